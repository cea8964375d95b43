//! Constructive solid geometry for packets, without lists of spans.
//!
//! Differences are intersections with what lies outside of their second members, so that a tree is
//! unions and intersections in turn, of leaves that may be turned inside out. One rule serves both: a node has
//! an *absorbing* answer (of a union "inside", of an intersection "outside") that one member alone can
//! give. Where none gives it, the node's next crossing is the nearest of its members' next
//! ones. Where one does, nothing happens before that member's next crossing: the search jumps there,
//! and on, until no member absorbs; the crossing that was jumped to last is the node's.
//!
//! After a jump members are asked [`ACROSS`] behind the crossing: there walls that are in one place are
//! behind the ray together, whatever rounding made of each.

mod leaf;
mod line;
mod node;
mod tree;

use super::{Crossing, Normals, Solid};
use crate::geometry;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::{Rays, boxes};
use leaf::Leaf;
use line::Line;
use node::{Member, Node, Parts};
use tree::Tree;

/// How far behind a crossing a search goes on, in units of length: more than rounding errors, less than
/// what rays keep from surfaces that they leave.
const ACROSS: f32 = 2e-5;

/// Solids in their places, and trees of them.
pub struct Csg {
    root: Member,
    nodes: Vec<Node>,
    /// In the order of the tree: of walls in one place the first one's counts.
    leaves: Vec<Leaf>,
    /// How many lower bits of a part are the leaf's own; those above are the leaf's number.
    own_bits: u32,
}

/// A tree, or the solid itself where it is no more than one in its place.
pub fn simplest(solid: &dyn geometry::Solid) -> Solid {
    match tree::of(solid) {
        Tree::Leaf(leaf) if leaf.is_bare() => Solid::new(leaf.solid),
        tree => Solid::Csg(Csg::new(&tree)),
    }
}

impl Csg {
    fn new(tree: &Tree) -> Csg {
        let margin = boxes::margin(&tree.bounds());
        let mut parts = Parts::default();
        let root = parts.add(tree, margin);
        let Parts { nodes, leaves, .. } = parts;
        // Numbers stay below 2³¹, where they can be compared as signed ones.
        let own_bits = 31 - leaves.len().next_power_of_two().trailing_zeros();
        Csg { root, nodes, leaves, own_bits }
    }

    #[inline(always)]
    pub fn nearest<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        match self.root {
            Member::Leaf(leaf) => self.leaves[leaf].nearest(rays, after, before, lanes),
            Member::Node(node) => self.nearest_of_root(node, rays, after, before, lanes),
        }
    }

    #[inline(always)]
    pub fn blocks<S: Simd>(
        &self,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        match self.root {
            Member::Leaf(leaf) => self.leaves[leaf].blocks(rays, after, before, lanes),
            Member::Node(node) => self.root_blocks(node, rays, after, before, lanes),
        }
    }

    #[inline(always)]
    pub fn contains<S: Simd>(&self, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        self.member_holds(self.root, points, lanes)
    }

    #[inline(always)]
    pub fn normals<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        lanes: Mask8<S>,
    ) -> Normals<S> {
        match self.root {
            Member::Leaf(leaf) => self.leaves[leaf].normals(points, parts, lanes),
            Member::Node(_) => self.normals_of_leaves(points, parts, lanes),
        }
    }

    #[inline(never)]
    fn nearest_of_root<S: Simd>(
        &self,
        node: usize,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        S::run(
            #[inline(always)]
            || {
                let (line, moved) = Line::new(rays, self.nodes[node].middle());
                let found = self.nearest_of_node(
                    node,
                    &line,
                    after - moved + line.across,
                    before - moved,
                    lanes,
                );
                Crossing::between(found.t + moved, found.part, after, before)
            },
        )
    }

    #[inline(never)]
    fn root_blocks<S: Simd>(
        &self,
        node: usize,
        rays: &Rays<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        S::run(
            #[inline(always)]
            || {
                let (line, moved) = Line::new(rays, self.nodes[node].middle());
                let (after, before) = (after - moved + line.across, before - moved);
                self.node_blocks(node, &line, after, before, lanes)
            },
        )
    }

    /// Asks each leaf once for all lanes that hit it.
    #[inline(never)]
    fn normals_of_leaves<S: Simd>(
        &self,
        points: Vec3x8<S>,
        parts: U32x8<S>,
        lanes: Mask8<S>,
    ) -> Normals<S> {
        S::run(
            #[inline(always)]
            || {
                let numbers = parts >> self.own_bits;
                let own = parts & U32x8::splat((1 << self.own_bits) - 1);
                let each = numbers.store();
                let mut normals = Normals::flat(Vec3x8::zero());
                let mut rest = lanes;
                while rest.any() {
                    let number = each[rest.bits().trailing_zeros() as usize];
                    let hit = rest & numbers.eq(U32x8::splat(number));
                    // Lanes that were asked for hit something: there is such a leaf.
                    if let Some(leaf) = self.leaves.get(number as usize) {
                        let found = leaf.normals(points, own, hit);
                        normals.flat = Vec3x8::select(hit, found.flat, normals.flat);
                        normals.smooth = Vec3x8::select(hit, found.smooth, normals.smooth);
                    }
                    rest = rest.but(hit);
                }
                normals
            },
        )
    }
}
