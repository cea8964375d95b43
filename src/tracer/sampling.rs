//! Phong's pictures: one ray a pixel, a grid, or a grid where neighbours differ.

use image::DynamicImage;

use super::canvas::{Canvas, Pixel};
use super::phong::{Phong, Sample};
use super::{Antialiasing, RayCounts, antialiasing};
use crate::scene::{Rgb, Scene};

/// Traces `scene` as [`super::render`] does, by Phong's sum.
pub fn render(
    scene: &Scene,
    width: u32,
    height: u32,
    mode: Antialiasing,
) -> (DynamicImage, RayCounts) {
    let easel = Easel { tracer: Phong::new(scene), scene, width, height };
    let mut picture = Canvas::new(width, height, scene.background.is_none());
    let counts = match mode {
        Antialiasing::None => easel.grid(&mut picture, 1),
        Antialiasing::Grid(side) => easel.grid(&mut picture, side),
        Antialiasing::Adaptive { rays, threshold } => easel.adaptive(&mut picture, rays, threshold),
    };
    (picture.into_picture(), counts)
}

/// A scene and the size that it is painted at.
struct Easel<'a> {
    tracer: Phong<'a>,
    scene: &'a Scene,
    width: u32,
    height: u32,
}

impl Easel<'_> {
    fn grid(&self, picture: &mut Canvas, side: u32) -> RayCounts {
        picture.paint(0..self.height as usize, |x, y, counts| self.mean(x, y, side, counts))
    }

    fn adaptive(&self, picture: &mut Canvas, side: u32, threshold: f32) -> RayCounts {
        let look = |x: usize, y: usize, counts: &mut RayCounts| {
            self.sample(x as f64 + 0.5, y as f64 + 0.5, 1, counts)
        };
        picture.paint_twice(look, |x, y, looks, counts| {
            let here = looks.at(x, y);
            let differs =
                looks.round(x, y).any(|there| there.footprint.differs(&here.footprint, threshold));
            if differs { self.mean(x, y, side, counts) } else { self.pixel(here) }
        })
    }

    fn mean(&self, x: usize, y: usize, side: u32, counts: &mut RayCounts) -> Pixel {
        antialiasing::mean(side, |dx, dy| {
            let sample = self.sample(x as f64 + dx, y as f64 + dy, side, counts);
            self.pixel(&sample)
        })
    }

    fn pixel(&self, sample: &Sample) -> Pixel {
        if self.scene.background.is_none() && !sample.hits {
            return Pixel::default();
        }
        // What is too bright is as bright as can be, also beside what is not.
        Pixel { color: sample.color.min(Rgb::ONE), cover: 1.0 }
    }

    /// The ray through a place of the picture, one of `side` across its pixel.
    fn sample(&self, x: f64, y: f64, side: u32, counts: &mut RayCounts) -> Sample {
        let ray = self.scene.camera.ray(x, y, self.width, self.height);
        let spread = self.scene.camera.spread(self.width * side);
        self.tracer.trace(ray, spread, counts)
    }
}
