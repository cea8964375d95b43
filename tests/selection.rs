//! Which games are taken, as a user asks for them.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

const MASTERS: &str = r#"[Event "Linares"]
[White "Kasparov, Garry"]
[Black "Karpov, Anatoly"]
[WhiteElo "2805"]
[Date "1993.03.09"]
[ECO "E86"]
[Result "1-0"]

1. d4 Nf6 2. c4 g6 1-0

[Event "Blitz"]
[White "Kasparov, Sergey"]
[Black "Anatoly Karpov"]
[WhiteElo "2400"]
[Date "1961.??.??"]
[ECO "B20"]
[Result "0-1"]

1. f3 e5 2. g4 Qh4# 0-1

[Event "Torn"]
[White "Réti, Richárd"]
[Black "?"]
[WhiteElo "?"]
[Date "????.??.??"]
[Result "*"]

1. e4 e5 2. Qxh7 *
"#;

const OTHERS: &str = "[White \"Morphy, Paul\"]\n[Black \"Kasparov, Garry\"]\n[ECO \"C41\"]\n\n1. e4 e5 2. Nf3 d6 *\n";

/// A folder with the files `masters.pgn` and `others.pgn`.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("masters.pgn"), MASTERS).unwrap();
    fs::write(folder.path().join("others.pgn"), OTHERS).unwrap();
    folder
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

/// The numbers of the games that `inspect` lists.
fn listed(stdout: &str) -> Vec<usize> {
    stdout.lines().filter_map(|line| line.split_whitespace().next()?.parse().ok()).collect()
}

#[test]
fn inspect_lists_the_games_that_are_asked_for() {
    let folder = folder();
    for (flags, expected) in [
        (&["--select", "2:3"][..], &[2, 3][..]),
        (&["--tag", "White=kasparov*"], &[1, 2]),
        (&["--tag", "White=Reti*"], &[3]),
        (&["--tag", "WhiteElo>=2500"], &[1]),
        (&["--tag", "WhiteElo!=2805"], &[2, 3]),
        (&["--tag", "Date<1962"], &[2]),
        (&["--tag", "ECO=B20-B99"], &[2]),
        (&["--tag", "ECO>=B20", "--tag", "Result=1-0"], &[1]),
        (&["--tag", "ECO!=*"], &[3]),
        (&["--player", "Karpov"], &[1, 2]),
        (&["--player", "Anatoly Karpov", "--player", "Kasparov, G*"], &[1]),
        (&["--player", "Karpov", "--player", "Kasparov"], &[1, 2]),
        (&["--plies", "4-"], &[1, 2]),
        (&["--plies", "-2"], &[3]),
        (&["--plies", "2"], &[3]),
        (&["--checkmate"], &[2]),
        (&["--fen", "*/*/*/*/*q/*/*/* w"], &[2]),
        (&["--fen", "*/*/*/*/2[PQ]P*/*/*/*"], &[1]),
        (&["--limit", "2"], &[1, 2]),
        (&["--player", "Karpov", "--limit", "1"], &[1]),
        (&["--select", "2-3", "--player", "Karpov"], &[2]),
    ] {
        let (code, stdout, stderr) =
            run(folder.path(), &[&["inspect", "masters.pgn"], flags].concat());
        assert_eq!(listed(&stdout), expected, "{flags:?}: {stderr}");
        // The third one cannot be read whole; where it is not asked for nobody hears of it.
        let has_third = expected.contains(&3);
        assert_eq!(
            (code, stdout.contains("Qxh7")),
            (3 * i32::from(has_third), has_third),
            "{flags:?}"
        );
        assert_eq!(stderr, "", "{flags:?}");
    }
}

#[test]
fn games_that_are_not_asked_for_are_no_problem_in_tables_either() {
    let folder = folder();
    for table in ["--positions", "--notes"] {
        let (code, _, stderr) = run(folder.path(), &["inspect", "masters.pgn", table]);
        assert_eq!(code, 3);
        assert!(stderr.contains("game 3, line 28: `Qxh7`"), "{stderr}");
        let (code, stdout, stderr) =
            run(folder.path(), &["inspect", "masters.pgn", table, "--player", "Karpov"]);
        assert_eq!((code, stderr.as_str()), (0, ""));
        assert!(stdout.lines().skip(1).all(|row| row.starts_with(['1', '2'])), "{stdout}");
    }
}

