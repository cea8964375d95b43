//! What comments, glyphs and variations say: every case is a text and what must come of it.

use lightsquare::game::{Eval, Game, Scanner, Variation};
use lightsquare::notation::Color;

fn read(text: &str) -> Game {
    let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
    Game::read(scanned, 1)
}

/// What is said of each position from the start on, as `--notes` writes it.
fn told(game: &Game) -> Vec<String> {
    (0..=game.plies.len())
        .map(|ply| {
            let notes = game.notes(ply);
            let times = [("clk", notes.clock), ("emt", notes.elapsed)];
            let times = times.iter().filter_map(|(name, s)| s.map(|s| format!("{name} {s}")));
            let eval = notes.eval.map(|eval| match eval {
                Eval::Pawns(pawns) => format!("eval {pawns}"),
                Eval::Mate(moves) => format!("eval #{moves}"),
            });
            let circles = notes.circles.iter().map(ToString::to_string);
            let arrows = notes.arrows.iter().map(ToString::to_string);
            let glyphs = notes.glyphs.iter().map(|nag| format!("${nag}"));
            let said = times.chain(eval).chain(circles).chain(arrows).chain(glyphs);
            said.collect::<Vec<_>>().join(" ")
        })
        .collect()
}

#[test]
fn a_comment_belongs_to_the_position_that_it_stands_behind() {
    let cases: &[(&str, &[&str])] = &[
        ("[Event \"x\"]\n\n{[%csl Gd5]} 1. e4 e5 *", &["Gd5", "", ""]),
        ("1. e4 {[%clk 0:09:59]} e5 {[%clk 0:10:00]} *", &["", "clk 599", "clk 600"]),
        // Several comments a move, in braces and to the end of the line, over two lines.
        ("1. e4 {[%clk 0:01:00]} {[%eval 0.2]} e5 *", &["", "clk 60 eval 0.2", ""]),
        ("1. e4 ; [%emt 0:00:09]\ne5 *", &["", "emt 9", ""]),
        ("1. e4 {[%cal Ge2e4,\nRd1d8] a [%csl Ba1]} e5 *", &["", "Ba1 Ge2e4 Rd1d8", ""]),
        // The first of a kind counts.
        ("1. e4 {[%clk 0:01:00][%clk 0:00:59]} *", &["", "clk 60"]),
        // A comment longer than any buffer.
        (&format!("1. e4 {{{}[%clk 0:01:00]}} e5 *", "x".repeat(20_000)), &["", "clk 60", ""]),
        // Before a number, behind a variation, within one, behind the result.
        ("1. e4 1... {[%eval 1]} e5 *", &["", "eval 1", ""]),
        ("1. e4 (1. d4) {[%eval 1]} e5 *", &["", "eval 1", ""]),
        ("1. e4 (1. d4 {[%eval 1]} $1) e5 *", &["", "", ""]),
        ("1. e4 ({[%eval 1]} 1. d4) e5 *", &["", "", ""]),
        ("1. e4 e5 1-0 {[%eval #1]}", &["", "", "eval #1"]),
        // Texts that are no commands.
        ("1. e4 {clk 0:01:00 [eval 1] [%] [%clk} *", &["", ""]),
    ];
    for (text, expected) in cases {
        assert_eq!(told(&read(text)), *expected, "{text:?}");
    }
}

#[test]
fn glyphs_belong_to_the_move_before_them() {
    let cases: &[(&str, &[&str])] = &[
        ("1. e4! e5?? 2. Nf3!? Nc6?! *", &["", "$1", "$4", "$5", "$6"]),
        ("1. e4 $1 e5$2 2. Nf3 $146 $14 *", &["", "$1", "$2", "$146 $14"]),
        ("1. e4! $1 $0 e5 +- 2. Nf3 ± Nc6 -/+ *", &["", "$1", "$18", "$16", "$17"]),
        (
            "1. e4= e5+- 2. Nf3!?∓ Nc6∞ 3. Bb5⩲ a6⩱ *",
            &["", "$10", "$18", "$5 $17", "$13", "$14", "$15"],
        ),
        (
            "1. e4 e5 2. Qh5 Nc6 3. Bc4 Nf6 4. Qxf7#!! $255 1-0",
            &["", "", "", "", "", "", "", "$3 $255"],
        ),
    ];
    for (text, expected) in cases {
        let game = read(text);
        assert_eq!(told(&game), *expected, "{text:?}");
        assert_eq!(game.problems, [], "{text:?}");
    }
    assert_eq!(read("1. e4 e5 2. Nf3!! $18 *").notes(3).move_glyph(), Some("!!"));
    assert_eq!(read("1. e4 e5 2. Nf3!! $18 *").notes(3).position_glyph(), Some("+−"));
}

