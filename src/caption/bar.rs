//! Who stands better, as a bar and a number.

use super::canvas::{Area, Canvas};
use super::font::{Fonts, Weight};
use super::text::{Line, Span};
use super::tone::Tone;
use crate::notation::Color;

/// A judgement of a position.
#[derive(Clone, Debug, PartialEq)]
pub struct Gauge {
    /// White's share of the bar, 0 to 1.
    pub share: f64,
    /// As in `+1.2`, `−0.4` or `#−3`; empty where nothing is said yet.
    pub label: String,
}

impl Gauge {
    /// Nobody has judged so far.
    pub fn even() -> Gauge {
        Gauge { share: 0.5, label: String::new() }
    }

    /// White is so many pawns better.
    pub fn pawns(pawns: f64) -> Gauge {
        // No sign before what is shown as nothing.
        let tenths = (pawns * 10.0).round();
        let sign = if tenths > 0.0 { "+" } else { sign(tenths < 0.0) };
        Gauge { share: share(pawns), label: format!("{sign}{:.1}", tenths.abs() / 10.0) }
    }

    /// This player is mated.
    pub fn mated(player: Color) -> Gauge {
        Gauge { share: player.fold_wb(0.0, 1.0), label: "#".to_owned() }
    }

    /// White mates in so many moves; a negative number where Black does.
    pub fn mate(moves: i32) -> Gauge {
        let is_black = moves < 0;
        let share = if is_black { 0.0 } else { 1.0 };
        Gauge { share, label: format!("#{}{}", sign(is_black), moves.unsigned_abs()) }
    }
}

fn sign(is_negative: bool) -> &'static str {
    if is_negative { "−" } else { "" }
}

/// White's chances where White is so many pawns better, from 0 to 1: the curve that lichess.org
/// fitted to its games and published (lichess.org/page/accuracy),
/// 50 + 50 × (2 / (1 + exp(−0.00368208 × centipawns)) − 1) per cent.
pub(super) fn share(pawns: f64) -> f64 {
    0.5 + 0.5 * (2.0 / (1.0 + libm::exp(-0.368208 * pawns)) - 1.0)
}

/// Draws the bar over an area with lines of a thickness, White's share on the left as White's name is.
pub fn draw(canvas: &mut Canvas, tone: &Tone, area: Area, line: f32, gauge: &Gauge) {
    let border = (area.left + area.width() * gauge.share as f32).round();
    canvas.fill(Area { right: border, ..area }, tone.white);
    canvas.fill(Area { left: border, ..area }, tone.black);
    let middle = ((area.left + area.right) / 2.0).round();
    canvas.fill(Area { left: middle - line, right: middle + line, ..area }, tone.accent);
    canvas.fill(Area { bottom: area.top + line, ..area }, tone.rule);
    canvas.fill(Area { top: area.bottom - line, ..area }, tone.rule);
}

/// The number on a ground of the colour of the side that it speaks for.
pub struct Chip {
    line: Line,
    is_black: bool,
    size: f32,
}

impl Chip {
    /// `None` where there is no number.
    pub fn new(fonts: &Fonts, tone: &Tone, gauge: &Gauge, size: f32) -> Option<Chip> {
        let is_black = gauge.share < 0.5;
        let ink = if is_black { tone.chip_black.1 } else { tone.chip_white.1 };
        let span = Span::new(fonts, &gauge.label, Weight::Bold, ink).tabular();
        let line = Line::new(vec![span], 0.0, size);
        (!line.is_empty()).then_some(Chip { line, is_black, size })
    }

    pub fn width(&self, fonts: &Fonts) -> f32 {
        self.line.width(fonts) + 0.9 * self.size
    }

    pub fn draw(&self, canvas: &mut Canvas, fonts: &Fonts, tone: &Tone, x: f32, middle: f32) {
        let half = 0.72 * self.size;
        let right = x + self.width(fonts);
        let area = Area { left: x, right, top: middle - half, bottom: middle + half };
        let ground = if self.is_black { tone.chip_black.0 } else { tone.chip_white.0 };
        canvas.fill_round(area, 0.3 * self.size, ground);
        self.line.draw(canvas, fonts, x + 0.45 * self.size, middle);
    }
}
