//! What pictures of a game say: from its tags, moves and notes to a caption's content.

use crate::caption::{Card, Content, Gauge, Player};
use crate::config::Captions;
use crate::game::{Ending, Eval, Game, Notes};
use crate::notation::Color;
use crate::timeline::{self, Dials, Frame};

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
        let shown_ply = if is_moving { frame.ply + 1 } else { frame.ply };
        let clocks = clocks(frame.dials.as_ref().filter(|_| settings.clocks));
        let mut players = [Color::White, Color::Black].map(|color| player(game, color));
        for (player, clock) in players.iter_mut().zip(clocks) {
            player.clock = clock;
        }
        if !says(settings.players) {
            players = players.map(|player| Player { clock: player.clock, ..Player::default() });
        }
        Content {
            players,
            to_move: (!is_over).then(|| game.turn(frame.ply)),
            moved: if settings.moved { moved(game, shown_ply) } else { String::new() },
            occasion: if says(settings.event) { occasion(game) } else { Vec::new() },
            result: result(game, (is_over && settings.event) || card == Some(Card::Result)),
            ending: if card == Some(Card::Result) { ending(game) } else { String::new() },
            gauge: self.gauges.get(frame.ply).filter(|_| settings.eval).cloned(),
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

/// The last known judgement at each position; at a mate no other is needed.
fn gauges(game: &Game) -> Vec<Gauge> {
    let judged = (0..=game.plies.len()).map(|ply| game.notes(ply).eval);
    if judged.clone().all(|eval| eval.is_none()) {
        return Vec::new();
    }
    let mut last = Gauge::even();
    let mut gauges = Vec::with_capacity(game.plies.len() + 1);
    for eval in judged {
        match eval {
            Some(Eval::Pawns(pawns)) => last = Gauge::pawns(pawns),
            Some(Eval::Mate(moves)) => last = Gauge::mate(moves),
            None => {}
        }
        gauges.push(last.clone());
    }
    if let (Some(Ending::Checkmate), Some(gauge)) = (game.ending(), gauges.last_mut()) {
        *gauge = Gauge::mated(game.turn(game.plies.len()));
    }
    gauges
}

fn player(game: &Game, color: Color) -> Player {
    let name = color.fold_wb("White", "Black");
    let tag = |ending: &str| {
        let value = game.tag(&format!("{name}{ending}")).unwrap_or_default().trim();
        if matches!(value, "-" | "0") { String::new() } else { value.to_owned() }
    };
    Player {
        name: Some(tag("")).filter(|tag| !tag.is_empty()).unwrap_or(name.to_owned()),
        title: tag("Title"),
        rating: tag("Elo"),
        clock: String::new(),
    }
}

fn clocks(dials: Option<&Dials>) -> [String; 2] {
    let written = |seconds: u32| {
        let (hours, minutes, seconds) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
        if hours > 0 {
            format!("{hours}:{minutes:02}:{seconds:02}")
        } else {
            format!("{minutes}:{seconds:02}")
        }
    };
    match dials {
        Some(Dials::Times { left, .. }) => left.map(|left| left.map(written).unwrap_or_default()),
        Some(Dials::Moment(_)) | None => Default::default(),
    }
}

/// `17. Rd8#!!`; nothing at the start.
fn moved(game: &Game, ply: usize) -> String {
    let mut moved = game.numbered_san(ply).unwrap_or_default();
    if !moved.is_empty() {
        moved.push_str(&glyphs(game.notes(ply)));
    }
    moved
}

/// The signs of annotators by their numbers in PGN: those of moves stand at the move, those of positions behind it.
const OF_MOVES: [(u8, &str); 6] = [(1, "!"), (2, "?"), (3, "!!"), (4, "??"), (5, "!?"), (6, "?!")];
const OF_POSITIONS: [(u8, &str); 8] =
    [(10, "="), (13, "∞"), (14, "⩲"), (15, "⩱"), (16, "±"), (17, "∓"), (18, "+−"), (19, "−+")];

fn glyphs(notes: &Notes) -> String {
    let first = |signs: &[(u8, &'static str)]| {
        let known = |glyph: &u8| signs.iter().find(|(number, _)| number == glyph);
        notes.glyphs.iter().find_map(known).map(|(_, sign)| *sign)
    };
    let mut glyphs = first(&OF_MOVES).unwrap_or_default().to_owned();
    if let Some(sign) = first(&OF_POSITIONS) {
        glyphs.push(' ');
        glyphs.push_str(sign);
    }
    glyphs
}

/// The tournament, its place, date and round, as far as they are known.
fn occasion(game: &Game) -> Vec<String> {
    let known = |name: &str| game.tag(name).map(str::trim).filter(|value| *value != "-");
    let event = known("Event").map(str::to_owned);
    let site = known("Site").map(place);
    // A tournament that bears the name of its town is not told twice.
    let names_event = |site: &String| event.as_ref().is_some_and(|event| site.starts_with(event));
    let event = if site.as_ref().is_some_and(names_event) { None } else { event };
    let round = known("Round").map(|round| format!("round {round}"));
    let date = known("Date").and_then(date).or_else(|| known("UTCDate").and_then(date));
    [event, site, date, round].into_iter().flatten().collect()
}

/// A place as it is; of an address on the web, whose it is.
fn place(site: &str) -> String {
    let address = site.split_once("://").filter(|(scheme, _)| scheme.starts_with("http"));
    let host = address.and_then(|(_, rest)| rest.split('/').next());
    host.map_or(site, |host| host.trim_start_matches("www.")).to_owned()
}

const MONTHS: [&str; 12] = [
    "January",
    "February",
    "March",
    "April",
    "May",
    "June",
    "July",
    "August",
    "September",
    "October",
    "November",
    "December",
];

/// `1858.11.02` as `2 November 1858`, without what is not known. What is no date stays as it is.
fn date(date: &str) -> Option<String> {
    let parts: Vec<&str> = date.split('.').collect();
    let [year, month, day] = parts[..] else {
        return Some(date.to_owned()).filter(|date| date.chars().any(char::is_alphanumeric));
    };
    let year: u32 = year.parse().ok()?;
    let month = month.parse::<usize>().ok().and_then(|month| MONTHS.get(month.checked_sub(1)?));
    let day = day.parse::<u32>().ok().filter(|day| (1..=31).contains(day));
    Some(match (month, day) {
        (Some(month), Some(day)) => format!("{day} {month} {year}"),
        (Some(month), None) => format!("{month} {year}"),
        (None, _) => year.to_string(),
    })
}

/// As it is set: `1–0`, `½–½`.
fn result(game: &Game, is_wanted: bool) -> String {
    let set = match game.result.as_str() {
        _ if !is_wanted => "",
        "1-0" => "1–0",
        "0-1" => "0–1",
        "1/2-1/2" => "½–½",
        _ => "",
    };
    set.to_owned()
}

/// How the game ended, if the board or the tag `Termination` says it.
fn ending(game: &Game) -> String {
    let by_rule = game.ending().filter(|_| game.is_whole()).map(|ending| match ending {
        Ending::Checkmate => "Checkmate",
        Ending::Stalemate => "Stalemate",
        Ending::InsufficientMaterial => "Neither side can mate",
    });
    if let Some(ending) = by_rule {
        return ending.to_owned();
    }
    let termination = game.tag("Termination").unwrap_or_default().trim();
    let known = match (termination.to_lowercase().as_str(), game.result.as_str()) {
        ("time forfeit", "1-0") => "White wins on time",
        ("time forfeit", "0-1") => "Black wins on time",
        ("time forfeit", _) => "Time ran out",
        ("rules infraction", _) => "Rules infraction",
        ("adjudication", _) => "Adjudicated",
        ("abandoned", _) => "Abandoned",
        // Sites write whole sentences: `Hou won by resignation`.
        (text, _) if text.contains(" won ") || text.contains(" drawn ") => termination,
        _ => "",
    };
    known.to_owned()
}
