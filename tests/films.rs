//! Films and variations as the command makes them.

mod seen;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use glam::DVec3;
use image::RgbImage;
use lightsquare::assets::{Assets, SetName};
use lightsquare::config::{Config, Orientation, ShowClock, VIEWS, View};
use lightsquare::job::Showing;
use lightsquare::notation::Placement;
use lightsquare::scene::{Stage, TO_MOVER};
use lightsquare::timeline::{Dials, Frame, Gaze};
use serde_json::Value;
use tempfile::TempDir;

const GAME: &str = "[White \"Anand\"]\n[Black \"Topalov\"]\n[Result \"1-0\"]\n[TimeControl \"60\"]\n\n\
    1. e4 {[%clk 0:00:55]} d5 {[%clk 0:00:50]} 2. exd5 {[%clk 0:00:41]} Qxd5 {[%clk 0:00:39]} 1-0\n";

/// Half a second for everything, at four frames a second.
const TIMES: [&str; 11] = [
    "--animate",
    "--fps",
    "4",
    "--transition",
    "0.5",
    "--pause",
    "0.5",
    "--first",
    "0.5",
    "--last",
    "0.5",
];

const TINY: [&str; 2] = ["--size", "24x16"];

/// Runs the command in `folder` with a game on its standard input; its exit code and messages.
fn run(folder: &Path, parts: &[&[&str]], input: &str) -> (i32, String) {
    let output = Command::cargo_bin("lightsquare")
        .unwrap()
        .current_dir(folder)
        .args(parts.concat())
        .args(["--look", "thesis", "--aa", "none", "--cpu", "1"])
        .write_stdin(input)
        .output()
        .unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

/// Runs what has to go well and say nothing.
fn done(folder: &Path, parts: &[&[&str]], input: &str) {
    let all = [parts, &[&["-q"][..]]].concat();
    assert_eq!(run(folder, &all, input), (0, String::new()), "{all:?}");
}

/// All files and folders below `folder`, by their paths in it; files with their bytes.
fn tree(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            let within = tree(&path).into_iter();
            found.extend(within.map(|(below, bytes)| (format!("{name}/{below}"), bytes)));
            found.insert(format!("{name}/"), Vec::new());
        } else {
            found.insert(name, fs::read(&path).unwrap());
        }
    }
    found
}

fn names(folder: &Path) -> Vec<String> {
    tree(folder).into_keys().collect()
}

/// Names of frames `first` to `last` in a folder, which ends in `/` if it is not empty.
fn frames(folder: &str, first: usize, last: usize) -> impl Iterator<Item = String> {
    (first..=last).map(move |index| format!("{folder}frame_{index:05}.png"))
}

fn json(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).unwrap()
}

fn rows(manifest: &[u8]) -> Vec<Value> {
    json(manifest)["frames"].as_array().unwrap().clone()
}

fn picture(path: PathBuf) -> RgbImage {
    image::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).to_rgb8()
}