#[test]
fn a_file_without_such_games_is_passed_over_where_another_one_has_some() {
    let folder = folder();
    let both = |flags: &[&str]| {
        run(folder.path(), &[&["inspect", "masters.pgn", "others.pgn"], flags].concat())
    };
    let (code, stdout, stderr) = both(&["--player", "Morphy"]);
    assert_eq!((code, stderr.as_str()), (0, ""));
    assert!(stdout.starts_with("others.pgn\n    1  Morphy, Paul"), "{stdout}");
    let (code, stdout, stderr) = both(&["--select", "2"]);
    assert_eq!(code, 0);
    assert!(!stdout.contains("Morphy"), "{stdout}");
    assert!(stderr.contains("others.pgn: game 2 is selected, but it has 1"), "{stderr}");
    // The limit is one of all files together.
    let (code, stdout, _) = both(&["--player", "Kasparov, Garry", "--limit", "2"]);
    assert_eq!((code, listed(&stdout)), (0, vec![1, 1]));
    let (code, stdout, _) = both(&["--player", "Kasparov, Garry", "--limit", "1"]);
    assert_eq!((code, listed(&stdout)), (0, vec![1]));
    assert!(!stdout.contains("others.pgn"), "{stdout}");
}

#[test]
fn that_there_are_none_is_told_with_how_many_there_are() {
    let folder = folder();
    for (arguments, message) in [
        (
            &["masters.pgn", "--player", "Short"][..],
            "masters.pgn: none of its games is selected, it has 3",
        ),
        (
            &["masters.pgn", "--select", "4-9"],
            "masters.pgn: none of its games is selected, it has 3",
        ),
        (
            &["masters.pgn", "--select", "1", "--checkmate"],
            "masters.pgn: none of its games is selected, it has 3",
        ),
        (
            &["masters.pgn", "others.pgn", "--tag", "ECO=A00"],
            "none of the games is selected, the 2 files have 4",
        ),
    ] {
        let (code, stdout, stderr) = run(folder.path(), &[&["inspect"], arguments].concat());
        assert_eq!((code, stdout.as_str()), (1, ""), "{arguments:?}");
        assert_eq!(stderr.trim_end(), format!("error: {message}"), "{arguments:?}");
    }
}

#[test]
fn bad_tests_are_told_with_their_flag() {
    let folder = folder();
    for (flags, flag, part) in [
        (&["--tag", "WhiteElo>>2500"][..], "--tag", "`>>` is no comparison, expected one of"),
        (&["--tag", "Foo"], "--tag", "no comparison in it, expected a tag's name"),
        (&["--tag", "White<Kasparov"], "--tag", "`Kasparov` has no order, expected a whole number"),
        (&["--plies", "80-20"], "--plies", "`80-20` is no number of half-moves"),
        (&["--fen", "8/8/8"], "--fen", "3 ranks, expected 8"),
        (&["--limit", "0"], "--limit", "expected a whole number from 1"),
        (&["--player", " "], "--player", "an empty name, expected one such as Kasparov"),
        (
            &["--player", "A", "--player", "B", "--player", "C"],
            "--player",
            "3 names, expected at most two",
        ),
        (&["--select", "x"], "--select", "`x` is no game number or range"),
    ] {
        for command in ["inspect", "render"] {
            let (code, stdout, stderr) =
                run(folder.path(), &[&[command, "masters.pgn"], flags].concat());
            assert_eq!((code, stdout.as_str()), (2, ""), "{flags:?}");
            assert!(stderr.contains(flag) && stderr.contains(part), "{flags:?} gave {stderr}");
        }
    }
}

