//! The chess clock beside the board: a case with a painted face, and a rocker on it that is up on the
//! side of the player who is to move.

mod dial;
mod digits;
mod face;
mod reading;

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use glam::{DAffine3, DVec3};

use super::materials::{MaterialError, Materials};
use super::measures::{DEPTH, MIDDLE};
use super::{Mapping, Material, Object, Surface, Texture};
use crate::assets::Bitmap;
use crate::config::{self, Coat, Filter, Finish};
use crate::geometry::transform::{rotation_x, rotation_y, translation};
use crate::geometry::{Bounds, Cuboid, Solid};
use crate::timeline::Dials;
use reading::{Reading, readings};

/// The case where it was made: on the table, with its face towards x.
const CASE: Cuboid = Cuboid { min: DVec3::new(-1.5, -DEPTH, -6.0), max: DVec3::new(1.5, 5.2, 6.0) };

/// What the face leaves free at its edges, and how far it stands out, in world units.
const RIM: f64 = 0.45;
const THICKNESS: f64 = 0.02;

/// The face: a plate on the case.
const PLATE: Cuboid = Cuboid {
    min: DVec3::new(CASE.max.x, CASE.min.y + RIM, CASE.min.z + RIM),
    max: DVec3::new(CASE.max.x + THICKNESS, CASE.max.y - RIM, CASE.max.z - RIM),
};

/// How far the clock is from the board's middle where it is nearest to it, in world units: so far, or as
/// far as this behind what stands beside the board.
const AWAY: f64 = 21.5;
const BEHIND: f64 = 0.3;

/// How far it is turned to those who look at the board from a side, in degrees.
const TURN: f64 = 25.0;

/// The rocker when it is level: its middle above the case, and its tilt in degrees when it is not.
const ROCKER: Cuboid =
    Cuboid { min: DVec3::new(-0.55, -0.14, -3.6), max: DVec3::new(0.55, 0.14, 3.6) };
const ROCKER_HEIGHT: f64 = 0.48;
const TILT: f64 = 5.0;

/// What the rocker rocks on.
const PIVOT: Cuboid = Cuboid {
    min: DVec3::new(-0.4, CASE.max.y, -0.35),
    max: DVec3::new(0.4, CASE.max.y + ROCKER_HEIGHT, 0.35),
};

/// How high the rocker's end reaches above the case.
const HIGHEST: f64 = 1.0;

/// The way from where the clock was made to where it stands for a camera that looks along `forward`:
/// beside the a-file, or the h-file, such that its face is seen; and turned a little to the camera. Captured
/// pieces stand as far as `beside` from the board's middle.
pub fn place(forward: DVec3, beside: f64) -> DAffine3 {
    // Where the camera is, as seen from the clock.
    let beside_h = forward.x > 1e-9;
    let (x, z) = if beside_h { (forward.x, forward.z) } else { (-forward.x, -forward.z) };
    let is_above = x.abs() + z.abs() < 1e-9;
    let turn = if is_above { 0.0 } else { libm::atan2(z, x).to_degrees().clamp(-TURN, TURN) };
    let half = rotation_y(turn).transform_vector3(DVec3::Z * CASE.max.z).x.abs()
        + rotation_y(turn).transform_vector3(DVec3::X * CASE.max.x).x;
    let (side, half_turn) = if beside_h { (DVec3::X, 180.0) } else { (DVec3::NEG_X, 0.0) };
    let away = AWAY.max(beside + BEHIND) + half;
    translation(MIDDLE + side * away) * rotation_y(half_turn + turn)
}

/// The corners of what the clock fills at a [`place`].
pub fn corners(place: &DAffine3) -> [DVec3; 8] {
    let max = CASE.max + DVec3::new(THICKNESS, HIGHEST, 0.0);
    Bounds { min: CASE.min, max }.corners().map(|corner| place.transform_point3(corner))
}

/// The clock of a stage.
pub struct Clock {
    settings: config::Clock,
    /// [`CASE`], [`PLATE`], [`PIVOT`] and [`ROCKER`]: the same ones in all pictures, so that they are known again.
    solids: [Arc<dyn Solid>; 4],
    case: Surface,
    brass: Surface,
    filter: Filter,
    is_linear: bool,
    /// The faces that were painted last, and what they show: most frames show the same, and a frame that was
    /// looked at ahead of its time is to be known again.
    painted: Mutex<VecDeque<([Reading; 2], Surface)>>,
}

/// So many faces are kept (each takes about 0.5 MB): more than a row of pictures has bodies that come and go.
const FACES: usize = 144;

