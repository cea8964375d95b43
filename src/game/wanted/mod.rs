//! Which games are wanted, of all that files hold.

mod date;
mod pattern;
mod player;
mod tags;
mod wildcard;

pub use pattern::{ParsePatternError, PositionPattern};
pub use player::{Players, PlayersError};
pub use tags::{ParseTagTestError, TagTest};

use std::ops::{Range, RangeInclusive};
use std::str::FromStr;

use shakmaty::Position;

use super::scan::Head;
use super::{Ending, Game, Games, Selection, Source, SourceError};

/// Which games are wanted; all by default. A game must pass every test that is there.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// By their number in their file.
    pub numbers: Option<Selection>,
    pub tags: Vec<TagTest>,
    pub players: Players,
    /// By the half-moves that could be played.
    pub plies: Option<PlyRange>,
    /// Only those that end in mate.
    pub checkmate: bool,
    /// Only those that came to such a position, at the start or after any move that was played.
    pub position: Option<PositionPattern>,
    /// How many games are taken in all, the first ones.
    pub limit: Option<usize>,
}

impl Wanted {
    /// Whether a game may be wanted, as far as its number in its file and its tags say, before its moves
    /// are read.
    pub fn takes_head(&self, number: usize, tags: &[(String, String)]) -> bool {
        self.numbers.as_ref().is_none_or(|numbers| numbers.contains(number))
            && self.tags.iter().all(|test| test.holds(tags))
            && self.players.played(tags)
    }

    /// Whether a game is wanted that [`Wanted::takes_head`] of its number and tags. Of a game whose start
    /// is not known no test of its moves is true.
    pub fn takes_game(&self, game: &Game) -> bool {
        if !self.needs_moves() {
            return true;
        }
        game.start_is_known
            && self.plies.as_ref().is_none_or(|plies| plies.contains(game.plies.len()))
            // What cannot be read behind a mate is no move.
            && (!self.checkmate || game.ending() == Some(Ending::Checkmate))
            && self.position.as_ref().is_none_or(|pattern| reaches(game, pattern))
    }

    /// The highest number that is asked for; where games are asked for by number, none follows it.
    pub fn highest_number(&self) -> Option<usize> {
        self.numbers.as_ref().map(Selection::highest)
    }

    /// Of all these those with such numbers, however many there are; `None` where no other number is asked for.
    pub fn between(&self, range: Range<usize>) -> Option<Wanted> {
        let all = Selection::all();
        let numbers = self.numbers.as_ref().unwrap_or(&all).between(range)?;
        Some(Wanted { numbers: Some(numbers), limit: None, ..self.clone() })
    }

    /// Whether [`Wanted::takes_game`] can say no.
    pub fn needs_moves(&self) -> bool {
        self.plies.is_some() || self.checkmate || self.position.is_some()
    }
}

impl Source {
    /// The games that are wanted, one after the other, but for the limit: that is of all files together. What their
    /// numbers and tags rule out is not replayed, and of games that are not wanted nothing is reported. Behind the
    /// highest number that is asked for nothing is read.
    pub fn wanted(self, wanted: &Wanted) -> WantedGames<'_> {
        let pick: Pick = Box::new(|head| wanted.takes_head(head.number, head.tags));
        WantedGames { wanted, games: self.games_where(pick), is_over: false }
    }
}

type Pick<'a> = Box<dyn FnMut(&Head) -> bool + Send + 'a>;

/// The games of a [`Source`] that are wanted.
pub struct WantedGames<'a> {
    wanted: &'a Wanted,
    games: Games<Pick<'a>>,
    is_over: bool,
}

impl WantedGames<'_> {
    /// How many games have come by, those that were not wanted too.
    pub fn seen(&self) -> usize {
        self.games.seen()
    }
}

impl Iterator for WantedGames<'_> {
    type Item = Result<Game, SourceError>;

    fn next(&mut self) -> Option<Result<Game, SourceError>> {
        while !self.is_over {
            let game = match self.games.next()? {
                Ok(game) => game,
                Err(error) => return Some(Err(error)),
            };
            let takes = |wanted: &Wanted| {
                wanted.takes_head(game.number, &game.tags) && wanted.takes_game(&game)
            };
            if takes(self.wanted) {
                let last = self.wanted.highest_number();
                self.is_over = last.is_some_and(|last| game.number >= last);
                return Some(Ok(game));
            }
            // That a file is cut off is told whatever is wanted of it.
            if self.games.is_cut() {
                return Some(Ok(Game::nothing(game.number, game.line, game.problems)));
            }
        }
        None
    }
}

/// Whether a position of the main line is one of a pattern.
fn reaches(game: &Game, pattern: &PositionPattern) -> bool {
    pattern.matches(&game.start.board, game.start.turn)
        || game.plies.iter().any(|ply| pattern.matches(ply.after.board(), ply.after.turn()))
}

/// Numbers of half-moves: `20-80`, `20-`, `-80` or `20`; both ends belong to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlyRange(RangeInclusive<usize>);

/// Why a text is no range of half-moves.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no number of half-moves, expected one or a range as in 20-80, 20- or -80")]
pub struct ParsePlyRangeError(String);

impl PlyRange {
    pub fn contains(&self, plies: usize) -> bool {
        self.0.contains(&plies)
    }
}

impl FromStr for PlyRange {
    type Err = ParsePlyRangeError;

