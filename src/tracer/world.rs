//! What packets of rays ask a scene, whatever then becomes of the answers.

use glam::Vec3;

use super::absent::Absent;
use super::body::Body;
use super::cast::Cast;
use super::cells::Grid;
use crate::geometry::{Bounds, Solid as _};
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::Rays;
use crate::packet::boxes::{Aabb, Hierarchy, Way};
use crate::packet::shaft::{Crowd, Few, Shaft};
use crate::packet::solids::Normals;
use crate::packet::surfaces::Look;
use crate::scene::{Object, Scene};

use super::materials::Materials;
use super::shelf::Shelf;
use super::ties::{NO_MEMBER, Ties8};

/// How far off a surface its secondary rays begin, along the normal, in world units: enough not
/// to meet the surface itself, too little to miss what touches it.
pub const OFFSET: f32 = 1e-4;

/// Rays whose shaft may meet more bodies than these do not keep together.
const TOGETHER: usize = 8;

/// What stands for no body.
pub const NOTHING: u32 = u32::MAX;

/// A scene with what is needed to trace packets through it.
pub struct World<'a> {
    pub scene: &'a Scene,
    pub materials: Materials,
    /// What is opaque first: of surfaces in one place that of the first body is seen.
    bodies: Vec<Body>,
    grid: Grid,
    /// What stands in no cell, with a tree of its boxes; and what has no end.
    loose: Vec<usize>,
    boxes: Hierarchy,
    endless: Vec<usize>,
    /// All that has an end, for shafts; and the middle and the radius of a ball round it and what is absent.
    crowd: Crowd,
    ball: (Vec3, f32),
    /// Which bodies are transparent.
    transparent: Vec<usize>,
    /// Numbers by which bodies are told apart, whatever else there is.
    names: Vec<u32>,
    /// Where it is asked what pixels depend on: the bodies' numbers in the cast.
    members: Vec<u32>,
    absent: Option<Absent>,
}

/// Which rays still look for something, and how far.
#[derive(Clone, Copy)]
pub struct Search<S: Simd> {
    pub lanes: Mask8<S>,
    pub before: F32x8<S>,
}

