//! Pictures of a game one after the other are, to the byte, what each of them is by itself.

use std::path::Path;

use glam::DVec3;
use image::DynamicImage;
use lightsquare::assets::{Assets, SetName};
use lightsquare::config::{Config, Look, ShowClock, View};
use lightsquare::game::{Game, Scanner, Source};
use lightsquare::job::Showing;
use lightsquare::notation::{Piece, Role, Square};
use lightsquare::scene::{Object, Scene, Stage};
use lightsquare::timeline::{Film, Frame, Gaze, Mover, Pause, Spot, Timeline};
use lightsquare::tracer::{Antialiasing, RayCounts, Tracer, render};

const WIDTH: u32 = 72;
const HEIGHT: u32 = 48;

const ADAPTIVE: Antialiasing = Antialiasing::Adaptive { rays: 3, threshold: 0.03 };

/// Three frames of each move, and one of each position.
const FILM: Film = Film {
    fps: 5.0,
    transition: 0.6,
    pause: Pause::Even(0.2),
    first: 0.2,
    last: 0.2,
    title: 0.0,
    result: 0.0,
};

/// Castling on both sides, en passant, a promotion that captures, mate; arrows, circles and clocks.
fn game() -> Game {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("games/demonstration.pgn");
    Source::open(&path).unwrap().games().next().unwrap().unwrap()
}

/// A game's film in small pictures.
struct Show {
    stage: Stage,
    frames: Vec<Frame>,
}

/// The demonstration with a clock, all marks, and captured pieces beside the board.
fn show(look: Look, change: impl Fn(&mut Config)) -> Show {
    show_of(&game(), look, change)
}

fn show_of(game: &Game, look: Look, change: impl Fn(&mut Config)) -> Show {
    let mut config = Config { width: WIDTH, height: HEIGHT, ..Config::new(look) };
    config.render.subdivisions = 2;
    config.marks = Config::new(Look::Studio).marks;
    config.clock.show = ShowClock::Game;
    change(&mut config);
    let set = match look {
        Look::Studio => SetName::Staunton,
        Look::Thesis => SetName::Thesis,
    };
    let assets = Assets::load(&config, &set).unwrap();
    let showing = Showing { film: FILM, animate: true, ..Showing::default() };
    let stage = Stage::new(&config, &assets, showing.reach(&config)).unwrap();
    let script = showing.script(&config, stage.bodies().clone());
    let timeline = Timeline::new(game, 0, game.plies.len(), &script).unwrap();
    let frames = (0..timeline.frames()).map(|index| timeline.frame(index)).collect();
    Show { stage, frames }
}

impl Show {
    /// The scenes of frames `first` to `last`.
    fn scenes(&self, first: usize, last: usize) -> Vec<Scene> {
        self.frames[first..=last].iter().map(|frame| self.stage.scene(frame)).collect()
    }
}

fn total(counts: impl IntoIterator<Item = RayCounts>) -> u64 {
    counts.into_iter().map(|counts| counts.total()).sum()
}

fn whole(scenes: &[Scene], mode: Antialiasing) -> Vec<(DynamicImage, RayCounts)> {
    scenes.iter().map(|scene| render(scene, WIDTH, HEIGHT, mode)).collect()
}

/// Traces scenes one after the other and finds the pictures that they have by themselves. Gives how many rays
/// that took, of one that all take by themselves.
fn assert_reuse(what: &str, scenes: &[Scene], mode: Antialiasing) -> f64 {
    let mut tracer = Tracer::new(WIDTH, HEIGHT, mode);
    let mut rays = Vec::new();
    let expected = whole(scenes, mode);
    for (index, (scene, (expected, _))) in scenes.iter().zip(&expected).enumerate() {
        let coming = scenes[index + 1..].iter().cloned();
        let (found, counts) = tracer.picture(scene, coming);
        rays.push(counts);
        let pairs = found.as_bytes().iter().zip(expected.as_bytes());
        let others = pairs.filter(|(a, b)| a != b).count();
        assert!(found == *expected, "{what}, {mode:?}, picture {index}: {others} bytes differ");
    }
    total(rays) as f64 / total(expected.into_iter().map(|(_, rays)| rays)) as f64
}

