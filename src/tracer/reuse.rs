//! Pictures one after the other: what nothing has changed is not traced again.
//!
//! What is kept is the picture of all that stood still, with the regions that each pixel depends on. Of the next
//! scene, bodies that are gone, or stand in other cells, or are painted otherwise change regions; pixels that
//! depend on any of these are painted anew, and kept. What is new and in no cell, say a piece on its way, is laid
//! over it: pixels that depend on a region that it takes are painted once more, and not kept. When it still is
//! there in the next picture, it has come to rest, and is kept like all else.

use image::DynamicImage;

use super::exposure::{Exposure, Sizes, Sum};
use super::oracle;
use super::phong::{Phong, Seen};
use super::pixel::{self, Stored};
use super::plane::Plane;
use super::regions::{Regions, Space};
use super::sampling::Sampling;
use super::shelf::Shelf;
use super::silhouette::Silhouette;
use super::sketch::{Painter, Sketch};
use super::studio::Studio;
use super::world::World;
use super::{Antialiasing, RayCounts};
use crate::scene::{Object, Scene, repainted};

/// Traces pictures of one size one after the other.
pub struct Tracer {
    size: [u32; 2],
    mode: Antialiasing,
    shelf: Shelf,
    /// 1, but in a test.
    reach: f32,
    last: Option<Last>,
}

/// What is known of the last picture.
struct Last {
    /// Without what was laid over it.
    scene: Scene,
    /// What was laid over it.
    over: Vec<Object>,
    kept: Option<Kept>,
}

/// What stood still in the last picture.
enum Kept {
    Phong(Sketch<Seen>),
    Studio(Sketch<Sum>),
}

/// What is to be done for a picture.
struct Change {
    /// What stands still in it.
    scene: Scene,
    changed: Regions,
    /// What is laid over it, and the regions that this takes.
    over: Vec<Object>,
    taken: Regions,
}

/// Does something with the painter of a scene.
trait Work<T> {
    fn phong(self, painter: &impl Painter<Look = Seen>) -> T;
    fn studio(self, painter: &impl Painter<Look = Sum>) -> T;
}

impl Tracer {
    /// For pictures of `width` × `height` pixels.
    pub fn new(width: u32, height: u32, mode: Antialiasing) -> Tracer {
        Tracer { size: [width, height], mode, shelf: Shelf::default(), reach: 1.0, last: None }
    }

    /// For a test: the same, with the envelopes that rays look out for made smaller by the factor `share`. What
    /// changes is then overlooked, and pictures are wrong.
    #[doc(hidden)]
    pub fn shrunk(self, share: f32) -> Tracer {
        Tracer { reach: share, ..self }
    }

    /// Traces `scene` on the threads of the current pool. The picture has an alpha channel (not multiplied into
    /// its colours) when the scene has no background. It is the same, to the bit, whatever was traced before.
    pub fn picture(&mut self, scene: &Scene) -> (DynamicImage, RayCounts) {
        let (pixels, counts) = self.pixels(scene);
        (pixel::picture(&pixels, scene.background.is_none()), counts)
    }

    fn pixels(&mut self, scene: &Scene) -> (Plane<Stored>, RayCounts) {
        let last = self.last.take();
        // A camera that has moved is likely to move on.
        let is_moving = last.as_ref().is_some_and(|last| last.scene.camera != scene.camera);
        let known = last.and_then(|last| Some((change(&last, scene)?, last.kept?)));
        let Some((change, mut kept)) = known else {
            let keeps = !is_moving;
            let (kept, counts) = self.whole(scene, keeps);
            let pixels = kept.picture().clone();
            let kept = keeps.then_some(kept);
            self.last = Some(Last { scene: scene.clone(), over: Vec::new(), kept });
            return (pixels, counts);
        };
        let mut counts = RayCounts::default();
        if !change.changed.is_empty() {
            counts = self.with_painter(&change.scene, Repaint(&mut kept, &change.changed));
        }
        let mut pixels = None;
        if !change.taken.is_empty() {
            let silhouette = Silhouette::new(scene, self.size);
            let work = Overpaint { kept: &mut kept, silhouette, taken: &change.taken };
            let (over, rays) = self.with_painter(scene, work);
            (pixels, counts) = (Some(over), counts + rays);
        }
        let pixels = pixels.unwrap_or_else(|| kept.picture().clone());
        self.last = Some(Last { scene: change.scene, over: change.over, kept: Some(kept) });
        (pixels, counts)
    }

