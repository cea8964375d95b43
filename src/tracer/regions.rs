//! Where rays passed, so that what changes elsewhere need not be asked again.
//!
//! A region is a part of space: the room of what stands in a cell, with the cell's square beneath it; or a zone,
//! a column of space as wide as a cell, up to the height of what stands in cells, or from there up. The outermost
//! zones have no end, so that zones are everywhere.

use glam::{DVec3, Vec3};
use smallvec::SmallVec;

use crate::geometry::{Bounds, Solid};
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;
use crate::scene::{Cells, Object};

/// Columns and rows of zones, and how many of the columns lie before the first cell.
const COLUMNS: usize = 16;
const ROWS: usize = 8;
const BEFORE: f64 = 4.0;

/// Words for the zones of a layer, for both layers, and for cells.
const LAYER: usize = COLUMNS * ROWS / 32;
const CELLS: usize = 2;
const WORDS: usize = CELLS + 2 * LAYER;

/// A set of regions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Regions([u32; WORDS]);

impl Regions {
    /// Everywhere.
    pub const ALL: Regions = Regions([u32::MAX; WORDS]);

    /// The cells whose bits are set, row by row.
    pub fn of_cells(cells: u64) -> Regions {
        let mut regions = Regions::default();
        (regions.0[0], regions.0[1]) = (cells as u32, (cells >> 32) as u32);
        regions
    }

    /// Those parts of the set that are not empty, by number: what [`Regions::meet`] asks for.
    pub fn words(&self) -> SmallVec<[(usize, u32); WORDS]> {
        self.0.iter().copied().enumerate().filter(|(_, word)| *word != 0).collect()
    }

    /// Whether this set has any region in common with the one of these parts.
    #[inline(always)]
    pub fn meet(&self, words: &[(usize, u32)]) -> bool {
        words.iter().any(|(index, word)| self.0[*index] & word != 0)
    }

    pub fn add(&mut self, other: &Regions) {
        self.0.iter_mut().zip(other.0).for_each(|(word, other)| *word |= other);
    }

    /// Whether there is none that `other` has not.
    pub fn are_within(&self, other: &Regions) -> bool {
        self.0.iter().zip(other.0).all(|(word, other)| word & !other == 0)
    }

    pub fn is_empty(&self) -> bool {
        *self == Regions::default()
    }
}

/// A space that is divided into regions.
#[derive(Clone, Copy)]
pub struct Space {
    cells: Cells,
    /// The zones' lower left corner, and their side.
    corner: [f32; 2],
    side: f32,
    /// Where the lower layer ends.
    top: f32,
    /// How far what stands in a cell is taken to reach from its middle, by rays on their way.
    reach: f32,
}

/// Room for rounding round boxes.
const MARGIN: f64 = 2e-3;

impl Space {
    pub fn new(cells: Cells) -> Space {
        let corner = cells.origin - cells.side / 2.0;
        Space {
            cells,
            corner: [(corner.x - BEFORE * cells.side) as f32, corner.y as f32],
            side: cells.side as f32,
            top: cells.heights[1] as f32,
            reach: cells.reach as f32,
        }
    }

    /// The same space, in which rays take what stands in cells to be narrower than it is, by the factor `share`:
    /// what they touch is not all told.
    pub fn shrunk(self, share: f32) -> Space {
        Space { reach: share * self.reach, ..self }
    }

    /// The cell in which a body stands; none where it does not keep to one.
    pub fn cell(&self, object: &Object) -> Option<usize> {
        let Bounds { min, max } = object.body.bounds();
        let Cells { origin, side, reach, heights: [low, high] } = self.cells;
        let middle = (min + max) / 2.0;
        let place = [middle.x - origin.x, middle.z - origin.y].map(|at| (at / side).round());
        let [column, row] = place;
        let is_there = place.iter().all(|index| (0.0..ROWS as f64).contains(index));
        let (x, z) = (origin.x + column * side, origin.y + row * side);
        let asides = [x - min.x, max.x - x, z - min.z, max.z - z];
        let keeps = asides.iter().all(|aside| *aside <= reach) && min.y >= low && max.y <= high;
        (is_there && keeps).then(|| ROWS * row as usize + column as usize)
    }

    /// The regions that a body takes: its cell, or zones.
    pub fn regions(&self, object: &Object) -> Regions {
        let bounds = object.body.bounds();
        match self.cell(object) {
            _ if !bounds.is_finite() => Regions::ALL,
            Some(cell) => Regions::of_cells(1 << cell),
            None => self.zones(bounds.min, bounds.max),
        }
    }

