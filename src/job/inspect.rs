//! What a file holds: games, or all their positions.

use std::io::Write;
use std::path::PathBuf;

use super::{JobError, Progress, say_missing, say_problems, shown};
use crate::game::{Game, Selection, Source, shortened};
use crate::notation::Color;

/// Which games to tell of, and how.
#[derive(Clone, Debug)]
pub struct InspectJob {
    /// Files of games; `-` is the standard input.
    pub inputs: Vec<PathBuf>,
    /// All games when `None`.
    pub selection: Option<Selection>,
    /// Every position as a tab-separated row, instead of a line a game.
    pub positions: bool,
}

/// Writes one line a game, or one row a position under a header line a file. Gives the number of
/// games that could not be read whole.
///
/// # Errors
/// Input that cannot be read, a selection without games, or what `out` gives.
pub fn inspect(
    job: &InspectJob,
    progress: &dyn Progress,
    out: &mut dyn Write,
) -> Result<usize, JobError> {
    let mut partial = 0;
    for input in &job.inputs {
        let file = shown(input);
        let games = Source::open(input)?.games();
        if job.positions {
            writeln!(out, "game\tply\tsan\tfen\twhite\tblack").map_err(JobError::Write)?;
        } else if job.inputs.len() > 1 {
            writeln!(out, "{file}").map_err(JobError::Write)?;
        }
        let (mut seen, mut selected) = (0, 0);
        for game in games {
            let game = game?;
            seen += 1;
            if job.selection.as_ref().is_some_and(|selection| !selection.contains(game.number)) {
                continue;
            }
            selected += 1;
            partial += usize::from(!game.is_whole());
            let written = if job.positions {
                say_problems(&file, &game, progress);
                positions(&game, out)
            } else {
                line(&game, out)
            };
            written.map_err(JobError::Write)?;
        }
        if selected == 0 {
            return Err(JobError::NothingSelected { file, games: seen });
        }
        say_missing(&file, job.selection.as_ref(), seen, progress);
    }
    out.flush().map_err(JobError::Write)?;
    Ok(partial)
}

fn line(game: &Game, out: &mut dyn Write) -> std::io::Result<()> {
    let [white, black] =
        [Color::White, Color::Black].map(|color| shortened(game.player(color), 60));
    let (number, result, plies) = (game.number, &game.result, game.plies.len());
    write!(out, "{number:>5}  {white} – {black}  {result}  {plies} plies")?;
    for name in ["Event", "Date"] {
        if let Some(value) = game.tag(name) {
            write!(out, "  {name} {}", shortened(value, 60))?;
        }
    }
    writeln!(out)?;
    for problem in &game.problems {
        writeln!(out, "       {problem}")?;
    }
    Ok(())
}

fn positions(game: &Game, out: &mut dyn Write) -> std::io::Result<()> {
    if !game.start_is_known {
        return Ok(());
    }
    for ply in 0..=game.plies.len() {
        let placement = game.placement(ply);
        let [white, black] = [Color::White, Color::Black].map(|color| placement.notation(color));
        let san = game.san(ply).unwrap_or("-");
        let fen = game.fen(ply);
        writeln!(out, "{}\t{ply}\t{san}\t{fen}\t{white}\t{black}", game.number)?;
    }
    Ok(())
}
