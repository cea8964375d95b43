//! The strip below a scene.
//!
//! White's name stands on the left and Black's on the right, each behind a disc of its colour, the
//! move between them; clocks and the tournament in a second row. The bar of a judgement runs along
//! the upper edge.

use super::bar::{self, Chip};
use super::canvas::{Area, Canvas};
use super::font::{Fonts, Weight};
use super::measures::Measures;
use super::text::{Line, Span};
use super::tone::Tone;
use super::{Content, Player};
use crate::notation::Color;

/// Measures in ems of the upper row: the margin at the sides, white between what stands in a row,
/// a disc's radius, the second row's letters, the bar's height.
const MARGIN: f32 = 1.0;
const APART: f32 = 1.2;
const DISC: f32 = 0.36;
const BESIDE_DISC: f32 = 0.5;
const SMALL: f32 = 0.72;
const BAR: f32 = 0.28;

/// Between the parts of a name, in ems.
const GAP: f32 = 0.34;

/// Draws on a canvas that is the strip, of the ground's colour.
pub fn draw(canvas: &mut Canvas, fonts: &Fonts, tone: &Tone, content: &Content) {
    let (width, height) = (canvas.width(), canvas.height());
    let Measures { em, has_two_rows } = Measures::of(width, height);
    let bar = (BAR * em).round().max(2.0);
    let edge = Area { left: 0.0, top: 0.0, right: width, bottom: bar };
    match &content.gauge {
        Some(gauge) => bar::draw(canvas, tone, edge, hairline(em), gauge),
        None => canvas.fill(Area { bottom: hairline(em), ..edge }, tone.rule),
    }
    let lower = Lower::new(fonts, tone, content, SMALL * em);
    let has_lower = has_two_rows && !lower.is_empty();
    let room = height - bar;
    let (upper_middle, lower_middle) =
        if has_lower { (bar + 0.355 * room, bar + 0.72 * room) } else { (bar + 0.485 * room, 0.0) };
    let inset = MARGIN * em + 2.0 * DISC * em + BESIDE_DISC * em;
    upper_row(canvas, fonts, tone, content, em, upper_middle, !has_two_rows);
    if has_lower {
        let has_names = content.players.iter().any(|player| !player.name.is_empty());
        lower.draw(canvas, fonts, if has_names { inset } else { MARGIN * em }, lower_middle);
    }
}

/// The thickness of a fine line, in whole pixels.
pub fn hairline(em: f32) -> f32 {
    (em / 24.0).round().max(1.0)
}

/// Names and the move; with the clocks where there is no second row.
fn upper_row(
    canvas: &mut Canvas,
    fonts: &Fonts,
    tone: &Tone,
    content: &Content,
    em: f32,
    middle: f32,
    with_clocks: bool,
) {
    let width = canvas.width();
    let chip = content.gauge.as_ref().and_then(|gauge| Chip::new(fonts, tone, gauge, 0.72 * em));
    let chip_width = chip.as_ref().map_or(0.0, |chip| chip.width(fonts));
    let moved = Span::new(fonts, &content.moved, Weight::Bold, tone.ink);
    let moved = Line::new(vec![moved], 0.0, em);
    let between = if chip.is_some() && !moved.is_empty() { 0.55 * em } else { 0.0 };
    let moved = moved.fitted(fonts, 0.5 * width - chip_width - between);
    let group = moved.width(fonts) + between + chip_width;
    let from = ((width - group) / 2.0).round();
    moved.draw(canvas, fonts, from, middle);
    let is_nameless = content.players.iter().all(|player| player.name.is_empty());
    if let Some(color) = content.to_move.filter(|_| is_nameless && group > 0.0) {
        draw_disc(canvas, tone, color, false, (from - 0.9 * em, middle), em);
    }
    if let Some(chip) = chip {
        chip.draw(canvas, fonts, tone, from + group - chip_width, middle);
    }

    let inset = (MARGIN + 2.0 * DISC + BESIDE_DISC) * em;
    let apart = if group > 0.0 { group / 2.0 + APART * em } else { APART * em / 2.0 };
    let room = (width / 2.0 - apart - inset).max(0.0);
    let lines = content
        .players
        .each_ref()
        .map(|player| Line::new(name(fonts, tone, player, with_clocks), GAP, em));
    let lines = Line::both_fitted(lines, fonts, room);
    let players = content.players.iter().zip(&lines);
    for (color, (player, line)) in [Color::White, Color::Black].into_iter().zip(players) {
        if player.name.is_empty() {
            continue;
        }
        let far = MARGIN * em + DISC * em;
        let (disc, x) = match color {
            Color::White => (far, inset),
            Color::Black => (width - far, width - inset - line.width(fonts)),
        };
        line.draw(canvas, fonts, x, middle);
        let is_on_turn = content.to_move == Some(color);
        draw_disc(canvas, tone, color, is_on_turn, (disc, middle), em);
    }
}

