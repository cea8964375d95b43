//! Files of games that are packed, cut off, damaged, or no text at all.

use std::fs;
use std::io::Write;
use std::path::Path;

use assert_cmd::Command;
use bzip2::write::BzEncoder;
use flate2::write::GzEncoder;
use lightsquare::game::{Game, Source, SourceError, Wanted};
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

/// Enough games that each way to pack them has more than one block.
fn games() -> String {
    (1..=9000)
        .map(|n| {
            let (a, b) = (n * 7919 % 10_007, n * 104_729 % 99_991);
            format!("[White \"a{a}\"]\n[Black \"{b}\"]\n\n1. e4 e5 2. Nf3 {{{b:x}}} Nc6 1-0\n\n")
        })
        .collect()
}

fn gzip(text: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(text).unwrap();
    encoder.finish().unwrap()
}

fn bzip2(text: &[u8]) -> Vec<u8> {
    let mut encoder = BzEncoder::new(Vec::new(), bzip2::Compression::fast());
    encoder.write_all(text).unwrap();
    encoder.finish().unwrap()
}

fn zstd(text: &[u8]) -> Vec<u8> {
    compress_to_vec(text, CompressionLevel::Fastest)
}

type Pack = fn(&[u8]) -> Vec<u8>;
const PACKED: [(&str, Pack); 3] = [("zstd", zstd), ("gzip", gzip), ("bzip2", bzip2)];

fn read(path: &Path) -> Result<Vec<Game>, SourceError> {
    Source::open(path)?.games().collect()
}

/// Reads bytes from a file whose name says nothing of what they are.
fn read_bytes(bytes: &[u8]) -> Result<Vec<Game>, SourceError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("games.txt");
    fs::write(&path, bytes).unwrap();
    read(&path)
}

fn told(games: &[Game]) -> Vec<String> {
    let tell = |game: &Game| {
        let plies: Vec<String> = game.plies.iter().map(|ply| ply.san.to_string()).collect();
        format!("{} {} {:?} {plies:?} {:?}", game.number, game.line, game.tags, game.problems)
    };
    games.iter().map(tell).collect()
}

#[test]
fn packed_games_are_the_same_games() {
    let text = games();
    let expected = told(&read_bytes(text.as_bytes()).unwrap());
    assert_eq!(expected.len(), 9000);
    let (first, second) = text.as_bytes().split_at(text.len() / 3);
    for (name, pack) in PACKED {
        let whole = pack(text.as_bytes());
        assert!(whole.len() < text.len() && whole.len() > 65_000, "{name}: {}", whole.len());
        assert!(told(&read_bytes(&whole).unwrap()) == expected, "{name}");
        // Two streams one after the other, the cut within a game; an empty one between.
        let parts = [pack(first), pack(b""), pack(second)].concat();
        assert!(told(&read_bytes(&parts).unwrap()) == expected, "{name}, in parts");
    }
    // Frames that are to be skipped, before and between.
    let skipped = [0x53, 0x2A, 0x4D, 0x18, 3, 0, 0, 0, 9, 9, 9];
    let parts = [&skipped[..], &zstd(first), &skipped, &zstd(second), &skipped].concat();
    assert!(told(&read_bytes(&parts).unwrap()) == expected);
}

#[test]
fn the_standard_input_is_unpacked_too() {
    for (name, pack) in PACKED {
        let mut command = Command::cargo_bin("lightsquare").unwrap();
        let packed = pack(b"\xEF\xBB\xBF[White \"a\"]\r\n\r\n1. e4 *\r\n");
        let output = command.args(["inspect", "-"]).write_stdin(packed).output().unwrap();
        let out = String::from_utf8(output.stdout).unwrap();
        assert_eq!(out, "    1  a – ?  *  1 plies\n", "{name}");
        assert_eq!(output.status.code(), Some(0));
    }
}

/// Games before the end are read; the one in hand is not whole; each says so, and the exit code is 3.
#[test]
fn a_stream_that_ends_early_is_told_behind_the_games_before() {
    let text = games();
    let expected = told(&read_bytes(text.as_bytes()).unwrap());
    for (name, pack) in PACKED {
        let whole = pack(text.as_bytes());
        for end in [whole.len() / 2, whole.len() * 9 / 10] {
            let games = read_bytes(&whole[..end]).unwrap();
            let (last, before) = games.split_last().unwrap();
            assert!(!before.is_empty() && before.len() < 9000, "{name}: {}", before.len());
            assert!(told(before) == expected[..before.len()], "{name}");
            let problem = last.problems.last().unwrap();
            let what = "is how the file is packed, and its stream ends early behind this line";
            assert_eq!((problem.token.as_str(), problem.what.as_str()), (name, what));
            assert!(!last.is_whole() && last.plies.len() <= 4);
            assert!(problem.line >= last.line);
        }
    }
}

/// What is lost may have been wanted, so it is told even where no game that is there is.
/// A frame of zstd as large as its window, of which nothing may be given away before its end; in plain blocks.
fn in_one_window(text: &[u8]) -> Vec<u8> {
    let length = u32::try_from(text.len()).unwrap();
    let mut frame = [&[0x28, 0xB5, 0x2F, 0xFD, 0xA0][..], &length.to_le_bytes()].concat();
    let blocks: Vec<&[u8]> = text.chunks(100_000).collect();
    for (index, block) in blocks.iter().enumerate() {
        let is_last = u32::from(index + 1 == blocks.len());
        let head = is_last | (block.len() as u32) << 3;
        frame.extend(&head.to_le_bytes()[..3]);
        frame.extend(*block);
    }
    frame
}

