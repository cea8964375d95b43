//! The command as a user meets it.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

/// Runs the command in the repository's folder.
fn run(arguments: &[&str]) -> (i32, String, String) {
    run_in(Path::new(env!("CARGO_MANIFEST_DIR")), arguments, "")
}

fn run_in(folder: &Path, arguments: &[&str], input: &str) -> (i32, String, String) {
    let output = Command::cargo_bin("lightsquare")
        .unwrap()
        .current_dir(folder)
        .args(arguments)
        .write_stdin(input)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// All files and folders below `folder`, by name; files with their bytes.
fn tree(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(tree(&path));
            files.push((path, Vec::new()));
        } else {
            files.push((path.clone(), fs::read(&path).unwrap()));
        }
    }
    files.sort();
    files
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// Text chunks of a PNG: keyword and text.
fn texts(path: &Path) -> Vec<(String, String)> {
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap()));
    let reader = decoder.read_info().unwrap();
    let info = reader.info();
    let plain = info.uncompressed_latin1_text.iter().map(|c| (c.keyword.clone(), c.text.clone()));
    let wide = info.utf8_text.iter().map(|c| (c.keyword.clone(), c.get_text().unwrap()));
    plain.chain(wide).collect()
}

#[test]
fn a_game_becomes_a_folder_of_numbered_pictures() {
    let out = TempDir::new().unwrap();
    let folder = out.path().to_str().unwrap();
    let (code, stdout, stderr) =
        run(&["render", "games/opera-1858.pgn", "--size", "32x18", "--aa", "none", "-o", folder]);
    assert_eq!((code, stdout.as_str()), (0, ""), "{stderr}");
    let game = out.path().join("opera-1858/0001-morphy-paul-duke-karl-count-isouard");
    let names: Vec<String> = tree(&game)
        .iter()
        .map(|(path, _)| path.file_name().unwrap().to_string_lossy().into_owned())
        .collect();
    let mut expected: Vec<String> = (0..34).map(|index| format!("frame_{index:05}.png")).collect();
    expected.push("game.json".to_owned());
    assert_eq!(names, expected);

    let manifest = json(&game.join("game.json"));
    assert_eq!(manifest["tags"]["White"], "Morphy, Paul");
    assert_eq!(manifest["settings"]["config_file"], "config.ini");
    let last = &manifest["frames"][33];
    assert_eq!(last["san"], "Rd8#");
    assert_eq!(last["fen"], "1n1Rkb1r/p4ppp/4q3/4p1B1/4P3/8/PPP2PPP/2K5 b k - 1 17");
    assert_eq!(last["white"], "KC1PA2PB2PC2PF2PG2PH2PE4SG5VD8");
    let says = texts(&game.join("frame_00033.png"));
    for (keyword, text) in
        [("SAN", "Rd8#"), ("Ply", "33"), ("Game", "1"), ("FEN", last["fen"].as_str().unwrap())]
    {
        assert!(says.contains(&(keyword.to_owned(), text.to_owned())), "{keyword}: {says:?}");
    }
    let report = json(&out.path().join("opera-1858/report.jsonl"));
    assert_eq!(report["status"], "rendered");
    assert_eq!((&report["plies"], &report["frames"]), (&33.into(), &34.into()));
}

#[test]
fn the_bytes_are_the_same_for_any_number_of_threads() {
    let trees = ["1", "2", "5"].map(|threads| {
        let out = TempDir::new().unwrap();
        let folder = out.path().to_str().unwrap();
        let (code, _, stderr) = run(&[
            "render",
            "games/gundersen-faul-1928.pgn",
            "--from",
            "13w",
            "--to",
            "15w",
            "--animate",
            "--fps",
            "5",
            "--last",
            "0.4",
            "--orbit",
            "30",
            "--size",
            "48x32",
            "--cpu",
            threads,
            "-o",
            folder,
        ]);
        assert_eq!(code, 0, "{stderr}");
        tree(out.path())
            .into_iter()
            .map(|(path, bytes)| (path.strip_prefix(out.path()).unwrap().to_owned(), bytes))
            .collect::<Vec<_>>()
    });
    assert!(trees[0].len() > 20);
    assert!(trees[0] == trees[1] && trees[0] == trees[2]);
}

