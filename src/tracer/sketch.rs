//! A picture under way, in two passes, and what each pixel of it depends on.

use super::RayCounts;
use super::mask::Mask;
use super::pixel::Stored;
use super::plane::{Plane, Spot};
use super::record::Record;
use super::ties::Ties;

/// A way to paint pixels: a first look at each, and then what it shows, which may depend on the first looks at
/// the pixels round it.
pub trait Painter: Sync {
    type Look: Copy + Send + Sync;

    /// What a first look finds where no body can be, and what the pixel then shows.
    fn nothing(&self) -> (Self::Look, Stored);

    /// Whether there is a first look at all.
    fn looks_first(&self) -> bool;

    /// Appends the first looks at pixels, and if it is asked for what they depend on.
    fn look(
        &self,
        spots: &[Spot],
        made: &mut Vec<Self::Look>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts;

    /// Appends what pixels show, and if it is asked for what this depends on besides their first
    /// looks and those of the pixels round them.
    fn finish(
        &self,
        spots: &[Spot],
        looks: &Plane<Self::Look>,
        made: &mut Vec<Stored>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts;

    /// Rays that a pixel counts for where no body can be.
    fn rays(&self) -> u64;
}

/// A picture with what is known of its pixels.
pub struct Sketch<L> {
    looks: Plane<L>,
    pub picture: Plane<Stored>,
    /// What pixels depend on: their first looks, and all the rest of it; if that is kept.
    ties: Option<[Record; 2]>,
}

/// Pixels that look otherwise for a while.
#[derive(Default)]
pub struct Overlay {
    pub mask: Mask,
    /// What they show, in their order.
    pub values: Vec<Stored>,
}

impl<L: Copy + Send + Sync> Sketch<L> {
    /// Paints a whole picture of `size`, of which only `some` pixels can show a body. What pixels depend on is
    /// kept for later if `keeps`.
    pub fn new(
        painter: &impl Painter<Look = L>,
        some: &Mask,
        size @ [width, height]: [u32; 2],
        keeps: bool,
    ) -> (Sketch<L>, RayCounts) {
        let (look, stored) = painter.nothing();
        let looked @ [columns, rows] = if painter.looks_first() { size } else { [0, 0] };
        let mut sketch = Sketch {
            looks: Plane::new(columns, rows, look),
            picture: Plane::new(width, height, stored),
            ties: keeps.then(|| [Record::new(looked), Record::new(size)]),
        };
        let counts = sketch.paint(painter, some, some);
        let skipped = (u64::from(width) * u64::from(height) - some.count()) * painter.rays();
        (sketch, counts + RayCounts { primary: skipped, ..RayCounts::default() })
    }

    /// Paints anew what depends on `changed`, and tells which pixels that is.
    pub fn repaint(
        &mut self,
        painter: &impl Painter<Look = L>,
        changed: &Ties,
    ) -> (Mask, RayCounts) {
        let [first, all] = self.stale(changed);
        let counts = self.paint(painter, &first, &all);
        (all, counts)
    }

    /// What the picture is when `over` is laid over it, without a change to what is kept.
    pub fn overpaint(
        &mut self,
        painter: &impl Painter<Look = L>,
        over: &Ties,
    ) -> (Overlay, RayCounts) {
        let [first, mask] = self.stale(over);
        let (looks, picture) = (first.values(&self.looks), mask.values(&self.picture));
        let ties = self.ties.take();
        let counts = self.paint(painter, &first, &mask);
        self.ties = ties;
        let values = mask.values(&self.picture);
        first.set(&mut self.looks, &looks);
        mask.set(&mut self.picture, &picture);
        (Overlay { mask, values }, counts)
    }

    /// The pixels whose first look depends on `changed`, and those that are to be painted.
    fn stale(&self, changed: &Ties) -> [Mask; 2] {
        let Some([first, all]) = &self.ties else {
            let full = |width, height| Mask::full([width, height]);
            return [
                full(self.looks.width, self.looks.height),
                full(self.picture.width, self.picture.height),
            ];
        };
        let (looks, mut pixels) = (first.stale(changed), all.stale(changed));
        if !looks.is_empty() {
            pixels.add_all(&looks.grown());
        }
        [looks, pixels]
    }

    /// Paints some pixels: first looks at some, then what others show.
    fn paint(
        &mut self,
        painter: &impl Painter<Look = L>,
        looks: &Mask,
        pixels: &Mask,
    ) -> RayCounts {
        let (first, all) = self.ties.as_mut().map(|[first, all]| (first, all)).unzip();
        let mut counts = RayCounts::default();
        if painter.looks_first() {
            counts = fill(&mut self.looks, looks, first, |spots, made, ties| {
                painter.look(spots, made, ties)
            });
        }
        let seen = &self.looks;
        let finish = |spots: &[Spot], made: &mut Vec<Stored>, ties: Option<&mut Vec<Ties>>| {
            painter.finish(spots, seen, made, ties)
        };
        counts + fill(&mut self.picture, pixels, all, finish)
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
