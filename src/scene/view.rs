//! Named cameras: from which side, how high and through which lens they show the board, and what
//! of it they have to hold.

use glam::{DAffine3, DVec3};

use super::board;
use super::camera::Camera;
use super::measures::{MIDDLE, SQUARE};
use super::{clock, framing};
use crate::assets::PieceSet;
use crate::config::{self, Config, Orientation, Pose, View};
use crate::geometry::transform::{rotation_x, rotation_y, translation};
use crate::geometry::{Bounds, Solid};
use crate::timeline::{Bodies, ceiling, tray_reach};

/// What the pictures of a job may show besides positions at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// Whether moves are under way: captured pieces are carried over others to their place beside the board.
    pub moves: bool,
    /// Whether captured pieces stand beside the board.
    pub captured: bool,
    /// For how many columns of pieces beside the board there is to be room at least, at either side.
    pub columns: u32,
    /// How far the camera turns about the board at most, clockwise (below 0) and anticlockwise, in degrees.
    pub orbit: [f64; 2],
}

impl Reach {
    /// Whether there is to be room beside the board.
    pub fn is_wide(&self) -> bool {
        self.moves || self.captured || self.columns > 0
    }
}

/// A way to look at the board's middle.
struct Stand {
    /// Degrees above the board.
    elevation: f64,
    /// Degrees from White's side, anticlockwise as seen from above.
    azimuth: f64,
    /// Degrees that the longer side of the picture covers; nothing in parallel projection.
    field: Option<f64>,
}

/// From how far beside White's side the board is seen by default, in degrees.
const ASIDE: f64 = -25.0;

/// The turn from there to as far beside Black's side, past the a-file: what stands beside the h-file, and looks
/// over the board, is seen from both.
pub const TO_MOVER: f64 = -180.0 - 2.0 * ASIDE;

/// How much higher queens may be carried over kings than pictures have to hold, in world units: so rarely, and
/// hardly ever over the farthest rank, that all others should not be smaller for it.
const RARE: f64 = 1.4;

/// How much nearer to the board's middle a camera is that leans towards the piece which moves, as a share
/// of its way there.
const FOLLOWING: f64 = 0.22;

/// Degrees between the turns of an orbit that are looked at. Between two of them a corner reaches at
/// most 0.1 % farther from the axis than in one.
const ORBIT_STEP: f64 = 5.0;

/// The room that pieces take: a box that holds each of them where it was made, and where any of them move or
/// stand beside the board, the room of each.
#[derive(Clone, Copy)]
pub struct Room<'a> {
    pub man: Bounds,
    pub bodies: &'a Bodies,
}

/// The smallest box that is known to hold each piece of a set where it was made.
pub fn extent(set: &PieceSet) -> Bounds {
    set.men().iter().fold(Bounds::EMPTY, |all, man| all.union(man.bounds()))
}

/// The camera that `config` asks for, before any orbit, with pieces that take so much `room`; `None` when
/// what its lens is to show sharp lies behind it.
pub fn camera(config: &Config, room: Room, reach: Reach) -> Option<Camera> {
    let config::Camera { aperture, focus, .. } = config.camera;
    let pinhole = pinhole(config, room, reach);
    if aperture > 0.0 { pinhole.focused(aperture / 2.0, focus) } else { Some(pinhole) }
}

/// The same without its lens.
fn pinhole(config: &Config, room: Room, reach: Reach) -> Camera {
    let config::Camera { view, orientation, pose, path, .. } = &config.camera;
    let Some(Stand { elevation, azimuth, field }) = stand(*view) else {
        return posed(
            &match (view, path.first()) {
                (View::Free, _) => *pose,
                (View::Path, Some(key)) => key.pose,
                _ => Pose::default(),
            },
            *orientation,
        );
    };
    let turn = rotation_y(azimuth + half_turn(*orientation)) * rotation_x(elevation);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| turn.transform_vector3(axis));
    let points = points(config, room, reach, axes[2]);
    let aspect = f64::from(config.width) / f64::from(config.height);
    match field {
        Some(field) if *view == View::Follow => {
            framing::perspective(axes, field, &points, aspect).nearer(MIDDLE, FOLLOWING)
        }
        Some(field) => framing::perspective(axes, field, &points, aspect),
        None => framing::parallel(axes, &points, aspect),
    }
}

/// The camera of a pose, as it is given or half a turn from there.
pub fn posed(pose: &Pose, orientation: Orientation) -> Camera {
    let camera = Camera::free(pose);
    match orientation {
        Orientation::White => camera,
        Orientation::Black => camera.orbited(MIDDLE, half_turn(orientation)),
    }
}

