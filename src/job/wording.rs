//! What a game's tags say, in words for people.

use crate::game::{Ending, Game};

/// The tournament, its place, date and round, as far as they are known.
pub fn occasion(game: &Game) -> Vec<String> {
    let is_known = |value: &&str| !matches!(*value, "" | "?" | "-");
    let known = |name: &str| game.tag(name).map(str::trim).filter(is_known);
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
pub fn result(game: &Game) -> String {
    let set = match game.result.as_str() {
        "1-0" => "1–0",
        "0-1" => "0–1",
        "1/2-1/2" => "½–½",
        _ => "",
    };
    set.to_owned()
}

/// How the game ended, if the board or the tag `Termination` says it.
pub fn ending(game: &Game) -> String {
    // A result that contradicts the board has another reason, which nobody tells.
    let is_meant = |ending: &Ending| (game.result == "1/2-1/2") != ending.is_decisive();
    let by_rule = game.ending().filter(|_| game.is_whole()).filter(is_meant);
    let by_rule = by_rule.map(|ending| match ending {
        Ending::Checkmate => "Checkmate",
        Ending::Stalemate => "Stalemate",
        Ending::InsufficientMaterial => "Neither side can mate",
        Ending::Explosion => "The king is blown up",
        Ending::NothingToMove => "All given away, or stuck",
        Ending::ThirdCheck => "Third check",
        Ending::Hill => "The king is on the hill",
        Ending::Goal => "The king has reached the goal",
        Ending::BothAtGoal => "Both kings have reached the goal",
        Ending::HordeTaken => "The horde is taken",
    });
    if let Some(ending) = by_rule {
        return ending.to_owned();
    }
    if let Some(loser) = game.clocks().flag() {
        return loser.fold_wb("Black wins on time", "White wins on time").to_owned();
    }
    let termination = game.tag("Termination").unwrap_or_default().trim();
    let known = match termination.to_lowercase().as_str() {
        "time forfeit" => "Time ran out",
        "rules infraction" => "Rules infraction",
        "adjudication" => "Adjudicated",
        "abandoned" => "Abandoned",
        // Sites write whole sentences: `Hou won by resignation`.
        text if text.contains(" won ") || text.contains(" drawn ") => termination,
        _ => "",
    };
    known.to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::Scanner;

    const SCHOLARS: &str = "1. e4 e5 2. Bc4 Nc6 3. Qh5 Nf6 4. Qxf7# 1-0";

    fn game(text: &str) -> Game {
        let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
        Game::read(scanned, 1)
    }

    #[test]
    fn endings_are_told_where_they_are_known() {
        let stalemate = "[FEN \"7k/8/5KQ1/8/8/8/8/8 w - - 0 1\"]\n\n1. Qf7 1/2-1/2";
        let bare = "[FEN \"7k/5p2/5K2/8/8/8/8/8 w - - 0 1\"]\n\n1. Kxf7 1/2-1/2";
        for (termination, moves, expected) in [
            ("Normal", SCHOLARS, "Checkmate"),
            ("Time forfeit", SCHOLARS, "Checkmate"),
            ("Normal", stalemate, "Stalemate"),
            ("?", bare, "Neither side can mate"),
            ("Normal", "1. e4 1-0", ""),
            ("Time forfeit", "1. e4 1-0", "White wins on time"),
            ("time forfeit", "1. e4 0-1", "Black wins on time"),
            ("Time forfeit", "1. e4 1/2-1/2", "Time ran out"),
            ("Hou won by resignation", "1. e4 1-0", "Hou won by resignation"),
            ("abandoned", "1. e4 *", "Abandoned"),
            ("Topalov won on time", "1. e4 0-1", "Black wins on time"),
            ("whatever", "1. e4 *", ""),
        ] {
            let separator = if moves.starts_with('[') { "" } else { "\n" };
            let text = format!("[Termination \"{termination}\"]\n{separator}{moves}");
            assert_eq!(ending(&game(&text)), expected, "{text}");
        }
    }

    #[test]
    fn variants_have_endings_of_their_own() {
        for (variant, start, moves, expected) in [
            ("atomic", "", "1. Nf3 a6 2. Ne5 a5 3. Nxf7 1-0", "The king is blown up"),
            ("koth", "4k3/8/8/8/8/3K4/8/8 w - - 0 1", "1. Kd4 1-0", "The king is on the hill"),
            (
                "race",
                "8/k6K/8/8/8/8/8/8 w - - 0 1",
                "1. Kh8 Ka8 1/2-1/2",
                "Both kings have reached the goal",
            ),
            // A result that the rules do not give has another reason.
            ("race", "8/k6K/8/8/8/8/8/8 w - - 0 1", "1. Kh8 Ka8 0-1", ""),
        ] {
            let fen = if start.is_empty() { String::new() } else { format!("[FEN \"{start}\"]\n") };
            let text = format!("[Variant \"{variant}\"]\n{fen}\n{moves}");
            assert_eq!(ending(&game(&text)), expected, "{text}");
        }
    }

    #[test]
    fn what_is_blank_or_unknown_is_not_told() {
        for (event, site, round, expected) in [
            (" ", "Paris", " ", vec!["Paris", "2 November 1858"]),
            ("Opera", " ", "2", vec!["Opera", "2 November 1858", "round 2"]),
            (" ? ", " - ", "-", vec!["2 November 1858"]),
            ("Paris", "Paris FRA", "?", vec!["Paris FRA", "2 November 1858"]),
        ] {
            let text = format!(
                "[Event \"{event}\"]\n[Site \"{site}\"]\n[Date \"1858.11.02\"]\n\
                 [Round \"{round}\"]\n\n*"
            );
            assert_eq!(occasion(&game(&text)), expected, "{text}");
        }
    }

    #[test]
    fn dates_and_places_are_written_as_people_do() {
        for (text, expected) in [
            ("1858.11.02", Some("2 November 1858")),
            ("1858.11.??", Some("November 1858")),
            ("1858.??.??", Some("1858")),
            ("1858.13.40", Some("1858")),
            ("????.??.??", None),
            ("1858", Some("1858")),
            ("??", None),
        ] {
            assert_eq!(date(text).as_deref(), expected, "{text}");
        }
        for (text, expected) in [
            ("Paris FRA", "Paris FRA"),
            ("https://lichess.org/ENPo6ReH", "lichess.org"),
            ("https://www.chess.com", "chess.com"),
        ] {
            assert_eq!(place(text), expected);
        }
    }
}
