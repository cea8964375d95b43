//! What comments and glyphs say of a position.

use super::glyph;
use crate::notation::{Arrow, Circle};

/// What is said of the position after a move, or of the start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Notes {
    /// Seconds left on the clock of the player who has just moved (`[%clk 1:02:03]`).
    pub clock: Option<f64>,
    /// Seconds that the move took (`[%emt 0:00:09]`).
    pub elapsed: Option<f64>,
    /// Who stands better (`[%eval 0.17]`).
    pub eval: Option<Eval>,
    /// Squares with a ring (`[%csl Gd5,Ra1]`).
    pub circles: Vec<Circle>,
    /// Arrows (`[%cal Ge2e4]`).
    pub arrows: Vec<Arrow>,
    /// Numeric annotation glyphs (`!` is 1, `?` is 2, …), in the order of the file.
    pub glyphs: Vec<u8>,
}

/// How much better White stands; negative where Black does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eval {
    /// In pawns.
    Pawns(f64),
    /// Moves to mate (`[%eval #-3]`: Black mates in 3); 0 where it is mate already.
    Mate(i32),
}

/// One thing that a comment says to programs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Note {
    Clock(f64),
    Elapsed(f64),
    Eval(Eval),
    Circle(Circle),
    Arrow(Arrow),
}

/// How many circles, how many arrows and how many glyphs of a position are kept.
const MOST: usize = 64;

impl Notes {
    /// What is said of the move: `!`, `?`, `!!`, `??`, `!?` or `?!`. The first one counts.
    pub fn move_glyph(&self) -> Option<&'static str> {
        self.glyphs.iter().find_map(|nag| glyph::of_move(*nag))
    }

    /// What is said of the position: `=`, `∞`, `⩲`, `⩱`, `±`, `∓`, `+−` or `−+`. The first one
    /// counts.
    pub fn position_glyph(&self) -> Option<&'static str> {
        self.glyphs.iter().find_map(|nag| glyph::of_position(*nag))
    }

    /// Takes a note over. Of two clocks, times or evals the first one counts.
    pub(super) fn add(&mut self, note: Note) {
        match note {
            Note::Clock(seconds) => _ = self.clock.get_or_insert(seconds),
            Note::Elapsed(seconds) => _ = self.elapsed.get_or_insert(seconds),
            Note::Eval(eval) => _ = self.eval.get_or_insert(eval),
            Note::Circle(circle) => push(&mut self.circles, circle),
            Note::Arrow(arrow) => push(&mut self.arrows, arrow),
        }
    }

    /// Takes a glyph over by its number.
    pub(super) fn add_glyph(&mut self, nag: u8) {
        push(&mut self.glyphs, nag);
    }
}

/// Adds what is not there yet, as long as there is room.
fn push<T: PartialEq>(list: &mut Vec<T>, item: T) {
    if list.len() < MOST && !list.contains(&item) {
        list.push(item);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_bounded_and_said_once() {
        let mut notes = Notes::default();
        for nag in (1..=255).chain(1..=255) {
            notes.add_glyph(nag);
        }
        assert_eq!(notes.glyphs, (1..=64).collect::<Vec<u8>>());
        notes.add(Note::Clock(2.0));
        notes.add(Note::Clock(1.0));
        assert_eq!(notes.clock, Some(2.0));
    }

    #[test]
    fn glyphs_are_written_for_move_and_position_apart() {
        let glyphs = |glyphs: &[u8]| {
            let notes = Notes { glyphs: glyphs.to_vec(), ..Notes::default() };
            (notes.move_glyph(), notes.position_glyph())
        };
        assert_eq!(glyphs(&[]), (None, None));
        assert_eq!(glyphs(&[146, 18, 3]), (Some("!!"), Some("+−")));
        assert_eq!(glyphs(&[5, 14, 6]), (Some("!?"), Some("⩲")));
    }
}