#[test]
fn what_cannot_be_read_is_a_remark() {
    let cases = [
        ("1. e4\n{a\n[%clk 1-2]} *", "line 3: `[%clk 1-2]` is no time"),
        ("1. e4 {[%emt]} *", "line 1: `[%emt]` is no time"),
        ("1. e4 {[%eval good]} *", "line 1: `[%eval good]` is no evaluation"),
        ("1. e4 {[%csl Gd5,Xd5]} *", "line 1: `Xd5` is no mark"),
        ("1. e4 {[%cal Ge2e2]} *", "line 1: `Ge2e2` goes from a square to itself"),
        ("1. e4 $256 *", "line 1: `$256` is no glyph, expected $1 to $255"),
    ];
    for (text, problem) in cases {
        let game = read(text);
        assert_eq!(game.problems.len(), 1, "{text:?}: {:?}", game.problems);
        assert!(game.problems[0].to_string().starts_with(problem), "{:?}", game.problems);
        assert!(game.is_whole(), "{text:?}");
    }
    for unknown in ["[%tqu \"x\"]", "[%evp 0,31]", "[%mdl 4]", "[%CSL Xx]"] {
        assert_eq!(read(&format!("1. e4 {{{unknown}}} *")).problems, [], "{unknown}");
    }
    // Said of a variation, it stays there.
    let game = read("1. e4 (1. d4 {[%clk x]} d5) e5 *");
    assert_eq!((game.problems.len(), game.variations[0].problems.len()), (0, 1));
}

/// A variation in one line: where it begins, its moves, and those within it.
fn written(variation: &Variation) -> String {
    let moves: Vec<String> = variation.plies.iter().map(|ply| ply.san.to_string()).collect();
    let within: Vec<String> = variation.variations.iter().map(written).collect();
    let problems: String = variation.problems.iter().map(|p| format!(" | {p}")).collect();
    let within =
        if within.is_empty() { String::new() } else { format!(" ({})", within.join("; ")) };
    format!("{} {}{within}{problems}", variation.ply, moves.join(" "))
}

#[test]
fn variations_are_played_from_the_move_that_they_replace() {
    let cases: &[(&str, &[&str])] = &[
        ("1. e4 e5 2. Nf3 (2. f4 exf4) (2. Nc3) Nc6 *", &["2 f4 exf4", "2 Nc3"]),
        (
            "1. e4 (1. d4 d5 2. c4 (2. Nf3 Nf6 (2... e6)) 2... e6) e5 *",
            &["0 d4 d5 c4 e6 (2 Nf3 Nf6 (3 e6))"],
        ),
        ("1. e4 e5 (1... c5 {a} 2. Nf3! $14 (2. c3) d6) 2. Nf3 *", &["1 c5 Nf3 d6 (2 c3)"]),
        ("1. e4 e5 1-0 (1... c5 *)", &["1 c5"]),
        // Numbered as the main line is.
        (
            "[FEN \"rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR w KQkq - 0 1\"]\n\n23. e4 (23. d4 d5 24. c4) e5 *",
            &["0 d4 d5 c4"],
        ),
        // As strict as the main line: cut where a move cannot be played, or may be missing.
        ("1. e4 (1. d4 d5 2. Qxh7 e6) e5 *", &["0 d4 d5 | line 1: `Qxh7` is no legal move"]),
        ("1. e4 (1. d4 d5 3. c4) e5 *", &["0  | line 1: `c4` is numbered 3, expected 2"]),
        ("1. e4 e5 (2. Nf3) 2. d4 *", &["1  | line 1: `Nf3` is numbered 2, expected 1"]),
        (
            "1. e4 (1. d4 -- 2. c4) e5 *",
            &["0 d4 | line 1: `--` is a null move, which no position can show"],
        ),
        (
            "1. e4 (1. d4 N f6) e5 *",
            &[
                "0 d4 | line 1: `N` is no move | line 1: `f6` follows the letter N, which may be its piece",
            ],
        ),
        ("1. e4 (1. d4 - d5) e5 *", &["0 d4 | line 1: `-` is no move"]),
        ("1. e4 (1. d4 ... 2. c4) e5 *", &["0  | line 1: `c4` is numbered 2, expected 1"]),
        (
            "1. e4 1... (e5) e6 *",
            &["0  | line 1: `(` opens a variation between a number and its move"],
        ),
        (
            "1. e4 ((1. d4) d5) e5 *",
            &[
                "0  | line 1: `(` opens a variation before any move | line 1: `(` opens a variation behind the last good move; it is left out",
            ],
        ),
        // Nothing in it, or not closed: where it ends is not known.
        ("1. e4 () ({but}) ( ; so\n ) e5 *", &[]),
        ("1. e4 (1. d4 (1. c4) 1... e5 2. Nf3 *", &[]),
    ];
    for (text, expected) in cases {
        let game = read(text);
        let variations: Vec<String> = game.variations.iter().map(written).collect();
        assert_eq!(variations, *expected, "{text:?}");
    }
}

