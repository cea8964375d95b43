//! Colours over one piece of wood or stone, for packets of points.

use glam::{DVec3, Vec3};

use super::lettering::Lettering;
use super::noise::Fractal;
use super::timber::Timber;
use crate::config::Axis;
use crate::lanes::{F32x8, Mask8, Simd, Vec3x8, math};
use crate::scene::{self, Noise, Place, texture};

/// Points as textures see them.
#[derive(Clone, Copy)]
pub struct Places<S: Simd> {
    /// In the body's own space.
    pub on_body: Vec3x8<S>,
    /// In the piece that this part of the body is cut from.
    pub points: Vec3x8<S>,
    /// World units that are seen at once.
    pub seen: F32x8<S>,
}

/// The texture of one piece: what depends on its seed is known.
pub enum Texture {
    Plain(Vec3),
    Patterned(Box<Patterned>),
}

pub enum Patterned {
    Wood {
        colors: [Vec3; 2],
        noise: Fractal,
        grain: Axis,
    },
    Timber {
        colors: [Vec3; 2],
        timber: Timber,
        grain: Axis,
    },
    Marble {
        colors: [Vec3; 2],
        noise: Fractal,
        /// What sheets are counted along, and where the block lies.
        across: Vec3,
        block: f32,
    },
    Lettered(Lettering),
    /// Asked point by point, and so made linear after that.
    Bitmap {
        written: scene::Texture,
        is_linear: bool,
    },
}

impl Texture {
    /// The texture of the piece that `seed` stands for.
    pub fn new(texture: &scene::Texture, seed: u64) -> Texture {
        let both = |colors: &[DVec3; 2]| colors.map(|color| color.as_vec3());
        Texture::Patterned(Box::new(match texture {
            scene::Texture::Plain(color) => return Texture::Plain(color.as_vec3()),
            scene::Texture::Wood { colors, noise: Noise { size, octaves }, grain } => {
                let scale = texture::WOOD_STRETCH / *size;
                let noise = Fractal::new(scale, DVec3::ZERO, *octaves);
                Patterned::Wood { colors: both(colors), noise, grain: *grain }
            }
            scene::Texture::Timber { colors, ring, grain } => Patterned::Timber {
                colors: both(colors),
                timber: Timber::new(*ring, seed),
                grain: *grain,
            },
            scene::Texture::Marble { colors, noise: Noise { size, octaves } } => {
                let block = texture::block(seed);
                let sheets = texture::SHEETS.dot(block);
                Patterned::Marble {
                    colors: both(colors),
                    noise: Fractal::new(DVec3::splat(1.0 / size), block, *octaves),
                    across: (texture::SHEETS / *size).as_vec3(),
                    // All sheets are alike.
                    block: (sheets - sheets.floor()) as f32,
                }
            }
            scene::Texture::Lettered { ground, ink, readers } => Patterned::Lettered(
                Lettering::new(Texture::new(ground, seed), ink.as_vec3(), *readers),
            ),
            scene::Texture::Bitmap { bitmap, mapping, filter, linear } => {
                let (bitmap, mapping, filter) = (bitmap.clone(), *mapping, *filter);
                let written = scene::Texture::Bitmap { bitmap, mapping, filter, linear: false };
                Patterned::Bitmap { written, is_linear: *linear }
            }
        }))
    }

    #[inline(always)]
    pub fn color<S: Simd>(&self, places: &Places<S>, lanes: Mask8<S>) -> Vec3x8<S> {
        match self {
            Texture::Plain(color) => Vec3x8::splat(*color),
            Texture::Patterned(pattern) => pattern.color(places, lanes),
        }
    }
}

impl Patterned {
    #[inline(never)]
    fn color<S: Simd>(&self, places: &Places<S>, lanes: Mask8<S>) -> Vec3x8<S> {
        S::run(
            #[inline(always)]
            || {
                let Places { points, seen, .. } = *places;
                match self {
                    Patterned::Wood { colors, noise, grain } => {
                        let bumps = noise.at(lengthways(points, *grain), lanes);
                        let bumps = bumps * F32x8::splat(texture::RINGS as f32);
                        mixed(colors, bumps - bumps.floor())
                    }
                    Patterned::Timber { colors, timber, grain } => {
                        mixed(colors, timber.shade(lengthways(points, *grain), seen, lanes))
                    }
                    Patterned::Marble { colors, noise, across, block } => {
                        let bend = noise.at(points, lanes) * F32x8::splat(texture::BEND as f32);
                        let sheet = points.dot(Vec3x8::splat(*across)) + F32x8::splat(*block);
                        let half = (sheet + bend) * F32x8::splat(0.5);
                        let wave = F32x8::splat(1.0) - math::sin_cos_turns(half).0.abs();
                        mixed(colors, wave * wave)
                    }
                    Patterned::Lettered(lettering) => lettering.color(places, lanes),
                    Patterned::Bitmap { written, is_linear } => {
                        let color = point_by_point(places, lanes, |point, seen| {
                            // Pictures lie where they lie, whatever the seed.
                            written.color(Place { on_body: point, point, seed: 0 }, seen)
                        });
                        if *is_linear {
                            Vec3x8::new(
                                linear_light(color.x),
                                linear_light(color.y),
                                linear_light(color.z),
                            )
                        } else {
                            color
                        }
                    }
                }
            },
        )
    }
}

#[inline(always)]
fn mixed<S: Simd>(colors: &[Vec3; 2], share: F32x8<S>) -> Vec3x8<S> {
    Vec3x8::splat(colors[0]).lerp(Vec3x8::splat(colors[1]), share)
}

/// Points of wood that grew along `grain`, with z along it.
#[inline(always)]
fn lengthways<S: Simd>(Vec3x8 { x, y, z }: Vec3x8<S>, grain: Axis) -> Vec3x8<S> {
    match grain {
        Axis::X => Vec3x8::new(y, z, x),
        Axis::Y => Vec3x8::new(z, x, y),
        Axis::Z => Vec3x8::new(x, y, z),
    }
}

/// What a function of points in the piece gives, for what is rare.
#[inline(always)]
fn point_by_point<S: Simd>(
    places: &Places<S>,
    lanes: Mask8<S>,
    color: impl Fn(DVec3, f64) -> DVec3,
) -> Vec3x8<S> {
    let (points, seen, lanes) = (places.points.store(), places.seen.store(), lanes.bits());
    Vec3x8::load(&std::array::from_fn(|lane| {
        if lanes >> lane & 1 == 1 {
            color(points[lane].as_dvec3(), f64::from(seen[lane]))
        } else {
            DVec3::ZERO
        }
    }))
}

/// Channels as they are written to a picture, as linear light ([`scene::linear_light`]).
#[inline(always)]
fn linear_light<S: Simd>(channel: F32x8<S>) -> F32x8<S> {
    let base = (channel + F32x8::splat(0.055)) * F32x8::splat(1.0 / 1.055);
    let curve = math::pow(base, F32x8::splat(2.4));
    channel.le(F32x8::splat(0.04045)).select(channel * F32x8::splat(1.0 / 12.92), curve)
}
