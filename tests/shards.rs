//! Work that is cut into shards: whatever becomes of them on the way, in the end it is as if one machine had done it.

mod trees;

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

use assert_cmd::Command;
use tempfile::TempDir;
use trees::{Tree, assert_same, tree};

/// Two games that begin alike, one of them in part, one that cannot be shown, and one with a variation in a variation.
const GAMES: &str = "[White \"A\"]\n[Black \"B\"]\n\n1. e4 e5 2. Nf3 (2. Bc4 Nc6 (2... Nf6)) Nc6 3. Bb5 a6 *\n\n\
    [White \"C\"]\n[Black \"D\"]\n\n1. e4 e5 2. Nf3 d6 3. d5 *\n\n\
    [White \"E\"]\n[FEN \"nothing\"]\n\n1. e4 *\n";

const OTHERS: &str = "[White \"F\"]\n\n1. f3 e5 2. g4 Qh4# 0-1\n\n[White \"G\"]\n\n1. d4 *\n\n\
    [White \"H\"]\n\n1. e4 e5 2. Qh5 Nc6 3. Bc4 Nf6 4. Qxf7# 1-0\n";

const PLAIN: [&str; 6] = ["--look", "thesis", "--aa", "none", "--size", "40x30"];

/// A folder with games.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("games.pgn"), GAMES).unwrap();
    fs::write(folder.path().join("others.pgn"), OTHERS).unwrap();
    folder
}