#[test]
fn a_game_that_cannot_be_played_whole_is_shown_to_its_last_good_move() {
    let out = TempDir::new().unwrap();
    let games = "[White \"A\"]\n\n1. e4 e5 2. Qxh7 *\n\n[White \"B\"]\n\n1. d4 *\n";
    let (code, _, stderr) = run_in(out.path(), &["render", "-", "--size", "8x8", "-o", "x"], games);
    assert_eq!(code, 3);
    assert!(stderr.contains("-: game 1, line 3: `Qxh7` is no legal move"), "{stderr}");
    let report = fs::read_to_string(out.path().join("x/stdin/report.jsonl")).unwrap();
    let lines: Vec<Value> =
        report.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), 2);
    assert_eq!((&lines[0]["status"], &lines[0]["frames"]), (&"partial".into(), &3.into()));
    assert_eq!(lines[0]["problems"][0]["token"], "Qxh7");
    assert_eq!((&lines[1]["status"], &lines[1]["frames"]), (&"rendered".into(), &2.into()));
    assert!(out.path().join("x/stdin/0001-a-black/frame_00002.png").is_file());
    assert!(out.path().join("x/stdin/0002-b-black/frame_00001.png").is_file());
}

#[test]
fn parts_of_games_are_selected() {
    let out = TempDir::new().unwrap();
    let games =
        "[White \"A\"]\n1. e4 e5 *\n[White \"B\"]\n1. d4 d5 2. c4 e6 *\n[White \"C\"]\n1. c4 *\n";
    let (code, ..) = run_in(
        out.path(),
        &["render", "-", "--select", "2", "--from", "1b", "--to", "2w", "--size", "8x8"],
        games,
    );
    assert_eq!(code, 0);
    let folder = out.path().join("out/stdin/0002-b-black");
    let plies: Vec<Value> = json(&folder.join("game.json"))["frames"]
        .as_array()
        .unwrap()
        .iter()
        .map(|frame| frame["ply"].clone())
        .collect();
    assert_eq!(plies, [2, 3]);
    assert_eq!(fs::read_dir(out.path().join("out/stdin")).unwrap().count(), 2);
}

#[test]
fn inspect_tells_a_line_a_game_and_a_row_a_position() {
    let (code, stdout, _) = run(&["inspect", "games/saavedra-1895.pgn"]);
    assert_eq!((code, stdout.lines().count()), (0, 1));
    assert!(stdout.contains("Saavedra") && stdout.contains("13 plies"), "{stdout}");
    let (code, stdout, _) = run(&["inspect", "--positions", "games/saavedra-1895.pgn"]);
    assert_eq!(code, 0);
    let rows: Vec<&str> = stdout.lines().collect();
    assert_eq!(rows.len(), 15);
    assert_eq!(rows[0], "game\tply\tsan\tfen\twhite\tblack");
    assert!(rows[1].starts_with("1\t0\t-\t"), "{}", rows[1]);
}

#[test]
fn inspect_tells_what_is_said_of_moves_and_variations() {
    let (code, stdout, _) = run(&["inspect", "--notes", "tests/data/notes.pgn"]);
    let rows: Vec<&str> = stdout.lines().collect();
    assert_eq!((code, rows.len()), (0, 20), "{stdout}");
    assert_eq!(rows[0], "game\tvariation\tply\tsan\tclk\temt\teval\tcsl\tcal\tnags");
    assert_eq!(rows[1], "1\t-\t0\t-\t-\t-\t-\tGe4,Rd5\tGe2e4\t-");
    assert_eq!(rows[5], "1\t-\t4\tNc6\t545\t-\t#12\t-\t-\t4");
    assert_eq!(rows[18], "1\t1w-d4/1b-nf6/2w-nf3\t3\tNf3\t-\t-\t-\tYf3\t-\t1");
    let (code, _, stderr) = run(&["inspect", "--notes", "--positions", "tests/data/notes.pgn"]);
    assert_eq!(code, 2, "{stderr}");
}