    fn from_str(text: &str) -> Result<PlyRange, ParsePlyRangeError> {
        let (first, last) = text.split_once(['-', ':']).unwrap_or((text, text));
        let [first, last] = [first, last].map(str::trim);
        let end = |text: &str, open| if text.is_empty() { Some(open) } else { text.parse().ok() };
        let range = end(first, 0).zip(end(last, usize::MAX));
        range
            .map(|(first, last)| first..=last)
            .filter(|range| !range.is_empty() && [first, last] != ["", ""])
            .map(PlyRange)
            .ok_or_else(|| ParsePlyRangeError(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::game::Scanner;

    /// The games of a text, numbered from 1.
    fn games(text: &str) -> Vec<Game> {
        (1..)
            .zip(Scanner::new(text.as_bytes()))
            .map(|(number, scanned)| Game::read(scanned.unwrap(), number))
            .collect()
    }

    /// The numbers of those that are wanted.
    fn taken(wanted: &Wanted, games: &[Game]) -> Vec<usize> {
        games
            .iter()
            .filter(|game| wanted.takes_head(game.number, &game.tags) && wanted.takes_game(game))
            .map(|game| game.number)
            .collect()
    }

    const GAMES: &str = "\
        [White \"A\"]\n\n1. f3 e5 2. g4 Qh4# 0-1\n\n\
        [White \"B\"]\n\n1. e4 e5 (1... c5 2. Nf3) 2. Nf3 *\n\n\
        [White \"C\"]\n\n*\n\n\
        [White \"D\"]\n\n1. f3 e5 2. g4 Qh4# 3. Kxh4 0-1\n\n\
        [White \"E\"]\n\n1. e4 e5 2. Ke3 Nf6 3. d4 *\n\n\
        [White \"F\"]\n[FEN \"nonsense\"]\n\n1. e4 *\n\n\
        [White \"G\"]\n[FEN \"7k/5Q2/6K1/8/8/8/8/8 w - - 0 1\"]\n\n1. Qf8# 1-0\n";

    #[test]
    fn every_test_must_be_passed() {
        let games = games(GAMES);
        let all = Wanted::default();
        let numbers = |text: &str| Some(text.parse().unwrap());
        let tags = |text: &str| vec![text.parse().unwrap()];
        let plies = |text: &str| Some(text.parse().unwrap());
        let position = |text: &str| Some(text.parse().unwrap());
        for (wanted, expected) in [
            (all.clone(), vec![1, 2, 3, 4, 5, 6, 7]),
            (Wanted { numbers: numbers("2-3,9"), ..all.clone() }, vec![2, 3]),
            (Wanted { tags: tags("White=B"), ..all.clone() }, vec![2]),
            (Wanted { tags: tags("White!=B"), numbers: numbers("2-3"), ..all.clone() }, vec![3]),
            // Half-moves that could be played: of game 5 two.
            (Wanted { plies: plies("0"), ..all.clone() }, vec![3]),
            (Wanted { plies: plies("-2"), ..all.clone() }, vec![3, 5, 7]),
            (Wanted { plies: plies("3-"), ..all.clone() }, vec![1, 2, 4]),
            (Wanted { checkmate: true, ..all.clone() }, vec![1, 4, 7]),
            (Wanted { checkmate: true, plies: plies("2-"), ..all.clone() }, vec![1, 4]),
            // The start is a position too; that of game 6 is not known.
            (
                Wanted {
                    position: position("rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR w"),
                    ..all.clone()
                },
                vec![1, 2, 3, 4, 5],
            ),
            (Wanted { position: position("*/*/*/*/4P*/*/*/* b"), ..all.clone() }, vec![2, 5]),
            (Wanted { position: position("*Q*k/*/*K*/*/*/*/*/*"), ..all.clone() }, vec![7]),
            // Only in a variation.
            (Wanted { position: position("*/*/*/2p*/*/*/*/*"), ..all.clone() }, vec![]),
            // Behind the last good move.
            (Wanted { position: position("*/*/*/*/*/*/*/* w"), plies: plies("5"), ..all }, vec![]),
        ] {
            assert_eq!(taken(&wanted, &games), expected, "{wanted:?}");
        }
    }

    #[test]
    fn moves_are_needed_where_they_can_rule_a_game_out() {
        let all = Wanted::default();
        for (wanted, expected) in [
            (all.clone(), false),
            (
                Wanted { tags: vec!["White=B".parse().unwrap()], limit: Some(1), ..all.clone() },
                false,
            ),
            (Wanted { plies: Some("1-".parse().unwrap()), ..all.clone() }, true),
            (Wanted { checkmate: true, ..all.clone() }, true),
            (Wanted { position: Some("*/*/*/*/*/*/*/*".parse().unwrap()), ..all }, true),
        ] {
            assert_eq!(wanted.needs_moves(), expected, "{wanted:?}");
        }
    }

    #[test]
    fn ranges_of_plies_are_inclusive_and_may_be_open() {
        for (text, expected) in [
            ("2-4", vec![2, 3, 4]),
            ("2:4", vec![2, 3, 4]),
            (" 2 - 4 ", vec![2, 3, 4]),
            ("4-", vec![4, 5, 6]),
            ("-2", vec![0, 1, 2]),
            ("3", vec![3]),
            ("0", vec![0]),
        ] {
            let range: PlyRange = text.parse().unwrap();
            let found: Vec<usize> = (0..7).filter(|plies| range.contains(*plies)).collect();
            assert_eq!(found, expected, "{text:?}");
        }
        for text in ["", "-", "4-2", "x", "1-x", "1-2-3", "--4", "1.5"] {
            assert!(text.parse::<PlyRange>().is_err(), "{text:?}");
        }
    }
}
