//! Pictures one after the other: what nothing has changed is not traced again.
//!
//! Of the pictures to come it is known which bodies come and go in them: those are the [`Cast`]. While the first
//! picture is traced, each ray tells which of them it meets, and which it would meet if they were there. So each
//! pixel has a set of those whose coming or going may change it, and no other pixel is ever changed by that. What
//! is kept is the picture of all that stands. What is there in one picture alone, say a piece on its way, is laid
//! over it: its pixels are painted once more, and not kept.

use image::DynamicImage;

use super::cast::{Cast, Stand, change};
use super::exposure::{Exposed, Exposure};
use super::mask::Mask;
use super::oracle;
use super::phong::{Phong, Seen};
use super::pixel::{self, Stored};
use super::plane::Plane;
use super::samples::Sum;
use super::sampling::Sampling;
use super::shelf::Shelf;
use super::silhouette::silhouette;
use super::sizes::Sizes;
use super::sketch::{Overlay, Painter, Sketch};
use super::studio::Studio;
use super::ties::Ties;
use super::world::World;
use super::{Antialiasing, RayCounts};
use crate::scene::Scene;

/// Traces pictures of one size one after the other.
pub struct Tracer {
    size: [u32; 2],
    mode: Antialiasing,
    shelf: Shelf,
    /// 1, but in a test.
    share: f64,
    /// How many pictures to come are looked at; few, where what was told of them was not true.
    ahead: usize,
    last: Option<Last>,
}

/// No more pictures than these are looked at.
const FARTHEST: usize = 512;

/// What is known of the last picture.
struct Last {
    cast: Cast,
    /// What stood in it, and which members of the cast are among that.
    scene: Scene,
    present: u128,
    kept: Kept,
    /// What stood in it, as a picture.
    picture: DynamicImage,
}

/// What stood in the last picture.
enum Kept {
    Phong(Sketch<Seen, Stored>),
    Studio(Sketch<Sum, Exposed>),
}

/// What painters keep of a pixel.
trait Keeps: Copy + Send + Sync {
    type Work: Copy + Send + Sync;
    fn kept(sketch: Sketch<Self, Self::Work>) -> Kept;
    fn sketch(kept: &mut Kept) -> Option<&mut Sketch<Self, Self::Work>>;
}

/// What is to be done by the painter of a scene.
trait Job {
    type Done;
    fn with<L: Keeps>(
        self,
        painter: &impl Painter<Look = L, Work = L::Work>,
    ) -> (Self::Done, RayCounts);
}

impl Tracer {
    /// For pictures of `width` × `height` pixels.
    pub fn new(width: u32, height: u32, mode: Antialiasing) -> Tracer {
        Tracer {
            size: [width, height],
            mode,
            shelf: Shelf::default(),
            share: 1.0,
            ahead: FARTHEST,
            last: None,
        }
    }

    /// For a test: the same, with the bodies that rays look out for made smaller by the factor `share`. What
    /// changes is then overlooked, and pictures are wrong.
    #[doc(hidden)]
    pub fn shrunk(self, share: f64) -> Tracer {
        Tracer { share, ..self }
    }

    /// Traces `scene` on the threads of the current pool; those that are `coming` are likely to be asked for
    /// next, in their order. The picture has an alpha channel (not multiplied into its colours) when the scene
    /// has no background. It is the same, to the bit, whatever was traced before, and whatever comes.
    pub fn picture(
        &mut self,
        scene: &Scene,
        coming: impl IntoIterator<Item = Scene>,
    ) -> (DynamicImage, RayCounts) {
        let was_told = self.last.as_ref().is_none_or(|last| last.cast.is_of_use());
        let known = self.last.take().and_then(|mut last| {
            let stand = last.cast.stand(scene, last.present)?;
            let changed = change((&last.scene, last.present), (&stand.scene, stand.present))?;
            Some((last, stand, changed))
        });
        let is_transparent = scene.background.is_none();
        let (cast, stand, mut kept, standing, mut counts) = match known {
            Some((Last { cast, mut kept, mut picture, .. }, stand, changed)) => {
                let mut counts = RayCounts::default();
                if !changed.is_empty() {
                    let job = Repaint(&mut kept, &changed);
                    let (mask, rays) = self.paint(&stand.scene, Some(&cast), job);
                    let pixels = kept.picture();
                    pixel::set(&mut picture, mask.spots().map(|spot| (spot, pixels.at(spot))));
                    counts = rays;
                }
                (cast, stand, kept, picture, counts)
            }
            None => {
                self.ahead = if was_told { (2 * self.ahead).min(FARTHEST) } else { 1 };
                let coming = coming.into_iter().take(self.ahead);
                let mut cast = Cast::new(scene, coming).shrunk(self.share);
                let stand = cast.stand(scene, 0);
                let Some(stand) = stand.filter(|_| cast.pictures() > 1) else {
                    let (kept, counts) = self.whole(scene, None);
                    return (pixel::picture(kept.picture(), is_transparent), counts);
                };
                let (kept, counts) = self.whole(&stand.scene, Some(&cast));
                let picture = pixel::picture(kept.picture(), is_transparent);
                (cast, stand, kept, picture, counts)
            }
        };
        let mut picture = standing.clone();
        if stand.over != 0 {
            let over = Ties::new(0, stand.over);
            let (overlay, rays) = self.paint(scene, None, Overpaint(&mut kept, &over));
            pixel::set(&mut picture, overlay.mask.spots().zip(overlay.values));
            counts = counts + rays;
        }
        let Stand { scene, present, .. } = stand;
        self.last = Some(Last { cast, scene, present, kept, picture: standing });
        (picture, counts)
    }

