//! How many samples pixels get.

use super::Antialiasing;
use super::outlook::Known;
use super::samples::Sum;
use crate::scene::Scene;

/// No fewer samples are believed. With so many, pixels share out light between them.
const FEWEST: u32 = 4;

/// How far off, in pixels, others are whose first looks tell how much there is of light that is shared out.
const REACH: u32 = 2;

/// With so many times the first samples an error may be as great as the threshold.
const ENOUGH: f32 = 1.25;

/// What looks like what is beside it may err as if it had so many samples more.
const PLAIN: f32 = 2.0;

/// How many samples pixels get.
pub struct Sizes {
    /// Of a pixel to begin with, of one that is not as simple as it seems, and at most.
    pub few: u32,
    first: u32,
    pub most: u32,
    /// The error of a pixel's mean that is small enough, of what can be shown; negative where none is.
    error: f32,
    has_lens: bool,
}

impl Sizes {
    /// Of a grid the number of rays alone counts; adaptive, a pixel begins with a few, and goes on while the error
    /// of its mean seems too great. Before a quarter of them it stops only where it is like the pixels beside it.
    pub fn new(scene: &Scene, mode: Antialiasing) -> Sizes {
        let (first, most, error) = match mode {
            Antialiasing::None => (1, 1, -1.0),
            Antialiasing::Grid(side) => (side * side, side * side, -1.0),
            Antialiasing::Adaptive { rays, threshold } => {
                // Samples are most even in powers of two.
                let quarter = (rays * rays / 4).max(1);
                (1 << quarter.ilog2(), rays * rays, threshold)
            }
        };
        let has_lens = scene.camera.has_lens();
        let few = if has_lens { first } else { first / 4 };
        Sizes { few: few.max(FEWEST).min(most), first, most, error, has_lens }
    }

    /// Whether pixels share out light.
    pub fn share_out(&self) -> bool {
        self.few == FEWEST
    }

    /// How far off, in columns and rows, pixels are whose first looks count.
    pub fn reach(&self) -> u32 {
        if self.share_out() { REACH } else { 1 }
    }

    /// How many samples side by side make a pixel's width, as far as textures are concerned.
    pub fn across(&self) -> f64 {
        f64::from(self.first).sqrt().min(4.0)
    }

    /// Whether a pixel that had its first look needs more samples. `around` are the first looks at it and at the
    /// pixels beside it: where they spread, its own few may be alike by chance.
    pub fn goes_on(&self, sum: &Sum, around: &Sum, known: &Known, differs: bool) -> bool {
        let least = around.deviation(known) / (self.few as f32).sqrt();
        self.is_short(sum, least.max(sum.error(known)), differs)
    }

    /// Whether it needs more than it has.
    pub fn wants_more(&self, sum: &Sum, known: &Known, differs: bool) -> bool {
        self.is_short(sum, sum.error(known), differs)
    }

    /// An error may be the greater the more samples it took. So each sample goes where it brings most, since
    /// halving an error takes four times as many.
    fn is_short(&self, sum: &Sum, error: f32, differs: bool) -> bool {
        if sum.count >= self.most {
            return false;
        }
        if differs && sum.count < self.first {
            return true;
        }
        // What a lens blurs is made of few bright samples among many.
        let small = if self.has_lens { self.error / 2.0 } else { self.error };
        let count = sum.count as f32 + if differs { 0.0 } else { PLAIN };
        error > small * count / (ENOUGH * self.first as f32)
    }
}