#[test]
fn diagrams_come_from_fens_strings_and_games() {
    let out = TempDir::new().unwrap();
    let pictures = [
        (vec!["--fen", "8/8/8/3k4/8/8/8/8"], "a.png"),
        (vec!["--black", "KD5"], "b.png"),
        (vec!["--fen", "8/8/8/3k4/8/8/8/8 w - - 0 1"], "c.png"),
    ];
    let mut pixels = Vec::new();
    for (arguments, name) in &pictures {
        let path = out.path().join(name);
        let mut all = vec!["diagram", "--size", "64x40", "-o", path.to_str().unwrap()];
        all.extend(arguments);
        let (code, _, stderr) = run(&all);
        assert_eq!(code, 0, "{stderr}");
        let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(&path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut buffer).unwrap();
        pixels.push(buffer);
    }
    assert!(pixels[0] == pixels[1] && pixels[0] == pixels[2]);

    let game = out.path().join("mate.png");
    let (code, ..) = run(&[
        "diagram",
        "games/opera-1858.pgn",
        "--at",
        "17w",
        "--size",
        "64x40",
        "-o",
        game.to_str().unwrap(),
    ]);
    assert_eq!(code, 0);
    assert!(texts(&game).contains(&("SAN".to_owned(), "Rd8#".to_owned())));
}