    /// The zones that a box meets.
    fn zones(&self, min: DVec3, max: DVec3) -> Regions {
        let (min, max) = (min - MARGIN, max + MARGIN);
        let range = |low: f64, high: f64, corner: f32, count: usize| {
            let index = |at: f64| {
                let index = ((at - f64::from(corner)) / f64::from(self.side)).floor();
                index.clamp(0.0, (count - 1) as f64) as usize
            };
            index(low)..=index(high)
        };
        let mut regions = Regions::default();
        for row in range(min.z, max.z, self.corner[1], ROWS) {
            for column in range(min.x, max.x, self.corner[0], COLUMNS) {
                let zone = COLUMNS * row + column;
                let layers = [min.y <= f64::from(self.top), max.y >= f64::from(self.top)];
                for (layer, _) in layers.iter().enumerate().filter(|(_, is_met)| **is_met) {
                    regions.0[CELLS + layer * LAYER + zone / 32] |= 1 << (zone % 32);
                }
            }
        }
        regions
    }
}

/// The regions that eight rays, and those that come of them, have touched.
pub struct Touched<S: Simd> {
    words: [U32x8<S>; WORDS],
}

impl<S: Simd> Touched<S> {
    #[inline(always)]
    pub fn new() -> Touched<S> {
        Touched { words: [U32x8::splat(0); WORDS] }
    }

    #[inline(always)]
    pub fn store(&self) -> [Regions; 8] {
        let mut regions = [Regions::default(); 8];
        for (index, word) in self.words.iter().enumerate() {
            for (regions, word) in regions.iter_mut().zip(word.store()) {
                regions.0[index] = word;
            }
        }
        regions
    }

    /// Adds the same regions to some lanes.
    #[inline(always)]
    pub fn add(&mut self, lanes: Mask8<S>, regions: &Regions) {
        for (touched, word) in self.words.iter_mut().zip(regions.0) {
            if word != 0 {
                *touched = *touched | lanes.select_words(U32x8::splat(word), U32x8::splat(0));
            }
        }
    }

    /// Adds the cells whose squares lie under `points`.
    #[inline(always)]
    pub fn add_squares(&mut self, space: &Space, points: Vec3x8<S>, lanes: Mask8<S>) {
        let number = F32x8::splat;
        let Cells { origin, side, .. } = space.cells;
        let scale = number(1.0 / side as f32);
        let column = (points.x - number(origin.x as f32)) * scale + number(0.5);
        let row = (points.z - number(origin.y as f32)) * scale + number(0.5);
        let (column, row) = (column.floor().clamp(0.0, 7.0), row.floor().clamp(0.0, 7.0));
        let cell = (row.to_i32() << 3) + column.to_i32();
        let bit = U32x8::splat(1) << (cell & U32x8::splat(31));
        let is_high = cell.below(U32x8::splat(32));
        let zero = U32x8::splat(0);
        self.words[0] = self.words[0] | (lanes & is_high).select_words(bit, zero);
        self.words[1] = self.words[1] | lanes.but(is_high).select_words(bit, zero);
    }

    /// Adds all that rays pass up to the distances `to`.
    #[inline(never)]
    pub fn add_way(&mut self, space: &Space, rays: &Rays<S>, to: F32x8<S>, lanes: Mask8<S>) {
        S::run(
            #[inline(always)]
            || {
                let inverse = rays.direction.recips();
                let Cells { origin, side, heights: [low, high], .. } = space.cells;
                let cells = Slab {
                    origin: [origin.x as f32, origin.y as f32],
                    side: side as f32,
                    reach: space.reach,
                    heights: [low as f32, high as f32],
                };
                let zero = U32x8::splat(0);
                let mut rows = [zero; ROWS];
                cells.rows::<S, 8, false>(rays, inverse, to, lanes, &mut rows);
                for (index, bits) in rows.into_iter().enumerate() {
                    let word = &mut self.words[index / 4];
                    *word = *word | bits << (8 * (index % 4)) as u32;
                }
                let half = space.side / 2.0;
                // What has no end is as good as this high.
                let heights = [[-1e4, space.top], [space.top, 1e4]];
                for (layer, heights) in heights.into_iter().enumerate() {
                    let zones = Slab {
                        origin: [space.corner[0] + half, space.corner[1] + half],
                        side: space.side,
                        reach: half + 1e-3,
                        heights,
                    };
                    let mut rows = [zero; ROWS];
                    zones.rows::<S, COLUMNS, true>(rays, inverse, to, lanes, &mut rows);
                    for (index, bits) in rows.into_iter().enumerate() {
                        let word = &mut self.words[CELLS + layer * LAYER + index / 2];
                        *word = *word | bits << (16 * (index % 2)) as u32;
                    }
                }
            },
        );
    }
}

/// Rows of boxes of one height, in a plane of eight rows.
pub struct Slab {
    /// The middle of the first box, and the way to the next.
    pub origin: [f32; 2],
    pub side: f32,
    /// How far each box reaches from its middle.
    pub reach: f32,
    pub heights: [f32; 2],
}

