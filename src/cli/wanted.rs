//! Which games are wanted.

use clap::Args;
use lightsquare::game::{Players, PlyRange, PositionPattern, Selection, TagTest, Wanted};

use super::UsageError;
use super::values::limit;

pub const EXAMPLES: &str = "\
Games are those that pass every test. Examples:
  --select 1:3,10                           by number
  --tag 'White=Kasparov*'                   * is any run of characters; case and accents are the same
  --tag 'WhiteElo>=2500' --tag Result=1-0   several tests, all must hold; also != < <= >
  --tag 'Date<1962'                         before 1962; what is unknown of a date is not guessed
  --tag ECO=B20-B99                         a range of openings
  --tag 'Annotator=*'                       games that have the tag; 'Annotator!=*' those that do not
  --player Kasparov --player Karpov         with either colour; two of them against each other
  --plies 20-80 --checkmate                 so many half-moves, and then mate
  --fen '*/*/*/*/*/*/*PPP*/*K* w'           a position that was reached, with White to move";

/// Which games are wanted.
#[derive(Args)]
#[command(next_help_heading = "Which games")]
pub struct WantedArgs {
    /// Numbers of games in their file, as in 3, 5-9 or 1:3,10
    #[arg(long, value_name = "GAMES")]
    select: Option<Selection>,
    /// What a tag must say: its name, one of = != < <= > >= and a value, as in 'White=Kasparov*',
    /// 'WhiteElo>=2500', 'Date<1962' or ECO=B20-B99; all of several must hold
    #[arg(long = "tag", value_name = "TEST")]
    tags: Vec<TagTest>,
    /// Who must have played, by surname or whole name; two of them against each other
    #[arg(long = "player", value_name = "NAME")]
    players: Vec<String>,
    /// How many half-moves could be played, as in 20-80, 20-, -80 or 20
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    plies: Option<PlyRange>,
    /// Only games that end in mate
    #[arg(long)]
    checkmate: bool,
    /// A position that was reached: a FEN, in whose ranks ? is any square, ! a piece, A a white and a a
    /// black one, * any number of squares, [Qq] one of a list and [^Qq] none of it
    #[arg(long, value_name = "PATTERN")]
    fen: Option<PositionPattern>,
    /// How many games to take, of all files together
    #[arg(long, value_name = "N", value_parser = limit)]
    limit: Option<usize>,
}

impl WantedArgs {
    pub fn into_wanted(self) -> Result<Wanted, UsageError> {
        Ok(Wanted {
            numbers: self.select,
            tags: self.tags,
            players: Players::new(&self.players)
                .map_err(|error| UsageError(format!("--player: {error}")))?,
            plies: self.plies,
            checkmate: self.checkmate,
            position: self.fen,
            limit: self.limit,
        })
    }
}
