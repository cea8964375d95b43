//! The ways in which files write moves.

use std::fs;
use std::path::{Path, PathBuf};

use lightsquare::game::{Game, Letters, Ply, Scanner, Source};
use shakmaty::{Color, Move, Position, Role};

fn read(text: &str, letters: Letters) -> Vec<Game> {
    let game = |scanned: std::io::Result<_>| Game::read_in(scanned.unwrap(), 1, letters);
    Scanner::new(text.as_bytes()).map(game).collect()
}

fn read_one(text: &str) -> Game {
    let mut games = read(text, Letters::Auto);
    assert_eq!(games.len(), 1, "{text}");
    games.remove(0)
}

fn moves(game: &Game) -> String {
    let moves: Vec<String> = game.plies.iter().map(|ply| ply.san.to_string()).collect();
    moves.join(" ")
}

/// The games of the repository, each with its tags as they are written.
fn games() -> Vec<(PathBuf, String, Game)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("games");
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let game = |path: PathBuf| {
        let game = Source::open(&path).unwrap().games().next().unwrap().unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let tags = text.lines().take_while(|line| line.starts_with('['));
        (path, tags.map(|line| format!("{line}\n")).collect(), game)
    };
    paths
        .into_iter()
        .filter(|path| path.extension().is_some_and(|e| e == "pgn"))
        .map(game)
        .collect()
}

/// A move in the letters of a language: of king, queen, rook, bishop and knight.
fn in_letters(ply: &Ply, letters: [&str; 5]) -> String {
    let san = ply.san.to_string();
    san.chars()
        .map(|c| match "KQRBN".find(c) {
            Some(index) => letters[index].to_owned(),
            None => c.to_string(),
        })
        .collect()
}

fn long(ply: &Ply) -> String {
    let castles = matches!(ply.played, Move::Castle { .. });
    if castles {
        return ply.san.to_string();
    }
    let (from, to) = (ply.played.from().unwrap(), ply.played.to());
    let role = ply.played.role();
    let piece = if role == Role::Pawn { String::new() } else { role.upper_char().to_string() };
    let dash = if ply.played.is_capture() { "x" } else { "-" };
    let promotion = ply.played.promotion().map(|role| role.upper_char().to_string());
    format!("{piece}{from}{dash}{to}{}", promotion.unwrap_or_default())
}

/// King and rook for castling in Chess960, else where the king goes.
fn uci(ply: &Ply) -> String {
    ply.played.to_uci(shakmaty::CastlingMode::Chess960).to_string()
}

/// As someone types who is in a hurry.
fn sloppy(ply: &Ply) -> String {
    let san = ply.san.to_string();
    let bare = san.trim_end_matches(['+', '#']).replace(['x', '='], "").replace("O-O", "0-0");
    let bare = bare.replace("0-0-O", "0-0-0");
    if matches!(ply.played, Move::EnPassant { .. }) { format!("{bare}ep") } else { bare }
}

type Writes = fn(&Ply) -> String;

const NOTATIONS: [(&str, Writes); 9] = [
    ("short", |ply| ply.san.to_string()),
    ("long", long),
    ("uci", uci),
    ("German", |ply| in_letters(ply, ["K", "D", "T", "L", "S"])),
    ("Czech", |ply| in_letters(ply, ["K", "D", "V", "S", "J"])),
    ("French", |ply| in_letters(ply, ["R", "D", "T", "F", "C"])),
    ("Russian", |ply| in_letters(ply, ["Кр", "Ф", "Л", "С", "К"])),
    ("figurines", |ply| match ply.mover() {
        Color::White => in_letters(ply, ["♔", "♕", "♖", "♗", "♘"]),
        Color::Black => in_letters(ply, ["♚", "♛", "♜", "♝", "♞"]),
    }),
    ("sloppy", sloppy),
];

