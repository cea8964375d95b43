//! From a frame of the game to the bodies of a scene.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use super::board::board;
use super::bodies::bodies;
use super::clock::Clock;
use super::facing::Facing;
use super::materials::{MaterialError, Materials};
use super::measures::{MIDDLE, SQUARE};
use super::models::model;
use super::noise::hash;
use super::paint::Paints;
use super::{Camera, Cells, Object, Reach, Readers, Rgb, Room, Scene, Side, Surface, view};
use crate::assets::Assets;
use crate::config::{self, Config, Light, Shading, View};
use crate::geometry::transform::{scale, translation};
use crate::geometry::{Bounds, Placed};
use crate::notation::{Color, Piece, Role, Square};
use crate::timeline::{Bodies, Frame, Gaze, Mover, Spot};

/// A quarter of the least step that a picture can show. (Each surface of glass splits a ray in
/// two; most of them are not worth following.)
const MIN_WEIGHT: f64 = 1.0 / 1024.0;

/// The felt under a piece. Without it a foot of glass and the square beneath would be the same
/// plane, and rounding would choose between them pixel by pixel.
const FELT: f64 = 0.005;

/// Room for rounding round pieces in their cells.
const MARGIN: f64 = 0.01;

/// How far a camera leans, as a share of the way from the board's middle to what it leans towards.
const LEAN: f64 = 0.35;

/// Why a stage cannot be set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StageError {
    #[error(transparent)]
    Material(#[from] MaterialError),
    #[error("the camera's Focus is not before it, expected a point that it sees")]
    FocusBehind,
}

/// More columns of pieces beside the board than this are not cared for: all pieces in hand that a game can have
/// take fewer.
const MOST_COLUMNS: u32 = 8;

/// The camera, and where the clock stands, for pictures that have to show as much.
struct Outlook {
    camera: Camera,
    clock: DAffine3,
}

/// What stays the same from frame to frame: the set, all that is no piece, lights, camera and
/// background.
pub struct Stage {
    /// By role and colour, as they are turned, in the middle of the first square.
    pieces: [[Placed; 2]; 6],
    /// Of White's pieces, and of Black's.
    surfaces: [Surface; 2],
    /// The board, its squares first, and the extra models.
    fixed: Vec<Object>,
    clock: Option<Clock>,
    paints: Paints,
    lights: Vec<Light>,
    /// By how many columns of pieces beside the board frames have to show.
    outlooks: Vec<Outlook>,
    bodies: Bodies,
    lens: config::Camera,
    background: Option<Rgb>,
    room: Option<Room>,
    cells: Cells,
    max_depth: u32,
    max_distance: f64,
    snell_index: f64,
}

impl Stage {
    /// Sets the stage as `config` says, with `assets` that were loaded for it, for frames that reach as
    /// far as `reach`.
    ///
    /// # Errors
    /// When `config` names a material that it does not have, or `assets` lack a picture (neither
    /// happens with settings that were read from a file); when the camera's focus lies behind it.
    pub fn new(config: &Config, assets: &Assets, reach: Reach) -> Result<Stage, StageError> {
        let materials = Materials { config, bitmaps: &assets.bitmaps };
        let scheme = config.scheme();
        let set = assets.set.clone();
        let bodies = bodies(&set);
        let man = view::extent(&set);
        let room = view::Room { man, bodies: &bodies };
        let outlook = |columns: u32| {
            let reach = Reach { columns, ..reach };
            let camera = view::camera(config, room, reach).ok_or(StageError::FocusBehind)?;
            let clock = view::clock_place(config, camera.axes()[2], &bodies, reach);
            Ok(Outlook { camera, clock })
        };
        let outlooks: Vec<Outlook> =
            (0..=MOST_COLUMNS).map(outlook).collect::<Result<_, StageError>>()?;
        // All of them look the same way.
        let camera = outlooks[0].camera;
        let near = Side::near(&camera);
        // A camera that goes to both players reads coordinates from both sides.
        let both = config.camera.view == View::Mover;
        let mut fixed = board(&scheme, &materials, Readers { near, both })?;
        let has_clock = config.clock.has_place();
        let clock = has_clock.then(|| Clock::new(&materials));
        for settings in &config.models {
            fixed.push(model(settings, &materials)?);
        }
        let facing = Facing::new(config.knights, &camera);
        Ok(Stage {
            pieces: Role::ALL.map(|role| {
                let solid = Arc::new(set.men()[role as usize - 1].clone());
                let turned =
                    |color| facing.turn(Piece { role, color }) * translation(DVec3::Y * FELT);
                [Color::White, Color::Black].map(|color| Placed::new(solid.clone(), turned(color)))
            }),
            surfaces: [materials.surface(&scheme.white)?, materials.surface(&scheme.black)?],
            fixed,
            clock: clock.transpose()?,
            paints: Paints::new(&materials),
            lights: config.lights.clone(),
            room: (config.render.shading == Shading::Studio).then(|| {
                let turn = if config.room.turns { camera.azimuth() } else { 0.0 };
                Room::new(&config.room, &config.lights, turn)
            }),
            outlooks,
            bodies,
            lens: config.camera.clone(),
            background: scheme.background,
            max_depth: config.render.max_depth,
            cells: cells(man),
            max_distance: config.render.max_distance,
            snell_index: config.snell_index,
        })
    }