impl Clock {
    /// A clock as the settings have it.
    ///
    /// # Errors
    /// When the settings name a material that is not there.
    pub fn new(materials: &Materials) -> Result<Clock, MaterialError> {
        let settings = materials.config.clock.clone();
        let [case, brass] = materials.config.clock.materials();
        Ok(Clock {
            case: materials.surface(case)?,
            brass: materials.surface(brass)?,
            filter: materials.config.render.filter,
            is_linear: materials.is_linear(),
            settings,
            solids: [CASE, PLATE, PIVOT, ROCKER].map(|solid| Arc::new(solid) as Arc<dyn Solid>),
            painted: Mutex::default(),
        })
    }

    /// Its bodies at a [`place`], when a frame shows `dials`; none where there is no clock for it.
    pub fn objects(&self, place: &DAffine3, dials: Option<&Dials>) -> Vec<Object> {
        let Some([white, black]) = readings(&self.settings, dials) else {
            return Vec::new();
        };
        // From in front of the face, its own z lies to the right; White's dial is on White's side.
        let white_is_left = place.transform_vector3(DVec3::Z).z > 0.0;
        let [left, right] = if white_is_left { [white, black] } else { [black, white] };
        let tilt = match (left.is_running, right.is_running) {
            (true, false) => TILT,
            (false, true) => -TILT,
            _ => 0.0,
        };
        // The end on the left is that of −z.
        let rocker = translation(DVec3::Y * (CASE.max.y + ROCKER_HEIGHT)) * rotation_x(tilt);
        let shown = [left, right];
        let mut painted = self.painted.lock().unwrap_or_else(PoisonError::into_inner);
        let known = painted.iter().find(|(known, _)| *known == shown);
        let face = match known.map(|(_, face)| face.clone()) {
            Some(face) => face,
            None => {
                let face = self.face(&shown);
                painted.truncate(FACES - 1);
                painted.push_front((shown, face.clone()));
                face
            }
        };
        let still = DAffine3::IDENTITY;
        let parts = [
            (still, self.case.clone()),
            (still, face),
            (still, self.case.clone()),
            (rocker, self.brass.clone()),
        ];
        let bodies = self.solids.iter().zip(parts);
        let stand = |(solid, (within, surface)): (&Arc<dyn Solid>, _)| {
            Object::placed(solid.clone(), *place * within, surface)
        };
        bodies.map(stand).collect()
    }

    /// The painted face.
    fn face(&self, readings: &[Reading; 2]) -> Surface {
        let size = PLATE.max - PLATE.min;
        let finish = Finish {
            ambient: 0.45,
            diffuse: 0.55,
            specular: 0.2,
            shininess: 80.0,
            reflectivity: 0.0,
            transparency: 0.0,
        };
        let texture = Texture::Bitmap {
            bitmap: Arc::new(Bitmap::new(face::paint(size.z, size.y, readings), self.filter)),
            mapping: Mapping {
                kind: config::Mapping::Planar,
                origin: PLATE.min,
                u: DVec3::Z * size.z,
                v: DVec3::Y * size.y,
            },
            filter: self.filter,
            linear: self.is_linear,
        };
        // Without a coat: no glare hides what it shows.
        let coat = Coat { coat: 1.0, ..Coat::default() };
        Surface::Uniform(Material { finish, coat, texture })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions that cameras look along, on both sides and from above.
    const FORWARDS: [DVec3; 6] = [
        DVec3::new(0.3, -0.7, 0.64),
        DVec3::new(0.0, -0.5, 0.87),
        DVec3::new(-0.3, -0.7, -0.64),
        DVec3::new(-0.8, -0.6, 0.0),
        DVec3::new(1.0, 0.0, 0.0),
        DVec3::NEG_Y,
    ];

    #[test]
    fn the_face_is_seen_and_the_clock_is_off_the_board() {
        for forward in FORWARDS {
            let place = place(forward, 0.0);
            let face = place.transform_vector3(DVec3::X);
            assert!(face.dot(forward) < 1e-9, "{forward}: {face}");
            let nearest = corners(&place).map(|corner| (corner.x - MIDDLE.x).abs());
            let nearest = nearest.into_iter().fold(f64::INFINITY, f64::min);
            assert!((nearest - AWAY).abs() < 0.05, "{forward}: {nearest}");
            // It looks over the board.
            assert!(face.x * (MIDDLE.x - place.translation.x) > 0.0);
        }
    }

    #[test]
    fn the_rocker_stays_above_the_case_and_within_its_reach() {
        for tilt in [TILT, -TILT, 0.0] {
            let turned = ROCKER.bounds().transformed(&rotation_x(tilt));
            assert!(turned.min.y + ROCKER_HEIGHT > 0.0 && turned.max.y + ROCKER_HEIGHT < HIGHEST);
        }
    }
}
