//! The thesis's set: plain turnings, the king with a cross, the knight cut out of a box.
//!
//! Every piece is drawn in units of its own height. Heights are those of FIDE's equipment
//! standard, in millimetres, beside a square of 57 mm; bases are 43 to 50 % of the height. The two
//! widest bases, king and queen, are 2.78 units together, so that a piece that moves diagonally
//! (it passes the centres beside its way at 2.83 units) touches none.

use glam::{DAffine3, DVec2, DVec3};

use super::PieceSet;
use crate::geometry::transform::{rotation_y, rotation_z, scale, translation};
use crate::geometry::{ControlPoint, Csg, Cuboid, CurveError, Lathe, Normals, Profile, Sphere};

/// World units of a millimetre: a square is 57 mm and 4 units wide.
const MILLIMETRE: f64 = 4.0 / 57.0;

/// A control point (u, v); the third says whether it is a corner.
type Point = (f64, f64, bool);

const KING: [Point; 16] = [
    (0.0, 0.0, true),
    (0.216, 0.0, true),
    (0.216, 0.075, false),
    (0.15, 0.1, true),
    (0.13, 0.17, false),
    (0.078, 0.3, false),
    (0.066, 0.5, false),
    (0.076, 0.6, true),
    (0.13, 0.612, true),
    (0.13, 0.642, true),
    (0.08, 0.66, true),
    (0.078, 0.73, false),
    (0.128, 0.85, true),
    (0.1, 0.885, false),
    (0.03, 0.905, true),
    (0.0, 0.905, true),
];

const QUEEN: [Point; 18] = [
    (0.0, 0.0, true),
    (0.225, 0.0, true),
    (0.225, 0.08, false),
    (0.155, 0.105, true),
    (0.135, 0.18, false),
    (0.078, 0.32, false),
    (0.066, 0.52, false),
    (0.076, 0.62, true),
    (0.132, 0.632, true),
    (0.132, 0.662, true),
    (0.082, 0.68, true),
    (0.078, 0.77, false),
    (0.14, 0.9, true),
    (0.118, 0.905, true),
    (0.03, 0.88, true),
    (0.068, 0.92, false),
    (0.068, 1.0, false),
    (0.0, 1.0, true),
];

const BISHOP: [Point; 16] = [
    (0.0, 0.0, true),
    (0.244, 0.0, true),
    (0.244, 0.095, false),
    (0.17, 0.125, true),
    (0.145, 0.2, false),
    (0.085, 0.34, false),
    (0.074, 0.48, false),
    (0.086, 0.56, true),
    (0.15, 0.572, true),
    (0.15, 0.605, true),
    (0.085, 0.622, true),
    (0.17, 0.71, false),
    (0.12, 0.86, false),
    (0.024, 0.935, true),
    (0.068, 0.965, false),
    (0.0, 1.0, true),
];

const ROOK: [Point; 14] = [
    (0.0, 0.0, true),
    (0.25, 0.0, true),
    (0.25, 0.12, false),
    (0.19, 0.155, true),
    (0.165, 0.25, false),
    (0.14, 0.42, false),
    (0.145, 0.64, true),
    (0.19, 0.67, true),
    (0.19, 0.71, true),
    (0.215, 0.73, true),
    (0.222, 1.0, true),
    (0.155, 1.0, true),
    (0.15, 0.87, true),
    (0.0, 0.87, true),
];

const PAWN: [Point; 14] = [
    (0.0, 0.0, true),
    (0.25, 0.0, true),
    (0.25, 0.125, false),
    (0.185, 0.16, true),
    (0.155, 0.25, false),
    (0.095, 0.42, false),
    (0.085, 0.585, true),
    (0.16, 0.6, true),
    (0.16, 0.64, true),
    (0.09, 0.66, true),
    (0.185, 0.7, false),
    (0.205, 0.86, false),
    (0.14, 1.0, false),
    (0.0, 1.0, true),
];