#[test]
fn bad_input_gets_a_sentence_and_leaves_nothing_behind() {
    let out = TempDir::new().unwrap();
    let write = |name: &str, bytes: &[u8]| fs::write(out.path().join(name), bytes).unwrap();
    write("empty.pgn", b"");
    write("rubbish.pgn", &[0x7f, b'E', b'L', b'F', 0, 1, 2]);
    write("wide.pgn", b"\xff\xfe[\0E\0");
    write("prose.pgn", b"Dear Sir,\nthis is no game.\n");
    write("game.pgn", b"[White \"A\"]\n\n1. e4 *\n");
    write("bad.ini", b"[Camera]\nFVO=90\nZRot=NaN\n");
    write("path.ini", b"[CameraPath]\n9w=0,40,-40 | 14,0,14 | 60\n3b=14,40,-40 | 14,0,14 | 60\n");
    write("late.ini", b"[CameraPath]\n9w=0,40,-40 | 14,0,14 | 60\n2=14,40,-40 | 14,0,14 | 60\n");
    write("file", b"");
    let before = tree(out.path()).len();
    let cases: &[(&[&str], i32, &str)] = &[
        (&["render", "no.pgn"], 1, "no.pgn: no such file"),
        (&["render", "."], 1, ".: is a folder, expected a PGN file"),
        (&["render", "empty.pgn"], 1, "empty.pgn: is empty, expected games in PGN"),
        (&["render", "rubbish.pgn"], 1, "rubbish.pgn: is no text (byte 4 is 0)"),
        (&["render", "wide.pgn"], 1, "wide.pgn: is UTF-16 text, expected UTF-8 or Latin-1"),
        (
            &["render", "prose.pgn"],
            1,
            "prose.pgn: no game in it, line 1: `Dear` begins a text that is no game",
        ),
        (&["render", "game.pgn", "no.pgn"], 1, "no.pgn: no such file"),
        (
            &["render", "game.pgn", "--select", "2"],
            1,
            "game.pgn: none of its games is selected, it has 1",
        ),
        (&["render", "game.pgn", "--select", "x"], 2, "`x` is no game number or range"),
        (&["render", "game.pgn", "--size", "99999999x99999999"], 2, "each from 1 to 16384"),
        (&["render", "game.pgn", "--size", "-3x4"], 2, "expected WIDTHxHEIGHT in pixels"),
        (&["render", "game.pgn", "--size", "NaN"], 2, "expected WIDTHxHEIGHT in pixels"),
        (
            &["render", "game.pgn", "--animate", "--fps", "0"],
            2,
            "'--fps <N>': expected a number from 1 to 240",
        ),
        (
            &["render", "game.pgn", "--animate", "--pause", "-1"],
            2,
            "'--pause <S|real>': expected a number from 0 to 3600, or real",
        ),
        (
            &["render", "game.pgn", "--animate", "--fps", "1000"],
            2,
            "invalid value '1000' for '--fps <N>': expected a number from 1 to 240",
        ),
        (
            &["render", "game.pgn", "--title=-1"],
            2,
            "invalid value '-1' for '--title[=<S>]': expected a number from 0 to 3600",
        ),
        (
            &["render", "game.pgn", "--frames", "100-50"],
            2,
            "'--frames <FRAMES>': expected a frame's number from 0 on, or two with a hyphen, the lower one first",
        ),
        (
            &["render", "game.pgn", "--animate", "--frames", "160-165"],
            1,
            "--frames: game.pgn: game 1 has frames 0 to 164, expected a part of them, found 160 to 165",
        ),
        (
            &["render", "game.pgn", "--frames", "2"],
            1,
            "game 1 has frames 0 to 1, expected a part of them, found 2",
        ),
        (
            &["render", "game.pgn", "--variations", "--frames", "0"],
            2,
            "the argument '--variations' cannot be used with '--frames <FRAMES>'",
        ),
        (&["render", "game.pgn", "--camera", "plyer"], 2, "a similar value exists: 'player'"),
        (&["render", "game.pgn", "--camera", "path"], 2, "`path` needs a section [CameraPath]"),
        (
            &["render", "game.pgn", "--animate", "--orbit-over", "move"],
            2,
            "required arguments were not provided:\n  --orbit <DEG>",
        ),
        (
            &["render", "game.pgn", "-c", "path.ini"],
            1,
            "path.ini: line 3: the key frame `3b` stands behind `9w`, expected each later than the one before",
        ),
        (
            &["render", "game.pgn", "-c", "late.ini"],
            1,
            "game.pgn: game 1: [CameraPath]: the key frame `2` comes at 2.00 s, and `9w` before it at 24.00 s",
        ),
        (
            &["diagram", "game.pgn", "--arrows", "e4e4"],
            2,
            "invalid value 'e4e4' for '--arrows <ARROWS>': goes from a square to itself, expected two squares",
        ),
        (&["render", "game.pgn", "--orbit", "NaN"], 2, "'--orbit <DEG>': expected a number"),
        (
            &["render", "game.pgn", "--from", "17x"],
            2,
            "`17x` is no position, expected a move as in 17w",
        ),
        (&["render", "game.pgn", "-c", "no.ini"], 1, "no.ini: cannot be read"),
        (&["render", "game.pgn", "-c", "."], 1, ".: is a folder, expected a config.ini"),
        (
            &["render", "game.pgn", "-c", "bad.ini"],
            1,
            "bad.ini: line 2: there is no key `FVO`, did you mean `FOV`?\n  line 3: ZRot is `NaN`",
        ),
        (&["render", "game.pgn", "-o", "file"], 1, "cannot be written"),
        (
            &["diagram", "--fen", "8/8/8/9"],
            2,
            "'--fen <FEN>': invalid board part in fen, expected a FEN such as",
        ),
        (
            &["diagram", "--white", "KE9"],
            2,
            "white: `9` at character 3 is no rank, expected 1 to 8",
        ),
        (
            &["diagram", "game.pgn", "--at", "9w"],
            1,
            "game.pgn: game 1 has no position 9w, it goes from start to 1w",
        ),
        (
            &["diagram", "game.pgn", "-o", "x.gif"],
            2,
            "--output: expected a file of .png, .jpg, .bmp, .tiff, .webp, .jpeg, .tif, found `x.gif`",
        ),
        (&["diagram", "game.pgn", "--select", "x"], 2, "expected a whole number from 1"),
        (
            &["render", "game.pgn", "--cpu", "x"],
            2,
            "'--cpu <N>': expected a whole number from 1 to 1024",
        ),
        (&["render", "game.pgn", "-o", "-"], 2, "--out: expected a folder, found `-`"),
        (
            &[
                "render",
                "game.pgn",
                "--animate",
                "--last",
                "3600",
                "--first",
                "3600",
                "--fps",
                "240",
                "--pause",
                "3600",
            ],
            1,
            "game.pgn: game 1 would take 1728144 frames, expected at most 1000000",
        ),
        (&["inspect", "no.pgn"], 1, "no.pgn: no such file"),
        (&["rendr"], 2, "a similar subcommand exists: 'render'"),
    ];
    for (arguments, code, message) in cases {
        let (found, stdout, stderr) = run_in(out.path(), arguments, "");
        assert_eq!(found, *code, "{arguments:?}: {stderr}");
        assert!(stderr.contains(message), "{arguments:?}: {stderr}");
        assert!(!stderr.contains("panicked"), "{arguments:?}: {stderr}");
        assert_eq!(stdout, "", "{arguments:?}");
        assert_eq!(tree(out.path()).len(), before, "{arguments:?} left something behind");
    }
}