/// `GM Carlsen 2851`.
fn name(fonts: &Fonts, tone: &Tone, player: &Player, with_clock: bool) -> Vec<Span> {
    let quiet = |text| Span::new(fonts, text, Weight::Regular, tone.quiet).scaled(0.86).spare();
    let mut spans = vec![
        quiet(&player.title),
        Span::new(fonts, &player.name, Weight::Bold, tone.ink),
        quiet(&player.rating),
    ];
    if with_clock {
        spans.push(Span::new(fonts, &player.clock, Weight::Regular, tone.ink).tabular());
    }
    spans
}

/// The player's colour; with a ring about it for the one to move.
fn draw_disc(
    canvas: &mut Canvas,
    tone: &Tone,
    color: Color,
    is_on_turn: bool,
    (x, y): (f32, f32),
    em: f32,
) {
    let radius = DISC * em;
    let line = (em / 14.0).max(1.0);
    let mut ring = |radius, ink| canvas.fill_round(Area::disc(x, y, radius), radius, ink);
    if is_on_turn {
        let around = line.max(em / 9.0);
        ring(radius + 2.0 * around, tone.accent);
        ring(radius + around, tone.ground);
    }
    ring(radius, tone.outline);
    let ink = color.fold_wb(tone.white, tone.black);
    ring(if ink == tone.outline { radius } else { radius - line }, ink);
}

/// The second row: clocks, and between them the result and the tournament.
struct Lower {
    clocks: [Line; 2],
    middle: Line,
}

impl Lower {
    fn new(fonts: &Fonts, tone: &Tone, content: &Content, size: f32) -> Lower {
        let clock = |color: Color| {
            let text = &content.players[color.fold_wb(0, 1)].clock;
            let is_running = content.to_move == Some(color);
            let ink = if is_running { tone.ink } else { tone.quiet };
            Line::new(vec![Span::new(fonts, text, Weight::Regular, ink).tabular()], 0.0, size * 1.1)
        };
        let result = Span::new(fonts, &content.result, Weight::Bold, tone.ink).scaled(1.12);
        let event = Span::new(fonts, &content.occasion.join(" · "), Weight::Regular, tone.quiet);
        Lower {
            clocks: [clock(Color::White), clock(Color::Black)],
            middle: Line::new(vec![result, event], 0.7, size),
        }
    }

    fn is_empty(&self) -> bool {
        self.middle.is_empty() && self.clocks.iter().all(Line::is_empty)
    }

    fn draw(self, canvas: &mut Canvas, fonts: &Fonts, inset: f32, middle: f32) {
        let width = canvas.width();
        let [white, black] = self.clocks;
        let side = white.width(fonts).max(black.width(fonts));
        let taken = if side > 0.0 { inset + side * 1.3 } else { inset / 2.0 };
        let line = self.middle.fitted(fonts, (width - 2.0 * taken).max(0.0));
        line.draw(canvas, fonts, ((width - line.width(fonts)) / 2.0).round(), middle);
        white.draw(canvas, fonts, inset, middle);
        let x = width - inset - black.width(fonts);
        black.draw(canvas, fonts, x, middle);
    }
}
