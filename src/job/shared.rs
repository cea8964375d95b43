//! Scenes that many games of a job have in common: they are traced and compressed once.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use image::DynamicImage;

use super::fingerprint::Fingerprints;
use crate::output::RepeatedPicture;
use crate::timeline::Frame;

/// Scenes that were made lately, of the first moves of games; what comes later is hardly ever the same.
pub struct Shared<'a> {
    fingerprints: Fingerprints<'a>,
    known: Mutex<Known>,
}

#[derive(Default)]
struct Known {
    scenes: HashMap<String, Kept>,
    /// How often one was asked for, for all of them.
    asked: u64,
    bytes: usize,
}

struct Kept {
    scene: Arc<RepeatedPicture>,
    /// When it was asked for last.
    asked: u64,
}

/// So many bytes of pixels are kept at most.
const MOST_BYTES: usize = 128 << 20;

/// The half-moves after which games are different.
const OPENING: usize = 24;

impl<'a> Shared<'a> {
    pub fn new(fingerprints: Fingerprints<'a>) -> Shared<'a> {
        Shared { fingerprints, known: Mutex::default() }
    }

    /// The scene of `frame`, which is made if it is not there. Two who ask at once may both make it; it is the same.
    pub fn scene(
        &self,
        frame: &Frame,
        make: impl FnOnce() -> DynamicImage,
    ) -> Arc<RepeatedPicture> {
        if frame.ply > OPENING {
            return Arc::new(RepeatedPicture::new(make()));
        }
        let fingerprint = self.fingerprints.scene(frame);
        if let Some(scene) = self.known().find(&fingerprint) {
            return scene;
        }
        let scene = Arc::new(RepeatedPicture::new(make()));
        self.known().keep(fingerprint, &scene);
        scene
    }

    fn known(&self) -> std::sync::MutexGuard<'_, Known> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Known {
    fn find(&mut self, fingerprint: &str) -> Option<Arc<RepeatedPicture>> {
        self.asked += 1;
        let kept = self.scenes.get_mut(fingerprint)?;
        kept.asked = self.asked;
        Some(kept.scene.clone())
    }

    /// Keeps a scene; those that nobody asked for for longest make room for it.
    fn keep(&mut self, fingerprint: String, scene: &Arc<RepeatedPicture>) {
        let bytes = scene.picture().as_bytes().len();
        if bytes > MOST_BYTES {
            return;
        }
        self.bytes += bytes;
        let kept = Kept { scene: scene.clone(), asked: self.asked };
        if let Some(twin) = self.scenes.insert(fingerprint, kept) {
            self.bytes -= twin.scene.picture().as_bytes().len();
        }
        while self.bytes > MOST_BYTES {
            let oldest = self.scenes.iter().min_by_key(|(_, kept)| kept.asked);
            let Some(oldest) = oldest.map(|(fingerprint, _)| fingerprint.clone()) else { break };
            if let Some(gone) = self.scenes.remove(&oldest) {
                self.bytes -= gone.scene.picture().as_bytes().len();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(side: u32) -> Arc<RepeatedPicture> {
        Arc::new(RepeatedPicture::new(DynamicImage::new_rgb8(side, side)))
    }

    #[test]
    fn what_was_asked_for_least_lately_makes_room() {
        let mut known = Known::default();
        // Four of these are too much.
        let side = 3600;
        for name in ["a", "b", "c"] {
            known.keep(name.to_owned(), &picture(side));
            assert!(known.find("a").is_some());
        }
        known.keep("d".to_owned(), &picture(side));
        // One that is larger than all the room is not kept.
        known.keep("e".to_owned(), &picture(7000));
        let mut names: Vec<&str> = known.scenes.keys().map(String::as_str).collect();
        names.sort_unstable();
        assert_eq!(names, ["a", "c", "d"]);
        assert_eq!(known.bytes, 3 * 3 * (side * side) as usize);
    }
}
