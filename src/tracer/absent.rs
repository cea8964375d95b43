//! Bodies that are not there, but will be in another picture.

use smallvec::{SmallVec, smallvec};

use super::body::Body;
use super::materials::Materials;
use super::ties::Ties8;
use crate::geometry::Bounds;
use crate::lanes::{F32x8, Mask8, Simd, Vec3x8};
use crate::packet::Rays;
use crate::packet::boxes::{Aabb, Hierarchy, Way};
use crate::packet::shaft::{Crowd, Shaft};
use crate::scene::Object;

/// Members of a cast that are not there.
pub struct Absent {
    bodies: Vec<(Members, Body)>,
    boxes: Hierarchy,
    /// The box round all of them: to ask each takes longer than to ask the rays.
    all: Crowd,
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
        let all = Aabb::union(bodies.iter().map(|(_, body)| body.aabb));
        Absent {
            bodies,
            boxes: Hierarchy::new(&bounds, 0.0),
            all: Crowd::new([all]),
            are_transparent,
        }
    }

    /// Whether ways in a shaft may meet any.
    #[inline(always)]
    pub fn may_be_in<S: Simd>(&self, shaft: &Shaft) -> bool {
        self.all.is_met::<S>(shaft)
    }

    /// Adds those that rays would meet, up to the distances `before`.
    #[inline(never)]
    pub fn would_meet<S: Simd>(
        &self,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
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
                    ties,
                    #[inline(always)]
                    |body, lanes| body.is_met(rays, before, lanes),
                );
            },
        );
    }

    /// Adds those that would hold back light from `distance`.
    #[inline(never)]
    pub fn would_block<S: Simd>(
        &self,
        materials: &Materials,
        rays: &Rays<S>,
        distance: F32x8<S>,
        lanes: Mask8<S>,
        ties: &mut Ties8<S>,
    ) {
        S::run(
            #[inline(always)]
            || {
                self.each(
                    rays,
                    distance,
                    lanes,
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

    /// Adds those of which `matters` says so, among those whose boxes rays enter before `before`.
    #[inline(always)]
    fn each<S: Simd>(
        &self,
        rays: &Rays<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
        ties: &mut Ties8<S>,
        matters: impl Fn(&Body, Mask8<S>) -> Mask8<S>,
    ) {
        self.boxes.along(
            &Way::new(rays),
            F32x8::splat(0.0),
            before,
            lanes,
            #[inline(always)]
            |item, before, near| {
                let (members, body) = &self.bodies[item];
                let new = near.but(ties.have(members[0]));
                if new.any() {
                    let found = new & matters(body, new);
                    members.iter().for_each(|member| ties.add(*member, found));
                }
                (before, lanes)
            },
        );
    }
}
