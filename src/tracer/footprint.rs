//! What a pixel saw, so that it can be compared with its neighbours.

use glam::{DVec3, Vec3};

use crate::scene::Rgb;

/// The surfaces that a ray from the camera met, in mirrors and through glass too; each surface
/// counts by its share of the pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Footprint {
    /// Which objects were met, in which order.
    objects: u64,
    normal: Vec3,
    /// Of the texture.
    color: Vec3,
    /// That the surface gets straight from the lights, as it answers it.
    light: Vec3,
}

/// How much more normals may differ than colours: what they do to the light is compared with it.
const NORMAL_SCALE: f32 = 8.0;

impl Footprint {
    pub fn meet_nothing(&mut self) {
        self.meet_object(0);
    }

    pub fn meet(&mut self, weight: f64, object: usize, normal: DVec3, color: Rgb, light: Rgb) {
        self.meet_object(object as u64 + 1);
        self.normal += (normal * weight).as_vec3();
        self.color += (color * weight).as_vec3();
        self.light += (light * weight).as_vec3();
    }

    /// Whether the ray from the camera met nothing at all.
    pub fn is_of_nothing(&self) -> bool {
        let mut nothing = Footprint::default();
        nothing.meet_nothing();
        *self == nothing
    }

    fn meet_object(&mut self, object: u64) {
        // Steps of a hash: FNV's, by whole numbers.
        self.objects = (self.objects ^ object.wrapping_add(1)).wrapping_mul(0x0000_0100_0000_01B3);
    }

    /// Whether two pixels saw different things: other objects, or the same ones with normals,
    /// colours or light further apart than `threshold` allows.
    pub fn differs(&self, other: &Footprint, threshold: f32) -> bool {
        let apart = |a: Vec3, b: Vec3| (a - b).abs().max_element();
        self.objects != other.objects
            || apart(self.normal, other.normal) > NORMAL_SCALE * threshold
            || apart(self.color, other.color) > threshold
            || apart(self.light, other.light) > threshold
    }
}