/// What the pictures below show, so that they can be relied upon.
#[test]
fn the_game_has_everything_that_can_change() {
    let Show { frames, .. } = show(Look::Thesis, |_| {});
    assert_eq!(frames.len(), 1 + 4 * 26);
    let movers = |count: usize| frames.iter().filter(|frame| frame.movers.len() == count).count();
    assert_eq!([0, 1, 2].map(movers), [27, 48, 30]);
    let castles = |frame: &&Frame| {
        let roles: Vec<Role> = frame.movers.iter().map(|mover| mover.piece.role).collect();
        roles.contains(&Role::King) && roles.contains(&Role::Rook)
    };
    assert!(frames.iter().filter(castles).count() >= 4);
    assert_eq!(frames.last().unwrap().taken.len(), 8);
    let changes = |same: fn(&Frame, &Frame) -> bool| {
        frames.windows(2).filter(|pair| !same(&pair[0], &pair[1])).count()
    };
    assert!(changes(|a, b| a.marks == b.marks) > 30 && changes(|a, b| a.dials == b.dials) > 30);
}

#[test]
fn a_game_in_a_row_has_the_pictures_that_it_has_one_by_one() {
    for (look, name) in [(Look::Thesis, "thesis"), (Look::Studio, "studio")] {
        for view in [View::White, View::Top] {
            let show = show(look, |config| config.camera.view = view);
            let scenes = show.scenes(0, show.frames.len() - 1);
            for mode in [Antialiasing::None, Antialiasing::Grid(2), ADAPTIVE] {
                let share = assert_reuse(&format!("{name}, {view:?}"), &scenes, mode);
                assert!(share < 0.75, "{name}, {view:?}, {mode:?}: {share} of the rays");
            }
        }
    }
}

/// A drop, and pieces that change colour; an explosion.
#[test]
fn games_by_other_rules_in_a_row_have_the_pictures_that_they_have_one_by_one() {
    for (variant, moves, movers) in [
        ("crazyhouse", "1. e4 d5 2. exd5 Qxd5 3. @e6 @d4 *", 2),
        ("atomic", "1. Nf3 a6 2. Ne5 a5 3. Nxd7 *", 5),
    ] {
        let text = format!("[Variant \"{variant}\"]\n\n{moves}");
        for look in [Look::Thesis, Look::Studio] {
            let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
            let show = show_of(&Game::read(scanned, 1), look, |_| {});
            assert!(show.frames.iter().any(|frame| frame.movers.len() == movers), "{variant}");
            let scenes = show.scenes(0, show.frames.len() - 1);
            for mode in [Antialiasing::None, ADAPTIVE] {
                assert_reuse(&format!("{variant}, {look:?}"), &scenes, mode);
            }
        }
    }
}

/// From before the promotion to after it.
const FIRST: usize = 62;
const LAST: usize = 72;

#[test]
fn glass_and_lenses_and_grounds_change_nothing() {
    type Change = fn(&mut Config);
    let cases: [(&str, Look, Change); 10] = [
        ("glass", Look::Thesis, |config| config.theme = "glass".to_owned()),
        ("glass", Look::Studio, |config| config.theme = "glass".to_owned()),
        ("marble", Look::Thesis, |config| config.theme = "marble".to_owned()),
        ("print", Look::Studio, |config| config.theme = "print".to_owned()),
        ("a lens", Look::Studio, |config| config.camera.aperture = 2.0),
        // More softboxes than there are bits for.
        ("many lights", Look::Studio, |config| {
            config.lights = config.lights.iter().cycle().take(40).copied().collect();
            config.lights.iter_mut().for_each(|light| light.color *= 0.07);
        }),
        ("points and what is below", Look::Studio, |config| {
            (config.lights[0].width, config.lights[0].height) = (0.0, 0.0);
            config.lights[1].position.y = -9.0;
        }),
        ("a black sky", Look::Studio, |config| {
            let room = &mut config.room;
            (room.horizon, room.sky, room.zenith) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        }),
        // Shares that lie between two bytes.
        ("a grey ground", Look::Thesis, |config| {
            config.parts.background = Some(Some(DVec3::new(0.1, 0.3, 0.7)));
        }),
        ("no ground", Look::Thesis, |config| config.parts.background = Some(None)),
    ];
    for (name, look, change) in cases {
        let scenes = show(look, change).scenes(FIRST, LAST);
        for mode in [Antialiasing::Grid(3), ADAPTIVE] {
            assert_reuse(&format!("{name}, {look:?}"), &scenes, mode);
        }
    }
}

