//! Of a film's frames those that look otherwise than the one before.

use super::batch::Part;
use super::captions::GameCaptions;
use super::settings::{PictureSettings, shown_of};
use crate::caption::Content;
use crate::config::Config;
use crate::output::Cut;
use crate::timeline::{Frame, Timeline};

/// The shots of a part of a game.
#[derive(Default)]
pub struct Shots {
    /// The first frame of each.
    pub begins: Vec<usize>,
    pub cut: Cut,
}

impl Shots {
    /// Of the frames of `part`, at `fps` a second where the format has no times of its own.
    pub fn of(
        settings: &PictureSettings,
        timeline: &Timeline,
        captions: &GameCaptions,
        part: &Part,
        fps: f64,
    ) -> Shots {
        let mut begins = Vec::new();
        // What the studio compares too, before it makes a picture anew.
        let mut last: Option<(Frame, Option<Content>)> = None;
        for (index, _) in part.frames() {
            let frame = timeline.frame(index);
            let (content, shown) = (captions.of(&frame), shown_of(settings, &frame));
            let is_same = last
                .as_ref()
                .is_some_and(|(last, said)| shown.shows_the_same(last) && *said == content);
            if !is_same {
                begins.push(index);
            }
            last = Some((shown, content));
        }
        let start = timeline.begins(part.frames.start);
        let next = begins.iter().skip(1).copied().chain([part.frames.end]);
        let ends = next.map(|index| timeline.begins(index) - start).collect();
        let Config { width, height, .. } = settings.config;
        let is_transparent = settings.config.is_transparent();
        Shots { begins, cut: Cut { size: [width, height], fps, is_transparent, ends } }
    }
}
