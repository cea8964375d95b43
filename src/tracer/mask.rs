//! Some of a picture's pixels.

use rayon::prelude::*;

use super::plane::{Plane, Spot};

/// A tile's width and height in pixels.
pub const TILE: u32 = 8;

/// Pixels in blocks of this size make packets of rays that keep together.
const BLOCK: [u32; 2] = [4, 2];

/// A set of pixels, by tiles.
#[derive(Clone, Default)]
pub struct Mask {
    width: u32,
    height: u32,
    /// How many tiles there are in a row of them.
    columns: u32,
    /// By tile, row by row: a bit for each of its pixels, row by row.
    tiles: Vec<u64>,
}

impl Mask {
    /// None of the pixels of a picture.
    pub fn empty([width, height]: [u32; 2]) -> Mask {
        let columns = width.div_ceil(TILE);
        let tiles = vec![0; (columns * height.div_ceil(TILE)) as usize];
        Mask { width, height, columns, tiles }
    }

    /// All of them.
    pub fn full(size: [u32; 2]) -> Mask {
        let mut mask = Mask::empty(size);
        let [columns, rows] = size.map(|side| side.div_ceil(TILE));
        for row in 0..rows {
            (0..columns).for_each(|column| mask.add_tile([column, row]));
        }
        mask
    }

    /// Adds a tile, by its column and row.
    pub fn add_tile(&mut self, [column, row]: [u32; 2]) {
        let [width, height] = [self.width - column * TILE, self.height - row * TILE];
        let line = 0xFF >> (TILE - width.min(TILE));
        let lines = (0..height.min(TILE)).fold(0, |lines, y| lines | line << (y * TILE));
        self.tiles[(row * self.columns + column) as usize] = lines;
    }

    pub fn add(&mut self, [x, y]: Spot) {
        let tile = (y / TILE * self.columns + x / TILE) as usize;
        self.tiles[tile] |= 1 << (y % TILE * TILE + x % TILE);
    }

    pub fn has(&self, [x, y]: Spot) -> bool {
        let tile = (y / TILE * self.columns + x / TILE) as usize;
        self.tiles[tile] >> (y % TILE * TILE + x % TILE) & 1 == 1
    }

    /// Leaves out what is not to be kept.
    pub fn retain(&mut self, keeps: impl Fn(Spot) -> bool + Sync) {
        let columns = self.columns;
        let tiles = self.tiles.par_iter_mut().enumerate().with_min_len(64);
        tiles.filter(|(_, tile)| **tile != 0).for_each(|(index, tile)| {
            let (column, row) = (index as u32 % columns, index as u32 / columns);
            for bit in 0..TILE * TILE {
                let spot = [column * TILE + bit % TILE, row * TILE + bit / TILE];
                if *tile >> bit & 1 == 1 && !keeps(spot) {
                    *tile &= !(1 << bit);
                }
            }
        });
    }

    /// Adds all pixels of another set of the same picture.
    pub fn add_all(&mut self, other: &Mask) {
        self.tiles.iter_mut().zip(&other.tiles).for_each(|(tile, other)| *tile |= other);
    }

    /// The set with all pixels round those of it, up to `reach` columns and rows away.
    pub fn grown(&self, reach: u32) -> Mask {
        let mut grown = Mask::empty([self.width, self.height]);
        for [x, y] in self.spots() {
            for row in y.saturating_sub(reach)..(y + reach + 1).min(self.height) {
                for column in x.saturating_sub(reach)..(x + reach + 1).min(self.width) {
                    grown.add([column, row]);
                }
            }
        }
        grown
    }

    /// How many pixels it has.
    pub fn count(&self) -> u64 {
        self.tiles.iter().map(|tile| u64::from(tile.count_ones())).sum()
    }

    pub fn is_empty(&self) -> bool {
        self.tiles.iter().all(|tile| *tile == 0)
    }

    /// The tiles that have any of it, by number.
    pub fn tiles(&self) -> impl Iterator<Item = usize> {
        self.tiles.iter().enumerate().filter(|(_, tile)| **tile != 0).map(|(index, _)| index)
    }

    /// All of it, always in the same order.
    pub fn spots(&self) -> impl Iterator<Item = Spot> {
        (0..self.height.div_ceil(TILE)).flat_map(|row| self.spots_of(row))
    }

