//! The studio's pictures: many samples a pixel, and more where they disagree.

use image::DynamicImage;

use super::canvas::{Canvas, Pixel};
use super::sequence::Sequence;
use super::studio::{Glimpse, Studio};
use super::{Antialiasing, RayCounts, tone};
use crate::scene::{Rgb, Room, Scene, linear_light};

/// Where in the pixel a sample goes through.
const PLACE: u32 = 0;

/// Where in the lens it does.
const LENS: u32 = 1;

/// No fewer samples are believed.
const FEWEST: u32 = 4;

/// Samples that differ by no more than this part of the error that is small enough are the same.
const SAME: f64 = 0.15;

/// Pixels side by side whose brightness differs by more are looked at again: a hairline may have been
/// missed in one of them.
const CONTRAST: f64 = 0.08;

/// One bright sample among dark ones counts no more than this: fine highlights do not flicker.
const BRIGHTEST: f64 = 2.0;

/// Traces `scene` as [`super::render`] does, in the light of `room`. Of a grid the number of rays
/// alone counts; adaptive, a pixel begins with a quarter of them (and stops before where the first
/// are all the same), and goes on while the error of its mean seems greater than the threshold.
pub fn render(
    scene: &Scene,
    room: &Room,
    width: u32,
    height: u32,
    mode: Antialiasing,
) -> (DynamicImage, RayCounts) {
    let (first, most, error) = match mode {
        Antialiasing::None => (1, 1, -1.0),
        Antialiasing::Grid(side) => (side * side, side * side, -1.0),
        Antialiasing::Adaptive { rays, threshold } => {
            // Samples are most even in powers of two.
            let quarter = (rays * rays / 4).max(1);
            (1 << quarter.ilog2(), rays * rays, f64::from(threshold))
        }
    };
    let few = if scene.camera.has_lens() { first } else { first / 4 };
    let exposure = Exposure {
        few: few.max(FEWEST).min(most),
        studio: Studio::new(scene, room),
        scene,
        size: [width, height],
        first,
        most,
        error,
        behind: scene.background.map(|color| shown(linear_light(color))),
    };
    let mut picture = Canvas::new(width, height, scene.background.is_none());
    let counts = exposure.take(&mut picture);
    (picture.into_picture(), counts)
}

struct Exposure<'a> {
    studio: Studio<'a>,
    scene: &'a Scene,
    size: [u32; 2],
    /// Samples of a pixel to begin with, of one that is not as simple as it seems, and at most.
    few: u32,
    first: u32,
    most: u32,
    /// The error of a pixel's mean that is small enough, of what can be shown; negative where none is.
    error: f64,
    /// How bright the background looks, if there is one.
    behind: Option<f64>,
}

/// The samples of a pixel so far.
#[derive(Clone, Copy, Default)]
struct Sum {
    count: u32,
    light: Rgb,
    cover: f64,
    /// Of how bright samples look, and of its square.
    shown: f64,
    squares: f64,
    /// Of the square of what they cover.
    covers: f64,
}

/// How bright light looks, 0 to 1: a square root is near enough.
fn shown(light: Rgb) -> f64 {
    light.dot(Rgb::splat(1.0 / 3.0)).clamp(0.0, 1.0).sqrt()
}

impl Exposure<'_> {
    /// Paints the picture: first a few samples of each pixel, then more of those that need them.
    fn take(&self, picture: &mut Canvas) -> RayCounts {
        let look = |x: usize, y: usize, counts: &mut RayCounts| {
            let mut sum = Sum::default();
            self.add(&mut sum, self.few, x as u32, y as u32, counts);
            sum
        };
        picture.paint_twice(look, |x, y, looks, counts| {
            let mut sum = *looks.at(x, y);
            let shown = sum.shown();
            let differs = looks.round(x, y).any(|there| (there.shown() - shown).abs() > CONTRAST);
            self.refine(&mut sum, x as u32, y as u32, differs, counts);
            self.developed(&sum)
        })
    }

    /// Adds samples until their error is small enough. If the first few are all the same, and about
    /// those of the pixels beside, they are believed.
    fn refine(&self, sum: &mut Sum, x: u32, y: u32, differs: bool, counts: &mut RayCounts) {
        while sum.count < self.most {
            let small_enough = match (sum.count < self.first, self.scene.camera.has_lens()) {
                (true, _) if differs => -1.0,
                (true, _) => SAME * self.error,
                // What a lens blurs is made of few bright samples among many.
                (false, true) => self.error / 2.0,
                (false, false) => self.error,
            };
            if sum.error() <= small_enough {
                return;
            }
            self.add(sum, (2 * sum.count).min(self.most), x, y, counts);
        }
    }

    /// Adds samples up to a number of them.
    fn add(&self, sum: &mut Sum, wanted: u32, x: u32, y: u32, counts: &mut RayCounts) {
        for index in sum.count..wanted {
            sum.add(self.sample(x, y, index, counts), self.behind);
        }
    }

    fn sample(&self, x: u32, y: u32, index: u32, counts: &mut RayCounts) -> Glimpse {
        let numbers = Sequence::new(x, y, index);
        let (dx, dy) = if self.most == 1 { (0.5, 0.5) } else { numbers.pair(PLACE) };
        let [width, height] = self.size;
        let camera = &self.scene.camera;
        let ray = camera.ray(f64::from(x) + dx, f64::from(y) + dy, width, height);
        let ray = camera.ray_through_lens(ray, || numbers.pair(LENS));
        let across = f64::from(self.first).sqrt().min(4.0);
        let spread = camera.spread(width) / across;
        let Glimpse { light, cover } = self.studio.trace(ray, spread, &numbers, counts);
        Glimpse { light: light.min(Rgb::splat(BRIGHTEST)), cover }
    }

    /// What the samples show: their light through the tone curve, over the background.
    fn developed(&self, sum: &Sum) -> Pixel {
        let cover = sum.cover / f64::from(sum.count);
        if cover == 0.0 {
            return self.over_background(Pixel::default());
        }
        let color = tone::stored(tone::neutral(sum.light / sum.cover));
        self.over_background(Pixel { color: color * cover, cover })
    }

    fn over_background(&self, pixel: Pixel) -> Pixel {
        match self.scene.background {
            Some(background) => {
                Pixel { color: pixel.color + background * (1.0 - pixel.cover), cover: 1.0 }
            }
            None => pixel,
        }
    }
}

impl Sum {
    /// Adds a sample, before a background that looks as bright as `behind`.
    fn add(&mut self, Glimpse { light, cover }: Glimpse, behind: Option<f64>) {
        self.count += 1;
        self.light += light * cover;
        self.cover += cover;
        let shown = shown(light) * cover + behind.unwrap_or(0.0) * (1.0 - cover);
        self.shown += shown;
        self.squares += shown * shown;
        if behind.is_none() {
            self.covers += cover * cover;
        }
    }

    /// How bright the mean looks.
    fn shown(&self) -> f64 {
        self.shown / f64::from(self.count)
    }

    /// The standard error of how bright the mean looks, or of how much is covered of what is
    /// transparent, as of samples that know nothing of each other; these are more even, and err less.
    fn error(&self) -> f64 {
        let count = f64::from(self.count);
        let error = |sum: f64, squares: f64| {
            let mean = sum / count;
            let variance = (squares / count - mean * mean).max(0.0);
            (variance / (count - 1.0).max(1.0)).sqrt()
        };
        error(self.shown, self.squares).max(error(self.cover, self.covers))
    }
}
