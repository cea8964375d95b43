//! `[Captions]`: the strip of words below a scene.

use serde::Serialize;

use super::keys::{Key, key};
use super::values::{Choice, Number, YES_NO};

/// What the strip says, and how it looks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Captions {
    pub show: bool,
    /// Names, titles and ratings.
    pub players: bool,
    /// The last move, or the one under way.
    #[serde(rename = "move")]
    pub moved: bool,
    /// The tournament, where and when it was, and the result.
    pub event: bool,
    /// Who stands better.
    pub eval: bool,
    pub clocks: bool,
    /// Its share of the picture's height, 0 to 0.4; 0 for one that suits the size.
    pub height: f64,
    pub tone: Tone,
}

/// Whether words are light on dark.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Tone {
    /// As the background is.
    Auto,
    Dark,
    Light,
}

impl Default for Captions {
    fn default() -> Captions {
        Captions {
            show: false,
            players: true,
            moved: true,
            event: true,
            eval: true,
            clocks: true,
            height: 0.0,
            tone: Tone::Auto,
        }
    }
}

const TONES: Choice<Tone> =
    Choice(&[("auto", Tone::Auto), ("dark", Tone::Dark), ("light", Tone::Light)]);

pub const KEYS: [Key<Captions>; 8] = [
    key!("Show", Captions, show: YES_NO),
    key!("Players", Captions, players: YES_NO),
    key!("Move", Captions, moved: YES_NO),
    key!("Event", Captions, event: YES_NO),
    key!("Eval", Captions, eval: YES_NO),
    key!("Clocks", Captions, clocks: YES_NO),
    key!("Height", Captions, height: Number(0.0, 0.4)),
    key!("Tone", Captions, tone: TONES),
];
