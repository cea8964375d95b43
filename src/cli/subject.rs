//! Where a single position comes from.

use std::path::PathBuf;

use clap::Args;
use lightsquare::game::{Letters, Moment};
use lightsquare::job::Subject;
use lightsquare::notation::Placement;

use super::UsageError;
use super::values::{FenArg, fen, game_number};

/// Where a single position comes from.
#[derive(Args)]
pub struct SubjectArgs {
    /// A file of games in PGN; - is the standard input
    #[arg(value_name = "PGN", required_unless_present_any = ["fen", "white", "black", "print_config"])]
    input: Option<PathBuf>,
    /// The game's number in its file
    #[arg(long, value_name = "GAME", default_value = "1", value_parser = game_number, conflicts_with_all = ["fen", "white", "black"])]
    select: usize,
    /// Letters of the pieces: english, german, french, czech, …; auto finds those of a whole game
    #[arg(long, value_name = "LANGUAGE", default_value = "auto", conflicts_with_all = ["fen", "white", "black"])]
    letters: Letters,
    /// The position: after a move (17w, 17b), after so many half-moves, start or end
    #[arg(long, value_name = "MOVE", default_value = "end", conflicts_with_all = ["fen", "white", "black"])]
    at: Moment,
    /// A position as FEN, or the board part of one; it need not be legal
    #[arg(long, value_name = "FEN", value_parser = fen, conflicts_with_all = ["input", "white", "black"])]
    fen: Option<FenArg>,
    /// White's pieces in the thesis's letters K D V S J P, as in KE1PE2
    #[arg(long, value_name = "PIECES", conflicts_with = "input")]
    white: Option<String>,
    /// Black's pieces, likewise
    #[arg(long, value_name = "PIECES", conflicts_with = "input")]
    black: Option<String>,
}

impl SubjectArgs {
    pub fn into_subject(self) -> anyhow::Result<Subject> {
        Ok(match (self.input, self.fen) {
            (Some(file), _) => {
                Subject::Game { file, letters: self.letters, number: self.select, at: self.at }
            }
            (None, Some(FenArg(placement, fen))) => Subject::Placement { placement, fen },
            (None, None) => {
                let [white, black] =
                    [&self.white, &self.black].map(|text| text.as_deref().unwrap_or_default());
                let placement = Placement::parse(white, black)
                    .map_err(|error| UsageError(format!("--white or --black: {error}")))?;
                Subject::Placement { fen: placement.board_fen(), placement }
            }
        })
    }
}
