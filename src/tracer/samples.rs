//! The samples of a pixel, and what they come to together.

use glam::Vec3;

use super::outlook::{BOXES, Known, Outlook, POOLS, SKY, Shares};
use super::plane::Spot;
use super::ties::Ties;

/// What numbers are for: where in the pixel a sample goes through.
pub const PLACE: u32 = 0;

/// Where in the lens it does.
pub const LENS: u32 = 1;

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
    /// What its pixel depends on anyway.
    pub ties: Ties,
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

/// The samples of a pixel so far.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sum {
    pub count: u32,
    /// Linear, times what they cover.
    pub light: Vec3,
    pub cover: f32,
    /// Of the square of what they cover.
    covers: f32,
    /// How bright samples look as they are, and as of what is seen under one share of the softboxes' light.
    noises: [Noise; 2],
    pub outlook: Outlook,
    /// How bright the first look at it is under an open sky, and as of what is seen under open softboxes too.
    pub brightness: [f32; 2],
    /// Whether that look asked for the sky: half of all pixels do, for the others too.
    pub asks: bool,
}

/// How much samples differ.
#[derive(Clone, Copy, Debug, Default)]
struct Noise {
    /// Of how bright they look, and of its square.
    shown: f32,
    squares: f32,
}

impl Sum {
    /// Of open light what the samples saw of it; all of the sky's where they did not ask.
    pub fn shares(&self) -> Shares {
        own_shares(&self.outlook, self.asks)
    }

    /// Adds a sample, before a background that looks as bright as `behind`. Its error is as of what is seen
    /// under such `shares` of open light.
    pub fn add(&mut self, glimpse: &Glimpse, shares: &Shares, behind: Option<f32>) {
        let Glimpse { light, cover, mut outlook } = *glimpse;
        let ground = behind.unwrap_or(0.0) * (1.0 - cover);
        let own = outlook.under_one(SKY, light, shares);
        let one = outlook.under_one(BOXES, own, shares);
        let bright = shown(own) * cover + ground;
        self.noises[0].add(bright);
        self.noises[1].add(if one == own { bright } else { shown(one) * cover + ground });
        if cover < 1.0 {
            outlook.weigh(Vec3::splat(cover));
        }
        self.outlook.add(&outlook);
        self.count += 1;
        self.light += light * cover;
        self.cover += cover;
        if behind.is_none() {
            self.covers += cover * cover;
        }
    }

    /// Ends the first look.
    pub fn looked(&mut self, behind: Option<f32>) {
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

    /// Adds the samples of another pixel, but for their light.
    pub fn merge(&mut self, other: &Sum) {
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
    pub fn deviation(&self, known: &Known) -> f32 {
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
    pub fn error(&self, known: &Known) -> f32 {
        self.deviation(known) / (self.count as f32 - 1.0).max(1.0).sqrt()
    }
}

impl Noise {
    fn add(&mut self, shown: f32) {
        self.shown += shown;
        self.squares += shown * shown;
    }
}

/// How bright light looks, 0 to 1: a square root is near enough.
pub fn shown(light: Vec3) -> f32 {
    ((light.x + light.y + light.z) * (1.0 / 3.0)).clamp(0.0, 1.0).sqrt()
}

/// Of open light what samples of a pixel saw of it; all of the sky's where they did not ask.
pub fn own_shares(outlook: &Outlook, asks: bool) -> Shares {
    let mut shares = outlook.shares();
    if !asks {
        shares[SKY] = Some(Vec3::ONE);
    }
    shares
}