fn half_turn(orientation: Orientation) -> f64 {
    match orientation {
        Orientation::White => 0.0,
        Orientation::Black => 180.0,
    }
}

/// Where the views that show the whole board stand.
fn stand(view: View) -> Option<Stand> {
    let (elevation, azimuth, field) = match view {
        View::White | View::Mover | View::Follow => (45.0, ASIDE, Some(26.0)),
        View::Black => (45.0, ASIDE + 180.0, Some(26.0)),
        View::Top => (90.0, 0.0, None),
        View::Above => (62.0, 0.0, Some(26.0)),
        View::Side => (35.0, 90.0, Some(26.0)),
        View::Player => (32.0, 0.0, Some(36.0)),
        View::Thesis | View::Free | View::Path => return None,
    };
    Some(Stand { elevation, azimuth, field })
}

/// The corners of all that pictures must hold: the board, the tallest piece on every square,
/// the clock where there is one, captured pieces beside the board and on their way there, for a camera
/// that looks along `forward`.
fn points(config: &Config, room: Room, reach: Reach, forward: DVec3) -> Vec<DVec3> {
    let Room { man, bodies } = room;
    // It may be turned whichever way.
    let radius =
        [man.min.x, man.min.z, man.max.x, man.max.z].map(f64::abs).into_iter().fold(0.0, f64::max);
    // So far from the middle to the right and away, between two heights.
    let block = |across: f64, away: f64, bottom: f64, top: f64| Bounds {
        min: MIDDLE + DVec3::new(-across, bottom, -away),
        max: MIDDLE + DVec3::new(across, top, away),
    };
    let outer = 3.5 * SQUARE + radius;
    let mut boxes = vec![board::bounds(), block(outer, outer, 0.0, man.max.y)];
    if reach.is_wide() {
        let [beside, along] = tray_reach(bodies, reach.columns);
        let [beside, along, table, capturable, ceiling] =
            [beside, along, bodies.table, bodies.tallest()[1], ceiling(bodies)]
                .map(|squares| squares * SQUARE);
        boxes.push(block(beside, along, table, table + capturable));
        if reach.moves {
            // Nearly all that is carried away stays below this over the board, and settles beside it.
            let most = ceiling + capturable - RARE;
            boxes.push(block(outer, outer, 0.0, most));
            boxes.push(block(beside, outer, 0.0, most - ceiling / 4.0));
        }
    }
    // A camera that has turned one way sees the board turned the other way.
    let [from, to] = reach.orbit.map(|degrees| degrees.clamp(-360.0, 360.0));
    let steps = ((to - from).min(360.0) / ORBIT_STEP).ceil();
    let turned = |step: u32| {
        let turn = rotation_y(-from - (to - from).min(360.0) * f64::from(step) / steps.max(1.0));
        translation(MIDDLE) * turn * translation(-MIDDLE)
    };
    let mut corners: Vec<DVec3> = boxes.iter().flat_map(Bounds::corners).collect();
    if config.clock.has_place() {
        corners.extend(clock::corners(&clock_place(config, forward, bodies, reach)));
    }
    (0..=steps as u32)
        .map(turned)
        .flat_map(|turn| corners.iter().map(move |corner| turn.transform_point3(*corner)))
        .collect()
}

