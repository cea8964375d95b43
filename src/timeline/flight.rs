//! The way of one piece through a move's time.

use super::pieces::Spot;

/// A way up, over and down again; times are shares of the move's time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    pub from: Spot,
    pub to: Spot,
    /// The height that it rises to, in squares above the board.
    pub over: f64,
    /// Which share of its own time it takes to rise, and so to sink: 0.5 makes an arc.
    pub rise: f64,
    /// Whether it sinks in the whole second half of its time instead, gently.
    pub settles: bool,
    /// Which share of its own time it goes straight up first, and straight down at last.
    pub steep: f64,
    /// When it begins and ends.
    pub begin: f64,
    pub end: f64,
}

impl Flight {
    /// The point of its way, as seen from above, that is nearest to a `spot`.
    pub fn nearest(&self, spot: Spot) -> Spot {
        let (across, away) = (self.to.file - self.from.file, self.to.rank - self.from.rank);
        let length2 = across * across + away * away;
        let towards = (spot.file - self.from.file) * across + (spot.rank - self.from.rank) * away;
        let along = if length2 > 0.0 { (towards / length2).clamp(0.0, 1.0) } else { 0.0 };
        Spot {
            file: mix(self.from.file, self.to.file, along),
            rank: mix(self.from.rank, self.to.rank, along),
            ..spot
        }
    }

    /// Where the piece is when the part `passed` (0 to 1) of the move's time is over.
    pub fn at(&self, passed: f64) -> Spot {
        let own = ((passed - self.begin) / (self.end - self.begin)).clamp(0.0, 1.0);
        let along = ease((own - self.steep) / (1.0 - 2.0 * self.steep));
        let (ground, left) =
            if own < 0.5 { (self.from.height, own) } else { (self.to.height, 1.0 - own) };
        let lifted =
            if self.settles && own > 0.5 { ease(2.0 * left) } else { arc(left / self.rise) };
        Spot {
            file: mix(self.from.file, self.to.file, along),
            rank: mix(self.from.rank, self.to.rank, along),
            height: mix(ground, self.over.max(ground), lifted),
        }
    }
}

/// From 0 to 1 with a gentle beginning and end; it stays there.
pub fn ease(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// From 0 to 1 with a quick beginning and a gentle end; it stays there. (A piece has to be high before it
/// has gone far.)
fn arc(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    let once = t * (2.0 - t);
    once * (2.0 - once)
}

/// The point that divides the way from `a` to `b` at the share `t`.
pub fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}
