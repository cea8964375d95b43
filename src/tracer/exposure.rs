//! The studio's pictures: many samples a pixel, and more where they disagree.

use glam::Vec3;

use super::eye::Eye;
use super::outlook::{BOXES, Known, OPEN, Outlook, POOLS, SKY, Shares};
use super::pixel::{Pixel, Stored};
use super::plane::{Plane, Spot};
use super::sketch::Painter;
use super::ties::Ties;
use super::{Antialiasing, RayCounts, tone};
use crate::scene::{Rgb, Scene, linear_light};

/// What numbers are for: where in the pixel a sample goes through.
pub const PLACE: u32 = 0;

/// Where in the lens it does.
pub const LENS: u32 = 1;

/// No fewer samples are believed. With so many, pixels share out light between them.
const FEWEST: u32 = 4;

/// How far off, in pixels, others are whose first looks tell how much there is of light that is shared out.
const REACH: u32 = 2;

/// With so many times the first samples an error may be as great as the threshold.
const ENOUGH: f32 = 1.25;

/// What looks like what is beside it may err as if it had so many samples more.
const PLAIN: f32 = 2.0;

/// Pixels side by side whose brightness differs by more are looked at again: a hairline may have been
/// missed in one of them.
const CONTRAST: f32 = 0.08;

/// One bright sample among dark ones counts no more than this: fine highlights do not flicker.
const BRIGHTEST: f32 = 2.0;

/// A sample of a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub spot: Spot,
    pub index: u32,
    /// Whether it goes through the pixel's middle, being the only one.
    pub is_centered: bool,
    /// What it need not ask.
    pub known: Known,
}

/// What a single ray from the camera brings back.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Glimpse {
    /// Linear, and no brighter than one sample may be.
    pub light: Vec3,
    /// How much of the background it hides, 0 to 1.
    pub cover: f32,
    pub outlook: Outlook,
}

impl Glimpse {
    pub fn new(light: Vec3, cover: f32, outlook: Outlook) -> Glimpse {
        Glimpse { light: light.min(Vec3::splat(BRIGHTEST)), cover, outlook }
    }
}

/// Develops what an eye sees.
pub struct Exposure<E> {
    eye: E,
    sizes: Sizes,
    background: Option<Rgb>,
    /// How bright the background looks, if there is one.
    behind: Option<f32>,
}

/// How many samples pixels get.
pub struct Sizes {
    /// Of a pixel to begin with, of one that is not as simple as it seems, and at most.
    few: u32,
    first: u32,
    most: u32,
    /// The error of a pixel's mean that is small enough, of what can be shown; negative where none is.
    error: f32,
    has_lens: bool,
}

/// The samples of a pixel so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sum {
    count: u32,
    light: Vec3,
    cover: f32,
    /// Of the square of what they cover.
    covers: f32,
    /// How bright samples look as they are, and as of what is seen under one share of the softboxes' light.
    noises: [Noise; 2],
    outlook: Outlook,
    /// How bright the first look at it is under an open sky, and as of what is seen under open softboxes too.
    brightness: [f32; 2],
    /// Whether that look asked for the sky: half of all pixels do, for the others too.
    asks: bool,
}

/// Whether a pixel asks: two side by side, which make a packet, and not the two beside them.
fn asks([x, y]: Spot) -> bool {
    (x / 2 + y).is_multiple_of(2)
}

/// How much samples differ.
#[derive(Clone, Copy, Debug, Default)]
struct Noise {
    /// Of how bright they look, and of its square.
    shown: f32,
    squares: f32,
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
        Guide { known: *known, shares: Some(shared(own_shares(&own.outlook, own.asks), known)) }
    }
}

/// How bright light looks, 0 to 1: a square root is near enough.
fn shown(light: Vec3) -> f32 {
    ((light.x + light.y + light.z) * (1.0 / 3.0)).clamp(0.0, 1.0).sqrt()
}

/// Of open light what samples of a pixel saw of it; all of the sky's where they did not ask.
fn own_shares(outlook: &Outlook, asks: bool) -> Shares {
    let mut shares = outlook.shares();
    if !asks {
        shares[SKY] = Some(Vec3::ONE);
    }
    shares
}