/// A bracket in a variation that may hide moves ends it, those around it, and the game.
#[test]
fn what_hides_moves_in_a_variation_ends_all_lines() {
    for hides in ["[2. Nf3 Nc6]", "<2. Nf3>", "{a {b}", "\n[FEN x y]\n"] {
        let text = format!("1. e4 (1. d4 (1. c4 c5 {hides} Nc3) d5) e5 *");
        let game = read(&text);
        let outer = &game.variations[0];
        let inner = &outer.variations[0];
        let shown = [game.plies.len(), outer.plies.len(), inner.plies.len()];
        assert_eq!(shown, [1, 1, 2], "{text:?}");
        for problems in [&game.problems, &outer.problems, &inner.problems] {
            assert!(problems.iter().any(|problem| problem.loses_moves), "{text:?}");
        }
    }
}

#[test]
fn variations_behind_the_last_good_move_are_left_out_with_a_word() {
    let game = read("1. e4 e5 (1... c5) 2. Qxh7\n(2. Nf3) (2. d4) Nc6 *");
    assert_eq!(game.variations.len(), 1);
    let last = game.problems.last().unwrap();
    assert_eq!(
        last.to_string(),
        "line 2: `(` opens the first of 2 variations behind the last good move; they are left out"
    );
    assert!(!last.loses_moves);
}

#[test]
fn deep_nesting_is_bounded_and_harms_nothing() {
    let deep = 200_000;
    let text = format!("1. e4 {}{} e5 *", "(1. d4 ".repeat(deep), ")".repeat(deep));
    let game = read(&text);
    assert_eq!((game.plies.len(), game.is_whole()), (2, true));
    let branches: Vec<_> = game.branches().collect();
    assert_eq!(branches.len(), 32);
    let innermost = game.variation(&branches[31].path).unwrap();
    assert_eq!(innermost.problems.len(), 1);
    assert!(innermost.problems[0].what.contains("too deep"));
}

#[test]
fn branches_have_names_fit_for_folders() {
    let game = read(
        "1. e4 (1. d4 d5 (1... Nf6 2. c4) (1... d6)) (1. d4 c5) (1. Qxh7) e5 2. Nf3 Nc6 3. Bc4 Bc5 \
         4. O-O (4. c3 Nf6 5. d4 exd4) Nf6 (4... Qf6) *",
    );
    let branches: Vec<(Vec<usize>, String)> =
        game.branches().map(|branch| (branch.path, branch.names.join("/"))).collect();
    let expected = [
        (vec![0], "1w-d4"),
        (vec![1], "1w-d4-2"),
        (vec![3], "4w-c3"),
        (vec![4], "4b-qf6"),
        (vec![0, 0], "1w-d4/1b-nf6"),
        (vec![0, 1], "1w-d4/1b-d6"),
    ];
    assert_eq!(branches, expected.map(|(path, name)| (path, name.to_owned())));
}