#[test]
fn a_part_of_a_film_is_what_the_whole_has_there() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let shows = ["--captions", "--clock", "--title=0.5", "--result=0.5", "--size", "120x76"];
    let camera = ["--camera", "mover", "--orbit", "40"];
    let film = |out: &str, camera: &[&str], part: &[&str]| {
        done(here, &[&["render", "-", "-o", out], &TIMES, &shows, camera, part], GAME);
    };
    let of = |out: &str| here.join(out).join("stdin/0001-anand-topalov");
    film("whole", &camera, &[]);
    let whole = tree(&of("whole"));
    let mut expected: Vec<String> = frames("", 0, 21).collect();
    expected.push("game.json".to_owned());
    assert_eq!(names(&of("whole")), expected);
    let whole_rows = rows(&whole["game.json"]);

    // Out of the title, one in a move, into the result.
    for (first, last) in [(0, 3), (7, 7), (17, 21)] {
        let (out, part) = (format!("part-{first}"), format!("{first}-{last}"));
        film(&out, &camera, &["--frames", &part]);
        let found = tree(&of(&out));
        let manifest = format!("game_{first:05}-{last:05}.json");
        let expected = frames("", first, last).chain([manifest.clone()]).collect::<Vec<_>>();
        assert_eq!(found.keys().collect::<Vec<_>>(), expected.iter().collect::<Vec<_>>());
        for name in frames("", first, last) {
            assert!(found[&name] == whole[&name], "{name} of {part}");
        }
        assert_eq!(rows(&found[&manifest]), whole_rows[first..=last], "{part}");
        // All but its rows is as in the whole's.
        let mut manifests = [&found[&manifest], &whole["game.json"]].map(|bytes| json(bytes));
        for manifest in &mut manifests {
            (manifest["frames"], manifest["fingerprint"]) = (Value::Null, Value::Null);
        }
        assert_eq!(manifests[0], manifests[1], "{part}");
    }

    // Among the whole's pictures, those of the part alone are others.
    film("whole", &["--camera", "top"], &["--frames", "5-8"]);
    let among = tree(&of("whole"));
    let changed = among.iter().filter(|(name, bytes)| whole.get(*name) != Some(bytes));
    let changed: Vec<&String> = changed.map(|(name, _)| name).collect();
    let mut expected: Vec<String> = frames("", 5, 8).collect();
    expected.push("game_00005-00008.json".to_owned());
    assert_eq!(changed, expected.iter().collect::<Vec<_>>());
    assert_eq!(among.len(), whole.len() + 1);

    film("whole", &camera, &[]);
    assert!(tree(&of("whole")) == whole, "{:?}", names(&of("whole")));
}

#[test]
fn variations_have_folders_within_their_games() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    let game = Path::new(env!("CARGO_MANIFEST_DIR")).join("games/demonstration.pgn");
    let render = ["render", game.to_str().unwrap(), "-o", "out"];
    done(here, &[&render, &TINY, &["--variations"]], "");

    let of_game = here.join("out/demonstration/0001-white-black");
    let found = tree(&of_game);
    let main = rows(&found["game.json"]);
    // Each with the position before its first move, how many positions it has, and its last move.
    let variations =
        [("11w-d4/", 20, 2, "d4"), ("7w-dxc7/", 12, 5, "Bd6"), ("7w-dxc7/8w-h3/", 14, 3, "Bh5")];
    let mut expected: Vec<String> = frames("", 0, 26).collect();
    expected.push("game.json".to_owned());
    for (name, first, positions, last_move) in variations {
        expected.extend([name.to_owned(), format!("{name}game.json")]);
        expected.extend(frames(name, 0, positions - 1));
        let manifest = json(&found[&format!("{name}game.json")]);
        assert_eq!(manifest["variation"], name.trim_end_matches('/'));
        assert_eq!(manifest["result"], "*");
        let rows = manifest["frames"].as_array().unwrap();
        let plies: Vec<&Value> = rows.iter().map(|row| &row["ply"]).collect();
        assert_eq!(plies, (first..first + positions).collect::<Vec<_>>(), "{name}");
        assert_eq!(rows[positions - 1]["san"], last_move, "{name}");
        // A nested one leaves another line than the game's.
        let line = if name == "7w-dxc7/8w-h3/" {
            json(&found["7w-dxc7/game.json"])["frames"][first - 12].clone()
        } else {
            main[first].clone()
        };
        assert_eq!((&rows[0]["fen"], &rows[0]["san"]), (&line["fen"], &line["san"]), "{name}");
    }
    expected.sort();
    assert_eq!(found.into_keys().collect::<Vec<_>>(), expected);
    assert_eq!(json(&fs::read(of_game.join("game.json")).unwrap()).get("variation"), None);

    // What a run without them leaves: what is not lightsquare's.
    let foreign = ["notes/plan.txt", "12w-mine", "11w-d4/mine.txt", "7w-dxc7/8w-h3/notes/x.png"];
    for path in foreign.map(|path| of_game.join(path)) {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, "mine").unwrap();
    }
    done(here, &[&render, &TINY], "");
    let mut expected: Vec<String> = frames("", 0, 26).collect();
    let folders = ["notes/", "11w-d4/", "7w-dxc7/", "7w-dxc7/8w-h3/", "7w-dxc7/8w-h3/notes/"];
    expected.extend(["game.json"].iter().chain(&foreign).chain(&folders).map(|n| (*n).to_owned()));
    expected.sort();
    assert_eq!(names(&of_game), expected);

    for path in ["11w-d4/mine.txt", "7w-dxc7/8w-h3/notes/x.png"] {
        fs::remove_file(of_game.join(path)).unwrap();
    }
    fs::remove_dir(of_game.join("7w-dxc7/8w-h3/notes")).unwrap();
    done(here, &[&render, &TINY], "");
    assert!(!of_game.join("11w-d4").exists() && !of_game.join("7w-dxc7").exists());
}

