//! What pictures of a game say: from its tags, moves and notes to a caption's content.

use super::wording;
use crate::caption::{Card, Content, Gauge, Player};
use crate::config::Captions;
use crate::game::{Eval, Game};
use crate::notation::Color;
use crate::timeline::{self, Dials, Frame, digital};

/// Captions of one game.
pub struct GameCaptions<'a> {
    game: &'a Game,
    settings: Captions,
    /// Of each position, from the start; empty for a game that is not judged.
    gauges: Vec<Gauge>,
}

impl<'a> GameCaptions<'a> {
    pub fn new(game: &'a Game, settings: Captions) -> GameCaptions<'a> {
        GameCaptions { game, settings, gauges: gauges(game) }
    }

    /// What the picture of `frame` says; `None` where it has neither strip nor card.
    pub fn of(&self, frame: &Frame) -> Option<Content> {
        (self.settings.show || frame.card.is_some()).then(|| self.content(frame))
    }

    fn content(&self, frame: &Frame) -> Content {
        let (game, settings) = (self.game, &self.settings);
        let is_moving = !frame.movers.is_empty();
        let is_last = frame.ply == game.plies.len() && !is_moving;
        let is_over = is_last && game.is_whole() && game.result != "*";
        let card = frame.card.map(|card| match card {
            timeline::Card::Title => Card::Title,
            timeline::Card::Result => Card::Result,
        });
        // A card says all that it is for, whatever the strip is to say.
        let says = |part: bool| part || card.is_some();
        let tells_result = (is_over && settings.event) || card == Some(Card::Result);
        let shown_ply = if is_moving { frame.ply + 1 } else { frame.ply };
        let dials = frame.dials.as_ref().filter(|_| settings.clocks);
        let clocks = clocks(dials);
        let mut players = [Color::White, Color::Black].map(|color| player(game, color));
        for (player, clock) in players.iter_mut().zip(clocks) {
            player.clock = clock;
        }
        if !says(settings.players) {
            players = players.map(|player| Player { clock: player.clock, ..Player::default() });
        }
        Content {
            players,
            has_clocks: matches!(dials, Some(Dials::Times { .. })),
            to_move: (!is_over).then(|| game.turn(frame.ply)),
            moved: if settings.moved { moved(game, shown_ply) } else { String::new() },
            occasion: if says(settings.event) { wording::occasion(game) } else { Vec::new() },
            result: if tells_result { wording::result(game) } else { String::new() },
            ending: if card == Some(Card::Result) { wording::ending(game) } else { String::new() },
            gauge: self.gauges.get(frame.ply).filter(|_| settings.eval).cloned().map(|gauge| {
                // Beside a move that is under way it would be taken for that move's.
                if is_moving { Gauge { label: String::new(), ..gauge } } else { gauge }
            }),
            card,
        }
    }
}

/// What is known of a position of no game: who is to move, as its FEN says. `None` where even that is
/// not, or nothing is to be said.
pub fn of_fen(fen: &str, settings: Captions) -> Option<Content> {
    if !settings.show || !settings.moved {
        return None;
    }
    let (to_move, moved) = match fen.split_whitespace().nth(1)? {
        "w" => (Color::White, "White to move"),
        "b" => (Color::Black, "Black to move"),
        _ => return None,
    };
    Some(Content { to_move: Some(to_move), moved: moved.to_owned(), ..Content::default() })
}

/// The judgement of each position. The bar stands where the last one left it; a number is only there
/// where the position has its own, or is mate.
fn gauges(game: &Game) -> Vec<Gauge> {
    let plies = 0..=game.plies.len();
    if plies.clone().all(|ply| game.notes(ply).eval.is_none()) {
        return Vec::new();
    }
    let mut last = Gauge::even();
    let mut gauges = Vec::with_capacity(game.plies.len() + 1);
    for ply in plies {
        last = match game.notes(ply).eval {
            Some(Eval::Pawns(pawns)) => Gauge::pawns(pawns),
            Some(Eval::Mate(0)) => Gauge::mated(game.turn(ply)),
            Some(Eval::Mate(moves)) => Gauge::mate(moves),
            None => Gauge { label: String::new(), ..last },
        };
        gauges.push(last.clone());
    }
    if let (Some(winner), Some(gauge)) = (game.winner(), gauges.last_mut()) {
        *gauge = Gauge::mated(winner.other());
    }
    gauges
}

fn player(game: &Game, color: Color) -> Player {
    let name = color.fold_wb("White", "Black");
    let tag = |ending: &str| {
        let value = game.tag(&format!("{name}{ending}")).unwrap_or_default().trim();
        if matches!(value, "-" | "?" | "0") { String::new() } else { value.to_owned() }
    };
    Player {
        name: Some(tag("")).filter(|tag| !tag.is_empty()).unwrap_or(name.to_owned()),
        title: tag("Title"),
        rating: tag("Elo"),
        clock: String::new(),
    }
}

fn clocks(dials: Option<&Dials>) -> [String; 2] {
    match dials {
        Some(Dials::Times { left, .. }) => left.map(|left| left.map(digital).unwrap_or_default()),
        Some(Dials::Moves { .. }) | None => Default::default(),
    }
}

/// `17. Rd8#!! ±`, in three-check with the checks that were given; nothing at the start.
fn moved(game: &Game, ply: usize) -> String {
    let Some(mut moved) = game.numbered_san(ply) else {
        return String::new();
    };
    let notes = game.notes(ply);
    moved.extend(notes.move_glyph());
    moved.extend(notes.position_glyph().map(|glyph| format!(" {glyph}")));
    if let Some([white, black]) = game.checks_given(ply).filter(|checks| *checks != [0, 0]) {
        moved += &format!(" (checks {white}–{black})");
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::Scanner;
    use crate::timeline::{Script, Timeline};

    const OPERA: &str = "[Event \"Paris\"]\n[Site \"Paris FRA\"]\n[Date \"1858.11.??\"]\n\
                         [Round \"?\"]\n[White \"Morphy, Paul\"]\n[WhiteElo \"2690\"]\n\
                         [WhiteTitle \"GM\"]\n[BlackElo \"?\"]\n[Result \"1-0\"]\n\n";

    const SCHOLARS: &str = "1. e4 e5 2. Bc4 Nc6 3. Qh5 Nf6 4. Qxf7# 1-0";

    fn game(text: &str) -> Game {
        let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
        Game::read(scanned, 1)
    }

    fn shown() -> Captions {
        Captions { show: true, ..Captions::default() }
    }

    /// The content of each position.
    fn contents(game: &Game, settings: Captions) -> Vec<Content> {
        let script = Script::default();
        let timeline = Timeline::new(game, 0, game.plies.len(), &script).unwrap();
        let captions = GameCaptions::new(game, settings);
        (0..timeline.frames()).filter_map(|index| captions.of(&timeline.frame(index))).collect()
    }

    #[test]
    fn a_strip_says_who_plays_what_and_where() {
        let game = game(&format!("{OPERA}{SCHOLARS}"));
        let contents = contents(&game, shown());
        let [start, second, last] = [&contents[0], &contents[2], &contents[7]];
        let [white, black] = &start.players;
        assert_eq!([&white.title, &white.name, &white.rating], ["GM", "Morphy, Paul", "2690"]);
        assert_eq!([&black.title, &black.name, &black.rating], ["", "Black", ""]);
        assert_eq!(start.occasion, ["Paris FRA", "November 1858"]);
        assert_eq!([&start.moved, &second.moved, &last.moved], ["", "1… e5", "4. Qxf7#"]);
        assert_eq!([&start.result, &second.result, &last.result], ["", "", "1–0"]);
        let to_move = [start, &contents[1], last].map(|content| content.to_move);
        assert_eq!(to_move, [Some(Color::White), Some(Color::Black), None]);
        assert!(contents.iter().all(|content| content.gauge.is_none() && content.card.is_none()));
    }

    #[test]
    fn numbers_are_those_of_the_start() {
        let fen = "[FEN \"4k3/8/8/8/8/8/4P3/4K3 b - - 0 37\"]\n\n37... Kd7 38. e4 *";
        let moved: Vec<String> =
            contents(&game(fen), shown()).into_iter().map(|content| content.moved).collect();
        assert_eq!(moved, ["", "37… Kd7", "38. e4"]);
    }

    #[test]
    fn the_move_under_way_is_the_one_that_is_named() {
        let game = game("1. e4 e5 2. Nf3 *");
        let script = Script { animate: true, ..Script::default() };
        let timeline = Timeline::new(&game, 0, 3, &script).unwrap();
        let captions = GameCaptions::new(&game, shown());
        let mut seen = Vec::new();
        for index in 0..timeline.frames() {
            let frame = timeline.frame(index);
            let content = captions.of(&frame).unwrap();
            seen.push((!frame.movers.is_empty(), content.moved, content.to_move.unwrap()));
        }
        seen.dedup();
        let (white, black) = (Color::White, Color::Black);
        let expected = [
            (false, "", white),
            (true, "1. e4", white),
            (false, "1. e4", black),
            (true, "1… e5", black),
            (false, "1… e5", white),
            (true, "2. Nf3", white),
            (false, "2. Nf3", black),
        ];
        assert_eq!(seen, expected.map(|(moving, san, turn)| (moving, san.to_owned(), turn)));
    }

    #[test]
    fn each_part_can_be_left_out() {
        let game = game(&format!("{OPERA}{{[%eval 0.3]}} {SCHOLARS}"));
        let whole = shown();
        let last = |settings: Captions| contents(&game, settings).pop();
        assert_eq!(last(Captions { show: false, ..whole }), None);
        let said = |settings: Captions| {
            let Content { players, moved, occasion, result, gauge, .. } = last(settings).unwrap();
            let names = players.iter().any(|player| *player != Player::default());
            [names, !moved.is_empty(), !occasion.is_empty(), !result.is_empty(), gauge.is_some()]
        };
        assert_eq!(said(whole), [true; 5]);
        for (settings, expected) in [
            (Captions { players: false, ..whole }, [false, true, true, true, true]),
            (Captions { moved: false, ..whole }, [true, false, true, true, true]),
            (Captions { event: false, ..whole }, [true, true, false, false, true]),
            (Captions { eval: false, ..whole }, [true, true, true, true, false]),
        ] {
            assert_eq!(said(settings), expected, "{settings:?}");
        }
    }

    #[test]
    fn the_bar_stays_at_the_last_judgement_and_the_number_is_the_positions_own() {
        let judged = |game: &Game| -> Vec<(String, f64)> {
            let gauges = contents(game, shown()).into_iter().map(|content| content.gauge.unwrap());
            gauges.map(|gauge| (gauge.label, gauge.share)).collect()
        };
        let game = game(
            "1. e4 {[%eval 0.2]} e5 2. Bc4 (2. Qh5 {[%eval -0.4]} Nc6) 2... Nc6 3. Qh5 \
             Nf6 {[%eval #1]} 4. Qxf7# 1-0",
        );
        let [even, ahead, behind] = [0.0, 0.2, -0.4].map(|pawns| Gauge::pawns(pawns).share);
        let expected = [
            ("", even),
            ("+0.2", ahead),
            ("", ahead),
            ("", ahead),
            ("", ahead),
            ("", ahead),
            ("#1", 1.0),
            // After the mate the bar is the winner's.
            ("#", 1.0),
        ];
        assert_eq!(judged(&game), expected.map(|(label, share)| (label.to_owned(), share)));
        let variation = game.with_variation(&[0]).unwrap();
        let expected = [("", even), ("+0.2", ahead), ("", ahead), ("−0.4", behind), ("", behind)];
        assert_eq!(judged(&variation), expected.map(|(label, share)| (label.to_owned(), share)));
    }

    #[test]
    fn while_a_move_is_under_way_there_is_no_number() {
        let game = game("1. e4 {[%eval 0.2]} e5 *");
        let script = Script { animate: true, ..Script::default() };
        let timeline = Timeline::new(&game, 0, 2, &script).unwrap();
        let captions = GameCaptions::new(&game, shown());
        let mut seen: Vec<(bool, String)> = (0..timeline.frames())
            .map(|index| timeline.frame(index))
            .map(|frame| (frame.movers.is_empty(), captions.of(&frame).unwrap().gauge.unwrap()))
            .map(|(is_at_rest, gauge)| (is_at_rest, gauge.label))
            .collect();
        seen.dedup();
        let expected = [(true, ""), (false, ""), (true, "+0.2"), (false, ""), (true, "")];
        assert_eq!(seen, expected.map(|(is_at_rest, label)| (is_at_rest, label.to_owned())));
    }

    #[test]
    fn the_result_waits_for_the_end_and_for_certainty() {
        for (text, expected) in [
            ("1. e4 e5 1/2-1/2", "½–½"),
            ("1. e4 e5 0-1", "0–1"),
            ("1. e4 e5 *", ""),
            ("1. e4 e5 2. Qxe9 1-0", ""),
        ] {
            let last = contents(&game(text), shown()).pop().unwrap();
            assert_eq!(last.result, expected, "{text}");
            assert_eq!(last.to_move.is_none(), !expected.is_empty(), "{text}");
        }
    }

    #[test]
    fn cards_are_there_without_a_strip_and_say_all() {
        let game = game(&format!("{OPERA}{SCHOLARS}"));
        let nothing = Captions { players: false, event: false, ..Captions::default() };
        let captions = GameCaptions::new(&game, nothing);
        let card = |ply: usize, card| {
            let script = Script::default();
            let frame = Timeline::new(&game, ply, ply, &script).unwrap().frame(0);
            captions.of(&Frame { card: Some(card), ..frame }).unwrap()
        };
        let title = card(0, timeline::Card::Title);
        assert_eq!(
            [title.card, captions.of(&Frame::still(game.placement(0))).and(None)],
            [Some(Card::Title), None]
        );
        assert_eq!(title.players[0].name, "Morphy, Paul");
        assert_eq!([&title.result, &title.ending], ["", ""]);
        let result = card(7, timeline::Card::Result);
        assert_eq!([&result.result, &result.ending], ["1–0", "Checkmate"]);
        assert_eq!(result.occasion, ["Paris FRA", "November 1858"]);
    }

    #[test]
    fn glyphs_stand_at_the_move_and_behind_it() {
        for (text, expected) in [
            ("1. e4 *", "1. e4"),
            ("1. e4!! *", "1. e4!!"),
            ("1. e4 $14 $6 *", "1. e4?! ⩲"),
            ("1. e4 $19 *", "1. e4 −+"),
        ] {
            assert_eq!(moved(&game(text), 1), expected);
        }
    }

    #[test]
    fn checks_are_counted_where_they_count() {
        for (variant, expected) in [("3check", "3. Bb5+ (checks 1–0)"), ("chess", "3. Bb5+")] {
            let game = game(&format!("[Variant \"{variant}\"]\n\n1. e4 e5 2. a3 d6 3. Bb5+ *"));
            assert_eq!(moved(&game, 5), expected);
            assert_eq!(moved(&game, 4), "2… d6");
        }
    }

    #[test]
    fn times_are_written_as_on_clocks() {
        let dials = Dials::Times { left: [Some(3723), Some(59)], running: None };
        assert_eq!(clocks(Some(&dials)), ["1:02:03", "0:59"]);
        let dials = Dials::Times { left: [None, Some(0)], running: None };
        assert_eq!(clocks(Some(&dials)), ["", "0:00"]);
        assert_eq!(clocks(Some(&Dials::Moves { made: [17, 16], to_move: Color::Black })), ["", ""]);
    }

    #[test]
    fn a_fen_says_who_is_to_move() {
        for (fen, expected) in [
            ("8/8/8/8/8/8/8/8 w - - 0 1", Some("White to move")),
            ("8/8/8/8/8/8/8/8 b", Some("Black to move")),
            ("8/8/8/8/8/8/8/8", None),
            ("8/8/8/8/8/8/8/8 -", None),
        ] {
            let content = of_fen(fen, shown());
            assert_eq!(content.as_ref().map(|content| content.moved.as_str()), expected, "{fen}");
            assert_eq!(of_fen(fen, Captions::default()), None);
        }
    }
}
