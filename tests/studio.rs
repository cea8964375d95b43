//! Pictures in the studio's light.

use glam::DVec3;
use image::DynamicImage;
use lightsquare::assets::{Assets, SetName};
use lightsquare::config::{Config, Look};
use lightsquare::notation::{Color, Placement};
use lightsquare::scene::{Reach, Scene, Stage};
use lightsquare::timeline::{Dials, Frame, Mover, Spot};
use lightsquare::tracer::{Antialiasing, render};

const ENDING: &str = "8/5k2/8/3q4/8/2N5/1P6/K7";

/// The scene of a placement with the default look, as `change` has it.
fn scene(fen: &str, change: impl Fn(&mut Config)) -> Scene {
    stage(change).scene(&Frame::still(Placement::from_fen(fen).unwrap()))
}

fn stage(change: impl Fn(&mut Config)) -> Stage {
    let mut config = Config { width: 90, height: 60, ..Config::new(Look::Studio) };
    config.render.subdivisions = 2;
    change(&mut config);
    let assets = Assets::load(&config, &SetName::Staunton).unwrap();
    Stage::new(&config, &assets, Reach::default()).unwrap()
}

fn picture(scene: &Scene, mode: Antialiasing) -> DynamicImage {
    render(scene, 90, 60, mode).0
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let scene = scene(ENDING, |_| {});
    for mode in [Antialiasing::Grid(2), Antialiasing::Adaptive { rays: 4, threshold: 0.02 }] {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| render(&scene, 90, 60, mode))
        };
        assert_eq!(with(1), with(3));
    }
}

/// What is drawn far from a piece that goes does not even crawl: its numbers are the pixel's own. (Pieces farther
/// away than four squares hide no sky.)
#[test]
fn nothing_changes_where_nothing_moved() {
    let mode = Antialiasing::Adaptive { rays: 4, threshold: 0.02 };
    let [before, after] = ["7q/5k2/8/8/8/2N5/1P6/K7", "7q/5k2/8/8/8/1PN5/8/K7"]
        .map(|fen| picture(&scene(fen, |_| {}), mode).into_rgb8());
    let differs = |x: u32, y: u32| {
        before.get_pixel(x, y).0.iter().zip(after.get_pixel(x, y).0).any(|(a, b)| a.abs_diff(b) > 2)
    };
    let all = (0..60).flat_map(|y| (0..90).map(move |x| (x, y)));
    let changed: Vec<(u32, u32)> = all.filter(|(x, y)| differs(*x, *y)).collect();
    assert!((10..400).contains(&changed.len()), "{}", changed.len());
    // b2 and b3 lie in the near left part of the picture.
    assert!(changed.iter().all(|(x, y)| *x < 55 && *y > 25), "{changed:?}");
}

#[test]
fn a_piece_takes_its_grain_along() {
    let stage = stage(|_| {});
    let mut frame = Frame::still(Placement::from_fen("8/8/8/8/8/8/4P3/8").unwrap());
    let at_home = stage.scene(&frame).objects.last().unwrap().seed;
    let square = lightsquare::notation::Square::E2;
    let piece = frame.placement.get(square).unwrap();
    frame.placement.set(square, None);
    let spot = Spot { file: 4.0, rank: 2.3, height: 0.1 };
    frame.movers = vec![Mover { piece, identity: square, spot, size: 1.0 }];
    assert_eq!(stage.scene(&frame).objects.last().unwrap().seed, at_home);
    let other = scene("8/8/8/8/8/8/3P4/8", |_| {});
    assert_ne!(other.objects.last().unwrap().seed, at_home);
}

/// The ground is transparent, the board is not, and the colour of an edge is the board's.
#[test]
fn a_transparent_ground_has_no_fringes() {
    let scene = scene(ENDING, |config| {
        config.theme = "print".to_owned();
        config.parts.background = Some(None);
    });
    let DynamicImage::ImageRgba8(picture) = picture(&scene, Antialiasing::Grid(4)) else {
        panic!("no alpha channel");
    };
    assert_eq!(picture.get_pixel(0, 0).0[3], 0);
    assert_eq!(picture.get_pixel(45, 30).0[3], 255);
    let edges: Vec<_> = picture.pixels().filter(|pixel| (1..255).contains(&pixel.0[3])).collect();
    assert!(edges.len() > 50, "{}", edges.len());
    // The frame is of paper: nothing black or grey has come into its edge from the ground.
    let bright = edges.iter().filter(|pixel| pixel.0[0] > 120).count();
    assert!(10 * bright > 9 * edges.len(), "{bright} of {}", edges.len());
}

/// A ball of one colour and no coat in a room that is equally bright all round is of that colour all
/// over, as far as it sees the room.
#[test]
fn an_even_room_lights_evenly() {
    let scene = scene("8/8/8/8/8/8/8/8", |config| {
        config.lights.clear();
        let white = DVec3::splat(0.5);
        (config.room.horizon, config.room.sky, config.room.zenith) = (white, white, white);
        config.parts.table = Some(None);
        for part in [&mut config.parts.light, &mut config.parts.dark, &mut config.parts.frame] {
            *part = Some("mid-grey".to_owned());
        }
        config.parts.inlay = Some(None);
    });
    let picture = picture(&scene, Antialiasing::Grid(2)).into_rgb8();
    let top = picture.get_pixel(45, 30).0;
    for (x, y) in [(30, 30), (45, 20), (60, 32), (45, 40)] {
        let there = picture.get_pixel(x, y).0;
        assert!(there.iter().zip(top).all(|(a, b)| a.abs_diff(b) <= 1), "{there:?} is not {top:?}");
    }
}

