//! How text becomes games: every case is a text and what must come of it.

use lightsquare::game::{Game, Scanner};

fn read(text: &str) -> Vec<Game> {
    read_bytes(text.as_bytes())
}

fn read_bytes(bytes: &[u8]) -> Vec<Game> {
    Scanner::new(bytes).map(|scanned| Game::read(scanned.unwrap(), 1)).collect()
}

/// A game in one line: its moves, its result, and its problems.
fn told(game: &Game) -> String {
    let moves: Vec<String> = game.plies.iter().map(|ply| ply.san.to_string()).collect();
    let problems: String = game.problems.iter().map(|problem| format!(" | {problem}")).collect();
    format!("{} {}{problems}", moves.join(" "), game.result)
}

fn assert_told(text: &str, expected: &[&str]) {
    let told: Vec<String> = read(text).iter().map(told).collect();
    assert_eq!(told, expected, "{text:?}");
}

#[test]
fn games_end_where_the_next_one_begins_and_nowhere_else() {
    let cases: &[(&str, &[&str])] = &[
        // A blank line within the moves, after a comment, within the tags.
        ("[Event \"x\"]\n\n1. e4\n\ne5 *", &["e4 e5 *"]),
        ("[Event \"x\"]\n\n1. e4 {c}\n\n1... e5 *", &["e4 e5 *"]),
        ("[Event \"x\"]\n\n[Site \"y\"]\n\n1. e4 *", &["e4 *"]),
        // A tag section after moves, with no result before it.
        ("[Event \"a\"]\n1. e4\n[Event \"b\"]\n1. d4", &["e4 *", "d4 *"]),
        // Games without moves.
        ("[Event \"a\"]\n\n[Event \"b\"]\n\n1. d4", &[" *", "d4 *"]),
        ("[Event \"a\"]\n[Result \"1-0\"]\n\n1-0\n\n[Event \"b\"]\n\n*", &[" 1-0", " *"]),
        // Several on a line, without tags, without numbers.
        ("1. e4 e5 * 1. d4 d5 1-0 1. c4 0-1", &["e4 e5 *", "d4 d5 1-0", "c4 0-1"]),
        ("e4 e5 *\nd4 d5 1-0\n", &["e4 e5 *", "d4 d5 1-0"]),
        ("e4 * Nf3 *", &["e4 *", " * | line 1: `Nf3` goes on behind a result"]),
        ("[Result \"1-0\"] e4 *\n[Result \"0-1\"] d4 0-1", &["e4 *", "d4 0-1"]),
        // What follows the result belongs to the game that it ends.
        ("1. e4 1-0 {resigns} (1. d4)\n", &["e4 1-0"]),
        // Nothing at all.
        ("", &[]),
        ("\n\n * \n", &[]),
    ];
    for (text, expected) in cases {
        assert_told(text, expected);
    }
}

#[test]
fn line_ends_and_encodings_do_not_matter() {
    let text = "\u{feff}[White \"Réti\"]\n\n; note\n1. e4\n% escape\ne5 {x\ny} 2. Nf3 *\n";
    let plain = read(text);
    for other in [text.replace('\n', "\r\n"), text.replace('\n', "\r")] {
        let games = read(&other);
        assert_eq!(told(&games[0]), told(&plain[0]));
        assert_eq!(games[0].tags, plain[0].tags);
    }
    let latin1: Vec<u8> = text.chars().skip(1).map(|c| u8::try_from(c).unwrap()).collect();
    assert_eq!(read_bytes(&latin1)[0].tags, plain[0].tags);
    assert_eq!(told(&plain[0]), "e4 e5 Nf3 *");
}