/// Exit code, standard output and messages.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("lightsquare").unwrap();
    command.current_dir(folder).args(arguments).env_remove("SLURM_ARRAY_TASK_ID");
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// What the command says where all goes well.
fn done(folder: &Path, arguments: &[&str]) -> String {
    let (code, told, said) = run(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {said}");
    told
}

/// What it says where it fails, in a sentence without a panic.
fn refused(folder: &Path, arguments: &[&str], code: i32) -> String {
    let (found, _, said) = run(folder, arguments);
    assert_eq!(found, code, "{arguments:?}: {said}");
    assert!(said.contains("error: ") && !said.contains("panicked"), "{said}");
    said
}

fn plan(folder: &Path, options: &[&str], shards: usize) {
    let shards = shards.to_string();
    let games = ["plan", "games.pgn", "others.pgn", "--shards", &shards];
    let (code, told, said) = run(folder, &[&games, &PLAIN[..], options].concat());
    assert_eq!(code, 0, "{said}");
    let last = shards.parse::<usize>().unwrap() - 1;
    let all = if last == 0 { "0".to_owned() } else { format!("0-{last}") };
    assert_eq!(told, format!("--array={all}\n"));
}

/// Renders a shard; what is said of it.
fn shard(folder: &Path, number: usize) -> String {
    let number = number.to_string();
    let (code, _, said) = run(folder, &["render", "--plan", "plan.jsonl", "--shard", &number]);
    assert_eq!(code, 0, "{said}");
    said
}

/// Renders a shard of which everything is there.
fn kept(folder: &Path, number: usize) {
    let said = shard(folder, number);
    let mut numbers = said.split(|c: char| !c.is_ascii_digit()).filter(|part| !part.is_empty());
    let [_, frames, kept] = [(); 3].map(|()| numbers.next());
    assert!(frames == Some("0") || frames == kept, "{said}");
}

/// Merges, and gives all output. One game is partial and one is skipped.
fn merged(folder: &Path) -> Tree {
    done(folder, &["verify", "plan.jsonl"]);
    let (code, told, said) = run(folder, &["merge", "plan.jsonl"]);
    assert!([0, 3].contains(&code) && told.is_empty(), "{code}: {said}");
    tree(&folder.join("out"))
}

/// What one machine makes of the same.
fn alone(options: &[&str]) -> Tree {
    let folder = folder();
    let (code, _, said) =
        run(folder.path(), &[&["render", "games.pgn", "others.pgn"], &PLAIN[..], options].concat());
    assert!([0, 3].contains(&code), "{said}");
    tree(&folder.path().join("out"))
}

#[test]
fn shards_in_any_order_make_what_one_machine_makes() {
    for options in [
        &["--variations", "--film", "apng"][..],
        &["--animate", "--fps", "3", "--film", "gif", "--title"],
        &["--variations", "--film", "gif", "--film", "apng", "--no-frames"],
        &["--format", "jpg"],
        &["--format", "webp", "--every", "2"],
        &["--at", "end", "--limit", "4"],
        &["--checkmate", "--names", "###.png"],
        &["--animate", "--fps", "2", "--frames", "1-4"],
    ] {
        let expected = alone(options);
        for shards in [1, 2, 3, 7] {
            let folder = folder();
            let folder = folder.path();
            plan(folder, options, shards);
            // From both ends to the middle; the first one twice.
            for number in 0..shards {
                let other = shards - 1 - number;
                shard(folder, if number % 2 == 0 { number } else { other });
                shard(folder, if number % 2 == 0 { other } else { number });
            }
            // Sent again, all of it, before it is merged and behind.
            (0..shards).for_each(|number| kept(folder, number));
            assert_same(&merged(folder), &expected, &format!("{options:?} in {shards}"));
            (0..shards).for_each(|number| kept(folder, number));
            let again = tree(&folder.join("out"));
            assert_same(&again, &expected, &format!("{options:?} in {shards} behind the merge"));
            assert_same(&merged(folder), &expected, &format!("{options:?} in {shards} again"));
        }
    }
}

#[test]
fn shards_at_once_even_the_same_one_do_not_disturb_each_other() {
    for options in [&["--animate", "--fps", "8", "--film", "gif"][..], &["--format", "bmp"]] {
        let folder = folder();
        let folder = folder.path();
        // More than there are frames, for one of them.
        let shards = if options.contains(&"bmp") { 30 } else { 3 };
        plan(folder, options, shards);
        let all_at_once = || {
            thread::scope(|scope| {
                for number in [0, 1, 2, 1, 0, 2].into_iter().chain(3..shards) {
                    scope.spawn(move || shard(folder, number));
                }
            });
        };
        let expected = alone(options);
        all_at_once();
        assert_same(&merged(folder), &expected, &format!("{options:?}"));
        // Behind the merge they leave nothing.
        all_at_once();
        assert_same(&tree(&folder.join("out")), &expected, &format!("{options:?} again"));
    }
}

#[test]
fn verify_finds_what_is_missing_cut_or_flipped() {
    for ending in ["png", "jpg", "bmp", "tiff", "webp"] {
        let folder = folder();
        let folder = folder.path();
        plan(folder, &["--format", ending], 3);
        for number in 0..3 {
            shard(folder, number);
        }
        let name = |index: usize| format!("out/games/0001-a-b/frame_{index:05}.{ending}");
        let bytes = fs::read(folder.join(name(1))).unwrap();
        fs::write(folder.join(name(1)), &bytes[..bytes.len() - 5]).unwrap();
        fs::remove_file(folder.join(name(2))).unwrap();
        fs::remove_file(folder.join(name(3))).unwrap();
        let mut bytes = fs::read(folder.join(name(4))).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 4;
        fs::write(folder.join(name(4)), &bytes).unwrap();
        // A picture of the plan, but another one.
        let last = format!("out/others/0003-h-black/frame_00007.{ending}");
        fs::copy(folder.join(name(0)), folder.join(&last)).unwrap();
        let expected = "--array=0,2\n\
            0\tgames/0001-a-b\t1\tbroken\n\
            0\tgames/0001-a-b\t2-3\tmissing\n\
            0\tgames/0001-a-b\t4\tbroken\n\
            2\tothers/0003-h-black\t7\tbroken\n";
        for command in ["verify", "merge"] {
            let (code, told, said) = run(folder, &[command, "plan.jsonl"]);
            assert_eq!((code, &*told), (3, expected), "{ending}: {said}");
            assert!(
                said.contains("5 of 27 frames in out missing or broken, in 2 shards"),
                "{said}"
            );
        }
        assert!(!folder.join("out/games/report.jsonl").exists());
        // What it prints is enough to send again.
        for number in [0, 2] {
            shard(folder, number);
        }
        let expected = alone(&["--format", ending]);
        assert_same(&merged(folder), &expected, ending);
        // Behind the merge it is the manifests that tell.
        let mut bytes = fs::read(folder.join(name(4))).unwrap();
        bytes[middle] ^= 4;
        fs::write(folder.join(name(4)), &bytes).unwrap();
        let (code, told, _) = run(folder, &["verify", "plan.jsonl"]);
        assert_eq!((code, &*told), (3, "--array=0\n0\tgames/0001-a-b\t4\tbroken\n"), "{ending}");
        shard(folder, 0);
        assert_same(&merged(folder), &expected, ending);
    }
}

#[test]
fn films_alone_are_made_where_no_cut_goes_through_them() {
    let options = ["--film", "gif", "--film", "apng", "--no-frames"];
    let expected = alone(&options);
    let folder = folder();
    let folder = folder.path();
    plan(folder, &options, 6);
    for number in 0..6 {
        shard(folder, number);
    }
    let out = tree(&folder.join("out"));
    let count = |ending: &str| {
        out.keys().filter(|name| name.extension().is_some_and(|end| end == ending)).count()
    };
    // Three games of five are cut.
    assert_eq!((count("gif"), count("apng")), (2, 2));
    assert!(count("png") > 0);
    assert_same(&merged(folder), &expected, "");
    let film = folder.join("out/games/0001-a-b/film.gif");
    fs::remove_file(&film).unwrap();
    let (code, told, _) = run(folder, &["verify", "plan.jsonl"]);
    assert_eq!(
        (code, &*told),
        (3, "--array=0-1\n0\tgames/0001-a-b\t0-3\tmissing\n1\tgames/0001-a-b\t4-6\tmissing\n")
    );
    for number in 0..2 {
        shard(folder, number);
    }
    assert_same(&merged(folder), &expected, "again");
    // A film of something else is not replaced.
    let other = ["plan", "games.pgn", "--shards", "1", "-o", "new.jsonl", "--captions"];
    done(folder, &[&other[..], &["--size", "160x120"], &options].concat());
    let said = refused(folder, &["render", "--plan", "new.jsonl", "--shard", "0"], 1);
    assert!(said.contains("out/games/0001-a-b/game.json: is of another run or plan"), "{said}");
}

#[test]
fn a_shard_that_is_ended_goes_on_when_it_is_sent_again() {
    for ending in ["png", "bmp"] {
        let options = ["--animate", "--fps", "10", "--quality", "print", "--format", ending];
        let options = [&options[..], &["--look", "thesis", "--size", "320x200"]].concat();
        let folder = folder();
        let folder = folder.path();
        let games = ["plan", "games.pgn", "--select", "1", "--shards", "1"];
        done(folder, &[&games[..], &options].concat());
        let pictures = || {
            let entries = fs::read_dir(folder.join("out/games/0001-a-b")).into_iter().flatten();
            let names = entries.map(|entry| entry.unwrap().path());
            names.filter(|name| name.extension().is_some_and(|end| end == ending)).count()
        };
        for (signal, expected) in [("-TERM", Some(143)), ("-KILL", None), ("-INT", Some(130))] {
            let before = pictures();
            let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_lightsquare"))
                .args(["render", "--plan", "plan.jsonl", "--cpu", "1"])
                .env("SLURM_ARRAY_TASK_ID", "0")
                .current_dir(folder)
                .stderr(Stdio::null())
                .spawn()
                .unwrap();
            while pictures() < before + 3 {
                assert_eq!(child.try_wait().unwrap(), None, "it ended before it was told to");
                thread::sleep(Duration::from_millis(5));
            }
            let id = child.id().to_string();
            std::process::Command::new("kill").args([signal, &id]).status().unwrap();
            assert_eq!(child.wait().unwrap().code(), expected, "{signal}");
            let (code, told, _) = run(folder, &["verify", "plan.jsonl"]);
            assert_eq!(code, 3);
            // One may be written, and not be noted yet.
            assert!(told.matches("broken").count() <= usize::from(ending != "png"), "{told}");
        }
        let before = pictures();
        let said = shard(folder, 0);
        let kept = said.split('(').nth(1).and_then(|rest| rest.split(' ').next()).unwrap();
        assert!(kept.parse::<usize>().unwrap() + 3 >= before, "{before} were there: {said}");
        done(folder, &["merge", "plan.jsonl"]);
        let games = ["render", "games.pgn", "--select", "1", "--out", "alone"];
        done(folder, &[&games[..], &options].concat());
        assert_same(&tree(&folder.join("out")), &tree(&folder.join("alone")), ending);
    }
}

#[test]
fn a_plan_is_found_and_followed_from_everywhere() {
    let expected = alone(&[]);
    let root = folder();
    let root = root.path();
    for (made_in, output, from, found) in [
        (".", "plans/plan.jsonl", ".", "plans/plan.jsonl"),
        (".", "plans/plan.jsonl", "plans", "plan.jsonl"),
        (".", "plan.jsonl", "plans/deep", "../../plan.jsonl"),
    ] {
        fs::create_dir_all(root.join("plans/deep")).unwrap();
        let games = ["plan", "games.pgn", "others.pgn", "--shards", "2", "-o", output];
        done(&root.join(made_in), &[&games, &PLAIN[..]].concat());
        let from = root.join(from);
        for number in ["0", "1"] {
            done(&from, &["render", "--plan", found, "--shard", number]);
        }
        done(&from, &["verify", found]);
        assert_eq!(run(&from, &["merge", found]).0, 3);
        assert_same(&tree(&root.join("out")), &expected, output);
        fs::remove_dir_all(root.join("out")).unwrap();
    }
}

#[test]
fn a_plan_is_the_same_each_time_and_fits_no_other_program_games_or_settings() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("config.ini"), "[GlobalSettings]\nSnellIndex=1.2\n").unwrap();
    plan(folder, &[], 4);
    let text = fs::read_to_string(folder.join("plan.jsonl")).unwrap();
    plan(folder, &[], 4);
    assert_eq!(fs::read_to_string(folder.join("plan.jsonl")).unwrap(), text);
    shard(folder, 3);
    // It may be made again while its shards are there.
    plan(folder, &[], 4);
    fs::remove_dir_all(folder.join("out")).unwrap();

    let lines: Vec<&str> = text.lines().collect();
    let version = format!("\"lightsquare\":\"{}\"", env!("CARGO_PKG_VERSION"));
    for (content, expected) in [
        (lines[..3].join("\n"), "plan.jsonl: is cut short, it has 2 of 4 shards"),
        (text[..text.len() - 9].to_owned(), "plan.jsonl: is cut short, it has 3 of 4 shards"),
        (text.replace("\"frame\":0", "\"frame\":1"), "was changed, or is damaged"),
        (
            text.replace(&version, "\"lightsquare\":\"9.9.9\""),
            "was made by lightsquare 9.9.9 (pictures 1, plans 1), and this is",
        ),
        ("[Event \"x\"]\n".to_owned(), "plan.jsonl: is no plan of lightsquare"),
        (String::new(), "plan.jsonl: is no plan of lightsquare"),
    ] {
        fs::write(folder.join("plan.jsonl"), content).unwrap();
        for arguments in
            [&["render", "--plan", "plan.jsonl", "--shard", "0"][..], &["verify", "plan.jsonl"]]
        {
            let said = refused(folder, arguments, 1);
            assert!(said.contains(expected), "{said}");
        }
    }

    fs::write(folder.join("plan.jsonl"), &text).unwrap();
    let shard_0 = ["render", "--plan", "plan.jsonl", "--shard", "0"];
    for (name, content, expected) in [
        ("games.pgn", Some(&GAMES[1..]), "games.pgn: has changed since plan.jsonl was made"),
        ("others.pgn", None, "others.pgn: is not there, and plan.jsonl was made with it"),
        (
            "config.ini",
            Some("[GlobalSettings]\nSnellIndex=1.3\n"),
            "config.ini, a chess set, bitmaps) have changed",
        ),
        ("config.ini", None, "config.ini, a chess set, bitmaps) have changed"),
    ] {
        let path = folder.join(name);
        let before = fs::read(&path).unwrap();
        match content {
            Some(content) => fs::write(&path, content).unwrap(),
            None => fs::remove_file(&path).unwrap(),
        }
        for arguments in [&shard_0[..], &["verify", "plan.jsonl"], &["merge", "plan.jsonl"]] {
            let said = refused(folder, arguments, 1);
            assert!(said.contains(expected), "{said}");
        }
        fs::write(path, before).unwrap();
    }
    assert!(!folder.join("out").exists());
    shard(folder, 0);
}

