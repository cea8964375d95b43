//! The studio's pictures: many samples a pixel, and more where they disagree.

use glam::Vec3;

use super::eye::Eye;
use super::outlook::{BOXES, Known, MIRROR, OPEN, Outlook, POOLS, SKY, Shares};
use super::pixel::{Stored, stored};
use super::plane::{Plane, Spot};
use super::samples::{Glimpse, Sample, Sum, own_shares, shown};
use super::sizes::Sizes;
use super::sketch::Painter;
use super::ties::Ties;
use super::{RayCounts, tone};
use crate::scene::{Rgb, Scene, linear_light};

/// Pixels side by side whose brightness differs by more are looked at again: a hairline may have been
/// missed in one of them.
const CONTRAST: f32 = 0.08;

/// Develops what an eye sees.
pub struct Exposure<E> {
    eye: E,
    sizes: Sizes,
    background: Option<Rgb>,
    /// How bright the background looks, if there is one.
    behind: Option<f32>,
}

/// Whether a pixel asks: two side by side, which make a packet, and not the two beside them.
fn asks([x, y]: Spot) -> bool {
    (x / 2 + y).is_multiple_of(2)
}

/// All samples of a pixel, but for how much they see of light that is shared out.
#[derive(Clone, Copy, Debug)]
pub struct Exposed {
    count: u32,
    light: Vec3,
    cover: f32,
    outlook: Outlook,
    /// Why there are so many of them.
    plan: Plan,
}

impl Exposed {
    fn new(sum: &Sum, plan: Plan) -> Exposed {
        let Sum { count, light, cover, outlook, .. } = *sum;
        Exposed { count, light, cover, outlook, plan }
    }
}

/// What is done about a pixel after its first look. It depends on first looks at the pixels beside it, but not
/// on all that they saw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Plan {
    /// What its samples need not ask.
    known: Known,
    /// Whether one beside it looks otherwise.
    differs: bool,
    /// Whether it gets more samples.
    goes_on: bool,
}

/// What samples of a pixel go by.
struct Guide {
    known: Known,
    /// Of open light the shares that their errors are as of; in first looks, those of the samples themselves.
    shares: Option<Shares>,
}

impl Guide {
    /// For the first look, at a pixel that `asks` for the sky or does not.
    fn first(asks: bool) -> Guide {
        let known = Known { pooled: [false, !asks], ..Known::default() };
        Guide { known, shares: None }
    }

    /// For later samples. Their errors are as of what the first look saw, not of what those beside it did: the work
    /// depends on these by its plan alone.
    fn later(own: &Sum, Plan { known, .. }: &Plan) -> Guide {
        Guide { known: *known, shares: Some(shared(own.shares(), known)) }
    }
}

/// The shares of light that pixels share out, all of it where nobody asked; none of what they do not share.
fn shared(shares: Shares, known: &Known) -> Shares {
    let mut shares = shares;
    for (share, is_shared) in shares.iter_mut().zip(known.pooled) {
        *share = is_shared.then(|| share.unwrap_or(Vec3::ONE));
    }
    shares
}

impl<E: Eye<[Sample], Glimpse>> Exposure<E> {
    pub fn new(eye: E, scene: &Scene, sizes: Sizes) -> Exposure<E> {
        let behind = scene.background.map(|color| shown(linear_light(color).as_vec3()));
        Exposure { eye, sizes, background: scene.background, behind }
    }

