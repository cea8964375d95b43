//! Boxes in rows: which of them rays pass is known without asking any.

use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;

/// Rows, and boxes in each.
pub const SIDE: usize = 8;

/// Rows of boxes of one height, in a plane of eight rows.
pub struct Slab {
    /// The middle of the first box, and the way to the next.
    pub origin: [f32; 2],
    pub side: f32,
    /// How far each box reaches from its middle.
    pub reach: f32,
    pub heights: [f32; 2],
}

impl Slab {
    /// Which of each row's boxes rays pass up to `to`, as bits.
    #[inline(always)]
    pub fn rows<S: Simd>(
        &self,
        rays: &Rays<S>,
        inverse: Vec3x8<S>,
        to: F32x8<S>,
        lanes: Mask8<S>,
        rows: &mut [U32x8<S>; SIDE],
    ) {
        let (o, d) = (rays.origin, rays.direction);
        let number = F32x8::splat;
        // Where the ray is at the right height; an endless one is as good as this long. A level one is at its
        // height all the way, or nowhere.
        let [low, high] = self.heights;
        let (low, high) = (number(low), number(high));
        let (a, b) = ((low - o.y) * inverse.y, (high - o.y) * inverse.y);
        let is_flat = d.y.abs().lt(number(1e-12));
        let is_high = is_flat & o.y.ge(low) & o.y.le(high);
        let enter = is_flat.select(number(0.0), a.min(b).max(number(0.0)));
        let exit = is_flat.select(number(1e6), a.max(b)).min(to).min(number(1e6));
        let lanes = lanes & enter.le(exit) & (is_high | !is_flat);
        if !lanes.any() {
            return;
        }
        // Along the rows: from where a ray is near the middle line of one to where it is no more. A ray that
        // keeps within a row is taken to be in all that it is near.
        let reach = number(self.reach).with_sign_of(d.z);
        let to_first = number(self.origin[1]) - o.z;
        let is_level = d.z.abs().lt(number(1e-12));
        let scale = number(1.0 / self.side);
        let left = number((self.side - self.reach - self.origin[0]) / self.side);
        let right = number((self.side + self.reach - self.origin[0]) / self.side);
        let most = SIDE as f32;
        let mut wanted = self.rows_of(o.z + d.z * enter, o.z + d.z * exit, lanes);
        while wanted != 0 {
            let index = wanted.trailing_zeros() as usize;
            wanted &= wanted - 1;
            let to_row = to_first + number(index as f32 * self.side);
            let mut near = (to_row - reach) * inverse.z;
            let mut far = (to_row + reach) * inverse.z;
            let is_beside = is_level & to_row.abs().gt(number(self.reach));
            let endless = number(f32::INFINITY);
            near = is_level.select(-endless, near);
            far = is_level.select(endless, far);
            let (from, until) = (near.max(enter), far.min(exit));
            let is_in = from.le(until).but(is_beside);
            let (a, b) = (o.x + d.x * from, o.x + d.x * until);
            let (first, behind) = (a.min(b) * scale + left, a.max(b) * scale + right);
            let one = U32x8::splat(1);
            let first = first.clamp(0.0, most).floor();
            let behind = behind.clamp(0.0, most).floor();
            let bits = (one << behind.to_i32()) - (one << first.to_i32());
            let is_any = is_in & lanes & first.lt(behind);
            rows[index] = is_any.select_words(bits, U32x8::splat(0));
        }
    }

    /// The rows that ways from `a` to `b` across them may pass in any lane, as bits.
    #[inline(always)]
    fn rows_of<S: Simd>(&self, a: F32x8<S>, b: F32x8<S>, lanes: Mask8<S>) -> u32 {
        // As if boxes met, with room for rounding: one row more does no harm.
        let scale = F32x8::splat(1.0 / self.side);
        let low = a.min(b) * scale + F32x8::splat(0.49 - self.origin[1] / self.side);
        let high = a.max(b) * scale + F32x8::splat(1.51 - self.origin[1] / self.side);
        let (first, behind) = (low.clamp(0.0, SIDE as f32), high.clamp(0.0, SIDE as f32));
        let one = U32x8::splat(1);
        let bits = (one << behind.to_i32()) - (one << first.to_i32());
        lanes.select_words(bits, U32x8::splat(0)).in_any_lane()
    }
}
