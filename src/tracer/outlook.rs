//! What the first samples of pixels side by side tell of the light there, so that later ones need not ask.
//!
//! Where all of them saw a softbox, or none of them did, the next sample would see no more. What stands in
//! the way of the sky changes so slowly from pixel to pixel that all of them together know it better than
//! the samples of one: also at the edges of bodies, where what they share out is what each sample would see under an
//! open sky. So does what stands in the way of softboxes, but for the edges of sharp shadows. Half of all pixels
//! ask for the sky; the others note what would come, and nothing that came.

use glam::Vec3;

use crate::lanes::{self, Mask8, Simd, U32x8, Vec3x8};

/// The bit of what a mirror sees; softboxes have those below it by their numbers. More softboxes than there
/// are bits are always asked.
pub const MIRROR: u32 = 31;

/// Light that pixels side by side may share out between them: what comes from the softboxes (those that have a bit),
/// and what comes from the sky or from what hides it.
pub const BOXES: usize = 0;
pub const SKY: usize = 1;

/// Of two things that tell how bright a pixel is, the one that is told as under open light.
pub const OPEN: usize = 1;

/// How many kinds of such light there are.
pub const POOLS: usize = 2;

/// Of each kind, how much of its open light there is, by channel; `None` where samples say it themselves.
pub type Shares = [Option<Vec3>; POOLS];

/// What samples found out where they met a surface first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outlook {
    /// Rays that nothing stood in the way of, and those that something did, a bit each.
    pub free: u32,
    pub hidden: u32,
    pub pools: [Pool; POOLS],
}

/// Light of one kind.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pool {
    /// What came, and what would have come had nothing stood in the way; both as the pixel shows them.
    pub came: Vec3,
    pub open: Vec3,
}

impl Pool {
    /// Adds what came to others.
    pub fn add(&mut self, other: &Pool) {
        self.came += other.came;
        self.open += other.open;
    }

    /// Of its open light what there really is, by channel, all of it where a channel has none; `None` where there is no
    /// open light. Those who did not ask may not be among it, or they count as dark.
    pub fn share(&self) -> Option<Vec3> {
        let is_any = self.open.cmpgt(Vec3::ZERO);
        is_any.any().then(|| Vec3::select(is_any, self.came / self.open, Vec3::ONE))
    }
}

impl Outlook {
    /// Adds what others found out.
    pub fn add(&mut self, other: &Outlook) {
        self.free |= other.free;
        self.hidden |= other.hidden;
        self.pools.iter_mut().zip(&other.pools).for_each(|(pool, other)| pool.add(other));
    }

    /// Takes of all light only that `share`, which the pixel shows.
    pub fn weigh(&mut self, share: Vec3) {
        for Pool { came, open } in &mut self.pools {
            *came *= share;
            *open *= share;
        }
    }

    /// Of each kind of light its share.
    pub fn shares(&self) -> Shares {
        self.pools.map(|pool| pool.share())
    }

    /// What becomes of `light` that has this light in it, where there are such shares of what is open. (Light is cut
    /// where it is too bright, its parts are not.)
    pub fn under(&self, light: Vec3, shares: &Shares) -> Vec3 {
        self.under_one(BOXES, self.under_one(SKY, light, shares), shares)
    }

    /// The same for one kind of light.
    pub fn under_one(&self, kind: usize, light: Vec3, shares: &Shares) -> Vec3 {
        let Pool { came, open } = self.pools[kind];
        shares[kind].map_or(light, |share| (light + (open * share - came)).max(Vec3::ZERO))
    }

    /// What need not be asked again.
    pub fn known(&self) -> Known {
        Known {
            free: self.free & !self.hidden,
            hidden: self.hidden & !self.free,
            pooled: self.pools.map(|pool| pool.share().is_some()),
        }
    }
}

/// What a sample need not ask.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Known {
    /// Rays that nothing stands in the way of, and those that something does, a bit each.
    pub free: u32,
    pub hidden: u32,
    /// By kind of light, whether it is known how much there is of what is open. Samples then have none of it in them.
    pub pooled: [bool; POOLS],
}

impl Known {
    /// Which rays need not be asked for, and whether the lights' are among them.
    pub fn answered(&self) -> ([bool; POOLS], u32) {
        (self.pooled, self.free | self.hidden)
    }
}

/// What eight samples need not ask, and what they find out.
pub struct Outlooks<S: Simd> {
    /// See [`Known`].
    known: [U32x8<S>; 2],
    pub pooled: [Mask8<S>; POOLS],
    /// See [`Outlook`].
    free: U32x8<S>,
    hidden: U32x8<S>,
    pools: [Pool8<S>; POOLS],
}

/// See [`Pool`].
#[derive(Clone, Copy)]
struct Pool8<S: Simd> {
    came: Vec3x8<S>,
    open: Vec3x8<S>,
}

