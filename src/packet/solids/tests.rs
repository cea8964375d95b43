//! Packets held against the solids that they are made of, in f64, and against themselves.

use glam::{DVec2, DVec3, Vec3};

use super::Solid;
use crate::assets::{SetName, piece_set};
use crate::geometry::transform::{rotation_x, rotation_y, rotation_z, scale, translation};
use crate::geometry::{
    self, Bounds, ControlPoint, Csg, Cuboid, Hit, Interval, Normals, Outline, Plane, Prism, Ray,
    Spans, Sphere,
};
use crate::lanes::{F32x8, Mask8, Plain, Simd, Task, Vec3x8, dispatch};
use crate::packet::Rays;

/// How many packets a solid is asked with in each test.
const PACKETS: usize = 400;

/// Of so many answers, one may be another: rays that graze an edge, points on a surface.
const GRAZING: usize = 5000;

/// What rays keep from surfaces that they leave.
const OFF: f64 = 1e-4;

/// Simple solids, trees of them, and the pieces of both sets.
fn solids() -> Vec<(String, Box<dyn geometry::Solid>)> {
    let ball = Sphere { center: DVec3::new(0.3, 1.0, -0.2), radius: 1.2 };
    let brick = Cuboid::centered(DVec3::new(1.0, 0.5, 2.0));
    let sphere = || Csg::leaf(ball);
    let cuboid = || Csg::leaf(brick);
    let turned = || {
        let turn = rotation_x(20.0) * rotation_y(-50.0) * rotation_z(75.0);
        cuboid().placed(translation(DVec3::Y) * turn * scale(1.3))
    };
    let half = || Plane::new(DVec3::new(0.0, 1.1, 0.0), DVec3::new(1.0, 2.0, -0.5));
    let points = [(-1.5, 0.2), (0.4, -0.5), (1.6, 0.4), (0.5, 1.0), (1.2, 3.0), (-0.8, 2.0)];
    let control = points.map(|(x, y)| ControlPoint { at: DVec2::new(x, y), corner: x > 1.0 });
    let outline = Outline::new(control.to_vec()).unwrap();
    let prism =
        |steps, normals| Csg::leaf(Prism::new(&outline, steps, normals, -0.7, 1.1).unwrap());
    let stretch = glam::DAffine3::from_scale(DVec3::new(0.4, 1.5, 0.9));
    let at = |x: f64| translation(DVec3::new(x, 0.4 * x, 0.1));
    let string = (0..40_u32).map(|index| {
        let turn = rotation_z(17.0 * f64::from(index));
        sphere().placed(at(0.1 * f64::from(index) - 2.0) * turn * stretch * scale(0.3))
    });
    let string = string.reduce(Csg::or).unwrap();
    let mut solids: Vec<(String, Box<dyn geometry::Solid>)> = vec![
        ("plane".into(), Box::new(half())),
        ("sphere".into(), Box::new(ball)),
        ("cuboid".into(), Box::new(brick)),
    ];
    let trees = [
        ("prism", prism(0, Normals::Flat)),
        ("rounded prism", prism(3, Normals::Smooth)),
        ("carved prism", prism(3, Normals::Smooth).minus(sphere()).and(turned())),
        ("half a sphere", sphere().minus(Csg::leaf(half()))),
        ("quarter of a sphere", sphere().and(Csg::leaf(half())).and(cuboid())),
        ("stretched sphere", sphere().placed(at(1.0) * stretch)),
        ("turned cuboid", turned()),
        ("union", sphere().or(cuboid())),
        ("intersection", sphere().and(turned())),
        ("difference", turned().minus(sphere())),
        ("tree", turned().minus(sphere().and(cuboid())).or(cuboid().minus(turned()))),
        ("string", string.clone()),
        ("placed string", string.clone().or(cuboid()).placed(rotation_x(30.0) * scale(1.4))),
        ("cut by a string", cuboid().minus(string.clone())),
        ("shell of a string", string.clone().minus(string.placed(scale(0.97)))),
    ];
    let pieces = [("thesis", SetName::Thesis, 4), ("staunton", SetName::Staunton, 3)];
    let pieces = pieces.into_iter().flat_map(|(set, name, steps)| {
        let pieces = piece_set(&name, steps, Normals::Smooth).unwrap();
        let men = ["pawn", "knight", "bishop", "rook", "queen", "king"];
        men.into_iter()
            .zip(pieces.men().map(Csg::clone))
            .map(move |(man, solid)| (format!("{set} {man}"), solid))
            .collect::<Vec<_>>()
    });
    let trees = trees.map(|(name, solid)| (name.to_owned(), solid)).into_iter().chain(pieces);
    solids.extend(trees.map(|(name, solid)| (name, Box::new(solid) as Box<dyn geometry::Solid>)));
    solids
}

