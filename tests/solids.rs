//! What rays find in solids, held against a question that needs no rays: is this point inside?

use glam::{DVec2, DVec3};
use lightsquare::assets::{PieceSet, SetName, piece_set};
use lightsquare::geometry::transform::{rotation_x, rotation_y, rotation_z, scale, translation};
use lightsquare::geometry::{
    ControlPoint, Csg, Cuboid, Interval, Lathe, Normals, Outline, Plane, Prism, Profile, Ray,
    Solid, Spans, Sphere,
};
use proptest::prelude::*;
use std::sync::LazyLock;

static THESIS: LazyLock<PieceSet> =
    LazyLock::new(|| piece_set(&SetName::Thesis, 4, Normals::Flat).unwrap());

static STAUNTON: LazyLock<PieceSet> =
    LazyLock::new(|| piece_set(&SetName::Staunton, 3, Normals::Smooth).unwrap());

fn solids() -> Vec<(&'static str, Csg)> {
    let sphere = || Csg::leaf(Sphere { center: DVec3::new(0.3, 1.0, -0.2), radius: 1.2 });
    let cuboid = || Csg::leaf(Cuboid::centered(DVec3::new(1.0, 0.5, 2.0)));
    let turned = || {
        let turn = rotation_x(20.0) * rotation_y(-50.0) * rotation_z(75.0);
        cuboid().placed(translation(DVec3::Y) * turn * scale(1.3))
    };
    let half_space = || Plane::new(DVec3::new(0.0, 1.1, 0.0), DVec3::new(1.0, 2.0, -0.5));
    let prism = |steps, normals| {
        let points = [(-1.5, 0.2), (0.4, -0.5), (1.6, 0.4), (0.5, 1.0), (1.2, 3.0), (-0.8, 2.0)];
        let control = points.map(|(x, y)| ControlPoint { at: DVec2::new(x, y), corner: x > 1.0 });
        let outline = Outline::new(control.to_vec()).unwrap();
        Csg::leaf(Prism::new(&outline, steps, normals, -0.7, 1.1).unwrap())
    };
    vec![
        ("prism", prism(0, Normals::Flat)),
        ("rounded prism", prism(3, Normals::Smooth)),
        ("carved prism", prism(3, Normals::Smooth).minus(sphere()).and(turned())),
        ("half a sphere", sphere().minus(Csg::leaf(half_space()))),
        ("quarter of a sphere", sphere().and(Csg::leaf(half_space())).and(cuboid())),
        ("sphere", sphere()),
        ("cuboid", cuboid()),
        ("turned cuboid", turned()),
        ("union", sphere().or(cuboid())),
        ("intersection", sphere().and(turned())),
        ("difference", turned().minus(sphere())),
        ("tree", turned().minus(sphere().and(cuboid())).or(cuboid().minus(turned()))),
        ("thesis pawn", THESIS.pawn.clone()),
        ("thesis knight", THESIS.knight.clone()),
        ("thesis bishop", THESIS.bishop.clone()),
        ("thesis rook", THESIS.rook.clone()),
        ("thesis queen", THESIS.queen.clone()),
        ("thesis king", THESIS.king.clone()),
        ("pawn", STAUNTON.pawn.clone()),
        ("knight", STAUNTON.knight.clone()),
        ("bishop", STAUNTON.bishop.clone()),
        ("rook", STAUNTON.rook.clone()),
        ("queen", STAUNTON.queen.clone()),
        ("king", STAUNTON.king.clone()),
    ]
}

fn spans(solid: &Csg, ray: &Ray) -> Spans {
    let mut spans = Spans::new();
    solid.spans(ray, &mut spans);
    spans
}

