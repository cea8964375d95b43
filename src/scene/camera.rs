//! The camera: from places on the picture to rays.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::config::Pose;
use crate::geometry::Ray;
use crate::geometry::transform::{rotation_y, sin_cos};

/// How far from what it shows a camera in parallel projection stands, in world units.
pub const FAR: f64 = 200.0;

/// A camera in a left-handed world: x to the right, y up, z *into* the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    position: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    projection: Projection,
    /// Half of the picture's width: as seen at distance 1 in perspective, in world units in
    /// parallel projection.
    half_width: f64,
    /// Radius of the lens, and how far ahead what is sharp lies, in world units.
    lens: f64,
    focus: f64,
}

/// Where rays come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// All from the camera's place, as through a pinhole.
    Perspective,
    /// Each from its own place beside it, all in one direction.
    Parallel,
}

impl Camera {
    /// A camera by its place, its directions to the right, upwards and forward, and half of the
    /// width that it sees: at distance 1 in perspective, anywhere in parallel projection.
    pub fn new(
        position: DVec3,
        [right, up, forward]: [DVec3; 3],
        projection: Projection,
        half_width: f64,
    ) -> Camera {
        Camera { position, right, up, forward, projection, half_width, lens: 0.0, focus: 1.0 }
    }

    /// The pinhole camera that stands free. Its true angle from left to right is half of `fov`: the
    /// thesis takes `h = FOV·π/180/2` and a distance of `(width/2) / tan(h/2)` (Turek 2008, 4.3).
    pub fn free(pose: &Pose) -> Camera {
        let forward = (pose.look_at - pose.position).normalize();
        // Straight up or down there is no upright; rank 8 then points up in the picture.
        let upright =
            if forward.cross(DVec3::Y).length_squared() < 1e-18 { DVec3::Z } else { DVec3::Y };
        let level = upright.cross(forward).normalize();
        let above = forward.cross(level);
        // A positive roll turns a ray from x towards y, which turns the picture clockwise.
        let (sin, cos) = sin_cos(pose.z_rot);
        let (sin_half, cos_half) = sin_cos(pose.fov / 4.0);
        let axes = [level * cos + above * sin, above * cos - level * sin, forward];
        Camera::new(pose.position, axes, Projection::Perspective, sin_half / cos_half)
    }

    /// This camera after a turn about the upright line through `middle`, in degrees; positive is
    /// anticlockwise as seen from above.
    pub fn orbited(&self, middle: DVec3, degrees: f64) -> Camera {
        let turn = rotation_y(degrees);
        Camera {
            position: middle + turn.transform_vector3(self.position - middle),
            right: turn.transform_vector3(self.right),
            up: turn.transform_vector3(self.up),
            forward: turn.transform_vector3(self.forward),
            ..*self
        }
    }

    /// This camera nearer to `point` by a share of its way there.
    pub fn nearer(&self, point: DVec3, share: f64) -> Camera {
        Camera { position: self.position.lerp(point, share), ..*self }
    }

    /// This camera moved by `way`, with all that it looks at.
    pub fn moved(&self, way: DVec3) -> Camera {
        Camera { position: self.position + way, ..*self }
    }

    /// From which side of the board it looks, in degrees from White's, anticlockwise as seen from
    /// above.
    pub fn azimuth(&self) -> f64 {
        // Straight down, what points up in the picture is the way ahead.
        let ahead = if self.forward.y.abs() > 1.0 - 1e-9 { self.up } else { self.forward };
        libm::atan2(-ahead.x, ahead.z).to_degrees()
    }

    /// This camera with a lens of a `radius` in world units that shows `point` sharp; `None` when that
    /// does not lie ahead.
    pub fn focused(&self, radius: f64, point: DVec3) -> Option<Camera> {
        let focus = (point - self.position).dot(self.forward);
        (focus > 0.0).then_some(Camera { lens: radius, focus, ..*self })
    }

    /// Whether it has a lens.
    pub fn has_lens(&self) -> bool {
        self.lens > 0.0
    }

    /// The ray that [`Camera::ray`] gives, from another point of the lens, if there is one: `choose` gives
    /// two numbers from 0 to 1 for it.
    pub fn ray_through_lens(&self, pinhole: Ray, choose: impl Fn() -> (f64, f64)) -> Ray {
        if self.lens == 0.0 {
            return pinhole;
        }
        let (u, v) = choose();
        let sharp = pinhole.at(self.focus / pinhole.direction.dot(self.forward));
        let (sin, cos) = libm::sincos(TAU * v);
        let beside = (self.right * cos + self.up * sin) * (self.lens * u.sqrt());
        let origin = pinhole.origin + beside;
        Ray { origin, direction: (sharp - origin).normalize() }
    }

