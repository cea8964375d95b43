//! `[Camera]`: where pictures are seen from.

use glam::DVec3;
use serde::Serialize;

use super::ini::Section;
use super::keys::{Key, key, read_section};
use super::values::{Choice, Number, PLACE};
use super::{Fault, KeyFrame};

/// Where the camera stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Camera {
    pub view: View,
    pub orientation: Orientation,
    /// Width of the lens in world units, 0 for a pinhole: what is not as far as `focus` is blurred.
    /// (In the studio alone.)
    pub aperture: f64,
    /// World units: a point that is sharp.
    pub focus: DVec3,
    /// What counts where the view is [`View::Free`].
    #[serde(flatten)]
    pub pose: Pose,
    /// What counts where the view is [`View::Path`], in the order of time; then it is not empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub path: Vec<KeyFrame>,
}

/// The camera by name. All but `Follow` and the last three show the whole board, whatever the picture's
/// shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum View {
    /// From White's side, high enough and so far aside that no piece hides another.
    White,
    /// The same from Black's side.
    Black,
    /// Straight down, in parallel projection, rank 8 on top.
    Top,
    /// From high above White's side: a board that is nearly as high as wide.
    Above,
    /// From the side of the h-file.
    Side,
    /// As White sees the board.
    Player,
    /// As `White`, from the side of the player who is to move.
    Mover,
    /// Nearer than `White`, leaning towards the piece that moves.
    Follow,
    /// The thesis's, [`Pose::default`].
    Thesis,
    /// As [`Camera::pose`] says.
    Free,
    /// As [`Camera::path`] says.
    Path,
}

/// Views, by name.
pub const VIEWS: [(&str, View); 11] = [
    ("white", View::White),
    ("black", View::Black),
    ("top", View::Top),
    ("above", View::Above),
    ("side", View::Side),
    ("player", View::Player),
    ("mover", View::Mover),
    ("follow", View::Follow),
    ("thesis", View::Thesis),
    ("free", View::Free),
    ("path", View::Path),
];

/// From whose side of the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Orientation {
    /// As the view is made.
    White,
    /// Half a turn about the board's middle from there.
    Black,
}

/// Orientations, by name.
pub const ORIENTATIONS: [(&str, Orientation); 2] =
    [("white", Orientation::White), ("black", Orientation::Black)];

/// A free camera's place and what it looks at; the default is the thesis's.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pose {
    /// In world units.
    pub position: DVec3,
    /// In world units; another point than `position`.
    pub look_at: DVec3,
    /// In degrees, **twice** the true angle from the left edge of the picture to the right: the
    /// thesis halves it twice, and its files mean it so.
    pub fov: f64,
    /// Roll about the view axis in degrees; positive turns a ray from x towards y in camera
    /// space, so the picture turns clockwise.
    pub z_rot: f64,
}

impl Default for Pose {
    fn default() -> Pose {
        Pose {
            position: DVec3::new(45.0, 15.0, -30.0),
            look_at: DVec3::new(14.0, 0.0, 14.0),
            fov: 90.0,
            z_rot: 0.0,
        }
    }
}

pub const KEYS: [Key<Camera>; 8] = [
    key!("View", Camera, view: Choice(&VIEWS)),
    key!("Orientation", Camera, orientation: Choice(&ORIENTATIONS)),
    key!("Aperture", Camera, aperture: Number(0.0, 20.0)),
    key!("Focus", Camera, focus: PLACE).only("a camera with an Aperture", |c| c.aperture > 0.0),
    key!("Position", Camera, pose.position: PLACE).only(FREE, is_free),
    key!("LookAt", Camera, pose.look_at: PLACE).only(FREE, is_free),
    key!("FOV", Camera, pose.fov: FOV).only(FREE, is_free),
    key!("ZRot", Camera, pose.z_rot: ROLL).only(FREE, is_free),
];

/// The keys of a pose.
const POSE: [&str; 4] = ["Position", "LookAt", "FOV", "ZRot"];

/// Degrees of a field of view, twice the true angle, and of a roll.
pub const FOV: Number = Number(1.0, 340.0);
pub const ROLL: Number = Number(-360.0, 360.0);

const FREE: &str = "a camera with View=free";

fn is_free(camera: &Camera) -> bool {
    camera.view == View::Free
}

/// Reads the section over what `camera` is without it. One that gives a pose and no view, as the
/// thesis's files do, means a free camera. Gives whether it names a view.
pub fn read(section: &Section, camera: &mut Camera, faults: &mut Vec<Fault>) -> bool {
    let gives =
        |name: &str| section.entries.iter().any(|entry| entry.key.eq_ignore_ascii_case(name));
    if !gives("View") && POSE.iter().any(|name| gives(name)) {
        camera.view = View::Free;
    }
    read_section(section, &KEYS, camera, faults);
    if camera.pose.position.distance(camera.pose.look_at) < 1e-9 {
        faults.push(Fault {
            line: section.line,
            message: "the camera's LookAt is its own Position, expected another point".to_owned(),
        });
    }
    gives("View")
}
