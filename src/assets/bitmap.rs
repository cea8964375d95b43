//! Pictures that lie on bodies.

use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3, Vec3};
use image::{ImageReader, RgbImage};

use crate::config::Filter;

/// A picture with its copies at halved sizes, down to a single texel.
#[derive(Debug)]
pub struct Bitmap {
    levels: Vec<Level>,
}

#[derive(Debug)]
struct Level {
    width: usize,
    height: usize,
    /// Row by row from the top, each channel 0 to 1.
    texels: Vec<Vec3>,
}

/// A picture that cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be read as a picture, expected BMP or PNG", path.display())]
pub struct BitmapError {
    path: PathBuf,
    #[source]
    error: image::ImageError,
}

impl Bitmap {
    /// Takes a picture of at least one pixel.
    pub fn new(picture: &RgbImage) -> Bitmap {
        let texels =
            picture.pixels().map(|pixel| Vec3::from(pixel.0.map(f32::from)) / 255.0).collect();
        let (width, height) = (picture.width() as usize, picture.height() as usize);
        let mut levels = vec![Level { width, height, texels }];
        while let Some(level) = levels.last().filter(|level| level.width.max(level.height) > 1) {
            let halved = level.halved();
            levels.push(halved);
        }
        Bitmap { levels }
    }

    /// Reads a BMP or PNG file; what is transparent in it counts as opaque.
    ///
    /// # Errors
    /// When there is no such file, or it holds no such picture.
    pub fn open(path: &Path) -> Result<Bitmap, BitmapError> {
        let failed = |error| BitmapError { path: path.to_owned(), error };
        let reader = ImageReader::open(path)
            .and_then(ImageReader::with_guessed_format)
            .map_err(|error| failed(error.into()))?;
        Ok(Bitmap::new(&reader.decode().map_err(failed)?.to_rgb8()))
    }

    /// Width and height in texels.
    pub fn size(&self) -> DVec2 {
        DVec2::new(self.levels[0].width as f64, self.levels[0].height as f64)
    }

    /// The picture itself.
    pub fn picture(&self) -> RgbImage {
        let Level { width, height, texels } = &self.levels[0];
        let texel = |x: u32, y: u32| texels[y as usize * width + x as usize];
        let byte = |channel: f32| (channel * 255.0 + 0.5) as u8;
        RgbImage::from_fn(*width as u32, *height as u32, |x, y| {
            image::Rgb(texel(x, y).to_array().map(byte))
        })
    }

    /// The colour at `place`: (0, 0) is the bottom left corner, (1, 1) the top right one, and it
    /// repeats beyond. `texels` is the width that is seen there at once, in texels.
    pub fn color(&self, place: DVec2, filter: Filter, texels: f64) -> DVec3 {
        let place = DVec2::new(place.x, 1.0 - place.y);
        match filter {
            Filter::Nearest => self.levels[0].nearest(place),
            Filter::Bilinear => self.levels[0].between(place),
            Filter::Mip => {
                let highest = (self.levels.len() - 1) as f64;
                let level = libm::log2(texels.max(1.0)).min(highest);
                let (below, share) = (level.floor(), level - level.floor());
                let fine = self.levels[below as usize].between(place);
                let coarse = &self.levels[level.ceil() as usize];
                if share > 0.0 { fine.lerp(coarse.between(place), share) } else { fine }
            }
        }
    }
}

impl Level {
    fn texel(&self, column: f64, row: f64) -> DVec3 {
        let wrapped = |index: f64, count: usize| index.rem_euclid(count as f64) as usize % count;
        let (column, row) = (wrapped(column, self.width), wrapped(row, self.height));
        self.texels[row * self.width + column].as_dvec3()
    }

    fn scaled(&self, place: DVec2) -> DVec2 {
        (place - place.floor()) * DVec2::new(self.width as f64, self.height as f64)
    }

    fn nearest(&self, place: DVec2) -> DVec3 {
        let at = self.scaled(place).floor();
        self.texel(at.x, at.y)
    }

