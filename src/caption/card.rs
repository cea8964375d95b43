//! Cards: a frame of words over a veiled picture, before a game or behind it.

use super::canvas::{Area, Canvas};
use super::font::{Fonts, Weight};
use super::text::{Line, Span};
use super::tone::Tone;
use super::{Card, Content, Player};

/// The em of a card's largest names: this share of the picture's shorter side, or so many pixels where
/// that is less and there is room.
const SHARE: f32 = 0.062;
const LEAST: f32 = 15.0;
const MOST: f32 = 0.1;

/// Letters that are smaller, in pixels, are not drawn.
const SMALLEST: f32 = 5.0;

/// The largest share of the width that words take.
const ROOM: f32 = 0.88;

/// What stands in a card, from the top.
enum Row {
    /// Words, and the height that they take, in ems of the card.
    Words(Line, f32),
    Rule,
}

const RULE: f32 = 1.5;

impl Row {
    fn height(&self) -> f32 {
        match self {
            Row::Words(_, height) => *height,
            Row::Rule => RULE,
        }
    }
}

/// Veils the picture on `canvas` and writes a card over it.
pub fn draw(canvas: &mut Canvas, fonts: &Fonts, tone: &Tone, content: &Content, card: Card) {
    canvas.wash(tone.ground, tone.veil);
    let side = canvas.width().min(canvas.height());
    let em = (SHARE * side).max(LEAST).min(MOST * side);
    let room = ROOM * canvas.width();
    let row = |line: Line, size: f32, height: f32| {
        (!line.is_empty() && size * em >= SMALLEST).then_some(Row::Words(line, height))
    };
    let words = |spans: Vec<Span>, size: f32, height: f32| {
        row(Line::new(spans, 0.4, size * em).fitted(fonts, room), size, height)
    };
    let quiet = |text: &str, size: f32| {
        words(vec![Span::new(fonts, text, Weight::Regular, tone.quiet)], size, 1.5 * size + 0.1)
    };
    let [white, black] = &content.players;
    let rule = || Some(Row::Rule);
    let rows = match card {
        Card::Title => {
            let names =
                [white, black].map(|player| Line::new(full_name(fonts, tone, player), 0.4, em));
            let [white, black] = Line::both_fitted(names, fonts, room);
            vec![
                quiet(content.occasion.first().map_or("", String::as_str), 0.62),
                rule(),
                row(white, 1.0, 1.45),
                quiet("–", 0.8),
                row(black, 1.0, 1.45),
                rule(),
                quiet(&content.occasion.get(1..).unwrap_or_default().join(" · "), 0.52),
            ]
        }
        Card::Result => {
            let bold = |player: &Player| Span::new(fonts, &player.name, Weight::Bold, tone.ink);
            let dash = Span::new(fonts, "–", Weight::Regular, tone.quiet);
            let spans = [bold(white), dash, bold(black)];
            let (size, height) = (0.8, 1.3);
            let line = |spans: Vec<Span>| Line::new(spans, 0.4, size * em);
            let beside = line(spans.to_vec());
            let names = if beside.fits(fonts, room) {
                vec![beside.fitted(fonts, room)]
            } else {
                let [white, dash, black] = spans.map(|span| line(vec![span]));
                let [white, black] = Line::both_fitted([white, black], fonts, room);
                vec![white, dash, black]
            };
            let names = names.into_iter().map(|line| row(line, size, height));
            let others = vec![
                words(vec![Span::new(fonts, &content.result, Weight::Bold, tone.ink)], 2.4, 3.1),
                words(
                    vec![Span::new(fonts, &content.ending, Weight::Regular, tone.ink)],
                    0.72,
                    1.1,
                ),
                rule(),
                quiet(&content.occasion.join(" · "), 0.52),
            ];
            names.chain(others).collect()
        }
    };
    let rows: Vec<Row> = without_loose_rules(rows.into_iter().flatten().collect());
    let total: f32 = rows.iter().map(Row::height).sum::<f32>() * em;
    let mut top = (canvas.height() - total) / 2.0;
    for row in rows {
        let middle = top + row.height() * em / 2.0;
        let center = canvas.width() / 2.0;
        top += row.height() * em;
        match row {
            Row::Words(line, _) => {
                let x = (center - line.width(fonts) / 2.0).round();
                line.draw(canvas, fonts, x, middle);
            }
            Row::Rule => {
                let (y, half) = (middle.round(), 1.6 * em);
                let thick = (em / 24.0).round().max(1.0);
                let area =
                    Area { left: center - half, right: center + half, top: y, bottom: y + thick };
                canvas.fill(area, tone.accent);
            }
        }
    }
}

/// A rule separates words: none stands at an end, or behind another.
fn without_loose_rules(rows: Vec<Row>) -> Vec<Row> {
    let mut kept: Vec<Row> = Vec::new();
    for row in rows {
        let is_loose = kept.last().is_none_or(|last| matches!(last, Row::Rule));
        if !(is_loose && matches!(row, Row::Rule)) {
            kept.push(row);
        }
    }
    if matches!(kept.last(), Some(Row::Rule)) {
        kept.pop();
    }
    kept
}

fn full_name(fonts: &Fonts, tone: &Tone, player: &Player) -> Vec<Span> {
    let quiet = |text| Span::new(fonts, text, Weight::Regular, tone.quiet).scaled(0.66).spare();
    vec![
        quiet(&player.title),
        Span::new(fonts, &player.name, Weight::Bold, tone.ink),
        quiet(&player.rating),
    ]
}
