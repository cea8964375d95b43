//! The strip below a scene.
//!
//! White's name stands on the left and Black's on the right, each behind a disc of its colour, the
//! move between them; clocks and the tournament in a second row. The bar of a judgement runs along
//! the upper edge. In a narrow picture the same stands in four rows below each other.

use super::bar::{self, Chip, Gauge};
use super::canvas::{Area, Canvas, Ink};
use super::font::{Fonts, Weight};
use super::measures::{Measures, Rows};
use super::text::{LEAST, Line, Span};
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

/// White between the move and the number behind it.
const BESIDE_NUMBER: f32 = 0.55;

/// Between the parts of a name, in ems.
const GAP: f32 = 0.34;

/// The widest move that is usual; at its smallest it always has room between the names.
const WIDEST: &str = "99… Rdxd8=Q+!!";
/// As for numbers that speak of a position.
const WIDEST_NUMBER: &str = "+10.0";

/// As for times left.
const WIDEST_CLOCK: &str = "0:00:00";

/// The largest share of a row that is kept free for the move.
const MIDDLE: f32 = 0.5;

/// What there is to draw with and what is to be said, for all parts of a strip.
struct Strip<'a> {
    fonts: &'a Fonts,
    tone: &'a Tone,
    content: &'a Content,
    /// Pixels an em of the upper row.
    em: f32,
}

/// Draws on a canvas that is the strip, of the ground's colour; the move has its place kept if moves
/// are told at all.
pub fn draw(canvas: &mut Canvas, fonts: &Fonts, tone: &Tone, content: &Content, tells_moves: bool) {
    let (width, height) = (canvas.width(), canvas.height());
    let Measures { em, rows } = Measures::of(width, height);
    let bar = (BAR * em).round().max(2.0);
    let edge = Area { left: 0.0, top: 0.0, right: width, bottom: bar };
    match &content.gauge {
        Some(gauge) => bar::draw(canvas, tone, edge, hairline(em), gauge),
        None => canvas.fill(Area { bottom: hairline(em), ..edge }, tone.rule),
    }
    let strip = Strip { fonts, tone, content, em };
    let down = |share: f32| bar + share * (height - bar);
    let has_second = content.has_clocks || !strip.event().is_empty();
    match rows {
        Rows::Four if !strip.is_nameless() => {
            strip.list(canvas, [0.15, 0.385, 0.63, 0.86].map(down))
        }
        Rows::One => strip.upper_row(canvas, down(0.485), tells_moves, true),
        Rows::Two | Rows::Four if has_second => {
            strip.upper_row(canvas, down(0.355), tells_moves, false);
            strip.lower_row(canvas, down(0.72));
        }
        Rows::Two | Rows::Four => strip.upper_row(canvas, down(0.485), tells_moves, false),
    }
}

/// The thickness of a fine line, in whole pixels.
pub fn hairline(em: f32) -> f32 {
    (em / 24.0).round().max(1.0)
}

const COLORS: [Color; 2] = [Color::White, Color::Black];

