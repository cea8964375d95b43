//! How a flat picture is laid on a body.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::config;

/// From points of a body to places of a picture: (0, 0) is its bottom left corner, (1, 1) its top
/// right one, and it repeats beyond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping {
    pub kind: config::Mapping,
    pub origin: DVec3,
    pub u: DVec3,
    pub v: DVec3,
}

impl Mapping {
    /// Where `point` lies on the picture, and how many pictures a world unit is there, to the right
    /// and upwards.
    pub fn place(&self, point: DVec3) -> (DVec2, DVec2) {
        let from_origin = point - self.origin;
        match self.kind {
            config::Mapping::Planar => {
                // The point is a sum of u and v, up to a way across both (Cramer's rule).
                let across = self.u.cross(self.v);
                let area2 = across.length_squared();
                let (u, v) = (self.v.cross(across) / area2, across.cross(self.u) / area2);
                let place = DVec2::new(from_origin.dot(u), from_origin.dot(v));
                (place, DVec2::new(u.length(), v.length()))
            }
            config::Mapping::Cylindrical => {
                let (turn, radius, height) = self.about_axis(from_origin);
                let tall = self.v.length();
                (DVec2::new(turn, height / tall), DVec2::new(1.0 / (TAU * radius), 1.0 / tall))
            }
            config::Mapping::Spherical => {
                let (turn, radius, height) = self.about_axis(from_origin);
                let latitude = libm::atan2(height, radius);
                let distance = (radius * radius + height * height).sqrt();
                let place = DVec2::new(turn, 0.5 + latitude / PI);
                (place, DVec2::new(1.0 / (TAU * radius), 1.0 / (PI * distance)))
            }
        }
    }

    /// The share of a turn about v from u on, to the right as seen from outside; the distance from
    /// the axis; and the height along it.
    fn about_axis(&self, from_origin: DVec3) -> (f64, f64, f64) {
        let [start, up, right] = self.axes();
        let (forward, sideways) = (from_origin.dot(start), from_origin.dot(right));
        let turn = libm::atan2(sideways, forward) / TAU;
        (turn, (forward * forward + sideways * sideways).sqrt(), from_origin.dot(up))
    }

    /// The direction of the left edge, the axis, and the direction a quarter of a turn on, each
    /// of length 1, for cylinders and spheres.
    pub fn axes(&self) -> [DVec3; 3] {
        let up = self.v.normalize();
        let start = (self.u - up * self.u.dot(up)).normalize();
        // The world is left-handed: who stands outside has the right hand there.
        [start, up, start.cross(up)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mapping(kind: config::Mapping, u: DVec3, v: DVec3) -> Mapping {
        Mapping { kind, origin: DVec3::new(1.0, 2.0, 3.0), u, v }
    }

    #[test]
    fn a_plane_is_covered_by_sheared_copies() {
        let (u, v) = (DVec3::new(2.0, 0.0, 0.0), DVec3::new(1.0, 3.0, 0.0));
        let mapping = mapping(config::Mapping::Planar, u, v);
        let point = mapping.origin + u * 0.25 + v * -1.5 + DVec3::Z * 7.0;
        assert!(mapping.place(point).0.distance(DVec2::new(0.25, -1.5)) < 1e-12);
    }

    #[test]
    fn a_cylinder_is_read_to_the_right_from_outside() {
        let mapping = mapping(config::Mapping::Cylindrical, DVec3::NEG_Z, DVec3::Y * 4.0);
        // Seen from −z, x lies to the right.
        let place = |offset: DVec3| mapping.place(mapping.origin + offset).0;
        assert!(place(DVec3::new(0.0, 1.0, -5.0)).distance(DVec2::new(0.0, 0.25)) < 1e-12);
        assert!(place(DVec3::new(5.0, 2.0, 0.0)).distance(DVec2::new(0.25, 0.5)) < 1e-12);
    }

    #[test]
    fn a_sphere_has_its_poles_at_the_edges() {
        let mapping = mapping(config::Mapping::Spherical, DVec3::NEG_Z, DVec3::Y);
        let height = |offset: DVec3| mapping.place(mapping.origin + offset).0.y;
        assert!((height(DVec3::Y * 3.0) - 1.0).abs() < 1e-12);
        assert!((height(DVec3::NEG_Y) - 0.0).abs() < 1e-12);
        assert!((height(DVec3::new(0.0, 1.0, 1.0)) - 0.75).abs() < 1e-12);
    }
}