#[test]
fn output_of_another_plan_or_run_is_left_alone() {
    let folder = folder();
    let folder = folder.path();
    plan(folder, &[], 2);
    shard(folder, 0);
    let before = tree(&folder.join("out"));
    // Shards that are not merged.
    let games = ["plan", "games.pgn", "--shards", "2", "-o", "new.jsonl", "--out"];
    let said = refused(folder, &[&games[..], &["out"], &PLAIN].concat(), 1);
    assert!(said.contains("out/.shards: has shards of a plan that are not merged"), "{said}");
    let said = refused(folder, &["render", "games.pgn"], 1);
    assert!(said.contains("expected `lightsquare merge` first, another --out"), "{said}");
    fs::rename(folder.join("out"), folder.join("elsewhere")).unwrap();
    done(folder, &[&games[..], &["out"], &PLAIN].concat());
    fs::rename(folder.join("elsewhere"), folder.join("out")).unwrap();
    for arguments in
        [&["render", "--plan", "new.jsonl", "--shard", "1"][..], &["verify", "new.jsonl"]]
    {
        let said = refused(folder, arguments, 1);
        assert!(said.contains("has shards of another plan, this is"), "{said}");
    }
    assert_same(&tree(&folder.join("out")), &before, "");
    // Shards that are merged.
    shard(folder, 1);
    let before = merged(folder);
    for (options, what) in [
        (&["--plain", "--captions", "--size", "160x120"][..], "other pictures"),
        (&["--format", "webp"], "another format"),
        (&["--to", "1w"], "less"),
        (&["--film", "gif", "--no-frames"], "films alone"),
    ] {
        let other = ["plan", "games.pgn", "--shards", "1", "-o", "new.jsonl"];
        let look = if options.contains(&"--size") { &PLAIN[..4] } else { &PLAIN[..] };
        done(folder, &[&other[..], look, options].concat());
        for arguments in
            [&["render", "--plan", "new.jsonl", "--shard", "0"][..], &["verify", "new.jsonl"]]
        {
            let said = refused(folder, arguments, 1);
            assert!(said.contains("0001-a-b/game.json: is of another run or plan"), "{said}");
        }
        assert_same(&tree(&folder.join("out")), &before, what);
    }
}