#[test]
fn what_cannot_be_read_is_told_with_its_line_and_token() {
    let cases: &[(&str, &[&str])] = &[
        ("1. e4 e5\n2. Qxh7 Nc6 *", &["e4 e5 * | line 2: `Qxh7` is no legal move"]),
        ("1. e4 e5 2. Xyz *", &["e4 e5 * | line 1: `Xyz` is no move"]),
        ("1. Nf3 d5 2. Nc3 d4 3. Nd2 *", &["Nf3 d5 Nc3 d4 * | line 1: `Nd2` is no legal move"]),
        (
            "1. Nf3 d5 2. d3 e5 3. Nd2 *",
            &["Nf3 d5 d3 e5 * | line 1: `Nd2` can be more than one legal move"],
        ),
        ("1. e4 -- 2. d4 *", &["e4 * | line 1: `--` is a null move, which no position can show"]),
        ("1. e4 Z0 2. d4 *", &["e4 * | line 1: `Z0` is a null move, which no position can show"]),
        ("1. e4 {a\nb", &["e4 * | line 1: `{` opens a comment that is never closed"]),
        ("1. e4 (1. d4\n2. c4 *", &["e4 * | line 1: `(` opens a variation that is never closed"]),
        ("1. e4 ) 1... e5 *", &["e4 * | line 1: `)` closes nothing"]),
        // Lost moves before, so the position is not known.
        (
            "1-0\n2. Nf3 Nc6 *",
            &[" * | line 2: `Nf3` goes on with a game whose beginning is not known"],
        ),
        (
            "1. e4 1-0 2. Nf3 *",
            &["e4 1-0", " * | line 1: `Nf3` goes on with a game whose beginning is not known"],
        ),
    ];
    for (text, expected) in cases {
        assert_told(text, expected);
    }
}

/// Whatever may hide a move ends the game there: no position is shown that it may not have had.
#[test]
fn a_game_stops_where_a_move_may_be_missing() {
    let cases = [
        // Numbers that do not fit.
        ("1. e4 e5 3. Bc4 Nf6 *", ""),
        ("1. e4 e5 2. Nf3 3. Nc3 *", "e4 e5"),
        // Of these two moves one is missing, and d5 may be Black's.
        ("1. e4 e5 2. d4 3. d5 *", "e4 e5"),
        ("1. d4 2. d5 *", ""),
        ("1. d4 12 2. d5 *", "d4"),
        ("1. d4 (null) 2. d5 *", ""),
        ("1. e4 e5 2... Nf3 *", ""),
        ("1. e4 e5 2. Nf3 Nc6 3. Bc4 Bc5 4. 0 - 0 Nd4 *", "e4 e5 Nf3 Nc6 Bc4 Bc5"),
        ("e4 e5 17. Bb5 a6 *", ""),
        ("1. e4 Nc6 3. Bb5 a6 *", ""),
        ("1. e4 e5 2. Nf3 d6 4. Ba4 *", "e4 e5"),
        ("1. e4 e5 1. Nf3 Nc6 3. Bb5 *", ""),
        // Castling in two pieces.
        ("1. Nf3 Nf6 2. g3 g6 3. Bg2 Bg7 4. O-O O-O -O *", "Nf3 Nf6 g3 g6 Bg2 Bg7 O-O"),
        // Escapes and commands that are none.
        ("1. e4 e5\n % 2. Nf3 Nc6\nBc4 *", "e4 e5"),
        ("1. e4 e5 [%x Nf3 Nc6] Bc4 *", "e4 e5"),
        ("[Event \"x\"]\n\n{intro 1. e4 e5 *", ""),
        // A move that is not there, or said not to be made.
        ("1. d4 ... 2. d5 *", ""),
        ("1. d4 — d5 *", "d4"),
        ("1. d4 - d5 *", "d4"),
        ("1. d4 _ d5 *", "d4"),
        ("1. d4 0000 2. d5 *", "d4"),
        ("1. d4 @@@@ 2. d5 *", "d4"),
        ("1. d4 –– 2. d5 *", "d4"),
        // A piece that is torn from its square.
        ("1. e4 e5 2. N f3 d6 *", "e4 e5"),
        ("1. e4 e5 2. Nf3 N c6 *", "e4 e5 Nf3"),
        ("1. e4 e5 2. Nf3 N{x}c6 *", "e4 e5 Nf3"),
        ("1. e4 e5 2. Nf3 N\nc6 *", "e4 e5 Nf3"),
        ("1. e4 e5 2. B c4 *", "e4 e5"),
        ("1. e4 e5 2. ♘ f3 *", "e4 e5"),
        ("1. e4 e5 2. К f3 *", "e4 e5"),
        ("1. e4 e5 2. \u{fffd} f3 *", "e4 e5"),
        ("1. e4 e5 2. -f3 *", "e4 e5"),
        ("1. e4 e5 2. ]f3 *", "e4 e5"),
        ("1. e4 e5 2. Q]h3 *", "e4 e5"),
        ("1. e4 e5 2. N$g6 *", "e4 e5"),
        ("1. e4 e 2. e5 d6 *", "e4"),
        // A part of a move.
        ("1. e4 d5 2. xd5 *", "e4 d5"),
        ("1. aa3 *", ""),
        ("1. e4 e5 2. B1c3 *", "e4 e5"),
        // Brackets that may hold moves.
        ("1. e4 e5 [2. Nf3 Nc6\n3. Bc4 Nf6 *", "e4 e5"),
        ("1. e4 e5\n[2. Nf3 Nc6\n3. Bc4 Nf6 *", "e4 e5"),
        ("1. e4 e5 [2. Nf3 Nc6] 3. Bc4 Nf6 *", "e4 e5"),
        ("1. e4 e5 <2. Nf3 Nc6\n3. Bc4 Nf6 *", "e4 e5"),
        ("1. e4 e5 <2. Nf3 Nc6> Bc4 Nf6 *", "e4 e5"),
        ("1. e4 \u{1b}[2J e5 *", "e4"),
        // Braces and brackets that do not close, or close nothing.
        ("1. e4 {best 1... e5 2. Nf3 {good} Nc6 2. d4 *", "e4"),
        ("1. e4 {a {b} e5} *", "e4"),
        ("1. e4 } 1... e5 *", "e4"),
        ("(1. d4) 1. e4 *", ""),
        ("(FEN \"4k3/8/8/8/8/8/4P3/4K3 w - - 0 1\") 1. e4 *", ""),
        ("1. e4 e5 2. N?f3 d6 *", "e4 e5"),
    ];
    for (text, moves) in cases {
        let game = &read(text)[0];
        let shown: Vec<String> = game.plies.iter().map(|ply| ply.san.to_string()).collect();
        assert_eq!(shown.join(" "), moves, "{text:?}: {:?}", game.problems);
        assert!(!game.is_whole(), "{text:?}");
    }
}

