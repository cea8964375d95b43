//! Plays the moves of a scanned game, as far as they can be played.

use shakmaty::san::{SanError, SanPlus};
use shakmaty::{Chess, Move, Setup};

use super::movetext::{self, Written};
use super::scan::Token;
use super::{Game, Ply, Problem, ScannedGame, start, tag};

/// Replays `scanned` (the game's number is set by the caller).
pub fn replay(scanned: ScannedGame) -> Game {
    let mut problems = scanned.problems;
    let mut plies = Vec::new();
    let numbered_on = scanned.tags.is_empty() && scanned.first_number.is_some_and(|n| n != 1);
    let start = match (start::setup(&scanned.tags), scanned.tokens.first()) {
        _ if scanned.start_is_lost => None,
        (Ok(_), Some(first)) if numbered_on => {
            let what = "goes on with a game whose beginning is not known";
            problems.push(Problem::new(first.line, &first.text, what, true));
            None
        }
        (Ok(setup), _) => Some(setup),
        (Err(refusal), _) => {
            problems.push(Problem::new(scanned.line, &refusal.token, &refusal.what, true));
            None
        }
    };
    if let Some(setup) = &start {
        match (scanned.tokens.first(), start::position(setup)) {
            (Some(first), Err(error)) => {
                let what = format!("cannot be played from the FEN: {error}");
                problems.push(Problem::new(first.line, &first.text, &what, true));
            }
            (_, Ok(position)) => {
                let written = movetext::read(&scanned.tokens, &scanned.movetext);
                problems.extend(play(position, &scanned.tokens, &written, &mut plies));
            }
            (None, Err(_)) => {}
        }
    }
    problems.sort_by_key(|problem| problem.line);
    let result = scanned
        .result
        .or_else(|| tag(&scanned.tags, "Result").map(str::to_owned))
        .unwrap_or_else(|| "*".to_owned());
    Game {
        number: 0,
        line: scanned.line,
        tags: scanned.tags,
        start_is_known: start.is_some(),
        start: start.unwrap_or_else(Setup::empty),
        plies,
        result,
        problems,
    }
}

/// Plays move by move into `plies`; gives what stopped it.
fn play(
    mut position: Chess,
    tokens: &[Token],
    written: &[Written],
    plies: &mut Vec<Ply>,
) -> Option<Problem> {
    for (index, token) in tokens.iter().enumerate() {
        let stop = |what: &str| Some(Problem::new(token.line, &token.text, what, true));
        let Some(written) = written.get(index) else {
            return stop("is followed by a move that is not certain");
        };
        let played = match legal(&position, written) {
            Ok(played) => played,
            Err(what) => return stop(what),
        };
        let san = SanPlus::from_move_and_play_unchecked(&mut position, played);
        plies.push(Ply { san: san.to_string(), played, after: position.clone() });
    }
    None
}

/// The legal move that is meant, or a clause that says what is wrong.
fn legal(position: &Chess, written: &Written) -> Result<Move, &'static str> {
    if written.passes {
        return Err("is a null move, which no position can show");
    }
    let by_squares = written.uci.as_ref().and_then(|uci| uci.to_move(position).ok());
    match (&written.san, by_squares) {
        (Some(san), by_squares) => match (san.to_move(position), by_squares) {
            (Ok(played), _) | (Err(_), Some(played)) => Ok(played),
            (Err(SanError::AmbiguousSan), None) => Err("can be more than one legal move"),
            (Err(SanError::IllegalSan), None) => Err("is no legal move"),
        },
        (None, Some(played)) => Ok(played),
        (None, None) if written.uci.is_some() => Err("is no legal move"),
        (None, None) => Err("is no move"),
    }
}