/// Random numbers, always the same ones (S. Vigna's SplitMix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Between 0 and 1.
    fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn in_box(&mut self, bounds: &Bounds) -> DVec3 {
        let share = DVec3::new(self.share(), self.share(), self.share());
        bounds.min + (bounds.max - bounds.min) * share
    }

    /// A vector of length 1.
    fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.in_box(&Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE });
            if (0.01..1.0).contains(&v.length_squared()) {
                return v.normalize();
            }
        }
    }
}

/// A ray in numbers that an f32 can hold.
fn rounded(origin: DVec3, direction: DVec3) -> Ray {
    Ray { origin: origin.as_vec3().as_dvec3(), direction: direction.as_vec3().as_dvec3() }
}

/// A box round what of a solid is near the origin.
fn near_bounds(solid: &dyn geometry::Solid) -> Bounds {
    let near = Bounds { min: DVec3::splat(-4.0), max: DVec3::splat(8.0) };
    solid.bounds().intersection(near)
}

/// Rays from afar, and where those hit something, rays from there in any direction.
fn rays(solid: &dyn geometry::Solid, random: &mut Random) -> Ray {
    let bounds = near_bounds(solid);
    let aim = random.in_box(&bounds);
    let length = 0.5 + 1.5 * random.share();
    let from = aim + random.direction() * (10.0 + 30.0 * random.share());
    let ray = rounded(from, (aim - from).normalize() * length);
    let kind = random.next() % 4;
    match solid.nearest(&ray, Interval::AHEAD) {
        Some(hit) if kind > 0 && hit.t.is_finite() => {
            let side = if kind == 3 { -1.0 } else { 1.0 };
            let direction = random.direction();
            let direction = direction * (direction.dot(hit.normal) * side).signum();
            rounded(ray.at(hit.t) + hit.normal * side * OFF, direction * length)
        }
        _ => ray,
    }
}

/// The ends of spans that a ray from its origin on meets, but for those of gaps that rounding left between
/// walls in one place.
fn ends(solid: &dyn geometry::Solid, ray: &Ray) -> Vec<Hit> {
    let mut spans = Spans::new();
    solid.spans(ray, &mut spans);
    let mut ends: Vec<Hit> = Vec::new();
    for end in spans.iter().flat_map(|span| [span.enter, span.exit]) {
        match ends.last() {
            Some(last) if end.t - last.t < 1e-9 => drop(ends.pop()),
            _ => ends.push(end),
        }
    }
    // A plane's span may end where no ray gets.
    ends.retain(|end| end.t > 0.0 && end.t.is_finite());
    ends
}

/// All questions to a solid at once.
struct Ask<'a> {
    solid: &'a Solid,
    rays: [Ray; 8],
    after: [f32; 8],
    before: [f32; 8],
    lanes: u8,
}

/// One lane's answers.
#[derive(Clone, Copy, Debug)]
struct Answer {
    t: f32,
    flat: Vec3,
    smooth: Vec3,
    blocks: bool,
    contains: bool,
}

impl Answer {
    fn bits(&self) -> [u32; 9] {
        let [a, b, c] = self.flat.to_array().map(f32::to_bits);
        let [d, e, f] = self.smooth.to_array().map(f32::to_bits);
        [self.t.to_bits(), a, b, c, d, e, f, u32::from(self.blocks), u32::from(self.contains)]
    }
}

