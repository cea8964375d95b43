//! Packets held against the scalar solids.

use glam::DVec3;

use super::{Normals, Solid};
use crate::geometry::{self, Bounds, Interval, Ray, Shape, Spans};
use crate::lanes::{F32x8, Mask8, Plain, Simd, Task, U32x8, Vec3x8, dispatch};
use crate::packet::Rays;

/// Numbers from 0 to 1 by chance, always the same.
pub struct Chance(pub u64);

impl Chance {
    pub fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    pub fn in_box(&mut self, bounds: &Bounds) -> DVec3 {
        let share = DVec3::from([(); 3].map(|()| self.next()));
        bounds.min + (bounds.max - bounds.min) * share
    }

    /// A vector of length 1.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let at = self.in_box(&Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE });
            if (0.01..1.0).contains(&at.length_squared()) {
                return at.normalize();
            }
        }
    }
}

/// A question of eight rays, as f32 has them.
#[derive(Clone, Copy)]
pub struct Asked {
    pub rays: [Ray; 8],
    pub after: [f32; 8],
    pub before: [f32; 8],
    pub lanes: u8,
}

impl Asked {
    /// All that lies in front of rays.
    pub fn ahead(rays: [Ray; 8]) -> Asked {
        let rays = rays.map(rounded);
        Asked { rays, after: [0.0; 8], before: [f32::INFINITY; 8], lanes: u8::MAX }
    }

    fn packet<S: Simd>(&self) -> Rays<S> {
        Rays {
            origin: Vec3x8::load(&self.rays.map(|ray| ray.origin)),
            direction: Vec3x8::load(&self.rays.map(|ray| ray.direction)),
        }
    }
}

/// The nearest ray in f32.
pub fn rounded(ray: Ray) -> Ray {
    let f32s = |v: DVec3| v.as_vec3().as_dvec3();
    Ray { origin: f32s(ray.origin), direction: f32s(ray.direction) }
}

/// What is found on a lane, as bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    pub t: f32,
    pub part: u32,
    pub is_blocked: bool,
    /// Whether the ray's origin lies inside.
    pub is_inside: bool,
    pub flat: DVec3,
    pub smooth: DVec3,
}

struct AskAll<'a>(&'a Solid, &'a Asked);

impl Task for AskAll<'_> {
    type Output = [Option<Found>; 8];

    #[inline(always)]
    fn run<S: Simd>(self) -> [Option<Found>; 8] {
        let AskAll(solid, asked) = self;
        let rays = asked.packet::<S>();
        let (after, before) = (F32x8::load(&asked.after), F32x8::load(&asked.before));
        let lanes = Mask8::from_bits(asked.lanes);
        let crossing = solid.nearest(&rays, after, before, lanes);
        let blocks = solid.blocks(&rays, after, before, lanes).bits();
        let inside = solid.contains(rays.origin, lanes).bits();
        let met = crossing.t.lt(F32x8::splat(f32::INFINITY)) & lanes;
        // Where nothing is met, a point and a part that are there.
        let parts = met.select_words(crossing.part, U32x8::splat(0));
        let Normals { flat, smooth } = solid.normals(rays.at(met.keep(crossing.t)), parts, met);
        let (t, part) = (crossing.t.store(), parts.store());
        let (flat, smooth) = (flat.store(), smooth.store());
        std::array::from_fn(|lane| {
            let is_met = met.bits() >> lane & 1 == 1;
            let normal = |v: glam::Vec3| if is_met { v.as_dvec3() } else { DVec3::ZERO };
            (asked.lanes >> lane & 1 == 1).then(|| Found {
                t: t[lane],
                part: part[lane],
                is_blocked: blocks >> lane & 1 == 1,
                is_inside: inside >> lane & 1 == 1,
                flat: normal(flat[lane]),
                smooth: normal(smooth[lane]),
            })
        })
    }
}

/// What a packet finds, the same in either way.
pub fn ask(solid: &Solid, asked: &Asked) -> [Option<Found>; 8] {
    let found = dispatch(AskAll(solid, asked));
    assert_eq!(found, Plain::run(|| AskAll(solid, asked).run::<Plain>()));
    found
}

/// Asks all questions, and again in another order and with other lanes at their side, which changes nothing.
pub fn ask_each(solid: &Solid, questions: &[(Ray, f32, f32)]) -> Vec<Found> {
    let eight = |indices: [usize; 8], lanes: u8| {
        let pick = indices.map(|index| questions[index % questions.len()]);
        let asked = Asked {
            rays: pick.map(|(ray, ..)| rounded(ray)),
            after: pick.map(|(_, after, _)| after),
            before: pick.map(|(.., before)| before),
            lanes,
        };
        ask(solid, &asked)
    };
    let count = questions.len();
    let mut all = Vec::with_capacity(count + 8);
    for first in (0..count).step_by(8) {
        all.extend(eight(std::array::from_fn(|lane| first + lane), u8::MAX).into_iter().flatten());
    }
    all.truncate(count);
    for first in (0..count).step_by(5) {
        let indices = std::array::from_fn(|lane| (first * 7 + lane * lane * 1013) % count);
        let lanes = (first as u8).wrapping_mul(37) | 1;
        for (index, found) in indices.into_iter().zip(eight(indices, lanes)) {
            if let Some(found) = found {
                assert_eq!(found, all[index], "{:?} in other company", questions[index]);
            }
        }
    }
    all
}