#[test]
fn harmless_things_stop_nothing() {
    let cases = [
        "1. e4 [%clk 0:01:00] e5 2. Nf3 *",
        "1. e4\n[%eval 0.3]\ne5 2. Nf3 *",
        "1. e4 [#] e5 2. Nf3 *",
        "1. e4 1... e5 2. Nf3 *",
        "1. e4 ... e5 2. Nf3 *",
        "1 e4 e5 2 Nf3 *",
        "1 . e4 e5 2 . Nf3 *",
        "1. e4 e5 2. Nf3 N *",
        "1. e4 D e5 2. Nf3 *",
        "1. e4 N e5 2. Nf3 *",
        "1. e4+- e5!?± 2. Nf3= *",
        "1. e4 e5 2. Nf3 *\n\u{1a}",
        "1. e4 e5 2. Nf3 1-0 White resigns\n",
        "1.\u{a0}e4 e5\u{a0}2.\u{a0}Nf3 *",
        "1. e4 e5 2. Nf3*",
    ];
    for text in cases {
        let game = &read(text)[0];
        let moves: Vec<String> = game.plies.iter().map(|ply| ply.san.to_string()).collect();
        assert_eq!(moves.join(" "), "e4 e5 Nf3", "{text:?}");
        assert!(game.is_whole() && read(text).len() == 1, "{text:?}: {:?}", game.problems);
    }
}

#[test]
fn moves_that_are_numbered_from_one_again_are_another_game() {
    assert_told("1. e4 e5\n\n1. Nf3 Nc6\n", &["e4 e5 *", "Nf3 Nc6 *"]);
    assert_told("[Event \"a\"]\n\n1. e4 e5\n\n1. d4 d5 *", &["e4 e5 *", "d4 d5 *"]);
    assert_told(
        "12. Nf3 Nc6 *",
        &[" * | line 1: `Nf3` goes on with a game whose beginning is not known"],
    );
    let fen = "[FEN \"rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR w KQkq - 0 1\"]\n\n";
    assert_told(&format!("{fen}23. e4 e5 24. Nf3 *"), &["e4 e5 Nf3 *"]);
    assert_told(
        &format!("{fen}23. e4 e5 25. Nf3 *"),
        &[" * | line 3: `Nf3` is numbered 25, expected 24"],
    );
}

