//! Values by pixel, filled by all threads.

use std::ops::Add;

use rayon::prelude::*;

use super::RayCounts;
use super::mask::{Mask, TILE};
use super::ties::Ties;

/// A pixel's column and row.
pub type Spot = [u32; 2];

/// A value for each pixel of a picture, row by row.
#[derive(Clone, Debug)]
pub struct Plane<T> {
    pub width: u32,
    pub height: u32,
    values: Vec<T>,
}

/// How many pixels are asked for at once.
const BATCH: usize = 128;

impl<T: Copy + Send + Sync> Plane<T> {
    /// A plane of one value.
    pub fn new(width: u32, height: u32, value: T) -> Plane<T> {
        Plane { width, height, values: vec![value; width as usize * height as usize] }
    }

    pub fn at(&self, spot: Spot) -> T {
        *self.value(spot)
    }

    pub fn value(&self, [x, y]: Spot) -> &T {
        &self.values[y as usize * self.width as usize + x as usize]
    }

    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The values at a pixel and at those round it, up to `reach` columns and rows away.
    pub fn round(&self, [x, y]: Spot, reach: u32) -> impl Iterator<Item = &T> {
        let columns = x.saturating_sub(reach)..(x + reach + 1).min(self.width);
        let rows = y.saturating_sub(reach)..(y + reach + 1).min(self.height);
        rows.flat_map(move |row| {
            let start = row as usize * self.width as usize;
            self.values[start + columns.start as usize..start + columns.end as usize].iter()
        })
    }

    pub fn set(&mut self, [x, y]: Spot, value: T) {
        self.values[y as usize * self.width as usize + x as usize] = value;
    }

    /// Gives the `wanted` pixels new values: `make` is told some of them, and appends theirs, and where `ties`
    /// are kept what they depend on. Which pixels it is told at once has no meaning.
    pub fn fill(
        &mut self,
        wanted: &Mask,
        ties: Option<&mut Plane<Ties>>,
        make: impl Fn(&[Spot], &mut Vec<T>, Option<&mut Vec<Ties>>) -> RayCounts + Sync,
    ) -> RayCounts {
        let width = self.width as usize;
        if width == 0 {
            return RayCounts::default();
        }
        let band = |index: usize, rows: &mut [T], mut ties: Option<&mut [Ties]>| {
            let spots: Vec<Spot> = wanted.spots_of(index as u32).collect();
            let mut made = Vec::new();
            let mut tied = ties.as_ref().map(|_| Vec::new());
            let mut counts = RayCounts::default();
            let place = |[x, y]: Spot| (y % TILE) as usize * width + x as usize;
            for some in spots.chunks(BATCH) {
                made.clear();
                tied.iter_mut().for_each(Vec::clear);
                counts = counts + make(some, &mut made, tied.as_mut());
                for (spot, value) in some.iter().zip(&made) {
                    rows[place(*spot)] = *value;
                }
                if let (Some(ties), Some(tied)) = (&mut ties, &tied) {
                    for (spot, tied) in some.iter().zip(tied) {
                        ties[place(*spot)] = *tied;
                    }
                }
            }
            counts
        };
        // What is to be done may all be in a few of them: each may go to another thread.
        let rows = TILE as usize * width;
        let bands = self.values.par_chunks_mut(rows).enumerate().with_max_len(1);
        let sum = RayCounts::default;
        match ties {
            None => bands.map(|(index, rows)| band(index, rows, None)).reduce(sum, Add::add),
            Some(ties) => bands
                .zip(ties.values.par_chunks_mut(rows))
                .map(|((index, rows), ties)| band(index, rows, Some(ties)))
                .reduce(sum, Add::add),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_wanted_pixel_is_asked_for_once() {
        let mut plane = Plane::new(13, 21, 0);
        let is_wanted = |[x, y]: Spot| (x + y) % 3 != 0;
        let all = || (0..13).flat_map(|x| (0..21).map(move |y| [x, y]));
        let mut wanted = Mask::empty([13, 21]);
        all().filter(|spot| is_wanted(*spot)).for_each(|spot| wanted.add(spot));
        let counts = plane.fill(&wanted, None, |spots, made, _| {
            made.extend(spots.iter().map(|[x, y]| 100 * y + x + 1));
            RayCounts { primary: spots.len() as u64, ..RayCounts::default() }
        });
        let mut count = 0;
        for [x, y] in all() {
            let expected = if is_wanted([x, y]) { 100 * y + x + 1 } else { 0 };
            assert_eq!(plane.at([x, y]), expected, "{x}, {y}");
            count += u64::from(expected > 0);
        }
        assert_eq!(counts.primary, count);
        assert_eq!(plane.round([0, 0], 1).count(), 4);
        assert_eq!(plane.round([5, 20], 1).count(), 6);
        assert_eq!(plane.round([11, 7], 2).count(), 20);
    }
}