/// The shares of light that pixels share out, all of it where nobody asked; none of what they do not share.
fn shared(shares: Shares, known: &Known) -> Shares {
    let mut shares = shares;
    for (share, is_shared) in shares.iter_mut().zip(known.pooled) {
        *share = is_shared.then(|| share.unwrap_or(Vec3::ONE));
    }
    shares
}

impl Sizes {
    /// Of a grid the number of rays alone counts; adaptive, a pixel begins with a few, and goes on while the error
    /// of its mean seems too great. Before a quarter of them it stops only where it is like the pixels beside it.
    pub fn new(scene: &Scene, mode: Antialiasing) -> Sizes {
        let (first, most, error) = match mode {
            Antialiasing::None => (1, 1, -1.0),
            Antialiasing::Grid(side) => (side * side, side * side, -1.0),
            Antialiasing::Adaptive { rays, threshold } => {
                // Samples are most even in powers of two.
                let quarter = (rays * rays / 4).max(1);
                (1 << quarter.ilog2(), rays * rays, threshold)
            }
        };
        let has_lens = scene.camera.has_lens();
        let few = if has_lens { first } else { first / 4 };
        Sizes { few: few.max(FEWEST).min(most), first, most, error, has_lens }
    }

    /// Whether pixels share out light.
    fn share_out(&self) -> bool {
        self.few == FEWEST
    }

    /// How many samples side by side make a pixel's width, as far as textures are concerned.
    pub fn across(&self) -> f64 {
        f64::from(self.first).sqrt().min(4.0)
    }

    /// Whether a pixel that had its first look needs more samples. `around` are the first looks at it and at the
    /// pixels beside it: where they spread, its own few may be alike by chance.
    fn goes_on(&self, sum: &Sum, around: &Sum, Plan { known, differs, .. }: &Plan) -> bool {
        let least = around.deviation(known) / (self.few as f32).sqrt();
        self.is_short(sum, least.max(sum.error(known)), *differs)
    }

    /// Whether it needs more than it has.
    fn wants_more(&self, sum: &Sum, Plan { known, differs, .. }: &Plan) -> bool {
        self.is_short(sum, sum.error(known), *differs)
    }

    /// An error may be the greater the more samples it took. So each sample goes where it brings most, since
    /// halving an error takes four times as many.
    fn is_short(&self, sum: &Sum, error: f32, differs: bool) -> bool {
        if sum.count >= self.most {
            return false;
        }
        if differs && sum.count < self.first {
            return true;
        }
        // What a lens blurs is made of few bright samples among many.
        let small = if self.has_lens { self.error / 2.0 } else { self.error };
        let count = sum.count as f32 + if differs { 0.0 } else { PLAIN };
        error > small * count / (ENOUGH * self.first as f32)
    }
}

impl<E: Eye<[Sample], Glimpse>> Exposure<E> {
    pub fn new(eye: E, scene: &Scene, sizes: Sizes) -> Exposure<E> {
        let behind = scene.background.map(|color| shown(linear_light(color).as_vec3()));
        Exposure { eye, sizes, background: scene.background, behind }
    }

    /// Adds samples to some of the pixels, up to the number that each of them `wanted`, and what they
    /// depend on. First samples ask everything, others go by their `guides`.
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
            for index in sum.count..wanted(sum) {
                samples.push(Sample { spot, index, is_centered, known });
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
        let reach = if self.sizes.share_out() { REACH } else { 1 };
        let asking = looks.round(spot, reach).filter(|there| there.asks);
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
        // Of what nobody asked for there is nothing to share out.
        let mut known = around.outlook.known();
        // Many samples of its own know an edge better. Where one pixel is lit and another is not there is an edge of
        // a shadow, which would be blurred.
        let is_edge = differ[OPEN] || free & hidden != 0;
        known.pooled[BOXES] &= !is_edge && self.sizes.share_out();
        let differs = differ[usize::from(known.pooled[BOXES])];
        known.pooled[SKY] &= !differs || self.sizes.share_out();
        let plan = Plan { known, differs, goes_on: false };
        Plan { goes_on: self.sizes.goes_on(own, &around, &plan), ..plan }
    }