#[test]
fn a_variation_that_cannot_be_played_is_said_and_reported() {
    let folder = TempDir::new().unwrap();
    let game = "1. e4 (1. Bf9) e5 (1... Ke5 2. d4) *";
    let render = ["render", "-", "-o", "out"];
    let (code, messages) = run(folder.path(), &[&render, &TINY, &["--variations"]], game);
    assert_eq!(code, 3, "{messages}");
    let report = json(&fs::read(folder.path().join("out/stdin/report.jsonl")).unwrap());
    assert_eq!((&report["status"], &report["frames"]), (&"partial".into(), &3.into()));
    let variations = report["variations"].as_array().unwrap();
    for (token, plies) in [("Bf9", 0), ("Ke5", 1)] {
        let sentence = messages.lines().find(|line| line.contains(&format!("`{token}`")));
        assert!(sentence.is_some_and(|line| line.contains("line 1")), "{messages}");
        let of_it = |line: &&Value| line["problems"][0]["token"] == token;
        let line = variations.iter().find(of_it).unwrap();
        assert_eq!(line["folder"], Value::Null);
        assert_eq!((&line["plies"], &line["frames"]), (&plies.into(), &0.into()), "{token}");
    }
    assert_eq!(variations.len(), 2);
    assert!(
        names(&folder.path().join("out/stdin/0001-white-black"))
            .iter()
            .all(|name| { name == "game.json" || name.starts_with("frame_") })
    );

    // Who does not ask for variations misses nothing.
    let (code, messages) = run(folder.path(), &[&render, &TINY], game);
    assert_eq!(code, 0, "{messages}");
}

/// Key frames: when, position, look-at, and FOV and roll.
const PATH: [(&str, [f64; 3], [f64; 3], &str); 3] = [
    ("1w", [45.0, 40.0, -40.0], [14.0, 0.0, 14.0], "70"),
    ("2w", [10.0, 45.0, -35.0], [12.0, 0.0, 16.0], "80 | 10"),
    ("end", [-25.0, 30.0, -15.0], [20.0, 0.0, 12.0], "80 | -5"),
];

/// Settings with the path, its points changed by `change`.
fn path(change: impl Fn([f64; 3]) -> [f64; 3]) -> String {
    let place = |point| change(point).map(|number| number.to_string()).join(",");
    let line = |(when, position, look_at, rest)| {
        format!("{when} = {} | {} | {rest}\n", place(position), place(look_at))
    };
    format!("[CameraPath]\n{}", PATH.map(line).concat())
}

#[test]
fn a_path_is_turned_by_half_a_turn_for_black() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    fs::write(here.join("path.ini"), path(|point| point)).unwrap();
    fs::write(here.join("mirrored.ini"), path(|[x, y, z]| [28.0 - x, y, 28.0 - z])).unwrap();
    let film = |out: &str, arguments: &[&str]| {
        let render = ["render", "-", "-o", out, "--size", "48x32"];
        done(here, &[&render, &TIMES, arguments], GAME);
        let game = here.join(out).join("stdin/0001-anand-topalov");
        let pictures: Vec<RgbImage> =
            frames("", 0, 17).map(|name| picture(game.join(name))).collect();
        (rows(&fs::read(game.join("game.json")).unwrap()), pictures)
    };
    let (rows, plain) = film("plain", &["-c", "path.ini"]);
    let (_, flipped) = film("flipped", &["-c", "path.ini", "--flip"]);
    let (_, mirrored) = film("mirrored", &["-c", "mirrored.ini"]);

    // Moves end at 1, 2, 3 and 4 s.
    assert_eq!(rows.len(), 18);
    let place = |row: &Value, what: &str| row["camera"]["pose"][what].clone();
    for (frame, (when, position, look_at, _)) in
        [(0, PATH[0]), (4, PATH[0]), (12, PATH[1]), (17, PATH[2])]
    {
        assert_eq!(place(&rows[frame], "position"), Value::from(position.to_vec()), "{when}");
        assert_eq!(place(&rows[frame], "look_at"), Value::from(look_at.to_vec()), "{when}");
    }
    assert_ne!(place(&rows[8], "position"), place(&rows[4], "position"));

    for index in 0..18 {
        assert!(flipped[index] != plain[index], "frame {index}");
        // Turned cameras and turned points differ by rounding, which may show at an edge.
        let pairs = flipped[index].pixels().zip(mirrored[index].pixels());
        let others = pairs.filter(|(a, b)| a != b).count();
        assert!(others <= 3, "frame {index}: {others} pixels");
    }
}

