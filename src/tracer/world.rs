//! What packets of rays ask a scene, whatever then becomes of the answers.

use std::sync::Arc;

use glam::{DMat3, Vec2, Vec3};

use super::cells::Grid;
use super::regions::{Regions, Space, Touched, rounded};
use crate::geometry::{Bounds, Solid as _};
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::boxes::{Aabb, Hierarchy, Way};
use crate::packet::solids::{Crossing, Normals, Solid};
use crate::packet::surfaces::{Look, Surface};
use crate::packet::{Rays, Transform};
use crate::scene::{Object, Scene};

use super::materials::Materials;
use super::shelf::Shelf;

/// How far off a surface its secondary rays begin, along the normal, in world units: enough not
/// to meet the surface itself, too little to miss what touches it.
pub const OFFSET: f32 = 1e-4;

/// How far below a surface its material is asked for: a flat face may be the very border between two
/// squares or two pictures, where rounding would choose.
const HAIR: f32 = 1e-4;

/// Surfaces of a body that are no farther apart along a ray, in world units, are one, which rounding meets
/// twice.
const ACROSS: f32 = 2e-5;

/// What stands for no body.
pub const NOTHING: u32 = u32::MAX;

/// A body of the scene.
struct Body {
    solid: Arc<Solid>,
    to_own: Transform,
    /// What carries normals from the solid's own space, where that is turned or stretched.
    normals: Option<[Vec3; 3]>,
    surface: Surface,
    /// Where the surface's materials begin in the world's.
    materials: u32,
    /// A box that is known to hold the body, with room for rounding.
    aabb: Aabb,
    roof: Option<Roof>,
    is_transparent: bool,
    is_endless: bool,
    /// Whether squares are painted on it.
    is_painted: bool,
    /// The regions that it takes.
    regions: Regions,
}

/// A level rectangle at the top of a body; see [`Object::roof`].
struct Roof {
    min: Vec2,
    max: Vec2,
    height: f32,
}

/// The part of a body that is its roof.
const ROOF: u32 = u32::MAX - 1;

/// A scene with what is needed to trace packets through it.
pub struct World<'a> {
    pub scene: &'a Scene,
    pub materials: Materials,
    /// What is opaque first: of surfaces in one place that of the first body is seen.
    bodies: Vec<Body>,
    grid: Grid,
    /// How the space is divided.
    space: Space,
    /// What stands in no cell, with a tree of its boxes; and what has no end.
    loose: Vec<usize>,
    boxes: Hierarchy,
    endless: Vec<usize>,
    /// Which bodies are transparent.
    transparent: Vec<usize>,
    /// Numbers by which bodies are told apart, whatever else there is.
    names: Vec<u32>,
}

/// Which rays still look for something, and how far.
#[derive(Clone, Copy)]
pub struct Search<S: Simd> {
    pub lanes: Mask8<S>,
    pub before: F32x8<S>,
}

/// Where rays meet bodies.
#[derive(Clone, Copy)]
pub struct Meeting<S: Simd> {
    pub t: F32x8<S>,
    /// [`NOTHING`] where nothing is met.
    pub body: U32x8<S>,
    part: U32x8<S>,
}

impl<S: Simd> Meeting<S> {
    /// Where anything is met.
    #[inline(always)]
    pub fn lanes(&self) -> Mask8<S> {
        !self.body.eq(U32x8::splat(NOTHING))
    }
}

/// What is seen where rays meet bodies.
#[derive(Clone, Copy)]
pub struct Sight<S: Simd> {
    pub point: Vec3x8<S>,
    pub normals: Normals<S>,
    pub color: Vec3x8<S>,
    /// By the world's [`Materials`].
    pub material: U32x8<S>,
}