const KNIGHT_BASE: [Point; 9] = [
    (0.0, 0.0, true),
    (0.25, 0.0, true),
    (0.25, 0.11, false),
    (0.19, 0.145, true),
    (0.19, 0.17, false),
    (0.225, 0.185, false),
    (0.235, 0.21, false),
    (0.235, 0.235, true),
    (0.0, 0.235, true),
];

/// Builds the set; curves get `subdivisions` steps (4 in the thesis, 2 where speed counts more).
///
/// # Errors
/// When a profile is none; the built-in ones are tested.
pub fn thesis_set(subdivisions: u32, normals: Normals) -> Result<PieceSet, CurveError> {
    let turned = |points: &[Point]| turned(points, subdivisions, normals);
    Ok(PieceSet {
        pawn: tall(50.0, turned(&PAWN)?),
        knight: tall(60.0, turned(&KNIGHT_BASE)?.or(horse())),
        bishop: tall(70.0, turned(&BISHOP)?.minus(cut())),
        rook: tall(55.0, crenels().into_iter().fold(turned(&ROOK)?, Csg::minus)),
        queen: tall(85.0, notches().fold(turned(&QUEEN)?, Csg::minus)),
        king: tall(95.0, turned(&KING)?.or(cross())),
    })
}

/// A piece of height 1 at its true height, in millimetres.
fn tall(millimetres: f64, piece: Csg) -> Csg {
    piece.placed(scale(millimetres * MILLIMETRE))
}

fn turned(points: &[Point], subdivisions: u32, normals: Normals) -> Result<Csg, CurveError> {
    let control =
        points.iter().map(|&(u, v, corner)| ControlPoint { at: DVec2::new(u, v), corner });
    let profile = Profile::new(control.collect())?;
    Ok(Csg::leaf(Lathe::new(&profile, subdivisions, normals)?))
}

/// A box by half-sizes and middle, with a turn about its middle.
fn block(half: [f64; 3], middle: [f64; 3], turn: DAffine3) -> Csg {
    let place = translation(DVec3::from(middle)) * turn;
    Csg::leaf(Cuboid::centered(DVec3::from(half))).placed(place)
}

fn upright(half: [f64; 3], middle: [f64; 3]) -> Csg {
    block(half, middle, DAffine3::IDENTITY)
}

fn cross() -> Csg {
    let stem = upright([0.019, 0.06, 0.019], [0.0, 0.94, 0.0]);
    stem.or(upright([0.054, 0.019, 0.019], [0.0, 0.95, 0.0]))
}

/// The dents between the points of the queen's coronet.
fn notches() -> impl Iterator<Item = Csg> {
    (0..8).map(|index| {
        let spot = rotation_y(45.0 * f64::from(index)).transform_point3(DVec3::X * 0.136);
        Csg::leaf(Sphere { center: spot + DVec3::Y * 0.908, radius: 0.034 })
    })
}

/// The slot in the bishop's mitre.
fn cut() -> Csg {
    block([0.014, 0.15, 0.3], [0.105, 0.83, 0.0], rotation_z(-35.0))
}

/// The gaps between the rook's merlons: three slots through the axis.
fn crenels() -> [Csg; 3] {
    [0.0, 60.0, 120.0]
        .map(|degrees| block([0.3, 0.08, 0.045], [0.0, 0.985, 0.0], rotation_y(degrees)))
}

/// The knight's head and neck, facing +x, cut out of one box as in the thesis.
fn horse() -> Csg {
    let body = upright([0.24, 0.385, 0.12], [0.045, 0.615, 0.0]);
    // Under the jaw and before the throat: beyond both lines at once.
    let throat = beyond([0.075, 0.6], -104.0).and(beyond([0.075, 0.6], 22.0));
    let cuts = [
        // Forehead and nose, muzzle, chin.
        beyond([0.07, 1.0], 40.0),
        beyond([0.285, 0.7], -16.0),
        throat,
        // Crest, nape and back.
        beyond([-0.04, 1.0], 108.0),
        beyond([-0.13, 0.94], 138.0),
        beyond([-0.19, 0.8], 164.0),
        upright([0.09, 0.05, 0.032], [0.0, 1.0, 0.0]),
        block([0.1, 0.009, 0.2], [0.3, 0.63, 0.0], rotation_z(18.0)),
        // The sides, narrower to the nose and to the mane.
        beside(0.06, 75.0),
        beside(-0.08, 106.0),
        eye(1.0),
        eye(-1.0),
    ];
    cuts.into_iter().fold(body, Csg::minus)
}

