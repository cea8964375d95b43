//! Words on pictures: a strip below the scene, and cards before and behind a game.
//!
//! A [`Caption`] knows how large pictures are and what they have to look like; a [`Content`] is what
//! one of them says. Pixels of the scene above the strip stay as they were traced.

mod bar;
mod canvas;
mod card;
mod font;
mod measures;
mod signs;
mod strip;
mod text;
mod tone;

#[cfg(test)]
mod tests;

pub use bar::Gauge;
pub use measures::CaptionError;

use std::sync::LazyLock;

use image::{DynamicImage, GenericImage, GenericImageView, Rgb, RgbImage, Rgba};

use crate::config::Config;
use crate::notation::Color;
use canvas::Canvas;
use font::Fonts;
use measures::strip_height;
use tone::Tone;

/// What a picture says. Texts that are empty are left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Content {
    /// White, and Black.
    pub players: [Player; 2],
    /// Whether times of theirs are told, be they known at this moment or not.
    pub has_clocks: bool,
    /// Whose move it is; nobody's once the game is over.
    pub to_move: Option<Color>,
    /// The move that led to the position, or is under way: `17. Rd8#`.
    pub moved: String,
    /// The tournament, where and when it was, the round; what matters most is the first.
    pub occasion: Vec<String>,
    /// `1–0`, once the game is over.
    pub result: String,
    /// How it ended: `Checkmate`.
    pub ending: String,
    /// Who stands better; `None` for a game that is not judged.
    pub gauge: Option<Gauge>,
    /// A card over the whole picture instead of a strip.
    pub card: Option<Card>,
}

/// One of the two players.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Player {
    pub name: String,
    /// Such as `GM`.
    pub title: String,
    pub rating: String,
    /// The time left, as in `1:02:03`.
    pub clock: String,
}

/// A picture of words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Card {
    /// Who plays whom, where and when.
    Title,
    /// How it ended.
    Result,
}

/// Writes on the pictures of a job.
pub struct Caption {
    width: u32,
    height: u32,
    strip: u32,
    /// Whether moves are told at all.
    tells_moves: bool,
    tone: Tone,
    /// Read when the first words are written.
    fonts: LazyLock<Fonts>,
}

impl Caption {
    /// For pictures of `config`'s size, and in a tone that suits their background.
    ///
    /// # Errors
    /// When there has to be a strip, and the pictures are too small for one.
    pub fn new(config: &Config) -> Result<Caption, CaptionError> {
        let Config { width, height, .. } = *config;
        let strip =
            if config.captions.show { strip_height(&config.captions, width, height)? } else { 0 };
        let tone = Tone::new(config.captions.tone, config.scheme().background);
        let tells_moves = config.captions.moved;
        let fonts = LazyLock::new(Fonts::new as fn() -> Fonts);
        Ok(Caption { width, height, strip, tells_moves, tone, fonts })
    }

    /// How many rows of a picture are left for the scene, at least 1.
    pub fn scene_height(&self) -> u32 {
        self.height - self.strip
    }

    /// The whole picture: a scene of the width, [`Caption::scene_height`] high, and what is said. A
    /// card is opaque, whatever the scene; so is the strip.
    pub fn draw(&self, scene: &DynamicImage, content: &Content) -> DynamicImage {
        if let Some(card) = content.card {
            let mut canvas = Canvas::new(self.flattened(scene));
            card::draw(&mut canvas, &self.fonts, &self.tone, content, card);
            return canvas.into_picture().into();
        }
        let ground = RgbImage::from_pixel(self.width, self.strip, Rgb(self.tone.ground));
        let mut canvas = Canvas::new(ground);
        if self.strip > 0 {
            strip::draw(&mut canvas, &self.fonts, &self.tone, content, self.tells_moves);
        }
        let strip = canvas.into_picture();
        match scene {
            DynamicImage::ImageRgba8(scene) => {
                let opaque = |Rgb([red, green, blue]): Rgb<u8>| Rgba([red, green, blue, 255]);
                DynamicImage::ImageRgba8(self.joined(scene, &strip, opaque))
            }
            DynamicImage::ImageRgb8(scene) => {
                DynamicImage::ImageRgb8(self.joined(scene, &strip, |color| color))
            }
            _ => DynamicImage::ImageRgb8(self.joined(&scene.to_rgb8(), &strip, |color| color)),
        }
    }

    /// `scene` over `strip`.
    fn joined<I: GenericImage>(
        &self,
        scene: &I,
        strip: &RgbImage,
        color: impl Fn(Rgb<u8>) -> I::Pixel,
    ) -> image::ImageBuffer<I::Pixel, Vec<<I::Pixel as image::Pixel>::Subpixel>> {
        let above = self.scene_height();
        image::ImageBuffer::from_fn(self.width, self.height, |x, y| {
            if scene.in_bounds(x, y) && y < above {
                scene.get_pixel(x, y)
            } else {
                color(*strip.get_pixel(x, y.saturating_sub(above)))
            }
        })
    }

    /// The scene before the tone's ground; where the strip would be, its last row goes on.
    fn flattened(&self, scene: &DynamicImage) -> RgbImage {
        let ground = self.tone.ground;
        let last = |side: u32| side.saturating_sub(1);
        RgbImage::from_fn(self.width, self.height, |x, y| {
            let (x, y) = (x.min(last(scene.width())), y.min(last(scene.height())));
            let Rgba([red, green, blue, alpha]) = scene.get_pixel(x, y);
            let over = |above: u8, below: u8| {
                let cover = u32::from(alpha);
                let sum = u32::from(above) * cover + u32::from(below) * (255 - cover);
                ((sum + 127) / 255) as u8
            };
            Rgb([over(red, ground[0]), over(green, ground[1]), over(blue, ground[2])])
        })
    }
}
