//! Games that are not picked are passed over, and all others have the numbers, lines and tags that
//! they have when all are read.

use std::fs;
use std::path::{Path, PathBuf};

use lightsquare::game::{Head, Scanner, Source};
use proptest::prelude::*;

/// Number, line and tags.
type Seen = (usize, usize, Vec<(String, String)>);

/// What is asked before each game, and what games there are in the end.
fn seen(text: &[u8], mut is_wanted: impl FnMut(usize) -> bool) -> [Vec<Seen>; 2] {
    let (mut asked, mut given) = (Vec::new(), Vec::new());
    let pick = |head: &Head| {
        asked.push((head.number, head.line, head.tags.to_vec()));
        is_wanted(head.number)
    };
    for scanned in Scanner::picking(text, pick) {
        let scanned = scanned.unwrap();
        given.push((scanned.number, scanned.line, scanned.tags));
    }
    [asked, given]
}

fn texts() -> Vec<Vec<u8>> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["games", "tests/data", "../shared/games"];
    let further = ["../shared/games/classic", "../shared/games/strange"];
    let mut paths: Vec<PathBuf> = folders
        .iter()
        .chain(&further)
        .filter_map(|folder| fs::read_dir(here.join(folder)).ok())
        .flatten()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "pgn"))
        .collect();
    paths.sort();
    paths.iter().map(|path| fs::read(path).unwrap()).collect()
}

fn assert_same(text: &[u8]) {
    let expected = seen(text, |_| true);
    let given = &expected[1];
    assert!(given.iter().filter(|(number, ..)| *number > 0).eq(&expected[0]));
    for (name, wanted) in [("none", 0), ("every second", 2), ("every third", 3)] {
        let found = seen(text, |number| wanted > 0 && number % wanted == 0);
        assert_eq!(found, expected, "{name}: {}", String::from_utf8_lossy(text));
    }
}

#[test]
fn real_files_are_cut_alike() {
    let texts = texts();
    assert!(texts.len() > 20);
    texts.iter().for_each(|text| assert_same(text));
}

/// A piece of a real file, with some places changed.
fn changed() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop::sample::select(vec![
        "{",
        "}",
        "(",
        ")",
        "[",
        "]",
        "\n",
        "\n\n",
        "\"",
        "1.",
        "1. ",
        "1-0 ",
        "*",
        "<",
        ";",
        "%",
        "[Event \"x\"]\n",
        "\n%",
        " ",
        "$1",
        "N",
        "--",
        "e4 ",
        "\\",
        "\r",
        "\u{feff}",
        " 1/2 ",
        "12 ",
        "...",
        "\u{1a}",
        "é",
        "[FEN \"x\n",
        "Sf3 ",
    ]);
    let place = any::<prop::sample::Index>();
    let changes = prop::collection::vec((place, 0_usize..20, piece), 0..12);
    (prop::sample::select(texts()), any::<prop::sample::Index>(), changes).prop_map(
        |(text, start, changes)| {
            let start = start.index(text.len());
            let mut text = text[start..text.len().min(start + 4000)].to_vec();
            for (at, length, piece) in changes {
                let at = at.index(text.len().max(1)).min(text.len());
                let end = (at + length).min(text.len());
                text.splice(at..end, piece.bytes());
            }
            text
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]
    #[test]
    fn changed_files_are_cut_alike(text in changed()) {
        assert_same(&text);
    }
}

#[test]
fn a_source_gives_the_games_that_are_picked_by_their_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("games.pgn");
    let text = "prose\n\n[White \"a\"]\n\n1. e4 {x *\n\n[White \"b\"]\n\n1. Xx *\n\n1. d4 *\n\n[White \"c\"]\n";
    fs::write(&path, text).unwrap();
    let picked = |wanted: &[usize]| {
        let pick = |head: &Head| wanted.contains(&head.number);
        let mut games = Source::open(&path).unwrap().games_where(pick);
        let found: Vec<String> = games
            .by_ref()
            .map(|game| game.unwrap())
            .map(|game| {
                format!(
                    "{} {} {}",
                    game.number,
                    game.player(shakmaty::Color::White),
                    game.plies.len()
                )
            })
            .collect();
        (found, games.seen())
    };
    assert_eq!(picked(&[]), (vec![], 4));
    assert_eq!(picked(&[3]), (vec!["3 ? 1".to_owned()], 4));
    let all = ["1 a 1", "2 b 0", "3 ? 1", "4 c 0"].map(str::to_owned);
    assert_eq!(picked(&[1, 2, 3, 4]), (all.into(), 4));
}
