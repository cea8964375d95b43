//! Marks that somebody drew on the board, as PGN writes them in `[%csl Gd5]` and `[%cal Ge2e4]`.

use std::fmt;
use std::str::FromStr;

use super::Square;

/// The colours that marks are drawn in, by their first letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Brush {
    Green,
    Red,
    Yellow,
    Blue,
}

/// A square with a ring round it: `Gd5`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Circle {
    pub brush: Brush,
    pub square: Square,
}

/// An arrow from a square to another one: `Ge2e4`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arrow {
    pub brush: Brush,
    pub from: Square,
    pub to: Square,
}

/// Why a text is no mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseMarkError {
    #[error("expected G, R, Y or B and a square, as in Gd5")]
    NoCircle,
    #[error("expected G, R, Y or B and two squares, as in Ge2e4")]
    NoArrow,
    #[error("goes from a square to itself, expected two squares")]
    ToItself,
}

/// The letters of the brushes.
const BRUSHES: [(char, Brush); 4] =
    [('G', Brush::Green), ('R', Brush::Red), ('Y', Brush::Yellow), ('B', Brush::Blue)];

impl Brush {
    /// Cuts a brush's letter from the front of a text.
    fn cut(text: &str) -> Option<(Brush, &str)> {
        let mut rest = text.chars();
        let letter = rest.next()?.to_ascii_uppercase();
        let (_, brush) = BRUSHES.iter().find(|(known, _)| *known == letter)?;
        Some((*brush, rest.as_str()))
    }

    fn letter(self) -> char {
        BRUSHES.iter().find(|(_, brush)| *brush == self).map_or('?', |(letter, _)| *letter)
    }
}

impl FromStr for Circle {
    type Err = ParseMarkError;

    fn from_str(text: &str) -> Result<Circle, ParseMarkError> {
        let (brush, square) = Brush::cut(text).ok_or(ParseMarkError::NoCircle)?;
        let square = square.to_ascii_lowercase().parse().map_err(|_| ParseMarkError::NoCircle)?;
        Ok(Circle { brush, square })
    }
}

impl FromStr for Arrow {
    type Err = ParseMarkError;

    fn from_str(text: &str) -> Result<Arrow, ParseMarkError> {
        let (brush, squares) = Brush::cut(text).ok_or(ParseMarkError::NoArrow)?;
        let squares = squares.to_ascii_lowercase();
        let (from, to) = squares.split_at_checked(2).ok_or(ParseMarkError::NoArrow)?;
        let square = |text: &str| text.parse().map_err(|_| ParseMarkError::NoArrow);
        let (from, to) = (square(from)?, square(to)?);
        if from == to { Err(ParseMarkError::ToItself) } else { Ok(Arrow { brush, from, to }) }
    }
}

impl fmt::Display for Circle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.brush.letter(), self.square)
    }
}

impl fmt::Display for Arrow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}{}", self.brush.letter(), self.from, self.to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_read_and_written() {
        for text in ["Gd5", "Ra1", "Yh8", "Be4"] {
            assert_eq!(
                text.parse::<Circle>().map(|circle| circle.to_string()),
                Ok(text.to_owned())
            );
        }
        for text in ["Ge2e4", "Rd1d8", "Yg1f3", "Ba8h1"] {
            assert_eq!(text.parse::<Arrow>().map(|arrow| arrow.to_string()), Ok(text.to_owned()));
        }
    }

    #[test]
    fn what_is_no_mark_is_refused() {
        for text in ["", "G", "d5", "Gd9", "Gd5e4", "Pd5", "Gé"] {
            assert_eq!(text.parse::<Circle>(), Err(ParseMarkError::NoCircle), "{text}");
        }
        for text in ["", "Ge2", "e2e4", "Ge2e9", "Ge2e4e5", "Géé"] {
            assert_eq!(text.parse::<Arrow>(), Err(ParseMarkError::NoArrow), "{text}");
        }
        assert_eq!("Ge2e2".parse::<Arrow>(), Err(ParseMarkError::ToItself));
    }
}