/// Nobody waits for the end of what never ends.
#[test]
fn the_standard_input_is_read_as_far_as_games_are_wanted() {
    use std::io::Write;
    use std::process::{Command, Stdio};
    for flags in [&["--limit", "2"][..], &["--select", "1:2"]] {
        let folder = folder();
        let mut child = Command::new(env!("CARGO_BIN_EXE_lightsquare"))
            .current_dir(folder.path())
            .args([
                "render", "-", "--at", "end", "--look", "thesis", "--aa", "none", "--size", "8x8",
                "-q",
            ])
            .args(flags)
            .stdin(Stdio::piped())
            .spawn()
            .unwrap();
        let mut input = child.stdin.take().unwrap();
        // It ends while it is still written to.
        while input.write_all(OTHERS.as_bytes()).is_ok() {}
        assert_eq!(child.wait().unwrap().code(), Some(0), "{flags:?}");
        let games = fs::read_dir(folder.path().join("out/stdin")).unwrap().count();
        assert_eq!(games, 3, "{flags:?}: two games and the report");
    }
}

/// A quick measurement, of which only what is counted is certain.
#[test]
fn an_estimate_counts_games_and_frames() {
    let folder = folder();
    let quick = ["--size", "16x16", "--aa", "none", "--look", "thesis"];
    for (command, games, frames) in [
        (&["render", "masters.pgn", "--estimate", "--limit", "2"][..], 2, 10),
        (&["render", "masters.pgn", "--estimate", "--at", "end"], 3, 3),
    ] {
        let (code, stdout, stderr) = run(folder.path(), &[command, &quick].concat());
        assert_eq!(code, 0, "{stderr}");
        let expected = format!("games: {games}; frames: {frames}; about ");
        assert!(stdout.starts_with(&expected), "{stdout}");
    }
    let (code, stdout, stderr) =
        run(folder.path(), &["inspect", "masters.pgn", "--estimate", "--select", "2"]);
    assert_eq!(code, 0, "{stderr}");
    assert!(stdout.starts_with("games: 1; frames: 5; about "), "{stdout}");
    assert!(!folder.path().join("out").exists());
}

/// `render` takes the very games that `inspect` does, under the numbers that they have in their files.
#[test]
fn the_same_games_are_rendered() {
    for (flags, expected) in [
        (&[][..], &["masters/0001", "masters/0002", "masters/0003", "others/0001"][..]),
        (&["--player", "Kasparov"], &["masters/0001", "masters/0002", "others/0001"]),
        (&["--player", "Kasparov", "--limit", "2"], &["masters/0001", "masters/0002"]),
        (&["--select", "2-3"], &["masters/0002", "masters/0003"]),
        (&["--tag", "ECO=C*", "--select", "1"], &["others/0001"]),
        (&["--checkmate"], &["masters/0002"]),
        (&["--limit", "1"], &["masters/0001"]),
    ] {
        let folder = folder();
        let plain = ["--at", "end", "--look", "thesis", "--aa", "none", "--size", "8x8", "-q"];
        let command = ["render", "masters.pgn", "others.pgn"];
        let (code, _, stderr) = run(folder.path(), &[&command, &plain[..], flags].concat());
        assert!([0, 3].contains(&code), "{stderr}");
        let mut found = Vec::new();
        for file in fs::read_dir(folder.path().join("out")).unwrap() {
            let file = file.unwrap();
            for game in fs::read_dir(file.path()).unwrap() {
                let names = [file.file_name(), game.unwrap().file_name()];
                let [file, game] = names.map(|name| name.into_string().unwrap());
                if game != "report.jsonl" {
                    found.push(format!("{file}/{}", &game[..4]));
                }
            }
            let report = fs::read_to_string(file.path().join("report.jsonl")).unwrap();
            let name = file.file_name().into_string().unwrap();
            let here = expected.iter().filter(|game| game.starts_with(&name)).count();
            assert_eq!(report.lines().count(), here, "{flags:?}");
        }
        found.sort();
        assert_eq!(found, expected, "{flags:?}");
    }
    let folder = folder();
    let (code, _, stderr) = run(folder.path(), &["render", "masters.pgn", "--player", "Nobody"]);
    assert_eq!(code, 1);
    assert!(stderr.contains("masters.pgn: none of its games is selected, it has 3"), "{stderr}");
    assert!(!folder.path().join("out").exists());
}
