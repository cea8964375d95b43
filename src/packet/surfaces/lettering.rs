//! Coordinates on the board's frame, for packets of points: only those near a label are asked for its ink.

use glam::{DVec2, Vec2, Vec3};

use super::for_each_kind;
use super::texture::{Places, Texture};
use crate::geometry::transform::sin_cos;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::scene::Readers;
use crate::scene::coordinates::{self, SIZE, Side, WITHIN};
use crate::scene::glyphs::{self, PEN, REACH};
use crate::scene::measures::{HALF, MIDDLE, SQUARE};

/// Ink on a ground.
pub struct Lettering {
    ground: Texture,
    ink: Vec3,
    /// By side, eight each.
    labels: Vec<Option<Label>>,
}

/// What is written beside a square.
struct Label {
    /// The board's middle as the glyph is drawn, and the ways to its right and upwards on the board.
    origin: Vec2,
    right: Vec2,
    up: Vec2,
    strokes: Vec<Stroke>,
}

/// One stroke of the pen.
enum Stroke {
    Line {
        from: Vec2,
        along: Vec2,
        per_length2: f32,
    },
    /// About a centre, as far as `cos` of the angle from its own middle says.
    Arc {
        center: Vec2,
        radius: f32,
        towards: Vec2,
        cos: f32,
        ends: [Vec2; 2],
    },
}

/// No ink of a glyph is farther from a label's middle, to any side and in world units.
const FARTHEST: f64 = SIZE * (REACH[1] + 0.5);

impl Lettering {
    pub fn new(ground: Texture, ink: Vec3, readers: Readers) -> Lettering {
        let label = |side| move |number| coordinates::Label::new(readers, side, number);
        let labels = Side::ALL.into_iter().flat_map(|side| (0..8).map(label(side)));
        let labels = labels.map(|label| label.map(|label| Label::new(&label))).collect();
        Lettering { ground, ink, labels }
    }

    #[inline(always)]
    pub fn color<S: Simd>(&self, places: &Places<S>, lanes: Mask8<S>) -> Vec3x8<S> {
        let ground = self.ground.color(places, lanes);
        let from_middle = places.on_body - Vec3x8::splat(MIDDLE.as_vec3());
        let (x, z) = (from_middle.x, from_middle.z);
        let (dx, dz) = (x.abs(), z.abs());
        // Across the frame and along it from the middle of where a label may be.
        let half = F32x8::splat(HALF as f32);
        let is_file = dz.gt(dx);
        let (out, along) = (is_file.select(dz, dx), is_file.select(x, z));
        let number = ((along + half) * F32x8::splat(1.0 / SQUARE as f32)).floor().clamp(0.0, 7.0);
        let beside = (number + F32x8::splat(0.5)) * F32x8::splat(SQUARE as f32) - half;
        let off = (out - F32x8::splat((HALF + WITHIN) as f32)).abs().max((along - beside).abs());
        let reach = F32x8::splat(FARTHEST as f32) + places.seen * F32x8::splat(0.5);
        // Corners belong to no side.
        let near = off.lt(reach) & out.gt(half) & is_file.select(dx, dz).le(half) & lanes;
        if !near.any() {
            return ground;
        }
        let is_far = is_file.select(z, -x).gt(F32x8::splat(0.0));
        let [white, kingside, black, queenside] =
            [U32x8::splat(0), U32x8::splat(8), U32x8::splat(16), U32x8::splat(24)];
        let far = is_file.select_words(black, queenside);
        let first = is_far.select_words(far, is_file.select_words(white, kingside));
        let mut cover = F32x8::splat(0.0);
        for_each_kind(
            first + number.to_i32(),
            near,
            #[inline(always)]
            |label, these| {
                if let Some(Some(label)) = self.labels.get(label) {
                    cover = these.select(label.cover([x, z], places.seen, these), cover);
                }
            },
        );
        ground.lerp(Vec3x8::splat(self.ink), cover)
    }
}

impl Label {
    fn new(label: &coordinates::Label) -> Label {
        let origin = label.point(DVec2::ZERO);
        let step = |way| label.point(way) - origin;
        let (kingwards, away) = (step(DVec2::X), step(DVec2::Y));
        Label {
            origin: origin.as_vec2(),
            right: DVec2::new(kingwards.x, away.x).as_vec2(),
            up: DVec2::new(kingwards.y, away.y).as_vec2(),
            strokes: label.strokes().iter().map(Stroke::new).collect(),
        }
    }