    /// A whole picture.
    fn whole(&self, scene: &Scene, keeps: bool) -> (Kept, RayCounts) {
        let silhouette = Silhouette::new(scene, self.size);
        self.with_painter(scene, Whole { silhouette, size: self.size, keeps })
    }

    fn with_painter<T>(&self, scene: &Scene, work: impl Work<T>) -> T {
        let space = Space::new(scene.cells).shrunk(self.reach);
        let world = World::new(scene, space, &self.shelf);
        match &scene.room {
            None => {
                let eye = Phong::new(world, self.size);
                work.phong(&Sampling::new(eye, scene, self.mode))
            }
            Some(room) => {
                let sizes = Sizes::new(scene, self.mode);
                let eye = Studio::new(world, room, self.size, sizes.across());
                work.studio(&Exposure::new(eye, scene, sizes))
            }
        }
    }
}

/// Traces `scene` into a picture of `width` × `height` pixels, as [`Tracer::picture`] does.
pub fn render(
    scene: &Scene,
    width: u32,
    height: u32,
    mode: Antialiasing,
) -> (DynamicImage, RayCounts) {
    let (kept, counts) = Tracer::new(width, height, mode).whole(scene, false);
    (pixel::picture(kept.picture(), scene.background.is_none()), counts)
}

/// The same picture from the `oracle`, to within rounding.
pub fn render_by_oracle(
    scene: &Scene,
    width: u32,
    height: u32,
    mode: Antialiasing,
) -> (DynamicImage, RayCounts) {
    let size = [width, height];
    let work = Whole { silhouette: Silhouette::everywhere(size), size, keeps: false };
    let (kept, counts) = match &scene.room {
        None => work.phong(&Sampling::new(oracle::Phong::new(scene, size), scene, mode)),
        Some(room) => {
            let sizes = Sizes::new(scene, mode);
            let eye = oracle::Studio::new(scene, room, size, sizes.across());
            work.studio(&Exposure::new(eye, scene, sizes))
        }
    };
    (pixel::picture(kept.picture(), scene.background.is_none()), counts)
}

impl Kept {
    fn picture(&self) -> &Plane<Stored> {
        match self {
            Kept::Phong(sketch) => &sketch.picture,
            Kept::Studio(sketch) => &sketch.picture,
        }
    }
}

struct Whole {
    silhouette: Silhouette,
    size: [u32; 2],
    keeps: bool,
}

impl Work<(Kept, RayCounts)> for Whole {
    fn phong(self, painter: &impl Painter<Look = Seen>) -> (Kept, RayCounts) {
        let (sketch, counts) = Sketch::new(painter, &self.silhouette, self.size, self.keeps);
        (Kept::Phong(sketch), counts)
    }

    fn studio(self, painter: &impl Painter<Look = Sum>) -> (Kept, RayCounts) {
        let (sketch, counts) = Sketch::new(painter, &self.silhouette, self.size, self.keeps);
        (Kept::Studio(sketch), counts)
    }
}

struct Repaint<'a>(&'a mut Kept, &'a Regions);

