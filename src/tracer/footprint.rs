//! What a pixel saw, so that it can be compared with its neighbours.

use glam::Vec3;

use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};

/// The surfaces that a ray from the camera met, in mirrors and through glass too; each surface
/// counts by its share of the pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Footprint {
    /// Which bodies were met, in which order.
    bodies: u32,
    normal: Vec3,
    /// Of the texture.
    color: Vec3,
    /// That the surface gets straight from the lights, as it answers it.
    light: Vec3,
}

/// How much more normals may differ than colours: what they do to the light is compared with it.
const NORMAL_SCALE: f32 = 8.0;

/// FNV's prime.
const PRIME: u32 = 0x0100_0193;

impl Footprint {
    /// Of a ray from the camera that meets nothing.
    pub fn of_nothing() -> Footprint {
        Footprint::new(&[None], Vec3::ZERO, Vec3::ZERO, Vec3::ZERO)
    }

    /// What was met, in this order, and the sums over it.
    pub fn new(met: &[Option<usize>], normal: Vec3, color: Vec3, light: Vec3) -> Footprint {
        let number = |met: &Option<usize>| met.map_or(0, |body| body as u32 + 1);
        let bodies = met.iter().fold(0, |bodies, met| step(bodies, number(met)));
        Footprint { bodies, normal, color, light }
    }

    /// Whether two pixels saw different things: other bodies, or the same ones with normals,
    /// colours or light further apart than `threshold` allows.
    pub fn differs(&self, other: &Footprint, threshold: f32) -> bool {
        let apart = |a: Vec3, b: Vec3| (a - b).abs().max_element();
        self.bodies != other.bodies
            || apart(self.normal, other.normal) > NORMAL_SCALE * threshold
            || apart(self.color, other.color) > threshold
            || apart(self.light, other.light) > threshold
    }
}

/// A step of a hash: FNV's, by whole numbers.
fn step(bodies: u32, number: u32) -> u32 {
    (bodies ^ (number + 1)).wrapping_mul(PRIME)
}

/// The footprints of a packet.
pub struct Footprints<S: Simd> {
    bodies: U32x8<S>,
    normal: Vec3x8<S>,
    color: Vec3x8<S>,
    light: Vec3x8<S>,
}

impl<S: Simd> Footprints<S> {
    #[inline(always)]
    pub fn new() -> Footprints<S> {
        let zero = Vec3x8::zero();
        Footprints { bodies: U32x8::splat(0), normal: zero, color: zero, light: zero }
    }

    #[inline(always)]
    pub fn meet_nothing(&mut self, lanes: Mask8<S>) {
        self.meet_body(lanes, U32x8::splat(0));
    }

    #[inline(always)]
    pub fn meet(
        &mut self,
        lanes: Mask8<S>,
        weight: F32x8<S>,
        body: U32x8<S>,
        normal: Vec3x8<S>,
        color: Vec3x8<S>,
        light: Vec3x8<S>,
    ) {
        self.meet_body(lanes, body + U32x8::splat(1));
        let weight = lanes.keep(weight);
        self.normal += normal * weight;
        self.color += color * weight;
        self.light += light * weight;
    }

    #[inline(always)]
    pub fn store(&self) -> [Footprint; 8] {
        let bodies = self.bodies.store();
        let (normal, color, light) = (self.normal.store(), self.color.store(), self.light.store());
        std::array::from_fn(|lane| Footprint {
            bodies: bodies[lane],
            normal: normal[lane],
            color: color[lane],
            light: light[lane],
        })
    }

    #[inline(always)]
    fn meet_body(&mut self, lanes: Mask8<S>, body: U32x8<S>) {
        let met = (self.bodies ^ (body + U32x8::splat(1))) * U32x8::splat(PRIME);
        self.bodies = lanes.select_words(met, self.bodies);
    }
}
