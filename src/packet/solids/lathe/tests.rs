use glam::{DVec2, DVec3};

use super::super::oracle::{Chance, hold, lathes};
use crate::assets::{PieceSet, SetName, piece_set};
use crate::geometry::{ControlPoint, Interval, Lathe, Normals, Profile, Ray, Solid};

fn turned(points: &[(f64, f64)], steps: u32) -> Lathe {
    let corner = |&(u, v): &(f64, f64)| ControlPoint { at: DVec2::new(u, v), corner: steps == 0 };
    let profile = Profile::new(points.iter().map(corner).collect()).unwrap();
    Lathe::new(&profile, steps, Normals::Smooth).unwrap()
}

/// Shapes of all kinds: cylinder, cone, double cone, ring, bowl, needle, and one far off the origin.
fn shapes() -> Vec<Lathe> {
    vec![
        turned(&[(0.0, 0.0), (1.0, 0.0), (1.0, 3.86), (0.0, 3.86)], 0),
        turned(&[(0.0, 0.0), (1.5, 0.0), (0.0, 4.0)], 0),
        turned(&[(0.0, -1.0), (1.0, 0.0), (0.0, 1.0)], 0),
        turned(&[(0.0, 0.5), (0.7, 0.5), (0.7, 0.0), (1.2, 0.0), (1.2, 0.6), (0.0, 0.6)], 0),
        turned(&[(0.0, 0.1), (1.0, 0.2), (1.4, 1.5), (1.3, 1.5), (0.8, 0.3), (0.0, 0.25)], 4),
        turned(&[(0.0, 0.0), (0.2, 0.1), (0.05, 9.0), (0.0, 9.1)], 2),
        turned(&[(0.0, 8.0), (1.3, 8.001), (0.9, 9.0), (0.0, 9.001)], 3),
    ]
}

/// Rays of all kinds at a body of this size, from where cameras are and from the surface itself.
fn questions(lathe: &Lathe, chance: &mut Chance, count: usize) -> Vec<(Ray, f32, f32)> {
    let bounds = lathe.bounds();
    let size = bounds.max.abs().max(bounds.min.abs()).max_element();
    let radius = bounds.max.x;
    let segments = lathe.segments();
    let ring = |chance: &mut Chance, at: DVec2| {
        let (sin, cos) = libm::sincos(chance.between(0.0, 6.3));
        DVec3::new(at.x * cos, at.y, at.x * sin)
    };
    let within = |chance: &mut Chance| {
        let spread = 1.2 * radius;
        DVec3::new(
            chance.between(-spread, spread),
            chance.between(bounds.min.y - 0.1 * size, bounds.max.y + 0.1 * size),
            chance.between(-spread, spread),
        )
    };
    let mut questions = Vec::new();
    while questions.len() < count {
        let from = within(chance) + chance.direction() * chance.between(3.0, 35.0) * size;
        let segment = &segments[(chance.next() * segments.len() as f64) as usize];
        let towards = |to: DVec3| (to - from).normalize();
        let level = |v: DVec3| DVec3::new(v.x, 0.0, v.z).normalize_or(DVec3::X);
        let (origin, direction) = match questions.len() % 10 {
            0 | 1 => (from, towards(within(chance))),
            // At joints, seen from anywhere.
            2 | 3 => (from, towards(ring(chance, segment.from))),
            4 => (from, towards(DVec3::Y * within(chance).y)),
            // From straight above, or nearly so; level, or nearly so.
            5 => (within(chance) + DVec3::Y * 20.0 * size, DVec3::NEG_Y),
            6 => {
                let off = 10.0_f64.powf(chance.between(-12.0, -1.0));
                let down = (DVec3::NEG_Y + chance.direction() * off).normalize();
                (within(chance) - down * 20.0 * size, down)
            }
            7 => {
                let along = level(chance.direction());
                let heights = [segment.from.y, within(chance).y];
                let height = heights[usize::from(chance.next() < 0.5)];
                let at = within(chance).with_y(height);
                (at - along * chance.between(0.0, 30.0) * size, along)
            }
            8 => {
                let slope = 10.0_f64.powf(chance.between(-9.0, -1.0));
                let along = (level(chance.direction()) + DVec3::Y * slope).normalize();
                (within(chance) - along * 20.0 * size, along)
            }
            // From the surface.
            _ => {
                let ray = Ray { origin: from, direction: towards(within(chance)) };
                let Some(hit) = lathe.nearest(&ray, Interval::AHEAD) else { continue };
                let side = if hit.normal.dot(ray.direction) < 0.0 { 1.0 } else { -1.0 };
                let origin = ray.at(hit.t) + hit.normal * side * 3e-5 * size;
                (origin, chance.direction())
            }
        };
        let scale = [1.0, 0.17, 1.3][(chance.next() * 3.0) as usize];
        let far =
            if chance.next() < 0.8 { f64::INFINITY } else { chance.between(0.0, 40.0) * size };
        questions.push((Ray { origin, direction: direction * scale }, 0.0, far as f32));
    }
    questions
}

fn held(name: &str, lathe: &Lathe, chance: &mut Chance, count: usize) {
    let bounds = lathe.bounds();
    let size = bounds.max.abs().max(bounds.min.abs()).max_element();
    let questions = questions(lathe, chance, count);
    let slack = |ray: &Ray| 2e-6 * size + 3e-7 * ray.origin.length();
    let met = hold(name, lathe, &questions, slack);
    assert!(met > count / 6, "{name}: {met} are met");
}

fn staunton() -> PieceSet {
    piece_set(&SetName::Staunton, 4, Normals::Smooth).unwrap()
}

#[test]
fn lathes_are_met_as_the_scalar_ones_are() {
    let mut chance = Chance(1);
    for (index, lathe) in shapes().iter().enumerate() {
        held(&format!("shape {index}"), lathe, &mut chance, 20_000);
    }
}

#[test]
fn pieces_are_met_as_the_scalar_ones_are() {
    let mut chance = Chance(2);
    let set = staunton();
    for (index, piece) in set.men().into_iter().enumerate() {
        let mut found = Vec::new();
        lathes(piece, &mut found);
        for lathe in found {
            held(&format!("piece {index}"), lathe, &mut chance, 20_000);
        }
    }
}
