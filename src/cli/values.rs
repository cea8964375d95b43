//! Values of flags that are checked as they are read.

use std::ops::RangeInclusive;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use lightsquare::config::{MAX_RAYS, MAX_SIDE};
use lightsquare::job::MOST_SHARDS;
use lightsquare::notation::Placement;
use lightsquare::timeline::Pause;

/// A placement with the FEN that it was read from.
#[derive(Clone)]
pub struct FenArg(pub Placement, pub String);

pub fn fen(text: &str) -> Result<FenArg, String> {
    Placement::from_fen(text).map(|placement| FenArg(placement, text.to_owned())).map_err(|error| {
        format!(
            "{error}, expected a FEN such as 8/8/8/3k4/8/8/4P3/4K3 w - - 0 1, or its board part"
        )
    })
}

/// One of a table of words, whatever its case.
pub fn one_of<T: Copy + Send + Sync + 'static>(
    table: &'static [(&'static str, T)],
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(table.iter().map(|(word, _)| *word)).try_map(|word| {
        let found = table.iter().find(|(known, _)| known.eq_ignore_ascii_case(&word));
        found.map(|(_, value)| *value).ok_or("it is none of them")
    })
}

pub fn size(text: &str) -> Result<(u32, u32), String> {
    let side = |text: &str| text.parse().ok().filter(|side| (1..=MAX_SIDE).contains(side));
    text.split_once(['x', 'X', '×'])
        .and_then(|(width, height)| Some((side(width)?, side(height)?)))
        .ok_or_else(|| {
            format!("expected WIDTHxHEIGHT in pixels, each from 1 to {MAX_SIDE}, as in 1000x600")
        })
}

pub fn game_number(text: &str) -> Result<usize, String> {
    whole_number(text, 1, 1_000_000_000)
}

pub fn limit(text: &str) -> Result<usize, String> {
    whole_number(text, 1, 1_000_000_000)
}

pub fn rays(text: &str) -> Result<u32, String> {
    whole_number(text, 1, MAX_RAYS as usize).map(|rays| rays as u32)
}

pub fn threads(text: &str) -> Result<usize, String> {
    whole_number(text, 1, 1024)
}

pub fn runs(text: &str) -> Result<usize, String> {
    whole_number(text, 1, 1000)
}

pub fn plies(text: &str) -> Result<usize, String> {
    whole_number(text, 0, 1000)
}

pub fn shards(text: &str) -> Result<usize, String> {
    whole_number(text, 1, MOST_SHARDS)
}

pub fn shard(text: &str) -> Result<usize, String> {
    whole_number(text, 0, MOST_SHARDS - 1)
}

pub fn every(text: &str) -> Result<usize, String> {
    whole_number(text, 1, 100_000)
}

pub fn dpi(text: &str) -> Result<u32, String> {
    whole_number(text, 10, 4800).map(|dpi| dpi as u32)
}

pub fn fps(text: &str) -> Result<f64, String> {
    number(text, 1.0, 240.0)
}

pub fn seconds(text: &str) -> Result<f64, String> {
    number(text, 0.0, 3600.0)
}

pub fn pause(text: &str) -> Result<Pause, String> {
    if text.eq_ignore_ascii_case("real") {
        return Ok(Pause::Real);
    }
    seconds(text).map(Pause::Even).map_err(|expected| format!("{expected}, or real"))
}

/// A frame, or the first and the last of a few, counted from 0.
pub fn frames(text: &str) -> Result<RangeInclusive<usize>, String> {
    let expected = "expected a frame's number from 0 on, or two with a hyphen, the lower one first, as in \
                    100-250";
    let number = |text: &str| text.trim().parse::<usize>().ok();
    let (first, last) = text.split_once(['-', ':']).unwrap_or((text, text));
    let range = number(first).zip(number(last)).filter(|(first, last)| first <= last);
    range.map(|(first, last)| first..=last).ok_or_else(|| expected.to_owned())
}

pub fn degrees(text: &str) -> Result<f64, String> {
    number(text, -36_000.0, 36_000.0)
}

fn number(text: &str, min: f64, max: f64) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|number| (min..=max).contains(number))
        .ok_or_else(|| format!("expected a number from {min} to {max}"))
}

fn whole_number(text: &str, min: usize, max: usize) -> Result<usize, String> {
    text.parse()
        .ok()
        .filter(|number| (min..=max).contains(number))
        .ok_or_else(|| format!("expected a whole number from {min} to {max}"))
}
