//! Which marks are painted on the board, and in what colours.

use glam::DVec3;
use serde::Serialize;

use super::keys::{Key, key};
use super::values::{COLOR, YES_NO};

/// The marks on the board's squares.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Marks {
    pub last_move: bool,
    pub check: bool,
    /// A mated king is marked as one in check where this is off and `check` is on.
    pub mate: bool,
    /// The squares and arrows that comments name, and those that are asked for.
    pub drawn: bool,
    /// Colours as they are written to a picture, each channel 0 to 1.
    pub last_move_color: DVec3,
    pub check_color: DVec3,
    pub mate_color: DVec3,
    /// Of the four brushes.
    pub green: DVec3,
    pub red: DVec3,
    pub yellow: DVec3,
    pub blue: DVec3,
}

impl Marks {
    /// The kinds of marks by name, and whether each is shown.
    pub fn kinds(&mut self) -> [(&'static str, &mut bool); 4] {
        [
            ("last-move", &mut self.last_move),
            ("check", &mut self.check),
            ("mate", &mut self.mate),
            ("drawn", &mut self.drawn),
        ]
    }

    /// Colours to be told apart by their brightness too, where a picture is printed in greys.
    pub(super) fn new(are_shown: bool) -> Marks {
        Marks {
            last_move: are_shown,
            check: are_shown,
            mate: are_shown,
            drawn: are_shown,
            last_move_color: DVec3::new(0.93, 0.76, 0.2),
            check_color: DVec3::new(0.86, 0.12, 0.1),
            mate_color: DVec3::new(0.62, 0.04, 0.1),
            green: DVec3::new(0.3, 0.7, 0.3),
            red: DVec3::new(0.86, 0.17, 0.13),
            yellow: DVec3::new(0.98, 0.82, 0.2),
            blue: DVec3::new(0.06, 0.18, 0.52),
        }
    }
}

pub const KEYS: [Key<Marks>; 11] = [
    key!("LastMove", Marks, last_move: YES_NO),
    key!("Check", Marks, check: YES_NO),
    key!("Mate", Marks, mate: YES_NO),
    key!("Drawn", Marks, drawn: YES_NO),
    key!("LastMoveColor", Marks, last_move_color: COLOR),
    key!("CheckColor", Marks, check_color: COLOR),
    key!("MateColor", Marks, mate_color: COLOR),
    key!("Green", Marks, green: COLOR),
    key!("Red", Marks, red: COLOR),
    key!("Yellow", Marks, yellow: COLOR),
    key!("Blue", Marks, blue: COLOR),
];