    /// A mean of the four texels whose middles are nearest.
    fn between(&self, place: DVec2) -> DVec3 {
        let at = self.scaled(place) - 0.5;
        let (cell, share) = (at.floor(), at - at.floor());
        let row = |y: f64| {
            self.texel(cell.x, cell.y + y).lerp(self.texel(cell.x + 1.0, cell.y + y), share.x)
        };
        row(0.0).lerp(row(1.0), share.y)
    }

    /// A copy of half the size; each texel is the mean of what it covers.
    fn halved(&self) -> Level {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let mut texels = Vec::with_capacity(width * height);
        for row in 0..height {
            for column in 0..width {
                let mut sum = Vec3::ZERO;
                let mut area = 0.0;
                for (y, tall) in covered(row, height, self.height) {
                    for (x, wide) in covered(column, width, self.width) {
                        sum += self.texels[y * self.width + x] * (wide * tall);
                        area += wide * tall;
                    }
                }
                texels.push(sum / area);
            }
        }
        Level { width, height, texels }
    }
}

/// Which of `from` texels in a row the one at `index` of `to` covers, and how much of each.
fn covered(index: usize, to: usize, from: usize) -> impl Iterator<Item = (usize, f32)> {
    let scale = from as f64 / to as f64;
    let (start, end) = (index as f64 * scale, (index + 1) as f64 * scale);
    (start as usize..(end.ceil() as usize).min(from)).map(move |texel| {
        let low = start.max(texel as f64);
        let high = end.min((texel + 1) as f64);
        (texel, (high - low) as f32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3 × 2 texels, red growing to the right, green from top to bottom.
    fn ramp() -> Bitmap {
        Bitmap::new(&RgbImage::from_fn(3, 2, |x, y| image::Rgb([x as u8 * 100, y as u8 * 200, 0])))
    }

    #[test]
    fn texels_stand_where_they_are_seen_and_repeat() {
        let bitmap = ramp();
        for turns in [-2.0, 0.0, 3.0] {
            for (s, t, color) in [(0.1, 0.9, [0, 0]), (0.9, 0.9, [200, 0]), (0.5, 0.1, [100, 200])]
            {
                let place = DVec2::new(s + turns, t - turns);
                let found = bitmap.color(place, Filter::Nearest, 1.0) * 255.0;
                assert!((found.x - f64::from(color[0])).abs() < 0.01, "{place} gave {found}");
                assert!((found.y - f64::from(color[1])).abs() < 0.01, "{place} gave {found}");
            }
        }
    }

    #[test]
    fn filters_agree_in_the_middle_of_texels() {
        let bitmap = ramp();
        for (s, t) in [(0.5 / 3.0, 0.25), (1.5 / 3.0, 0.75), (2.5 / 3.0, 0.25)] {
            let colors = [Filter::Nearest, Filter::Bilinear, Filter::Mip]
                .map(|filter| bitmap.color(DVec2::new(s, t), filter, 1.0));
            assert!(colors[0].distance(colors[1]) < 1e-9 && colors[0].distance(colors[2]) < 1e-9);
        }
        let half_way = bitmap.color(DVec2::new(1.0 / 3.0, 0.75), Filter::Bilinear, 1.0) * 255.0;
        assert!((half_way.x - 50.0).abs() < 1e-3);
    }

    #[test]
    fn the_last_level_is_the_mean_of_all() {
        let mean = ramp().color(DVec2::new(0.3, 0.7), Filter::Mip, 1e9) * 255.0;
        assert!((mean - DVec3::new(100.0, 100.0, 0.0)).length() < 1e-3, "{mean}");
    }

    #[test]
    fn the_picture_comes_back_as_it_was_given() {
        let picture =
            RgbImage::from_fn(5, 7, |x, y| image::Rgb([(x * 50) as u8, (y * 30) as u8, 7]));
        assert_eq!(Bitmap::new(&picture).picture(), picture);
    }
}