#[test]
fn a_diagram_or_a_list_tells_what_could_not_be_read() {
    let out = TempDir::new().unwrap();
    fs::write(out.path().join("bad.pgn"), "[White \"A\"]\n\n1. e4 e5 2. Ke4 *\n").unwrap();
    let told = "bad.pgn: game 1, line 3: `Ke4` is no legal move";
    let (code, _, stderr) = run_in(out.path(), &["diagram", "bad.pgn", "--size", "8x8"], "");
    assert_eq!(code, 3);
    assert!(stderr.contains(told) && out.path().join("out/diagram.png").is_file(), "{stderr}");
    let (code, stdout, stderr) = run_in(out.path(), &["inspect", "--positions", "bad.pgn"], "");
    assert_eq!((code, stdout.lines().count()), (3, 4));
    assert!(stderr.contains(told), "{stderr}");
}

#[test]
fn a_part_that_the_game_does_not_have_is_skipped_and_said() {
    let out = TempDir::new().unwrap();
    let file = "games/topalov-shirov-1998.pgn";
    let cases = [
        (["--to", "10w"], "`--to 10w` is before the start, the first move is 47b"),
        (["--from", "10w"], "`--from 10w` is before the start, the first move is 47b"),
        (["--from", "90w"], "`--from 90w` is behind the end, 53b"),
    ];
    for (arguments, message) in cases {
        let folder = out.path().to_str().unwrap();
        let all = [&["render", file, "--size", "8x8", "-o", folder], &arguments[..]].concat();
        let (code, _, stderr) = run(&all);
        assert_eq!(code, 3, "{arguments:?}");
        assert!(stderr.contains(message), "{arguments:?}: {stderr}");
        assert!(!tree(out.path()).iter().any(|(path, _)| path.ends_with("frame_00000.png")));
    }
}

#[test]
fn pictures_of_an_earlier_run_do_not_stay() {
    let out = TempDir::new().unwrap();
    let game = "1. e4 e5 2. Nf3 Nc6 *";
    run_in(out.path(), &["render", "-", "--size", "8x8"], game);
    let folder = out.path().join("out/stdin/0001-white-black");
    fs::write(folder.join("frame_mine.png"), "").unwrap();
    assert_eq!(tree(&folder).len(), 7);
    run_in(out.path(), &["render", "-", "--size", "8x8", "--from", "2w"], game);
    let names: Vec<PathBuf> = tree(&folder).into_iter().map(|(path, _)| path).collect();
    let expected = ["frame_00000.png", "frame_00001.png", "frame_mine.png", "game.json"];
    assert_eq!(names, expected.map(|name| folder.join(name)));
}