#[test]
fn an_unclosed_comment_does_not_swallow_the_next_game() {
    assert_told(
        "[Event \"a\"]\n\n1. e4 {never\nclosed *\n\n[Event \"b\"]\n\n1. d4 *\n",
        &["e4 * | line 3: `{` opens a comment that is never closed", "d4 *"],
    );
    assert_told(
        "[White \"a\"]\n\n1. e4 {never\n[White \"b\"]\n\n1. d4 d5 *\n",
        &["e4 * | line 3: `{` opens a comment that is never closed", "d4 d5 *"],
    );
    // Behind a result it hides nothing.
    assert_told(
        "[White \"a\"]\n\n1. e4 1-0 {never\n[White \"b\"]\n\n1. d4 *\n",
        &["e4 1-0 | line 3: `{` opens a comment that is never closed", "d4 *"],
    );
    assert!(read("[White \"a\"]\n\n1. e4 1-0 {never\n[White \"b\"]\n\n1. d4 *\n")[0].is_whole());
    // Before the first game, too.
    assert_told(
        "{ never\n\n[Event \"a\"]\n\n1. e4 *\n\n[Event \"b\"]\n\n1. d4 *\n",
        &["e4 * | line 1: `{` opens a comment that is never closed", "d4 *"],
    );
}

#[test]
fn an_unreadable_tag_is_reported_and_ends_nothing() {
    let games = read("[Event \"a\"]\n[White \"\"Mephisto\"\"]\n[Black \"b\"]\n\n1. e4 *\n");
    assert_eq!(games.len(), 1);
    assert_eq!(
        told(&games[0]),
        "e4 * | line 2: `[White \"\"Mephisto\"\"]` is no tag, expected [Name \"Value\"]"
    );
    assert_eq!(games[0].tag("Black"), Some("b"));
    assert!(games[0].is_whole());
    // After moves it belongs to the game that its section begins.
    let games = read("1. e4 *\n[White \"\"M\"\"]\n[Black \"b\"]\n\n1. d4 *\n");
    assert_eq!(games.len(), 2);
    assert_eq!(games[0].problems, []);
    assert_eq!(games[1].problems.len(), 1);
    assert_eq!(games[1].line, 2);
}

#[test]
fn an_unreadable_start_is_never_taken_for_the_usual_one() {
    // The tag belongs to the game that follows it, with a result before it or without.
    for result in ["*", ""] {
        let games = read(&format!("1. e4 {result}\n[FEN \"x\" y]\n[White \"b\"]\n\n1. d4 *\n"));
        assert_eq!(told(&games[0]), "e4 *");
        assert!(!games[1].start_is_known && games[1].plies.is_empty());
    }
    let games = read("1. e4 *\n[FEN \"x\" y]\n\n1. d4 *\n");
    assert!(games[0].is_whole() && !games[1].start_is_known);
    // Without a tag that can be read, the game before cannot go on past it.
    let games = read("1. e4\n[FEN \"x\" y]\n\n1... d5 *\n");
    assert_eq!((games.len(), games[0].plies.len(), games[0].is_whole()), (1, 1, false));
}

#[test]
fn no_position_is_shown_where_the_start_is_not_known() {
    let cases = [
        "[FEN \"8/8/8/8/8/8/8/8 w\" - -]\n\n1. e4 *",
        "[FEN \"rubbish\"]\n\n1. e4 *",
        "[SetUp \"1\"]\n\n1. e4 *",
        "[FEN: \"4k3/8/8/8/8/8/4P3/4K3 w - - 0 1\"]\n\n1. e4 *",
        "[\"FEN\" \"4k3/8/8/8/8/8/4P3/4K3 w - - 0 1\"]\n\n1. e4 *",
        "[F\u{415}N \"4k3/8/8/8/8/8/4P3/4K3 w - - 0 1\"]\n\n1. e4 *",
        "[FEN \"4k3/8/8/8/8/8/4P3/4K3 w - - 0 1\"]\n[FEN \"4k3/8/8/8/8/8/3P4/4K3 w - - 0 1\"]\n\n1. e4 *",
        "[FEN=\"4k3/8/8/8/8/8/4P3/4K3 w - - 0 1\"]\n\n1. e4 *",
        "[Variant \"Chess960\"]\n\n1. e4 *",
        "[Variant \"Suicide\"]\n\n1. e4 *",
    ];
    for text in cases {
        let game = &read(text)[0];
        assert!(!game.start_is_known, "{text}");
        assert!(!game.is_whole(), "{text}");
        assert_eq!(game.plies.len(), 0, "{text}");
    }
}

