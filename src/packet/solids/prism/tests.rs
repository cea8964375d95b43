use glam::{DVec2, DVec3};

use super::super::Solid as Packet;
use super::super::oracle::{Chance, ask_each, hold};
use crate::geometry::{ControlPoint, Interval, Normals, Outline, Prism, Ray, Solid, Spans};

fn prism(points: &[(f64, f64)], steps: u32, [back, front]: [f64; 2]) -> Prism {
    let control = points
        .iter()
        .map(|&(x, y)| ControlPoint { at: DVec2::new(x, y), corner: steps == 0 || x > 1.0 });
    let outline = Outline::new(control.collect()).unwrap();
    Prism::new(&outline, steps, Normals::Smooth, back, front).unwrap()
}

/// Shapes of all kinds: angular, rounded, concave, a long bar with a flat top, a thin sheet.
fn shapes() -> Vec<Prism> {
    let lump = [(-1.5, 0.2), (0.4, -0.5), (1.6, 0.4), (0.5, 1.0), (1.2, 3.0), (-0.8, 2.0)];
    let leaf = [(-2.0, 0.2), (0.1, -1.0), (2.5, 0.3), (1.0, 1.5), (1.2, 4.0), (-1.0, 3.0)];
    let bar = [(-18.0, -1.5), (18.0, -1.5), (18.0, -1.3), (17.4, 0.0), (-17.4, 0.0), (-18.0, -1.3)];
    vec![
        prism(&lump, 0, [-0.7, 1.1]),
        prism(&lump, 3, [-0.7, 1.1]),
        prism(&leaf, 2, [-1.0, 1.0]),
        prism(&bar, 0, [-19.0, 19.0]),
        prism(&leaf, 4, [3.0, 3.01]),
    ]
}

/// Rays of all kinds at a prism, from where cameras are and from the surface itself.
fn questions(prism: &Prism, chance: &mut Chance, count: usize) -> Vec<(Ray, f32, f32)> {
    let bounds = prism.bounds();
    let (middle, half) = ((bounds.min + bounds.max) / 2.0, (bounds.max - bounds.min) / 2.0);
    let size = half.max_element();
    let segments = prism.segments();
    let within = |chance: &mut Chance| {
        middle + DVec3::from([(); 3].map(|()| chance.between(-1.2, 1.2))) * half
    };
    let mut questions = Vec::new();
    while questions.len() < count {
        let from = within(chance) + chance.direction() * chance.between(1.0, 20.0) * size;
        let segment = &segments[(chance.next() * segments.len() as f64) as usize];
        let z = within(chance).z.clamp(bounds.min.z, bounds.max.z);
        let towards = |to: DVec3| (to - from).normalize();
        let (origin, direction) = match questions.len() % 9 {
            0 | 1 => (from, towards(within(chance))),
            // At edges between walls, and between walls and lids.
            2 => (from, towards(segment.from.extend(z))),
            3 => (from, towards(segment.from.lerp(segment.to, chance.next()).extend(bounds.min.z))),
            // Along z, or nearly so; along a lid, or nearly so.
            4 => (within(chance) - DVec3::Z * 5.0 * size, DVec3::Z),
            5 => {
                let off = 10.0_f64.powf(chance.between(-13.0, -1.0));
                let along = (DVec3::NEG_Z + chance.direction() * off).normalize();
                (within(chance) - along * 5.0 * size, along)
            }
            6 => {
                let along = chance.direction().with_z(0.0).normalize_or(DVec3::X);
                (within(chance) - along * 5.0 * size, along)
            }
            // Nearly within a wall.
            7 => {
                let turn = 10.0_f64.powf(chance.between(-3.0, -1.0));
                let (sin, cos) = libm::sincos(if chance.next() < 0.5 { turn } else { -turn });
                let along = DVec2::new(cos, sin).rotate((segment.to - segment.from).normalize());
                let at = segment.from.lerp(segment.to, chance.next());
                let before = at - along * chance.between(1.0, 7.0);
                let slope = chance.between(-0.3, 0.3);
                (before.extend(z), along.extend(slope).normalize())
            }
            // From the surface.
            _ => {
                let ray = Ray { origin: from, direction: towards(within(chance)) };
                let Some(hit) = prism.nearest(&ray, Interval::AHEAD) else { continue };
                let side = if hit.normal.dot(ray.direction) < 0.0 { 1.0 } else { -1.0 };
                (ray.at(hit.t) + hit.normal * side * 1e-4 * size.max(1.0), chance.direction())
            }
        };
        let scale = [1.0, 0.17, 1.3][(chance.next() * 3.0) as usize];
        let far =
            if chance.next() < 0.8 { f64::INFINITY } else { chance.between(0.0, 25.0) * size };
        questions.push((Ray { origin, direction: direction * scale }, 0.0, far as f32));
    }
    questions
}