/// Holds what is found against the scalar solid: a difference is none where a ray that is off by no more than
/// `slack` finds what the packet found. Gives how many rays meet the solid.
pub fn hold(
    name: &str,
    scalar: &dyn geometry::Solid,
    questions: &[(Ray, f32, f32)],
    slack: impl Fn(&Ray) -> f64,
) -> usize {
    let solid = Solid::new(scalar);
    let found = ask_each(&solid, questions);
    let mut met = 0;
    for ((ray, after, before), found) in questions.iter().zip(&found) {
        let ray = rounded(*ray);
        let slack = slack(&ray);
        let length = ray.direction.length();
        let range = Interval { min: f64::from(*after), max: f64::from(*before) };
        let agrees = |ray: &Ray, near: f64| match scalar.nearest(ray, range) {
            None => found.t == f32::INFINITY,
            Some(hit) => {
                let off = (hit.t - f64::from(found.t)).abs();
                let slanted = hit.normal.dot(ray.direction / length).abs().max(1e-3);
                off * length < near / slanted
            }
        };
        let sideways = ray.direction.any_orthonormal_vector();
        let upwards = ray.direction.cross(sideways).normalize();
        let shifted = || {
            (0..24).map(|step| {
                let (sin, cos) = libm::sincos(f64::from(step % 8) * std::f64::consts::FRAC_PI_4);
                let by = slack * [0.3, 1.0, 2.0][step as usize / 8];
                Ray { origin: ray.origin + (sideways * cos + upwards * sin) * by, ..ray }
            })
        };
        // Where a ray runs within a surface, it may be met anywhere, or not at all.
        let is_level = |normal: DVec3| normal.dot(ray.direction / length).abs() < 1e-4;
        let grazes = found.t < f32::INFINITY && is_level(found.flat)
            || scalar.nearest(&ray, range).is_some_and(|hit| is_level(hit.normal));
        let is_so =
            grazes || agrees(&ray, 4.0 * slack) || shifted().any(|ray| agrees(&ray, 8.0 * slack));
        assert!(
            is_so,
            "{name}: {ray:?} from {after} to {before}: {found:?}, expected {:?}",
            scalar.nearest(&ray, range)
        );
        assert_eq!(found.is_blocked, found.t < f32::INFINITY, "{name}: {ray:?}");
        let inside = |point| scalar.contains(point) == found.is_inside;
        let nudges = [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
        assert!(
            inside(ray.origin) || nudges.iter().any(|by| inside(ray.origin + *by * slack)),
            "{name}: {} is inside: {}",
            ray.origin,
            found.is_inside
        );
        if found.t < f32::INFINITY {
            met += 1;
            for normal in [found.flat, found.smooth] {
                assert!((normal.length() - 1.0).abs() < 1e-5, "{name}: {normal}");
            }
            let near = |normal: DVec3, exact: DVec3| normal.distance(exact) < 0.02;
            // Lines through the place along its normal meet the same surface there; at edges those beside it.
            let point = ray.at(f64::from(found.t));
            let (aside, along) = found.flat.normalize().any_orthonormal_pair();
            let has_normals = (0..17).any(|step| {
                let (sin, cos) = libm::sincos(f64::from(step % 8) * std::f64::consts::FRAC_PI_4);
                let by = slack * [0.0, 1.0, 4.0][(step as usize).div_ceil(8)];
                let origin = point + (aside * cos + along * sin) * by;
                let mut spans = Spans::new();
                scalar.spans(&Ray { origin, direction: -found.flat.normalize() }, &mut spans);
                spans.iter().flat_map(|span| [span.enter, span.exit]).any(|hit| {
                    hit.t.abs() < 20.0 * slack
                        && near(found.flat, hit.normal)
                        && near(found.smooth, hit.shading)
                })
            });
            // Near an axis all normals meet.
            let is_so = has_normals || point.with_y(0.0).length() < 30.0 * slack;
            assert!(
                is_so,
                "{name}: {ray:?}: {found:?}, expected {:?}",
                scalar.nearest(&ray, range)
            );
        }
    }
    met
}

/// All lathes that a solid is made of, each in its own space.
pub fn lathes<'a>(solid: &'a dyn geometry::Solid, found: &mut Vec<&'a geometry::Lathe>) {
    match solid.shape() {
        Shape::Lathe(lathe) => found.push(lathe),
        Shape::Placed(placed) => lathes(placed.solid(), found),
        Shape::Csg(csg) => match csg.root() {
            geometry::Root::Leaf(leaf) => lathes(leaf, found),
            geometry::Root::Pair(_, first, second) => {
                lathes(first, found);
                lathes(second, found);
            }
        },
        _ => {}
    }
}
