//! A picture that is being painted, row by row.

use std::ops::Range;

use image::{DynamicImage, RgbImage, RgbaImage};
use rayon::prelude::*;

use super::RayCounts;
use crate::scene::Rgb;

/// What a pixel, or a part of it, shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// As it is stored, 0 to 1, times `cover`.
    pub color: Rgb,
    /// How much of it is not transparent, 0 to 1.
    pub cover: f64,
}

/// How many rows a thread has in hand at a time in two passes.
const ROWS: usize = 32;

/// Bytes for a picture with or without an alpha channel.
pub struct Canvas {
    width: u32,
    height: u32,
    is_transparent: bool,
    bytes: Vec<u8>,
}

impl Canvas {
    pub fn new(width: u32, height: u32, is_transparent: bool) -> Canvas {
        let channels = if is_transparent { 4 } else { 3 };
        let bytes = vec![0; channels * width as usize * height as usize];
        Canvas { width, height, is_transparent, bytes }
    }

    /// Gives the pixels of some rows what `pixel(x, y, counts)` shows, on all threads of the pool.
    pub fn paint(
        &mut self,
        rows: Range<usize>,
        pixel: impl Fn(usize, usize, &mut RayCounts) -> Pixel + Sync,
    ) -> RayCounts {
        let channels = if self.is_transparent { 4 } else { 3 };
        let row_bytes = channels * self.width as usize;
        self.bytes[rows.start * row_bytes..rows.end * row_bytes]
            .par_chunks_mut(row_bytes)
            .enumerate()
            .map(|(index, row)| {
                let mut counts = RayCounts::default();
                for (x, stored) in row.chunks_exact_mut(channels).enumerate() {
                    let bytes = pixel(x, rows.start + index, &mut counts).bytes();
                    stored.copy_from_slice(&bytes[..channels]);
                }
                counts
            })
            .reduce(RayCounts::default, std::ops::Add::add)
    }

    /// Paints the whole picture in two passes, band by band so that memory is bounded: first
    /// `look(x, y, counts)` at each pixel, then what `pixel(x, y, looks, counts)` shows, which sees what
    /// was found there and in the eight pixels round it.
    pub fn paint_twice<T: Send + Sync>(
        &mut self,
        look: impl Fn(usize, usize, &mut RayCounts) -> T + Sync,
        pixel: impl Fn(usize, usize, &Looks<T>, &mut RayCounts) -> Pixel + Sync,
    ) -> RayCounts {
        let (width, height) = (self.width as usize, self.height as usize);
        let row = |y: usize| {
            let mut counts = RayCounts::default();
            let found = (0..width).map(|x| look(x, y, &mut counts)).collect();
            (found, counts)
        };
        let mut counts = RayCounts::default();
        let mut looks = Looks { first: 0, rows: Vec::new(), height };
        let band = ROWS * rayon::current_num_threads();
        for start in (0..height).step_by(band) {
            let end = (start + band).min(height);
            // At least the rows beside the band in hand.
            looks.rows.drain(..start.saturating_sub(1) - looks.first);
            looks.first = start.saturating_sub(1);
            let wanted = looks.first + looks.rows.len()..(end + 1).min(height);
            let (more, rays): (Vec<_>, Vec<_>) = wanted.into_par_iter().map(row).unzip();
            looks.rows.extend(more);
            let painted = self.paint(start..end, |x, y, counts| pixel(x, y, &looks, counts));
            counts = rays.into_iter().fold(counts + painted, std::ops::Add::add);
        }
        counts
    }

    /// The picture, with an alpha channel that is not multiplied into its colours.
    pub fn into_picture(self) -> DynamicImage {
        let Canvas { width, height, is_transparent, bytes } = self;
        let picture = if is_transparent {
            RgbaImage::from_raw(width, height, bytes).map(DynamicImage::ImageRgba8)
        } else {
            RgbImage::from_raw(width, height, bytes).map(DynamicImage::ImageRgb8)
        };
        picture.unwrap_or_default()
    }
}

/// What a first pass found, in the rows from `first` on.
pub struct Looks<T> {
    first: usize,
    rows: Vec<Vec<T>>,
    height: usize,
}

impl<T> Looks<T> {
    /// What was found at a pixel.
    pub fn at(&self, x: usize, y: usize) -> &T {
        &self.rows[y - self.first][x]
    }

    /// What was found there and in the eight pixels round it.
    pub fn round(&self, x: usize, y: usize) -> impl Iterator<Item = &T> {
        (y.max(1) - 1..(y + 2).min(self.height)).flat_map(move |row| {
            let row = &self.rows[row - self.first];
            &row[x.max(1) - 1..(x + 2).min(row.len())]
        })
    }
}

impl Pixel {
    /// Red, green, blue and alpha; the colour of what is hardly there is that of what is there.
    fn bytes(self) -> [u8; 4] {
        let color = if self.cover > 0.0 { self.color / self.cover } else { Rgb::ZERO };
        let [red, green, blue] = color.to_array().map(byte);
        [red, green, blue, byte(self.cover)]
    }
}

fn byte(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

impl std::ops::Add for Pixel {
    type Output = Pixel;

    fn add(self, other: Pixel) -> Pixel {
        Pixel { color: self.color + other.color, cover: self.cover + other.cover }
    }
}

impl std::ops::Div<f64> for Pixel {
    type Output = Pixel;

    fn div(self, by: f64) -> Pixel {
        Pixel { color: self.color / by, cover: self.cover / by }
    }
}