#[test]
fn prisms_are_met_as_the_scalar_ones_are() {
    let mut chance = Chance(3);
    for (index, prism) in shapes().iter().enumerate() {
        let bounds = prism.bounds();
        let size = bounds.max.abs().max(bounds.min.abs()).max_element();
        let questions = questions(prism, &mut chance, 20_000);
        let slack = |ray: &Ray| 2e-6 * size + 3e-7 * ray.origin.length();
        let met = hold(&format!("prism {index}"), prism, &questions, slack);
        assert!(met > 2000, "prism {index}: {met} are met");
    }
}

/// A ray within the plane of a wall meets the prism where the prism is, and nowhere else.
#[test]
fn rays_within_a_wall_stay_on_it() {
    let prism = &shapes()[2];
    let mut questions = Vec::new();
    for segment in prism.segments() {
        for step in 0..200 {
            let along = (segment.to - segment.from).normalize();
            let before = segment.from - along * (1.0 + 0.013 * f64::from(step));
            let direction = along.extend(0.004 * f64::from(step)).normalize();
            questions.push((Ray { origin: before.extend(-3.0), direction }, 0.0, f32::INFINITY));
        }
    }
    let found = ask_each(&Packet::new(prism), &questions);
    let (low, high) = (prism.bounds().min - 1e-4, prism.bounds().max + 1e-4);
    for ((ray, ..), found) in questions.iter().zip(found) {
        let point = ray.at(f64::from(found.t));
        assert!(found.t == f32::INFINITY || point.clamp(low, high) == point, "{point}");
    }
}

/// Asked again from each crossing on, a prism tells all of them, the same whatever lies before.
#[test]
fn crossings_come_one_after_the_other() {
    let prism = &shapes()[2];
    let mut chance = Chance(4);
    let packet = Packet::new(prism);
    let rays: Vec<Ray> =
        questions(prism, &mut chance, 900).into_iter().map(|(ray, ..)| ray).collect();
    let mut open: Vec<(Ray, f32, f32)> =
        rays.iter().map(|ray| (*ray, 0.0, f32::INFINITY)).collect();
    let mut crossings = 0_usize;
    while !open.is_empty() {
        let found = ask_each(&packet, &open);
        let mut next = Vec::new();
        for ((ray, after, before), found) in open.into_iter().zip(found) {
            assert!(found.t > after && (found.t < before || found.t == f32::INFINITY));
            if found.t < f32::INFINITY {
                crossings += 1;
                next.push((ray, found.t, f32::INFINITY));
            }
        }
        open = next;
    }
    let expected: usize = rays
        .iter()
        .map(|ray| {
            let mut spans = Spans::new();
            prism.spans(ray, &mut spans);
            let ends = spans.iter().flat_map(|span| [span.enter.t, span.exit.t]);
            ends.filter(|t| *t > 0.0).count()
        })
        .sum();
    assert!(crossings.abs_diff(expected) <= 4, "{crossings} crossings, expected {expected}");
}
