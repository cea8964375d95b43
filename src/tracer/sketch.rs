//! A picture under way, in two passes, and what each pixel of it depends on.

use super::RayCounts;
use super::mask::Mask;
use super::pixel::Stored;
use super::plane::{Plane, Spot};
use super::record::Record;
use super::ties::Ties;

/// A way to paint pixels: a first look at each; then work, which may depend on the first looks at the pixels round it;
/// then what it shows, which they may change even where the work would be the same.
pub trait Painter: Sync {
    type Look: Copy + Send + Sync;
    type Work: Copy + Send + Sync;

    /// What is found where no body can be, the work on it, and what the pixel then shows.
    fn nothing(&self) -> (Self::Look, Self::Work, Stored);

    /// Whether there is a first look at all.
    fn looks_first(&self) -> bool;

    /// Appends the first looks at pixels, and if it is asked for what they depend on.
    fn look(
        &self,
        spots: &[Spot],
        made: &mut Vec<Self::Look>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts;

    /// Appends the work on pixels, and if it is asked for what this depends on besides their first
    /// looks, which is `first`, and those of the pixels round them.
    fn work(
        &self,
        spots: &[Spot],
        looks: &Plane<Self::Look>,
        made: &mut Vec<Self::Work>,
        first: Option<&Plane<Ties>>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts;

    /// Whether work on a pixel is known to come to `work` still, after other first looks at the pixels round it: its
    /// own, and all that rays of the work can meet, are as they were.
    fn is_done(&self, spot: Spot, looks: &Plane<Self::Look>, work: &Self::Work) -> bool;

    /// What a pixel shows after that work.
    fn finish(&self, spot: Spot, looks: &Plane<Self::Look>, work: &Self::Work) -> Stored;

    /// How far off, in columns and rows, pixels are whose first looks count for a pixel.
    fn reach(&self) -> u32;

    /// Rays that a pixel counts for where no body can be.
    fn rays(&self) -> u64;
}

/// A picture with what is known of its pixels.
pub struct Sketch<L, W> {
    looks: Plane<L>,
    pub picture: Plane<Stored>,
    kept: Option<Kept<W>>,
}

/// What is kept of pixels for later.
struct Kept<W> {
    works: Plane<W>,
    /// What their first looks depend on, and what their work does.
    ties: [Record; 2],
}

/// Pixels that look otherwise for a while.
#[derive(Default)]
pub struct Overlay {
    pub mask: Mask,
    /// What they show, in their order.
    pub values: Vec<Stored>,
}

/// What is to be painted anew.
struct Stale {
    /// The pixels whose first looks are to be made again, and whose work is.
    looks: Mask,
    works: Mask,
    /// These, and those that are in reach of them.
    all: Mask,
}

impl<L: Copy + Send + Sync, W: Copy + Send + Sync> Sketch<L, W> {
    /// Paints a whole picture of `size`, of which only `some` pixels can show a body. What pixels depend on is
    /// kept for later if `keeps`.
    pub fn new(
        painter: &impl Painter<Look = L, Work = W>,
        some: &Mask,
        size @ [width, height]: [u32; 2],
        keeps: bool,
    ) -> (Sketch<L, W>, RayCounts) {
        let (look, work, stored) = painter.nothing();
        let looked @ [columns, rows] = if painter.looks_first() { size } else { [0, 0] };
        let mut sketch = Sketch {
            looks: Plane::new(columns, rows, look),
            picture: Plane::new(width, height, stored),
            kept: keeps.then(|| Kept {
                works: Plane::new(width, height, work),
                ties: [Record::new(looked), Record::new(size)],
            }),
        };
        let counts = sketch.look(painter, some, true) + sketch.work(painter, some, true);
        sketch.finish(painter, some);
        let skipped = (u64::from(width) * u64::from(height) - some.count()) * painter.rays();
        (sketch, counts + RayCounts { primary: skipped, ..RayCounts::default() })
    }

    /// Paints anew what depends on `changed`, and tells which pixels that is.
    pub fn repaint(
        &mut self,
        painter: &impl Painter<Look = L, Work = W>,
        changed: &Ties,
    ) -> (Mask, RayCounts) {
        let stale = self.stale(changed, painter.reach());
        let counts = self.paint(painter, &stale, true);
        (stale.all, counts)
    }

    /// What the picture is when `over` is laid over it, without a change to what is kept.
    pub fn overpaint(
        &mut self,
        painter: &impl Painter<Look = L, Work = W>,
        over: &Ties,
    ) -> (Overlay, RayCounts) {
        let stale = self.stale(over, painter.reach());
        let (looks, picture) = (stale.looks.values(&self.looks), stale.all.values(&self.picture));
        let works = self.kept.as_ref().map(|kept| stale.all.values(&kept.works));
        let counts = self.paint(painter, &stale, false);
        let values = stale.all.values(&self.picture);
        stale.looks.set(&mut self.looks, &looks);
        stale.all.set(&mut self.picture, &picture);
        if let (Some(kept), Some(works)) = (&mut self.kept, works) {
            stale.all.set(&mut kept.works, &works);
        }
        (Overlay { mask: stale.all, values }, counts)
    }

    /// The pixels that depend on `changed`; all where that is not kept.
    fn stale(&self, changed: &Ties, reach: u32) -> Stale {
        let Some(Kept { ties: [first, rest], .. }) = &self.kept else {
            let full = |width, height| Mask::full([width, height]);
            let all = || full(self.picture.width, self.picture.height);
            let looks = full(self.looks.width, self.looks.height);
            return Stale { looks, works: all(), all: all() };
        };
        let (looks, mut works) = (first.stale(changed), rest.stale(changed));
        let mut all = works.clone();
        if !looks.is_empty() {
            works.add_all(&looks);
            all.add_all(&looks.grown(reach));
        }
        Stale { looks, works, all }
    }

    /// Paints some pixels, and keeps what they depend on if it `notes` that.
    fn paint(
        &mut self,
        painter: &impl Painter<Look = L, Work = W>,
        stale: &Stale,
        notes: bool,
    ) -> RayCounts {
        let mut counts = self.look(painter, &stale.looks, notes);
        let mut works = stale.all.clone();
        if let Some(Kept { works: done, .. }) = &self.kept {
            let is_done = |spot| painter.is_done(spot, &self.looks, &done.at(spot));
            works.retain(|spot| stale.works.has(spot) || !is_done(spot));
        }
        counts = counts + self.work(painter, &works, notes);
        self.finish(painter, &stale.all);
        counts
    }

    /// First looks at some pixels.
    fn look(
        &mut self,
        painter: &impl Painter<Look = L, Work = W>,
        some: &Mask,
        notes: bool,
    ) -> RayCounts {
        if !painter.looks_first() {
            return RayCounts::default();
        }
        let record = self.kept.as_mut().filter(|_| notes).map(|kept| &mut kept.ties[0]);
        fill(&mut self.looks, some, record, |spots, made, ties| painter.look(spots, made, ties))
    }

    /// Work on some pixels, which is finished too where it is not kept.
    fn work(
        &mut self,
        painter: &impl Painter<Look = L, Work = W>,
        some: &Mask,
        notes: bool,
    ) -> RayCounts {
        let looks = &self.looks;
        let Some(Kept { works, ties: [first, record] }) = &mut self.kept else {
            return fill(&mut self.picture, some, None, |spots, made, _| {
                let mut works = Vec::with_capacity(spots.len());
                let counts = painter.work(spots, looks, &mut works, None, None);
                let pairs = spots.iter().zip(&works);
                made.extend(pairs.map(|(spot, work)| painter.finish(*spot, looks, work)));
                counts
            });
        };
        fill(works, some, notes.then_some(record), |spots, made, ties| {
            let first = ties.as_ref().map(|_| &first.pixels);
            painter.work(spots, looks, made, first, ties)
        })
    }

    /// Finishes some pixels whose work was kept.
    fn finish(&mut self, painter: &impl Painter<Look = L, Work = W>, some: &Mask) {
        let (looks, Some(Kept { works, .. })) = (&self.looks, &self.kept) else {
            return;
        };
        fill(&mut self.picture, some, None, |spots, made, _| {
            made.extend(spots.iter().map(|spot| painter.finish(*spot, looks, &works.at(*spot))));
            RayCounts::default()
        });
    }
}

/// Fills some of a plane's pixels, with a record of what they depend on.
fn fill<T: Copy + Send + Sync>(
    plane: &mut Plane<T>,
    wanted: &Mask,
    mut record: Option<&mut Record>,
    make: impl Fn(&[Spot], &mut Vec<T>, Option<&mut Vec<Ties>>) -> RayCounts + Sync,
) -> RayCounts {
    let ties = record.as_mut().map(|record| &mut record.pixels);
    let counts = plane.fill(wanted, ties, make);
    record.into_iter().for_each(|record| record.update(wanted));
    counts
}
