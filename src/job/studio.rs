//! From a frame to a picture: the stage, the tracer and its threads.

use std::sync::Arc;

use image::DynamicImage;

use super::JobError;
use super::settings::{PictureSettings, shown_of};
use super::shared::Shared;
use crate::assets::Assets;
use crate::caption::{Caption, Content};
use crate::config::{Config, Render, Sampling};
use crate::output::RepeatedPicture;
use crate::scene::{self, Reach, Stage};
use crate::timeline::{Bodies, Frame};
use crate::tracer::{self, Antialiasing, RayCounts, Tracer};

/// Sets the stage for pictures with `settings` of frames that reach as far as `reach`.
pub(super) fn stage(settings: &PictureSettings, reach: Reach) -> Result<Stage, JobError> {
    let assets = Assets::load(&settings.config, &settings.set)?;
    Ok(Stage::new(&settings.config, &assets, reach)?)
}

/// The room that pieces and board take.
pub(super) fn bodies(settings: &PictureSettings) -> Result<Bodies, JobError> {
    Ok(scene::bodies(&Assets::load(&settings.config, &settings.set)?.set))
}

fn antialiasing(render: &Render) -> Antialiasing {
    let rays = render.rays;
    match render.sampling {
        Sampling::None => Antialiasing::None,
        Sampling::Grid => Antialiasing::Grid(rays),
        Sampling::Adaptive => Antialiasing::Adaptive { rays, threshold: render.threshold as f32 },
    }
}

/// The picture that was made last.
struct Shot {
    /// What of the frame can be seen.
    shown: Frame,
    scene: Arc<RepeatedPicture>,
    /// What was said on it, and the whole picture.
    said: Option<(Content, Arc<RepeatedPicture>)>,
}

/// Makes pictures of frames, on the threads of the pool that it is asked in.
pub(super) struct Studio<'a> {
    settings: &'a PictureSettings,
    /// As high as the scene is.
    stage: Stage,
    caption: Caption,
    tracer: Tracer,
    last: Option<Shot>,
    /// Scenes that other games may have too.
    shared: Option<&'a Shared<'a>>,
    rays: RayCounts,
}

impl<'a> Studio<'a> {
    pub fn new(settings: &'a PictureSettings, reach: Reach) -> Result<Studio<'a>, JobError> {
        let caption = Caption::new(&settings.config)?;
        let mut of_scene = settings.clone();
        of_scene.config.height = caption.scene_height();
        let Config { width, height, render, .. } = &of_scene.config;
        Ok(Studio {
            settings,
            stage: stage(&of_scene, reach)?,
            caption,
            tracer: Tracer::new(*width, *height, antialiasing(render)),
            last: None,
            shared: None,
            rays: RayCounts::default(),
        })
    }

    /// This studio, which takes scenes that are there already, and leaves its own.
    pub fn sharing(self, shared: &'a Shared<'a>) -> Studio<'a> {
        Studio { shared: Some(shared), ..self }
    }

    /// The picture of a frame of a film, with `content` in words if there is any. What stood still since the
    /// frame before is not traced again, as far as it is known what is `coming`. A pause is one picture many times
    /// over: it is made once.
    pub fn picture(
        &mut self,
        frame: &Frame,
        content: Option<&Content>,
        coming: impl Iterator<Item = Frame>,
    ) -> Arc<RepeatedPicture> {
        let shown = shown_of(self.settings, frame);
        let (scene, said) = match self.last.take() {
            Some(last) if shown.shows_the_same(&last.shown) => (last.scene, last.said),
            _ => (self.scene(&shown, coming), None),
        };
        let said = content.map(|content| match said {
            Some((last, picture)) if last == *content => (last, picture),
            _ => {
                let picture = self.caption.draw(scene.picture(), content);
                (content.clone(), Arc::new(RepeatedPicture::new(picture)))
            }
        });
        let picture = said.as_ref().map_or(&scene, |(_, picture)| picture).clone();
        self.last = Some(Shot { shown, scene, said });
        picture
    }

    /// The scene of a frame, from those that are shared if it is among them.
    fn scene(
        &mut self,
        frame: &Frame,
        coming: impl Iterator<Item = Frame>,
    ) -> Arc<RepeatedPicture> {
        match self.shared {
            None => Arc::new(RepeatedPicture::new(self.trace(frame, coming))),
            Some(shared) => shared.scene(frame, || self.trace(frame, coming)),
        }
    }

    /// The same picture, if it is the only one.
    pub fn single(&mut self, frame: &Frame, content: Option<&Content>) -> DynamicImage {
        let scene = self.trace_whole(&shown_of(self.settings, frame));
        match content {
            Some(content) => self.caption.draw(&scene, content),
            None => scene,
        }
    }

    /// The scene of a frame, without words; those that are `coming` are to follow.
    pub fn trace(&mut self, frame: &Frame, coming: impl Iterator<Item = Frame>) -> DynamicImage {
        let settings = self.settings;
        let frame = &shown_of(settings, frame);
        let mut last = frame.clone();
        let others = coming.map(|frame| shown_of(settings, &frame)).filter(|frame| {
            let is_other = !frame.shows_the_same(&last);
            last.clone_from(frame);
            is_other
        });
        let scenes = others.map(|frame| self.stage.scene(&frame));
        let (picture, rays) = self.tracer.picture(&self.stage.scene(frame), scenes);
        self.rays = self.rays + rays;
        picture
    }

    /// The same, whatever was traced before.
    pub fn trace_whole(&mut self, frame: &Frame) -> DynamicImage {
        let mode = antialiasing(&self.settings.config.render);
        let (width, height) = (self.settings.config.width, self.caption.scene_height());
        let (picture, rays) = tracer::render(&self.stage.scene(frame), width, height, mode);
        self.rays = self.rays + rays;
        picture
    }

    /// The room that pieces and board take.
    pub fn bodies(&self) -> &Bodies {
        self.stage.bodies()
    }

    /// All rays so far.
    pub fn rays(&self) -> RayCounts {
        self.rays
    }
}
