//! Lines of text: how wide they are, what becomes of those that are too long, and drawing them.

use super::canvas::{Area, Canvas, Ink};
use super::font::{Face, Fonts, Shape, Weight};

/// How high capital letters are, in ems.
pub const CAPITAL: f32 = 0.727;

/// The smallest share of its size that a line is shrunk to before it is cut.
pub const LEAST: f32 = 0.8;

/// No line has room for more letters; what a file holds may be as long as it likes.
const MOST: usize = 200;

/// Letters of one kind in a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Span {
    text: String,
    weight: Weight,
    ink: Ink,
    /// Of the line's size.
    scale: f32,
    /// Whether all digits are as wide as the widest, so that a clock does not tremble.
    is_tabular: bool,
    /// Whether the line does without it where there is no room.
    is_spare: bool,
}

impl Span {
    pub fn new(fonts: &Fonts, text: &str, weight: Weight, ink: Ink) -> Span {
        let head: String = text.chars().take(MOST).collect();
        let text = fonts.face(weight).spelled(&head);
        Span { text, weight, ink, scale: 1.0, is_tabular: false, is_spare: false }
    }

    pub fn scaled(self, scale: f32) -> Span {
        Span { scale, ..self }
    }

    pub fn tabular(self) -> Span {
        Span { is_tabular: true, ..self }
    }

    pub fn spare(self) -> Span {
        Span { is_spare: true, ..self }
    }

    fn set(&self, face: &Face) -> Vec<Letter> {
        let cell = ('0'..='9').map(|digit| face.advance(digit)).fold(0.0, f32::max);
        let mut letters = Vec::new();
        let mut x = 0.0;
        let mut before = None;
        for letter in self.text.chars() {
            let advance = face.advance(letter);
            if self.is_tabular && letter.is_ascii_digit() {
                let at = x + (cell - advance) / 2.0;
                x += cell;
                letters.push(Letter { letter, at, end: x });
            } else {
                x += before.map_or(0.0, |before| face.kern(before, letter));
                letters.push(Letter { letter, at: x, end: x + advance });
                x += advance;
            }
            before = Some(letter).filter(|_| !self.is_tabular);
        }
        letters
    }
}

/// A letter of a span that is set; places are from the span's beginning, in ems.
struct Letter {
    letter: char,
    /// Of its origin.
    at: f32,
    end: f32,
}

/// How wide a span's letters are, in ems.
fn width(letters: &[Letter]) -> f32 {
    letters.last().map_or(0.0, |last| last.end)
}

/// Spans on one baseline, with `gap` ems between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    spans: Vec<Span>,
    gap: f32,
    /// Pixels an em.
    size: f32,
}

impl Line {
    /// A line of its natural size; empty spans are left out.
    pub fn new(spans: Vec<Span>, gap: f32, size: f32) -> Line {
        Line { spans: spans.into_iter().filter(|span| !span.text.is_empty()).collect(), gap, size }
    }

    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// In pixels.
    pub fn width(&self, fonts: &Fonts) -> f32 {
        let widths = self.spans.iter().map(|span| self.span_width(fonts, span));
        let gaps = self.spans.len().saturating_sub(1) as f32 * self.gap * self.size;
        widths.sum::<f32>() + gaps
    }

    fn span_width(&self, fonts: &Fonts, span: &Span) -> f32 {
        width(&span.set(fonts.face(span.weight))) * span.scale * self.size
    }

    /// The line in so many pixels: as it is, or smaller, or without its spare spans, or with its
    /// longest span cut; without that span where there is no room even for an ellipsis.
    pub fn fitted(mut self, fonts: &Fonts, room: f32) -> Line {
        while self.wants_less(fonts, room) {
            self.drop_spare();
        }
        let width = self.width(fonts);
        if width <= room {
            return self;
        }
        // A hair less: what is shrunk to fit does.
        self.size *= (0.999 * room / width).max(LEAST);
        while self.width(fonts) > room && !self.is_empty() {
            self.cut_longest(fonts, room);
        }
        self
    }