fn points() -> impl Strategy<Value = DVec3> {
    (-3.0..3.0, -1.0..7.0, -3.0..3.0).prop_map(DVec3::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn a_ray_is_inside_exactly_within_its_spans(from in points(), to in points()) {
        prop_assume!(from.distance(to) > 1e-3);
        let ray = Ray { origin: from, direction: (to - from).normalize() };
        for (name, solid) in solids() {
            let spans = spans(&solid, &ray);
            for pair in spans.windows(2) {
                prop_assert!(pair[0].exit.t <= pair[1].enter.t, "{name}: spans overlap");
            }
            let ends: Vec<f64> = spans.iter().flat_map(|span| [span.enter.t, span.exit.t]).collect();
            for step in -200..200 {
                let t = f64::from(step) * 0.05;
                // Where a surface is near, rounding may decide.
                if ends.iter().any(|end| (end - t).abs() < 1e-6) {
                    continue;
                }
                let in_span = spans.iter().any(|span| span.enter.t < t && t < span.exit.t);
                prop_assert_eq!(in_span, solid.contains(ray.at(t)), "{} at {}", name, ray.at(t));
            }
        }
    }

    #[test]
    fn normals_have_length_1_and_point_outwards(from in points(), to in points()) {
        prop_assume!(from.distance(to) > 1e-3);
        let ray = Ray { origin: from, direction: (to - from).normalize() };
        for (name, solid) in solids() {
            for span in spans(&solid, &ray) {
                prop_assert!((span.enter.normal.length() - 1.0).abs() < 1e-9, "{name}");
                prop_assert!(span.enter.normal.dot(ray.direction) <= 1e-9, "{name} enters");
                prop_assert!(span.exit.normal.dot(ray.direction) >= -1e-9, "{name} leaves");
                for hit in [span.enter, span.exit] {
                    prop_assert!((hit.shading.length() - 1.0).abs() < 1e-9, "{name} is shaded");
                    prop_assert!(hit.shading.dot(hit.normal) > 0.7, "{name} is shaded as another");
                }
            }
        }
    }

    #[test]
    fn the_nearest_crossing_is_the_first_end_of_a_span(from in points(), to in points()) {
        prop_assume!(from.distance(to) > 1e-3);
        let ray = Ray { origin: from, direction: (to - from).normalize() };
        for (name, solid) in solids() {
            let first = spans(&solid, &ray)
                .iter()
                .flat_map(|span| [span.enter.t, span.exit.t])
                .find(|t| *t >= 0.0);
            let nearest = solid.nearest(&ray, Interval::AHEAD).map(|hit| hit.t);
            prop_assert_eq!(nearest.is_some(), first.is_some(), "{}", name);
            if let (Some(nearest), Some(first)) = (nearest, first) {
                prop_assert!((nearest - first).abs() < 1e-9, "{name}: {nearest} and {first}");
                let before = Interval::up_to(first - 1e-6);
                prop_assert!(!solid.blocks(&ray, before), "{name}");
                prop_assert!(solid.blocks(&ray, Interval::up_to(first + 1e-6)), "{name}");
            }
        }
    }
}

/// Rays that random points never give: straight down on the axis, and along the axes of a box.
#[test]
fn rays_on_an_axis_meet_what_lies_on_it() {
    for (name, solid) in solids() {
        let bounds = solid.bounds();
        let above = DVec3::new(0.0, bounds.max.y + 5.0, 0.0);
        let ray = Ray { origin: above, direction: DVec3::NEG_Y };
        let spans = spans(&solid, &ray);
        for step in 0..400 {
            let t = f64::from(step) * 0.0337;
            let in_span = spans.iter().any(|span| span.enter.t < t && t < span.exit.t);
            // Just beside the axis, the question needs no ray.
            let inside = solid.contains(ray.at(t) + DVec3::new(1e-7, 0.0, 1e-7));
            assert_eq!(in_span, inside, "{name} at {}", ray.at(t));
        }
    }
}

/// A ray within the plane of a wall meets the prism where the prism is, and nowhere else.
#[test]
fn rays_within_a_wall_of_a_prism_stay_on_it() {
    let corner = |x, y| ControlPoint { at: DVec2::new(x, y), corner: true };
    let leaf = [(-2.0, 0.2), (0.1, -1.0), (2.5, 0.3), (1.0, 1.5), (1.2, 4.0), (-1.0, 3.0)];
    let outline = Outline::new(leaf.map(|(x, y)| corner(x, y)).to_vec()).unwrap();
    let prism = Prism::new(&outline, 2, Normals::Flat, -1.0, 1.0).unwrap();
    let mut met = 0;
    for (index, segment) in prism.segments().iter().enumerate() {
        for step in 0..500 {
            let along = (segment.to - segment.from).normalize();
            let before = segment.from - along * (1.0 + 0.013 * f64::from(step));
            let ray = Ray {
                origin: before.extend(-3.0),
                direction: along.extend(0.002 * f64::from(step)).normalize(),
            };
            let mut spans = Spans::new();
            prism.spans(&ray, &mut spans);
            met += spans.len();
            for end in spans.iter().flat_map(|span| [span.enter, span.exit]) {
                let point = ray.at(end.t);
                let (low, high) = (prism.bounds().min - 1e-9, prism.bounds().max + 1e-9);
                assert!(point.cmpge(low).all() && point.cmple(high).all(), "{index}: {point}");
            }
        }
    }
    assert!(met > 0);
}

#[test]
fn a_plane_is_the_skin_of_half_of_space() {
    let plane = Plane::new(DVec3::Y * 2.0, DVec3::Y * 5.0);
    assert!(plane.contains(DVec3::new(9.0, 1.9, -9.0)) && !plane.contains(DVec3::Y * 2.1));
    let ray = |direction| Ray { origin: DVec3::Y * 5.0, direction };
    let down = plane.nearest(&ray(DVec3::NEG_Y), Interval::AHEAD).unwrap();
    assert_eq!((down.t, down.normal), (3.0, DVec3::Y));
    assert!(plane.nearest(&ray(DVec3::Y), Interval::AHEAD).is_none());
    assert!(plane.nearest(&ray(DVec3::X), Interval::AHEAD).is_none());
}

/// A face may lie on the very edge of the bounds: rounding must not open a way in.
#[test]
fn flat_tops_have_no_holes() {
    let corner = |u, v| ControlPoint { at: DVec2::new(u, v), corner: true };
    let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 3.86), corner(0.0, 3.86)];
    let drum =
        Csg::leaf(Lathe::new(&Profile::new(corners.to_vec()).unwrap(), 0, Normals::Flat).unwrap());
    for drum in [drum.clone(), drum.placed(scale(1.7))] {
        let height = drum.bounds().max.y;
        for step in 0..4000 {
            let angle = f64::from(step) * 0.0111;
            let top = DVec3::new(0.8 * angle.cos(), height, 0.8 * angle.sin());
            let origin = DVec3::new(45.0, 15.0 + 0.001 * f64::from(step), -30.0);
            let ray = Ray { origin, direction: (top - origin).normalize() };
            let hit = drum.nearest(&ray, Interval::AHEAD).unwrap();
            assert!(hit.normal.y > 0.99 && ray.at(hit.t).distance(top) < 1e-9, "{top}");
        }
    }
}
