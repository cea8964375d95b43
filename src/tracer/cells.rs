//! A grid of cells on which bodies stand: which of them a ray passes is known without asking any.

use smallvec::SmallVec;

use super::slab::{SIDE, Slab};
use super::world::Search;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;
use crate::scene::Cells;

/// What stands in the cells.
pub struct Grid {
    slab: Slab,
    /// By cell, row by row: the bodies that stand in it.
    standing: Vec<SmallVec<[usize; 2]>>,
    /// Which cells are not empty.
    occupied: u64,
}

impl Grid {
    pub fn new(cells: Cells) -> Grid {
        let Cells { origin, side, reach, heights } = cells;
        Grid {
            slab: Slab {
                origin: [origin.x as f32, origin.y as f32],
                side: side as f32,
                reach: reach as f32,
                heights: heights.map(|height| height as f32),
            },
            standing: vec![SmallVec::new(); SIDE * SIDE],
            occupied: 0,
        }
    }

    /// Puts a body into a cell.
    pub fn stand(&mut self, body: usize, cell: usize) {
        self.standing[cell].push(body);
        self.occupied |= 1 << cell;
    }

    /// Shows `look` the bodies in the cells that rays pass; see `World::visit`.
    #[inline(always)]
    pub fn visit<S: Simd>(
        &self,
        rays: &Rays<S>,
        inverse: Vec3x8<S>,
        search: &mut Search<S>,
        mut look: impl FnMut(usize, Mask8<S>, &mut Search<S>),
    ) {
        if self.occupied == 0 {
            return;
        }
        let mut rows = [U32x8::splat(0); SIDE];
        self.slab.rows(rays, inverse, search.before, search.lanes, &mut rows);
        let passed = [
            rows[0] | rows[1] << 8 | rows[2] << 16 | rows[3] << 24,
            rows[4] | rows[5] << 8 | rows[6] << 16 | rows[7] << 24,
        ];
        let [low, high] = [passed[0].in_any_lane(), passed[1].in_any_lane()];
        let mut left = (u64::from(low) | u64::from(high) << 32) & self.occupied;
        // What is near is likely to come first.
        let is_backward = rays.direction.z.lt(F32x8::splat(0.0)).bits().count_ones() > 4;
        while left != 0 {
            let cell = if is_backward { 63 - left.leading_zeros() } else { left.trailing_zeros() };
            left &= !(1 << cell);
            let word = passed[(cell / 32) as usize] >> (cell % 32);
            let lanes = search.lanes & (word & U32x8::splat(1)).eq(U32x8::splat(1));
            if lanes.any() {
                for index in &self.standing[cell as usize] {
                    look(*index, lanes, search);
                }
            }
        }
    }
}
