//! Marks on the board: which are shown, and what is drawn on a diagram.

use clap::Args;
use lightsquare::config::{Marks, unknown};
use lightsquare::job::Drawn;
use lightsquare::notation::{Arrow, Circle, ParseMarkError, Square};

use super::UsageError;

/// The kinds of marks that are to be shown, by name.
#[derive(Clone)]
pub struct MarksArg(Vec<String>);

impl MarksArg {
    /// Reads names with commas between them, or `all` or `none`.
    pub fn parse(text: &str) -> Result<MarksArg, String> {
        let mut known = ["last-move", "check", "mate", "drawn", "all", "none"].into_iter();
        let names: Vec<String> = text.split(',').map(|name| name.trim().to_lowercase()).collect();
        for name in &names {
            if !known.clone().any(|known| known == name) {
                return Err(unknown("mark", name, &mut known));
            }
            if names.len() > 1 && ["all", "none"].contains(&name.as_str()) {
                return Err(format!("`{name}` stands beside others, expected it alone"));
            }
        }
        Ok(MarksArg(names))
    }

    pub fn apply(&self, marks: &mut Marks) {
        for (name, is_shown) in marks.kinds() {
            *is_shown = self.shows(name);
        }
    }

    fn shows(&self, kind: &str) -> bool {
        self.0.iter().any(|name| name == kind || name == "all")
    }
}

/// What is to be drawn on the board.
#[derive(Args)]
#[command(next_help_heading = "Marks")]
pub struct DrawnArgs {
    /// Arrows to draw, with commas between: a colour (G, R, Y, B) and two squares, as in Ge2e4,Rd1d8
    /// [without the colour: green]
    #[arg(long, value_name = "ARROWS", value_delimiter = ',', value_parser = arrow)]
    arrows: Vec<Arrow>,
    /// Squares to draw rings on, likewise: a colour and a square, as in Gd5,Ra1
    #[arg(long, value_name = "SQUARES", value_delimiter = ',', value_parser = circle)]
    squares: Vec<Circle>,
    /// The squares that the last move left and reached, as in e2e4 [default: those of the game]
    #[arg(long, value_name = "SQUARES", value_parser = last_move)]
    last_move: Option<(Square, Square)>,
}

impl DrawnArgs {
    /// Switches on what is asked for; `given` is the flag that says which marks are shown.
    ///
    /// # Errors
    /// When that flag says otherwise.
    pub fn show(&self, given: Option<&MarksArg>, marks: &mut Marks) -> Result<(), UsageError> {
        let asked = [
            ("--arrows", "drawn", !self.arrows.is_empty()),
            ("--squares", "drawn", !self.squares.is_empty()),
            ("--last-move", "last-move", self.last_move.is_some()),
        ];
        for (flag, kind, _) in asked.into_iter().filter(|(_, _, is_asked)| *is_asked) {
            if given.is_some_and(|given| !given.shows(kind)) {
                let message = format!("{flag}: --marks leaves {kind} out, expected it in the list");
                return Err(UsageError(message));
            }
            for (_, is_shown) in marks.kinds().into_iter().filter(|(name, _)| *name == kind) {
                *is_shown = true;
            }
        }
        Ok(())
    }

    pub fn into_drawn(self) -> Drawn {
        let last_move = self.last_move.map(|(from, to)| [from, to]);
        Drawn { circles: self.squares, arrows: self.arrows, last_move }
    }
}

fn arrow(text: &str) -> Result<Arrow, ParseMarkError> {
    with_brush(text, 4).parse()
}

fn circle(text: &str) -> Result<Circle, ParseMarkError> {
    with_brush(text, 2).parse()
}

/// A mark with the letter of its brush; one of no more than `squares` letters has none, and is green.
fn with_brush(text: &str, squares: usize) -> String {
    let text = text.trim();
    if text.chars().count() == squares { format!("G{text}") } else { text.to_owned() }
}

fn last_move(text: &str) -> Result<(Square, Square), String> {
    let found = Some(text.trim()).filter(|text| text.chars().count() == 4).map(arrow);
    match found {
        Some(Ok(Arrow { from, to, .. })) => Ok((from, to)),
        Some(Err(error @ ParseMarkError::ToItself)) => Err(error.to_string()),
        _ => Err("expected two squares, as in e2e4".to_owned()),
    }
}
