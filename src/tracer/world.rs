//! What packets of rays ask a scene, whatever then becomes of the answers.

use std::sync::Arc;

use glam::{DMat3, DVec3, Vec2, Vec3};
use smallvec::SmallVec;

use super::cells::Grid;
use super::cast::Cast;
use crate::geometry::{Bounds, Solid as _};
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::solids::{Crossing, Normals, Solid};
use crate::packet::surfaces::{Look, Surface};
use crate::packet::{Rays, Transform};
use crate::scene::{Object, Scene};

use super::materials::Materials;
use super::shelf::Shelf;
use super::ties::{NO_MEMBER, Ties8};
use super::tree::Tree;

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
    min: Vec3,
    max: Vec3,
    roof: Option<Roof>,
    is_transparent: bool,
    is_endless: bool,
    /// Whether squares are painted on it.
    is_painted: bool,
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
    /// What stands in no cell, and what has no end.
    loose: Vec<usize>,
    endless: Vec<usize>,
    /// Which bodies are transparent.
    transparent: Vec<usize>,
    /// Numbers by which bodies are told apart, whatever else there is.
    names: Vec<u32>,
    /// Where it is asked what pixels depend on: the bodies' numbers in the cast.
    members: Vec<u32>,
    absent: Option<Absent>,
}

/// Members of a cast that are not there, but may be in another picture.
struct Absent {
    bodies: Vec<(Members, Body)>,
    tree: Tree,
    are_transparent: bool,
}