#[test]
fn what_a_cut_stream_has_given_is_read_however_large_its_window() {
    let text = games();
    let frame = in_one_window(text.as_bytes());
    assert_eq!(read_bytes(&frame).unwrap().len(), 9000);
    for share in [10, 5, 2] {
        // A whole block more or less.
        let kept = frame.len() - frame.len() / share;
        let games = read_bytes(&frame[..kept]).unwrap();
        let least = (kept - 100_000) * 9000 / frame.len() - 9;
        assert!(games.len() >= least, "{share}: {} of at least {least}", games.len());
        assert!(games.last().is_some_and(|game| !game.is_whole()));
        assert!(games[..games.len() - 1].iter().all(Game::is_whole));
    }
    // Of a frame whose checksum is cut off all is read.
    let mut checked = zstd(text.as_bytes());
    checked.truncate(checked.len() - 2);
    assert!(read_bytes(&checked).unwrap().len() >= 9000);
}

#[test]
fn a_stream_that_ends_early_is_told_whatever_is_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("games.pgn.gz");
    let whole = gzip(games().as_bytes());
    fs::write(&path, &whole[..whole.len() / 2]).unwrap();
    let by_moves = Wanted { checkmate: true, ..Wanted::default() };
    let by_tags = Wanted { tags: vec!["White=nobody".parse().unwrap()], ..Wanted::default() };
    for wanted in [by_moves, by_tags] {
        let given: Vec<Game> =
            Source::open(&path).unwrap().wanted(&wanted).collect::<Result<_, _>>().unwrap();
        assert_eq!(given.len(), 1);
        assert!(given[0].plies.is_empty() && !given[0].is_whole());
        assert!(given[0].problems.last().unwrap().what.contains("ends early"));
    }
}

#[test]
fn a_stream_that_is_damaged_is_told() {
    let text = games();
    for (name, pack) in PACKED {
        let mut bytes = pack(text.as_bytes());
        let middle = bytes.len() * 3 / 4;
        for byte in &mut bytes[middle..middle + 60] {
            *byte ^= 0x5A;
        }
        let games = read_bytes(&bytes).unwrap();
        let last = games.last().unwrap();
        assert!(!last.is_whole(), "{name}");
        let problem = last.problems.last().unwrap();
        assert!(problem.what.contains("and its stream "), "{name}: {problem}");
    }
    // What follows a stream must be one too.
    let games = read_bytes(&[&gzip(b"1. e4 *\n")[..], b"rubbish"].concat()).unwrap();
    assert_eq!((games.len(), games[0].is_whole(), games[1].is_whole()), (2, true, false));
}

#[test]
fn games_that_are_not_whole_make_the_exit_code_3() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("games.pgn.gz");
    let whole = gzip(games().as_bytes());
    fs::write(&path, &whole[..whole.len() / 2]).unwrap();
    let output = Command::cargo_bin("lightsquare").unwrap().arg("inspect").arg(&path).output();
    let output = output.unwrap();
    assert_eq!(output.status.code(), Some(3));
    let out = String::from_utf8(output.stdout).unwrap();
    assert!(out.contains("`gzip` is how the file is packed, and its stream ends early"));
    assert!(out.starts_with("    1  "));
}

#[test]
fn what_is_no_text_is_named() {
    let utf16: Vec<u8> = "\u{feff}1. e4 *".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "is empty, expected games in PGN"),
        (gzip(b""), "is empty, expected games in PGN"),
        (utf16.clone(), "is UTF-16 text, expected UTF-8 or Latin-1"),
        (zstd(&utf16), "is UTF-16 text, expected UTF-8 or Latin-1"),
        (b"1. e4\0".to_vec(), "is no text (byte 5 is 0), expected games in PGN"),
        (bzip2(b"1. e4\0"), "is no text (byte 5 is 0), expected games in PGN"),
        (zstd(&gzip(b"1. e4 *")), "is gzip packed as zstd again, expected games in PGN within"),
        (gzip(&zstd(b"1. e4 *")), "is zstd packed as gzip again, expected games in PGN within"),
        (gzip(b"PK\x03\x04zip"), "is zip packed as gzip again, expected games in PGN within"),
        (
            b"PK\x03\x04\x14\0".to_vec(),
            "is packed as zip, expected games in PGN, plain or as zstd, gzip or bzip2",
        ),
        (
            b"\xFD7zXZ\0\0\x04".to_vec(),
            "is packed as xz, expected games in PGN, plain or as zstd, gzip or bzip2",
        ),
        (
            gzip(b"1. e4 *")[..4].to_vec(),
            "the gzip stream ends early, and no game can be read before",
        ),
        (
            [0x28, 0xB5, 0x2F, 0xFD, 0x04, 0, 0, 0, 0, 0xFF].to_vec(),
            "the zstd stream ends early, and no game can be read before",
        ),
    ];
    for (bytes, expected) in cases {
        let error = read_bytes(&bytes).unwrap_err().to_string();
        assert!(error.ends_with(&format!("games.txt: {expected}")), "{error}\n{expected}");
    }
}