    /// Adds samples to some of the pixels, up to the number that each of them `wanted`, and what they
    /// depend on. They ask what their `guides` do not answer.
    fn add(
        &self,
        spots: &[Spot],
        some: &[usize],
        guides: &[Guide],
        wanted: impl Fn(&Sum) -> u32,
        sums: &mut [Sum],
        ties: Option<&mut [Ties]>,
    ) -> RayCounts {
        let is_centered = self.sizes.most == 1;
        let mut samples = Vec::new();
        for pixel in some {
            let (spot, sum) = (spots[*pixel], &sums[*pixel]);
            let known = guides[*pixel].known;
            let ties = match &ties {
                Some(ties) => ties[*pixel],
                None => Ties::default(),
            };
            for index in sum.count..wanted(sum) {
                samples.push(Sample { spot, index, is_centered, known, ties });
            }
        }
        let mut seen = Vec::with_capacity(samples.len());
        let mut each = ties.is_some().then(Vec::new);
        let counts = self.eye.see(&samples, &mut seen, each.as_mut());
        let (mut ties, mut next) = (ties, 0);
        for pixel in some {
            let sum = &mut sums[*pixel];
            let range = next..next + (wanted(sum) - sum.count) as usize;
            next = range.end;
            let seen = &seen[range.clone()];
            // Errors are as of what is seen under one share of open light, since the pixel will show it under one: that
            // of its own first look is near enough.
            let shares = guides[*pixel].shares.unwrap_or_else(|| {
                let mut outlook = Outlook::default();
                seen.iter().for_each(|glimpse| outlook.add(&glimpse.outlook));
                own_shares(&outlook, sum.asks)
            });
            seen.iter().for_each(|glimpse| sum.add(glimpse, &shares, self.behind));
            if let (Some(ties), Some(each)) = (&mut ties, &each) {
                ties[*pixel].add(&each[range].iter().collect());
            }
        }
        counts
    }

    /// Of light that is shared out the shares round a pixel; from farther off those of the sky, which changes slowly.
    fn shares(&self, spot: Spot, looks: &Plane<Sum>) -> Shares {
        let mut around = Outlook::default();
        looks.round(spot, 1).for_each(|there| around.pools[BOXES].add(&there.outlook.pools[BOXES]));
        let asking = looks.round(spot, self.sizes.reach()).filter(|there| there.asks);
        asking.for_each(|there| around.pools[SKY].add(&there.outlook.pools[SKY]));
        around.shares()
    }

    /// What first looks at a pixel and at those beside it tell.
    fn plan(&self, spot: Spot, looks: &Plane<Sum>) -> Plan {
        let own = looks.value(spot);
        let (mut around, mut free, mut hidden) = (Sum::default(), 0, 0);
        let mut differ = [false; 2];
        for there in looks.round(spot, 1) {
            free |= there.outlook.free & !there.outlook.hidden;
            hidden |= there.outlook.hidden & !there.outlook.free;
            around.merge(there);
            let pairs = there.brightness.iter().zip(&own.brightness);
            for (differs, (there, own)) in differ.iter_mut().zip(pairs) {
                *differs |= (there - own).abs() > CONTRAST;
            }
        }
        let mut known = around.outlook.known();
        // Many samples of its own know an edge better. Where one pixel is lit and another is not there is an edge of
        // a shadow, which would be blurred.
        let is_edge = differ[OPEN] || free & hidden != 0;
        known.pooled[BOXES] &= !is_edge && self.sizes.share_out();
        let differs = differ[usize::from(known.pooled[BOXES])];
        if known.pooled[BOXES] {
            // Nobody asks for single ones.
            (known.free, known.hidden) = (known.free & 1 << MIRROR, known.hidden & 1 << MIRROR);
        }
        known.pooled[SKY] = self.sizes.share_out() || (known.pooled[SKY] && !differs);
        let plan = Plan { known, differs, goes_on: false };
        Plan { goes_on: self.sizes.goes_on(own, &around, &known, differs), ..plan }
    }

    /// What the samples show: their light through the tone curve, over the background.
    fn developed(&self, all: &Exposed, shares: &Shares) -> Stored {
        let light = all.outlook.under(all.light, shares);
        let cover = f64::from(all.cover) / f64::from(all.count);
        let color = if cover == 0.0 {
            Rgb::ZERO
        } else {
            tone::stored(tone::neutral((light / all.cover).as_dvec3())) * cover
        };
        let (color, cover) = match self.background {
            Some(background) => (color + background * (1.0 - cover), 1.0),
            None => (color, cover),
        };
        stored([color.x, color.y, color.z, cover])
    }
}

impl<E: Eye<[Sample], Glimpse>> Painter for Exposure<E> {
    type Look = Sum;
    type Work = Exposed;

