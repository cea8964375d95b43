//! Colours over a surface; one entry a kind.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::noise::fractal;
use super::{Mapping, Readers, Rgb, coordinates, timber};
use crate::assets::{Beyond, Bitmap};
use crate::config::{self, Axis, Filter};

/// The colour at each point of a body, in the body's own space.
#[derive(Clone, Debug, PartialEq)]
pub enum Texture {
    /// One colour everywhere.
    Plain(Rgb),
    /// Rings of wood.
    Wood {
        /// The two colours that a ring runs between.
        colors: [Rgb; 2],
        noise: Noise,
        /// The direction that it grew in.
        grain: Axis,
    },
    /// Wood of a tree of its own.
    Timber {
        /// The ground, and the darkest of a ring.
        colors: [Rgb; 2],
        /// World units from ring to ring.
        ring: f64,
        /// The direction that it grew in.
        grain: Axis,
    },
    /// Veins of marble.
    Marble {
        /// The ground, and the veins.
        colors: [Rgb; 2],
        noise: Noise,
    },
    /// Coordinates on another texture, on the board's frame: their colour, and the side that they
    /// are to be read from.
    Lettered { ground: Box<Texture>, ink: Rgb, readers: Readers },
    /// A picture; its colours are as they are written, or as linear light.
    Bitmap { bitmap: Arc<Bitmap>, mapping: Mapping, filter: Filter, linear: bool },
}

/// A point as a texture sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// In the body's own space.
    pub on_body: DVec3,
    /// In the piece of wood or stone that this part of the body is cut from.
    pub point: DVec3,
    /// Which tree or block that is.
    pub seed: u64,
}

/// A sum of octaves of gradient noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// World units that one unit of the lowest octave is stretched over.
    pub size: f64,
    pub octaves: u32,
}

impl Texture {
    /// The colour at `place`, where a width of `seen` world units is seen at once.
    pub fn color(&self, place: Place, seen: f64) -> Rgb {
        let Place { point, seed, .. } = place;
        match self {
            Texture::Plain(color) => *color,
            Texture::Wood { colors, noise, grain } => colors[0]
                .lerp(colors[1], wood(lengthways(point, *grain) / noise.size, noise.octaves)),
            Texture::Timber { colors, ring, grain } => colors[0].lerp(
                colors[1],
                timber::shade(lengthways(point, *grain) / ring, seed, seen / ring),
            ),
            Texture::Lettered { ground, ink, readers } => {
                let cover = coordinates::ink(place.on_body.x, place.on_body.z, *readers, seen);
                ground.color(place, seen).lerp(*ink, cover)
            }
            Texture::Marble { colors, noise } => {
                let point = point / noise.size + block(seed);
                colors[0].lerp(colors[1], marble(point, noise.octaves))
            }
            Texture::Bitmap { bitmap, mapping, filter, linear } => {
                let (place, scale) = mapping.place(point);
                let texels = (scale * bitmap.size()).max_element() * seen;
                let beyond = match mapping.kind {
                    config::Mapping::Spherical => Beyond::Stays,
                    config::Mapping::Planar | config::Mapping::Cylindrical => Beyond::Repeats,
                };
                let color = bitmap.color(place, *filter, beyond, texels);
                if *linear { linear_light(color) } else { color }
            }
        }
    }

    /// Wood and marble as one colour, the mean over a large body; others as they are.
    pub fn plain(self) -> Texture {
        match self {
            Texture::Wood { .. } | Texture::Timber { .. } | Texture::Marble { .. } => {
                Texture::Plain(self.mean())
            }
            other => other,
        }
    }

    /// The mean colour over a large body; of a picture without MIP levels that of its middle.
    pub fn mean(&self) -> Rgb {
        match self {
            Texture::Plain(color) => *color,
            // A ring has all its shades in equal shares.
            Texture::Wood { colors, .. } => colors[0].lerp(colors[1], 0.5),
            Texture::Timber { colors, .. } => colors[0].lerp(colors[1], timber::MEAN),
            Texture::Marble { colors, .. } => colors[0].lerp(colors[1], MARBLE_MEAN),
            Texture::Lettered { ground, .. } => ground.mean(),
            Texture::Bitmap { bitmap, filter, linear, .. } => {
                let whole = bitmap.size().max_element();
                let color = bitmap.color(DVec2::splat(0.5), *filter, Beyond::Stays, whole);
                if *linear { linear_light(color) } else { color }
            }
        }
    }
}

/// A point of wood that grew along `grain`, with z along it.
fn lengthways(point: DVec3, grain: Axis) -> DVec3 {
    match grain {
        Axis::X => point.yzx(),
        Axis::Y => point.zxy(),
        Axis::Z => point,
    }
}

/// How noise is stretched in wood, which changes more slowly along the grain, z.
pub const WOOD_STRETCH: DVec3 = DVec3::new(1.0, 1.0, 0.05);