/// Pixels that begin with more samples than the fewest, or go on at edges.
#[test]
fn any_number_of_samples_changes_nothing() {
    let scenes = show(Look::Studio, |_| {}).scenes(FIRST, LAST);
    let adaptive = |rays| Antialiasing::Adaptive { rays, threshold: 0.02 };
    for mode in [Antialiasing::None, adaptive(4), adaptive(8), adaptive(12)] {
        assert_reuse("studio", &scenes, mode);
    }
}

/// A frame with every third of the standing pieces in the air, and as far to the left, some of them beside the
/// board.
fn lifted(mut frame: Frame, height: f64) -> Frame {
    let some: Vec<(Square, Piece)> = frame.placement.iter().step_by(3).collect();
    for (square, piece) in some {
        frame.placement.set(square, None);
        let on = Spot::on(square);
        frame.movers.push(Mover {
            piece,
            identity: frame.identities.get(square),
            spot: Spot { file: on.file - 3.0 * height, height, ..on },
            size: 1.0 - 0.3 * height,
        });
    }
    frame
}

/// Backwards, by leaps, and between pictures that have nothing in common.
#[test]
fn any_picture_may_follow_any_other() {
    for look in [Look::Thesis, Look::Studio] {
        let show = show(look, |_| {});
        let frame = |index: usize| show.frames[index].clone();
        let turned =
            |index: usize| Frame { gaze: Gaze { orbit: 20.0, ..Gaze::default() }, ..frame(index) };
        let mut frames: Vec<Frame> = [70, 70, 66, 65, 64, 104, 0, 67, 3].map(frame).to_vec();
        frames.extend([turned(3), turned(3), turned(4), turned(65), frame(65), frame(66)]);
        frames.extend(
            [(65, 0.2), (65, 0.5), (66, 0.5), (66, 1.0), (69, 0.0)]
                .map(|(index, height)| lifted(frame(index), height)),
        );
        let mut scenes: Vec<Scene> = frames.iter().map(|frame| show.stage.scene(frame)).collect();
        let mut dark = show.stage.scene(&frame(67));
        dark.background = Some(DVec3::ZERO);
        scenes.extend([dark.clone(), dark, show.stage.scene(&frame(67))]);
        for mode in [Antialiasing::None, ADAPTIVE] {
            assert_reuse(&format!("{look:?}"), &scenes, mode);
        }
    }
}

/// Bodies are the same in scenes that are built anew; a clock's faces too, that are looked at ahead of their time.
#[test]
fn scenes_that_are_built_anew_are_known_again() {
    for look in [Look::Thesis, Look::Studio] {
        let Show { stage, frames } = show(look, |_| {});
        let frames = &frames[..24];
        let dials = frames.windows(2).filter(|pair| pair[0].dials != pair[1].dials).count();
        assert!(dials > 4, "the clock runs");
        let mut tracer = Tracer::new(WIDTH, HEIGHT, ADAPTIVE);
        let (mut rays, mut all) = (0, 0);
        for (index, frame) in frames.iter().enumerate() {
            let coming = frames[index + 1..].iter().map(|frame| stage.scene(frame));
            let (found, counts) = tracer.picture(&stage.scene(frame), coming);
            let (expected, whole) = render(&stage.scene(frame), WIDTH, HEIGHT, ADAPTIVE);
            assert!(found == expected, "{look:?}, picture {index}");
            (rays, all) = (rays + counts.total(), all + whole.total());
        }
        assert!(2 * rays < all, "{look:?}: {rays} rays of {all}");
    }
}

