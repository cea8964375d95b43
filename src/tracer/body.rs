//! Bodies as packets of rays ask them.

use std::sync::Arc;

use glam::{DMat3, DVec3, Vec2, Vec3};

use super::materials::Materials;
use super::shelf::Shelf;
use crate::geometry::Solid as _;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::boxes::{Aabb, Way};
use crate::packet::solids::{Crossing, Normals, Solid};
use crate::packet::surfaces::{Look, Surface};
use crate::packet::{Rays, Transform};
use crate::scene::Object;

/// How far below a surface its material is asked for: a flat face may be the very border between two
/// squares or two pictures, where rounding would choose.
const HAIR: f32 = 1e-4;

/// Surfaces of a body that are no farther apart along a ray, in world units, are one, which rounding meets
/// twice.
const ACROSS: f32 = 2e-5;

/// A body of the scene.
pub struct Body {
    solid: Arc<Solid>,
    to_own: Transform,
    /// What carries normals from the solid's own space, where that is turned or stretched.
    normals: Option<[Vec3; 3]>,
    surface: Surface,
    /// Where the surface's materials begin in the world's.
    materials: u32,
    /// A box that is known to hold the body, with room for rounding.
    pub aabb: Aabb,
    roof: Option<Roof>,
    pub is_transparent: bool,
    pub is_endless: bool,
    /// Whether squares are painted on it.
    pub is_painted: bool,
}

/// A level rectangle at the top of a body; see [`Object::roof`].
struct Roof {
    min: Vec2,
    max: Vec2,
    height: f32,
}

/// The part of a body that is its roof.
const ROOF: u32 = u32::MAX - 1;

impl Body {
    /// Its materials in the world's are those from `materials` on.
    pub fn new(object: &Object, shelf: &Shelf, materials: u32) -> Body {
        let transform = object.body.transform();
        let to_own = transform.inverse();
        let bounds = object.body.bounds();
        let is_endless = !bounds.is_finite();
        let [min, max] = rounded(bounds.min, bounds.max);
        let normals = to_own.matrix3.transpose();
        let is_turned = normals != DMat3::IDENTITY;
        Body {
            solid: shelf.solid(object.body.shared()),
            to_own: Transform::new(&to_own),
            normals: is_turned.then(|| {
                [normals.x_axis, normals.y_axis, normals.z_axis].map(|column| column.as_vec3())
            }),
            surface: Surface::new(object),
            materials,
            aabb: Aabb { min, max },
            roof: object.roof.map(|[min, max]| Roof {
                min: min.as_vec2(),
                max: max.as_vec2(),
                height: bounds.max.y as f32,
            }),
            is_painted: object.paint.is_some(),
            is_transparent: object.surface.is_transparent(),
            is_endless,
        }
    }

