//! Pictures that lie on bodies.

use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3};
use image::{ImageReader, RgbImage};

use crate::config::{Filter, MAX_SIDE};

/// A picture, with copies of it at halved sizes down to a single texel where they are wanted.
#[derive(Debug)]
pub struct Bitmap {
    levels: Vec<RgbImage>,
}

/// A bitmap is the same as itself alone: nobody compares texels.
impl PartialEq for Bitmap {
    fn eq(&self, other: &Bitmap) -> bool {
        std::ptr::eq(self, other)
    }
}

/// What is beyond a picture's upper and lower edges. (Beyond its sides it always repeats.)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// The picture again.
    Repeats,
    /// Its outermost row: the edges are the poles of a sphere.
    Stays,
}

/// A picture that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum BitmapError {
    #[error("{}: cannot be read as a picture, expected BMP or PNG", path.display())]
    Unreadable {
        path: PathBuf,
        #[source]
        error: image::ImageError,
    },
    #[error("{}: is {width} x {height} pixels, expected at most {MAX_SIDE} a side", path.display())]
    TooLarge { path: PathBuf, width: u32, height: u32 },
}

impl Bitmap {
    /// Takes a picture of at least one pixel, to be read with `filter`.
    pub fn new(picture: RgbImage, filter: Filter) -> Bitmap {
        let mut levels = vec![picture];
        while filter == Filter::Mip
            && let Some(level) = levels.last().filter(|level| level.width().max(level.height()) > 1)
        {
            let halved = halved(level);
            levels.push(halved);
        }
        Bitmap { levels }
    }

    /// Reads a BMP or PNG file; what is transparent in it counts as opaque.
    ///
    /// # Errors
    /// When there is no such file, it holds no such picture, or a very large one.
    pub fn open(path: &Path, filter: Filter) -> Result<Bitmap, BitmapError> {
        let failed = |error| BitmapError::Unreadable { path: path.to_owned(), error };
        let reader = || {
            ImageReader::open(path)
                .and_then(ImageReader::with_guessed_format)
                .map_err(|error| failed(error.into()))
        };
        let (width, height) = reader()?.into_dimensions().map_err(failed)?;
        if width.max(height) > MAX_SIDE {
            return Err(BitmapError::TooLarge { path: path.to_owned(), width, height });
        }
        Ok(Bitmap::new(reader()?.decode().map_err(failed)?.to_rgb8(), filter))
    }

    /// Width and height in texels.
    pub fn size(&self) -> DVec2 {
        size(&self.levels[0])
    }

    /// The picture itself.
    pub fn picture(&self) -> &RgbImage {
        &self.levels[0]
    }

    /// The colour at `place`: (0, 0) is the bottom left corner, (1, 1) the top right one. `texels`
    /// is the width that is seen there at once, in texels.
    pub fn color(&self, place: DVec2, filter: Filter, beyond: Beyond, texels: f64) -> DVec3 {
        let between = |level: usize| between(&self.levels[level], place, beyond);
        match filter {
            Filter::Nearest => {
                let at = scaled(&self.levels[0], place, beyond).floor();
                texel(&self.levels[0], at.x, at.y, beyond)
            }
            Filter::Bilinear => between(0),
            Filter::Mip => {
                let highest = (self.levels.len() - 1) as f64;
                let level = libm::log2(texels.max(1.0)).min(highest);
                let (below, share) = (level.floor(), level - level.floor());
                let fine = between(below as usize);
                if share > 0.0 { fine.lerp(between(level.ceil() as usize), share) } else { fine }
            }
        }
    }
}

fn size(level: &RgbImage) -> DVec2 {
    DVec2::new(f64::from(level.width()), f64::from(level.height()))
}

/// `place` in texels from the lower left corner.
fn scaled(level: &RgbImage, place: DVec2, beyond: Beyond) -> DVec2 {
    let height = match beyond {
        Beyond::Repeats => place.y - place.y.floor(),
        Beyond::Stays => place.y.clamp(0.0, 1.0),
    };
    DVec2::new(place.x - place.x.floor(), height) * size(level)
}

/// The texel in a column from the left and a row from below.
fn texel(level: &RgbImage, column: f64, row: f64, beyond: Beyond) -> DVec3 {
    let (width, height) = level.dimensions();
    let wrapped = |index: f64, count: u32| index.rem_euclid(f64::from(count)) as u32 % count;
    let row = match beyond {
        Beyond::Repeats => wrapped(row, height),
        Beyond::Stays => row.clamp(0.0, f64::from(height - 1)) as u32,
    };
    let bytes = level.get_pixel(wrapped(column, width), height - 1 - row).0;
    DVec3::from(bytes.map(f64::from)) / 255.0
}

