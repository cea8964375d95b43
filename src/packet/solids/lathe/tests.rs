use glam::{DVec2, DVec3};

use super::super::Solid as Packet;
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
        let far = if chance.next() < 0.8 { f64::INFINITY } else { chance.between(0.0, 40.0) * size };
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

#[test]
#[ignore]
fn speed() {
    use crate::lanes::{F32x8, Mask8, Simd, Task, Vec3x8, dispatch};
    use crate::packet::Rays;
    struct Bench<'a>(&'a Packet, &'a [[Ray; 8]], bool);
    impl Task for Bench<'_> {
        type Output = (f64, usize);
        #[inline(always)]
        fn run<S: Simd>(self) -> (f64, usize) {
            let rays: Vec<Rays<S>> = self.1.iter().map(|rays| Rays {
                origin: Vec3x8::load(&rays.map(|ray| ray.origin)),
                direction: Vec3x8::load(&rays.map(|ray| ray.direction)),
            }).collect();
            let Packet::Lathe(lathe) = self.0 else { panic!() };
            let mut best = f64::INFINITY;
            let mut met = 0;
            for _ in 0..15 {
                met = 0;
                let start = std::time::Instant::now();
                for ray in &rays {
                    let after = F32x8::splat(0.0);
                    let before = F32x8::splat(f32::INFINITY);
                    let bits = if self.2 {
                        lathe.blocks(ray, after, before, Mask8::all_lanes()).bits()
                    } else {
                        lathe.nearest(ray, after, before, Mask8::all_lanes()).t.lt(before).bits()
                    };
                    met += bits.count_ones() as usize;
                }
                best = best.min(start.elapsed().as_secs_f64());
            }
            ((rays.len() * 8) as f64 / best / 1e6, met * 100 / (rays.len() * 8))
        }
    }
    let set = staunton();
    for (name, piece) in [("queen", &set.queen), ("king", &set.king), ("pawn", &set.pawn)] {
        let mut found = Vec::new();
        lathes(piece, &mut found);
        let lathe = found[0];
        let packet = Packet::new(lathe);
        let bounds = lathe.bounds();
        for (view, eye) in [
            ("slanted", DVec3::new(2.0, 6.0, -7.0)), ("level", DVec3::new(0.0, 0.6, -9.0)),
            ("above", DVec3::new(0.3, 12.0, -0.5)), ("below", DVec3::new(3.0, -5.0, -2.0)),
        ] {
            // Pixels of 2 × 4 a packet, over the silhouette's square.
            let middle = (bounds.min + bounds.max) / 2.0;
            let forward = (middle - eye).normalize();
            let right = forward.cross(DVec3::Y).normalize();
            let up = right.cross(forward);
            let half = (0.5 * (1.0 - forward.y.abs()) + bounds.max.x, bounds.max.x * 1.1);
            let (rows, columns) = (100_usize, 50_usize);
            let mut packets = Vec::new();
            for row in (0..rows).step_by(2) {
                for column in (0..columns).step_by(4) {
                    packets.push(std::array::from_fn(|lane| {
                        let y = ((row + lane / 4) as f64 + 0.5) / rows as f64 * 2.0 - 1.0;
                        let x = ((column + lane % 4) as f64 + 0.5) / columns as f64 * 2.0 - 1.0;
                        let to = middle + up * y * half.0 + right * x * half.1;
                        Ray { origin: eye, direction: (to - eye).normalize() / 6.0 }
                    }));
                }
            }
            let (nearest, met) = dispatch(Bench(&packet, &packets, false));
            let (blocks, _) = dispatch(Bench(&packet, &packets, true));
            println!("{name} {view}: {nearest:.1} M nearest/s, {blocks:.1} M blocks/s, {met} % met, {} segments", lathe.segments().len());
        }
    }
}