impl Task for Ask<'_> {
    type Output = [Answer; 8];

    #[inline(always)]
    fn run<S: Simd>(self) -> [Answer; 8] {
        let lanes = Mask8::<S>::from_bits(self.lanes);
        let rays = Rays {
            origin: Vec3x8::load(&self.rays.map(|ray| ray.origin)),
            direction: Vec3x8::load(&self.rays.map(|ray| ray.direction)),
        };
        let (after, before) = (F32x8::load(&self.after), F32x8::load(&self.before));
        let found = self.solid.nearest(&rays, after, before, lanes);
        let hit = lanes & found.is_one();
        let normals = self.solid.normals(rays.at(found.t), found.part, hit);
        let zero = Vec3x8::zero();
        let (flat, smooth) = (
            Vec3x8::select(hit, normals.flat, zero).store(),
            Vec3x8::select(hit, normals.smooth, zero).store(),
        );
        let blocks = (lanes & self.solid.blocks(&rays, after, before, lanes)).bits();
        let contains = (lanes & self.solid.contains(rays.origin, lanes)).bits();
        let t = lanes.select(found.t, F32x8::splat(0.0)).store();
        std::array::from_fn(|lane| Answer {
            t: t[lane],
            flat: flat[lane],
            smooth: smooth[lane],
            blocks: blocks >> lane & 1 == 1,
            contains: contains >> lane & 1 == 1,
        })
    }
}

impl<'a> Ask<'a> {
    fn ahead(solid: &'a Solid, rays: [Ray; 8]) -> Ask<'a> {
        Ask { solid, rays, after: [0.0; 8], before: [f32::INFINITY; 8], lanes: u8::MAX }
    }
}

/// Counts answers that differ, and says which when there are too many.
#[derive(Default)]
struct Differences {
    asked: usize,
    seen: Vec<String>,
}

impl Differences {
    fn note(&mut self, is_same: bool, what: impl FnOnce() -> String) {
        self.asked += 1;
        if !is_same {
            self.seen.push(what());
        }
    }

