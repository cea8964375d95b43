//! Runs over what earlier runs have left: whatever happened to those, the outcome is that of one run.

mod trees;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::time::{Duration, SystemTime};

use assert_cmd::Command;
use tempfile::TempDir;
use trees::tree;

/// Two games that begin alike, one in part, and one that cannot be shown.
const GAMES: &str = "[White \"A\"]\n[Black \"B\"]\n\n1. e4 e5 2. Nf3 (2. Bc4 Nc6) Nc6 3. Bb5 a6 *\n\n\
    [White \"C\"]\n[Black \"D\"]\n\n1. e4 e5 2. Nf3 d6 3. d5 *\n\n\
    [White \"E\"]\n[FEN \"nothing\"]\n\n1. e4 *\n";

const PLAIN: [&str; 4] = ["--look", "thesis", "--aa", "none"];

fn command(folder: &Path, parts: &[&[&str]]) -> Command {
    fs::write(folder.join("games.pgn"), GAMES).unwrap();
    let mut command = Command::cargo_bin("lightsquare").unwrap();
    command.current_dir(folder).args(["render", "games.pgn"]).args(PLAIN).args(parts.concat());
    if !parts.concat().contains(&"--size") {
        command.args(["--size", "40x30"]);
    }
    command
}

/// Exit code and messages.
fn run(folder: &Path, parts: &[&[&str]]) -> (i32, String) {
    let output = command(folder, parts).output().unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

/// Renders the games, of which one is partial and one is skipped; what was said.
fn done(folder: &Path, parts: &[&[&str]]) -> String {
    let (code, said) = run(folder, parts);
    assert_eq!(code, 3, "{said}");
    said
}

fn out(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    tree(&folder.join("out"))
}

/// What one run gives where nothing was before.
fn fresh(parts: &[&[&str]]) -> BTreeMap<PathBuf, Vec<u8>> {
    let folder = TempDir::new().unwrap();
    done(folder.path(), parts);
    out(folder.path())
}

const FIRST: &str = "out/games/0001-a-b";

#[test]
fn what_is_done_is_not_done_again() {
    let folder = TempDir::new().unwrap();
    let parts: &[&[&str]] = &[&["--variations", "--film", "gif"]];
    let said = done(folder.path(), parts);
    assert!(said.contains("15 frames, 3 films in out"), "{said}");
    let before = out(folder.path());
    // Whatever is written again has another time.
    let old = SystemTime::now() - Duration::from_secs(1000);
    let pictures = before.keys().map(|name| folder.path().join("out").join(name));
    let pictures: Vec<PathBuf> =
        pictures.filter(|path| !path.to_string_lossy().contains("json")).collect();
    for path in &pictures {
        fs::File::options().write(true).open(path).unwrap().set_modified(old).unwrap();
    }
    let said = done(folder.path(), parts);
    assert!(said.contains("15 frames (15 of them were there), 3 films in out"), "{said}");
    assert_eq!(out(folder.path()), before);
    for path in pictures {
        assert_eq!(fs::metadata(&path).unwrap().modified().unwrap(), old, "{}", path.display());
    }
}

#[test]
fn what_is_missing_or_broken_is_done_again() {
    for format in ["png", "jpg", "bmp", "tiff", "webp"] {
        let folder = TempDir::new().unwrap();
        let parts: &[&[&str]] = &[&["--format", format, "--film", "apng"]];
        done(folder.path(), parts);
        let before = out(folder.path());
        let first = folder.path().join(FIRST);
        let picture = |index: usize| first.join(format!("frame_{index:05}.{format}"));
        fs::remove_file(picture(0)).unwrap();
        let bytes = fs::read(picture(2)).unwrap();
        fs::write(picture(2), &bytes[..bytes.len() / 2]).unwrap();
        fs::write(picture(3), "").unwrap();
        let mut bytes = fs::read(picture(4)).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(picture(4), bytes).unwrap();
        // The film is made of the pictures that are there, where they are exact.
        fs::remove_file(first.join("film.apng")).unwrap();
        let said = done(folder.path(), parts);
        assert!(said.contains("12 frames (8 of them were there), 2 films"), "{format}: {said}");
        assert!(out(folder.path()) == before, "{format}");
    }
}

#[test]
fn other_settings_are_never_mixed() {
    let first = &["--to", "2b"][..];
    for other in [
        &["--flip"][..],
        &["--plain"],
        &["--theme", "marble"],
        &["--captions", "--size", "120x76"],
        &["--animate", "--fps", "2"],
        &["--from", "1w"],
        &["--every", "2"],
        &["--names", "x_###.png"],
        &["--format", "jpg"],
        &["--film", "gif"],
        &["--film", "gif", "--no-frames"],
        &["--variations"],
        &["--at", "end"],
    ] {
        let folder = TempDir::new().unwrap();
        for parts in [&[first][..], &[first, &["--frames", "1-2"]], &[other], &[first], &[other]] {
            run(folder.path(), parts);
        }
        let expected = TempDir::new().unwrap();
        let (code, said) = run(expected.path(), &[other]);
        assert_eq!(code, 3, "{said}");
        assert!(out(folder.path()) == out(expected.path()), "{other:?}");
    }
}

/// A part of other settings in the midst of the whole: neither run takes the other's pictures for its own.
#[test]
fn a_part_of_other_settings_is_not_taken_for_the_whole() {
    let folder = TempDir::new().unwrap();
    done(folder.path(), &[]);
    run(folder.path(), &[&["--frames", "1-2", "--flip", "--select", "1"]]);
    let mixed = out(folder.path());
    assert!(mixed.contains_key(Path::new("games/0001-a-b/game_00001-00002.json")));
    let said = done(folder.path(), &[]);
    assert!(said.contains("12 frames (10 of them were there)"), "{said}");
    assert!(out(folder.path()) == fresh(&[]));
}

/// A PNG says what it is made of, so that none can stand for another.
#[test]
fn a_picture_under_another_name_is_not_taken_for_it() {
    let folder = TempDir::new().unwrap();
    done(folder.path(), &[]);
    let before = out(folder.path());
    let first = folder.path().join(FIRST);
    fs::copy(first.join("frame_00004.png"), first.join("frame_00005.png")).unwrap();
    run(folder.path(), &[&["--frames", "1-2", "--select", "1", "--flip"]]);
    fs::remove_file(first.join("game_00001-00002.json")).unwrap();
    let said = done(folder.path(), &[]);
    assert!(said.contains("12 frames (9 of them were there)"), "{said}");
    assert!(out(folder.path()) == before);
}

/// Pictures of other settings whose manifest is about to be written over go with it.
#[test]
fn pictures_of_a_part_do_not_outlive_what_is_said_of_them() {
    for (mine, other, last) in [
        (&[][..], &[][..], &["--film", "gif", "--no-frames"][..]),
        (&["--names", "x#.png"], &["--names", "x#.png"], &["--names", "y#.png"]),
    ] {
        let part = ["--frames", "1-2", "--select", "1"];
        let folder = TempDir::new().unwrap();
        done(folder.path(), &[mine]);
        run(folder.path(), &[&part, &["--flip"], other]);
        run(folder.path(), &[&part, last]);
        done(folder.path(), &[mine]);
        assert!(out(folder.path()) == fresh(&[mine]), "{last:?}");
    }
}

/// Of a variation too that is not wanted any more.
#[test]
fn what_dead_runs_left_is_removed() {
    let folder = TempDir::new().unwrap();
    done(folder.path(), &[&["--variations"]]);
    let first = folder.path().join(FIRST);
    let variation = first.join("2w-bc4");
    assert!(variation.is_dir());
    for place in [&folder.path().join("out/games"), &first, &variation] {
        fs::write(place.join(".lightsquare-Xy12"), "half a picture").unwrap();
    }
    done(folder.path(), &[]);
    assert!(out(folder.path()) == fresh(&[]));
    assert!(!variation.exists());
}

#[test]
fn what_is_of_other_settings_can_be_left_alone() {
    let folder = TempDir::new().unwrap();
    done(folder.path(), &[]);
    let before = tree(&folder.path().join(FIRST));
    // Of the second game alone: the first one stays away too.
    fs::rename(folder.path().join(FIRST), folder.path().join("first")).unwrap();
    let others = out(folder.path());
    assert_eq!(run(folder.path(), &[&["--flip", "--no-replace"]]).0, 1);
    assert!(out(folder.path()) == others);
    fs::rename(folder.path().join("first"), folder.path().join(FIRST)).unwrap();
    let (code, said) = run(folder.path(), &[&["--flip", "--no-replace"]]);
    assert_eq!(code, 1, "{said}");
    assert!(said.contains("frame_00000.png: is of another run"), "{said}");
    assert!(tree(&folder.path().join(FIRST)) == before);
    // What is broken is of no other run.
    fs::remove_file(folder.path().join(FIRST).join("frame_00003.png")).unwrap();
    fs::write(folder.path().join(FIRST).join("frame_00002.png"), "").unwrap();
    done(folder.path(), &[&["--no-replace"]]);
    assert!(tree(&folder.path().join(FIRST)) == before);
}

#[test]
fn threads_and_games_side_by_side_change_nothing() {
    let parts = ["--variations", "--film", "apng"];
    let one = fresh(&[&parts, &["--cpu", "1"]]);
    for threads in ["2", "5"] {
        assert!(fresh(&[&parts, &["--cpu", threads]]) == one, "{threads}");
    }
    // The first moves of both games are the same: together they give what each gives alone.
    let folder = TempDir::new().unwrap();
    for number in ["1", "2"] {
        run(folder.path(), &[&parts, &["--select", number]]);
    }
    let alone = out(folder.path());
    assert!(alone.iter().all(|(name, bytes)| {
        name.ends_with("report.jsonl") || one.get(name).is_some_and(|known| known == bytes)
    }));
    assert_eq!(alone.len(), one.len());
}

#[test]
fn every_nth_position_and_the_last_one() {
    let folder = TempDir::new().unwrap();
    for (every, plies) in
        [("1", &[0, 1, 2, 3, 4, 5, 6][..]), ("4", &[0, 4, 6]), ("3", &[0, 3, 6]), ("99", &[0, 6])]
    {
        run(folder.path(), &[&["--every", every, "--select", "1"]]);
        let manifest = fs::read(folder.path().join(FIRST).join("game.json")).unwrap();
        let manifest: serde_json::Value = serde_json::from_slice(&manifest).unwrap();
        let rows = manifest["frames"].as_array().unwrap();
        let found: Vec<u64> = rows.iter().map(|row| row["ply"].as_u64().unwrap()).collect();
        assert_eq!(found, plies, "{every}");
        for (index, row) in rows.iter().enumerate() {
            assert_eq!(row["file"], format!("frame_{index:05}.png"));
        }
    }
    run(folder.path(), &[&["--at", "2w", "--select", "1"]]);
    assert_eq!(tree(&folder.path().join(FIRST)).len(), 2);
}

/// A run that takes long enough to be stopped.
fn long(folder: &Path) -> Child {
    fs::write(folder.join("games.pgn"), GAMES).unwrap();
    std::process::Command::new(env!("CARGO_BIN_EXE_lightsquare"))
        .current_dir(folder)
        .args(["render", "games.pgn"])
        .args(LONG)
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

const LONG: [&str; 12] = [
    "--look",
    "thesis",
    "--size",
    "160x120",
    "--animate",
    "--film",
    "gif",
    "--variations",
    "--fps",
    "10",
    "--last",
    "1",
];

/// Killed again and again, at moments that fall anywhere: what is left is never wrong, and in the end all is there.
#[cfg(unix)]
#[test]
fn runs_that_were_killed_are_gone_on_with() {
    let expected = TempDir::new().unwrap();
    assert_eq!(long(expected.path()).wait().unwrap().code(), Some(3));
    let expected = out(expected.path());
    let folder = TempDir::new().unwrap();
    for kill in 0..8_u64 {
        let mut child = long(folder.path());
        std::thread::sleep(Duration::from_millis(20 + kill * 37 % 150));
        child.kill().unwrap();
        child.wait().unwrap();
        let found = if folder.path().join("out").exists() { out(folder.path()) } else { continue };
        for (name, bytes) in found {
            let file = name.file_name().unwrap().to_string_lossy().into_owned();
            assert!(
                file.starts_with(".l") || expected.get(&name) == Some(&bytes),
                "{}",
                name.display()
            );
        }
    }
    assert_eq!(long(folder.path()).wait().unwrap().code(), Some(3));
    let found = out(folder.path());
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    assert!(found == expected);
}

#[cfg(unix)]
#[test]
fn two_runs_do_not_write_to_one_folder() {
    let folder = TempDir::new().unwrap();
    let mut child = long(folder.path());
    while !folder.path().join("out/games/.lock").exists() {
        assert!(child.try_wait().unwrap().is_none());
        std::thread::yield_now();
    }
    let (code, said) = run(folder.path(), &[]);
    assert_eq!(code, 1);
    let expected = format!("another lightsquare (process {}) writes there", child.id());
    assert!(said.contains(&expected), "{said}");
    child.kill().unwrap();
    child.wait().unwrap();
    // Its lock is still there, and holds nobody.
    assert!(folder.path().join("out/games/.lock").exists());
    done(folder.path(), &[]);
    assert!(!folder.path().join("out/games/.lock").exists());
}

#[cfg(unix)]
#[test]
fn no_link_leads_out_of_the_output_folder() {
    use std::os::unix::fs::symlink;
    let folder = TempDir::new().unwrap();
    let other = folder.path().join("other");
    fs::create_dir_all(&other).unwrap();
    fs::write(other.join("mine.png"), "mine").unwrap();
    fs::write(other.join("frame_00000.png"), "mine").unwrap();
    let before = tree(&other);

    // Files that are links are replaced, not followed.
    let first = folder.path().join(FIRST);
    fs::create_dir_all(&first).unwrap();
    for name in ["frame_00000.png", "game.json", "film.gif"] {
        symlink(other.join("mine.png"), first.join(name)).unwrap();
    }
    symlink(other.join("mine.png"), folder.path().join("out/games/report.jsonl")).unwrap();
    symlink(other.join("mine.png"), folder.path().join("out/games/.lock")).unwrap();
    done(folder.path(), &[&["--film", "gif"]]);
    assert!(tree(&other) == before);
    assert!(out(folder.path()) == fresh(&[&["--film", "gif"]]));

    // Folders that are links are refused.
    fs::remove_dir_all(&first).unwrap();
    symlink(&other, &first).unwrap();
    let (code, said) = run(folder.path(), &[]);
    assert_eq!(code, 1);
    assert!(said.contains("0001-a-b: cannot be written: it is a link"), "{said}");
    assert!(tree(&other) == before);
    fs::remove_dir_all(folder.path().join("out")).unwrap();
    fs::create_dir(folder.path().join("out")).unwrap();
    symlink(&other, folder.path().join("out/games")).unwrap();
    let (code, said) = run(folder.path(), &[]);
    assert_eq!(code, 1);
    assert!(said.contains("out/games: cannot be written: it is a link"), "{said}");
    assert!(tree(&other) == before);
}

#[test]
fn pictures_that_cannot_fit_are_refused_before_any_work() {
    let folder = TempDir::new().unwrap();
    // A film of an hour in the largest size and without compression takes 2.9 TB a minute.
    let huge = ["--animate", "--fps", "240", "--first", "3600", "--format", "bmp"];
    let size = ["--size", "16384x16384"];
    let mut command = Command::cargo_bin("lightsquare").unwrap();
    fs::write(folder.path().join("games.pgn"), GAMES).unwrap();
    command.current_dir(folder.path()).args(["render", "games.pgn"]).args(huge).args(size);
    let output = command.output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("frames of 16384x16384 take 13") && said.contains(" TB at least"),
        "{said}"
    );
    assert!(!folder.path().join("out").exists());
}
