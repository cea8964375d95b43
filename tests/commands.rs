//! The thesis's command line, scenes for POV-Ray, settings as they are in force, measurements.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use image::RgbImage;
use lightsquare::config::Config;
use serde_json::Value;
use tempfile::TempDir;

/// The thesis's excerpt, with a second light where it prints only one.
const EXCERPT: &str = "[GlobalSettings]\r\nImageWidth=120\r\nImageHeight=90\r\n\
    BackgroundColor=0,0,0\r\nLightCount=2\r\nModelCount=0\r\nSnellIndex=1.0\r\n\
    [Light0]\r\nPosition=0,150,-50\r\nColor=0.8,0.8,0.8\r\n\
    [Light1]\r\nPosition=90,90,20\r\nColor=0.5,0.5,0.5\r\n\
    [Camera]\r\nPosition=45,15,-30\r\nLookAt=14,0,14\r\nFOV=90\r\nZRot=10\r\n";

const WHITE: &str = "VA1JB1SC1KD1DE1SF1JG1VH1PA2PB2PC2PD2PE2PF2PG2PH2";
const BLACK: &str = "VA8JB8SC8KD8DE8SF8JG8VH8PA7PB7PC7PD7PE7PF7PG7PH7";

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("config.ini"), EXCERPT).unwrap();
    folder
}

fn read(path: &Path) -> RgbImage {
    image::open(path).unwrap().to_rgb8()
}

/// Exit code, standard output and messages.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("lightsquare")
        .unwrap()
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn the_thesis_command_line_gives_its_bmp() {
    let folder = folder();
    let here = folder.path();
    fs::rename(here.join("config.ini"), here.join("thesis.ini")).unwrap();
    let line = "-config thesis.ini -output a.bmp -AA 2 -ssrays 3 -cpu 2 -whiteplayer";
    let mut arguments: Vec<&str> = line.split(' ').collect();
    arguments.extend([WHITE, "-blackplayer", BLACK]);
    let (code, _, stderr) = run(here, &arguments);
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(&fs::read(here.join("a.bmp")).unwrap()[..2], b"BM");
    let today = [
        "diagram",
        "-c",
        "thesis.ini",
        "--white",
        WHITE,
        "--black",
        BLACK,
        "--aa",
        "2",
        "--ssrays",
        "3",
        "--set",
        "thesis",
        "--look",
        "thesis",
    ];
    let (code, _, stderr) = run(here, &[&today[..], &["-o", "b.png"]].concat());
    assert_eq!(code, 0, "{stderr}");
    let picture = read(&here.join("a.bmp"));
    assert_eq!(picture.dimensions(), (120, 90));
    assert_eq!(picture, read(&here.join("b.png")));
}