impl Work<RayCounts> for Repaint<'_> {
    fn phong(self, painter: &impl Painter<Look = Seen>) -> RayCounts {
        match self.0 {
            Kept::Phong(sketch) => sketch.repaint(painter, self.1),
            Kept::Studio(_) => RayCounts::default(),
        }
    }

    fn studio(self, painter: &impl Painter<Look = Sum>) -> RayCounts {
        match self.0 {
            Kept::Studio(sketch) => sketch.repaint(painter, self.1),
            Kept::Phong(_) => RayCounts::default(),
        }
    }
}

struct Overpaint<'a> {
    kept: &'a mut Kept,
    silhouette: Silhouette,
    taken: &'a Regions,
}

impl Work<(Plane<Stored>, RayCounts)> for Overpaint<'_> {
    fn phong(self, painter: &impl Painter<Look = Seen>) -> (Plane<Stored>, RayCounts) {
        match self.kept {
            Kept::Phong(sketch) => sketch.overpaint(painter, &self.silhouette, self.taken),
            Kept::Studio(sketch) => (sketch.picture.clone(), RayCounts::default()),
        }
    }

    fn studio(self, painter: &impl Painter<Look = Sum>) -> (Plane<Stored>, RayCounts) {
        match self.kept {
            Kept::Studio(sketch) => sketch.overpaint(painter, &self.silhouette, self.taken),
            Kept::Phong(sketch) => (sketch.picture.clone(), RayCounts::default()),
        }
    }
}

/// What is to be done for `scene` after the last picture; `None` where nothing of that can be used.
fn change(last: &Last, scene: &Scene) -> Option<Change> {
    let before = &last.scene;
    let is_alike = before.camera == scene.camera
        && before.cells == scene.cells
        && before.lights == scene.lights
        && before.room == scene.room
        && before.background == scene.background
        && before.max_depth == scene.max_depth
        && before.min_weight == scene.min_weight
        && before.max_distance == scene.max_distance
        && before.snell_index == scene.snell_index;
    if !is_alike {
        return None;
    }
    let space = Space::new(scene.cells);
    let mut changed = Regions::default();
    let mut gone: Vec<&Object> = before.objects.iter().collect();
    // Those that are there still, each with whether it is; others are new.
    let mut fresh = Vec::new();
    let mut still = Vec::with_capacity(scene.objects.len());
    for object in &scene.objects {
        let found = gone.iter().position(|old| old.is_same_body(object));
        still.push(match found.map(|index| gone.remove(index)) {
            None => {
                fresh.push(object);
                false
            }
            Some(old) => {
                if !old.is_same(object) {
                    changed.add(&space.regions(object));
                }
                changed.add(&painted_otherwise(old, object, &space));
                true
            }
        });
    }
    gone.iter().for_each(|old| changed.add(&space.regions(old)));
    // What is in a cell stands; and what changes nothing more, or was there before, is at rest.
    let rests = |object: &Object, changed: &Regions| {
        space.cell(object).is_some()
            || space.regions(object).are_within(changed)
            || last.over.iter().any(|old| old.is_same(object))
    };
    let mut stands = Vec::with_capacity(fresh.len());
    for object in fresh {
        let stays = rests(object, &changed);
        if stays {
            changed.add(&space.regions(object));
        }
        stands.push(stays);
    }
    let (mut over, mut taken) = (Vec::new(), Regions::default());
    let mut stands = stands.into_iter();
    let objects = scene.objects.iter().zip(still).filter(|(object, still)| {
        if *still || stands.next() == Some(true) {
            return true;
        }
        taken.add(&space.regions(object));
        over.push((*object).clone());
        false
    });
    let objects = objects.map(|(object, _)| object.clone()).collect();
    let scene = Scene { objects, ..scene.clone() };
    Some(Change { scene, changed, over, taken })
}

/// The squares that are painted otherwise.
fn painted_otherwise(old: &Object, new: &Object, space: &Space) -> Regions {
    match (&old.paint, &new.paint) {
        (None, None) => Regions::default(),
        (Some(old), Some(new)) => Regions::of_cells(repainted(old, new)),
        _ => space.regions(new),
    }
}