/// Where the clock stands for a camera that looks along `forward`.
pub fn clock_place(config: &Config, forward: DVec3, bodies: &Bodies, reach: Reach) -> DAffine3 {
    // What goes to both players' sides sees it as well from each.
    let forward = if config.camera.view == View::Mover { forward * DVec3::X } else { forward };
    clock::place(
        forward,
        if reach.is_wide() { tray_reach(bodies, reach.columns)[0] * SQUARE } else { 0.0 },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{ShowClock, VIEWS};
    use crate::scene::Projection;
    use crate::timeline::{Envelope, SLICE};

    /// As tall and wide as a king.
    const MAN: Bounds = Bounds { min: DVec3::new(-1.5, 0.0, -1.5), max: DVec3::new(1.5, 6.7, 1.5) };

    fn room(bodies: &Bodies) -> Room<'_> {
        Room { man: MAN, bodies }
    }

    /// Of men that are all as tall and wide.
    fn bodies() -> Bodies {
        let man = Envelope::new(vec![0.36; (MAN.max.y / SQUARE / SLICE) as usize]);
        Bodies { envelopes: [(); 6].map(|()| man.clone()), edge: 4.55, table: -0.4 }
    }

    fn shows_all(view: View) -> bool {
        stand(view).is_some() && view != View::Follow
    }

    /// How far from the middle of its picture a point lies, 1 at the edges.
    fn beyond(camera: &Camera, point: DVec3, aspect: f64) -> f64 {
        let [right, up, forward] = camera.axes();
        let to = point - camera.position();
        let depth = match camera.projection() {
            Projection::Perspective => to.dot(forward),
            Projection::Parallel => 1.0,
        };
        let half = camera.width() / 2.0 * depth;
        (to.dot(right) / half).abs().max((to.dot(up) / half * aspect).abs())
    }

    fn config(view: View, orientation: Orientation, [width, height]: [u32; 2]) -> Config {
        let mut config = Config { width, height, ..Config::default() };
        (config.camera.view, config.camera.orientation) = (view, orientation);
        config
    }

    #[test]
    fn named_views_hold_all_that_there_is_and_see_the_clocks_face_at_any_aspect() {
        let bodies = bodies();
        let still = Reach::default();
        let film = Reach { moves: true, captured: true, ..still };
        // The frame's corner, the top of a king on a8 and on h1, the clock's corner, a queen that is
        // carried off over a king, one that stands beside the board.
        let points: [(Reach, bool, DVec3); 6] = [
            (still, false, DVec3::new(-4.2, -1.6, 32.2)),
            (still, false, DVec3::new(0.0, 6.67, 28.0)),
            (still, false, DVec3::new(28.0, 6.67, 0.0)),
            (still, true, DVec3::new(-1.5, 5.2, 6.0)),
            (film, false, DVec3::new(28.0, 12.0, 28.0)),
            (film, false, DVec3::new(-7.4, 4.3, -3.0)),
        ];
        for (name, view) in VIEWS.into_iter().filter(|(_, view)| shows_all(*view)) {
            for orientation in [Orientation::White, Orientation::Black] {
                for size in [[90, 160], [100, 100], [150, 100], [160, 90]] {
                    for (reach, clock, point) in points {
                        let mut config = config(view, orientation, size);
                        config.clock.show = if clock { ShowClock::Game } else { ShowClock::No };
                        let camera = pinhole(&config, room(&bodies), reach);
                        let place = clock_place(&config, camera.axes()[2], &bodies, reach);
                        let point = if clock { place.transform_point3(point) } else { point };
                        let face = place.transform_vector3(DVec3::X);
                        assert!(face.dot(camera.axes()[2]) < 1e-9, "{name}, {orientation:?}");
                        let aspect = f64::from(size[0]) / f64::from(size[1]);
                        let beyond = beyond(&camera, point, aspect);
                        assert!(beyond < 1.0, "{name}, {orientation:?}, {size:?}: {point}");
                    }
                }
            }
        }
    }

    /// The board's corners stand out most when it is seen by a diagonal.
    #[test]
    fn an_orbit_holds_the_board_all_the_way() {
        let bodies = bodies();
        let config = config(View::White, Orientation::White, [150, 100]);
        let at_rest = pinhole(&config, room(&bodies), Reach::default());
        let orbits =
            pinhole(&config, room(&bodies), Reach { orbit: [0.0, 90.0], ..Reach::default() });
        let most = |camera: &Camera| {
            let corner = |turn: u32| {
                let camera = camera.orbited(MIDDLE, f64::from(turn));
                let at = |x, z| beyond(&camera, DVec3::new(x, -1.6, z), 1.5);
                at(-4.2, -4.2).max(at(32.2, -4.2)).max(at(-4.2, 32.2)).max(at(32.2, 32.2))
            };
            (0..=90).map(corner).fold(0.0, f64::max)
        };
        assert!(most(&at_rest) > 1.0 && most(&orbits) < 1.0);
    }

    #[test]
    fn blacks_orientation_is_half_a_turn() {
        let bodies = bodies();
        for (name, view) in VIEWS {
            let [white, black] = [Orientation::White, Orientation::Black].map(|orientation| {
                pinhole(&config(view, orientation, [150, 100]), room(&bodies), Reach::default())
            });
            let turned = white.orbited(MIDDLE, 180.0);
            assert!(turned.position().distance(black.position()) < 1e-9, "{name}");
            for (a, b) in turned.axes().into_iter().zip(black.axes()) {
                assert!(a.distance(b) < 1e-9, "{name}");
            }
        }
    }
}