#[test]
fn bad_thesis_lines_and_settings_get_a_sentence() {
    let folder = folder();
    let here = folder.path();
    let settings = [
        (
            "lights.ini",
            "[GlobalSettings]\nLightCount=3\n[Light0]\nPosition=0,1,0\nColor=1,1,1\n[Light1]\nPosition=0,2,0\nColor=1,1,1\n",
        ),
        ("view.ini", "[Camera]\nView=top\nFOV=80\n"),
        ("camera.ini", "[Camera]\nLookAt=45,15,-30\n"),
        ("focus.ini", "[Camera]\nAperture=1\nFocus=14,0,-1000\n"),
        ("window.ini", "[Model0]\nShape=plane\nOrigin=0,-9,0\nNormal=0,1,0\nMaterial=glass\n"),
        ("bitmap.ini", "[Material m]\nTexture=bitmap\nBitmap=broken.png\n[Pieces]\nWhite=m\n"),
        ("clock.ini", "[Clock]\nShow=yes\n"),
        ("clock.png", "[Clock]\nShow=yes\n"),
    ];
    for (name, text) in settings {
        fs::write(here.join(name), text).unwrap();
    }
    fs::write(here.join("broken.png"), "no picture").unwrap();
    let before = fs::read_dir(here).unwrap().count();
    let cases: &[(&[&str], i32, &str)] = &[
        (&["-whiteplayer", "KE1"], 2, "-output is missing"),
        (&["-output", "a.bmp", "-whiteplayer", "KE"], 2, "white: the string ends at character 2"),
        (&["-output", "a.bmp", "-config", "no.ini"], 1, "no.ini: cannot be read"),
        (
            &["-output", "a.bmp", "-config", "lights.ini"],
            1,
            "lights.ini: line 2: LightCount is 3, expected a section [Light2]",
        ),
        (
            &["-output", "a.bmp", "-config", "camera.ini"],
            1,
            "camera.ini: line 1: the camera's LookAt is its own Position",
        ),
        (
            &["diagram", "--white", "KE1", "-c", "window.ini"],
            1,
            "window.ini: line 5: Material `glass` is transparent",
        ),
        (
            &["diagram", "--white", "KE1", "-c", "bitmap.ini"],
            1,
            "bitmap.ini: line 3: the picture `broken.png` cannot be read (",
        ),
        (
            &["diagram", "--white", "KE1", "--set", "stauton"],
            2,
            "there is no set or folder `stauton`, did you mean `staunton`?",
        ),
        (
            &["diagram", "--white", "KE1", "--set", "."],
            1,
            "./set.toml: no such file, expected the files of a set: set.toml, pawn.toml",
        ),
        (&["diagram", "--white", "KE1", "--aa", "3"], 2, "[possible values: none, grid, adaptive]"),
        (
            &["diagram", "--white", "KE1", "--camera", "wite"],
            2,
            "invalid value 'wite' for '--camera <NAME>'\n  [possible values: white, black, top, above, side, \
             player, mover, follow, thesis, free, path]\n\n  tip: a similar value exists: 'white'",
        ),
        (
            &["diagram", "--white", "KE1", "--orientation", "red"],
            2,
            "[possible values: white, black]",
        ),
        (
            &["diagram", "--white", "KE1", "-c", "view.ini"],
            1,
            "view.ini: line 3: FOV is for a camera with View=free, which [Camera] is not",
        ),
        (
            &["diagram", "--white", "KE1", "--width", "80"],
            2,
            "expected a length above 0 with its unit, mm, cm or in, as in 80mm",
        ),
        (
            &["diagram", "--white", "KE1", "--width", "60in"],
            2,
            "--width: 60in at 300 pixels an inch makes 18000 x 13500 pixels, expected 1 to 16384",
        ),
        (
            &["diagram", "--white", "KE1", "-c", "focus.ini"],
            1,
            "the camera's Focus is not before it, expected a point that it sees",
        ),
        (
            &["diagram", "--white", "KE1", "--theme", "wod"],
            2,
            "--theme: there is no theme `wod`, did you mean `wood`?",
        ),
        (
            &["diagram", "--white", "KE1", "--look", "stodio"],
            2,
            "[possible values: studio, thesis]\n\n  tip: a similar value exists: 'studio'",
        ),
        (&["diagram", "--white", "KE1", "--quality", "best"], 2, "draft, normal, high, print]"),
        (
            &["diagram", "--white", "KE1", "--transparent", "-o", "a.bmp"],
            2,
            "--output: expected a .png, .tiff or .webp file for a transparent picture, found `a.bmp`",
        ),
        (
            &["export", "--white", "KE1", "--look", "studio"],
            2,
            "POV-Ray's scenes are written as Phong's model has them, expected --look thesis",
        ),
        (
            &["diagram", "--white", "KE1", "--arrows", "Ge2e4,e2e2"],
            2,
            "'e2e2' for '--arrows <ARROWS>': goes from a square to itself, expected two squares",
        ),
        (
            &["diagram", "--white", "KE1", "--arrows", "Pe2e4"],
            2,
            "'Pe2e4' for '--arrows <ARROWS>': expected G, R, Y or B and two squares, as in Ge2e4",
        ),
        (
            &["diagram", "--white", "KE1", "--squares", "Gd5,Ri1"],
            2,
            "'Ri1' for '--squares <SQUARES>': expected G, R, Y or B and a square, as in Gd5",
        ),
        (
            &["diagram", "--white", "KE1", "--last-move", "Ge2e4"],
            2,
            "'Ge2e4' for '--last-move <SQUARES>': expected two squares, as in e2e4",
        ),
        (
            &["diagram", "--white", "KE1", "--marks", "check,arows"],
            2,
            "there is no mark `arows`, expected one of last-move, check, mate, drawn, all, none",
        ),
        (
            &["diagram", "--white", "KE1", "--marks", "lastmove"],
            2,
            "there is no mark `lastmove`, did you mean `last-move`?",
        ),
        (
            &["diagram", "--white", "KE1", "--marks", "none,check"],
            2,
            "`none` stands beside others, expected it alone",
        ),
        (
            &["diagram", "--white", "KE1", "--marks", "check", "--squares", "d5"],
            2,
            "--squares: --marks leaves drawn out, expected it in the list",
        ),
        (&["diagram", "--white", "KE1", "--dpi", "300"], 2, "--width <LENGTH>"),
        (
            &["diagram", "--white", "KE1", "--width", "8cm", "--dpi", "0"],
            2,
            "expected a whole number from 10 to 4800",
        ),
        (&["diagram", "--white", "KE1", "--ssrays", "0"], 2, "a whole number from 1 to 32"),
        (
            &["export", "--white", "KE1", "-c", "clock.ini", "-o", "-"],
            1,
            "the scene has pictures (of the clock, or of materials), expected a file",
        ),
        (
            &["export", "--white", "KE1", "-c", "clock.ini", "-o", "scene.txt"],
            2,
            "--output: expected a .pov file, found `scene.txt`",
        ),
        (
            &["diagram", "--white", "KE1", "-c", "clock.png", "-o", "clock.png"],
            1,
            "clock.png: is the file that is read, expected another one to write",
        ),
        (&["-output", "", "-whiteplayer", "KE1"], 2, "-output is empty"),
        (&["export", "--white", "KE1", "--format", "obj"], 2, "[possible values: pov]"),
        (&["bench", "--runs", "0"], 2, "'--runs <N>': expected a whole number from 1 to 1000"),
    ];
    for (arguments, code, message) in cases {
        let (found, stdout, stderr) = run(here, arguments);
        assert_eq!(found, *code, "{arguments:?}: {stderr}");
        assert!(stderr.contains(message), "{arguments:?}: {stderr}");
        assert_eq!(stdout, "", "{arguments:?}");
        assert_eq!(fs::read_dir(here).unwrap().count(), before, "{arguments:?} left something");
    }
}