#[test]
fn a_variation_is_a_game_of_its_own() {
    let game = read(
        "[White \"a\"]\n\n{[%csl Gd5]} 1. e4 {[%clk 0:01:00]} e5 (1... c5 2. Nf3 (2. c3 d5 $1 x) d6) \
         2. d4 1-0",
    );
    let moves = |path: &[usize]| {
        let game = game.with_variation(path).unwrap();
        let moves: Vec<String> = game.plies.iter().map(|ply| ply.san.to_string()).collect();
        (moves.join(" "), game.is_whole(), game.variations.len())
    };
    assert_eq!(moves(&[]), ("e4 e5 d4".to_owned(), true, 1));
    assert_eq!(moves(&[0]), ("e4 c5 Nf3 d6".to_owned(), true, 1));
    assert_eq!(moves(&[0, 0]), ("e4 c5 c3 d5".to_owned(), false, 0));
    assert!(game.with_variation(&[1]).is_none() && game.with_variation(&[0, 1]).is_none());
    let branch = game.with_variation(&[0, 0]).unwrap();
    assert_eq!(branch.fen(4), "rnbqkbnr/pp2pppp/8/2pp4/4P3/2P5/PP1P1PPP/RNBQKBNR w KQkq - 0 3");
    assert_eq!(told(&branch), ["Gd5", "clk 60", "", "", "$1"]);
    assert_eq!((branch.result.as_str(), branch.player(Color::White)), ("*", "a"));
}

/// What each move took, and what was left at the end to White and to Black.
fn times(tags: &str, moves: &str) -> (Vec<Option<f64>>, [Option<f64>; 2]) {
    let game = read(&format!("{tags}\n\n{moves}"));
    let clocks = game.clocks();
    let thought = (1..=game.plies.len()).map(|ply| clocks.thought(ply)).collect();
    (thought, clocks.left(game.plies.len()))
}

#[test]
fn moves_take_what_the_clocks_say() {
    let s = Some;
    let clk = "1. e4 {[%clk 0:09:58]} e5 {[%clk 0:10:01.5]} 2. d4 {[%clk 0:09:58]} *";
    let control = |control: &str| format!("[TimeControl \"{control}\"]");
    let minute = [s(598.0), s(601.5)];
    type Seconds = Option<f64>;
    let cases: &[(&str, &str, &[Seconds], [Seconds; 2])] = &[
        (&control("600+5"), clk, &[s(7.0), s(3.5), s(5.0)], minute),
        // A clock cannot go up without an increment.
        (&control("600"), clk, &[s(2.0), None, s(0.0)], minute),
        // Without a control the start is not known; the increment is not, where a clock goes up.
        ("[Event \"x\"]", clk, &[None, None, s(0.0)], minute),
        (
            &control("?"),
            "1. e4 {[%clk 0:10:00]} e5 2. d4 {[%clk 0:09:00]} *",
            &[None, None, s(60.0)],
            [s(540.0), None],
        ),
        (
            &control("-"),
            "1. e4 {[%clk 0:10:00]} e5 2. d4 {[%clk 0:10:05]} *",
            &[None, None, None],
            [s(605.0), None],
        ),
        // By the time that moves took, too.
        (
            &control("60+1"),
            "1. e4 {[%emt 0:00:11]} e5 {[%emt 0:00:70]} *",
            &[s(11.0), s(70.0)],
            [s(50.0), s(0.0)],
        ),
        (&control("60"), "1. e4 {[%clk 0:00:50] [%emt 0:00:09]} *", &[s(9.0)], [s(50.0), s(60.0)]),
        // Where nothing is said nothing is known.
        (&control("60"), "1. e4 e5 2. d4 *", &[None, None, None], [None, None]),
        // A first move before which no time runs, and whole seconds.
        (
            &control("60+2"),
            "1. e4 {[%clk 0:01:00]} e5 {[%clk 0:00:59]} *",
            &[None, s(3.0)],
            [s(60.0), s(59.0)],
        ),
        (
            &control("60"),
            "1. e4 {[%clk 0:00:50]} e5 2. d4 {[%clk 0:00:51]} *",
            &[s(10.0), None, s(0.0)],
            [s(51.0), None],
        ),
        // Half the time by choice, as on lichess; elsewhere it was spent.
        (
            &format!("{}[Site \"https://lichess.org/x\"]", control("60+2")),
            "1. e4 {[%clk 0:00:30]} e5 2. d4 {[%clk 0:00:29]} *",
            &[s(0.0), None, s(1.0)],
            [s(29.0), None],
        ),
        (
            &control("60+2"),
            "1. e4 {[%clk 0:00:30]} e5 2. d4 {[%clk 0:00:29]} *",
            &[s(32.0), None, s(3.0)],
            [s(29.0), None],
        ),
        // Periods: the time is added when the moves are made, or when it is used up.
        (
            &control("2/60:30"),
            "1. e4 {[%clk 0:00:20]} e5 {[%clk 0:00:10]} 2. d4 {[%clk 0:00:40]} d5 {[%clk 0:00:05]} 3. c4 {[%clk 0:00:35]} c5 {[%clk 0:00:25]} *",
            &[s(40.0), s(50.0), s(10.0), s(5.0), s(5.0), s(10.0)],
            [s(35.0), s(25.0)],
        ),
        (
            &control("1/60"),
            "1. e4 {[%clk 0:01:50]} e5 2. d4 {[%clk 0:02:00]} *",
            &[s(10.0), None, s(50.0)],
            [s(120.0), None],
        ),
    ];
    for (tags, moves, thought, left) in cases {
        assert_eq!(times(tags, moves), (thought.to_vec(), *left), "{tags} {moves}");
    }
}

