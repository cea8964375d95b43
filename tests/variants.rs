//! Games by other rules than standard chess: how they start, what their moves do, how they end.

mod seen;

use std::path::Path;

use glam::DVec3;
use lightsquare::assets::{Assets, SetName};
use lightsquare::config::{Config, Orientation, VIEWS};
use lightsquare::game::{Ending, Game, Scanner};
use lightsquare::notation::{Color, Placement, Role, Square};
use lightsquare::scene::{Reach, Stage};
use lightsquare::timeline::{Frame, Mover, Script, Timeline};
use shakmaty::perft;

/// A game of that variant, from `fen` unless it is empty.
fn read(variant: &str, fen: &str, moves: &str) -> Game {
    let fen = if fen.is_empty() { String::new() } else { format!("[FEN \"{fen}\"]\n") };
    let text = format!("[Variant \"{variant}\"]\n{fen}\n{moves} *");
    let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
    Game::read(scanned, 1)
}

fn whole(variant: &str, fen: &str, moves: &str) -> Game {
    let game = read(variant, fen, moves);
    assert_eq!(game.problems, [], "{variant}, {fen}: {moves}");
    game
}

#[test]
fn each_variant_starts_as_its_rules_say() {
    let pieces = "rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR";
    let cases = [
        ("standard", format!("{pieces} w KQkq - 0 1")),
        ("atomic", format!("{pieces} w KQkq - 0 1")),
        ("King of the Hill", format!("{pieces} w KQkq - 0 1")),
        ("Antichess", format!("{pieces} w - - 0 1")),
        ("crazyhouse", format!("{pieces}[] w KQkq - 0 1")),
        ("3check", format!("{pieces} w KQkq - 3+3 0 1")),
        ("Racing Kings", "8/8/8/8/8/8/krbnNBRK/qrbnNBRQ w - - 0 1".to_owned()),
        (
            "Horde",
            "rnbqkbnr/pppppppp/8/1PP2PP1/PPPPPPPP/PPPPPPPP/PPPPPPPP/PPPPPPPP w kq - 0 1".to_owned(),
        ),
    ];
    for (variant, fen) in cases {
        assert_eq!(whole(variant, "", "").fen(0), fen, "{variant}");
    }
}

#[test]
fn fens_of_variants_are_read_in_all_their_forms() {
    let cases = [
        ("zh", "4k3/8/8/8/8/8/8/4K3[QNpp] w - - 0 1", "4k3/8/8/8/8/8/8/4K3[NQpp] w - - 0 1"),
        ("zh", "4k3/8/8/8/8/8/8/4K3/QNpp w - - 0 1", "4k3/8/8/8/8/8/8/4K3[NQpp] w - - 0 1"),
        ("zh", "4k3/1Q~6/8/8/8/8/8/4K3/ b - - 0 1", "4k3/1Q~6/8/8/8/8/8/4K3[] b - - 0 1"),
        // Nobody says the variant but the FEN.
        ("", "4k3/8/8/8/8/8/8/4K3[Q] w - - 0 1", "4k3/8/8/8/8/8/8/4K3[Q] w - - 0 1"),
        ("3check", "4k3/8/8/8/8/8/8/R3K3 w - - 2+3 0 1", "4k3/8/8/8/8/8/8/R3K3 w - - 2+3 0 1"),
        // Checks that were given, not those that are left.
        ("3check", "4k3/8/8/8/8/8/8/R3K3 w - - 0 1 +1+0", "4k3/8/8/8/8/8/8/R3K3 w - - 2+3 0 1"),
        ("3check", "4k3/8/8/8/8/8/8/R3K3 w - - 0 1", "4k3/8/8/8/8/8/8/R3K3 w - - 3+3 0 1"),
    ];
    for (variant, fen, expected) in cases {
        assert_eq!(whole(variant, fen, "").fen(0), expected, "{variant}, {fen}");
    }
}

#[test]
fn moves_do_what_the_rules_say() {
    let cases = [
        // What is captured is dropped.
        (
            "crazyhouse",
            "",
            "1. e4 d5 2. exd5 Qxd5 3. @e6 P@d4 4. Nf3",
            "rnb1kbnr/ppp1pppp/4P3/3q4/3p4/5N2/PPPP1PPP/RNBQKB1R[] b KQkq - 1 4",
        ),
        // What was a pawn is one again.
        (
            "crazyhouse",
            "r3k3/1P6/8/8/8/8/8/4K3[] w - - 0 1",
            "1. b8=Q+ Rxb8",
            "1r2k3/8/8/8/8/8/8/4K3[p] w - - 0 2",
        ),
        (
            "atomic",
            "",
            "1. Nf3 d5 2. Ne5 e6 3. Nxf7",
            "rnbq3r/ppp3pp/4p3/3p4/8/8/PPPPPPPP/RNBQKB1R b KQ - 0 3",
        ),
        (
            "antichess",
            "8/1P6/8/8/8/8/7p/8 w - - 0 1",
            "1. b8=K h1=K",
            "1K6/8/8/8/8/8/8/7k w - - 0 2",
        ),
        (
            "3check",
            "",
            "1. e4 f6 2. Qh5+",
            "rnbqkbnr/ppppp1pp/5p2/7Q/4P3/8/PPPP1PPP/RNB1KBNR b KQkq - 2+3 1 2",
        ),
        // The king goes to g1, though the move names the rook.
        (
            "crazyhouse960",
            "1rk5/8/8/8/8/8/8/1RK5[] w Bb - 0 1",
            "1. O-O-O",
            "1rk5/8/8/8/8/8/8/2KR4[] b q - 1 1",
        ),
    ];
    for (variant, fen, moves, expected) in cases {
        let game = whole(variant, fen, moves);
        assert_eq!(game.fen(game.plies.len()), expected, "{variant}, {fen}: {moves}");
    }
}