#[test]
fn what_no_plan_can_have_is_refused() {
    let folder = folder();
    let folder = folder.path();
    fs::write(folder.join("own.ini"), "").unwrap();
    fs::write(folder.join("other.txt"), "mine").unwrap();
    for (arguments, code, expected) in [
        (&["plan", "-"][..], 1, "-: a plan's games are read by every shard, expected files"),
        (&["plan", "none.pgn"], 1, "none.pgn: no such file"),
        (&["plan", "games.pgn", "--shards", "0"], 2, "from 1 to 1000"),
        (&["plan", "games.pgn", "--shards", "1001"], 2, "from 1 to 1000"),
        (&["plan", "games.pgn", "-o", "games.pgn"], 1, "games.pgn: is the file that is read"),
        (
            &["plan", "games.pgn", "-c", "own.ini", "-o", "own.ini"],
            1,
            "own.ini: is the file that is",
        ),
        (&["plan", "games.pgn", "-o", "x", "--out", "x"], 2, "found the folder of --out, `x`"),
        (&["plan", "games.pgn", "--out", "own.ini"], 1, "own.ini: cannot be written"),
        (&["render", "--plan", "plan.jsonl", "--shard", "x"], 2, "a whole number from 0 to 999"),
        (&["plan", "games.pgn", "-o", "other.txt"], 1, "other.txt: is there and is no plan"),
        (&["plan", "games.pgn", "-o", "-"], 2, "--output: expected a file, found `-`"),
        (&["verify", "none.jsonl"], 1, "none.jsonl: cannot be read"),
        (&["verify", "games.pgn"], 1, "games.pgn: is no plan of lightsquare"),
        (
            &["render", "--plan", "plan.jsonl"],
            2,
            "--shard: expected a shard's number, and there is no",
        ),
        (
            &["render", "--plan", "plan.jsonl", "--shard", "3"],
            2,
            "there is no shard 3, it has shards 0 to 2",
        ),
        (
            &["render", "--plan", "plan.jsonl", "--shard", "0", "games.pgn"],
            2,
            "cannot be used with",
        ),
        (
            &["render", "--plan", "plan.jsonl", "--shard", "0", "--size", "9x9"],
            2,
            "cannot be used with",
        ),
        (
            &["render", "--plan", "plan.jsonl", "--shard", "0", "--out", "x"],
            2,
            "cannot be used with",
        ),
        (&["render", "games.pgn", "--shard", "0"], 2, "--plan"),
    ] {
        if !folder.join("plan.jsonl").exists() {
            plan(folder, &[], 3);
        }
        let said = refused(folder, arguments, code);
        assert!(said.contains(expected), "{arguments:?}: {said}");
    }
    assert_eq!(fs::read_to_string(folder.join("games.pgn")).unwrap(), GAMES);
}