/// With one softbox as the only light, what is neither lit nor dark is the edge of a shadow.
#[test]
fn shadows_are_softer_the_larger_the_softbox_is() {
    let edge = |size: f64| {
        let scene = scene("8/8/8/8/4K3/8/8/8", |config| {
            config.lights.truncate(1);
            (config.lights[0].width, config.lights[0].height) = (size, size);
            let room = &mut config.room;
            (room.horizon, room.sky, room.zenith) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
            room.bounce = 0.0;
            config.theme = "print".to_owned();
            config.parts.dark = Some("paper".to_owned());
            config.parts.white = Some("paper".to_owned());
        });
        let picture = picture(&scene, Antialiasing::Grid(4)).into_rgb8();
        picture.pixels().filter(|pixel| (60..190).contains(&pixel.0[0])).count()
    };
    let [hard, soft, softer] = [1.0, 15.0, 40.0].map(edge);
    assert!(hard < soft && soft < softer, "{hard}, {soft}, {softer}");
}

#[test]
fn lights_turn_with_the_cameras_side_where_they_are_told_to() {
    use lightsquare::config::View;
    let key = |view: View, turns: bool| {
        let scene = scene(ENDING, |config| {
            config.camera.view = view;
            config.room.turns = turns;
        });
        scene.room.unwrap().softboxes[0].point((0.5, 0.5))
    };
    assert_eq!(key(View::White, false), key(View::Black, false));
    let middle = lightsquare::scene::MIDDLE;
    let [white, black] = [View::White, View::Black].map(|view| key(view, true) - middle);
    assert!((white + black).with_y(0.0).length() < 1e-9, "{white} and {black}");
}

/// From both sides of the board: the rocker's end on the side of the player to move is up, and his
/// lamp is lit.
#[test]
fn the_clock_shows_who_is_to_move_on_his_side() {
    use lightsquare::config::{ShowClock, View};
    for (view, running) in [View::White, View::Black, View::Player]
        .into_iter()
        .flat_map(|view| [Color::White, Color::Black].map(|running| (view, running)))
    {
        let stage = stage(|config| {
            config.camera.view = view;
            config.clock.show = ShowClock::Game;
        });
        let still = Frame::still(Placement::EMPTY);
        let others = stage.scene(&still).objects.len();
        let dials = Dials::Times { left: [Some(60), Some(70)], running: Some(running) };
        let objects = stage.scene(&Frame { dials: Some(dials), ..still }).objects;
        let [_, face, _, rocker] = &objects[others..] else { panic!("{}", objects.len()) };
        let side =
            |point: DVec3, from: DVec3| if point.z < from.z { Color::White } else { Color::Black };
        let [a, b] = [3.0, -3.0].map(|z| rocker.body.transform().transform_point3(DVec3::Z * z));
        let [up, down] = if a.y > b.y { [a, b] } else { [b, a] };
        assert!(up.y > down.y + 0.3 && side(up, down) == running, "{view:?}, {running:?}");
        let face_at =
            |x: f64, y: f64| face.body.transform().transform_point3(DVec3::new(1.52, y, x));
        let middle = face_at(0.0, 0.0);
        let grid = (0..400).flat_map(|x| (0..200).map(move |y| [f64::from(x), f64::from(y)]));
        let lit: Vec<DVec3> = grid
            .map(|[x, y]| face_at(0.028 * x - 5.6, 0.03 * y - 1.1))
            .filter(|point| {
                let (material, place) = face.material(*point, DVec3::ZERO);
                let color = face.color(material, place, 0.0);
                color.y > 3.0 * color.x && color.y > 0.5
            })
            .collect();
        assert!(
            lit.len() > 50 && lit.iter().all(|point| side(*point, middle) == running),
            "{view:?}"
        );
    }
}

/// Dark edges before a white or transparent ground are refined as others are.
#[test]
fn adaptive_samples_see_the_edges_of_what_is_dark() {
    let edges = |background: Option<DVec3>| {
        let scene = scene("8/8/8/3k4/8/8/8/8", |config| {
            config.theme = "print".to_owned();
            config.parts.frame = Some("ink".to_owned());
            config.parts.background = Some(background);
        });
        let picture = |mode| picture(&scene, mode).into_rgba8();
        let exact = picture(Antialiasing::Grid(16));
        let found = picture(Antialiasing::Adaptive { rays: 8, threshold: 0.02 });
        // What is hardly there has hardly a colour.
        let weighed = |pixel: &image::Rgba<u8>| {
            let [red, green, blue, alpha] = pixel.0.map(f64::from);
            [red * alpha / 255.0, green * alpha / 255.0, blue * alpha / 255.0, alpha]
        };
        let apart = |a: &image::Rgba<u8>, b: &image::Rgba<u8>| {
            let pairs = weighed(a).into_iter().zip(weighed(b));
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        exact.pixels().zip(found.pixels()).filter(|(a, b)| apart(a, b) > 30.0).count()
    };
    for background in [Some(DVec3::ONE), None] {
        // Of 5400; a hair that the first samples miss is missed.
        let wrong = edges(background);
        assert!(wrong < 30, "{background:?}: {wrong}");
    }
}
