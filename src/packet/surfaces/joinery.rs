//! The wood of a board, for packets of points.

use glam::Vec3;

use super::texture::{Places, Texture};
use super::{Look, for_each_kind, number};
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::scene::joinery::{Cut, SIDES, SQUARES, is_dark};
use crate::scene::measures::{HALF, MIDDLE, SQUARE};
use crate::scene::{self, noise::hash};

/// All parts of a board: squares, sides of the frame, and the inlay along them.
pub struct Joinery {
    parts: Vec<Part>,
    inlay_width: f32,
}

/// What is cut from one piece of one material.
struct Part {
    /// By [`scene::Joinery::materials`].
    material: u32,
    texture: Texture,
    middle: Vec3,
    is_turned: bool,
}

impl Joinery {
    pub fn new(joinery: &scene::Joinery, seed: u64) -> Joinery {
        let part = |material: u32, part: u64| {
            let Cut { middle, is_turned } = Cut::new(part);
            let texture = &joinery.materials[material as usize].texture;
            let texture = Texture::new(texture, hash(seed, part));
            Part { material, texture, middle: middle.as_vec3(), is_turned }
        };
        let squares = (0..SQUARES).map(|square| part(u32::from(!is_dark(square)), square));
        let sides = [2, 3]
            .into_iter()
            .flat_map(|material| (SQUARES..SQUARES + SIDES).map(move |side| part(material, side)));
        Joinery { parts: squares.chain(sides).collect(), inlay_width: joinery.inlay_width() as f32 }
    }

    #[inline(always)]
    pub fn look<S: Simd>(&self, points: Vec3x8<S>, seen: F32x8<S>, lanes: Mask8<S>) -> Look<S> {
        let mut look = Look { color: Vec3x8::zero(), material: U32x8::splat(0) };
        for_each_kind(
            self.parts(points),
            lanes,
            #[inline(always)]
            |part, these| {
                let Some(part) = self.parts.get(part) else { return };
                let Vec3x8 { x, y, z } = points - Vec3x8::splat(part.middle);
                let own = if part.is_turned { Vec3x8::new(-z, y, x) } else { Vec3x8::new(x, y, z) };
                let color =
                    part.texture.color(&Places { on_body: points, points: own, seen }, these);
                look.color = Vec3x8::select(these, color, look.color);
                look.material = these.select_words(U32x8::splat(part.material), look.material);
            },
        );
        look
    }

    #[inline(always)]
    pub fn material<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> U32x8<S> {
        let mut material = U32x8::splat(0);
        for_each_kind(
            self.parts(points),
            lanes,
            #[inline(always)]
            |part, these| {
                if let Some(part) = self.parts.get(part) {
                    material = these.select_words(U32x8::splat(part.material), material);
                }
            },
        );
        material
    }

    /// Which of the parts points lie on.
    #[inline(always)]
    fn parts<S: Simd>(&self, points: Vec3x8<S>) -> U32x8<S> {
        let from_middle = points - Vec3x8::splat(MIDDLE.as_vec3());
        let (dx, dz) = (from_middle.x.abs(), from_middle.z.abs());
        let beyond = dx.max(dz) - F32x8::splat(HALF as f32);
        let on_frame = beyond.ge(F32x8::splat(0.0));
        let square = (cell(points.z) << 3) + cell(points.x);
        if !on_frame.any() {
            return square;
        }
        let along_x = dz.gt(dx);
        let side = along_x.select(from_middle.z, from_middle.x);
        let side = U32x8::splat(SQUARES as u32)
            + (number(along_x) << 1)
            + number(side.gt(F32x8::splat(0.0)))
            + (number(beyond.lt(F32x8::splat(self.inlay_width))) << SIDES.trailing_zeros());
        on_frame.select_words(side, square)
    }
}

/// The file or rank of a place on the squares.
#[inline(always)]
fn cell<S: Simd>(at: F32x8<S>) -> U32x8<S> {
    let cell = at * F32x8::splat(1.0 / SQUARE as f32) + F32x8::splat(0.5);
    cell.floor().clamp(0.0, 7.0).to_i32()
}