/// What plain `render` has left, and a plan that would replace or remove some of it.
#[test]
fn what_a_run_with_other_settings_has_left_is_refused_before_anything_is_written() {
    let small = ["--size", "50x40"];
    for (before, planned) in [
        (&small[..], &["--frames", "1-2"][..]),
        (&["--size", "50x40", "--frames", "1-2"], &[]),
        (&["--size", "50x40", "--frames", "0-2"], &["--frames", "1-3"]),
        (&["--names", "x##.png"], &[]),
        (&["--variations"], &[]),
        (&["--film", "gif"], &["--film", "apng"]),
        (&["--film", "gif", "--no-frames", "--flip"], &["--film", "gif", "--no-frames"]),
    ] {
        let folder = folder();
        let folder = folder.path();
        // The second file is of the plan alone.
        let games = ["render", "games.pgn", "--select", "1"];
        let look = if before.contains(&"--size") { &PLAIN[..4] } else { &PLAIN[..] };
        done(folder, &[&games[..], look, before].concat());
        let left = tree(&folder.join("out"));
        let games = ["plan", "others.pgn", "games.pgn", "--plies", "6-9", "--shards", "1"];
        done(folder, &[&games[..], &PLAIN, planned].concat());
        for arguments in [
            &["render", "--plan", "plan.jsonl", "--shard", "0"][..],
            &["verify", "plan.jsonl"],
            &["merge", "plan.jsonl"],
        ] {
            let said = refused(folder, arguments, 1);
            assert!(said.contains("is of another run or plan"), "{before:?}, {planned:?}: {said}");
            assert_same(&tree(&folder.join("out")), &left, &format!("{before:?}, {planned:?}"));
        }
    }
}