    /// Where it stands.
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// Its directions to the right, upwards and forward, each of length 1.
    pub fn axes(&self) -> [DVec3; 3] {
        [self.right, self.up, self.forward]
    }

    /// Where its rays come from.
    pub fn projection(&self) -> Projection {
        self.projection
    }

    /// The width that the whole picture shows: at distance 1 in perspective, anywhere in parallel
    /// projection.
    pub fn width(&self) -> f64 {
        2.0 * self.half_width
    }

    /// The width that one of `across` equal parts of the picture's width stands for, per unit of
    /// distance; in parallel projection as it is at `FAR`, where such cameras are put.
    pub fn spread(&self, across: u32) -> f64 {
        let width = self.width() / f64::from(across);
        match self.projection {
            Projection::Perspective => width,
            Projection::Parallel => width / FAR,
        }
    }

    /// The ray of length 1 through the point (`x`, `y`) of a picture of `width` × `height` pixels;
    /// (0, 0) is the corner at the top left.
    pub fn ray(&self, x: f64, y: f64, width: u32, height: u32) -> Ray {
        let pixel = 2.0 * self.half_width / f64::from(width);
        let across = (x - f64::from(width) / 2.0) * pixel;
        let upwards = (f64::from(height) / 2.0 - y) * pixel;
        let aside = self.right * across + self.up * upwards;
        match self.projection {
            Projection::Perspective => {
                Ray { origin: self.position, direction: (self.forward + aside).normalize() }
            }
            Projection::Parallel => Ray { origin: self.position + aside, direction: self.forward },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen_at(camera: &Camera, point: DVec3) -> (f64, f64) {
        let to = point - camera.position;
        let depth = to.dot(camera.forward) * camera.half_width;
        (to.dot(camera.right) / depth, to.dot(camera.up) / depth)
    }

    #[test]
    fn the_world_is_left_handed() {
        let pose = Pose { position: DVec3::new(14.0, 20.0, -30.0), ..Pose::default() };
        let camera = Camera::free(&pose);
        let (a_file, _) = seen_at(&camera, DVec3::ZERO);
        let (h_file, first_rank) = seen_at(&camera, DVec3::new(28.0, 0.0, 0.0));
        let (_, eighth_rank) = seen_at(&camera, DVec3::new(28.0, 0.0, 28.0));
        assert!(a_file < h_file);
        assert!(first_rank < eighth_rank);
    }

    #[test]
    fn a_fov_of_90_sees_45_degrees() {
        let camera = Camera::free(&Pose::default());
        let [left, right] = [0.0, 1000.0].map(|x| camera.ray(x, 300.0, 1000, 600).direction);
        assert!((left.angle_between(right).to_degrees() - 45.0).abs() < 1e-9);
    }

    #[test]
    fn positive_roll_turns_rays_from_x_towards_y() {
        let mut pose = Pose::default();
        let straight = Camera::free(&pose);
        pose.z_rot = 90.0;
        let rolled = Camera::free(&pose);
        assert!(rolled.right.distance(straight.up) < 1e-12);
        assert!(rolled.up.distance(-straight.right) < 1e-12);
    }

    #[test]
    fn straight_down_has_rank_8_on_top() {
        let pose = Pose { position: DVec3::new(14.0, 60.0, 14.0), ..Pose::default() };
        let camera = Camera::free(&pose);
        assert_eq!(seen_at(&camera, DVec3::new(14.0, 0.0, 14.0)), (0.0, 0.0));
        let (x, y) = seen_at(&camera, DVec3::new(0.0, 0.0, 28.0));
        assert!(x < 0.0 && y > 0.0);
    }

    #[test]
    fn rays_through_a_lens_meet_where_it_is_sharp() {
        let point = DVec3::new(14.0, 0.0, 14.0);
        let camera = Camera::free(&Pose::default()).focused(2.0, point).unwrap();
        let pinhole = camera.ray(500.0, 300.0, 1000, 600);
        for pair in [(0.1, 0.2), (0.9, 0.5), (0.5, 0.8)] {
            let ray = camera.ray_through_lens(pinhole, || pair);
            assert!((ray.origin - pinhole.origin).length() > 0.1);
            let distance = (point - ray.origin).length();
            assert!(ray.at(distance).distance(point) < 1e-9);
        }
    }

    #[test]
    fn parallel_rays_cover_the_same_width_at_any_distance() {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let camera = Camera::new(DVec3::ZERO, axes, Projection::Parallel, 7.0);
        for distance in [0.0, 50.0] {
            let [left, right] = [0.0, 300.0].map(|x| camera.ray(x, 100.0, 300, 200).at(distance));
            assert_eq!(
                (left, right),
                (DVec3::new(-7.0, 0.0, distance), DVec3::new(7.0, 0.0, distance))
            );
        }
    }
}