/// Bodies in one place, twice the same body, and bodies in another order.
#[test]
fn bodies_that_are_in_each_others_place_are_seen_as_they_are() {
    let Show { stage, frames } = show(Look::Thesis, |config| config.theme = "glass".to_owned());
    let scene = stage.scene(&frames[0]);
    let change = |change: fn(&mut Vec<Object>)| {
        let mut scene = scene.clone();
        change(&mut scene.objects);
        scene
    };
    let scenes = [
        change(|_| {}),
        change(|objects| objects.extend_from_within(objects.len() - 2..)),
        change(|objects| objects.extend_from_within(objects.len() - 1..)),
        change(|_| {}),
        change(|objects| objects.reverse()),
        change(|objects| objects.rotate_left(3)),
        change(|objects| objects.truncate(20)),
    ];
    assert_reuse("in one place", &scenes, Antialiasing::Grid(2));
}

/// What is told of pictures to come need not be true.
#[test]
fn pictures_are_the_same_whatever_was_told_of_them() {
    type Told = fn(&[Scene], usize) -> Vec<Scene>;
    let cases: [(&str, Told); 4] = [
        ("nothing", |_, _| Vec::new()),
        ("what is past", |scenes, index| scenes[..index].iter().rev().cloned().collect()),
        ("every other one", |scenes, index| scenes[index..].iter().step_by(2).cloned().collect()),
        ("the same again", |scenes, index| vec![scenes[index].clone(); 3]),
    ];
    for look in [Look::Thesis, Look::Studio] {
        let scenes = show(look, |_| {}).scenes(FIRST, LAST);
        let expected = whole(&scenes, ADAPTIVE);
        for (told, coming) in cases {
            let mut tracer = Tracer::new(WIDTH, HEIGHT, ADAPTIVE);
            for (index, scene) in scenes.iter().enumerate() {
                let found = tracer.picture(scene, coming(&scenes, index)).0;
                assert!(found == expected[index].0, "{look:?}, told {told}: picture {index}");
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    for look in [Look::Thesis, Look::Studio] {
        let scenes = show(look, |_| {}).scenes(FIRST, LAST);
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut tracer = Tracer::new(WIDTH, HEIGHT, ADAPTIVE);
            let picture =
                |index: usize| tracer.picture(&scenes[index], scenes[index + 1..].to_vec());
            pool.install(|| (0..scenes.len()).map(picture).collect::<Vec<_>>())
        };
        let alone = with(1);
        for threads in [2, 5] {
            assert!(with(threads) == alone, "{look:?}: {threads} threads");
        }
    }
}

/// Where rays look out for smaller bodies than those that come, some of what changes is missed: what holds
/// pictures together is what is held here.
#[test]
fn a_body_that_is_wider_than_its_envelope_is_caught() {
    for look in [Look::Thesis, Look::Studio] {
        let show = show(look, |_| {});
        let scenes = show.scenes(0, show.frames.len() - 1);
        let mode = Antialiasing::None;
        let expected = whole(&scenes, mode);
        let wrong = |share: f64| {
            let mut tracer = Tracer::new(WIDTH, HEIGHT, mode).shrunk(share);
            let is_wrong = |index: &usize| {
                let coming = scenes[index + 1..].iter().cloned();
                tracer.picture(&scenes[*index], coming).0 != expected[*index].0
            };
            (0..scenes.len()).filter(is_wrong).count()
        };
        assert_eq!(wrong(1.0), 0, "{look:?}");
        let found = wrong(0.7);
        assert!(found > 10, "{look:?}: {found} of {}", scenes.len());
    }
}
