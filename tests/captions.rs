//! Pictures with captions, as the command makes them.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use image::{DynamicImage, GenericImageView};
use lightsquare::assets::SetName;
use lightsquare::config::{Config, Look};
use lightsquare::game::{Letters, Moment, Wanted};
use lightsquare::job::{Films, PictureSettings, Progress, RenderJob, Showing, render};
use lightsquare::output::{FrameNames, PictureFormat};
use lightsquare::timeline::Film;
use tempfile::TempDir;

const GAME: &str = "[White \"Anand\"]\n[Black \"Topalov\"]\n\n1. e4 e5 *\n";

/// Runs the command in `folder`; its exit code and messages.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let output = Command::cargo_bin("lightsquare")
        .unwrap()
        .current_dir(folder)
        .args(arguments)
        .args(["--look", "thesis", "--aa", "none", "--cpu", "1"])
        .write_stdin(GAME)
        .output()
        .unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

/// A diagram of so many pixels.
fn diagram(folder: &Path, size: &str, arguments: &[&str]) -> DynamicImage {
    let all = [&["diagram", "-o", "found.png", "--size", size], arguments].concat();
    assert_eq!(run(folder, &all), (0, "found.png is written\n".to_owned()), "{all:?}");
    image::open(folder.join("found.png")).unwrap()
}

fn rows(picture: &DynamicImage, from: u32, to: u32) -> DynamicImage {
    picture.crop_imm(0, from, picture.width(), to - from)
}

#[test]
fn the_scene_above_the_strip_is_the_one_of_a_lower_picture() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let captioned = diagram(here, "160x100", &["-", "--captions"]);
    assert_eq!(captioned.dimensions(), (160, 100));
    let lower = diagram(here, "160x81", &["-"]);
    assert_eq!(rows(&captioned, 0, 81), lower);
    // Transparent is the scene alone.
    let captioned = diagram(here, "160x100", &["-", "--captions", "--transparent"]);
    let opaque = |picture: DynamicImage| picture.to_rgba8().pixels().all(|pixel| pixel.0[3] == 255);
    assert!(!opaque(rows(&captioned, 0, 81)) && opaque(rows(&captioned, 81, 100)));
}

#[test]
fn a_position_of_no_game_says_who_is_to_move_if_that_is_known() {
    let folder = TempDir::new().unwrap();
    let strip = |side: &str| {
        let fen = format!("8/8/8/3k4/8/8/4P3/4K3{side}");
        let picture = diagram(folder.path(), "160x100", &["--fen", &fen, "--captions"]);
        let bare = diagram(folder.path(), "160x100", &["--fen", &fen]);
        (picture != bare).then(|| rows(&picture, 81, 100))
    };
    let [white, black, unknown] = [" w - - 0 1", " b - - 0 1", ""].map(strip);
    assert!(white.is_some() && black.is_some() && white != black);
    assert_eq!(unknown, None);
}

#[test]
fn while_a_move_is_under_way_its_words_stand_still() {
    let folder = TempDir::new().unwrap();
    let arguments = ["render", "-", "-o", "out", "--animate", "--fps", "5", "--last", "0.4"];
    let picture = ["--captions", "--size", "160x100", "-q"];
    let (code, messages) = run(folder.path(), &[&arguments[..], &picture].concat());
    assert_eq!((code, messages.as_str()), (0, ""));
    let frames = folder.path().join("out/stdin/0001-anand-topalov");
    let pictures: Vec<DynamicImage> = (0..16)
        .map(|index| image::open(frames.join(format!("frame_{index:05}.png"))).unwrap())
        .collect();
    // Moves from 1.0 to 1.6 s and from 2.4 to 3.0 s; at its very beginning one is only named.
    let changes = |part: fn(&DynamicImage) -> DynamicImage| {
        let changed = pictures.windows(2).map(|pair| part(&pair[0]) != part(&pair[1]));
        changed.enumerate().filter(|(_, is)| *is).map(|(index, _)| index + 1).collect::<Vec<_>>()
    };
    assert_eq!(changes(|picture| rows(picture, 81, 100)), [5, 8, 12, 15]);
    assert_eq!(changes(|picture| rows(picture, 0, 81)), [6, 7, 8, 13, 14, 15]);
}

/// Nobody watches.
struct Unwatched;

impl Progress for Unwatched {
    fn begin(&self, _frames: u64) {}
    fn game(&self, _name: &str) {}
    fn frame_done(&self) {}
    fn say(&self, _text: &str) {}
    fn detail(&self, _text: &str) {}
    fn is_cancelled(&self) -> bool {
        false
    }
}

#[test]
fn a_pause_is_traced_once() {
    let folder = TempDir::new().unwrap();
    let game = folder.path().join("game.pgn");
    fs::write(&game, "[White \"Anand\"]\n\n*\n").unwrap();
    let rays = |fps: f64| {
        let mut config = Config { width: 160, height: 100, ..Config::new(Look::Thesis) };
        config.captions.show = true;
        let job = RenderJob {
            inputs: vec![game.clone()],
            out: folder.path().join(format!("out-{fps}")),
            wanted: Wanted::default(),
            letters: Letters::Auto,
            from: Moment::Ply(0),
            to: Moment::End,
            variations: false,
            frames: None,
            every: 1,
            refuses_old: false,
            names: Some(FrameNames::new(PictureFormat::Png)),
            films: Films::default(),
            showing: Showing {
                film: Film { fps, ..Film::default() },
                animate: true,
                ..Showing::default()
            },
            picture: PictureSettings {
                config,
                config_file: None,
                set: SetName::Thesis,
                threads: Some(1),
            },
        };
        let summary = render(&job, &Unwatched).unwrap();
        (summary.frames, summary.rays)
    };
    let (few, many) = (rays(1.0), rays(3.0));
    assert_eq!((few.0, many.0), (6, 18));
    assert_eq!(few.1, many.1);
}

#[test]
fn captions_that_have_no_room_are_refused_before_any_work() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    fs::write(here.join("low.ini"), "[Captions]\nShow=yes\nHeight=0.05\n").unwrap();
    fs::write(here.join("wrong.ini"), "[Captions]\nHeight=0.5\nTone=drak\nPlayer=no\n").unwrap();
    for (arguments, messages) in [
        (
            vec!["--captions", "--size", "64x48"],
            vec!["a picture of 64 x 48 pixels has no room for them, expected at least 120 x 76"],
        ),
        (
            vec!["-c", "low.ini", "--size", "200x100"],
            vec!["captions: Height makes a strip of 5 rows of pixels, expected at least 19"],
        ),
        (
            vec!["-c", "wrong.ini"],
            vec![
                "line 2: Height is `0.5`, expected a number from 0 to 0.4",
                "line 3: Tone is `drak`, expected one of auto, dark, light (did you mean `dark`?)",
                "line 4: there is no key `Player`, did you mean `Players`?",
            ],
        ),
    ] {
        for command in ["render", "diagram"] {
            let all = [&[command, "-", "-o", "out.png"], &arguments[..]].concat();
            let (code, found) = run(here, &all);
            assert_eq!(code, 1, "{all:?}: {found}");
            assert!(messages.iter().all(|message| found.contains(message)), "{all:?}: {found}");
            assert!(!here.join("out.png").exists(), "{all:?}");
        }
    }
}
