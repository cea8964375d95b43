//! Pictures by packets of rays, held against those of the tracer that asks every object for every ray in
//! turn, in f64; and the plain way against AVX2's.

use assert_cmd::Command;
use glam::DVec3;
use image::DynamicImage;
use lightsquare::assets::{Assets, SetName};
use lightsquare::config::{Config, Look, ShowClock, View};
use lightsquare::notation::{Arrow, Brush, Circle, Placement, Square};
use lightsquare::scene::{Reach, Scene, Stage};
use lightsquare::timeline::{Dials, Frame, Marks};
use lightsquare::tracer::{Antialiasing, render, render_by_oracle};

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;

const ADAPTIVE: Antialiasing = Antialiasing::Adaptive { rays: 4, threshold: 0.03 };

const ENDING: &str = "8/5k2/8/3q1n2/8/2N2R2/1P2B3/K7";

/// The ending with marks of all kinds and a clock, with the settings of a look as `change` has them.
fn scene(look: Look, change: impl Fn(&mut Config)) -> Scene {
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
    let marks = Marks {
        last_move: vec![Square::C3, Square::E4],
        check: Some(Square::F7),
        circles: vec![Circle { square: Square::G2, brush: Brush::Red }],
        arrows: vec![Arrow { from: Square::D5, to: Square::A2, brush: Brush::Green }],
        ..Marks::default()
    };
    let frame = Frame {
        marks,
        dials: Some(Dials::Times { left: [Some(754), Some(59)], running: None }),
        ..Frame::still(Placement::from_fen(ENDING).unwrap())
    };
    Stage::new(&config, &assets, Reach::default()).unwrap().scene(&frame)
}

/// So many steps of 255 may rounding be.
const STEPS: u8 = 2;

/// How many pixels are farther apart.
fn beyond(one: &DynamicImage, other: &DynamicImage) -> usize {
    let [one, other] = [one, other].map(DynamicImage::to_rgba8);
    let apart = |a: &image::Rgba<u8>, b: &image::Rgba<u8>| {
        a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > STEPS)
    };
    one.pixels().zip(other.pixels()).filter(|(a, b)| apart(a, b)).count()
}

#[test]
fn packets_see_what_single_rays_see() {
    type Change = fn(&mut Config);
    let cases: [(&str, Look, Antialiasing, Change); 12] = [
        ("thesis", Look::Thesis, Antialiasing::None, |_| {}),
        ("thesis, grid", Look::Thesis, Antialiasing::Grid(2), |_| {}),
        ("thesis, adaptive", Look::Thesis, ADAPTIVE, |_| {}),
        ("thesis, above", Look::Thesis, Antialiasing::None, |c| c.camera.view = View::Top),
        ("thesis, wood", Look::Thesis, Antialiasing::None, |c| c.theme = "wood".to_owned()),
        ("thesis, marble", Look::Thesis, Antialiasing::None, |c| c.theme = "marble".to_owned()),
        ("thesis, glass", Look::Thesis, Antialiasing::None, glass),
        ("studio", Look::Studio, Antialiasing::Grid(2), |_| {}),
        ("studio, adaptive", Look::Studio, ADAPTIVE, |_| {}),
        ("studio, glass and metal", Look::Studio, Antialiasing::Grid(2), |c| {
            glass(c);
            c.parts.black = Some("brass".to_owned());
        }),
        ("studio, a lens", Look::Studio, Antialiasing::Grid(2), |c| c.camera.aperture = 2.0),
        ("studio, no ground", Look::Studio, Antialiasing::Grid(2), |c| {
            c.theme = "print".to_owned();
            c.parts.background = Some(None);
        }),
    ];
    for (name, look, mode, change) in cases {
        let scene = scene(look, change);
        let (found, rays) = render(&scene, WIDTH, HEIGHT, mode);
        let (expected, all) = render_by_oracle(&scene, WIDTH, HEIGHT, mode);
        let others = beyond(&found, &expected);
        // A hair decides at an edge; of 6144 pixels.
        assert!(others <= 12, "{name}: {others} pixels differ");
        let (rays, all) = (rays.total() as f64, all.total() as f64);
        assert!((rays / all - 1.0).abs() < 0.002, "{name}: {rays} rays, expected {all}");
    }
}

fn glass(config: &mut Config) {
    config.theme = "glass".to_owned();
    config.parts.background = Some(Some(DVec3::new(0.3, 0.34, 0.4)));
}

/// Without AVX2, pictures are the same to the byte. (Where the processor has none, both are plain.)
#[test]
fn the_plain_way_gives_the_same_bytes() {
    let looks: [&[&str]; 4] = [
        &["--look", "thesis", "--set", "thesis", "--aa", "adaptive"],
        &["--look", "thesis", "--theme", "marble", "--camera", "top"],
        &["--quality", "normal"],
        &["--theme", "glass", "--camera", "side", "--quality", "draft"],
    ];
    for options in looks {
        let folder = tempfile::tempdir().unwrap();
        let picture = |plain: bool| {
            let mut command = Command::cargo_bin("lightsquare").unwrap();
            command.current_dir(folder.path()).env_remove("LIGHTSQUARE_PLAIN");
            if plain {
                command.env("LIGHTSQUARE_PLAIN", "1");
            }
            command.args(["diagram", "--fen", ENDING, "-q", "-o", "found.bmp", "--size", "96x64"]);
            command.args(options).assert().success();
            std::fs::read(folder.path().join("found.bmp")).unwrap()
        };
        assert!(picture(true) == picture(false), "{options:?}");
    }
}
