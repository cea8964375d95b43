//! What the first samples of pixels side by side tell of the light there, so that later ones need not ask.
//!
//! Where all of them saw a softbox, or none of them did, the next sample would see no more. What stands in
//! the way of the sky changes so slowly from pixel to pixel that all of them together know it better than
//! the samples of one: also at the edges of bodies, where what they share out is what each sample would see under an
//! open sky.

use glam::{DVec3, Vec3};

use crate::lanes::{self, Mask8, Simd, U32x8, Vec3x8};

/// The bit of what a mirror sees; softboxes have those below it by their numbers. More softboxes than there
/// are bits are always asked.
pub const MIRROR: u32 = 31;

/// What samples found out where they met a surface first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outlook {
    /// Rays that nothing stood in the way of, and those that something did, a bit each.
    pub free: u32,
    pub hidden: u32,
    /// The light that came from the sky and what hides it, and what would have come had nothing hidden it; both
    /// as the pixel shows them.
    pub sky: Vec3,
    pub open_sky: Vec3,
}

impl Outlook {
    /// Adds what others found out.
    pub fn add(&mut self, other: &Outlook) {
        self.free |= other.free;
        self.hidden |= other.hidden;
        self.sky += other.sky;
        self.open_sky += other.open_sky;
    }

    /// Takes of the sky's light only that `share`, which the pixel shows.
    pub fn weigh(&mut self, share: Vec3) {
        self.sky *= share;
        self.open_sky *= share;
    }

    /// Of the light of an open sky what there really is, by channel, all of it where a channel has none;
    /// `None` where nobody has asked.
    pub fn share_of_sky(&self) -> Option<Vec3> {
        let is_any = self.open_sky.cmpgt(Vec3::ZERO);
        is_any.any().then(|| Vec3::select(is_any, self.sky / self.open_sky, Vec3::ONE))
    }

    /// What becomes of `light` that has this light of the sky in it, where of that of an open sky there is such a
    /// share. (Light is cut where it is too bright, the sky's part of it is not.)
    pub fn under(&self, light: DVec3, share_of_sky: Option<Vec3>) -> DVec3 {
        share_of_sky.map_or(light, |share| {
            (light + (self.open_sky * share - self.sky).as_dvec3()).max(DVec3::ZERO)
        })
    }

    /// What need not be asked again.
    pub fn known(&self) -> Known {
        Known {
            free: self.free & !self.hidden,
            hidden: self.hidden & !self.free,
            sky: self.share_of_sky().is_some(),
        }
    }
}

/// What a sample need not ask.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Known {
    /// Rays that nothing stands in the way of, and those that something does, a bit each.
    pub free: u32,
    pub hidden: u32,
    /// How much there is of the light of an open sky. Samples then have none of it in them.
    pub sky: bool,
}

impl Known {
    /// Which rays need not be asked for, and whether the sky is among them.
    pub fn answered(&self) -> (bool, u32) {
        (self.sky, self.free | self.hidden)
    }
}

/// What eight samples need not ask, and what they find out.
pub struct Outlooks<S: Simd> {
    /// See [`Known`].
    known: [U32x8<S>; 2],
    pub knows_sky: Mask8<S>,
    /// See [`Outlook`].
    free: U32x8<S>,
    hidden: U32x8<S>,
    pub sky: Vec3x8<S>,
    pub open_sky: Vec3x8<S>,
}

impl<S: Simd> Outlooks<S> {
    #[inline(always)]
    pub fn new(known: &[Known; 8]) -> Outlooks<S> {
        let (mut free, mut hidden, mut knows_sky) = ([0; 8], [0; 8], 0);
        for (lane, known) in known.iter().enumerate() {
            (free[lane], hidden[lane]) = (known.free, known.hidden);
            knows_sky |= u8::from(known.sky) << lane;
        }
        let zero = U32x8::splat(0);
        Outlooks {
            known: [U32x8::load(&free), U32x8::load(&hidden)],
            knows_sky: Mask8::from_bits(knows_sky),
            free: zero,
            hidden: zero,
            sky: Vec3x8::zero(),
            open_sky: Vec3x8::zero(),
        }
    }

    /// Where it is known that nothing stands in the way of rays of a kind, and where that something does.
    #[inline(always)]
    pub fn known(&self, bit: u32) -> [Mask8<S>; 2] {
        let [free, hidden] = self.known;
        let one = U32x8::splat(1);
        [((free >> bit) & one).eq(one), ((hidden >> bit) & one).eq(one)]
    }

    /// Takes of the sky's light in some lanes only that `share`, which the pixel shows.
    #[inline(always)]
    pub fn weigh(&mut self, lanes: Mask8<S>, share: Vec3x8<S>) {
        self.sky = Vec3x8::select(lanes, self.sky.times(share), self.sky);
        self.open_sky = Vec3x8::select(lanes, self.open_sky.times(share), self.open_sky);
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
            sky: self.sky.rows(),
            open_sky: self.open_sky.rows(),
        }
    }
}

/// What eight samples found out.
pub struct Rows {
    free: [u32; 8],
    hidden: [u32; 8],
    sky: lanes::Rows,
    open_sky: lanes::Rows,
}

impl Rows {
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Outlook {
        Outlook {
            free: self.free[lane],
            hidden: self.hidden[lane],
            sky: self.sky.lane(lane),
            open_sky: self.open_sky.lane(lane),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::Plain;

    fn seen(free: u32, hidden: u32) -> Outlook {
        let (sky, open_sky) = (Vec3::new(0.1, 0.2, 0.3), Vec3::splat(0.4));
        Outlook { free, hidden, sky, open_sky }
    }

    #[test]
    fn only_what_all_saw_alike_is_known() {
        let mut outlook = seen(0b0011, 0b1000);
        outlook.add(&seen(0b0001, 0b1010));
        let known = outlook.known();
        assert_eq!((known.free, known.hidden), (0b0001, 0b1000));
        assert_eq!(outlook.share_of_sky(), Some(Vec3::new(0.2, 0.4, 0.6) / 0.8));
        assert_eq!([known.sky, Outlook::default().known().sky], [true, false]);
    }

    #[test]
    fn each_lane_knows_and_finds_its_own() {
        let mut known = [Known::default(); 8];
        known[3] = seen(0b01, 0b10).known();
        let mut outlooks = Outlooks::<Plain>::new(&known);
        assert_eq!(outlooks.knows_sky.bits(), 1 << 3);
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