/// How many rings a unit of noise stands for.
pub const RINGS: f64 = 20.0;

/// Where in its ring a point of a log lies, 0 to 1: twenty rings a unit of noise, which changes
/// twenty times more slowly along the grain, z (Turek 2008, 3.7.7). The thesis casts to an integer
/// and so jumps where the noise is negative; the floor does not.
fn wood(point: DVec3, octaves: u32) -> f64 {
    let bumps = fractal(point * WOOD_STRETCH, octaves) * RINGS;
    bumps - bumps.floor()
}

/// Across the sheets of marble, as long as there is one sheet a unit.
pub const SHEETS: DVec3 = DVec3::new(0.6, 0.7, 0.4);

/// How far noise bends sheets.
pub const BEND: f64 = 2.2;

/// Where the block that `seed` stands for lies in its rock.
pub fn block(seed: u64) -> DVec3 {
    DVec3::new(7.1, 3.3, 5.7) * (seed % 1024) as f64
}

/// How much of a vein a point lies in, 0 to 1: parallel sheets, bent by noise, and thin.
fn marble(point: DVec3, octaves: u32) -> f64 {
    let bent = point.dot(SHEETS) + BEND * fractal(point, octaves);
    let wave = libm::sin(PI * bent).abs();
    (1.0 - wave) * (1.0 - wave)
}

/// The mean of (1 − |sin|)².
const MARBLE_MEAN: f64 = 1.5 - 4.0 / PI;

/// A colour as it is written to a picture (sRGB, each channel 0 to 1), as linear light (IEC
/// 61966-2-1).
pub fn linear_light(color: Rgb) -> Rgb {
    let linear = |channel: f64| {
        if channel <= 0.04045 { channel / 12.92 } else { libm::pow((channel + 0.055) / 1.055, 2.4) }
    };
    Rgb::from_array(color.to_array().map(linear))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(point: DVec3) -> Place {
        Place { on_body: point, point, seed: 0 }
    }

    const BLACK_AND_WHITE: [Rgb; 2] = [DVec3::ZERO, DVec3::ONE];

    /// Mean and steepest step of a texture along many lines.
    fn walk(texture: &Texture) -> f64 {
        let mut sum = 0.0;
        for step in 0..200_000 {
            let t = f64::from(step);
            sum += texture.color(at(DVec3::new(0.37 * t, -0.71 * t, 0.13 * t)), 0.0).x;
        }
        sum / 200_000.0
    }

    #[test]
    fn the_plain_color_is_the_mean() {
        let noise = Noise { size: 3.0, octaves: 4 };
        let wood = Texture::Wood { colors: BLACK_AND_WHITE, noise, grain: Axis::X };
        let marble = Texture::Marble { colors: BLACK_AND_WHITE, noise };
        for texture in [wood, marble] {
            let Texture::Plain(mean) = texture.clone().plain() else { panic!("not plain") };
            let walked = walk(&texture);
            assert!((walked - mean.x).abs() < 0.01, "{walked} is not {}", mean.x);
        }
    }

    /// Half black and half white, as linear light: the mean of what is written.
    #[test]
    fn the_mean_of_a_picture_is_that_of_all_of_it() {
        let picture =
            image::RgbImage::from_fn(8, 8, |x, _| image::Rgb([if x < 4 { 0 } else { 255 }; 3]));
        let texture = |linear| Texture::Bitmap {
            bitmap: Arc::new(Bitmap::new(picture.clone(), Filter::Mip)),
            mapping: Mapping {
                kind: config::Mapping::Planar,
                origin: DVec3::ZERO,
                u: DVec3::X,
                v: DVec3::Y,
            },
            filter: Filter::Mip,
            linear,
        };
        assert!((texture(false).mean().x - 0.5).abs() < 0.01);
        assert!((texture(true).mean().x - 0.214).abs() < 0.01);
    }

    #[test]
    fn wood_hardly_changes_along_its_grain() {
        let noise = Noise { size: 9.0, octaves: 1 };
        for (grain, along) in [(Axis::X, DVec3::X), (Axis::Y, DVec3::Y), (Axis::Z, DVec3::Z)] {
            let wood = Texture::Wood { colors: BLACK_AND_WHITE, noise, grain };
            let (mut lengthways, mut across) = (0.0, 0.0);
            for step in 0..2000 {
                let point = DVec3::new(0.37, -0.71, 0.13) * f64::from(step);
                let change = |by: DVec3| {
                    let change =
                        (wood.color(at(point + by), 0.0) - wood.color(at(point), 0.0)).x.abs();
                    change.min(1.0 - change)
                };
                lengthways += change(along * 0.05);
                across += change(along.any_orthonormal_vector() * 0.05);
            }
            assert!(10.0 * lengthways < across, "{grain:?}: {lengthways} along, {across} across");
        }
    }
}