/// What rays that keep together may meet, whatever has no end apart.
pub struct Candidates {
    /// Bodies that have an end.
    bodies: Few,
    /// Members of the cast that are not there, but would be.
    absent: Few,
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
    /// None so far, up to the distances `before`.
    #[inline(always)]
    fn nothing(before: F32x8<S>) -> Meeting<S> {
        let nothing = U32x8::splat(NOTHING);
        Meeting { t: before, body: nothing, part: nothing }
    }

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
            boxes: Hierarchy::new(&[], 0.0),
            endless: Vec::new(),
            crowd: Crowd::new([]),
            ball: (Vec3::ZERO, 0.0),
            transparent: Vec::new(),
            names: Vec::new(),
            members: Vec::new(),
            absent: None,
        };
        for (index, object) in order.into_iter().enumerate() {
            let materials = world.materials.add(object.surface.materials());
            let body = Body::new(object, shelf, materials);
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
        let bounds = |index: &usize| world.bodies[*index].aabb.bounds();
        let loose: Vec<Bounds> = world.loose.iter().map(bounds).collect();
        world.boxes = Hierarchy::new(&loose, 0.0);
        // What has none is never met there.
        let ends = |body: &Body| if body.is_endless { Aabb::union([]) } else { body.aabb };
        world.crowd = Crowd::new(world.bodies.iter().map(ends));
        world.absent = cast.map(|cast| {
            let others = (0..).zip(cast.members());
            let absent = others
                .filter(|(number, _)| cast.awaits(*number) && !world.members.contains(number));
            Absent::new(absent, |object| {
                let materials = world.materials.add(object.surface.materials());
                Body::new(&cast.envelope(object), shelf, materials)
            })
        });
        let absent = world.absent.iter().flat_map(Absent::boxes);
        let all = Aabb::union(world.bodies.iter().map(ends).chain(absent));
        if all.min.is_finite() {
            world.ball = (all.middle(), (all.max - all.min).length() / 2.0);
        }
        world
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
                let mut found = Meeting::nothing(before);
                self.visit(
                    rays,
                    Search { lanes, before },
                    #[inline(always)]
                    |index, lanes, search| {
                        self.meet(index, rays, lanes, &mut found);
                        search.before = found.t * F32x8::splat(1.0 + 4.0 * f32::EPSILON);
                    },
                );
                self.tell_met(rays, lanes, &found, None, ties);
                found
            },
        )
    }

    /// The same for rays, with directions of length 1, that are likely to keep together: those from the camera, or from
    /// mirrors.
    #[inline(never)]
    pub fn nearest_together<S: Simd>(
        &self,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
        ties: &mut Option<Ties8<S>>,
    ) -> Meeting<S> {
        S::run(
            #[inline(always)]
            || match self.ahead(std::slice::from_ref(rays), lanes) {
                Some(ahead) => self.nearest_of(&ahead, rays, before, lanes, ties),
                None => self.nearest(rays, before, lanes, ties),
            },
        )
    }

    /// What the `lanes` of packets of rays that are likely to keep together, with directions of length 1, may meet; if
    /// that is not few, nothing.
    #[inline(always)]
    pub fn ahead<S: Simd>(&self, packets: &[Rays<S>], lanes: Mask8<S>) -> Option<Candidates> {
        let from = Aabb::of_packets(packets, F32x8::splat(0.0), lanes);
        let ((middle, radius), spread) = (self.ball, (from.max - from.min).length());
        let reach = (from.middle() - middle).length() + spread + radius;
        let to = Aabb::of_packets(packets, F32x8::splat(1.001 * reach), lanes);
        let ahead = self.between::<S>(&from, &to);
        (ahead.bodies.len() <= TOGETHER).then_some(ahead)
    }

    /// The nearest body in front of rays that can meet, but for endless ones, none that is not `ahead`.
    #[inline(always)]
    pub fn nearest_of<S: Simd>(
        &self,
        ahead: &Candidates,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
        ties: &mut Option<Ties8<S>>,
    ) -> Meeting<S> {
        let (way, zero) = (Way::new(rays), F32x8::splat(0.0));
        let mut found = Meeting::nothing(before);
        for index in &self.endless {
            self.meet(*index, rays, lanes, &mut found);
        }
        for index in &ahead.bodies {
            let index = *index as usize;
            let before = found.t * F32x8::splat(1.0 + 4.0 * f32::EPSILON);
            let near = lanes & self.bodies[index].aabb.may_meet(&way, zero, before);
            if near.any() {
                self.meet(index, rays, near, &mut found);
            }
        }
        self.tell_met(rays, lanes, &found, Some(&ahead.absent), ties);
        found
    }

    /// Takes the first crossing of a body where it is the nearest so far.
    #[inline(always)]
    fn meet<S: Simd>(&self, index: usize, rays: &Rays<S>, lanes: Mask8<S>, found: &mut Meeting<S>) {
        // A hair more, so that what is in one place is compared.
        let limit = found.t * F32x8::splat(1.0 + 2.0 * f32::EPSILON);
        let crossing = self.bodies[index].first(rays, limit, lanes);
        let number = U32x8::splat(index as u32);
        let is_first = crossing.t.eq(found.t) & number.below(found.body);
        let closer = lanes & (crossing.t.lt(found.t) | is_first);
        found.t = closer.select(crossing.t, found.t);
        found.body = closer.select_words(number, found.body);
        found.part = closer.select_words(crossing.part, found.part);
    }

    /// Adds what it depends on that rays meet that, if it is asked for; of what is absent they can meet but a `few`,
    /// where that is known.
    #[inline(always)]
    fn tell_met<S: Simd>(
        &self,
        rays: &Rays<S>,
        lanes: Mask8<S>,
        found: &Meeting<S>,
        few: Option<&Few>,
        ties: &mut Option<Ties8<S>>,
    ) {
        if let (Some(ties), Some(absent)) = (ties, &self.absent) {
            let met = lanes & found.lanes();
            ties.add_each(U32x8::gather(&self.members, found.body), met);
            absent.would_meet(rays, found.t, lanes, few, ties);
        }
    }

    /// What may stand between points within `from` and a light within `to`.
    #[inline(always)]
    pub fn between<S: Simd>(&self, from: &Aabb, to: &Aabb) -> Candidates {
        let shaft = Shaft::new(from, to);
        let bodies = self.crowd.among::<S>(&shaft);
        Candidates { bodies, absent: self.absent_among::<S>(&shaft) }
    }

    #[inline(always)]
    fn absent_among<S: Simd>(&self, shaft: &Shaft) -> Few {
        match &self.absent {
            Some(absent) => absent.among::<S>(shaft),
            None => Few::new(),
        }
    }

    /// From which `points` nothing stands in the way of a light with these `corners`, if that is known without
    /// asking.
    #[inline(always)]
    pub fn is_open<S: Simd>(
        &self,
        points: Vec3x8<S>,
        corners: &[Vec3],
        between: &Candidates,
    ) -> Mask8<S> {
        if !between.bodies.is_empty() || !between.absent.is_empty() {
            return Mask8::no_lanes();
        }
        let mut open = Mask8::all_lanes();
        for index in &self.endless {
            open = open & self.bodies[*index].is_in_front_of(points, corners);
        }
        open
    }

    /// How much of lights at `distance` comes along `rays`: what is opaque holds all of it back, each
    /// surface of what is transparent lets its share through. (A line bends at none of them.) Nothing else that has an
    /// end may be in the way but what is `between`.
    #[inline(never)]
    pub fn transmission<S: Simd>(
        &self,
        rays: &Rays<S>,
        distance: F32x8<S>,
        lanes: Mask8<S>,
        between: &Candidates,
        ties: &mut Option<Ties8<S>>,
    ) -> F32x8<S> {
        S::run(
            #[inline(always)]
            || {
                let (way, zero) = (Way::new(rays), F32x8::splat(0.0));
                let mut open = lanes;
                let endless = self.endless.iter().map(|index| *index as u32);
                for index in endless.chain(between.bodies.iter().copied()) {
                    let body = &self.bodies[index as usize];
                    let near = open & body.may_meet(&way, distance);
                    if body.is_transparent || !near.any() {
                        continue;
                    }
                    let blocked = near & body.blocks(rays, zero, distance, near);
                    open = open.but(blocked);
                    if let Some(ties) = ties {
                        ties.add(self.members[index as usize], blocked);
                    }
                }
                // Whatever else is in the way of what is dark makes no difference.
                let mut share = open.keep(F32x8::splat(1.0));
                if !self.transparent.is_empty() {
                    share = self.dimmed(rays, distance, open, ties);
                }
                if let (Some(ties), Some(absent), false) =
                    (ties, &self.absent, between.absent.is_empty())
                {
                    let few = &between.absent;
                    absent.would_block(&self.materials, rays, distance, open, few, ties);
                }
                share
            },
        )
    }

    /// How much of what nothing opaque holds back gets through all that is transparent. It is asked in one order,
    /// by which products are rounded.
    #[inline(never)]
    fn dimmed<S: Simd>(
        &self,
        rays: &Rays<S>,
        distance: F32x8<S>,
        lanes: Mask8<S>,
        ties: &mut Option<Ties8<S>>,
    ) -> F32x8<S> {
        S::run(
            #[inline(always)]
            || {
                let (way, one) = (Way::new(rays), F32x8::splat(1.0));
                let mut share = lanes.keep(one);
                for index in &self.transparent {
                    let body = &self.bodies[*index];
                    let near = lanes & body.may_meet(&way, distance);
                    if near.any() {
                        let passed = body.passed(&self.materials, rays, distance, near);
                        share = near.select(share * passed, share);
                        if let Some(ties) = ties {
                            ties.add(self.members[*index], near & passed.lt(one));
                        }
                    }
                }
                share
            },
        )
    }

    /// Shows `look` the bodies that rays may meet, each with the lanes that may; `look` may shorten distances.
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
                let (normals, Look { color, material }) = body.look(point, part, seen, lanes);
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
                let material = body.material(point, meeting.part, lanes);
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
                    absent.would_hold(points, lanes.but(inside), ties);
                }
                inside.select(F32x8::splat(self.scene.snell_index as f32), F32x8::splat(1.0))
            },
        )
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
