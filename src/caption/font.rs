//! Faces: glyphs, kerning, and letters in place of those that a font has not.

use ab_glyph::{Font, FontRef, GlyphId, OutlinedGlyph, PxScale, point};
use ttf_parser::Tag;
use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use unicode_normalization::UnicodeNormalization;

use super::signs::{self, Bar};
use crate::assets::{BOLD, REGULAR};

/// How bold letters are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    Regular,
    Bold,
}

/// The faces of a family.
pub struct Fonts {
    regular: Face,
    bold: Face,
}

impl Fonts {
    /// The faces that come with the program.
    pub fn new() -> Fonts {
        Fonts { regular: Face::new(REGULAR, 0.080), bold: Face::new(BOLD, 0.111) }
    }

    pub fn face(&self, weight: Weight) -> &Face {
        match weight {
            Weight::Regular => &self.regular,
            Weight::Bold => &self.bold,
        }
    }
}

/// One weight of a family. All lengths are in ems: shares of the size.
pub struct Face {
    font: FontRef<'static>,
    tables: ttf_parser::Face<'static>,
    /// The lookups of kerning, in their order.
    kerning: Vec<u16>,
    /// Units an em.
    units: f32,
    /// How thick the bars of signs are.
    stroke: f32,
}

/// How a character is drawn.
pub enum Shape {
    Glyph(GlyphId),
    Sign(Vec<Bar>),
}

impl Face {
    fn new(bytes: &'static [u8], stroke: f32) -> Face {
        let font = FontRef::try_from_slice(bytes).expect("the fonts that come with it can be read");
        let tables = ttf_parser::Face::parse(bytes, 0).expect("it has just been read");
        let mut kerning: Vec<u16> = tables
            .tables()
            .gpos
            .iter()
            .flat_map(|gpos| gpos.features.into_iter())
            .filter(|feature| feature.tag == Tag::from_bytes(b"kern"))
            .flat_map(|feature| feature.lookup_indices.into_iter())
            .collect();
        kerning.sort_unstable();
        kerning.dedup();
        let units = font.units_per_em().unwrap_or(1000.0);
        Face { font, tables, kerning, units, stroke }
    }

    /// Whether `letter` has a glyph, or is a sign of ours.
    pub fn has(&self, letter: char) -> bool {
        // What stands in the private area is the font's own secret, not what was written.
        let is_private = ('\u{e000}'..='\u{f8ff}').contains(&letter);
        !is_private && (self.font.glyph_id(letter).0 != 0 || signs::is_sign(letter))
    }

    /// `text` in letters that can be drawn: accents put together with their letters, what the face
    /// lacks transliterated, blanks single.
    pub fn spelled(&self, text: &str) -> String {
        let mut spelled = String::new();
        for letter in text.nfc() {
            if letter.is_whitespace() {
                spelled.push(' ');
            } else if self.has(letter) {
                spelled.push(letter);
            } else {
                let latin = deunicode::deunicode_char(letter).unwrap_or_default();
                spelled.extend(latin.chars().filter(|letter| self.has(*letter)));
            }
        }
        spelled.split_whitespace().collect::<Vec<_>>().join(" ")
    }

    pub fn shape(&self, letter: char) -> Shape {
        match signs::bars(letter, self.stroke) {
            Some(bars) => Shape::Sign(bars),
            None => Shape::Glyph(self.font.glyph_id(letter)),
        }
    }

    /// How wide a letter is.
    pub fn advance(&self, letter: char) -> f32 {
        match self.shape(letter) {
            Shape::Sign(_) => signs::ADVANCE,
            Shape::Glyph(glyph) => self.font.h_advance_unscaled(glyph) / self.units,
        }
    }

    /// How much nearer (negative) or farther apart two letters stand.
    pub fn kern(&self, left: char, right: char) -> f32 {
        let (Shape::Glyph(left), Shape::Glyph(right)) = (self.shape(left), self.shape(right))
        else {
            return 0.0;
        };
        let Some(gpos) = self.tables.tables().gpos else {
            return 0.0;
        };
        let (left, right) = (ttf_parser::GlyphId(left.0), ttf_parser::GlyphId(right.0));
        let lookups = self.kerning.iter().filter_map(|index| gpos.lookups.get(*index));
        let sums = lookups.map(|lookup| {
            let subtables = lookup.subtables.into_iter::<PositioningSubtable>();
            let pairs = subtables.filter_map(|subtable| match subtable {
                PositioningSubtable::Pair(pairs) => Some(pairs),
                _ => None,
            });
            // The first table that knows the pair has the say.
            pairs.filter_map(|pairs| kern(&pairs, left, right)).next().unwrap_or(0)
        });
        f32::from(sums.sum::<i16>()) / self.units
    }

    /// A glyph of so many pixels an em with its origin at a place of the picture; `None` for a
    /// blank.
    pub fn outlined(&self, glyph: GlyphId, size: f32, x: f32, y: f32) -> Option<OutlinedGlyph> {
        let scale = PxScale::from(size * self.font.height_unscaled() / self.units);
        self.font.outline_glyph(glyph.with_scale_and_position(scale, point(x, y)))
    }
}

fn kern(
    pairs: &PairAdjustment,
    left: ttf_parser::GlyphId,
    right: ttf_parser::GlyphId,
) -> Option<i16> {
    let index = pairs.coverage().get(left)?;
    let (first, _) = match pairs {
        PairAdjustment::Format1 { sets, .. } => sets.get(index)?.get(right)?,
        PairAdjustment::Format2 { classes, matrix, .. } => {
            matrix.get((classes.0.get(left), classes.1.get(right)))?
        }
    };
    Some(first.x_advance)
}
