//! Phong's pictures: one ray a pixel, a grid, or a grid where neighbours differ.

use glam::Vec3;

use super::eye::Eye;
use super::footprint::Footprint;
use super::phong::{Places, Seen, Shade};
use super::pixel::{Stored, stored};
use super::plane::{Plane, Spot};
use super::sketch::Painter;
use super::ties::Ties;
use super::{Antialiasing, RayCounts};
use crate::lanes::{Simd, Task, dispatch};
use crate::scene::Scene;

/// Paints what an eye sees.
pub struct Sampling<E> {
    eye: E,
    mode: Antialiasing,
    /// Whether what meets nothing is transparent.
    is_transparent: bool,
    /// What is seen where nothing is met.
    nothing: Seen,
}

impl<E: Eye<Places, Seen> + Eye<Places, Shade>> Sampling<E> {
    pub fn new(eye: E, scene: &Scene, mode: Antialiasing) -> Sampling<E> {
        let background = scene.background.map(|color| color.as_vec3());
        let nothing = Seen {
            shade: Shade { color: background.unwrap_or(Vec3::ZERO), hits: false },
            footprint: Footprint::of_nothing(),
        };
        Sampling { eye, mode, is_transparent: background.is_none(), nothing }
    }

    /// How many rays a pixel gets across, if it gets more than one.
    fn side(&self) -> u32 {
        match self.mode {
            Antialiasing::None => 1,
            Antialiasing::Grid(side) | Antialiasing::Adaptive { rays: side, .. } => side,
        }
    }

    /// The means over the middles of `side` × `side` parts of pixels.
    fn means(
        &self,
        spots: &[Spot],
        made: &mut Vec<Stored>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        let side = self.side();
        let parts = (side * side) as usize;
        let mut seen: Vec<Shade> = Vec::with_capacity(spots.len() * parts);
        let mut each = ties.is_some().then(Vec::new);
        let counts = self.eye.see(&Places::new(spots, side), &mut seen, each.as_mut());
        let nothing = self.pixel(&self.nothing.shade);
        let is_transparent = self.is_transparent;
        dispatch(Means { seen: &seen, parts, is_transparent, nothing, made });
        if let (Some(ties), Some(each)) = (ties, each) {
            ties.extend(each.chunks_exact(parts).map(Ties::from_iter));
        }
        counts
    }

    fn pixel(&self, seen: &Shade) -> Stored {
        stored(parts_of(seen, self.is_transparent).map(f64::from))
    }
}

/// The means of each `parts` of what is seen.
struct Means<'a> {
    seen: &'a [Shade],
    parts: usize,
    is_transparent: bool,
    /// What a pixel shows where nothing is met.
    nothing: Stored,
    made: &'a mut Vec<Stored>,
}

impl Task for Means<'_> {
    type Output = ();

    /// Sums of so few f32 are exact in f64: the mean of any number of equal ones is the same again.
    #[inline(always)]
    fn run<S: Simd>(self) {
        for seen in self.seen.chunks_exact(self.parts) {
            let mut means = [0.0; 4];
            let mut hits = false;
            for shade in seen {
                hits |= shade.hits;
                for (sum, part) in means.iter_mut().zip(parts_of(shade, self.is_transparent)) {
                    *sum += f64::from(part);
                }
            }
            for mean in &mut means {
                *mean /= self.parts as f64;
            }
            self.made.push(if hits { stored(means) } else { self.nothing });
        }
    }
}

/// Red, green and blue, times cover, and cover.
#[inline(always)]
fn parts_of(seen: &Shade, is_transparent: bool) -> [f32; 4] {
    // What is too bright is as bright as can be, also beside what is not.
    let Vec3 { x, y, z } = seen.color.min(Vec3::ONE);
    if is_transparent && !seen.hits { [0.0; 4] } else { [x, y, z, 1.0] }
}

impl<E: Eye<Places, Seen> + Eye<Places, Shade>> Painter for Sampling<E> {
    type Look = Seen;
    type Work = Stored;

    fn nothing(&self) -> (Seen, Stored, Stored) {
        let stored = self.pixel(&self.nothing.shade);
        (self.nothing, stored, stored)
    }

    fn looks_first(&self) -> bool {
        matches!(self.mode, Antialiasing::Adaptive { .. })
    }

    fn look(
        &self,
        spots: &[Spot],
        made: &mut Vec<Seen>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        self.eye.see(&Places::new(spots, 1), made, ties)
    }

    fn work(
        &self,
        spots: &[Spot],
        looks: &Plane<Seen>,
        made: &mut Vec<Stored>,
        _: Option<&Plane<Ties>>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        let Antialiasing::Adaptive { threshold, .. } = self.mode else {
            return self.means(spots, made, ties);
        };
        let differs = |spot: &Spot| {
            let here = looks.at(*spot);
            looks.round(*spot, 1).any(|there| there.footprint.differs(&here.footprint, threshold))
        };
        let more: Vec<bool> = spots.iter().map(differs).collect();
        let some: Vec<Spot> =
            spots.iter().zip(&more).filter(|(_, more)| **more).map(|(spot, _)| *spot).collect();
        let mut means = Vec::with_capacity(some.len());
        let mut each = ties.is_some().then(Vec::new);
        let counts = self.means(&some, &mut means, each.as_mut());
        let (mut means, mut each) = (means.into_iter(), each.into_iter().flatten());
        let pairs = || spots.iter().zip(&more);
        let own = |spot: &Spot| self.pixel(&looks.at(*spot).shade);
        made.extend(pairs().map(|(spot, more)| {
            let mean = if *more { means.next() } else { None };
            mean.unwrap_or_else(|| own(spot))
        }));
        if let Some(ties) = ties {
            let next = |more: &bool| if *more { each.next() } else { None };
            ties.extend(more.iter().map(next).map(Option::unwrap_or_default));
        }
        counts
    }

    fn is_done(&self, _: Spot, _: &Plane<Seen>, _: &Stored) -> bool {
        false
    }

    fn finish(&self, _: Spot, _: &Plane<Seen>, work: &Stored) -> Stored {
        *work
    }

    fn reach(&self) -> u32 {
        1
    }

    fn rays(&self) -> u64 {
        if self.looks_first() { 1 } else { u64::from(self.side()).pow(2) }
    }
}