#[test]
fn pictures_for_print_have_the_pixels_and_say_how_wide_they_are() {
    let folder = folder();
    let here = folder.path();
    let print = ["diagram", "--white", "KE1", "--width", "20mm", "--dpi", "72", "--size", "40x30"];
    for file in ["a.png", "a.bmp"] {
        let (code, _, stderr) = run(here, &[&print[..], &["-o", file]].concat());
        assert_eq!(code, 0, "{stderr}");
        // 20 mm at 72 pixels an inch are 56.7 pixels.
        assert_eq!(read(&here.join(file)).dimensions(), (57, 43));
    }
    // 72 an inch are 2834.6 a metre.
    let png = fs::read(here.join("a.png")).unwrap();
    let density = [b"pHYs", &2835_u32.to_be_bytes()[..], &2835_u32.to_be_bytes(), &[1]].concat();
    assert!(png.windows(density.len()).any(|bytes| bytes == density));
    let bmp = fs::read(here.join("a.bmp")).unwrap();
    assert_eq!(bmp[38..46], [2835_u32.to_le_bytes(); 2].concat());
    let printed = run(here, &[&print[..], &["--print-config"]].concat()).1;
    assert!(printed.contains("ImageWidth=57\nImageHeight=43\n"), "{printed}");
}

#[test]
fn settings_in_force_are_printed_as_a_file_that_says_the_same() {
    let folder = folder();
    let here = folder.path();
    let flags = ["render", "--print-config", "--size", "64x48", "--aa", "2", "--plain"];
    let (code, printed, stderr) = run(here, &flags);
    assert_eq!((code, stderr.as_str()), (0, ""));
    let config = Config::parse(&printed).unwrap();
    assert_eq!((config.width, config.height, config.camera.pose.z_rot), (64, 48, 10.0));
    assert!(config.render.plain);
    fs::write(here.join("printed.ini"), &printed).unwrap();
    let again = ["export", "--print-config", "-c", "printed.ini"];
    assert_eq!(run(here, &again).1, printed);
}

