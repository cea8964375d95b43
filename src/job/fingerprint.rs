//! What a picture is made of, in a few letters: where they are the same, so is the picture.

use std::fmt::{self, Debug, Write};

use sha2::{Digest, Sha256};

use super::input::read_through;
use super::settings::{PictureSettings, shown_of};
use crate::caption::Content;
use crate::scene::Reach;
use crate::timeline::Frame;

/// The version of the pictures. It goes up whenever the same settings and frame give other bytes than before.
pub const PICTURES: u32 = 1;

/// How many letters a fingerprint has, four bits each.
const LETTERS: usize = 16;

/// Takes fingerprints of what one job renders.
#[derive(Clone)]
pub struct Fingerprints<'a> {
    settings: &'a PictureSettings,
    /// All that pictures of the job have in common.
    common: Sha256,
}

impl<'a> Fingerprints<'a> {
    /// For pictures that reach as far as `reach`, with what is in the files that `settings` name.
    pub fn new(settings: &'a PictureSettings, reach: Reach) -> Fingerprints<'a> {
        let mut common = Sink(Sha256::new());
        let set = settings.set.to_string();
        common.take(&(PICTURES, env!("CARGO_PKG_VERSION"), set, &settings.config, reach));
        for path in settings.drawn_files() {
            let mut content = Sha256::new();
            // What is needed for a picture has been read before; what is not may be missing.
            let bytes = read_through(&path, |bytes| content.update(bytes));
            common.take(&bytes.ok());
            common.0.update(content.finalize());
        }
        Fingerprints { settings, common: common.0 }
    }

    /// Of what can be seen of `frame` in the scene, without words.
    pub fn scene(&self, frame: &Frame) -> String {
        self.of(&seen(self.settings, frame))
    }

    /// Of a picture's file: its scene, its words, the texts that it has within, and its format.
    pub fn picture(&self, frame: &Frame, content: Option<&Content>, rest: &impl Debug) -> String {
        self.of(&(seen(self.settings, frame), content, rest))
    }

    /// Of whatever else depends on the settings. What is printed for a programmer names every part of a value, so none
    /// can be forgotten here.
    pub fn of(&self, value: &impl Debug) -> String {
        let mut sink = Sink(self.common.clone());
        sink.take(value);
        let digest = sink.0.finalize();
        digest.iter().take(LETTERS / 2).map(|byte| format!("{byte:02x}")).collect()
    }
}

/// A frame without what makes no difference to its picture.
fn seen(settings: &PictureSettings, frame: &Frame) -> Frame {
    Frame { time: 0.0, ply: 0, card: None, ..shown_of(settings, frame) }
}

/// Takes the hash of what is written to it.
struct Sink(Sha256);

impl Sink {
    fn take(&mut self, value: &impl Debug) {
        // It takes whatever it is given.
        let _ = write!(self, "{value:?}");
    }
}

impl Write for Sink {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}
