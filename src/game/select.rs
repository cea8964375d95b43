//! Which games of a file, and which positions of a game.

use std::ops::{Range, RangeInclusive};
use std::str::FromStr;

use shakmaty::Color;

use super::Game;

/// Numbers of games: `3`, `5-9`, `1:3,10`; both ends of a range belong to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selection(Vec<RangeInclusive<usize>>);

/// Why a text selects nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{part}` is no game number or range, expected numbers from 1 as in 3, 5-9 or 1:3,10")]
pub struct ParseSelectionError {
    pub part: String,
}

impl Selection {
    /// Every game.
    pub fn all() -> Selection {
        Selection(vec![1..=usize::MAX])
    }

    /// Those of its numbers that lie within `range`, if there are any.
    pub fn between(&self, range: Range<usize>) -> Option<Selection> {
        let last = range.end.checked_sub(1)?;
        let parts =
            self.0.iter().map(|part| *part.start().max(&range.start)..=*part.end().min(&last));
        let parts: Vec<_> = parts.filter(|part| !part.is_empty()).collect();
        (!parts.is_empty()).then_some(Selection(parts))
    }

    /// Whether game `number` is selected.
    pub fn contains(&self, number: usize) -> bool {
        self.0.iter().any(|range| range.contains(&number))
    }

    /// The highest number that is selected by name.
    pub fn highest(&self) -> usize {
        self.0.iter().map(|range| *range.end()).max().unwrap_or(0)
    }
}

impl FromStr for Selection {
    type Err = ParseSelectionError;

    fn from_str(text: &str) -> Result<Selection, ParseSelectionError> {
        let number = |text: &str| text.trim().parse().ok().filter(|number| *number > 0);
        let range = |part: &str| {
            let (first, last) = part.split_once(['-', ':']).unwrap_or((part, part));
            let range = number(first)?..=number(last)?;
            (!range.is_empty()).then_some(range)
        };
        text.split(',')
            .map(|part| range(part).ok_or_else(|| ParseSelectionError { part: part.to_owned() }))
            .collect::<Result<_, _>>()
            .map(Selection)
    }
}

/// A position of a game.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// After so many half-moves; 0 is the start.
    Ply(usize),
    /// After a player's move of that number: `17w`, `17b`.
    After(u32, Color),
    /// After the last move.
    End,
}

/// Why a text names no position.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no position, expected a move as in 17w or 17b, a number of half-moves, start or end"
)]
pub struct ParseMomentError(String);

impl FromStr for Moment {
    type Err = ParseMomentError;

    fn from_str(text: &str) -> Result<Moment, ParseMomentError> {
        let error = || ParseMomentError(text.to_owned());
        let by = |suffix, color| {
            text.strip_suffix(suffix).map(|number| {
                let number: Option<u32> = number.parse().ok().filter(|number| *number > 0);
                number.map(|number| Moment::After(number, color)).ok_or_else(error)
            })
        };
        match text {
            "start" => Ok(Moment::Ply(0)),
            "end" => Ok(Moment::End),
            _ => by("w", Color::White)
                .or_else(|| by("b", Color::Black))
                .unwrap_or_else(|| text.parse().map(Moment::Ply).map_err(|_| error())),
        }
    }
}

impl std::fmt::Display for Moment {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Moment::Ply(ply) => write!(f, "{ply}"),
            Moment::After(number, color) => write!(f, "{number}{}", color.char()),
            Moment::End => f.write_str("end"),
        }
    }
}

/// Where a moment lies that is no position of a game.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Absent {
    BeforeTheStart,
    BehindTheEnd,
}

impl Moment {
    /// The number of half-moves after which `game` is there.
    ///
    /// # Errors
    /// When the game begins later, or ends earlier.
    pub fn ply(self, game: &Game) -> Result<usize, Absent> {
        let ply = usize::try_from(self.counted(game)).map_err(|_| Absent::BeforeTheStart)?;
        if ply <= game.plies.len() { Ok(ply) } else { Err(Absent::BehindTheEnd) }
    }

    /// The number of half-moves after which `game` is there, or would be if it began earlier (then it is below 0)
    /// or went on.
    pub fn counted(self, game: &Game) -> i64 {
        match self {
            Moment::Ply(ply) => ply as i64,
            Moment::End => game.plies.len() as i64,
            Moment::After(number, color) => {
                let first =
                    2 * i64::from(game.start.fullmoves.get()) + game.start.turn.fold_wb(0, 1);
                2 * i64::from(number) + color.fold_wb(1, 2) - first
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_inclusive() {
        let selection: Selection = "1:3,10, 12-13".parse().unwrap();
        let selected: Vec<usize> = (0..20).filter(|n| selection.contains(*n)).collect();
        assert_eq!(selected, [1, 2, 3, 10, 12, 13]);
    }

    #[test]
    fn a_selection_can_be_narrowed() {
        let selection: Selection = "1:3,10,12-13".parse().unwrap();
        for (range, expected) in [
            (2..13, Some(vec![2, 3, 10, 12])),
            (0..usize::MAX, Some(vec![1, 2, 3, 10, 12, 13])),
            (4..10, None),
            (0..0, None),
        ] {
            let narrowed = selection.between(range.clone());
            let numbers = |s: Selection| (0..20).filter(|n| s.contains(*n)).collect::<Vec<_>>();
            assert_eq!(narrowed.map(numbers), expected, "{range:?}");
        }
        assert_eq!(Selection::all().between(5..8).unwrap().highest(), 7);
    }

    #[test]
    fn what_selects_nothing_is_refused() {
        for (text, part) in [("", ""), ("0", "0"), ("3,,4", ""), ("9-5", "9-5"), ("1,x", "x")] {
            let error = text.parse::<Selection>().unwrap_err();
            assert_eq!(error.part, part, "{text:?}");
        }
    }

    #[test]
    fn moments_are_read() {
        let cases = [
            ("17w", Moment::After(17, Color::White)),
            ("1b", Moment::After(1, Color::Black)),
            ("33", Moment::Ply(33)),
            ("start", Moment::Ply(0)),
            ("end", Moment::End),
        ];
        for (text, moment) in cases {
            assert_eq!(text.parse(), Ok(moment));
        }
        for text in ["", "w", "0w", "-1", "17x", "1.5"] {
            assert!(text.parse::<Moment>().is_err(), "{text:?}");
        }
    }
}