/// A box large enough to be all that lies beyond a line of the side view: through `point` (x, y),
/// with its outward normal at `degrees` from x towards y.
fn beyond(point: [f64; 2], degrees: f64) -> Csg {
    let turn = rotation_z(degrees);
    let middle = DVec3::new(point[0], point[1], 0.0) + turn.transform_vector3(DVec3::X);
    block([1.0, 1.0, 1.0], middle.into(), turn)
}

/// What is cut from both sides so that the body narrows away from `x`: `degrees` is the turn of
/// the wall's outward normal from x towards z.
fn beside(x: f64, degrees: f64) -> Csg {
    let wall = |side: f64| {
        let turn = rotation_y(side * degrees);
        let middle = DVec3::new(x, 0.0, side * 0.112) + turn.transform_vector3(DVec3::X);
        block([1.0, 2.0, 1.0], middle.into(), turn)
    };
    wall(1.0).or(wall(-1.0))
}

fn eye(side: f64) -> Csg {
    let socket = Csg::leaf(Sphere { center: DVec3::ZERO, radius: 0.028 });
    socket.placed(translation(DVec3::new(0.085, 0.85, side * 0.11)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Bounds, Interval, Ray, Solid};

    /// The highest point that rays from above find, in millimetres.
    fn millimetres(piece: &Csg) -> f64 {
        let steps = -40..=40;
        let grid = steps.clone().flat_map(|x| steps.clone().map(move |z| (x, z)));
        let hits = grid.filter_map(|(x, z)| {
            let origin = DVec3::new(f64::from(x), 250.0, f64::from(z)) * 0.04;
            let ray = Ray { origin, direction: DVec3::NEG_Y };
            piece.nearest(&ray, Interval::AHEAD).map(|hit| ray.at(hit.t).y)
        });
        hits.fold(0.0, f64::max) / MILLIMETRE
    }

    /// Diameter of what stands on the board, in world units.
    fn base(piece: &Csg) -> f64 {
        let Bounds { min, max } = piece.bounds();
        max.z - min.z
    }

    /// The farthest that anything reaches from the axis along x or z: a knight's muzzle too.
    fn reach(piece: &Csg) -> f64 {
        let Bounds { min, max } = piece.bounds();
        max.x.max(-min.x).max(max.z).max(-min.z)
    }

    fn all(set: &PieceSet) -> [&Csg; 6] {
        [&set.king, &set.queen, &set.bishop, &set.knight, &set.rook, &set.pawn]
    }

    #[test]
    fn heights_and_bases_follow_the_equipment_standard() {
        let set = thesis_set(4, Normals::Flat).unwrap();
        for (piece, height) in all(&set).into_iter().zip([95.0, 85.0, 70.0, 60.0, 55.0, 50.0]) {
            let found = millimetres(piece);
            assert!((found - height).abs() < 0.01 * height, "{found} is not {height}");
            let share = base(piece) / (height * MILLIMETRE);
            assert!((0.40..=0.51).contains(&share), "{height} mm: base {share}");
        }
        let share_of_square = base(&set.king) / 4.0;
        assert!((0.7..0.8).contains(&share_of_square), "{share_of_square}");
    }

    #[test]
    fn a_diagonal_mover_clears_any_two_neighbours() {
        let set = thesis_set(4, Normals::Flat).unwrap();
        let mut reaches = all(&set).map(reach);
        reaches.sort_by(f64::total_cmp);
        let widest = reaches[4] + reaches[5];
        assert!(widest < 8.0_f64.sqrt(), "{widest}");
    }
}