impl Strip<'_> {
    /// Names and the move between them; with the clocks where there is no second row.
    ///
    /// How large the names are does not depend on the move: they stand still throughout a film.
    fn upper_row(&self, canvas: &mut Canvas, middle: f32, tells_moves: bool, with_clocks: bool) {
        let Strip { fonts, content, em, .. } = *self;
        let (width, inset, apart) = (canvas.width(), self.inset(), APART * em);
        let kept = self.kept(tells_moves).min(MIDDLE * width);
        let beside = if kept > 0.0 { kept / 2.0 + apart } else { apart / 2.0 };
        let room = width / 2.0 - beside - inset;
        let clocks = self.clocks(em);
        let gap = GAP * em;
        let cell = self.cell(em) + gap;
        let has_cell = with_clocks && content.has_clocks && cell <= room;
        let cell = if has_cell { cell } else { 0.0 };
        let lines = self.names(room - cell);
        for ((color, player), (line, clock)) in
            COLORS.into_iter().zip(&content.players).zip(lines.iter().zip(&clocks))
        {
            let (far, end) = ((MARGIN + DISC) * em, width - inset);
            let (disc, x, clock_x) = match color {
                Color::White => (far, inset, inset + line.width(fonts) + gap),
                Color::Black => {
                    (width - far, end - cell - line.width(fonts), end - clock.width(fonts))
                }
            };
            if has_cell {
                clock.draw(canvas, fonts, clock_x, middle);
            }
            if !player.name.is_empty() {
                line.draw(canvas, fonts, x, middle);
                self.draw_disc(canvas, color, content.to_move == Some(color), (disc, middle));
            }
        }

        let longest = lines.iter().map(|line| line.width(fonts)).fold(0.0, f32::max);
        let taken = longest + cell;
        let side = if taken > 0.0 { inset + taken + apart } else { inset };
        let told = Told::new(self, width - 2.0 * side);
        let from = ((width - told.width(fonts)) / 2.0).round();
        told.draw(self, canvas, from, middle);
        if let Some(color) = content.to_move.filter(|_| self.is_nameless() && !told.is_empty()) {
            self.draw_disc(canvas, color, false, (from - 0.9 * em, middle));
        }
    }

    /// Clocks, and between them the result and the tournament.
    fn lower_row(&self, canvas: &mut Canvas, middle: f32) {
        let Strip { fonts, em, .. } = *self;
        let width = canvas.width();
        let inset = if self.is_nameless() { MARGIN * em } else { self.inset() };
        let size = 1.1 * SMALL * em;
        let [white, black] = self.clocks(size);
        let side = self.cell(size);
        let taken = if side > 0.0 { inset + side * 1.3 } else { inset / 2.0 };
        let line = self.event().fitted(fonts, (width - 2.0 * taken).max(0.0));
        line.draw(canvas, fonts, ((width - line.width(fonts)) / 2.0).round(), middle);
        white.draw(canvas, fonts, inset, middle);
        let x = width - inset - black.width(fonts);
        black.draw(canvas, fonts, x, middle);
    }

    /// All below each other, in four rows with their middles there; clocks behind their names.
    fn list(&self, canvas: &mut Canvas, [white, black, moved, event]: [f32; 4]) {
        let Strip { fonts, content, em, .. } = *self;
        let (inset, end) = (self.inset(), canvas.width() - MARGIN * em);
        let clocks = self.clocks(em);
        let side = self.cell(em);
        let taken = if side > 0.0 { side + APART * em } else { 0.0 };
        let names = self.names(end - inset - taken);
        let rows = COLORS.into_iter().zip([white, black]).zip(names.iter().zip(&clocks));
        for ((color, middle), (name, clock)) in rows {
            let is_on_turn = content.to_move == Some(color);
            self.draw_disc(canvas, color, is_on_turn, ((MARGIN + DISC) * em, middle));
            name.draw(canvas, fonts, inset, middle);
            clock.draw(canvas, fonts, end - clock.width(fonts), middle);
        }
        Told::new(self, end - inset).draw(self, canvas, inset, moved);
        self.event().fitted(fonts, end - inset).draw(canvas, fonts, inset, event);
    }

    /// From the strip's edge to a name, in pixels.
    fn inset(&self) -> f32 {
        (MARGIN + 2.0 * DISC + BESIDE_DISC) * self.em
    }

    fn is_nameless(&self) -> bool {
        self.content.players.iter().all(|player| player.name.is_empty())
    }

    /// The width that is kept free for the move and its number, the same throughout a film.
    fn kept(&self, tells_moves: bool) -> f32 {
        let Strip { fonts, tone, em, .. } = *self;
        let moved = if tells_moves { LEAST * self.moved(WIDEST).width(fonts) } else { 0.0 };
        let number = |gauge: &Gauge| {
            let widest = Gauge { label: WIDEST_NUMBER.to_owned(), ..*gauge };
            Chip::new(fonts, tone, &widest, SMALL * em).map(|chip| chip.width(fonts))
        };
        let number = self.content.gauge.as_ref().and_then(number).unwrap_or(0.0);
        let between = if moved > 0.0 && number > 0.0 { BESIDE_NUMBER * em } else { 0.0 };
        moved + between + number
    }

    fn moved(&self, text: &str) -> Line {
        Line::new(vec![Span::new(self.fonts, text, Weight::Bold, self.tone.ink)], 0.0, self.em)
    }

    /// `GM Carlsen 2851` of both players, each in so many pixels.
    fn names(&self, room: f32) -> [Line; 2] {
        let Strip { fonts, tone, content, em } = *self;
        let names = content.players.each_ref();
        let lines = names.map(|player| Line::new(name(fonts, tone, player), GAP, em));
        Line::both_fitted(lines, fonts, room.max(0.0))
    }

    /// The width that is kept free for a clock, in pixels; the same throughout a film, but for
    /// times of ten hours and more.
    fn cell(&self, size: f32) -> f32 {
        let widest = self.clock(WIDEST_CLOCK, self.tone.ink, size).width(self.fonts);
        let clocks = self.clocks(size).map(|clock| clock.width(self.fonts));
        if self.content.has_clocks { clocks.into_iter().fold(widest, f32::max) } else { 0.0 }
    }

    fn clock(&self, text: &str, ink: Ink, size: f32) -> Line {
        let span = Span::new(self.fonts, text, Weight::Regular, ink).tabular();
        Line::new(vec![span], 0.0, size)
    }

    fn clocks(&self, size: f32) -> [Line; 2] {
        let Strip { tone, content, .. } = *self;
        COLORS.map(|color| {
            let text = &content.players[color.fold_wb(0, 1)].clock;
            let is_running = content.to_move == Some(color);
            let ink = if is_running { tone.ink } else { tone.quiet };
            self.clock(text, ink, size)
        })
    }

    /// The result and the tournament.
    fn event(&self) -> Line {
        let Strip { fonts, tone, content, em } = *self;
        let result = Span::new(fonts, &content.result, Weight::Bold, tone.ink).scaled(1.12);
        let event = Span::new(fonts, &content.occasion.join(" · "), Weight::Regular, tone.quiet);
        Line::new(vec![result, event], 0.7, SMALL * em)
    }

    /// The player's colour; with a ring about it for the one to move.
    fn draw_disc(&self, canvas: &mut Canvas, color: Color, is_on_turn: bool, (x, y): (f32, f32)) {
        let Strip { tone, em, .. } = *self;
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
}

