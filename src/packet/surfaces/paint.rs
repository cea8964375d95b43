//! Marks on the board, for packets of points: only those on painted squares are asked for them.

use glam::{DVec2, Vec2, Vec3};

use super::for_each_kind;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8, math};
use crate::scene;
use crate::scene::measures::SQUARE;
use crate::scene::paint::shape::Shape;
use crate::scene::paint::{Layer, TOP};

/// Points may be so far below the board's top, in world units: they are moved by a hair before they are asked for.
const DEEPEST: f32 = 2e-4 + TOP as f32;

/// What is painted on a board's squares.
pub struct Painting {
    /// The squares that have any, as bits: those of ranks 1 to 4, and of 5 to 8.
    painted: [u32; 2],
    /// By square, the lowest first.
    layers: Vec<Vec<Coat>>,
}

/// One shape in one colour.
struct Coat {
    cover: Cover,
    color: Vec3,
    opacity: f32,
}

/// What a shape covers of a square that it reaches.
enum Cover {
    All,
    /// A band round a square's middle.
    Frame {
        middle: Vec2,
        amid: f32,
        half_width: f32,
    },
    /// Another shape, asked point by point.
    Other(Shape),
}

impl Painting {
    pub fn new(painting: &scene::Painting) -> Painting {
        let squares = painting.squares().map(|layers| layers.map(Coat::new).collect());
        let layers: Vec<Vec<Coat>> = squares.collect();
        let painted = [0, 32].map(|first| {
            let is_painted = |bit: usize| layers.get(first + bit).is_some_and(|l| !l.is_empty());
            (0..32).fold(0, |bits, bit| bits | u32::from(is_painted(bit)) << bit)
        });
        Painting { painted, layers }
    }

    /// The colours at `points` of the board, of the colours `ground` before.
    #[inline(always)]
    pub fn over<S: Simd>(
        &self,
        ground: Vec3x8<S>,
        points: Vec3x8<S>,
        seen: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Vec3x8<S> {
        let per_square = F32x8::splat(1.0 / SQUARE as f32);
        let (x, y) = (points.x * per_square, points.z * per_square);
        let half = F32x8::splat(0.5);
        let (file, rank) = ((x + half).floor(), (y + half).floor());
        let square = (rank.to_i32() << 3) + file.to_i32();
        let [low, high] = self.painted;
        let is_high = (square >> 5).eq(U32x8::splat(1));
        let bits = is_high.select_words(U32x8::splat(high), U32x8::splat(low));
        let is_painted =
            ((bits >> (square & U32x8::splat(31))) & U32x8::splat(1)).eq(U32x8::splat(1));
        let is_top = points.y.ge(F32x8::splat(-DEEPEST));
        let (first, last) = (F32x8::splat(0.0), F32x8::splat(7.0));
        let is_on = file.min(rank).ge(first) & file.max(rank).le(last);
        let painted = is_painted & is_top & is_on & lanes;
        if !painted.any() {
            return ground;
        }
        self.painted_over(ground, [x, y], square, seen * per_square, painted)
    }

    /// The same for `lanes` on painted squares; lengths are in squares.
    #[inline(never)]
    fn painted_over<S: Simd>(
        &self,
        ground: Vec3x8<S>,
        place: [F32x8<S>; 2],
        square: U32x8<S>,
        seen: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Vec3x8<S> {
        S::run(
            #[inline(always)]
            || {
                let mut color = ground;
                for_each_kind(
                    square,
                    lanes,
                    #[inline(always)]
                    |square, these| {
                        for coat in self.layers.get(square).into_iter().flatten() {
                            let cover = coat.cover.at(place, seen, these);
                            let share = these.keep(cover * F32x8::splat(coat.opacity));
                            color = color.lerp(Vec3x8::splat(coat.color), share);
                        }
                    },
                );
                color
            },
        )
    }
}

impl Coat {
    fn new(layer: &Layer) -> Coat {
        let cover = match &layer.shape {
            Shape::Square { .. } => Cover::All,
            Shape::Frame { middle, to, width } => Cover::Frame {
                middle: middle.as_vec2(),
                amid: (to - width / 2.0) as f32,
                half_width: (width / 2.0) as f32,
            },
            shape => Cover::Other(shape.clone()),
        };
        Coat { cover, color: layer.color.as_vec3(), opacity: layer.opacity as f32 }
    }
}

impl Cover {
    #[inline(always)]
    fn at<S: Simd>(&self, [x, y]: [F32x8<S>; 2], seen: F32x8<S>, lanes: Mask8<S>) -> F32x8<S> {
        match self {
            Cover::All => F32x8::splat(1.0),
            Cover::Frame { middle, amid, half_width } => {
                let dx = (x - F32x8::splat(middle.x)).abs();
                let dy = (y - F32x8::splat(middle.y)).abs();
                let outside = (dx.max(dy) - F32x8::splat(*amid)).abs() - F32x8::splat(*half_width);
                let seen = seen.max(F32x8::splat(f32::MIN_POSITIVE));
                (F32x8::splat(0.5) - outside / seen).clamp(0.0, 1.0)
            }
            Cover::Other(shape) => {
                let (y, seen) = (y.store(), seen.store());
                math::one_by_one(x, lanes, |lane, x| {
                    let point = DVec2::new(f64::from(x), f64::from(y[lane]));
                    shape.cover(point, f64::from(seen[lane])) as f32
                })
            }
        }
    }
}