#[test]
fn tags_are_read_as_they_are_written() {
    let cases = [
        ("[Event \"a ] b\"]", ("Event", "a ] b")),
        ("[Event \"C:\\temp\"]", ("Event", "C:\\temp")),
        ("[Event \"two\nlines\"]", ("Event", "two lines")),
        ("[Event \"x\\\\\"] ", ("Event", "x\\")),
        ("[Event  \"say \\\"hi\\\" \\\\ \" ]", ("Event", "say \"hi\" \\ ")),
        ("  [ Event \"x\"]", ("Event", "x")),
        ("[Event\"x\"]", ("Event", "x")),
        ("[Event \"x\"", ("Event", "x")),
        ("[Event \"a\u{1b}[31m\"]", ("Event", "a [31m")),
    ];
    for (text, (name, value)) in cases {
        let games = read(&format!("{text}\n\n1. e4 *"));
        assert_eq!(games[0].tags, [(name.to_owned(), value.to_owned())], "{text}");
        assert_eq!(told(&games[0]), "e4 *", "{text}");
    }
}

#[test]
fn glyphs_numbers_and_symbols_are_no_moves() {
    assert_told(
        "1.e4! $1 e5?? 2 . Nf3 !? 2...Nc6 +- 3.Bb5$2 ± a6 = 4. O-O$10 *",
        &["e4 e5 Nf3 Nc6 Bb5 a6 O-O *"],
    );
    assert_told("1. e4 e5 2. Nf3 N Nc6 *", &["e4 e5 Nf3 Nc6 * | line 1: `N` is no move"]);
    assert_told("1. e4<br>e5 *", &["e4 e5 * | line 1: `<br>` is no move"]);
}

#[test]
fn one_game_in_many_notations_has_the_same_moves() {
    let expected = "e4 d5 e5 f5 exf6 Nh6 fxg7 Nc6 gxh8=Q Be6 Nf3 Qd7 Be2 O-O-O O-O";
    let games = [
        "1. e4 d5 2. e5 f5 3. exf6 Nh6 4. fxg7 Nc6 5. gxh8=Q Be6 6. Nf3 Qd7 7. Be2 O-O-O 8. O-O *",
        "1.e4 d5 2.e5 f5 3.exf6ep Nh6 4.fxg7 Nc6 5.gxh8Q Be6 6.Nf3 Qd7 7.Be2 0-0-0 8.0-0 *",
        "1. e2-e4 d7-d5 2. e4-e5 f7-f5 3. e5xf6 e.p. Ng8-h6 4. f6xg7 Nb8-c6 5. g7xh8=Q Bc8-e6 \
         6. Ng1-f3 Qd8-d7 7. Bf1-e2 o-o-o 8. o-o *",
        "e2e4 d7d5 e4e5 f7f5 e5f6 g8h6 f6g7 b8c6 g7h8q c8e6 g1f3 d8d7 f1e2 e8c8 e1g1 *",
        "1. e4 d5 2. e5 f5 3. exf6 Nh6 4. fxg7 Nc6 5. gxh8=Q Be6 6. Nf3 Qd7 7. Be2 O‑O‑O 8. O–O *",
    ];
    for text in games {
        let games = read(text);
        assert_eq!(told(&games[0]), format!("{expected} *"), "{text}");
    }
}

/// Whatever the bytes: no panic, no endless loop, and every game's moves are legal.
#[test]
fn rubbish_is_survived() {
    use proptest::prelude::*;
    let words = prop::sample::select(vec![
        "[Event \"a\"]",
        "[",
        "]",
        "{",
        "}",
        "(",
        ")",
        ";",
        "%",
        "\n",
        "\r",
        " ",
        "\"",
        "\\",
        "1.",
        "e4",
        "e5",
        "Nf3",
        "1-0",
        "*",
        "$",
        "$1",
        "--",
        "O-O",
        "<",
        ">",
        "[FEN \"8/8/8/8/8/8/8/K1k5 w - - 0 1\"]",
        "\u{feff}",
        "é",
        "a8=Q",
        "\0",
        "0-0",
        "½",
        "…",
    ]);
    proptest!(|(parts in prop::collection::vec(words, 0..60))| {
        let text = parts.concat();
        let games = read(&text);
        prop_assert!(games.len() <= parts.len() + 1);
    });
    proptest!(|(bytes in prop::collection::vec(any::<u8>(), 0..200))| {
        read_bytes(&bytes);
    });
}
