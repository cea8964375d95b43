//! What may stand between the points of one box and those of another: such ways make a shaft (E. Haines and J. Wallace,
//! *Shaft Culling for Efficient Ray-Traced Radiosity*, 1991).
//!
//! The points of a packet and a light make a shaft so narrow that most are empty: then none of its rays need be
//! asked. What is found is never too little, and depends on neighbours; so it decides which questions are
//! worth asking, and no answer.

use glam::{Vec3, Vec3A};
use smallvec::SmallVec;

use super::boxes::Aabb;
use crate::lanes::{F32x8, LANES, Mask8, Simd};

/// How much larger a shaft is made at its two ends, in world units, and by parts of their coordinates: more than rounding
/// errors, but at its beginning less than what rays leave a surface by, or it would always meet what it leaves.
const ROOM: [f32; 2] = [2e-5, 1e-2];
const ROOM_OF_EACH: f32 = 4e-6;

/// All ways from a point of one box to one of another.
pub struct Shaft {
    /// Of its lower borders and of its upper ones, by axis.
    borders: [Borders; 2],
}

/// Where borders begin, and what a step of 1 along each axis brings in parts of the whole way.
struct Borders {
    start: Vec3A,
    per_unit: Vec3A,
}

/// The numbers of few boxes among many.
pub type Few = SmallVec<[u32; 32]>;

/// Boxes, eight at once.
pub struct Crowd {
    /// The lower corners' coordinates, and the upper ones'.
    rows: Vec<[[[f32; LANES]; 3]; 2]>,
}

impl Shaft {
    #[inline(always)]
    pub fn new(from: &Aabb, to: &Aabb) -> Shaft {
        let [start, end] = ROOM;
        let grown =
            |corner: Vec3, by: f32| corner + by + (corner.abs() * by.signum()) * ROOM_OF_EACH;
        let borders = |from: Vec3, to: Vec3| {
            let (start, way) = (Vec3A::from(from), Vec3A::from(to - from));
            // Where it leads nowhere, steps are as good as endless.
            let least = Vec3A::splat(1e-6);
            let way = Vec3A::select(way.abs().cmplt(least), least, way);
            Borders { start, per_unit: Vec3A::ONE / way }
        };
        Shaft {
            borders: [
                borders(grown(from.min, -start), grown(to.min, -end)),
                borders(grown(from.max, start), grown(to.max, end)),
            ],
        }
    }
}

impl Crowd {
    pub fn new(boxes: impl IntoIterator<Item = Aabb>) -> Crowd {
        // Where a row has no eighth box, there is one that holds nothing.
        let mut rows = Vec::new();
        for (number, Aabb { min, max }) in boxes.into_iter().enumerate() {
            if number % LANES == 0 {
                rows.push([[[f32::INFINITY; LANES]; 3], [[f32::NEG_INFINITY; LANES]; 3]]);
            }
            let row = &mut rows[number / LANES];
            for axis in 0..3 {
                row[0][axis][number % LANES] = min[axis];
                row[1][axis][number % LANES] = max[axis];
            }
        }
        Crowd { rows }
    }

    /// Those that ways in the shaft may meet.
    #[inline(always)]
    pub fn among<S: Simd>(&self, shaft: &Shaft) -> Few {
        let mut few = Few::new();
        for (index, row) in (0..).zip(&self.rows) {
            let mut left = met::<S>(row, shaft).bits();
            while left != 0 {
                few.push(index * LANES as u32 + left.trailing_zeros());
                left &= left - 1;
            }
        }
        few
    }
}

/// Which boxes of a row a shaft may meet. At each part of the way, from 0 to 1, it is a box, whose borders
/// move evenly: there must be a part where no border has left the other box behind.
#[inline(always)]
fn met<S: Simd>([min, max]: &[[[f32; LANES]; 3]; 2], shaft: &Shaft) -> Mask8<S> {
    let (mut enter, mut exit) = (F32x8::splat(0.0), F32x8::splat(1.0));
    for axis in 0..3 {
        for (Borders { start, per_unit }, (edges, leaves)) in
            shaft.borders.iter().zip([(max, true), (min, false)])
        {
            let per_unit = per_unit[axis];
            let part =
                (F32x8::load(&edges[axis]) - F32x8::splat(start[axis])) * F32x8::splat(per_unit);
            if (per_unit > 0.0) == leaves {
                exit = exit.min(part);
            } else {
                enter = enter.max(part);
            }
        }
    }
    enter.le(exit)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use proptest::prelude::*;

    use super::*;
    use crate::lanes::{Plain, Vec3x8};
    use crate::packet::Rays;
    use crate::packet::boxes::Way;

    fn aabb() -> impl Strategy<Value = Aabb> {
        let place = || prop_oneof![-9.0..9.0_f32, Just(0.0), Just(2.0)];
        let size = || prop_oneof![0.0..5.0_f32, Just(0.0)];
        ([place(), place(), place()], [size(), size(), size()]).prop_map(|(min, size)| Aabb {
            min: min.into(),
            max: Vec3::from(min) + Vec3::from(size),
        })
    }

    proptest! {
        /// Whatever boxes there are: a way that meets one of them is in a shaft that meets it.
        #[test]
        fn no_box_in_the_way_is_left_out(
            [from, to] in [aabb(), aabb()],
            boxes in proptest::collection::vec(aabb(), 1..20),
            places in proptest::collection::vec([0.0..=1.0_f32, 0.0..=1.0, 0.0..=1.0], 2..30),
        ) {
            let crowd = Crowd::new(boxes.iter().copied());
            let shaft = Shaft::new(&from, &to);
            let few = crowd.among::<Plain>(&shaft);
            for pair in places.windows(2) {
                let point = |aabb: &Aabb, place: [f32; 3]| aabb.min + (aabb.max - aabb.min) * Vec3::from(place);
                let (start, end) = (point(&from, pair[0]), point(&to, pair[1]));
                let load = |v: Vec3| Vec3x8::<Plain>::load(&[DVec3::from(v); 8]);
                let rays = Rays { origin: load(start), direction: load(end - start) };
                let (way, zero, one) = (Way::new(&rays), F32x8::splat(0.0), F32x8::splat(1.0));
                for (number, aabb) in (0..).zip(&boxes) {
                    if aabb.may_meet(&way, zero, one).any() {
                        prop_assert!(few.contains(&number), "{number} of {boxes:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn an_empty_shaft_meets_nothing() {
        let cube = |x: f32, y: f32| Aabb {
            min: Vec3::new(x, y, 0.0),
            max: Vec3::new(x + 1.0, y + 1.0, 1.0),
        };
        let crowd = Crowd::new((0..10).map(|number| cube(2.0 * number as f32, 0.0)));
        let among = |from: &Aabb, to: &Aabb| crowd.among::<Plain>(&Shaft::new(from, to)).to_vec();
        let up = |x: f32| among(&cube(x, -3.0), &cube(x, 3.0));
        assert_eq!(up(4.0), [2]);
        assert_eq!(up(9.0), [4, 5]);
        assert!(up(-3.0).is_empty() && up(30.0).is_empty());
        assert!(among(&cube(0.0, 2.0), &cube(18.0, 3.0)).is_empty());
        assert_eq!(among(&cube(0.0, -2.0), &cube(18.0, 3.0)), [2, 3, 4, 5]);
    }
}