/// The move, and the number of the position behind it.
struct Told {
    moved: Line,
    chip: Option<Chip>,
    /// White between them.
    between: f32,
}

impl Told {
    /// In so many pixels: where there is no room for both, the move stays.
    fn new(strip: &Strip, room: f32) -> Told {
        let Strip { fonts, tone, content, em } = *strip;
        let moved = strip.moved(&content.moved);
        let between = if moved.is_empty() { 0.0 } else { BESIDE_NUMBER * em };
        let chip =
            content.gauge.as_ref().and_then(|gauge| Chip::new(fonts, tone, gauge, SMALL * em));
        let rest = |chip: &Chip| room - chip.width(fonts) - between;
        let chip = chip.filter(|chip| moved.fits(fonts, rest(chip)));
        let moved = moved.fitted(fonts, chip.as_ref().map_or(room, rest));
        Told { moved, between: if chip.is_some() { between } else { 0.0 }, chip }
    }

    fn is_empty(&self) -> bool {
        self.moved.is_empty() && self.chip.is_none()
    }

    fn width(&self, fonts: &Fonts) -> f32 {
        let chip = self.chip.as_ref().map_or(0.0, |chip| chip.width(fonts));
        self.moved.width(fonts) + self.between + chip
    }

    fn draw(&self, strip: &Strip, canvas: &mut Canvas, x: f32, middle: f32) {
        let Strip { fonts, tone, .. } = *strip;
        self.moved.draw(canvas, fonts, x, middle);
        if let Some(chip) = &self.chip {
            let x = x + self.moved.width(fonts) + self.between;
            chip.draw(canvas, fonts, tone, x, middle);
        }
    }
}

/// `GM Carlsen 2851`.
fn name(fonts: &Fonts, tone: &Tone, player: &Player) -> Vec<Span> {
    let quiet = |text| Span::new(fonts, text, Weight::Regular, tone.quiet).scaled(0.86).spare();
    vec![
        quiet(&player.title),
        Span::new(fonts, &player.name, Weight::Bold, tone.ink),
        quiet(&player.rating),
    ]
}