impl<'a> World<'a> {
    /// `space` is the scene's.
    pub fn new(scene: &'a Scene, space: Space, shelf: &Shelf) -> World<'a> {
        let mut order: Vec<&Object> = scene.objects.iter().collect();
        order.sort_by_key(|object| object.surface.is_transparent());
        let mut world = World {
            scene,
            materials: Materials::default(),
            bodies: Vec::with_capacity(order.len()),
            grid: Grid::new(scene.cells),
            space,
            loose: Vec::new(),
            boxes: Hierarchy::new(&[], 0.0),
            endless: Vec::new(),
            transparent: Vec::new(),
            names: Vec::new(),
        };
        for (index, object) in order.into_iter().enumerate() {
            let materials = world.materials.add(object.surface.materials());
            let body = Body::new(object, shelf, materials, &space);
            match space.cell(object) {
                _ if body.is_endless => world.endless.push(index),
                Some(cell) => world.grid.stand(index, cell),
                None => world.loose.push(index),
            }
            if body.is_transparent {
                world.transparent.push(index);
            }
            world.names.push(name(object));
            world.bodies.push(body);
        }
        let bounds = |index: &usize| world.bodies[*index].aabb.bounds();
        let loose: Vec<Bounds> = world.loose.iter().map(bounds).collect();
        world.boxes = Hierarchy::new(&loose, 0.0);
        world
    }

    /// Whether anything can be seen through.
    pub fn is_transparent(&self) -> bool {
        !self.transparent.is_empty()
    }

    /// Numbers by which the bodies that rays meet are told apart.
    #[inline(always)]
    pub fn names<S: Simd>(&self, meeting: &Meeting<S>) -> U32x8<S> {
        U32x8::gather(&self.names, meeting.body)
    }

    /// Whether the body that rays meet has no end.
    #[inline(always)]
    pub fn is_endless<S: Simd>(&self, meeting: &Meeting<S>) -> Mask8<S> {
        let mut lanes = Mask8::no_lanes();
        for index in &self.endless {
            lanes = lanes | meeting.body.eq(U32x8::splat(*index as u32));
        }
        lanes
    }

    /// The nearest body in front of `rays` up to the distances `before`.
    #[inline(never)]
    pub fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
        touched: &mut Option<Touched<S>>,
    ) -> Meeting<S> {
        S::run(
            #[inline(always)]
            || {
                let nothing = U32x8::splat(NOTHING);
                let mut found = Meeting { t: before, body: nothing, part: nothing };
                self.visit(
                    rays,
                    Search { lanes, before },
                    #[inline(always)]
                    |index, lanes, search| {
                        let body = &self.bodies[index];
                        // A hair more, so that what is in one place is compared.
                        let limit = found.t * F32x8::splat(1.0 + 2.0 * f32::EPSILON);
                        let crossing = body.first(rays, limit, lanes);
                        let number = U32x8::splat(index as u32);
                        let is_first = crossing.t.eq(found.t) & number.below(found.body);
                        let closer = lanes & (crossing.t.lt(found.t) | is_first);
                        found.t = closer.select(crossing.t, found.t);
                        found.body = closer.select_words(number, found.body);
                        found.part = closer.select_words(crossing.part, found.part);
                        search.before = found.t;
                    },
                );
                if let Some(touched) = touched {
                    touched.add_way(&self.space, rays, found.t, lanes);
                }
                found
            },
        )
    }

