//! The games of `games/`, held against what is known of them; and, where it is there, the larger
//! collection beside the repository.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use lightsquare::game::{Game, Source};
use shakmaty::{Color, Move, Position, Role};

fn here(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The collection's folder, where it is there.
fn collection() -> Option<PathBuf> {
    let folder = here("../shared/games");
    if !folder.is_dir() {
        eprintln!("skipped: there is no folder {}", folder.display());
        return None;
    }
    Some(folder)
}

fn read(path: &Path) -> Vec<Game> {
    Source::open(path).unwrap().games().collect::<Result<_, _>>().unwrap()
}

/// What a game has to show, in the words of the table.
fn shows(game: &Game) -> BTreeSet<&'static str> {
    let mut found = BTreeSet::new();
    for (index, ply) in game.plies.iter().enumerate() {
        let color = if (index % 2 == 0) == (game.start.turn == Color::White) {
            Color::White
        } else {
            Color::Black
        };
        match ply.played {
            Move::Castle { king, rook } => {
                found.insert(match (color, rook > king) {
                    (Color::White, true) => "castle-white-short",
                    (Color::White, false) => "castle-white-long",
                    (Color::Black, true) => "castle-black-short",
                    (Color::Black, false) => "castle-black-long",
                });
            }
            Move::EnPassant { .. } => {
                found.insert("en-passant");
            }
            Move::Normal { promotion: Some(role), .. } => {
                found.insert("promotion");
                if role != Role::Queen {
                    found.insert("under-promotion");
                }
            }
            _ => {}
        }
    }
    if game.tag("FEN").is_some() {
        found.insert("fen-start");
    }
    if game.tag("Variant") == Some("Chess960") {
        found.insert("chess960");
    }
    if game.plies.last().is_some_and(|ply| ply.after.is_checkmate()) {
        found.insert("mate");
    }
    found
}

#[test]
fn every_game_is_what_it_is_known_to_be() {
    let mut files: BTreeSet<String> = std::fs::read_dir(here("games"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".pgn"))
        .collect();
    let mut all_shown = BTreeSet::new();
    for row in include_str!("data/games.tsv").lines().skip(1) {
        let [file, plies, result, final_fen, shown] = row.split('\t').collect::<Vec<_>>()[..]
        else {
            panic!("not a row: {row}");
        };
        assert!(files.remove(file), "{file} is not in games/");
        let games = read(&here("games").join(file));
        assert_eq!(games.len(), 1, "{file}");
        let game = &games[0];
        assert_eq!(game.problems, [], "{file}");
        assert_eq!(game.plies.len().to_string(), plies, "{file}");
        assert_eq!(game.result, result, "{file}");
        assert_eq!(game.fen(game.plies.len()), final_fen, "{file}");
        let shown: BTreeSet<&str> = shown.split(',').filter(|word| !word.is_empty()).collect();
        assert_eq!(shows(game), shown, "{file}");
        let roster: Vec<&str> = game.tags.iter().take(7).map(|(name, _)| name.as_str()).collect();
        assert_eq!(
            roster,
            ["Event", "Site", "Date", "Round", "White", "Black", "Result"],
            "{file}"
        );
        assert_eq!(game.tag("Result"), Some(result), "{file}");
        all_shown.extend(shown);
    }
    assert_eq!(files, BTreeSet::new(), "files without a row");
    assert_eq!(all_shown.len(), 10, "{all_shown:?}");
}

#[test]
fn the_collection_beside_the_repository_is_read_whole() {
    let Some(folder) = collection() else {
        return;
    };
    let cases = [
        ("lichess_db_1000k.pgn", 438, 28_538),
        ("twic1599_1000k.pgn", 1110, 101_487),
        ("Morphy_ANSI.pgn", 211, 13_835),
        ("Morphy_UTF8.pgn", 211, 13_835),
        ("linares_2002.pgn", 42, 3063),
        ("lichess-study-checkmate-puzzles.pgn", 27, 86),
        ("chess960rwch.pgn", 20, 1692),
        ("zh.pgn", 83, 4794),
        ("atomic.pgn", 10, 331),
        ("classic/antichess-programfox.pgn", 2, 126),
        ("classic/knightvuillaume-jannlee-zh-lichess.pgn", 1, 48),
        ("classic/saturs-jannlee-zh-lichess.pgn", 1, 122),
        ("classic/chessbase-empty-line.pgn", 1, 134),
        ("classic/cutechess-fischerrandom.pgn", 4, 396),
        ("classic/uci-moves.pgn", 1, 113),
        ("strange/chessjs-0.pgn", 1, 77),
        ("strange/pgnextract-test-promotion-in.pgn", 8, 8),
        ("strange/pgnextract-test-fuzzydepth.pgn", 4, 20),
        ("strange/pgnextract-test-nobadresults.pgn", 9, 9),
    ];
    for (file, games, plies) in cases {
        let read = read(&folder.join(file));
        assert_eq!(read.len(), games, "{file}");
        assert_eq!(read.iter().map(|game| game.plies.len()).sum::<usize>(), plies, "{file}");
        assert!(read.iter().all(Game::is_whole), "{file}");
    }
}

#[test]
fn the_same_games_with_and_without_a_bom_are_the_same() {
    let Some(folder) = collection() else {
        return;
    };
    let [ansi, utf8] = ["Morphy_ANSI.pgn", "Morphy_UTF8.pgn"].map(|file| read(&folder.join(file)));
    for (a, b) in ansi.iter().zip(&utf8) {
        assert_eq!((a.line, &a.tags, &a.result), (b.line, &b.tags, &b.result));
        let fens =
            |game: &Game| (0..=game.plies.len()).map(|ply| game.fen(ply)).collect::<Vec<_>>();
        assert_eq!(fens(a), fens(b));
    }
}