#[test]
fn no_name_leads_out_of_the_output_folder() {
    let out = TempDir::new().unwrap();
    let game = "[White \"../../x\"]\n[Black \"/etc\"]\n\n1. e4 *\n";
    fs::write(out.path().join("...pgn"), game).unwrap();
    let (code, _, stderr) =
        run_in(out.path(), &["render", "...pgn", "--size", "8x8", "-o", "deep/out"], "");
    assert_eq!(code, 0, "{stderr}");
    assert!(out.path().join("deep/out/games/0001-x-etc/frame_00001.png").is_file());
    assert_eq!(fs::read_dir(out.path().join("deep")).unwrap().count(), 1);
}

#[test]
fn names_bring_no_control_characters_to_terminal_or_files() {
    let out = TempDir::new().unwrap();
    let game = "[White \"a\u{1b}[2Jb\u{202e}c\"]\n\n1. \u{7}e4 *\n";
    let (_, stdout, stderr) = run_in(out.path(), &["inspect", "-"], game);
    let (_, _, render) = run_in(out.path(), &["render", "-", "--size", "8x8"], game);
    let manifest = fs::read_to_string(out.path().join("out/stdin/0001-a-2jb-c-black/game.json"));
    for text in [stdout, stderr, render, manifest.unwrap()] {
        assert!(!text.contains(['\u{1b}', '\u{202e}', '\u{7}']), "{text:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_signal_ends_the_run_cleanly() {
    use std::process::Stdio;
    for (signal, expected) in [("-INT", 130), ("-TERM", 143)] {
        let out = TempDir::new().unwrap();
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_lightsquare"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(["render", "games/hong-ivanchuk-2025.pgn", "--size", "200x120", "-o"])
            .arg(out.path())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let folder = out.path().join("hong-ivanchuk-2025/0001-hong-andrew-ivanchuk-vasyl");
        while !folder.join("frame_00002.png").exists() {
            assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        let pid = child.id().to_string();
        assert!(
            std::process::Command::new("kill").args([signal, &pid]).status().unwrap().success()
        );
        assert_eq!(child.wait().unwrap().code(), Some(expected));
        let report = json(&out.path().join("hong-ivanchuk-2025/report.jsonl"));
        assert_eq!(report["status"], "stopped");
        let frames = json(&folder.join("game.json"))["frames"].as_array().unwrap().len();
        assert_eq!(report["frames"], frames);
        // As many pictures as the manifest says, and nothing else but the manifest.
        assert_eq!(tree(&folder).len(), frames + 1);
    }
}

#[cfg(unix)]
#[test]
fn a_link_is_followed_and_the_input_is_never_overwritten() {
    let out = TempDir::new().unwrap();
    let game = "[White \"A\"]\n\n1. e4 *\n";
    fs::write(out.path().join("game.png"), game).unwrap();
    let (code, _, stderr) =
        run_in(out.path(), &["diagram", "game.png", "-o", "game.png", "--size", "8x8"], "");
    assert_eq!(code, 1);
    assert!(stderr.contains("game.png: is the file that is read"), "{stderr}");
    assert_eq!(fs::read_to_string(out.path().join("game.png")).unwrap(), game);

    fs::write(out.path().join("target.png"), "").unwrap();
    std::os::unix::fs::symlink("target.png", out.path().join("link.png")).unwrap();
    let (code, ..) =
        run_in(out.path(), &["diagram", "game.png", "-o", "link.png", "--size", "8x8"], "");
    assert_eq!(code, 0);
    assert!(out.path().join("link.png").is_symlink());
    assert!(fs::metadata(out.path().join("target.png")).unwrap().len() > 0);
}
