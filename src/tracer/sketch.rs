//! A picture under way, in two passes, and what each pixel of it depends on.

use super::RayCounts;
use super::pixel::Stored;
use super::plane::{Plane, Spot};
use super::regions::Regions;
use super::silhouette::Silhouette;

/// A way to paint pixels: a first look at each, and then what it shows, which may depend on the first looks at
/// the pixels round it.
pub trait Painter: Sync {
    type Look: Copy + Send + Sync;

    /// What a first look finds where no body can be, and what the pixel then shows.
    fn nothing(&self) -> (Self::Look, Stored);

    /// Whether there is a first look at all.
    fn looks_first(&self) -> bool;

    /// Appends the first looks at pixels, and if it is asked for the regions that they depend on.
    fn look(
        &self,
        spots: &[Spot],
        made: &mut Vec<Self::Look>,
        touched: Option<&mut Vec<Regions>>,
    ) -> RayCounts;

    /// Appends what pixels show, and if it is asked for the regions that this depends on besides their first
    /// looks' and those of the pixels round them.
    fn finish(
        &self,
        spots: &[Spot],
        looks: &Plane<Self::Look>,
        made: &mut Vec<Stored>,
        touched: Option<&mut Vec<Regions>>,
    ) -> RayCounts;

    /// Rays that a pixel counts for where no body can be.
    fn rays(&self) -> u64;
}

/// A picture with what is known of its pixels.
pub struct Sketch<L> {
    looks: Plane<L>,
    pub picture: Plane<Stored>,
    /// What pixels depend on: their first looks, and all of it; if that is kept.
    regions: Option<[Plane<Regions>; 2]>,
}

impl<L: Copy + Send + Sync> Sketch<L> {
    /// Paints a whole picture of `size`; only what `silhouette` marks can show a body. What pixels depend on is
    /// kept for later if `keeps`.
    pub fn new(
        painter: &impl Painter<Look = L>,
        silhouette: &Silhouette,
        [width, height]: [u32; 2],
        keeps: bool,
    ) -> (Sketch<L>, RayCounts) {
        let (look, stored) = painter.nothing();
        let looked = if painter.looks_first() { [width, height] } else { [0, 0] };
        let regions = |[width, height]: [u32; 2]| Plane::new(width, height, Regions::default());
        let mut sketch = Sketch {
            looks: Plane::new(looked[0], looked[1], look),
            picture: Plane::new(width, height, stored),
            regions: keeps.then(|| [regions(looked), regions([width, height])]),
        };
        // Rays that meet nothing tell where they have passed all the same.
        let is_asked = |spot: Spot| keeps || silhouette.may_show(spot);
        let counts = sketch.paint(painter, is_asked, is_asked);
        let skipped = if keeps { 0 } else { silhouette.empty([width, height]) * painter.rays() };
        (sketch, counts + RayCounts { primary: skipped, ..RayCounts::default() })
    }

    /// Paints anew what depends on `changed` regions.
    pub fn repaint(&mut self, painter: &impl Painter<Look = L>, changed: &Regions) -> RayCounts {
        let Some([first, all]) = self.stale(changed) else {
            return RayCounts::default();
        };
        self.paint(painter, |spot| first.at(spot), |spot| all.at(spot))
    }

    /// What the picture is when something is laid over it that takes the regions `over`, without a change to what
    /// is kept.
    pub fn overpaint(
        &mut self,
        painter: &impl Painter<Look = L>,
        silhouette: &Silhouette,
        over: &Regions,
    ) -> (Plane<Stored>, RayCounts) {
        let Some([first, all]) = self.stale(over) else {
            return (self.picture.clone(), RayCounts::default());
        };
        let (looks, picture) = (self.looks.saved(|spot| first.at(spot)), self.picture.clone());
        let regions = self.regions.take();
        let (nothing, empty) = painter.nothing();
        self.looks.set(|spot| first.at(spot) && !silhouette.may_show(spot), nothing);
        self.picture.set(|spot| all.at(spot) && !silhouette.may_show(spot), empty);
        let counts = self.paint(
            painter,
            |spot| first.at(spot) && silhouette.may_show(spot),
            |spot| all.at(spot) && silhouette.may_show(spot),
        );
        self.regions = regions;
        self.looks.restore(looks);
        (std::mem::replace(&mut self.picture, picture), counts)
    }

    /// The pixels whose first look depends on `changed`, and those that are to be painted; `None` if there are
    /// none.
    fn stale(&self, changed: &Regions) -> Option<[Plane<bool>; 2]> {
        let [first, all] = self.regions.as_ref()?;
        if changed.is_empty() {
            return None;
        }
        let changed = changed.words();
        let looks = first.map(|_, regions| regions.meet(&changed));
        let pixels = if looks.width == 0 {
            all.map(|_, regions| regions.meet(&changed))
        } else {
            all.map(|spot, regions| regions.meet(&changed) || looks.round(spot).any(|is| is))
        };
        Some([looks, pixels])
    }

    /// Paints some pixels: first looks at some, then what others show.
    fn paint(
        &mut self,
        painter: &impl Painter<Look = L>,
        looks: impl Fn(Spot) -> bool + Sync,
        pixels: impl Fn(Spot) -> bool + Sync,
    ) -> RayCounts {
        let [mut first, mut all] = match self.regions.take() {
            Some([first, all]) => [Some(first), Some(all)],
            None => [None, None],
        };
        let mut counts = RayCounts::default();
        if painter.looks_first() {
            counts = self.looks.fill(looks, first.as_mut(), |spots, made, touched| {
                painter.look(spots, made, touched)
            });
        }
        let seen = &self.looks;
        counts = counts
            + self.picture.fill(pixels, all.as_mut(), |spots, made, touched| {
                painter.finish(spots, seen, made, touched)
            });
        self.regions = first.zip(all).map(|(first, all)| [first, all]);
        counts
    }
}