#[test]
fn moves_that_only_other_rules_allow_are_refused() {
    for (variant, moves, token) in [
        ("standard", "1. e4 e5 2. N@f3", "N@f3"),
        ("crazyhouse", "1. e4 e5 2. N@f3", "N@f3"),
        ("antichess", "1. e4 d5 2. Nf3", "Nf3"),
        ("racing kings", "1. Kh3 Ka3 2. Qb1+", "Qb1+"),
    ] {
        let game = read(variant, "", moves);
        assert!(!game.is_whole());
        let found: Vec<&str> = game.problems.iter().map(|problem| problem.token.as_str()).collect();
        assert_eq!(found, [token], "{variant}: {moves}");
    }
}

#[test]
fn games_of_unknown_variants_are_skipped_with_a_sentence() {
    for (variant, part) in [("suicide", "`antichess`"), ("atomik", "did you mean `atomic`?")] {
        let game = read(variant, "", "1. e4");
        assert!(!game.start_is_known && game.plies.is_empty());
        let said = game.problems[0].to_string();
        assert!(said.contains(variant) && said.contains(part), "{said}");
    }
}

#[test]
fn variants_end_by_their_own_rules() {
    let cases = [
        ("atomic", "", "1. Nf3 a6 2. Ne5 a5 3. Nxf7", Ending::Explosion, Color::White),
        (
            "antichess",
            "8/8/8/8/8/8/1p6/K7 w - - 0 1",
            "1. Kxb2",
            Ending::NothingToMove,
            Color::Black,
        ),
        (
            "3check",
            "4k3/8/8/8/8/8/8/R3K3 w - - 1+3 0 1",
            "1. Ra8+",
            Ending::ThirdCheck,
            Color::White,
        ),
        ("koth", "4k3/8/8/8/8/3K4/8/8 w - - 0 1", "1. Kd4", Ending::Hill, Color::White),
        ("racing kings", "8/7K/8/8/8/8/k7/8 w - - 0 1", "1. Kh8", Ending::Goal, Color::White),
        (
            "horde",
            "4k3/8/8/8/8/8/3p4/4P3 b - - 0 1",
            "1... dxe1=Q",
            Ending::HordeTaken,
            Color::Black,
        ),
        ("crazyhouse", "", "1. f3 e5 2. g4 Qh4#", Ending::Checkmate, Color::Black),
    ];
    for (variant, fen, moves, ending, winner) in cases {
        let game = whole(variant, fen, moves);
        assert_eq!(game.ending(), Some(ending), "{variant}, {fen}: {moves}");
        assert_eq!(game.winner(), Some(winner), "{variant}, {fen}: {moves}");
    }
    let both = whole("race", "8/k6K/8/8/8/8/8/8 w - - 0 1", "1. Kh8 Ka8");
    assert_eq!((both.ending(), both.winner()), (Some(Ending::BothAtGoal), None));
    assert_eq!(whole("race", "8/k6K/8/8/8/8/8/8 w - - 0 1", "1. Kh8").ending(), None);
}

fn at_the_end(game: &Game) -> Frame {
    let plies = game.plies.len();
    Timeline::new(game, plies, plies, &Script::default()).unwrap().frame(0)
}

#[test]
fn a_check_is_marked_where_the_rules_know_one_and_mate_where_it_is_one() {
    let cases = [
        ("3check", "4k3/8/8/8/8/8/8/R3K3 w - - 1+3 0 1", "1. Ra8+", Some(Square::E8), false),
        ("crazyhouse", "", "1. f3 e5 2. g4 Qh4#", Some(Square::E1), true),
        ("antichess", "4k3/8/8/8/8/8/8/R3K3 w - - 0 1", "1. Ra8", None, false),
        ("atomic", "", "1. Nf3 a6 2. Ne5 a5 3. Nxf7", None, false),
    ];
    for (variant, fen, moves, check, is_mate) in cases {
        let marks = at_the_end(&whole(variant, fen, moves)).marks;
        assert_eq!((marks.check, marks.is_mate), (check, is_mate), "{variant}: {moves}");
    }
}

