//! Solids of all kinds, and trees of them, held against those that they are made of, in f64.

use glam::{DVec2, DVec3};

use super::Solid;
use super::oracle::{Asked, Chance, Found, ask, ask_each, rounded};
use crate::assets::{SetName, piece_set};
use crate::geometry::transform::{rotation_x, rotation_y, rotation_z, scale, translation};
use crate::geometry::{
    self, Bounds, ControlPoint, Csg, Cuboid, Hit, Interval, Normals, Outline, Plane, Prism, Ray,
    Spans, Sphere,
};

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

/// A box round what of a solid is near the origin.
fn near_bounds(solid: &dyn geometry::Solid) -> Bounds {
    let near = Bounds { min: DVec3::splat(-4.0), max: DVec3::splat(8.0) };
    solid.bounds().intersection(near)
}

/// Rays from afar, and where those hit something, rays from there in any direction.
fn rays(solid: &dyn geometry::Solid, chance: &mut Chance) -> Ray {
    let bounds = near_bounds(solid);
    let aim = chance.in_box(&bounds);
    let length = chance.between(0.5, 2.0);
    let from = aim + chance.direction() * chance.between(10.0, 40.0);
    let ray = rounded(Ray { origin: from, direction: (aim - from).normalize() * length });
    let kind = (4.0 * chance.next()) as u32;
    match solid.nearest(&ray, Interval::AHEAD) {
        Some(hit) if kind > 0 && hit.t.is_finite() => {
            let side = if kind == 3 { -1.0 } else { 1.0 };
            let direction = chance.direction();
            let direction = direction * (direction.dot(hit.normal) * side).signum() * length;
            rounded(Ray { origin: ray.at(hit.t) + hit.normal * side * OFF, direction })
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
        let mut chance = Chance(1);
        let question = |_| {
            let ray = rays(&*original, &mut chance);
            let is_endless = chance.next() < 0.7;
            (ray, 0.0, if is_endless { f32::INFINITY } else { chance.between(0.0, 50.0) as f32 })
        };
        let questions: Vec<(Ray, f32, f32)> = (0..8 * PACKETS).map(question).collect();
        let answers = ask_each(&Solid::new(&*original), &questions);
        for ((ray, _, before), answer) in questions.iter().zip(answers) {
            assert_eq!(answer.is_blocked, answer.t.is_finite(), "{name}: {ray:?}");
            let first = ends(&*original, ray).first().copied();
            let exact = first.filter(|hit| hit.t < f64::from(*before));
            let is_same = match exact {
                None => answer.t.is_infinite(),
                Some(hit) => {
                    (f64::from(answer.t) - hit.t).abs() < 1e-4 * hit.t.max(1.0)
                        && answer.flat.distance(hit.normal) < 1e-2
                        && answer.smooth.distance(hit.shading) < 1e-2
                }
            };
            differences.note(is_same, || format!("{name}: {ray:?}\n  {answer:?}\n  {exact:?}"));
        }
    }
    differences.are_few();
}

#[test]
fn next_crossings_are_the_ends_of_spans() {
    let mut differences = Differences::default();
    for (name, original) in solids() {
        let solid = Solid::new(&*original);
        let mut chance = Chance(2);
        for _ in 0..PACKETS / 4 {
            let mut asked = Asked::ahead([(); 8].map(|()| rays(&*original, &mut chance)));
            let mut found = [const { Vec::new() }; 8];
            while asked.lanes != 0 {
                for (lane, answer) in ask(&solid, &asked).into_iter().enumerate() {
                    let Some(Found { t, .. }) = answer else { continue };
                    if t.is_finite() {
                        assert!(t > asked.after[lane], "{name}: {:?}", asked.rays[lane]);
                        found[lane].push(f64::from(t));
                        asked.after[lane] = t;
                    } else {
                        asked.lanes &= !(1 << lane);
                    }
                }
            }
            for (ray, found) in asked.rays.iter().zip(&found) {
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
        let mut chance = Chance(3);
        let bounds = near_bounds(&*original);
        let question = |_| {
            let ray = Ray { origin: chance.in_box(&bounds), direction: DVec3::X };
            (rounded(ray), 0.0, f32::INFINITY)
        };
        let questions: Vec<(Ray, f32, f32)> = (0..8 * PACKETS).map(question).collect();
        let answers = ask_each(&Solid::new(&*original), &questions);
        for ((ray, ..), answer) in questions.iter().zip(answers) {
            let is_same = answer.is_inside == original.contains(ray.origin);
            differences.note(is_same, || format!("{name}: {}", ray.origin));
        }
    }
    differences.are_few();
}