#[test]
fn every_game_in_nine_notations_has_the_same_moves() {
    for (path, tags, game) in games() {
        let expected: Vec<String> = game.plies.iter().map(|ply| ply.san.to_string()).collect();
        for (notation, write) in NOTATIONS {
            let moves: String = game.plies.iter().map(|ply| format!("{}\n", write(ply))).collect();
            let found = read_one(&format!("{tags}\n{moves}{}\n", game.result));
            let name = format!("{}, {notation}", path.display());
            let found_moves: Vec<String> =
                found.plies.iter().map(|ply| ply.san.to_string()).collect();
            assert_eq!(found_moves, expected, "{name}: {:?}", found.problems);
            assert!(found.is_whole(), "{name}");
            let last = game.plies.len();
            assert_eq!(found.fen(last), game.fen(last), "{name}");
            if notation.starts_with(|c: char| c.is_uppercase()) && moves.contains(['D', 'Ф']) {
                assert_eq!(found.problems.len(), 1, "{name}: {:?}", found.problems);
            }
        }
    }
}

#[test]
fn letters_are_those_of_one_language_that_fits_all_of_the_game() {
    let cases = [
        // German, and what has the same moves.
        ("1. e4 e5 2. Sf3 Sc6 3. Lb5 a6 *", "e4 e5 Nf3 Nc6 Bb5 a6", true),
        ("1. d4 d5 2. c4 e6 3. Pc3 Pf6 *", "d4 d5 c4 e6 Nc3 Nf6", true),
        ("1. e4 e5 2. Cf3 Cc6 3. Ab5 *", "e4 e5 Nf3 Nc6 Bb5", true),
        ("1. e4 e5 2. Jf3 Jc6 3. Sb5 *", "e4 e5 Nf3 Nc6 Bb5", true),
        // A knight in German, a bishop in Czech.
        ("1. e4 e5 2. Se2 *", "e4 e5", false),
        // A pawn that is named, and a Dutch knight.
        ("1. Pe4 Pe5 2. Pf4 *", "e4 e5 f4", true),
        ("1. e4 e5 2. Pf3 *", "e4 e5", false),
        // Two languages in one game.
        ("1. e4 e5 2. Nf3 Sc6 *", "e4 e5 Nf3", false),
        ("1. e4 e5 2. Sf3 Nc6 *", "e4 e5", false),
        // One move of the game cannot be played.
        ("1. e4 e5 2. Sf3 Sc6 3. Lb6 *", "e4 e5", false),
        // English, with a mistake.
        ("1. e4 e5 2. Nf3 Nc6 3. Bb6 *", "e4 e5 Nf3 Nc6", false),
        // Figurines belong to all.
        ("1. e4 e5 2. ♘f3 Sc6 *", "e4 e5 Nf3 Nc6", true),
    ];
    for (text, expected, is_whole) in cases {
        let game = read_one(text);
        assert_eq!(moves(&game), expected, "{text}: {:?}", game.problems);
        assert_eq!(game.is_whole(), is_whole, "{text}");
    }
    let told = |game: &Game| game.problems.iter().map(|p| p.to_string()).collect::<Vec<_>>();
    assert_eq!(
        told(&read_one("1. e4 e5 2. Sf3 (2. Lc4 Lc5) Sc6 3. Lb5 *")),
        ["line 1: `Sf3` and the other moves have German (K D T L S) letters"]
    );
}

#[test]
fn letters_that_are_named_are_the_only_ones() {
    let read = |text: &str, letters: &str| moves(&read(text, letters.parse().unwrap())[0]);
    assert_eq!(read("1. e4 e5 2. Se2 *", "german"), "e4 e5 Ne2");
    assert_eq!(read("1. e4 e5 2. Se2 *", "czech"), "e4 e5 Be2");
    assert_eq!(read("1. e4 e5 2. Sf3 *", "english"), "e4 e5");
    assert_eq!(read("1. e4 e5 2. Nf3 *", "german"), "e4 e5");
    // A German pawn is no bishop, nor is a French king a rook.
    assert_eq!(read("1. e4 e5 2. Bc4 *", "german"), "e4 e5");
    assert_eq!(read("1. e4 e5 2. Re2 Dh4 *", "french"), "e4 e5 Ke2 Qh4");
}