    fn nothing(&self) -> (Sum, Exposed, Stored) {
        let mut nothing = Sum::default();
        let none = [None; POOLS];
        (0..self.sizes.few).for_each(|_| nothing.add(&Glimpse::default(), &none, self.behind));
        nothing.looked(self.behind);
        let exposed = Exposed::new(&nothing, Plan::default());
        (nothing, exposed, self.developed(&exposed, &none))
    }

    fn looks_first(&self) -> bool {
        true
    }

    fn look(&self, spots: &[Spot], made: &mut Vec<Sum>, ties: Option<&mut Vec<Ties>>) -> RayCounts {
        made.resize(spots.len(), Sum::default());
        let ties = ties.map(|ties| {
            ties.resize(spots.len(), Ties::default());
            &mut ties[..]
        });
        for (sum, spot) in made.iter_mut().zip(spots) {
            sum.asks = asks(*spot) || !self.sizes.share_out();
        }
        let guides: Vec<Guide> = made.iter().map(|sum| Guide::first(sum.asks)).collect();
        let mut all: Vec<usize> = (0..spots.len()).collect();
        // Those that ask the same make full packets.
        all.sort_by_key(|index| made[*index].asks);
        let counts = self.add(spots, &all, &guides, |_| self.sizes.few, made, ties);
        made.iter_mut().for_each(|sum| sum.looked(self.behind));
        counts
    }

    /// Adds samples to pixels until their errors are small enough.
    fn work(
        &self,
        spots: &[Spot],
        looks: &Plane<Sum>,
        made: &mut Vec<Exposed>,
        first: Option<&Plane<Ties>>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        let mut sums: Vec<Sum> = spots.iter().map(|spot| looks.at(*spot)).collect();
        // What the first looks depend on need not be looked out for again.
        let mut each: Option<Vec<Ties>> =
            first.map(|first| spots.iter().map(|spot| first.at(*spot)).collect());
        let mut counts = RayCounts::default();
        let plans: Vec<Plan> = spots.iter().map(|spot| self.plan(*spot, looks)).collect();
        let guides: Vec<Guide> =
            sums.iter().zip(&plans).map(|(own, plan)| Guide::later(own, plan)).collect();
        let mut some: Vec<usize> = (0..spots.len()).filter(|index| plans[*index].goes_on).collect();
        // Those that ask the same make full packets.
        some.sort_by_key(|index| plans[*index].known.answered());
        while !some.is_empty() {
            let wanted = |sum: &Sum| (2 * sum.count).min(self.sizes.most);
            counts =
                counts + self.add(spots, &some, &guides, wanted, &mut sums, each.as_deref_mut());
            some.retain(|index| {
                let Plan { known, differs, .. } = &plans[*index];
                self.sizes.wants_more(&sums[*index], known, *differs)
            });
        }
        made.extend(sums.iter().zip(plans).map(|(sum, plan)| Exposed::new(sum, plan)));
        if let (Some(ties), Some(each)) = (ties, each) {
            ties.extend(each);
        }
        counts
    }

    fn is_done(&self, spot: Spot, looks: &Plane<Sum>, work: &Exposed) -> bool {
        self.plan(spot, looks) == work.plan
    }

    /// Shares that its samples did not ask for are those of all first looks round the pixel that asked, together.
    fn finish(&self, spot: Spot, looks: &Plane<Sum>, work: &Exposed) -> Stored {
        let mut shares = Shares::default();
        if work.plan.known.pooled.contains(&true) {
            shares = self.shares(spot, looks);
        }
        self.developed(work, &shared(shares, &work.plan.known))
    }

    fn reach(&self) -> u32 {
        self.sizes.reach()
    }

    fn rays(&self) -> u64 {
        self.sizes.few.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tracer::plane::Plane;

    /// In pictures of any shape that are wide enough for two pixels that ask and two that do not.
    #[test]
    fn every_pixel_has_one_in_reach_that_asks() {
        for [width, height] in [[4, 1], [1, 2], [3, 3], [9, 7]] {
            let mut plane = Plane::new(width, height, false);
            let all = || (0..width).flat_map(|x| (0..height).map(move |y| [x, y]));
            all().for_each(|spot| plane.set(spot, asks(spot)));
            for spot in all() {
                assert!(plane.round(spot, 2).any(|asks| *asks), "{spot:?} of {width} x {height}");
            }
        }
    }
}
