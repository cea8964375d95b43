//! Bodies that are not there, but will be in another picture.

use smallvec::{SmallVec, smallvec};

use super::body::Body;
use super::materials::Materials;
use super::ties::Ties8;
use crate::geometry::Bounds;
use crate::lanes::{F32x8, Mask8, Simd, Vec3x8};
use crate::packet::Rays;
use crate::packet::boxes::{Aabb, Hierarchy, Way};
use crate::packet::shaft::{Crowd, Few, Shaft};
use crate::scene::Object;

/// Members of a cast that are not there.
pub struct Absent {
    bodies: Vec<(Members, Body)>,
    boxes: Hierarchy,
    crowd: Crowd,
    pub are_transparent: bool,
}

/// The numbers of members that are opaque and fill the same space, or of a single one.
type Members = SmallVec<[u32; 4]>;

impl Absent {
    /// Of members with their numbers; `body` makes a body of an object.
    pub fn new<'a>(
        absent: impl Iterator<Item = (u32, &'a Object)>,
        mut body: impl FnMut(&Object) -> Body,
    ) -> Absent {
        let mut objects: Vec<&Object> = Vec::new();
        let mut bodies: Vec<(Members, Body)> = Vec::new();
        for (number, object) in absent {
            let is_opaque = |object: &Object| !object.surface.is_transparent();
            let is_same = |known: &&Object| {
                is_opaque(known) && is_opaque(object) && known.is_same_body(object)
            };
            match objects.iter().position(is_same) {
                Some(index) => bodies[index].0.push(number),
                None => {
                    objects.push(object);
                    bodies.push((smallvec![number], body(object)));
                }
            }
        }
        let bounds: Vec<Bounds> = bodies.iter().map(|(_, body)| body.aabb.bounds()).collect();
        let are_transparent = bodies.iter().any(|(_, body)| body.is_transparent);
        let crowd = Crowd::new(bodies.iter().map(|(_, body)| body.aabb));
        Absent { bodies, boxes: Hierarchy::new(&bounds, 0.0), crowd, are_transparent }
    }

    /// The boxes round them.
    pub fn boxes(&self) -> impl Iterator<Item = Aabb> {
        self.bodies.iter().map(|(_, body)| body.aabb)
    }

    /// Those that ways in a shaft may meet.
    #[inline(always)]
    pub fn among<S: Simd>(&self, shaft: &Shaft) -> Few {
        self.crowd.among::<S>(shaft)
    }

    /// Adds those that rays would meet, up to the distances `before`; if it is known that they can meet but a `few`, no
    /// others are asked.
    #[inline(never)]
    pub fn would_meet<S: Simd>(
        &self,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
        few: Option<&Few>,
        ties: &mut Ties8<S>,
    ) {
        S::run(
            #[inline(always)]
            || {
                // A hair more, so that what is in one place counts.
                let before = before * F32x8::splat(1.0 + 4.0 * f32::EPSILON);
                self.each(
                    rays,
                    before,
                    lanes,
                    few,
                    ties,
                    #[inline(always)]
                    |body, lanes| body.is_met(rays, before, lanes),
                );
            },
        );
    }

    /// Adds those of a `few` that would hold back light from `distance`.
    #[inline(never)]
    pub fn would_block<S: Simd>(
        &self,
        materials: &Materials,
        rays: &Rays<S>,
        distance: F32x8<S>,
        lanes: Mask8<S>,
        few: &Few,
        ties: &mut Ties8<S>,
    ) {
        S::run(
            #[inline(always)]
            || {
                self.each(
                    rays,
                    distance,
                    lanes,
                    Some(few),
                    ties,
                    #[inline(always)]
                    |body, lanes| {
                        if body.is_transparent {
                            let passed = body.passed(materials, rays, distance, lanes);
                            return passed.lt(F32x8::splat(1.0));
                        }
                        body.blocks(rays, F32x8::splat(0.0), distance, lanes)
                    },
                );
            },
        );
    }

    /// Adds those that are transparent and in which `points` would lie.
    #[inline(always)]
    pub fn would_hold<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>, ties: &mut Ties8<S>) {
        for (members, body) in self.bodies.iter().filter(|(_, body)| body.is_transparent) {
            let held = body.holds(points, lanes);
            members.iter().for_each(|member| ties.add(*member, held));
        }
    }

    /// Adds those of which `matters` says so, among a few or all, if rays enter their boxes before `before`.
    #[inline(always)]
    fn each<S: Simd>(
        &self,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
        few: Option<&Few>,
        ties: &mut Ties8<S>,
        matters: impl Fn(&Body, Mask8<S>) -> Mask8<S>,
    ) {
        let (way, zero) = (Way::new(rays), F32x8::splat(0.0));
        if let Some(few) = few {
            for item in few {
                let item = *item as usize;
                let near = lanes & self.bodies[item].1.aabb.may_meet(&way, zero, before);
                self.ask(item, near, ties, &matters);
            }
            return;
        }
        self.boxes.along(
            &way,
            zero,
            before,
            lanes,
            #[inline(always)]
            |item, before, near| {
                self.ask(item, near, ties, &matters);
                (before, lanes)
            },
        );
    }

    /// Adds one, where `matters` says so.
    #[inline(always)]
    fn ask<S: Simd>(
        &self,
        item: usize,
        near: Mask8<S>,
        ties: &mut Ties8<S>,
        matters: &impl Fn(&Body, Mask8<S>) -> Mask8<S>,
    ) {
        let (members, body) = &self.bodies[item];
        let new = near.but(ties.have(members[0]));
        if new.any() {
            let found = new & matters(body, new);
            for member in members {
                ties.add(*member, found);
            }
        }
    }
}