#[test]
fn a_diagram_is_the_picture_that_the_game_has_of_the_position() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    fs::write(here.join("path.ini"), path(|point| point)).unwrap();
    let common = ["--captured", "beside", "--clock", "--size", "48x32"];
    let cameras: [&[&str]; 4] = [
        &["--camera", "mover"],
        &["--camera", "follow"],
        &["-c", "path.ini"],
        &["--camera", "mover", "--flip"],
    ];
    for camera in cameras {
        done(here, &[&["render", "-", "-o", "out"], &common, camera], GAME);
        let game = here.join("out/stdin/0001-anand-topalov");
        let mut seen: Vec<RgbImage> = Vec::new();
        for (at, name) in ["start", "1w", "1b", "2w", "2b"].iter().zip(frames("", 0, 4)) {
            done(here, &[&["diagram", "-", "--at", at, "-o", "at.png"], &common, camera], GAME);
            let diagram = picture(here.join("at.png"));
            assert!(diagram == picture(game.join(name)), "{camera:?}, {at}");
            // The path rests until its first key frame, but the pieces do not.
            assert!(!seen.contains(&diagram), "{camera:?}, {at}");
            seen.push(diagram);
        }
    }
}

#[test]
fn pictures_hold_the_clock_all_the_way_round() {
    let dials = Dials::Times { left: [Some(60), Some(59)], running: None };
    let ticking = Frame { dials: Some(dials), ..Frame::still(Placement::EMPTY) };
    for (name, view) in VIEWS {
        if !["white", "black", "top", "side", "player", "mover"].contains(&name) {
            continue;
        }
        for orientation in [Orientation::White, Orientation::Black] {
            for (width, height) in [(300, 200), (180, 320)] {
                for orbit in [-60.0, 60.0] {
                    let mut config = Config { width, height, ..Config::default() };
                    (config.camera.view, config.camera.orientation) = (view, orientation);
                    config.clock.show = ShowClock::Game;
                    let assets = Assets::load(&config, &SetName::Staunton).unwrap();
                    let showing = Showing { animate: true, orbit, ..Showing::default() };
                    let stage = Stage::new(&config, &assets, showing.reach(&config)).unwrap();
                    let without = stage.scene(&Frame::still(Placement::EMPTY)).objects.len();
                    let clock = stage.scene(&ticking).objects.split_off(without);
                    let corners: Vec<DVec3> = clock
                        .iter()
                        .flat_map(|part| {
                            let (own, place) = (part.body.solid().bounds(), part.body.transform());
                            own.corners().map(|corner| place.transform_point3(corner))
                        })
                        .collect();
                    assert_eq!(corners.len(), 32, "case, face, pivot and rocker");
                    for share in 0..=60 {
                        let turn = orbit * f64::from(share) / 60.0;
                        let mover = if view == View::Mover { TO_MOVER } else { 0.0 };
                        for orbit in [turn, turn + mover / 2.0, turn + mover] {
                            let gaze = Gaze { orbit, ..Gaze::default() };
                            let camera = stage.scene(&Frame { gaze, ..ticking.clone() }).camera;
                            let aspect = f64::from(width) / f64::from(height);
                            let most = corners.iter().map(|c| seen::beyond(&camera, *c, aspect));
                            let most = most.fold(0.0, f64::max);
                            let what = format!("{name}, {orientation:?}, {width}, {orbit}");
                            assert!(most < 1.0, "{what}: {most}");
                        }
                    }
                }
            }
        }
    }
}
