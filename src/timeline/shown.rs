//! What a frame shows beside the pieces: marks on the board, the clock, the camera's way.

use serde::Serialize;

use crate::config::Pose;
use crate::notation::{Arrow, Circle, Color, Square};

/// What the board tells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// The squares that the last move left and reached (castling: the king's), in this order; while
    /// a move is under way, its own.
    pub last_move: Vec<Square>,
    /// The square of a king in check, or mated.
    pub check: Option<Square>,
    /// Whether that check is mate.
    pub is_mate: bool,
    pub circles: Vec<Circle>,
    pub arrows: Vec<Arrow>,
}

/// What a chess clock shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Dials {
    /// Whole seconds left to White and to Black, where they are known.
    Times { left: [Option<u32>; 2], running: Option<Color> },
    /// Of a game without times: how many moves each player has made, where the position's number says it,
    /// and whose move it is.
    Moves { made: [u32; 2], to_move: Color },
}

/// Seconds as a digital clock shows them: `1:02:03`, `12:34`, `0:09`.
pub fn digital(seconds: u32) -> String {
    let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
    if hours > 0 {
        format!("{hours}:{minutes:02}:{seconds:02}")
    } else {
        format!("{minutes}:{seconds:02}")
    }
}

/// How far the camera is from where it stands at the film's beginning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Gaze {
    /// How far it has turned about the board, in degrees; positive is anticlockwise as seen from
    /// above.
    pub orbit: f64,
    /// The point that it leans towards, in squares from the board's middle to the right and away
    /// from White; (0, 0) for a camera that does not lean.
    pub lean: [f64; 2],
    /// Where it stands on its path, which is over all other cameras.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pose: Option<Pose>,
}

impl Gaze {
    /// Whether the camera is where it stands at the film's beginning.
    pub fn is_still(&self) -> bool {
        *self == Gaze::default()
    }
}

/// A picture of words before or behind the game.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Card {
    Title,
    Result,
}
