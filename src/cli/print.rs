//! Pictures for print: how wide they are on paper.

use clap::Args;
use lightsquare::config::{Config, MAX_SIDE};

use super::UsageError;
use super::values::dpi;

/// The size on paper.
#[derive(Args)]
#[command(next_help_heading = "Print")]
pub struct PrintArgs {
    /// Width on paper, as in 80mm, 8cm or 3.2in; it sets the pixels, in the shape that the size has
    #[arg(long, value_name = "LENGTH", value_parser = length, allow_hyphen_values = true)]
    width: Option<Length>,
    /// Pixels an inch of paper, from 10 to 4800 [default: 300]
    #[arg(long, value_name = "N", value_parser = dpi, requires = "width", allow_hyphen_values = true)]
    dpi: Option<u32>,
}

/// A length on paper, above 0.
#[derive(Clone)]
struct Length {
    inches: f64,
    /// As it was given.
    text: String,
}

/// Units of length, and how many there are in an inch.
const UNITS: [(&str, f64); 3] = [("mm", 25.4), ("cm", 2.54), ("in", 1.0)];

impl PrintArgs {
    /// Gives `config` the pixels that the width on paper takes, in the shape that it had. Gives back
    /// the pixels an inch, where a width is asked for.
    ///
    /// # Errors
    /// A picture with fewer pixels than 1 a side, or more than [`MAX_SIDE`].
    pub fn apply(&self, config: &mut Config) -> Result<Option<u32>, UsageError> {
        let Some(Length { inches, text }) = &self.width else {
            return Ok(None);
        };
        let dpi = self.dpi.unwrap_or(300);
        let width = (inches * f64::from(dpi)).round();
        let height = (width * f64::from(config.height) / f64::from(config.width)).round();
        let range = 1.0..=f64::from(MAX_SIDE);
        if !range.contains(&width) || !range.contains(&height) {
            return Err(UsageError(format!(
                "--width: {text} at {dpi} pixels an inch makes {width} x {height} pixels, expected 1 to \
                 {MAX_SIDE} a side"
            )));
        }
        (config.width, config.height) = (width as u32, height as u32);
        Ok(Some(dpi))
    }
}

fn length(text: &str) -> Result<Length, String> {
    let expected = "expected a length above 0 with its unit, mm, cm or in, as in 80mm";
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let (number, unit) = (digits.trim(), &text[digits.len()..]);
    let number = number.parse().ok().filter(|number: &f64| *number > 0.0 && number.is_finite());
    let number = number.ok_or(expected)?;
    match UNITS.iter().find(|(name, _)| name.eq_ignore_ascii_case(unit)) {
        Some((_, per_inch)) => Ok(Length { inches: number / per_inch, text: text.to_owned() }),
        None if unit.is_empty() => Err(expected.to_owned()),
        None if unit.eq_ignore_ascii_case("px") => {
            Err(format!("pixels are for --size, {expected}"))
        }
        None => Err(format!("there is no unit `{unit}`, {expected}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_width_on_paper_sets_the_pixels_and_keeps_the_shape() {
        let cases = [
            ("80mm", None, Some((945, 567))),
            ("8cm", Some(300), Some((945, 567))),
            ("0.5 in", Some(600), Some((300, 180))),
            ("1IN", Some(10), Some((10, 6))),
            ("0.05mm", Some(300), Some((1, 1))),
            ("0.01mm", Some(300), None),
            ("2m", None, None),
            ("60in", None, None),
        ];
        for (text, dpi, expected) in cases {
            let print = length(text).map(|width| PrintArgs { width: Some(width), dpi });
            let mut config = Config { width: 1000, height: 600, ..Config::default() };
            let applied = print.map(|print| print.apply(&mut config));
            let found = matches!(applied, Ok(Ok(Some(_)))).then_some((config.width, config.height));
            assert_eq!(found, expected, "{text}");
        }
    }

    #[test]
    fn lengths_that_are_none_get_a_sentence() {
        let cases = [
            ("80", "expected a length above 0 with its unit, mm, cm or in, as in 80mm"),
            ("0mm", "expected a length above 0"),
            ("-5cm", "expected a length above 0"),
            ("nanmm", "expected a length above 0"),
            ("1e999in", "expected a length above 0"),
            ("", "expected a length above 0"),
            ("mm", "expected a length above 0"),
            ("3ft", "there is no unit `ft`, expected a length above 0 with its unit"),
            ("800px", "pixels are for --size, expected a length"),
        ];
        for (text, message) in cases {
            let error = length(text).err().unwrap_or_default();
            assert!(error.starts_with(message), "{text}: {error}");
        }
    }
}