    /// How much ink there is at places from the board's middle, 0 to 1.
    #[inline(always)]
    fn cover<S: Simd>(&self, place: [F32x8<S>; 2], seen: F32x8<S>, lanes: Mask8<S>) -> F32x8<S> {
        let x = F32x8::splat(self.origin.x) + dot(place, self.right);
        let y = F32x8::splat(self.origin.y) + dot(place, self.up);
        let [aside, below, above] = [REACH[0] as f32, REACH[1] as f32, REACH[2] as f32];
        let blur = seen * F32x8::splat(0.5 / SIZE as f32);
        let is_near = x.abs().le(F32x8::splat(aside) + blur)
            & (-y).le(F32x8::splat(below) + blur)
            & y.le(F32x8::splat(above) + blur)
            & lanes;
        if !is_near.any() {
            return F32x8::splat(0.0);
        }
        let mut nearest = F32x8::splat(f32::INFINITY);
        for stroke in &self.strokes {
            nearest = nearest.min(stroke.distance([x, y]));
        }
        let outside = (nearest - F32x8::splat(PEN as f32)) * F32x8::splat(SIZE as f32);
        let cover = F32x8::splat(0.5) - outside / seen.max(F32x8::splat(f32::MIN_POSITIVE));
        is_near.keep(cover.clamp(0.0, 1.0))
    }
}

impl Stroke {
    fn new(stroke: &glyphs::Stroke) -> Stroke {
        match *stroke {
            glyphs::Stroke::Line(from, to) => Stroke::Line {
                from: from.as_vec2(),
                along: (to - from).as_vec2(),
                per_length2: (to - from).length_squared().recip() as f32,
            },
            glyphs::Stroke::Arc(center, radius, [from, to]) => {
                let towards = |degrees| {
                    let (sin, cos) = sin_cos(degrees);
                    DVec2::new(cos, sin)
                };
                let end = |degrees| (center + towards(degrees) * radius).as_vec2();
                // All angles are in a whole circle, whatever rounding says.
                let is_whole = to - from >= 360.0;
                let cos = if is_whole { -2.0 } else { sin_cos((to - from) / 2.0).1 };
                Stroke::Arc {
                    center: center.as_vec2(),
                    radius: radius as f32,
                    towards: towards((from + to) / 2.0).as_vec2(),
                    cos: cos as f32,
                    ends: [end(from), end(to)],
                }
            }
        }
    }

    /// How far points lie from the stroke's middle.
    #[inline(always)]
    fn distance<S: Simd>(&self, point: [F32x8<S>; 2]) -> F32x8<S> {
        match self {
            Stroke::Line { from, along, per_length2 } => {
                let [x, y] = beyond(point, *from);
                let share = (dot([x, y], *along) * F32x8::splat(*per_length2)).clamp(0.0, 1.0);
                length([x - share * F32x8::splat(along.x), y - share * F32x8::splat(along.y)])
            }
            Stroke::Arc { center, radius, towards, cos, ends: [first, last] } => {
                let aside = beyond(point, *center);
                let away = length(aside);
                let is_beside = dot(aside, *towards).ge(away * F32x8::splat(*cos));
                let to_end = length(beyond(point, *first)).min(length(beyond(point, *last)));
                is_beside.select((away - F32x8::splat(*radius)).abs(), to_end)
            }
        }
    }
}

#[inline(always)]
fn beyond<S: Simd>([x, y]: [F32x8<S>; 2], from: Vec2) -> [F32x8<S>; 2] {
    [x - F32x8::splat(from.x), y - F32x8::splat(from.y)]
}

#[inline(always)]
fn dot<S: Simd>([x, y]: [F32x8<S>; 2], way: Vec2) -> F32x8<S> {
    x * F32x8::splat(way.x) + y * F32x8::splat(way.y)
}

#[inline(always)]
fn length<S: Simd>([x, y]: [F32x8<S>; 2]) -> F32x8<S> {
    (x * x + y * y).sqrt()
}
