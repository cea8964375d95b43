//! Values by pixel, filled by all threads.

use std::ops::Add;

use rayon::prelude::*;

use super::RayCounts;
use super::regions::Regions;

/// A pixel's column and row.
pub type Spot = [u32; 2];

/// A value for each pixel of a picture, row by row.
#[derive(Clone, Debug)]
pub struct Plane<T> {
    pub width: u32,
    pub height: u32,
    values: Vec<T>,
}

/// Rows that a thread has in hand at a time.
const ROWS: usize = 8;

/// Pixels in blocks of this size make packets of rays that keep together.
const BLOCK: [usize; 2] = [4, 2];

/// How many pixels are asked for at once.
const BATCH: usize = 128;

impl<T: Copy + Send + Sync> Plane<T> {
    /// A plane of one value.
    pub fn new(width: u32, height: u32, value: T) -> Plane<T> {
        Plane { width, height, values: vec![value; width as usize * height as usize] }
    }

    pub fn at(&self, [x, y]: Spot) -> T {
        self.values[y as usize * self.width as usize + x as usize]
    }

    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The values at a pixel and the up to eight round it.
    pub fn round(&self, [x, y]: Spot) -> impl Iterator<Item = T> {
        let columns = x.max(1) - 1..(x + 2).min(self.width);
        let rows = y.max(1) - 1..(y + 2).min(self.height);
        rows.flat_map(move |row| columns.clone().map(move |column| self.at([column, row])))
    }

    /// Another plane, of what `make` gives for each pixel's value.
    pub fn map<R: Copy + Default + Send + Sync>(
        &self,
        make: impl Fn(Spot, &T) -> R + Sync,
    ) -> Plane<R> {
        let mut made = Plane::new(self.width, self.height, R::default());
        let width = self.width.max(1) as usize;
        let rows = made.values.par_chunks_mut(width).zip(self.values.par_chunks(width));
        rows.enumerate().with_min_len(ROWS).for_each(|(y, (made, values))| {
            for (x, (made, value)) in made.iter_mut().zip(values).enumerate() {
                *made = make([x as u32, y as u32], value);
            }
        });
        made
    }

    /// Gives some pixels one value.
    pub fn set(&mut self, wanted: impl Fn(Spot) -> bool + Sync, value: T) {
        let width = self.width.max(1) as usize;
        let rows = self.values.par_chunks_mut(width).enumerate().with_min_len(ROWS);
        rows.for_each(|(y, row)| {
            for (x, stored) in row.iter_mut().enumerate() {
                if wanted([x as u32, y as u32]) {
                    *stored = value;
                }
            }
        });
    }

    /// The values of some pixels, to be restored later.
    pub fn saved(&self, wanted: impl Fn(Spot) -> bool) -> Vec<(usize, T)> {
        let width = self.width.max(1) as usize;
        let mut saved = Vec::new();
        for (y, row) in self.values.chunks(width).enumerate() {
            for (x, value) in row.iter().enumerate() {
                if wanted([x as u32, y as u32]) {
                    saved.push((y * width + x, *value));
                }
            }
        }
        saved
    }

    pub fn restore(&mut self, saved: Vec<(usize, T)>) {
        for (index, value) in saved {
            self.values[index] = value;
        }
    }

    /// Gives the `wanted` pixels new values: `make` is told some of them, and appends theirs, and where `regions`
    /// are kept those that they depend on. Which pixels it is told at once has no meaning.
    pub fn fill(
        &mut self,
        wanted: impl Fn(Spot) -> bool + Sync,
        regions: Option<&mut Plane<Regions>>,
        make: impl Fn(&[Spot], &mut Vec<T>, Option<&mut Vec<Regions>>) -> RayCounts + Sync,
    ) -> RayCounts {
        let width = self.width as usize;
        if width == 0 {
            return RayCounts::default();
        }
        let band = |index: usize, rows: &mut [T], mut regions: Option<&mut [Regions]>| {
            let top = index * ROWS;
            let spots = spots(width, top, rows.len() / width, &wanted);
            let mut made = Vec::with_capacity(BATCH);
            let mut touched = regions.as_ref().map(|_| Vec::with_capacity(BATCH));
            let mut counts = RayCounts::default();
            let place = |[x, y]: Spot| (y as usize - top) * width + x as usize;
            for some in spots.chunks(BATCH) {
                made.clear();
                touched.iter_mut().for_each(Vec::clear);
                counts = counts + make(some, &mut made, touched.as_mut());
                for (spot, value) in some.iter().zip(&made) {
                    rows[place(*spot)] = *value;
                }
                if let (Some(regions), Some(touched)) = (&mut regions, &touched) {
                    for (spot, touched) in some.iter().zip(touched) {
                        regions[place(*spot)] = *touched;
                    }
                }
            }
            counts
        };
        // What is to be done may all be in a few of them: each may go to another thread.
        let bands = self.values.par_chunks_mut(ROWS * width).enumerate().with_max_len(1);
        let sum = RayCounts::default;
        match regions {
            None => bands.map(|(index, rows)| band(index, rows, None)).reduce(sum, Add::add),
            Some(regions) => bands
                .zip(regions.values.par_chunks_mut(ROWS * width))
                .map(|((index, rows), regions)| band(index, rows, Some(regions)))
                .reduce(sum, Add::add),
        }
    }
}

/// The wanted pixels of some rows, block by block.
fn spots(width: usize, top: usize, rows: usize, wanted: impl Fn(Spot) -> bool) -> Vec<Spot> {
    let mut spots = Vec::new();
    for y in (0..rows).step_by(BLOCK[1]) {
        for x in (0..width).step_by(BLOCK[0]) {
            for row in y..(y + BLOCK[1]).min(rows) {
                for column in x..(x + BLOCK[0]).min(width) {
                    let spot = [column as u32, (top + row) as u32];
                    if wanted(spot) {
                        spots.push(spot);
                    }
                }
            }
        }
    }
    spots
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_wanted_pixel_is_asked_for_once() {
        let mut plane = Plane::new(13, 21, 0);
        let wanted = |[x, y]: Spot| (x + y) % 3 != 0;
        let counts = plane.fill(wanted, None, |spots, made, _| {
            made.extend(spots.iter().map(|[x, y]| 100 * y + x + 1));
            RayCounts { primary: spots.len() as u64, ..RayCounts::default() }
        });
        let mut count = 0;
        for (x, y) in (0..13).flat_map(|x| (0..21).map(move |y| (x, y))) {
            let expected = if wanted([x, y]) { 100 * y + x + 1 } else { 0 };
            assert_eq!(plane.at([x, y]), expected, "{x}, {y}");
            count += u64::from(expected > 0);
        }
        assert_eq!(counts.primary, count);
        assert_eq!(plane.round([0, 0]).count(), 4);
        assert_eq!(plane.round([5, 20]).count(), 6);
    }
}
