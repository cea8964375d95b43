//! Which way pieces look.

use glam::{DAffine3, DMat3, DVec3};

use super::Camera;
use crate::config::Knights;
use crate::geometry::transform::{rotation_y, sin_cos};
use crate::notation::{Color, Piece, Role};

/// How far pieces that look to the left or right are turned out of the picture, in degrees: a little
/// of a knight's face is seen, and nearly all of its profile.
const TOWARDS_VIEWER: f64 = 15.0;

/// The turns of pieces about their axes, the same in all frames.
pub struct Facing {
    knights: Knights,
    /// The turn to the side of the picture that knights look to.
    aside: DAffine3,
}

impl Facing {
    /// The turns that `knights` asks for as `camera` sees them before it orbits.
    pub fn new(knights: Knights, camera: &Camera) -> Facing {
        let [right, _, forward] = camera.axes();
        // A camera that has rolled on its side has no right of its own.
        let level = |axis: DVec3| DVec3::new(axis.x, 0.0, axis.z);
        let right = level(right).try_normalize().or(DVec3::Y.cross(level(forward)).try_normalize());
        let right = right.unwrap_or(DVec3::X);
        let away = right.cross(DVec3::Y);
        let (sin, cos) = sin_cos(TOWARDS_VIEWER);
        let side = if knights == Knights::Right { right } else { -right };
        let look = side * cos - away * sin;
        let aside = DMat3::from_cols(look, DVec3::Y, look.cross(DVec3::Y));
        Facing { knights, aside: DAffine3::from_mat3(aside) }
    }

    /// The turn of `piece` about its axis.
    pub fn turn(&self, piece: Piece) -> DAffine3 {
        match (self.knights, piece) {
            (Knights::Left | Knights::Right, _) => self.aside,
            (Knights::Enemy, Piece { role: Role::Knight, color: Color::White }) => rotation_y(90.0),
            (Knights::Enemy, Piece { role: Role::Knight, color: Color::Black }) => {
                rotation_y(-90.0)
            }
            (Knights::Enemy | Knights::Kingside, _) => DAffine3::IDENTITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Pose;

    fn camera(position: DVec3) -> Camera {
        Camera::free(&Pose { position, ..Pose::default() })
    }

    const PLACES: [DVec3; 4] = [
        DVec3::new(14.0, 20.0, -30.0),
        DVec3::new(-20.0, 50.0, 40.0),
        DVec3::new(60.0, 3.0, 14.0),
        // Straight above.
        DVec3::new(14.0, 60.0, 14.0),
    ];

    #[test]
    fn all_look_to_the_same_side_of_the_picture_and_a_little_out_of_it() {
        for (knights, side) in [(Knights::Left, -1.0), (Knights::Right, 1.0)] {
            for camera in PLACES.map(camera) {
                let [right, _, forward] = camera.axes();
                let facing = Facing::new(knights, &camera);
                for color in Color::ALL {
                    for role in Role::ALL {
                        let turn = facing.turn(Piece { color, role });
                        let look = turn.transform_vector3(DVec3::X);
                        assert!(look.dot(right) * side > 0.9, "{knights:?}: {look}");
                        assert!(look.dot(forward) <= 1e-12 && look.y == 0.0);
                        assert!((turn.matrix3.determinant() - 1.0).abs() < 1e-12);
                        // What is seen of the king's cross is its front or its back.
                        let front = turn.transform_vector3(DVec3::Z) * side;
                        assert!(front.dot(forward) >= -1e-12, "{knights:?}: {front}");
                    }
                }
            }
        }
    }

    #[test]
    fn knights_look_at_the_enemy_when_told_to_and_others_stay() {
        let facing = Facing::new(Knights::Enemy, &camera(PLACES[0]));
        for (color, rank) in [(Color::White, DVec3::Z), (Color::Black, DVec3::NEG_Z)] {
            let turn = |role| facing.turn(Piece { color, role });
            assert!(turn(Role::Knight).transform_vector3(DVec3::X).distance(rank) < 1e-12);
            assert_eq!(turn(Role::King), DAffine3::IDENTITY);
        }
    }
}
