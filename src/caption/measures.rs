//! How large strips and their letters are.

use crate::config::Captions;

/// The smallest letters that can be read, in pixels an em.
const SMALLEST: f32 = 10.0;

/// How high a strip of one row of words is and one of two, in ems of the upper row.
const ONE_ROW: f32 = 1.9;
const TWO_ROWS: f32 = 3.5;

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
    let least = (ONE_ROW * SMALLEST).ceil();
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
    let rows = if TWO_ROWS * em <= MOST * high { TWO_ROWS } else { ONE_ROW };
    Ok((rows * em).round().min(MOST * high) as u32)
}

/// What a strip of a size holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// An em of the upper row, in pixels.
    pub em: f32,
    pub has_two_rows: bool,
}

impl Measures {
    pub fn of(width: f32, strip: f32) -> Measures {
        let has_two_rows = strip + 0.5 >= TWO_ROWS * SMALLEST;
        let em = strip / if has_two_rows { TWO_ROWS } else { ONE_ROW };
        Measures { em: em.min((width / EMS).max(SMALLEST)), has_two_rows }
    }
}