impl Slab {
    /// Which of each row's `N` boxes rays pass up to `to`, as bits. If they are `ENDLESS`, boxes at the borders
    /// have no end.
    #[inline(always)]
    pub fn rows<S: Simd, const N: usize, const ENDLESS: bool>(
        &self,
        rays: &Rays<S>,
        inverse: Vec3x8<S>,
        to: F32x8<S>,
        lanes: Mask8<S>,
        rows: &mut [U32x8<S>; ROWS],
    ) {
        let (o, d) = (rays.origin, rays.direction);
        let number = F32x8::splat;
        // Where the ray is at the right height; an endless one is as good as this long. A level one is at its
        // height all the way, or nowhere.
        let [low, high] = self.heights;
        let (low, high) = (number(low), number(high));
        let (a, b) = ((low - o.y) * inverse.y, (high - o.y) * inverse.y);
        let is_flat = d.y.abs().lt(number(1e-12));
        let is_high = is_flat & o.y.ge(low) & o.y.le(high);
        let enter = is_flat.select(number(0.0), a.min(b).max(number(0.0)));
        let exit = is_flat.select(number(1e6), a.max(b)).min(to).min(number(1e6));
        let lanes = lanes & enter.le(exit) & (is_high | !is_flat);
        if !lanes.any() {
            return;
        }
        // Along the rows: from where a ray is near the middle line of one to where it is no more. A ray that
        // keeps within a row is taken to be in all that it is near.
        let reach = number(self.reach).with_sign_of(d.z);
        let to_first = number(self.origin[1]) - o.z;
        let is_level = d.z.abs().lt(number(1e-12));
        let scale = number(1.0 / self.side);
        let left = number((self.side - self.reach - self.origin[0]) / self.side);
        let right = number((self.side + self.reach - self.origin[0]) / self.side);
        let most = N as f32;
        let mut wanted = self.rows_of(o.z + d.z * enter, o.z + d.z * exit, lanes, ENDLESS);
        while wanted != 0 {
            let index = wanted.trailing_zeros() as usize;
            wanted &= wanted - 1;
            let to_row = to_first + number(index as f32 * self.side);
            let mut near = (to_row - reach) * inverse.z;
            let mut far = (to_row + reach) * inverse.z;
            let mut is_beside = is_level & to_row.abs().gt(number(self.reach));
            let endless = number(f32::INFINITY);
            if ENDLESS && (index == 0 || index == ROWS - 1) {
                // Beyond the first row or the last one.
                let is_outwards =
                    if index == 0 { d.z.lt(number(0.0)) } else { d.z.ge(number(0.0)) };
                far = is_outwards.select(endless, far);
                near = is_outwards.select(near, -endless);
                let beyond = if index == 0 { to_row } else { -to_row };
                is_beside = is_beside.but(beyond.gt(number(0.0)));
            }
            near = is_level.select(-endless, near);
            far = is_level.select(endless, far);
            let (from, until) = (near.max(enter), far.min(exit));
            let is_in = from.le(until).but(is_beside);
            let (a, b) = (o.x + d.x * from, o.x + d.x * until);
            let (first, behind) = (a.min(b) * scale + left, a.max(b) * scale + right);
            let one = U32x8::splat(1);
            let (first, behind) = if ENDLESS {
                (first.clamp(0.0, most - 1.0), behind.clamp(1.0, most))
            } else {
                (first.clamp(0.0, most), behind.clamp(0.0, most))
            };
            let (first, behind) = (first.floor(), behind.floor());
            let bits = (one << behind.to_i32()) - (one << first.to_i32());
            let is_any = is_in & lanes & first.lt(behind);
            rows[index] = is_any.select_words(bits, U32x8::splat(0));
        }
    }
}

impl Slab {
    /// The rows that ways from `a` to `b` across them may pass in any lane, as bits.
    #[inline(always)]
    fn rows_of<S: Simd>(&self, a: F32x8<S>, b: F32x8<S>, lanes: Mask8<S>, is_endless: bool) -> u32 {
        // As if boxes met, with room for rounding: one row more does no harm.
        let scale = F32x8::splat(1.0 / self.side);
        let low = a.min(b) * scale + F32x8::splat(0.49 - self.origin[1] / self.side);
        let high = a.max(b) * scale + F32x8::splat(1.51 - self.origin[1] / self.side);
        let most = ROWS as f32;
        let (first, behind) = if is_endless {
            (low.clamp(0.0, most - 1.0), high.clamp(1.0, most))
        } else {
            (low.clamp(0.0, most), high.clamp(0.0, most))
        };
        let one = U32x8::splat(1);
        let bits = (one << behind.to_i32()) - (one << first.to_i32());
        lanes.select_words(bits, U32x8::splat(0)).in_any_lane()
    }
}

/// A box round `min` and `max` in f32, with no more room than rounding needs: rays that leave a face must not be
/// taken to begin inside.
pub fn rounded(min: DVec3, max: DVec3) -> [Vec3; 2] {
    let room = |corner: DVec3| corner.abs() * 4e-6 + 1e-6;
    [(min - room(min)).as_vec3(), (max + room(max)).as_vec3()]
}
