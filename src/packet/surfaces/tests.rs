//! Surfaces of whole scenes, asked point by point in f64 and in lanes.

use glam::DVec3;

use super::*;
use crate::assets::{Assets, SetName};
use crate::config::{self, Config, ShowClock};
use crate::geometry::Bounds;
use crate::lanes::{Plain, Task, dispatch};
use crate::notation::{Arrow, Brush, Circle, Color, Placement, Square};
use crate::scene::noise::hash;
use crate::scene::{Object, Place, Reach, Scene, Stage};
use crate::timeline::{Dials, Frame, Marks};

/// Eight questions.
#[derive(Clone, Copy, Debug)]
struct Question {
    points: [DVec3; 8],
    seen: [f32; 8],
    lanes: u8,
}

/// By lane: the colour, its bits, and the material, by both ways to ask for it.
type Answers = [([f32; 3], [u32; 2]); 8];

struct Ask<'a>(&'a Surface, Question);

impl Task for Ask<'_> {
    type Output = Answers;

    #[inline(always)]
    fn run<S: Simd>(self) -> Answers {
        let Ask(surface, question) = self;
        let points = Vec3x8::<S>::load(&question.points);
        let lanes = Mask8::from_bits(question.lanes);
        let look = surface.look(points, F32x8::load(&question.seen), lanes);
        let (colors, material) = (look.color.store(), look.material.store());
        let alone = surface.material(points, lanes).store();
        std::array::from_fn(|lane| (colors[lane].to_array(), [material[lane], alone[lane]]))
    }
}

/// Numbers from 0 to 1, the same ones in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        (hash(3, self.0) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Points within bounds, as far from each other as `spread`.
    fn question(&mut self, bounds: &Bounds, spread: f64) -> Question {
        let mut within = |low: DVec3, high: DVec3| {
            DVec3::new(
                self.between(low.x, high.x),
                self.between(low.y, high.y),
                self.between(low.z, high.z),
            )
        };
        let far = DVec3::splat(60.0);
        let first = within(bounds.min.max(-far), bounds.max.min(far));
        let spread = DVec3::splat(spread);
        let points = [(); 8].map(|()| (first + within(-spread, spread)).as_vec3().as_dvec3());
        let seen = [(); 8].map(|()| (0.2 * libm::pow(self.next(), 3.0)) as f32);
        Question { points, seen, lanes: u8::MAX }
    }
}

fn scene(look: config::Look, theme: &str) -> Scene {
    let mut config = Config::new(look);
    config.theme = theme.to_owned();
    config.render.subdivisions = 1;
    config.clock.show = ShowClock::Game;
    let assets = Assets::load(&config, &SetName::Staunton).unwrap();
    let stage = Stage::new(&config, &assets, Reach::default()).unwrap();
    let placement = "rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR";
    let square = |name: &str| name.parse::<Square>().unwrap();
    let marks = Marks {
        last_move: vec![square("e2"), square("e4")],
        check: Some(square("e8")),
        is_mate: false,
        circles: vec![Circle { brush: Brush::Red, square: square("b6") }],
        arrows: vec![Arrow { brush: Brush::Blue, from: square("b1"), to: square("c3") }],
    };
    let dials = Some(Dials::Times { left: [Some(754), Some(12)], running: Some(Color::White) });
    let frame = Frame::still(Placement::from_fen(placement).unwrap());
    stage.scene(&Frame { marks, dials, ..frame })
}

/// Each object of each theme that is unlike others, with its bounds in its own space.
fn objects() -> impl Iterator<Item = (String, Object, Bounds)> {
    let looks = [config::Look::Studio, config::Look::Thesis];
    let themes = Config::new(config::Look::Studio).themes.into_keys();
    let named = themes.flat_map(move |theme: String| looks.map(|look| (look, theme.clone())));
    named.flat_map(|(look, theme)| {
        let name = format!("{look:?} {theme}");
        let mut objects = scene(look, &theme).objects;
        // Board, clock, and a few pieces of both players.
        let pieces = objects.len() - 32;
        objects = [objects[..pieces + 3].to_vec(), objects[objects.len() - 3..].to_vec()].concat();
        let bounded = move |object: Object| {
            let bounds = object.body.solid().bounds();
            (name.clone(), object, bounds)
        };
        objects.into_iter().map(bounded)
    })
}

/// The colour and material that one point has.
fn exact(object: &Object, point: DVec3, seen: f32) -> (DVec3, usize) {
    let place = Place { on_body: point, point, seed: object.seed };
    let (material, place) = object.surface.material(place);
    let index = object.surface.materials().iter().position(|other| std::ptr::eq(other, material));
    (object.color(material, place, f64::from(seen)), index.unwrap())
}

#[test]
fn surfaces_look_as_they_do_point_by_point_and_the_same_in_both_ways() {
    let mut numbers = Numbers(0);
    let (mut asked, mut edges) = (0, 0);
    for (name, object, mut bounds) in objects() {
        let surface = Surface::new(&object);
        for round in 0..400 {
            let spread = [0.01, 0.1, 5.0][round % 3];
            if round % 2 == 0 {
                // What is painted is the top.
                bounds.min.y = bounds.max.y.min(bounds.min.y.max(-1e-4));
            }
            let mut question = numbers.question(&bounds, spread);
            if round % 2 == 0 && object.paint.is_some() {
                question.points = question.points.map(|point| DVec3::new(point.x, 0.0, point.z));
            }
            let found = dispatch(Ask(&surface, question));
            assert_eq!(bits(found), bits(Ask(&surface, question).run::<Plain>()), "{name}");
            for (lane, (color, [material, alone])) in found.into_iter().enumerate() {
                let point = question.points[lane];
                let (exact, index) = exact(&object, point, question.seen[lane]);
                assert_eq!(material, alone);
                let error = (DVec3::from(color.map(f64::from)) - exact).abs().max_element();
                asked += 1;
                if error > 1e-4 || index != material as usize {
                    edges += 1;
                }
            }
        }
    }
    assert!(edges * 2000 < asked, "{edges} of {asked}");
}

fn bits(answers: Answers) -> [([u32; 3], [u32; 2]); 8] {
    answers.map(|(color, materials)| (color.map(f32::to_bits), materials))
}

/// A lane gets the same from a crowd, from another place in it, and alone.
#[test]
fn lanes_know_nothing_of_each_other() {
    let mut numbers = Numbers(1 << 32);
    for (name, object, bounds) in objects() {
        let surface = Surface::new(&object);
        for round in 0..100 {
            let near = numbers.question(&bounds, [0.01, 0.3][round % 2]);
            let far = numbers.question(&bounds, 8.0);
            let crowd = bits(dispatch(Ask(&surface, near)));
            let first = round % 8;
            for (lane, expected) in crowd.into_iter().enumerate() {
                // Half of the others are strangers, and some are not even asked.
                let mut mixed = far;
                let at = (lane + first) % 8;
                for other in [lane, (lane + 3) % 8, (lane + 5) % 8] {
                    let at = (other + first) % 8;
                    (mixed.points[at], mixed.seen[at]) = (near.points[other], near.seen[other]);
                }
                for lanes in [u8::MAX, 1 << at, 0b0101_1010 | 1 << at] {
                    let found = bits(dispatch(Ask(&surface, Question { lanes, ..mixed })));
                    assert_eq!(found[at], expected, "{name}, lanes {lanes:b}");
                }
            }
        }
    }
}