    /// How much of lights at `distance` comes along `rays`: what is opaque holds all of it back, each
    /// surface of what is transparent lets its share through. (A line bends at none of them.)
    #[inline(never)]
    pub fn transmission<S: Simd>(
        &self,
        rays: &Rays<S>,
        distance: F32x8<S>,
        lanes: Mask8<S>,
        touched: &mut Option<Touched<S>>,
    ) -> F32x8<S> {
        S::run(
            #[inline(always)]
            || {
                let mut share = lanes.keep(F32x8::splat(1.0));
                let mut dark = Mask8::no_lanes();
                self.visit(
                    rays,
                    Search { lanes, before: distance },
                    #[inline(always)]
                    |index, lanes, search| {
                        let body = &self.bodies[index];
                        if body.is_transparent {
                            let passed = self.passed(body, rays, distance, lanes);
                            share = lanes.select(share * passed, share);
                        } else {
                            let blocked =
                                lanes & body.blocks(rays, F32x8::splat(0.0), distance, lanes);
                            share = blocked.select(F32x8::splat(0.0), share);
                            search.lanes = search.lanes.but(blocked);
                            dark = dark | blocked;
                            // Whatever else is in the way makes no difference.
                            if let Some(touched) = touched
                                && blocked.any()
                            {
                                touched.add(blocked, &body.regions);
                            }
                        }
                    },
                );
                if let Some(touched) = touched {
                    touched.add_way(&self.space, rays, distance, lanes.but(dark));
                }
                share
            },
        )
    }

