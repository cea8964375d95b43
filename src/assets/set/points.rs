//! Curves as text: `.133,.190 .106,.235* base:0.222`.
//!
//! A token is a point, with a star where it is a corner, or a curve of the set's with a factor. A
//! number sign begins a comment up to the end of the line.

use std::collections::BTreeMap;

use glam::DVec2;

use super::SetError;
use super::table::Text;
use crate::config::unknown;
use crate::geometry::{ControlPoint, CurveError};

/// The curves that a set has for all its pieces, by name.
pub type Curves = BTreeMap<String, Curve>;

/// More points than any curve needs.
const MAX_POINTS: usize = 200;

/// No coordinate is farther out, in heights of the piece.
const FARTHEST: f64 = 10.0;

/// Control points, and the line of each.
#[derive(Clone)]
pub struct Curve {
    pub points: Vec<ControlPoint>,
    lines: Vec<usize>,
}

impl Curve {
    /// Reads the points of `text`; where it names one of `curves`, its points stand there.
    pub fn read(text: &Text, curves: &Curves) -> Result<Curve, SetError> {
        let mut curve = Curve { points: Vec::new(), lines: Vec::new() };
        for (at, token) in tokens(text.text) {
            let line = text.line(at);
            curve.add(token, line, curves).map_err(|message| text.fault(line, &message))?;
            if curve.points.len() > MAX_POINTS {
                let message = format!("the curve has too many points, expected {MAX_POINTS}");
                return Err(text.fault(line, &message));
            }
        }
        Ok(curve)
    }

    fn add(&mut self, token: &str, line: usize, curves: &Curves) -> Result<(), String> {
        if token.starts_with(|first: char| first.is_alphabetic()) && !token.contains(',') {
            let (name, factor) = token.split_once(':').unwrap_or((token, "1"));
            let factor = number(factor).filter(|factor| *factor > 0.0).ok_or_else(|| {
                format!("`{token}` has no factor, expected a number above 0 as in {name}:0.25")
            })?;
            let known = || curves.keys().map(String::as_str);
            let curve = match curves.get(name) {
                Some(curve) => curve,
                None if curves.is_empty() => {
                    return Err(format!("there is no curve `{name}`, expected points u,v"));
                }
                None => return Err(unknown("curve", name, known())),
            };
            let scaled = |point: &ControlPoint| ControlPoint { at: point.at * factor, ..*point };
            self.points.extend(curve.points.iter().map(scaled));
        } else {
            let (place, corner) = match token.strip_suffix('*') {
                Some(place) => (place, true),
                None => (token, false),
            };
            let numbers = place.split_once(',').and_then(|(u, v)| number(u).zip(number(v)));
            let (u, v) = numbers.ok_or_else(|| {
                format!(
                    "`{token}` is no point, expected two numbers up to 10 as in .25,.5 or .25,.5*"
                )
            })?;
            self.points.push(ControlPoint { at: DVec2::new(u, v), corner });
        }
        self.lines.resize(self.points.len(), line);
        Ok(())
    }

    /// The outline of which these points are the half with x ≥ 0.
    pub fn mirrored(mut self) -> Curve {
        for index in (0..self.points.len()).rev() {
            let ControlPoint { at, corner } = self.points[index];
            // A point on the axis is its own mirror image.
            let ends = index == 0 || index + 1 == self.lines.len();
            if !(at.x == 0.0 && ends) {
                self.points.push(ControlPoint { at: DVec2::new(-at.x, at.y), corner });
                self.lines.push(self.lines[index]);
            }
        }
        self
    }

    /// The line that `error` is about.
    pub fn line_of(&self, error: &CurveError) -> Option<usize> {
        let index = match *error {
            CurveError::BadRadius { point, .. }
            | CurveError::BadHeight { point, .. }
            | CurveError::BadPoint { point, .. } => point - 1,
            CurveError::OffAxis { first, .. } => {
                if first == 0.0 {
                    self.points.len() - 1
                } else {
                    0
                }
            }
            CurveError::CrossesItself(place) => {
                let distance = |index: &usize| self.points[*index].at.distance_squared(place);
                let nearer = |a: &usize, b: &usize| distance(a).total_cmp(&distance(b));
                (0..self.points.len()).min_by(nearer)?
            }
            CurveError::TooShort(_) | CurveError::NoBody => 0,
        };
        self.lines.get(index).copied()
    }
}

/// Words between blanks with their places, without comments.
fn tokens(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let place = |part: &str| part.as_ptr().addr() - text.as_ptr().addr();
    let code = |line: &'_ str| line.split('#').next().unwrap_or_default().len();
    text.lines()
        .flat_map(move |line| line[..code(line)].split_whitespace())
        .map(move |token| (place(token), token))
}

fn number(text: &str) -> Option<f64> {
    let is_plain = text.chars().all(|letter| "0123456789.+-eE".contains(letter));
    text.parse().ok().filter(|number: &f64| is_plain && number.abs() <= FARTHEST)
}