    /// A whole picture.
    fn whole(&self, scene: &Scene, cast: Option<&Cast>) -> (Kept, RayCounts) {
        let others = cast.map_or(&[][..], Cast::members);
        let some = silhouette(&scene.camera, scene.objects.iter().chain(others), self.size);
        let job = Whole { some, size: self.size, keeps: cast.is_some() };
        self.paint(scene, cast, job)
    }

    /// Has something done by the painter of `scene`, who tells what depends on the members of `cast`.
    fn paint<J: Job>(&self, scene: &Scene, cast: Option<&Cast>, job: J) -> (J::Done, RayCounts) {
        let world = World::new(scene, &self.shelf, cast);
        match &scene.room {
            None => {
                let eye = Phong::new(world, self.size);
                job.with(&Sampling::new(eye, scene, self.mode))
            }
            Some(room) => {
                let sizes = Sizes::new(scene, self.mode);
                let eye = Studio::new(world, room, self.size, sizes.across());
                job.with(&Exposure::new(eye, scene, sizes))
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
    let (kept, counts) = Tracer::new(width, height, mode).whole(scene, None);
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
    let job = Whole { some: Mask::full(size), size, keeps: false };
    let (kept, counts) = match &scene.room {
        None => job.with(&Sampling::new(oracle::Phong::new(scene, size), scene, mode)),
        Some(room) => {
            let sizes = Sizes::new(scene, mode);
            let eye = oracle::Studio::new(scene, room, size, sizes.across());
            job.with(&Exposure::new(eye, scene, sizes))
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

    fn sketch<L: Keeps>(&mut self) -> &mut Sketch<L, L::Work> {
        L::sketch(self).expect("a scene with a room is never taken for one without")
    }
}

impl Keeps for Seen {
    type Work = Stored;

    fn kept(sketch: Sketch<Seen, Stored>) -> Kept {
        Kept::Phong(sketch)
    }

    fn sketch(kept: &mut Kept) -> Option<&mut Sketch<Seen, Stored>> {
        if let Kept::Phong(sketch) = kept { Some(sketch) } else { None }
    }
}

impl Keeps for Sum {
    type Work = Exposed;

    fn kept(sketch: Sketch<Sum, Exposed>) -> Kept {
        Kept::Studio(sketch)
    }

    fn sketch(kept: &mut Kept) -> Option<&mut Sketch<Sum, Exposed>> {
        if let Kept::Studio(sketch) = kept { Some(sketch) } else { None }
    }
}

struct Whole {
    /// The pixels that can show a body.
    some: Mask,
    size: [u32; 2],
    keeps: bool,
}

impl Job for Whole {
    type Done = Kept;

    fn with<L: Keeps>(self, painter: &impl Painter<Look = L, Work = L::Work>) -> (Kept, RayCounts) {
        let (sketch, counts) = Sketch::new(painter, &self.some, self.size, self.keeps);
        (L::kept(sketch), counts)
    }
}

struct Repaint<'a>(&'a mut Kept, &'a Ties);

impl Job for Repaint<'_> {
    type Done = Mask;

    fn with<L: Keeps>(self, painter: &impl Painter<Look = L, Work = L::Work>) -> (Mask, RayCounts) {
        self.0.sketch().repaint(painter, self.1)
    }
}

struct Overpaint<'a>(&'a mut Kept, &'a Ties);

impl Job for Overpaint<'_> {
    type Done = Overlay;

    fn with<L: Keeps>(
        self,
        painter: &impl Painter<Look = L, Work = L::Work>,
    ) -> (Overlay, RayCounts) {
        self.0.sketch().overpaint(painter, self.1)
    }
}