    fn are_few(&self) {
        let (seen, allowed) = (self.seen.len(), self.asked / GRAZING);
        let some = &self.seen[..seen.min(20)];
        assert!(seen <= allowed, "{seen} of {} differ: {some:#?}", self.asked);
    }
}

#[test]
fn first_crossings_are_those_of_the_solid() {
    let mut differences = Differences::default();
    for (name, original) in solids() {
        let solid = Solid::new(&*original);
        let mut random = Random(1);
        for _ in 0..PACKETS {
            let rays = std::array::from_fn(|_| rays(&*original, &mut random));
            let answers = dispatch(Ask::ahead(&solid, rays));
            for (ray, answer) in rays.iter().zip(answers) {
                assert_eq!(answer.blocks, answer.t.is_finite(), "{name}: {ray:?}");
                let exact = ends(&*original, ray).first().copied();
                let is_same = match exact {
                    None => answer.t.is_infinite(),
                    Some(hit) => {
                        (f64::from(answer.t) - hit.t).abs() < 1e-4 * hit.t.max(1.0)
                            && answer.flat.as_dvec3().distance(hit.normal) < 1e-2
                            && answer.smooth.as_dvec3().distance(hit.shading) < 1e-2
                    }
                };
                differences.note(is_same, || format!("{name}: {ray:?}\n  {answer:?}\n  {exact:?}"));
            }
        }
    }
    differences.are_few();
}

#[test]
fn next_crossings_are_the_ends_of_spans() {
    let mut differences = Differences::default();
    for (name, original) in solids() {
        let solid = Solid::new(&*original);
        let mut random = Random(2);
        for _ in 0..PACKETS / 4 {
            let rays: [Ray; 8] = std::array::from_fn(|_| rays(&*original, &mut random));
            let mut found = [const { Vec::new() }; 8];
            let mut ask = Ask::ahead(&solid, rays);
            while ask.lanes != 0 {
                let answers = dispatch(Ask { ..ask });
                for (lane, answer) in answers.into_iter().enumerate() {
                    if ask.lanes >> lane & 1 == 0 {
                        continue;
                    }
                    if answer.t.is_finite() {
                        assert!(answer.t > ask.after[lane], "{name}: {:?}", rays[lane]);
                        found[lane].push(f64::from(answer.t));
                        ask.after[lane] = answer.t;
                    } else {
                        ask.lanes &= !(1 << lane);
                    }
                }
            }
            for (ray, found) in rays.iter().zip(&found) {
                let ends: Vec<f64> = ends(&*original, ray).iter().map(|end| end.t).collect();
                // What is thinner than a hair may have been passed.
                let thick = |ends: &[f64]| {
                    let mut kept: Vec<f64> = Vec::new();
                    for end in ends {
                        match kept.last() {
                            Some(last) if end - last < 1e-4 => drop(kept.pop()),
                            _ => kept.push(*end),
                        }
                    }
                    kept
                };
                let (found, ends) = (thick(found), thick(&ends));
                let is_same = found.len() == ends.len()
                    && found.iter().zip(&ends).all(|(a, b)| (a - b).abs() < 1e-4 * b.max(1.0));
                differences.note(is_same, || format!("{name}: {ray:?}\n  {found:?}\n  {ends:?}"));
            }
        }
    }
    differences.are_few();
}

#[test]
fn what_is_inside_is_inside_of_the_solid() {
    let mut differences = Differences::default();
    for (name, original) in solids() {
        let solid = Solid::new(&*original);
        let mut random = Random(3);
        let bounds = near_bounds(&*original);
        for _ in 0..PACKETS {
            let rays = std::array::from_fn(|_| rounded(random.in_box(&bounds), DVec3::X));
            let answers = dispatch(Ask::ahead(&solid, rays));
            for (ray, answer) in rays.iter().zip(answers) {
                let is_same = answer.contains == original.contains(ray.origin);
                differences.note(is_same, || format!("{name}: {}", ray.origin));
            }
        }
    }
    differences.are_few();
}

#[test]
fn lanes_know_nothing_of_each_other() {
    for (name, original) in solids() {
        let solid = Solid::new(&*original);
        let mut random = Random(4);
        for _ in 0..PACKETS / 8 {
            let rays: [Ray; 8] = std::array::from_fn(|_| rays(&*original, &mut random));
            let before = std::array::from_fn(|_| {
                if random.share() < 0.5 { f32::INFINITY } else { 50.0 * random.share() as f32 }
            });
            let ask = || Ask { before, ..Ask::ahead(&solid, rays) };
            let together = dispatch(ask());
            for (lane, ray) in rays.iter().enumerate() {
                // Alone, in another place, with others round it.
                let alone = dispatch(Ask { lanes: 1 << lane, ..ask() })[lane];
                let place = (random.next() % 8) as usize;
                let mut others: [Ray; 8] =
                    std::array::from_fn(|_| self::rays(&*original, &mut random));
                others[place] = *ray;
                let mut limits = before;
                limits[place] = before[lane];
                let lanes = random.next() as u8 | 1 << place;
                let ask = Ask { before: limits, lanes, ..Ask::ahead(&solid, others) };
                let among_others = dispatch(ask)[place];
                assert_eq!(together[lane].bits(), alone.bits(), "{name}: {ray:?}");
                assert_eq!(together[lane].bits(), among_others.bits(), "{name}: {ray:?}");
            }
        }
    }
}

#[test]
fn both_ways_give_the_same_bits() {
    for (name, original) in solids() {
        let solid = Solid::new(&*original);
        let mut random = Random(5);
        for _ in 0..PACKETS / 8 {
            let rays = std::array::from_fn(|_| rays(&*original, &mut random));
            let quick = dispatch(Ask::ahead(&solid, rays)).map(|answer| answer.bits());
            let plain = Ask::ahead(&solid, rays).run::<Plain>().map(|answer| answer.bits());
            assert_eq!(quick, plain, "{name}: {rays:?}");
        }
    }
}