#[test]
fn a_film_that_nobody_tells_of_is_made_anew() {
    let folder = folder();
    let folder = folder.path();
    let film = ["--film", "gif", "--no-frames", "--animate", "--fps", "20"];
    let look = [&["games.pgn", "--select", "1", "--size", "200x150"][..], &film].concat();
    done(folder, &[&["plan", "--shards", "1"], &look[..]].concat());
    let game = folder.join("out/games/0001-a-b");
    fs::create_dir_all(&game).unwrap();
    fs::write(game.join("film.gif"), "another").unwrap();
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_lightsquare"))
        .args(["render", "--plan", "plan.jsonl", "--shard", "0", "--cpu", "1"])
        .current_dir(folder)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while !folder.join("out/.shards").exists() {
        thread::sleep(Duration::from_millis(5));
    }
    thread::sleep(Duration::from_millis(300));
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(run(folder, &["verify", "plan.jsonl"]).0, 3);
    shard(folder, 0);
    done(folder, &["merge", "plan.jsonl"]);
    done(folder, &[&["render", "--out", "alone"], &look[..]].concat());
    assert_same(&tree(&folder.join("out")), &tree(&folder.join("alone")), "");
}

#[test]
fn games_of_which_nothing_can_be_shown_are_reported_as_ever() {
    let folder = folder();
    let folder = folder.path();
    plan(folder, &["--select", "3", "--tag", "White=E"], 2);
    for number in 0..2 {
        shard(folder, number);
    }
    let expected = alone(&["--select", "3", "--tag", "White=E"]);
    assert_same(&merged(folder), &expected, "");
}

#[test]
fn what_writes_there_already_keeps_shards_out_and_they_leave_nothing_behind() {
    let folder = folder();
    let folder = folder.path();
    plan(folder, &[], 1);
    fs::create_dir_all(folder.join("out/others")).unwrap();
    let lock = fs::File::create(folder.join("out/others/.lock")).unwrap();
    lock.lock().unwrap();
    let said = refused(folder, &["render", "--plan", "plan.jsonl", "--shard", "0"], 1);
    assert!(said.contains("out/others: another lightsquare"), "{said}");
    assert!(!folder.join("out/.shards").exists());
    drop(lock);
    shard(folder, 0);
    merged(folder);
}

#[test]
fn a_plan_says_what_it_comes_to() {
    let folder = folder();
    let (code, told, said) =
        run(folder.path(), &[&["plan", "others.pgn", "--shards", "2"], &PLAIN[..]].concat());
    assert_eq!((code, &*told), (0, "--array=0-1\n"));
    for expected in
        ["games: 3; frames: 15", "shards: 2, of 7 to 8 frames", "each begins with a game"]
    {
        assert!(said.contains(expected), "{said}");
    }
    let (_, _, said) =
        run(folder.path(), &[&["plan", "others.pgn", "--shards", "4"], &PLAIN[..]].concat());
    assert!(said.contains("2 of them begin within a game, which costs"), "{said}");
    // So little work is best left whole.
    let (_, told, _) = run(folder.path(), &[&["plan", "others.pgn"], &PLAIN[..]].concat());
    assert_eq!(told, "--array=0\n");
}
