//! What a shard has of all that is rendered.

use std::cmp::Ordering;
use std::ops::Range;

use serde::{Deserialize, Serialize};

/// A frame of all that a plan renders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Place {
    /// The file, counted from 0 in the order of the head.
    pub file: usize,
    /// The game's number in it.
    pub game: usize,
    /// Counted from 0 over the game and its variations.
    pub frame: u64,
}

/// A part of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    pub number: usize,
    pub frames: u64,
    pub begin: Place,
    /// Behind its last frame.
    pub end: Place,
}

impl Shard {
    /// Which frames of a game it has, of so many that there are in the game and its variations.
    pub fn of(&self, file: usize, game: usize, frames: u64) -> Range<u64> {
        let at = |place: Place| match (place.file, place.game).cmp(&(file, game)) {
            Ordering::Less => 0,
            Ordering::Equal => place.frame.min(frames),
            Ordering::Greater => frames,
        };
        at(self.begin)..at(self.end)
    }

    /// The numbers of the games of a file that it has frames of.
    pub fn games(&self, file: usize) -> Range<usize> {
        let first = match self.begin.file.cmp(&file) {
            Ordering::Less => 1,
            Ordering::Equal => self.begin.game,
            Ordering::Greater => return 0..0,
        };
        match self.end.file.cmp(&file) {
            Ordering::Less => 0..0,
            // Where it ends with the game before, it has nothing of this one.
            Ordering::Equal => first..self.end.game + usize::from(self.end.frame > 0),
            Ordering::Greater => first..usize::MAX,
        }
    }

    /// The files that it has frames of, with some between that may have none.
    pub fn files(&self) -> Range<usize> {
        let last = self.end.file;
        self.begin.file..last + usize::from(!self.games(last).is_empty())
    }
}