#[test]
fn moves_are_read_as_files_write_them_or_not_at_all() {
    let promotion = |text: &str| {
        let fen = "[FEN \"2r1k3/1P6/8/8/8/8/8/4K3 w - - 0 1\"]";
        moves(&read_one(&format!("{fen}\n\n1. {text} *")))
    };
    for text in ["b8=Q", "b8Q", "b8(Q)", "b8=(Q)", "b8/Q", "b8=q", "b7b8q", "b7-b8Q", "b8=♕"] {
        assert_eq!(promotion(text), "b8=Q", "{text}");
    }
    for text in ["bxc8=Q+", "bc8Q", "b7xc8(Q)+", "b7:c8Q", "b7c8q", "bc8=Q#"] {
        assert_eq!(promotion(text), "bxc8=Q+", "{text}");
    }
    // What it becomes is not said, or where it goes.
    for text in ["b8", "b8=", "b8=K", "b8()", "bc", "bxc", "xc8=Q", "bxc8"] {
        assert_eq!(promotion(text), "", "{text}");
    }
    let capture = |text: &str| moves(&read_one(&format!("1. e4 d5 2. Nc3 Nf6 3. {text} *")));
    for text in ["exd5", "ed5", "ed", "exd", "e:d5", "e4xd5", "e4d5", "e4-d5", "ed5:", "♙exd5"] {
        assert_eq!(capture(text), "e4 d5 Nc3 Nf6 exd5", "{text}");
    }
    for text in ["Nxd5", "Nd5", "N:d5", "Nd5:", "Nc3xd5", "Nc3-d5", "Nc3d5", "c3d5"] {
        assert_eq!(capture(text), "e4 d5 Nc3 Nf6 Nxd5", "{text}");
    }
    for text in ["xd5", "d5", "x", "fe", "ef", "exf6", "Nxb5", "Nxe4"] {
        assert_eq!(capture(text), "e4 d5 Nc3 Nf6", "{text}");
    }
    // Of two pawns that can, none does.
    let two = "[FEN \"4k3/8/8/3p1p2/4P3/8/8/4K3 w - - 0 1\"]\n\n1. ";
    assert_eq!(moves(&read_one(&format!("{two}ed *"))), "exd5");
    let twice = "[FEN \"4k3/8/3p4/4P3/3p4/4P3/8/4K3 w - - 0 1\"]\n\n1. ";
    assert_eq!(moves(&read_one(&format!("{twice}ed *"))), "");
    let castling = "1. e4 e5 2. Nf3 Nf6 3. Bc4 Bc5 4. ";
    for text in ["O-O", "0-0", "o-o", "O‑O", "O–O", "0—0", "OO", "e1g1", "e1h1", "O-O+", "e1-g1"]
    {
        let game = read_one(&format!("{castling}{text} *"));
        assert_eq!(moves(&game), "e4 e5 Nf3 Nf6 Bc4 Bc5 O-O", "{text}");
    }
    for text in ["--", "Z0", "0000", "@@@@", "null", "pass"] {
        let game = read_one(&format!("{castling}{text} d6 *"));
        let problem = format!("line 1: `{text}` is a null move, which no position can show");
        assert_eq!(game.problems.last().map(|p| p.to_string()), Some(problem), "{text}");
        assert_eq!(game.plies.len(), 6);
    }
}

/// In Chess960 the king that goes to the square of its rook castles.
#[test]
fn castling_by_the_square_of_the_rook_is_read() {
    let fen = "[Variant \"Chess960\"]\n[FEN \"1k5r/8/8/8/8/8/8/RK4R1 w AG - 0 1\"]\n\n1. ";
    for (text, san) in [("b1g1", "O-O"), ("b1a1", "O-O-O"), ("b1c1", "Kc1")] {
        assert_eq!(moves(&read_one(&format!("{fen}{text} *"))), san, "{text}");
    }
    assert!(
        read_one(&format!("{fen}b1g1 *")).plies[0].after.board().king_of(Color::White).is_some()
    );
}
