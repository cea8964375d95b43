//! A grid of cells on which bodies stand: which of them a ray passes is known without asking any.

use glam::Vec3;
use smallvec::SmallVec;

use super::world::Search;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;
use crate::scene::Cells;

/// Rows and columns at most, so that a cell is a bit of 64.
const SIDE: usize = 8;

/// What stands in the cells.
pub struct Grid {
    /// The middle of the first cell, and the way from one to the next.
    origin: [f32; 2],
    side: f32,
    /// How far bodies reach from the middles of their cells, from how low to how high.
    reach: f32,
    low: f32,
    high: f32,
    /// By cell, row by row: the bodies that stand in it.
    standing: Vec<SmallVec<[usize; 2]>>,
    /// Which cells are not empty.
    occupied: u64,
}

impl Grid {
    /// The grid of `cells` with those of the `bodies` (each with its box) that lie within one of them, and
    /// those that do not.
    pub fn new(
        cells: Option<Cells>,
        bodies: impl Iterator<Item = (usize, [Vec3; 2])>,
    ) -> (Grid, Vec<usize>) {
        let Cells { origin, side } = cells.unwrap_or_default();
        let mut grid = Grid {
            origin: [origin.x as f32, origin.y as f32],
            side: side as f32,
            reach: 0.0,
            low: f32::INFINITY,
            high: f32::NEG_INFINITY,
            standing: vec![SmallVec::new(); SIDE * SIDE],
            occupied: 0,
        };
        let mut loose = Vec::new();
        for (index, [min, max]) in bodies {
            let cell = if cells.is_some() { grid.cell(min, max) } else { None };
            let Some(([column, row], reach)) = cell else {
                loose.push(index);
                continue;
            };
            let cell = SIDE * row + column;
            grid.standing[cell].push(index);
            grid.occupied |= 1 << cell;
            grid.reach = grid.reach.max(reach);
            grid.low = grid.low.min(min.y);
            grid.high = grid.high.max(max.y);
        }
        (grid, loose)
    }

    /// The cell that holds a box wholly, and how far that reaches from the cell's middle.
    fn cell(&self, min: Vec3, max: Vec3) -> Option<([usize; 2], f32)> {
        let middle = (min + max) / 2.0;
        let place = [middle.x - self.origin[0], middle.z - self.origin[1]];
        let place = place.map(|along| (along / self.side).round());
        let is_there = place.iter().all(|index| (0.0..SIDE as f32).contains(index));
        let aside = |index: usize, low: f32, high: f32| {
            let middle = self.origin[index] + place[index] * self.side;
            (high - middle).max(middle - low)
        };
        let reach = aside(0, min.x, max.x).max(aside(1, min.z, max.z));
        (is_there && reach < self.side / 2.0).then(|| (place.map(|index| index as usize), reach))
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
        let passed = self.passed(rays, inverse, search);
        let [low, high] = passed.map(U32x8::store);
        let mut any = [0, 0];
        for lane in 0..8 {
            any = [any[0] | low[lane], any[1] | high[lane]];
        }
        let mut left = (u64::from(any[0]) | u64::from(any[1]) << 32) & self.occupied;
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

    /// The cells that rays pass at the height of what stands in them, and near enough to meet any of it: bits by
    /// row and column.
    #[inline(always)]
    fn passed<S: Simd>(
        &self,
        rays: &Rays<S>,
        inverse: Vec3x8<S>,
        search: &Search<S>,
    ) -> [U32x8<S>; 2] {
        let (o, d) = (rays.origin, rays.direction);
        let number = F32x8::splat;
        // Where the ray is at the right height; an endless one is as good as this long.
        let (a, b) = ((number(self.low) - o.y) * inverse.y, (number(self.high) - o.y) * inverse.y);
        let enter = a.min(b).max(number(0.0));
        let exit = a.max(b).min(search.before).min(number(1e6));
        let lanes = search.lanes & enter.le(exit);
        if !lanes.any() {
            return [U32x8::splat(0); 2];
        }
        // Along the rows: from where a ray is near the middle line of one to where it is no more.
        let reach = number(self.reach).with_sign_of(d.z);
        let to_first = number(self.origin[1]) - o.z;
        // A ray that keeps within a row is taken to be in all that it is near.
        let is_level = d.z.abs().lt(number(1e-12));
        let scale = number(1.0 / self.side);
        let (left, right) = (
            number((self.side - self.reach - self.origin[0]) / self.side),
            number((self.reach - self.origin[0]) / self.side),
        );
        let mut passed = [U32x8::splat(0); 2];
        for row in 0..SIDE {
            let to_row = to_first + number(row as f32 * self.side);
            let near = is_level.select(number(f32::NEG_INFINITY), (to_row - reach) * inverse.z);
            let far = is_level.select(number(f32::INFINITY), (to_row + reach) * inverse.z);
            let (from, to) = (near.max(enter), far.min(exit));
            let is_in = from.le(to) & !(is_level & to_row.abs().gt(number(self.reach)));
            let (a, b) = (o.x + d.x * from, o.x + d.x * to);
            let first = (a.min(b) * scale + left).floor().clamp(0.0, SIDE as f32);
            let behind = (a.max(b) * scale + right + number(1.0)).floor().clamp(0.0, SIDE as f32);
            let one = U32x8::splat(1);
            let bits = (one << behind.to_i32()) - (one << first.to_i32());
            let is_any = is_in & lanes & first.lt(behind);
            let word = &mut passed[row / 4];
            *word = *word | is_any.select_words(bits, U32x8::splat(0)) << (8 * (row % 4)) as u32;
        }
        passed
    }
}