#[test]
fn printed_settings_name_their_pictures_wherever_they_are_saved() {
    let folder = TempDir::new().unwrap();
    let here = folder.path();
    for name in ["a #b", "elsewhere"] {
        fs::create_dir(here.join(name)).unwrap();
    }
    RgbImage::from_fn(4, 3, |x, y| image::Rgb([60 * x as u8, 80 * y as u8, 9]))
        .save(here.join("a #b/picture.png"))
        .unwrap();
    let settings =
        "[Pieces]\nWhite=m\n[Material m]\nTexture=bitmap\nBitmap=picture.png ; a picture\n";
    fs::write(here.join("a #b/c.ini"), settings).unwrap();
    let king = ["diagram", "--white", "KE1", "--size", "40x30"];
    let with = |file, more: &[&str]| run(here, &[&king[..], &["-c", file], more].concat());
    let printed = with("a #b/c.ini", &["--print-config"]).1;
    fs::write(here.join("elsewhere/c.ini"), &printed).unwrap();
    assert_eq!(with("elsewhere/c.ini", &["--print-config"]).1, printed);
    for (file, picture) in [("a #b/c.ini", "a.png"), ("elsewhere/c.ini", "b.png")] {
        let (code, _, stderr) = with(file, &["-o", picture]);
        assert_eq!(code, 0, "{stderr}");
    }
    assert_eq!(read(&here.join("a.png")), read(&here.join("b.png")));
}

#[test]
fn marks_are_drawn_on_request_and_left_out_likewise() {
    let folder = folder();
    let here = folder.path();
    let diagram = |options: &[&str]| {
        let fen = "4k3/8/8/8/8/8/8/4RK2 b - - 0 1";
        let common = ["diagram", "--fen", fen, "--size", "60x40", "--aa", "none", "-o", "a.png"];
        let (code, _, stderr) = run(here, &[&common[..], options].concat());
        assert_eq!(code, 0, "{options:?}: {stderr}");
        read(&here.join("a.png"))
    };
    // The king is in check.
    let plain = diagram(&["--marks", "none"]);
    assert_ne!(diagram(&[]), plain);
    assert_eq!(diagram(&["--marks", "last-move,mate,drawn"]), plain);
    assert_eq!(diagram(&["--marks", "check"]), diagram(&["--marks", "all"]));
    let green = diagram(&["--arrows", "Ga1a7,Gb1c3", "--squares", "gd5"]);
    assert_ne!(green, diagram(&[]));
    assert_eq!(green, diagram(&["--arrows", "a1a7,b1c3", "--squares", "d5"]));
    assert_ne!(green, diagram(&["--arrows", "Ra1a7,Rb1c3", "--squares", "Rd5"]));
    assert_ne!(diagram(&["--last-move", "e2e4"]), diagram(&[]));
    // The thesis's look has none but those that are asked for.
    let thesis = |options: &[&str]| diagram(&[&["--look", "thesis"], options].concat());
    assert_eq!(thesis(&[]), thesis(&["--marks", "none"]));
    assert_ne!(thesis(&["--squares", "d5"]), thesis(&[]));
}

#[test]
fn an_export_says_that_it_has_no_marks() {
    let folder = folder();
    let fen = "4k3/8/8/8/8/8/8/4RK2 b - - 0 1";
    let arguments = ["export", "--fen", fen, "-o", "-"];
    let marks = "// Marks in lightsquare, none here.";
    let (_, plain, _) = run(folder.path(), &arguments);
    let (_, marked, _) = run(folder.path(), &[&arguments[..], &["--marks", "all"]].concat());
    assert!(!plain.contains(marks) && marked.contains(marks));
    assert_eq!(plain.lines().count() + 1, marked.lines().count());
}