impl<S: Simd> Outlooks<S> {
    #[inline(always)]
    pub fn new(known: &[Known; 8]) -> Outlooks<S> {
        let (mut free, mut hidden, mut pooled) = ([0; 8], [0; 8], [0; POOLS]);
        for (lane, known) in known.iter().enumerate() {
            (free[lane], hidden[lane]) = (known.free, known.hidden);
            for (bits, is_known) in pooled.iter_mut().zip(known.pooled) {
                *bits |= u8::from(is_known) << lane;
            }
        }
        let zero = U32x8::splat(0);
        let dark = Pool8 { came: Vec3x8::zero(), open: Vec3x8::zero() };
        Outlooks {
            known: [U32x8::load(&free), U32x8::load(&hidden)],
            pooled: [Mask8::from_bits(pooled[0]), Mask8::from_bits(pooled[1])],
            free: zero,
            hidden: zero,
            pools: [dark; POOLS],
        }
    }

    /// Where it is known that nothing stands in the way of rays of a kind, and where that something does.
    #[inline(always)]
    pub fn known(&self, bit: u32) -> [Mask8<S>; 2] {
        let [free, hidden] = self.known;
        let one = U32x8::splat(1);
        [((free >> bit) & one).eq(one), ((hidden >> bit) & one).eq(one)]
    }

    /// Notes the light of a kind that came in some lanes, and what would have come.
    #[inline(always)]
    pub fn gathered(&mut self, kind: usize, lanes: Mask8<S>, came: Vec3x8<S>, open: Vec3x8<S>) {
        let pool = &mut self.pools[kind];
        pool.came = Vec3x8::select(lanes, came, pool.came);
        pool.open = Vec3x8::select(lanes, open, pool.open);
    }

    /// Takes of all light in some lanes only that `share`, which the pixel shows.
    #[inline(always)]
    pub fn weigh(&mut self, lanes: Mask8<S>, share: Vec3x8<S>) {
        for Pool8 { came, open } in &mut self.pools {
            *came = Vec3x8::select(lanes, came.times(share), *came);
            *open = Vec3x8::select(lanes, open.times(share), *open);
        }
    }

    /// Notes for rays of a kind where nothing stood in the way, and where something did.
    #[inline(always)]
    pub fn found(&mut self, bit: u32, free: Mask8<S>, hidden: Mask8<S>) {
        let (word, zero) = (U32x8::splat(1 << bit), U32x8::splat(0));
        self.free = self.free | free.select_words(word, zero);
        self.hidden = self.hidden | hidden.select_words(word, zero);
    }

    #[inline(always)]
    pub fn rows(&self) -> Rows {
        Rows {
            free: self.free.store(),
            hidden: self.hidden.store(),
            pools: {
                let [boxes, sky] = &self.pools;
                [[boxes.came.rows(), boxes.open.rows()], [sky.came.rows(), sky.open.rows()]]
            },
        }
    }
}

/// What eight samples found out.
pub struct Rows {
    free: [u32; 8],
    hidden: [u32; 8],
    /// What came of each kind of light, and what would have come.
    pools: [[lanes::Rows; 2]; POOLS],
}

impl Rows {
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Outlook {
        Outlook {
            free: self.free[lane],
            hidden: self.hidden[lane],
            pools: std::array::from_fn(|kind| {
                let [came, open] = &self.pools[kind];
                Pool { came: came.lane(lane), open: open.lane(lane) }
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Plain;

    fn seen(free: u32, hidden: u32) -> Outlook {
        let sky = Pool { came: Vec3::new(0.1, 0.2, 0.3), open: Vec3::splat(0.4) };
        Outlook { free, hidden, pools: [Pool::default(), sky] }
    }

    #[test]
    fn only_what_all_saw_alike_is_known() {
        let mut outlook = seen(0b0011, 0b1000);
        outlook.add(&seen(0b0001, 0b1010));
        let known = outlook.known();
        assert_eq!((known.free, known.hidden), (0b0001, 0b1000));
        assert_eq!(outlook.shares(), [None, Some(Vec3::new(0.2, 0.4, 0.6) / 0.8)]);
        assert_eq!([known.pooled, Outlook::default().known().pooled], [[false, true], [false; 2]]);
    }

    #[test]
    fn a_channel_without_open_light_has_all_of_it() {
        let pool = Pool { came: Vec3::new(0.0, 0.1, 0.0), open: Vec3::new(0.0, 0.4, 0.2) };
        assert_eq!(pool.share(), Some(Vec3::new(1.0, 0.25, 0.0)));
        assert_eq!(Pool::default().share(), None);
    }

    #[test]
    fn each_lane_knows_and_finds_its_own() {
        let mut known = [Known::default(); 8];
        known[3] = seen(0b01, 0b10).known();
        let mut outlooks = Outlooks::<Plain>::new(&known);
        assert_eq!(outlooks.pooled.map(|lanes| lanes.bits()), [0, 1 << 3]);
        assert_eq!(outlooks.known(0).map(|lanes| lanes.bits()), [1 << 3, 0]);
        assert_eq!(outlooks.known(1).map(|lanes| lanes.bits()), [0, 1 << 3]);
        assert_eq!(outlooks.known(MIRROR).map(|lanes| lanes.bits()), [0, 0]);
        outlooks.found(2, Mask8::from_bits(0b011), Mask8::from_bits(0b110));
        outlooks.found(MIRROR, Mask8::from_bits(0b100), Mask8::no_lanes());
        let rows = outlooks.rows();
        let found = [0, 1, 2, 3].map(|lane| (rows.lane(lane).free, rows.lane(lane).hidden));
        assert_eq!(found, [(4, 0), (4, 4), (1 << MIRROR, 4), (0, 0)]);
    }
}
