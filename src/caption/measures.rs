//! How large strips and their letters are.

use crate::config::Captions;

/// The smallest letters that can be read, in pixels an em.
const SMALLEST: f32 = 10.0;

/// The rows of words in a strip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rows {
    /// Names and the move.
    One,
    /// These, and below them clocks and the tournament.
    Two,
    /// White, Black, the move, the tournament: in a narrow picture two names and a move have no room
    /// beside each other.
    Four,
}

impl Rows {
    /// How high a strip of them is, in ems of the upper row.
    const fn height(self) -> f32 {
        match self {
            Rows::One => 1.9,
            Rows::Two => 3.5,
            Rows::Four => 6.2,
        }
    }

    /// As many as a picture of a width has room for, where the strip is at most so high.
    fn within(width: f32, height: f32, em: f32) -> Rows {
        let is_narrow = width < NARROW * SMALLEST;
        let most = if is_narrow { [Rows::Four, Rows::Two] } else { [Rows::Two; 2] };
        most.into_iter().find(|rows| rows.height() * em <= height).unwrap_or(Rows::One)
    }
}

/// In a strip that is not so many ems wide names stand below each other, if there is room.
const NARROW: f32 = 30.0;

/// The pictures' size that an em of the upper row grows with: this share of the mean side.
const SHARE: f32 = 0.022;

/// A strip is so many ems wide at least, unless letters could not be read.
const EMS: f32 = 40.0;

/// The narrowest picture that has room for a move between two names, in pixels.
const LEAST_WIDTH: f32 = 120.0;

/// The largest share of a picture that a strip takes unasked.
const MOST: f32 = 0.25;

/// A picture that has no room for words.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CaptionError {
    #[error(
        "captions: a picture of {width} x {height} pixels has no room for them, expected at least \
         {least_width} x {least_height}"
    )]
    TooSmall { width: u32, height: u32, least_width: u32, least_height: u32 },
    #[error("captions: Height makes a strip of {strip} rows of pixels, expected at least {least}")]
    TooLow { strip: u32, least: u32 },
}

/// How many rows of pixels a strip takes from a picture of that size.
///
/// # Errors
/// When it would be too small for words that can be read.
pub fn strip_height(settings: &Captions, width: u32, height: u32) -> Result<u32, CaptionError> {
    let least = (Rows::One.height() * SMALLEST).ceil();
    let (least_width, least_height) = (LEAST_WIDTH, (least / MOST).ceil());
    let (wide, high) = (width as f32, height as f32);
    if wide < least_width || high < least_height {
        let (least_width, least_height) = (least_width as u32, least_height as u32);
        return Err(CaptionError::TooSmall { width, height, least_width, least_height });
    }
    if settings.height > 0.0 {
        let strip = (settings.height * f64::from(height)).round() as u32;
        let least = least as u32;
        return if strip < least { Err(CaptionError::TooLow { strip, least }) } else { Ok(strip) };
    }
    let em = (SHARE * (wide * high).sqrt()).min(wide / EMS).max(SMALLEST);
    let rows = Rows::within(wide, MOST * high, em);
    Ok((rows.height() * em).round().min(MOST * high) as u32)
}

/// What a strip of a size holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// An em of the upper row, in pixels.
    pub em: f32,
    pub rows: Rows,
}

impl Measures {
    pub fn of(width: f32, strip: f32) -> Measures {
        let rows = Rows::within(width, strip + 0.5, SMALLEST);
        let em = strip / rows.height();
        Measures { em: em.min((width / EMS).max(SMALLEST)), rows }
    }
}
