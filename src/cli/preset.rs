//! Places that films are made for.

use clap::ValueEnum;
use lightsquare::config::{Captured, View};
use lightsquare::output::FilmFormat;

/// Where a film goes.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Preset {
    /// Feeds: MP4, 1080x1080, 30 frames a second.
    Square,
    /// Video sites: MP4, 1920x1080, 30 frames a second.
    Wide,
    /// Telephones: MP4, 1080x1920, 30 frames a second.
    Tall,
    /// Forums and chats: GIF, 480x480, 15 frames a second.
    Gif,
}

impl Preset {
    /// Width and height in pixels.
    pub fn size(self) -> (u32, u32) {
        match self {
            Preset::Square => (1080, 1080),
            Preset::Wide => (1920, 1080),
            Preset::Tall => (1080, 1920),
            Preset::Gif => (480, 480),
        }
    }

    pub fn fps(self) -> f64 {
        if self == Preset::Gif { 15.0 } else { 30.0 }
    }

    pub fn film(self) -> FilmFormat {
        if self == Preset::Gif { FilmFormat::Gif } else { FilmFormat::Mp4 }
    }

    /// The camera that fills the picture best, where it is not the usual one.
    pub fn camera(self) -> Option<View> {
        (self == Preset::Tall).then_some(View::Above)
    }

    /// Where captured pieces stay: where there is little room for the board, it gets all of it.
    pub fn captured(self) -> Option<Captured> {
        matches!(self, Preset::Tall | Preset::Gif).then_some(Captured::Gone)
    }
}
