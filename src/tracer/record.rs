//! What each pixel of a picture depends on.

use rayon::prelude::*;

use super::mask::{Mask, TILE};
use super::plane::{Plane, Spot};
use super::ties::Ties;

/// What pixels depend on, and what those of each tile do.
pub struct Record {
    pub pixels: Plane<Ties>,
    tiles: Vec<Ties>,
}

impl Record {
    /// Of pixels that depend on nothing.
    pub fn new(size @ [width, height]: [u32; 2]) -> Record {
        let [columns, rows] = size.map(|side| side.div_ceil(TILE) as usize);
        let nothing = Ties::default();
        Record { pixels: Plane::new(width, height, nothing), tiles: vec![nothing; columns * rows] }
    }

    /// Takes note that some pixels have changed.
    pub fn update(&mut self, changed: &Mask) {
        let pixels = &self.pixels;
        let stale: Vec<usize> = changed.tiles().collect();
        let sum = |tile: &usize| spots(pixels, *tile).map(|spot| pixels.value(spot)).collect();
        let sums: Vec<Ties> = stale.par_iter().with_min_len(64).map(sum).collect();
        stale.into_iter().zip(sums).for_each(|(tile, sum)| self.tiles[tile] = sum);
    }

    /// The pixels that depend on any of `changed`.
    pub fn stale(&self, changed: &Ties) -> Mask {
        let mut mask = Mask::empty([self.pixels.width, self.pixels.height]);
        for (index, _) in self.tiles.iter().enumerate().filter(|(_, ties)| ties.meet(changed)) {
            let stale =
                spots(&self.pixels, index).filter(|spot| self.pixels.value(*spot).meet(changed));
            stale.for_each(|spot| mask.add(spot));
        }
        mask
    }
}

/// The pixels of a tile.
fn spots(pixels: &Plane<Ties>, tile: usize) -> impl Iterator<Item = Spot> + use<> {
    let (width, height) = (pixels.width, pixels.height);
    let columns = width.div_ceil(TILE);
    let (x, y) = (tile as u32 % columns * TILE, tile as u32 / columns * TILE);
    (y..(y + TILE).min(height)).flat_map(move |y| (x..(x + TILE).min(width)).map(move |x| [x, y]))
}