    /// Whether [`Line::fitted`] makes it smaller at most.
    pub fn fits(&self, fonts: &Fonts, room: f32) -> bool {
        self.width(fonts) * LEAST < room
    }

    /// Two lines as [`Line::fitted`] makes them, in letters of one size, and both without what one of
    /// them has no room for.
    pub fn both_fitted(lines: [Line; 2], fonts: &Fonts, room: f32) -> [Line; 2] {
        let mut lines = lines;
        while lines.iter().any(|line| line.wants_less(fonts, room)) {
            lines.iter_mut().for_each(Line::drop_spare);
        }
        let lines = lines.map(|line| line.fitted(fonts, room));
        let size = lines[0].size.min(lines[1].size);
        lines.map(|line| Line { size, ..line })
    }

    /// Whether there is no room even when it is shrunk, and it has something to do without.
    fn wants_less(&self, fonts: &Fonts, room: f32) -> bool {
        !self.fits(fonts, room) && self.spans.iter().any(|span| span.is_spare)
    }

    fn drop_spare(&mut self) {
        if let Some(spare) = self.spans.iter().position(|span| span.is_spare) {
            self.spans.remove(spare);
        }
    }

    fn cut_longest(&mut self, fonts: &Fonts, room: f32) {
        let widths = self.spans.iter().map(|span| self.span_width(fonts, span));
        let Some((longest, all)) = widths.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else {
            return;
        };
        let room = room - (self.width(fonts) - all);
        let span = &self.spans[longest];
        let face = fonts.face(span.weight);
        let mut letters = span.set(face);
        while letters.pop().is_some() {
            let Some(Letter { letter, end, .. }) = letters.last() else {
                break;
            };
            let is_end_of_word = letter.is_alphanumeric() || *letter == ')';
            let ellipsis = face.kern(*letter, '…') + face.advance('…');
            if is_end_of_word && (end + ellipsis) * span.scale * self.size <= room {
                let head = letters.iter().map(|letter| letter.letter);
                self.spans[longest].text = head.chain(['…']).collect();
                return;
            }
        }
        self.spans.remove(longest);
    }

    /// Its text, spans with blanks between them.
    #[cfg(test)]
    pub fn text(&self) -> String {
        self.spans.iter().map(|span| span.text.as_str()).collect::<Vec<_>>().join(" ")
    }

    #[cfg(test)]
    pub fn size(&self) -> f32 {
        self.size
    }

    /// Draws it from `x` on, so that the middle of its capitals is at the height `middle`.
    pub fn draw(&self, canvas: &mut Canvas, fonts: &Fonts, x: f32, middle: f32) {
        // On whole pixels feet are sharp.
        let baseline = (middle + CAPITAL * self.size / 2.0).round();
        let mut x = x;
        for span in &self.spans {
            let face = fonts.face(span.weight);
            let size = span.scale * self.size;
            let letters = span.set(face);
            for Letter { letter, at, .. } in &letters {
                draw_letter(canvas, face, (*letter, span.ink), size, x + at * size, baseline);
            }
            x += width(&letters) * size + self.gap * self.size;
        }
    }
}

fn draw_letter(
    canvas: &mut Canvas,
    face: &Face,
    (letter, ink): (char, Ink),
    size: f32,
    x: f32,
    y: f32,
) {
    match face.shape(letter) {
        Shape::Sign(bars) => {
            for bar in bars {
                let area = Area {
                    left: x + bar.left * size,
                    right: x + bar.right * size,
                    top: y - bar.top * size,
                    bottom: y - bar.bottom * size,
                };
                canvas.fill(area, ink);
            }
        }
        Shape::Glyph(glyph) => {
            if let Some(outlined) = face.outlined(glyph, size, x, y) {
                let corner = outlined.px_bounds().min;
                let (left, top) = (corner.x as i64, corner.y as i64);
                outlined.draw(|column, row, cover| {
                    canvas.blend(left + i64::from(column), top + i64::from(row), ink, cover);
                });
            }
        }
    }
}