    /// What the samples show: their light through the tone curve, over the background.
    fn developed(&self, all: &Exposed, shares: &Shares) -> Pixel {
        let light = all.outlook.under(all.light, shares);
        let cover = f64::from(all.cover) / f64::from(all.count);
        let color = if cover == 0.0 {
            Rgb::ZERO
        } else {
            tone::stored(tone::neutral((light / all.cover).as_dvec3())) * cover
        };
        match self.background {
            Some(background) => {
                let color = color + background * (1.0 - cover);
                Pixel { color, cover: 1.0 }
            }
            None => Pixel { color, cover },
        }
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
        (nothing, exposed, self.developed(&exposed, &none).stored())
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
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        let mut sums: Vec<Sum> = spots.iter().map(|spot| looks.at(*spot)).collect();
        let mut each = ties.as_ref().map(|_| vec![Ties::default(); spots.len()]);
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
            some.retain(|index| self.sizes.wants_more(&sums[*index], &plans[*index]));
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

    /// Shares that its samples did not ask for are those of all first looks round the pixel together.
    fn finish(&self, spot: Spot, looks: &Plane<Sum>, work: &Exposed) -> Stored {
        let mut shares = Shares::default();
        if work.plan.known.pooled.contains(&true) {
            shares = self.shares(spot, looks);
        }
        self.developed(work, &shared(shares, &work.plan.known)).stored()
    }

    fn reach(&self) -> u32 {
        REACH
    }

    fn rays(&self) -> u64 {
        self.sizes.few.into()
    }
}

impl Sum {
    /// Adds a sample, before a background that looks as bright as `behind`. Its error is as of what is seen
    /// under such `shares` of open light.
    fn add(&mut self, glimpse: &Glimpse, shares: &Shares, behind: Option<f32>) {
        let Glimpse { light, cover, mut outlook } = *glimpse;
        let ground = behind.unwrap_or(0.0) * (1.0 - cover);
        let own = outlook.under_one(SKY, light, shares);
        let one = outlook.under_one(BOXES, own, shares);
        let bright = shown(own) * cover + ground;
        self.noises[0].add(bright);
        self.noises[1].add(if one == own { bright } else { shown(one) * cover + ground });
        outlook.weigh(Vec3::splat(cover));
        self.outlook.add(&outlook);
        self.count += 1;
        self.light += light * cover;
        self.cover += cover;
        if behind.is_none() {
            self.covers += cover * cover;
        }
    }

    /// Ends the first look.
    fn looked(&mut self, behind: Option<f32>) {
        let cover = self.cover / self.count as f32;
        let ground = behind.unwrap_or(0.0) * (1.0 - cover);
        self.brightness = [ground; 2];
        if self.cover > 0.0 {
            let all = [Some(Vec3::ONE); POOLS];
            let own = self.outlook.under_one(SKY, self.light, &all);
            let open = self.outlook.under_one(BOXES, own, &all);
            self.brightness = [own, open].map(|light| shown(light / self.cover) * cover + ground);
        }
    }

    /// Adds the samples of another pixel.
    fn merge(&mut self, other: &Sum) {
        self.count += other.count;
        self.cover += other.cover;
        for (noise, other) in self.noises.iter_mut().zip(&other.noises) {
            noise.shown += other.shown;
            noise.squares += other.squares;
        }
        self.covers += other.covers;
        self.outlook.add(&other.outlook);
    }

    /// The standard deviation of how bright samples look that go by what is `known`, or of how much they cover of
    /// what is transparent.
    fn deviation(&self, known: &Known) -> f32 {
        let scale = 1.0 / self.count as f32;
        let variance = |sum: f32, squares: f32| {
            let mean = sum * scale;
            (squares * scale - mean * mean).max(0.0)
        };
        let Noise { shown, squares } = self.noises[usize::from(known.pooled[BOXES])];
        variance(shown, squares).max(variance(self.cover, self.covers)).sqrt()
    }

    /// The standard error of the mean, as of samples that know nothing of each other; these are more even, and
    /// err less.
    fn error(&self, known: &Known) -> f32 {
        self.deviation(known) / (self.count as f32 - 1.0).max(1.0).sqrt()
    }
}

impl Noise {
    fn add(&mut self, shown: f32) {
        self.shown += shown;
        self.squares += shown * shown;
    }
}