#[test]
fn players_begin_with_what_the_time_control_gives() {
    let cases = [
        ("600+5", Some(600.0)),
        ("40/7200:20/3600:900+30", Some(7200.0)),
        ("10+0.05", Some(10.0)),
        ("*180", None),
        ("-", None),
        ("?", None),
        ("5 minutes", None),
        ("0/60", None),
        ("60:x", None),
    ];
    for (control, start) in cases {
        let clocks = read(&format!("[TimeControl \"{control}\"]\n\n1. e4 *")).clocks();
        assert_eq!(clocks.left(0), [start; 2], "{control}");
        assert!(!clocks.is_known(), "{control}");
    }
}

#[test]
fn a_flag_falls_where_time_ends_the_game() {
    let cases = [
        ("Time forfeit", "1-0", Some(Color::Black)),
        ("White won on time", "1-0", Some(Color::Black)),
        ("time forfeit", "0-1", Some(Color::White)),
        ("Time forfeit", "1/2-1/2", None),
        ("Normal", "1-0", None),
        ("sometimes", "1-0", None),
    ];
    for (termination, result, flag) in cases {
        let text = |moves: &str| format!("[Termination \"{termination}\"]\n\n{moves} {result}");
        let clocks = read(&text("1. e4 {[%clk 0:00:09]} e5 {[%clk 0:00:05]}")).clocks();
        assert_eq!(clocks.flag(), flag, "{termination} {result}");
        let left = |color: Color, seconds| if flag == Some(color) { 0.0 } else { seconds };
        assert_eq!(
            clocks.left(2),
            [Some(left(Color::White, 9.0)), Some(left(Color::Black, 5.0))],
            "{termination} {result}"
        );
        assert_eq!(clocks.left(1), [Some(9.0), None], "{termination} {result}");
        // The end of a game that is not whole is not shown.
        assert_eq!(read(&text("1. e4 e5 2. Qxh7")).clocks().flag(), None);
    }
}

/// Whatever stands there: no panic, every branch can be followed, and no time is negative.
#[test]
fn rubbish_is_survived() {
    use proptest::prelude::*;
    let words = prop::sample::select(vec![
        "(",
        ")",
        "(1. d4 ",
        "1. e4 ",
        "e5 ",
        "2. Nf3 ",
        "Nf6 ",
        "$1 ",
        "$999 ",
        "!? ",
        "± ",
        "{",
        "}",
        "{[%clk 0:00:0",
        "9]} ",
        "[%clk ",
        "[%emt 0:00:05]",
        "[%eval #-",
        "[%csl Gd5,",
        "]",
        "; ",
        "\n",
        "1-0 ",
        "* ",
        "-- ",
        "é",
        "[TimeControl \"1/2:3+4\"]\n",
        "[Termination \"time\"]\n",
    ]);
    proptest!(|(parts in prop::collection::vec(words, 0..60))| {
        let text = parts.concat();
        for scanned in Scanner::new(text.as_bytes()) {
            let game = Game::read(scanned.unwrap(), 1);
            for branch in game.branches() {
                let variation = game.variation(&branch.path).unwrap();
                let line = game.with_variation(&branch.path).unwrap();
                prop_assert_eq!(line.plies.len(), variation.ply + variation.plies.len());
            }
            let clocks = game.clocks();
            for ply in 0..=game.plies.len() {
                let times = clocks.left(ply).into_iter().chain([clocks.thought(ply)]).flatten();
                prop_assert!(times.into_iter().all(|seconds| seconds >= 0.0 && seconds.is_finite()));
            }
        }
    });
}