    /// What the surfaces of a transparent body let through up to `distance`.
    fn passed<S: Simd>(
        &self,
        body: &Body,
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
                    let crossing = body.nearest(rays, after, distance, lanes);
                    lanes = lanes & crossing.t.lt(distance);
                    if !lanes.any() {
                        return share;
                    }
                    let point = rays.at(crossing.t);
                    let normals = body.normals(point, crossing.part, lanes);
                    let own = body.to_own.point(point - normals.flat * F32x8::splat(HAIR));
                    let material = body.surface.material(own, lanes) + U32x8::splat(body.materials);
                    let through = self.materials.transparency(material);
                    share = lanes.select(share * through, share);
                    after = lanes.select(crossing.t + F32x8::splat(ACROSS), after);
                }
            },
        )
    }

    /// Shows `look` the bodies that rays may meet, each with the lanes that may, as long as the search goes on:
    /// `look` may give up lanes, and shorten distances.
    #[inline(always)]
    fn visit<S: Simd>(
        &self,
        rays: &Rays<S>,
        mut search: Search<S>,
        mut look: impl FnMut(usize, Mask8<S>, &mut Search<S>),
    ) {
        for index in &self.endless {
            if search.lanes.any() {
                look(*index, search.lanes, &mut search);
            }
        }
        let (way, zero) = (Way::new(rays), F32x8::splat(0.0));
        self.boxes.along(
            &way,
            zero,
            search.before,
            search.lanes,
            #[inline(always)]
            |item, _, near| {
                look(self.loose[item], near, &mut search);
                (search.before, search.lanes)
            },
        );
        self.grid.visit(
            rays,
            way.per_length,
            &mut search,
            #[inline(always)]
            |index, lanes, search| {
                let near = lanes & self.bodies[index].aabb.may_meet(&way, zero, search.before);
                if near.any() {
                    look(index, near, search);
                }
            },
        );
    }

    /// What is seen of the bodies that rays meet, where widths of `seen` are seen at once.
    #[inline(always)]
    pub fn sight<S: Simd>(
        &self,
        rays: &Rays<S>,
        meeting: &Meeting<S>,
        seen: F32x8<S>,
        lanes: Mask8<S>,
        touched: &mut Option<Touched<S>>,
    ) -> Sight<S> {
        let point = rays.at(meeting.t);
        let zero = Vec3x8::zero();
        let mut sight = Sight {
            point,
            normals: Normals { flat: zero, smooth: zero },
            color: zero,
            material: U32x8::splat(0),
        };
        self.each(
            meeting,
            lanes,
            #[inline(always)]
            |body, lanes| {
                self.sight_of(body, point, meeting.part, seen, lanes, &mut sight);
                if let Some(touched) = touched
                    && body.is_painted
                {
                    touched.add_squares(&self.space, point, lanes);
                }
            },
        );
        sight
    }

    /// Adds what is seen of one body.
    #[inline(never)]
    fn sight_of<S: Simd>(
        &self,
        body: &Body,
        point: Vec3x8<S>,
        part: U32x8<S>,
        seen: F32x8<S>,
        lanes: Mask8<S>,
        sight: &mut Sight<S>,
    ) {
        S::run(
            #[inline(always)]
            || {
                let normals = body.normals(point, part, lanes);
                let own = body.to_own.point(point - normals.flat * F32x8::splat(HAIR));
                let Look { color, material } = body.surface.look(own, seen, lanes);
                let material = material + U32x8::splat(body.materials);
                sight.normals.flat = Vec3x8::select(lanes, normals.flat, sight.normals.flat);
                sight.normals.smooth = Vec3x8::select(lanes, normals.smooth, sight.normals.smooth);
                sight.color = Vec3x8::select(lanes, color, sight.color);
                sight.material = lanes.select_words(material, sight.material);
            },
        );
    }

    /// The materials of what rays meet, without more.
    #[inline(always)]
    pub fn material<S: Simd>(
        &self,
        rays: &Rays<S>,
        meeting: &Meeting<S>,
        lanes: Mask8<S>,
    ) -> U32x8<S> {
        let point = rays.at(meeting.t);
        let mut found = U32x8::splat(0);
        self.each(
            meeting,
            lanes,
            #[inline(always)]
            |body, lanes| {
                let material = if body.surface.is_uniform() {
                    U32x8::splat(body.materials)
                } else {
                    let normals = body.normals(point, meeting.part, lanes);
                    let own = body.to_own.point(point - normals.flat * F32x8::splat(HAIR));
                    body.surface.material(own, lanes) + U32x8::splat(body.materials)
                };
                found = lanes.select_words(material, found);
            },
        );
        found
    }

    /// Calls `look` once for each body that is met, with the lanes that meet it.
    #[inline(always)]
    fn each<S: Simd>(
        &self,
        meeting: &Meeting<S>,
        lanes: Mask8<S>,
        mut look: impl FnMut(&Body, Mask8<S>),
    ) {
        let bodies = meeting.body.store();
        let mut left = (lanes & meeting.lanes()).bits();
        while left != 0 {
            let index = bodies[left.trailing_zeros() as usize];
            let lanes = Mask8::from_bits(left) & meeting.body.eq(U32x8::splat(index));
            look(&self.bodies[index as usize], lanes);
            left &= !lanes.bits();
        }
    }

    /// The refractive index at `points`: that of all that is transparent, where it lies inside any of
    /// it (Turek 2008, 4.2).
    pub fn index_at<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> F32x8<S> {
        S::run(
            #[inline(always)]
            || {
                let mut inside = Mask8::no_lanes();
                for index in &self.transparent {
                    let body = &self.bodies[*index];
                    let near = body.aabb.holds(points) | Mask8::splat(body.is_endless);
                    let near = lanes.but(inside) & near;
                    if near.any() {
                        inside = inside | near & body.contains(points, near);
                    }
                }
                inside.select(F32x8::splat(self.scene.snell_index as f32), F32x8::splat(1.0))
            },
        )
    }
}

impl Body {
    fn new(object: &Object, shelf: &Shelf, materials: u32, space: &Space) -> Body {
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
            regions: space.regions(object),
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
    fn first<S: Simd>(&self, rays: &Rays<S>, before: F32x8<S>, lanes: Mask8<S>) -> Crossing<S> {
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

    #[inline(always)]
    fn blocks<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        self.solid.blocks(&self.to_own.rays(rays), after, before, lanes)
    }

    #[inline(always)]
    fn contains<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        self.solid.contains(self.to_own.point(points), lanes)
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

/// A hash (FNV's) of a body's place and seed.
fn name(object: &Object) -> u32 {
    let Bounds { min, max } = object.body.bounds();
    let numbers = [min, max].into_iter().flat_map(|corner| corner.to_array().map(f64::to_bits));
    let step = |hash: u64, number: u64| (hash ^ number).wrapping_mul(0x0000_0100_0000_01B3);
    let hash = numbers.chain([object.seed]).fold(0xCBF2_9CE4_8422_2325, step);
    (hash ^ hash >> 32) as u32
}