/// The numbers of members that are opaque and fill the same space, or of a single one.
type Members = SmallVec<[u32; 4]>;

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
    /// Of the objects of `scene`. If it is one of the pictures of a `cast`, it is told what pixels depend on.
    pub fn new(scene: &'a Scene, shelf: &Shelf, cast: Option<&Cast>) -> World<'a> {
        let mut order: Vec<&Object> = scene.objects.iter().collect();
        order.sort_by_key(|object| object.surface.is_transparent());
        let mut world = World {
            scene,
            materials: Materials::default(),
            bodies: Vec::with_capacity(order.len()),
            grid: Grid::new(scene.cells),
            loose: Vec::new(),
            endless: Vec::new(),
            transparent: Vec::new(),
            names: Vec::new(),
            members: Vec::new(),
            absent: None,
        };
        for (index, object) in order.into_iter().enumerate() {
            let body = world.body(object, shelf);
            match scene.cells.cell(&object.body) {
                _ if body.is_endless => world.endless.push(index),
                Some(cell) => world.grid.stand(index, cell),
                None => world.loose.push(index),
            }
            if body.is_transparent {
                world.transparent.push(index);
            }
            world.names.push(name(object));
            world.members.push(cast.and_then(|cast| cast.number(object)).unwrap_or(NO_MEMBER));
            world.bodies.push(body);
        }
        world.absent = cast.map(|cast| world.absent(cast, shelf));
        world
    }

    fn body(&mut self, object: &Object, shelf: &Shelf) -> Body {
        let materials = self.materials.add(object.surface.materials());
        Body::new(object, shelf, materials)
    }

    fn absent(&mut self, cast: &Cast, shelf: &Shelf) -> Absent {
        let mut bodies: Vec<(Members, Body)> = Vec::new();
        let mut objects: Vec<&Object> = Vec::new();
        for (number, object) in (0..).zip(cast.members()) {
            if self.members.contains(&number) {
                continue;
            }
            let is_same = |known: &&Object| {
                let are_opaque = !known.surface.is_transparent() && !object.surface.is_transparent();
                are_opaque && known.is_same_body(object)
            };
            match objects.iter().position(is_same) {
                Some(index) => bodies[index].0.push(number),
                None => {
                    objects.push(object);
                    let body = self.body(&cast.envelope(object), shelf);
                    bodies.push((Members::from_slice(&[number]), body));
                }
            }
        }
        let boxes: Vec<[Vec3; 2]> = bodies.iter().map(|(_, body)| [body.min, body.max]).collect();
        let are_transparent = bodies.iter().any(|(_, body)| body.is_transparent);
        Absent { bodies, tree: Tree::new(&boxes), are_transparent }
    }

    /// Whether anything can be seen through.
    pub fn is_transparent(&self) -> bool {
        !self.transparent.is_empty()
            || self.absent.as_ref().is_some_and(|absent| absent.are_transparent)
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
        ties: &mut Option<Ties8<S>>,
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
                if let Some(ties) = ties {
                    let met = lanes & found.lanes();
                    ties.add_each(U32x8::gather(&self.members, found.body), met);
                    self.would_meet(rays, found.t, lanes, ties);
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
        ties: &mut Option<Ties8<S>>,
    ) -> F32x8<S> {
        S::run(
            #[inline(always)]
            || {
                let one = F32x8::splat(1.0);
                let mut share = lanes.keep(one);
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
                            if let Some(ties) = ties {
                                ties.add(self.members[index], lanes & passed.lt(one));
                            }
                        } else {
                            let blocked =
                                lanes & body.blocks(rays, F32x8::splat(0.0), distance, lanes);
                            share = blocked.select(F32x8::splat(0.0), share);
                            search.lanes = search.lanes.but(blocked);
                            dark = dark | blocked;
                            if let Some(ties) = ties {
                                ties.add(self.members[index], blocked);
                            }
                        }
                    },
                );
                if let Some(ties) = ties {
                    // Whatever else is in the way of what is dark makes no difference.
                    self.would_block(rays, distance, lanes.but(dark), ties);
                }
                share
            },
        )
    }

    /// Adds the absent bodies that rays would meet, up to the distances `before`.
    #[inline(never)]
    fn would_meet<S: Simd>(
        &self,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
        ties: &mut Ties8<S>,
    ) {
        S::run(
            #[inline(always)]
            || {
                let Some(absent) = &self.absent else { return };
                // A hair more, so that what is in one place counts.
                let before = before * F32x8::splat(1.0 + 4.0 * f32::EPSILON);
                absent.tree.visit(
                    rays,
                    before,
                    lanes,
                    #[inline(always)]
                    |index, lanes| {
                        let (members, body) = &absent.bodies[index];
                        let lanes = lanes.but(ties.have(members[0]));
                        if lanes.any() {
                            let met = lanes & body.first(rays, before, lanes).t.lt(before);
                            members.iter().for_each(|member| ties.add(*member, met));
                        }
                    },
                );
            },
        );
    }

    /// Adds the absent bodies that would hold back light from `distance`.
    #[inline(never)]
    fn would_block<S: Simd>(
        &self,
        rays: &Rays<S>,
        distance: F32x8<S>,
        lanes: Mask8<S>,
        ties: &mut Ties8<S>,
    ) {
        S::run(
            #[inline(always)]
            || {
                let Some(absent) = &self.absent else { return };
                absent.tree.visit(
                    rays,
                    distance,
                    lanes,
                    #[inline(always)]
                    |index, lanes| {
                        let (members, body) = &absent.bodies[index];
                        let lanes = lanes.but(ties.have(members[0]));
                        if !lanes.any() {
                            return;
                        }
                        let blocked = if body.is_transparent {
                            self.passed(body, rays, distance, lanes).lt(F32x8::splat(1.0))
                        } else {
                            body.blocks(rays, F32x8::splat(0.0), distance, lanes)
                        };
                        members.iter().for_each(|member| ties.add(*member, lanes & blocked));
                    },
                );
            },
        );
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
        let inverse = rays.direction.recips();
        for index in &self.loose {
            let body = &self.bodies[*index];
            let near = search.lanes & enters(rays, inverse, [body.min, body.max], search.before);
            if near.any() {
                look(*index, near, &mut search);
            }
        }
        self.grid.visit(
            rays,
            inverse,
            &mut search,
            #[inline(always)]
            |index, lanes, search| {
                let body = &self.bodies[index];
                let near = lanes & enters(rays, inverse, [body.min, body.max], search.before);
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
        ties: &mut Option<Ties8<S>>,
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
                if let Some(ties) = ties
                    && body.is_painted
                {
                    ties.add_cells(&self.scene.cells, point, lanes);
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
    pub fn index_at<S: Simd>(
        &self,
        points: Vec3x8<S>,
        lanes: Mask8<S>,
        ties: &mut Option<Ties8<S>>,
    ) -> F32x8<S> {
        S::run(
            #[inline(always)]
            || {
                let mut inside = Mask8::no_lanes();
                for index in &self.transparent {
                    let found = self.bodies[*index].holds(points, lanes.but(inside));
                    inside = inside | found;
                    if let Some(ties) = ties {
                        ties.add(self.members[*index], found);
                    }
                }
                if let (Some(ties), Some(absent)) = (ties, &self.absent) {
                    let clear = absent.bodies.iter().filter(|(_, body)| body.is_transparent);
                    for (members, body) in clear {
                        let held = body.holds(points, lanes.but(inside));
                        members.iter().for_each(|member| ties.add(*member, held));
                    }
                }
                inside.select(F32x8::splat(self.scene.snell_index as f32), F32x8::splat(1.0))
            },
        )
    }
}

/// Which rays may come into a box before `before`. What is infinite in `inverse` is so by a direction of
/// zero; on a face of the box such a ray counts as inside.
#[inline(always)]
pub fn enters<S: Simd>(
    rays: &Rays<S>,
    inverse: Vec3x8<S>,
    [min, max]: [Vec3; 2],
    before: F32x8<S>,
) -> Mask8<S> {
    let low = (Vec3x8::splat(min) - rays.origin).times(inverse);
    let high = (Vec3x8::splat(max) - rays.origin).times(inverse);
    let (near, far) = (low.min(high), low.max(high));
    let enter = near.x.max(near.y).max(near.z.max(F32x8::splat(0.0)));
    let exit = far.x.min(far.y).min(far.z.min(before));
    enter.le(exit)
}

impl Body {
    fn new(object: &Object, shelf: &Shelf, materials: u32) -> Body {
        let transform = object.body.transform();
        let to_own = transform.inverse();
        let bounds = object.body.bounds();
        let is_endless = !bounds.is_finite();
        let Bounds { min, max } = bounds;
        let [min, max] = rounded(min, max);
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
            min,
            max,
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

    /// Which of the `points` lie inside.
    #[inline(always)]
    fn holds<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        let (min, max) = (Vec3x8::splat(self.min), Vec3x8::splat(self.max));
        let near = points.x.ge(min.x) & points.y.ge(min.y) & points.z.ge(min.z);
        let near = near & points.x.le(max.x) & points.y.le(max.y) & points.z.le(max.z);
        let near = lanes & (near | Mask8::splat(self.is_endless));
        if !near.any() {
            return near;
        }
        near & self.solid.contains(self.to_own.point(points), near)
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

/// A box round `min` and `max` in f32, with no more room than rounding needs: rays that leave a face must not be
/// taken to begin inside.
fn rounded(min: DVec3, max: DVec3) -> [Vec3; 2] {
    let room = |corner: DVec3| corner.abs() * 4e-6 + 1e-6;
    [(min - room(min)).as_vec3(), (max + room(max)).as_vec3()]
}