/// A mean of the four texels whose middles are nearest.
fn between(level: &RgbImage, place: DVec2, beyond: Beyond) -> DVec3 {
    let at = scaled(level, place, beyond) - 0.5;
    let (cell, share) = (at.floor(), at - at.floor());
    let row = |y: f64| {
        let texel = |x: f64| texel(level, cell.x + x, cell.y + y, beyond);
        texel(0.0).lerp(texel(1.0), share.x)
    };
    row(0.0).lerp(row(1.0), share.y)
}

/// A copy of half the size; each texel is the mean of what it covers.
fn halved(level: &RgbImage) -> RgbImage {
    let (width, height) = ((level.width() / 2).max(1), (level.height() / 2).max(1));
    RgbImage::from_fn(width, height, |column, row| {
        let mut sum = DVec3::ZERO;
        let mut area = 0.0;
        for (y, tall) in covered(row, height, level.height()) {
            for (x, wide) in covered(column, width, level.width()) {
                sum += DVec3::from(level.get_pixel(x, y).0.map(f64::from)) * (wide * tall);
                area += wide * tall;
            }
        }
        image::Rgb((sum / area).to_array().map(|channel| (channel + 0.5) as u8))
    })
}

/// Which of `from` texels in a row the one at `index` of `to` covers, and how much of each.
fn covered(index: u32, to: u32, from: u32) -> impl Iterator<Item = (u32, f64)> {
    let scale = f64::from(from) / f64::from(to);
    let (start, end) = (f64::from(index) * scale, f64::from(index + 1) * scale);
    (start as u32..(end.ceil() as u32).min(from)).map(move |texel| {
        let low = start.max(f64::from(texel));
        let high = end.min(f64::from(texel + 1));
        (texel, high - low)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3 × 2 texels, red growing to the right, green from top to bottom.
    fn ramp() -> Bitmap {
        let picture = RgbImage::from_fn(3, 2, |x, y| image::Rgb([x as u8 * 100, y as u8 * 200, 0]));
        Bitmap::new(picture, Filter::Mip)
    }

    fn bytes(color: DVec3) -> [u8; 3] {
        color.to_array().map(|channel| (channel * 255.0 + 0.5) as u8)
    }

    #[test]
    fn texels_stand_where_they_are_seen_and_repeat() {
        let bitmap = ramp();
        for turns in [-2.0, 0.0, 3.0] {
            for (s, t, color) in [
                (0.1, 0.9, [0, 0, 0]),
                (0.9, 0.9, [200, 0, 0]),
                (0.5, 0.1, [100, 200, 0]),
                (0.0, 0.0, [0, 200, 0]),
            ] {
                let place = DVec2::new(s + turns, t - turns);
                let found = bitmap.color(place, Filter::Nearest, Beyond::Repeats, 1.0);
                assert_eq!(bytes(found), color, "{place}");
            }
        }
    }

    #[test]
    fn at_a_pole_there_is_nothing_of_the_other_one() {
        let at = |height: f64, beyond| {
            bytes(ramp().color(DVec2::new(0.5, height), Filter::Bilinear, beyond, 1.0))[1]
        };
        assert_eq!([at(0.0, Beyond::Stays), at(1.0, Beyond::Stays)], [200, 0]);
        assert_eq!([at(0.0, Beyond::Repeats), at(1.0, Beyond::Repeats)], [100, 100]);
    }

    #[test]
    fn filters_agree_in_the_middle_of_texels() {
        let bitmap = ramp();
        for (s, t) in [(0.5 / 3.0, 0.25), (1.5 / 3.0, 0.75), (2.5 / 3.0, 0.25)] {
            let [nearest, bilinear, mip] = [Filter::Nearest, Filter::Bilinear, Filter::Mip]
                .map(|filter| bitmap.color(DVec2::new(s, t), filter, Beyond::Repeats, 1.0));
            assert_eq!(bytes(nearest), bytes(bilinear));
            assert_eq!(bytes(nearest), bytes(mip));
        }
        let half_way = DVec2::new(1.0 / 3.0, 0.75);
        let found = bitmap.color(half_way, Filter::Bilinear, Beyond::Repeats, 1.0);
        assert_eq!(bytes(found), [50, 0, 0]);
    }

    #[test]
    fn the_wider_the_view_the_nearer_to_the_mean() {
        // Stripes of a texel each.
        let stripes = RgbImage::from_fn(64, 64, |x, _| image::Rgb([(x % 2) as u8 * 200; 3]));
        let bitmap = Bitmap::new(stripes, Filter::Mip);
        let seen = |texels| {
            bytes(bitmap.color(DVec2::new(1.5 / 64.0, 0.5), Filter::Mip, Beyond::Repeats, texels))
        };
        assert_eq!([1.0, 2.0, 1e9].map(seen), [[200; 3], [100; 3], [100; 3]]);
        // Half-way between the two levels.
        assert_eq!(seen(2.0_f64.sqrt()), [150; 3]);
    }
}
