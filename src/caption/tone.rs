//! The colours of words and what is behind them.

use glam::DVec3;

use super::canvas::Ink;
use crate::config;

/// One set of colours.
pub struct Tone {
    /// Behind the words.
    pub ground: Ink,
    /// Words that matter, and those that matter less.
    pub ink: Ink,
    pub quiet: Ink,
    /// Rules between them.
    pub rule: Ink,
    /// The player to move.
    pub accent: Ink,
    /// White's colour, Black's, and a line round what would melt into the ground.
    pub white: Ink,
    pub black: Ink,
    pub outline: Ink,
    /// Ground and letters of a number that speaks for White, and of one that speaks for Black.
    pub chip_white: (Ink, Ink),
    pub chip_black: (Ink, Ink),
    /// How much of a card's picture is covered by the ground, 0 to 1.
    pub veil: f32,
}

const DARK: Tone = Tone {
    ground: [23, 23, 25],
    ink: [240, 238, 233],
    quiet: [158, 156, 152],
    rule: [62, 61, 60],
    accent: [217, 164, 74],
    white: [236, 233, 226],
    black: [66, 65, 64],
    outline: [128, 126, 122],
    chip_white: ([236, 233, 226], [23, 23, 25]),
    chip_black: ([66, 65, 64], [240, 238, 233]),
    veil: 0.80,
};

const LIGHT: Tone = Tone {
    ground: [248, 247, 244],
    ink: [26, 26, 28],
    quiet: [104, 102, 98],
    rule: [214, 211, 205],
    accent: [190, 122, 20],
    white: [255, 255, 255],
    black: [44, 43, 42],
    outline: [120, 118, 114],
    chip_white: ([226, 223, 217], [26, 26, 28]),
    chip_black: ([44, 43, 42], [248, 247, 244]),
    veil: 0.86,
};

/// A background so light, of white, asks for dark words.
const IS_LIGHT: f64 = 0.6;

impl Tone {
    /// The tone of the settings, or the one that suits a background as it is written to pictures;
    /// dark where there is none.
    pub fn new(tone: config::Tone, background: Option<DVec3>) -> Tone {
        let is_light = match tone {
            config::Tone::Light => true,
            config::Tone::Dark => false,
            config::Tone::Auto => {
                background.is_some_and(|color| color.element_sum() / 3.0 > IS_LIGHT)
            }
        };
        if is_light { LIGHT } else { DARK }
    }
}
