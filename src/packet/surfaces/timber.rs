//! Timber of one tree, for packets of points.

use glam::{DVec3, Vec2};

use super::noise::{Wave, share};
use crate::lanes::{F32x8, Mask8, Simd, Vec3x8};
use crate::scene::timber::{self, LATE, LEAN, RING_MEAN, Tree};

/// One tree's wood.
pub struct Timber {
    rings_per_unit: f32,
    seed: u64,
    /// In widths of a ring, as all that follows.
    heart: Vec2,
    /// How dark it is on the whole.
    ground: f32,
    /// What bends the rings, and how far.
    bends: [(Wave, f32); 2],
    drift: Wave,
    fibres: Wave,
}

impl Timber {
    /// The tree that `seed` stands for, with so many world units from `ring` to ring.
    pub fn new(ring: f64, seed: u64) -> Timber {
        let Tree { heart, along, tone } = Tree::new(seed);
        let wave = |[across, length]: [f64; 2]| {
            let scale = DVec3::new(across, across, length).recip();
            Wave::new(scale / ring, DVec3::Z * along * scale)
        };
        Timber {
            rings_per_unit: ring.recip() as f32,
            seed,
            heart: heart.as_vec2(),
            ground: (timber::MEAN + tone) as f32,
            bends: timber::BENDS.map(|(size, by)| (wave(size), by as f32)),
            drift: wave(timber::DRIFT.0),
            fibres: wave(timber::FIBRES.0),
        }
    }

    /// How dark the wood is at `points` with z along the grain, in world units.
    #[inline(always)]
    pub fn shade<S: Simd>(&self, points: Vec3x8<S>, seen: F32x8<S>, lanes: Mask8<S>) -> F32x8<S> {
        let seen = seen * F32x8::splat(self.rings_per_unit);
        let mut shade = F32x8::splat(self.ground)
            + F32x8::splat(timber::DRIFT.1 as f32) * self.drift.at(&points, lanes);
        let rings_left = visible(seen, timber::RING_WIDTH);
        let are_seen = rings_left.gt(F32x8::splat(0.0)) & lanes;
        if are_seen.any() {
            shade += are_seen.keep(self.rings(points, are_seen) * rings_left);
        }
        let fibres_left = visible(seen, timber::FIBRE_WIDTH);
        let are_seen = fibres_left.gt(F32x8::splat(0.0)) & lanes;
        if are_seen.any() {
            let fibres = F32x8::splat(timber::FIBRES.1 as f32) * self.fibres.at(&points, are_seen);
            shade += are_seen.keep(fibres * fibres_left);
        }
        shade.clamp(0.0, 1.0)
    }

    /// What rings add to the mean.
    #[inline(always)]
    fn rings<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> F32x8<S> {
        let widths = points * F32x8::splat(self.rings_per_unit);
        let x = widths.x + F32x8::splat(self.heart.x) + widths.z * F32x8::splat(LEAN as f32);
        let y = widths.y + F32x8::splat(self.heart.y);
        let mut radius = (x * x + y * y).sqrt();
        for (bend, by) in &self.bends {
            radius += F32x8::splat(*by) * bend.at(&points, lanes);
        }
        let ring = radius.floor();
        let t = radius - ring;
        let (end, width) = (LATE[0] as f32, LATE[1] as f32);
        let one = F32x8::splat(1.0);
        let late = t * t * (one - smooth((t - F32x8::splat(end)) * F32x8::splat(width.recip())));
        let year = share(self.seed, ring.to_i32());
        let squared = year * year;
        let year =
            F32x8::splat(0.2) + F32x8::splat(0.55) * year + F32x8::splat(0.65) * squared * squared;
        late * year - F32x8::splat(RING_MEAN as f32)
    }
}

/// How much is left of a pattern of `width` where `seen` is seen at once.
#[inline(always)]
fn visible<S: Simd>(seen: F32x8<S>, width: f64) -> F32x8<S> {
    let fade = seen * F32x8::splat((2.0 / width) as f32) - F32x8::splat(0.5);
    F32x8::splat(1.0) - smooth(fade)
}

#[inline(always)]
fn smooth<S: Simd>(t: F32x8<S>) -> F32x8<S> {
    let t = t.clamp(0.0, 1.0);
    t * t * (F32x8::splat(3.0) - F32x8::splat(2.0) * t)
}