/// The blocks of a file of perft positions: FENs, and how many sequences of so many moves there are.
fn blocks(text: &str) -> Vec<(String, Vec<(u32, u64)>)> {
    let mut blocks: Vec<(String, Vec<(u32, u64)>)> = Vec::new();
    for line in text.lines() {
        if let Some(epd) = line.strip_prefix("epd ") {
            blocks.push((epd.to_owned(), Vec::new()));
        } else if let Some(counts) = line.strip_prefix("perft ") {
            let mut numbers = counts.split_whitespace();
            let depth = numbers.next().unwrap().parse().unwrap();
            let nodes = numbers.next().unwrap().parse().unwrap();
            blocks.last_mut().unwrap().1.push((depth, nodes));
        }
    }
    blocks
}

/// More moves are not counted.
const MOST_NODES: u64 = 2_000;

#[test]
fn positions_of_the_collection_have_all_their_moves() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/games/positions");
    if !folder.is_dir() {
        eprintln!("skipped: there is no folder {}", folder.display());
        return;
    }
    let mut files = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "perft") {
            continue;
        }
        let variant = path.file_stem().unwrap().to_str().unwrap();
        let variant = if variant == "tricky" { "standard" } else { variant };
        let mut counted = 0;
        for (fen, counts) in blocks(&std::fs::read_to_string(&path).unwrap()) {
            let game = whole(variant, &fen, "");
            let position = game.position(0).unwrap();
            assert_eq!(game.placement(0), Placement::from_fen(&fen).unwrap(), "{variant}: {fen}");
            for (depth, nodes) in counts.into_iter().filter(|(_, nodes)| *nodes < MOST_NODES) {
                assert_eq!(perft(&position, depth), nodes, "{variant}, {fen}: {depth} moves");
                counted += 1;
            }
        }
        assert!(counted > 0, "{}", path.display());
        files += 1;
    }
    assert_eq!(files, 8);
}

/// All in hand, and as many pawns as nobody has in a game.
const FULL: &str = "4k3/8/8/8/8/8/8/4K3[QRRBBNNPPPPPPPPPPPPPPPPqrrbbnnpppp] w - - 0 1";

#[test]
fn what_is_in_hand_stands_beside_the_board_in_its_owners_colour() {
    let mut config = Config { width: 300, height: 200, ..Config::default() };
    for (name, view) in VIEWS {
        // Those that show all of the board.
        if !["white", "black", "top", "above", "side", "player"].contains(&name) {
            continue;
        }
        for orientation in [Orientation::White, Orientation::Black] {
            (config.camera.view, config.camera.orientation) = (view, orientation);
            let assets = Assets::load(&config, &SetName::Staunton).unwrap();
            let stage = Stage::new(&config, &assets, Reach::default()).unwrap();
            let bodies = stage.bodies();
            let frame = Frame::of_fen(Placement::from_fen(FULL).unwrap(), FULL, bodies);
            let of =
                |color| frame.taken.iter().filter(move |held: &&Mover| held.piece.color == color);
            assert_eq!(Color::ALL.map(|color| of(color).count()), [23, 11]);
            assert!(of(Color::White).all(|held| held.spot.file > 3.5 + bodies.edge));
            assert!(of(Color::Black).all(|held| held.spot.file < 3.5 - bodies.edge));
            let camera = stage.scene(&frame).camera;
            for (index, held) in frame.taken.iter().enumerate() {
                for other in &frame.taken[index + 1..] {
                    let gap = bodies.of(held.piece.role).gap(
                        held.spot,
                        bodies.of(other.piece.role),
                        other.spot,
                    );
                    assert!(gap > 0.0, "{held:?}, {other:?}");
                }
                let foot = DVec3::new(held.spot.file, held.spot.height, held.spot.rank) * 4.0;
                let top = foot + DVec3::Y * bodies.of(held.piece.role).height() * 4.0;
                for point in [foot, top] {
                    let beyond = seen::beyond(&camera, point, 1.5);
                    assert!(beyond < 1.0, "{name}, {orientation:?}: {held:?}: {beyond}");
                }
            }
        }
    }
}

#[test]
fn what_is_captured_goes_into_the_hand_of_who_took_it_and_comes_from_there() {
    let frame = |moves: &str| at_the_end(&whole("crazyhouse", "", moves));
    let held = |frame: &Frame| {
        let one = |held: &Mover| (held.piece.color, held.piece.role, held.identity);
        frame.taken.iter().map(one).collect::<Vec<_>>()
    };
    let captured = frame("1. e4 d5 2. exd5 Qxd5");
    let pawns = [(Color::White, Role::Pawn, Square::D7), (Color::Black, Role::Pawn, Square::E2)];
    assert_eq!(held(&captured), pawns);
    // It is the same piece, and it leaves the hand for the board.
    let dropped = frame("1. e4 d5 2. exd5 Qxd5 3. @e6");
    assert_eq!(held(&dropped), pawns[1..]);
    assert_eq!(dropped.identities.get(Square::E6), Square::D7);
    // There is as much room beside the board before anything is in hand.
    assert_eq!((frame("").columns, captured.columns), (1, 1));
}