    /// What `frame` shows.
    pub fn scene(&self, frame: &Frame) -> Scene {
        let standing = frame.placement.iter().map(|(square, piece)| {
            self.object(piece, frame.identities.get(square), Spot::on(square), 1.0)
        });
        let loose = frame.movers.iter().chain(&frame.taken).map(|mover| self.loose(mover));
        // By where they are: then those that stay keep their order when others come and go.
        let mut pieces: Vec<Object> = standing.chain(loose).collect();
        pieces.sort_by(|one, other| {
            let [one, other] = [one, other].map(|piece| piece.body.transform().translation);
            let nearer = one.z.total_cmp(&other.z).then(one.x.total_cmp(&other.x));
            nearer.then(one.y.total_cmp(&other.y))
        });
        let mut fixed = self.fixed.clone();
        if let Some(squares) = fixed.first_mut() {
            self.paints.paint(squares, &frame.marks, &frame.placement);
        }
        let outlook = &self.outlooks[frame.columns.min(MOST_COLUMNS) as usize];
        let clock = self.clock.iter();
        let clock = clock.flat_map(|clock| clock.objects(&outlook.clock, frame.dials.as_ref()));
        fixed.extend(clock);
        Scene {
            objects: fixed.into_iter().chain(pieces).collect(),
            cells: self.cells,
            lights: self.lights.clone(),
            camera: self.camera(outlook, &frame.gaze),
            background: self.background,
            room: self.room.clone(),
            max_depth: self.max_depth,
            min_weight: MIN_WEIGHT,
            max_distance: self.max_distance,
            snell_index: self.snell_index,
        }
    }

    /// The room that pieces and board take.
    pub fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// The camera with a gaze.
    fn camera(&self, outlook: &Outlook, gaze: &Gaze) -> Camera {
        let Gaze { orbit, lean: [across, away], pose } = gaze;
        let camera = match pose {
            // A lens that shows nothing sharp ahead is none.
            Some(pose) => {
                let config::Camera { aperture, focus, orientation, .. } = self.lens;
                let pinhole = view::posed(pose, orientation);
                pinhole.focused(aperture / 2.0, focus).unwrap_or(pinhole)
            }
            None => outlook.camera,
        };
        let lean = DVec3::new(*across, 0.0, *away) * (LEAN * SQUARE);
        camera.moved(lean).orbited(MIDDLE, *orbit)
    }

    fn loose(&self, Mover { piece, identity, spot, size }: &Mover) -> Object {
        self.object(*piece, *identity, *spot, *size)
    }

    /// A piece on its spot, as large as the share `size` of it. Its grain is that of its identity; in the
    /// thesis all are of one tree.
    fn object(&self, piece: Piece, identity: Square, spot: Spot, size: f64) -> Object {
        let color = match piece.color {
            Color::White => 0,
            Color::Black => 1,
        };
        // Roles are numbered from 1, the pawn's.
        let turned = &self.pieces[piece.role as usize - 1][color];
        let place = DVec3::new(spot.file, spot.height, spot.rank) * SQUARE;
        let body = if size == 1.0 {
            turned.moved(place)
        } else {
            let place = translation(place) * turned.transform() * scale(size);
            Placed::new(turned.shared().clone(), place)
        };
        let seed = if self.room.is_some() { hash(1, identity.to_usize() as u64) } else { 0 };
        let surface = self.surfaces[color].clone();
        Object { body, surface, seed, paint: None, roof: None }
    }
}

/// The squares, as cells for pieces of which each lies within `man`.
fn cells(man: Bounds) -> Cells {
    let reach = [man.min.x, man.min.z, man.max.x, man.max.z].map(f64::abs);
    let reach = reach.into_iter().fold(0.0, f64::max) + MARGIN;
    Cells {
        origin: DVec2::ZERO,
        side: SQUARE,
        // Wider ones are found without cells.
        reach: reach.min(SQUARE / 2.0),
        heights: [man.min.y - MARGIN, man.max.y + FELT + MARGIN],
    }
}