    /// Those in a row of tiles, block by block.
    pub fn spots_of(&self, row: u32) -> impl Iterator<Item = Spot> {
        let start = (row * self.columns) as usize;
        let tiles = (0..).zip(&self.tiles[start..start + self.columns as usize]);
        tiles.filter(|(_, tile)| **tile != 0).flat_map(move |(column, tile)| {
            let spots = (0..TILE * TILE).map(|index| {
                let (block, within) =
                    (index / (BLOCK[0] * BLOCK[1]), index % (BLOCK[0] * BLOCK[1]));
                let blocks = TILE / BLOCK[0];
                [
                    block % blocks * BLOCK[0] + within % BLOCK[0],
                    block / blocks * BLOCK[1] + within / BLOCK[0],
                ]
            });
            let wanted = spots.filter(move |[x, y]| tile >> (y * TILE + x) & 1 == 1);
            wanted.map(move |[x, y]| [column * TILE + x, row * TILE + y])
        })
    }

    /// A plane's values of these pixels, in their order.
    pub fn values<T: Copy + Send + Sync>(&self, plane: &Plane<T>) -> Vec<T> {
        self.spots().map(|spot| plane.at(spot)).collect()
    }

    /// Gives these pixels of a plane their `values`, in their order.
    pub fn set<T: Copy + Send + Sync>(&self, plane: &mut Plane<T>, values: &[T]) {
        self.spots().zip(values).for_each(|(spot, value)| plane.set(spot, *value));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    const SIZE: [u32; 2] = [13, 21];

    fn all() -> impl Iterator<Item = Spot> {
        (0..SIZE[0]).flat_map(|x| (0..SIZE[1]).map(move |y| [x, y]))
    }

    #[test]
    fn a_set_has_what_was_added() {
        let wanted = |[x, y]: &Spot| (x + 2 * y) % 5 == 0;
        let mut mask = Mask::empty(SIZE);
        assert!(mask.is_empty());
        all().filter(wanted).for_each(|spot| mask.add(spot));
        assert!(!mask.is_empty());
        assert!(all().all(|spot| mask.has(spot) == wanted(&spot)));
        let found: Vec<Spot> = mask.spots().collect();
        assert_eq!(found.len(), all().filter(wanted).count());
        assert_eq!(BTreeSet::from_iter(found), all().filter(wanted).collect());
    }

    #[test]
    fn a_grown_set_has_all_that_is_beside() {
        let mut mask = Mask::empty(SIZE);
        mask.add([0, 0]);
        mask.add([4, 8]);
        let beside = |[x, y]: &Spot| (*x < 2 && *y < 2) || (x.abs_diff(4) < 2 && y.abs_diff(8) < 2);
        assert_eq!(BTreeSet::from_iter(mask.grown(1).spots()), all().filter(beside).collect());
        assert_eq!(mask.grown(1).tiles().collect::<Vec<_>>(), [0, 2]);
    }

    #[test]
    fn what_is_not_retained_is_left_out() {
        let mut mask = Mask::full(SIZE);
        let is_kept = |[x, y]: Spot| x % 3 == 0 || y == 20;
        mask.retain(is_kept);
        assert!(all().all(|spot| mask.has(spot) == is_kept(spot)));
        assert_eq!(mask.count(), all().filter(|spot| is_kept(*spot)).count() as u64);
    }

    #[test]
    fn tiles_end_where_the_picture_does() {
        assert_eq!(BTreeSet::from_iter(Mask::full(SIZE).spots()), all().collect());
        let tile = |tile| {
            let mut mask = Mask::empty(SIZE);
            mask.add_tile(tile);
            mask
        };
        let mut both = tile([1, 0]);
        assert_eq!([both.count(), both.spots().count() as u64], [40, 40]);
        both.add_all(&tile([1, 2]));
        let within = |[x, y]: &Spot| *x >= 8 && (*y < 8 || *y >= 16);
        assert_eq!(BTreeSet::from_iter(both.spots()), all().filter(within).collect());
        assert_eq!(both.count(), 40 + 25);
    }

    #[test]
    fn values_are_told_and_set_in_one_order() {
        let is_marked = |[x, y]: &Spot| x / TILE != y / TILE;
        let mut mask = Mask::empty(SIZE);
        all().filter(is_marked).for_each(|spot| mask.add(spot));
        let mut plane = Plane::new(SIZE[0], SIZE[1], 0);
        all().for_each(|[x, y]| plane.set([x, y], 100 * y + x));
        let values = mask.values(&plane);
        let mut other = Plane::new(SIZE[0], SIZE[1], 0);
        mask.set(&mut other, &values);
        for [x, y] in all() {
            assert_eq!(other.at([x, y]), if is_marked(&[x, y]) { 100 * y + x } else { 0 });
        }
    }
}