    #[inline(always)]
    fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        self.solid.nearest(&self.to_own.rays(rays), after, before, lanes)
    }

    /// The first crossing in front of rays.
    #[inline(always)]
    pub fn first<S: Simd>(&self, rays: &Rays<S>, before: F32x8<S>, lanes: Mask8<S>) -> Crossing<S> {
        let zero = F32x8::splat(0.0);
        let Some(Roof { min, max, height }) = self.roof else {
            return self.nearest(rays, zero, before, lanes);
        };
        let down = lanes & rays.direction.y.lt(zero);
        let t = (F32x8::splat(height) - rays.origin.y) / rays.direction.y;
        let Vec3x8 { x, z, .. } = rays.at(t);
        let within = down
            & t.gt(zero)
            & x.ge(F32x8::splat(min.x))
            & x.le(F32x8::splat(max.x))
            & z.ge(F32x8::splat(min.y))
            & z.le(F32x8::splat(max.y));
        let others = lanes.but(within);
        let found =
            if others.any() { self.nearest(rays, zero, before, others) } else { Crossing::none() };
        Crossing::select(within & t.lt(before), Crossing { t, part: U32x8::splat(ROOF) }, found)
    }

    /// Whether [`Body::first`] finds anything: yes wherever it does. This is cheaper.
    #[inline(always)]
    pub fn is_met<S: Simd>(&self, rays: &Rays<S>, before: F32x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        if self.roof.is_some() {
            return self.first(rays, before, lanes).t.lt(before);
        }
        self.blocks(rays, F32x8::splat(0.0), before, lanes)
    }

    #[inline(always)]
    pub fn blocks<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        self.solid.blocks(&self.to_own.rays(rays), after, before, lanes)
    }

    /// From which `points`, as far as that is known without asking, no way to any of the `others` meets it.
    #[inline(always)]
    pub fn is_in_front_of<S: Simd>(&self, points: Vec3x8<S>, others: &[Vec3]) -> Mask8<S> {
        let mut lanes = self.solid.is_in_front_of(self.to_own.point(points));
        for other in others {
            if lanes.any() {
                lanes = lanes & self.solid.is_in_front_of(self.to_own.point(Vec3x8::splat(*other)));
            }
        }
        lanes
    }

    /// Which of the `points` lie inside.
    #[inline(always)]
    pub fn holds<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        let near = lanes & (self.aabb.holds(points) | Mask8::splat(self.is_endless));
        if !near.any() {
            return near;
        }
        near & self.solid.contains(self.to_own.point(points), near)
    }

    /// Which rays may meet it before `before`.
    #[inline(always)]
    pub fn may_meet<S: Simd>(&self, way: &Way<S>, before: F32x8<S>) -> Mask8<S> {
        self.aabb.may_meet(way, F32x8::splat(0.0), before) | Mask8::splat(self.is_endless)
    }

    /// What its surfaces, being transparent, let through up to `distance`.
    #[inline(never)]
    pub fn passed<S: Simd>(
        &self,
        materials: &Materials,
        rays: &Rays<S>,
        distance: F32x8<S>,
        lanes: Mask8<S>,
    ) -> F32x8<S> {
        S::run(
            #[inline(always)]
            || {
                let mut share = F32x8::splat(1.0);
                let mut after = F32x8::splat(0.0);
                let mut lanes = lanes;
                loop {
                    let crossing = self.nearest(rays, after, distance, lanes);
                    lanes = lanes & crossing.t.lt(distance);
                    if !lanes.any() {
                        return share;
                    }
                    let material = self.material(rays.at(crossing.t), crossing.part, lanes);
                    let through = materials.transparency(material);
                    share = lanes.select(share * through, share);
                    after = lanes.select(crossing.t + F32x8::splat(ACROSS), after);
                }
            },
        )
    }

    /// The materials, by the world's, at points of parts.
    #[inline(always)]
    pub fn material<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        lanes: Mask8<S>,
    ) -> U32x8<S> {
        let first = U32x8::splat(self.materials);
        if self.surface.is_uniform() {
            return first;
        }
        let normals = self.normals(points, parts, lanes);
        self.surface.material(self.below(points, &normals), lanes) + first
    }

    /// What is seen at points of parts, where widths of `seen` are seen at once: normals, and colours with
    /// materials by the world's.
    #[inline(always)]
    pub fn look<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        seen: F32x8<S>,
        lanes: Mask8<S>,
    ) -> (Normals<S>, Look<S>) {
        let normals = self.normals(points, parts, lanes);
        let Look { color, material } = self.surface.look(self.below(points, &normals), seen, lanes);
        (normals, Look { color, material: material + U32x8::splat(self.materials) })
    }

    /// Points a hair below points of the surface, in the solid's own space.
    #[inline(always)]
    fn below<S: Simd>(&self, points: Vec3x8<S>, normals: &Normals<S>) -> Vec3x8<S> {
        self.to_own.point(points - normals.flat * F32x8::splat(HAIR))
    }

    #[inline(always)]
    fn normals<S: Simd>(&self, points: Vec3x8<S>, parts: U32x8<S>, lanes: Mask8<S>) -> Normals<S> {
        if self.roof.is_some() {
            let upward = Vec3x8::splat(Vec3::Y);
            let on_roof = lanes & parts.eq(U32x8::splat(ROOF));
            let others = lanes.but(on_roof);
            if !others.any() {
                return Normals::flat(upward);
            }
            let parts = others.select_words(parts, U32x8::splat(0));
            let normals = self.normals_of_solid(points, parts, others);
            return Normals {
                flat: Vec3x8::select(on_roof, upward, normals.flat),
                smooth: Vec3x8::select(on_roof, upward, normals.smooth),
            };
        }
        self.normals_of_solid(points, parts, lanes)
    }

    #[inline(always)]
    fn normals_of_solid<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        lanes: Mask8<S>,
    ) -> Normals<S> {
        let normals = self.solid.normals(self.to_own.point(points), parts, lanes);
        let Some([x, y, z]) = self.normals else {
            return normals;
        };
        let columns = [Vec3x8::splat(x), Vec3x8::splat(y), Vec3x8::splat(z)];
        Normals {
            flat: normals.flat.by_columns(&columns).normalized(),
            smooth: normals.smooth.by_columns(&columns).normalized(),
        }
    }
}

/// A box round `min` and `max` in f32, with no more room than rounding needs: rays that leave a face must not be
/// taken to begin inside.
fn rounded(min: DVec3, max: DVec3) -> [Vec3; 2] {
    let room = |corner: DVec3| corner.abs() * 4e-6 + 1e-6;
    [(min - room(min)).as_vec3(), (max + room(max)).as_vec3()]
}
