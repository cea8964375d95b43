//! Values by pixel, filled by all threads.

use rayon::prelude::*;

use super::RayCounts;

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

    /// Gives the `wanted` pixels new values: `make` is told some of them, and appends theirs. Which of them it is
    /// told at once has no meaning.
    pub fn fill(
        &mut self,
        wanted: impl Fn(Spot) -> bool + Sync,
        make: impl Fn(&[Spot], &mut Vec<T>) -> RayCounts + Sync,
    ) -> RayCounts {
        let width = self.width as usize;
        let band = |(index, rows): (usize, &mut [T])| {
            let top = index * ROWS;
            let spots = spots(width, top, rows.len() / width, &wanted);
            let mut made = Vec::with_capacity(BATCH);
            let mut counts = RayCounts::default();
            for some in spots.chunks(BATCH) {
                made.clear();
                counts = counts + make(some, &mut made);
                for ([x, y], value) in some.iter().zip(&made) {
                    rows[(*y as usize - top) * width + *x as usize] = *value;
                }
            }
            counts
        };
        let bands = self.values.par_chunks_mut(ROWS * width).enumerate();
        bands.map(band).reduce(RayCounts::default, std::ops::Add::add)
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
        let counts = plane.fill(wanted, |spots, made| {
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