#[test]
fn a_scene_is_written_with_its_pictures_beside_it() {
    let folder = folder();
    let here = folder.path();
    fs::write(here.join("clock.ini"), "[Clock]\nShow=yes\n").unwrap();
    let arguments = ["export", "--format", "pov", "--white", "KE1JB1", "-c", "clock.ini"];
    let (code, _, stderr) = run(here, &[&arguments[..], &["-o", "sub/king.pov"]].concat());
    assert_eq!(code, 0, "{stderr}");
    assert!(stderr.contains("sub/king.pov is written"), "{stderr}");
    let scene = fs::read_to_string(here.join("sub/king.pov")).unwrap();
    assert!(scene.contains("assumed_gamma srgb") && scene.contains("king-bitmap0.png"));
    assert_eq!(read(&here.join("sub/king-bitmap0.png")).dimensions(), (532, 283));
    // What holds no picture fits into a pipe.
    let (code, stdout, _) = run(here, &["export", "--white", "KE1", "-o", "-"]);
    assert!(code == 0 && stdout.contains("camera {"));
}

#[test]
fn an_export_that_fails_changes_nothing() {
    let folder = folder();
    let here = folder.path();
    fs::write(here.join("clock.ini"), "[Clock]\nShow=yes\n").unwrap();
    fs::write(here.join("scene.pov"), "an older one").unwrap();
    fs::create_dir(here.join("scene-bitmap0.png")).unwrap();
    let arguments = ["export", "--white", "KE1", "-c", "clock.ini", "-o", "scene.pov"];
    let (code, _, stderr) = run(here, &arguments);
    assert_eq!(code, 1);
    assert!(stderr.contains("scene-bitmap0.png: cannot be written"), "{stderr}");
    assert_eq!(fs::read_to_string(here.join("scene.pov")).unwrap(), "an older one");
    assert_eq!(fs::read_dir(here).unwrap().count(), 4);
}

#[test]
fn pictures_of_a_game_do_not_take_the_place_of_what_they_are_made_of() {
    let folder = folder();
    let here = folder.path();
    fs::write(here.join("g.pgn"), "1. e4 *\n").unwrap();
    let render = ["render", "g.pgn", "--size", "8x8", "--aa", "none", "-o", "out"];
    assert_eq!(run(here, &render).0, 0);
    let frame = "out/g/0001-white-black/frame_00000.png";
    let settings = format!("[Pieces]\nWhite=m\n[Material m]\nTexture=bitmap\nBitmap={frame}\n");
    fs::write(here.join("c.ini"), settings).unwrap();
    let before = fs::read(here.join(frame)).unwrap();
    let (code, _, stderr) = run(here, &[&render[..], &["-c", "c.ini"]].concat());
    assert_eq!(code, 1);
    assert!(stderr.contains("is read, and lies in a folder that is written to"), "{stderr}");
    assert_eq!(fs::read(here.join(frame)).unwrap(), before);
}

#[test]
fn the_bench_measures_the_three_settings_of_the_thesis() {
    let folder = folder();
    let arguments = ["bench", "--runs", "1", "--plies", "0", "--json"];
    let (code, stdout, _) = run(folder.path(), &arguments);
    assert_eq!(code, 0);
    let measured: Value = serde_json::from_str(&stdout).unwrap();
    let rows = measured["pictures"].as_array().unwrap();
    let thesis: Vec<f64> = rows.iter().map(|row| row["thesis_seconds"].as_f64().unwrap()).collect();
    assert_eq!(thesis, [228.0, 56.0, 31.0]);
    let primary: Vec<u64> =
        rows.iter().map(|row| row["rays"]["primary"].as_u64().unwrap()).collect();
    assert_eq!(primary, [2_400_000, 600_000, 600_000]);
    assert!(rows.iter().all(|row| row["seconds"].as_f64().unwrap() > 0.0));
    assert_eq!(measured["games"].as_array().unwrap().len(), 0);
}
