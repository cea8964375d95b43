//! What bodies are made of, for packets of points.
//!
//! Surfaces are made ready for one body: what depends on seeds alone (the tree that a piece is cut from) is
//! known before the first point is asked for.

mod joinery;
mod lettering;
mod noise;
mod paint;
mod texture;
mod timber;

#[cfg(test)]
mod tests;

use glam::Vec2;

use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::scene;

use joinery::Joinery;
use paint::Painting;
use texture::{Places, Texture};

/// What is seen of a surface.
#[derive(Clone, Copy)]
pub struct Look<S: Simd> {
    pub color: Vec3x8<S>,
    /// Which of the surface's materials (by [`scene::Surface::materials`]) it is.
    pub material: U32x8<S>,
}

/// The surface of an object.
pub struct Surface {
    pieces: Pieces,
    paint: Option<Painting>,
}

/// What a surface consists of.
enum Pieces {
    One(Texture),
    /// Squares of two textures.
    Chequer {
        /// (x, z) of a square's corner.
        origin: Vec2,
        per_side: f32,
        textures: [Texture; 2],
    },
    Board(Joinery),
}

impl Surface {
    /// The surface of `object`: its materials, its seed, its paint.
    pub fn new(object: &scene::Object) -> Surface {
        let texture = |material: &scene::Material| Texture::new(&material.texture, object.seed);
        let pieces = match &object.surface {
            scene::Surface::Uniform(material) => Pieces::One(texture(material)),
            scene::Surface::Chequer { origin, side, materials } => Pieces::Chequer {
                origin: origin.as_vec2(),
                per_side: side.recip() as f32,
                textures: materials.each_ref().map(texture),
            },
            scene::Surface::Board(joinery) => Pieces::Board(Joinery::new(joinery, object.seed)),
        };
        Surface { pieces, paint: object.paint.as_deref().map(Painting::new) }
    }

    /// What is seen at `points` of the object's own space, where widths of `seen` world units are seen at
    /// once.
    #[inline(always)]
    pub fn look<S: Simd>(&self, points: Vec3x8<S>, seen: F32x8<S>, lanes: Mask8<S>) -> Look<S> {
        let mut look = match &self.pieces {
            Pieces::One(texture) => {
                let color = texture.color(&Places { on_body: points, points, seen }, lanes);
                Look { color, material: U32x8::splat(0) }
            }
            Pieces::Chequer { origin, per_side, textures } => {
                let is_odd = is_odd(points, *origin, *per_side);
                let places = Places { on_body: points, points, seen };
                let mut color = Vec3x8::zero();
                for (texture, these) in textures.iter().zip([lanes.but(is_odd), lanes & is_odd]) {
                    if these.any() {
                        color = Vec3x8::select(these, texture.color(&places, these), color);
                    }
                }
                Look { color, material: number(is_odd) }
            }
            Pieces::Board(joinery) => joinery.look(points, seen, lanes),
        };
        if let Some(paint) = &self.paint {
            look.color = paint.over(look.color, points, seen, lanes);
        }
        look
    }

    /// Whether there is one material all over.
    pub fn is_uniform(&self) -> bool {
        matches!(self.pieces, Pieces::One(_))
    }

    /// Which material is at `points`, for those who need no colour.
    #[inline(always)]
    pub fn material<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> U32x8<S> {
        match &self.pieces {
            Pieces::One(_) => U32x8::splat(0),
            Pieces::Chequer { origin, per_side, .. } => number(is_odd(points, *origin, *per_side)),
            Pieces::Board(joinery) => joinery.material(points, lanes),
        }
    }
}

/// Where the sum of a chequer's column and row is odd.
#[inline(always)]
fn is_odd<S: Simd>(points: Vec3x8<S>, origin: Vec2, per_side: f32) -> Mask8<S> {
    let column = (points.x - F32x8::splat(origin.x)) * F32x8::splat(per_side);
    let row = (points.z - F32x8::splat(origin.y)) * F32x8::splat(per_side);
    let sum = column.floor().to_i32() + row.floor().to_i32();
    (sum & U32x8::splat(1)).eq(U32x8::splat(1))
}

/// 1 where the answer is yes, else 0.
#[inline(always)]
fn number<S: Simd>(mask: Mask8<S>) -> U32x8<S> {
    mask.select_words(U32x8::splat(1), U32x8::splat(0))
}

/// Calls `each` with every one of the `kinds` that `lanes` have, and with those who have it.
#[inline(always)]
fn for_each_kind<S: Simd>(kinds: U32x8<S>, lanes: Mask8<S>, mut each: impl FnMut(usize, Mask8<S>)) {
    let numbers = kinds.store();
    let mut left = lanes;
    while left.any() {
        let kind = numbers[left.bits().trailing_zeros() as usize % 8];
        let these = kinds.eq(U32x8::splat(kind)) & left;
        each(kind as usize, these);
        left = left.but(these);
    }
}
