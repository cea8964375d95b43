//! The search along rays through a node's members.

use glam::Vec3;

use super::leaf::{Leaf, Made};
use super::line::Line;
use super::tree::Tree;
use super::{Crossing, Csg};
use crate::geometry::Bounds;
use crate::lanes::{F32x8, Mask8, Simd, U32x8, Vec3x8};
use crate::packet::boxes::{Aabb, Hierarchy};

/// A union, or an intersection.
pub struct Node {
    /// The answer that one member alone can give.
    absorbing: bool,
    /// Round the whole surface.
    aabb: Aabb,
    /// Whether points outside of the box are inside.
    beyond: bool,
    /// Members that absorb outside of their boxes, as the solids of an intersection do: all of them count
    /// everywhere.
    wide: Vec<Member>,
    /// Members that absorb only within their boxes: those of a union, or what is cut off.
    local: Vec<Member>,
    /// Which of these have boxes that end in all directions: they absorb nowhere for ever.
    is_bounded: Vec<bool>,
    boxes: Hierarchy,
}

/// A member of a node, by its number.
#[derive(Clone, Copy)]
pub enum Member {
    Leaf(usize),
    Node(usize),
}

/// The nodes and leaves of a tree that is being built.
#[derive(Default)]
pub struct Parts {
    pub nodes: Vec<Node>,
    pub leaves: Vec<Leaf>,
    made: Made,
}

impl Parts {
    /// Adds a tree whose boxes are to be larger by `margin`.
    pub fn add(&mut self, tree: &Tree, margin: f64) -> Member {
        let joined = match tree {
            Tree::Leaf(leaf) => {
                self.leaves.push(Leaf::new(leaf, &mut self.made));
                return Member::Leaf(self.leaves.len() - 1);
            }
            Tree::Node(joined) => joined,
        };
        let (mut wide, mut local, mut bounds) = (Vec::new(), Vec::new(), Vec::new());
        for member in &joined.members {
            let added = self.add(member, margin);
            if joined.absorbs_outside(member) {
                wide.push(added);
            } else {
                local.push(added);
                bounds.push(member.bounds());
            }
        }
        self.nodes.push(Node {
            absorbing: joined.absorbing,
            aabb: Aabb::new(&tree.bounds(), margin),
            beyond: joined.beyond(),
            wide,
            local,
            is_bounded: bounds.iter().map(Bounds::is_finite).collect(),
            boxes: Hierarchy::new(&bounds, margin),
        });
        Member::Node(self.nodes.len() - 1)
    }
}

/// How far a search has come in each lane.
struct Search<S: Simd> {
    /// Where members are asked: behind the last crossing.
    at: F32x8<S>,
    /// The crossing that was jumped to last, and whose member's number it is.
    last: Crossing<S>,
    by: U32x8<S>,
    /// Lanes in which a member may absorb.
    open: Mask8<S>,
    /// Those that have jumped since the round began.
    jumped: Mask8<S>,
    /// Those in which a member absorbed at the beginning: `last` is their answer.
    absorbed: Mask8<S>,
}

impl Node {
    /// The body of a node that is one body less small parts of it.
    fn cut(&self) -> Option<Member> {
        let is_cut = !self.absorbing && self.wide.len() == 1 && !self.local.is_empty();
        is_cut.then(|| self.wide[0])
    }

    pub fn middle(&self) -> Vec3 {
        self.aabb.middle()
    }
}

impl Csg {
    #[inline(always)]
    fn nearest_of_member<S: Simd>(
        &self,
        member: Member,
        line: &Line<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        match member {
            Member::Leaf(leaf) => {
                let found = self.leaves[leaf].nearest(&line.rays, after, before, lanes);
                let number = U32x8::splat((leaf as u32) << self.own_bits);
                Crossing { part: found.part | number, ..found }
            }
            Member::Node(node) => self.nearest_of_node(node, line, after, before, lanes),
        }
    }

    #[inline(always)]
    pub fn member_holds<S: Simd>(
        &self,
        member: Member,
        points: Vec3x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        match member {
            Member::Leaf(leaf) => self.leaves[leaf].holds(points, lanes),
            Member::Node(node) => self.node_holds(node, points, lanes),
        }
    }

    /// In which of `lanes` a member of `node` gives the absorbing answer.
    #[inline(always)]
    fn absorbs<S: Simd>(
        &self,
        node: &Node,
        member: Member,
        points: Vec3x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        let holds = self.member_holds(member, points, lanes);
        if node.absorbing { lanes & holds } else { lanes.but(holds) }
    }

    /// Whether points lie inside of a node.
    #[inline(never)]
    fn node_holds<S: Simd>(&self, node: usize, points: Vec3x8<S>, lanes: Mask8<S>) -> Mask8<S> {
        S::run(
            #[inline(always)]
            || {
                let node = &self.nodes[node];
                let within = lanes & node.aabb.holds(points);
                let mut rest = within;
                for member in &node.wide {
                    if !rest.any() {
                        break;
                    }
                    rest = rest.but(self.absorbs(node, *member, points, rest));
                }
                let is_left = rest;
                node.boxes.around(
                    points,
                    is_left,
                    #[inline(always)]
                    |item, near| {
                        rest = rest.but(self.absorbs(node, node.local[item], points, near));
                        (points, rest)
                    },
                );
                let inside = if node.absorbing { within.but(rest) } else { rest };
                if node.beyond { inside | !within } else { inside }
            },
        )
    }

    /// The first crossing of a node's surface between two distances.
    #[inline(never)]
    pub fn nearest_of_node<S: Simd>(
        &self,
        node: usize,
        line: &Line<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        S::run(
            #[inline(always)]
            || {
                let node = &self.nodes[node];
                let (enter, exit) = node.aabb.clip(&line.way);
                let lanes = lanes & enter.max(after).le(exit.min(before));
                if !lanes.any() {
                    return Crossing::none();
                }
                // What is cut somewhere else is whole.
                let (lanes, whole) = match node.cut() {
                    None => (lanes, Crossing::none()),
                    Some(body) => {
                        let near = node.boxes.may_meet(&line.way, after, before, lanes);
                        let far = lanes.but(near);
                        let whole = if far.any() {
                            self.nearest_of_member(body, line, after, before, far)
                        } else {
                            Crossing::none()
                        };
                        let whole = Crossing::between(whole.t, whole.part, after, before);
                        if !near.any() {
                            return whole;
                        }
                        (near, Crossing::select(far, whole, Crossing::none()))
                    }
                };
                let at = enter.max(after);
                // What is outside of all boxes is absorbed by wide members, or by none.
                let open = if node.wide.is_empty() { lanes & enter.le(after) } else { lanes };
                let (absorbed, last) = self.leave_absorbing(node, line, at, before, open);
                let free = lanes.but(absorbed);
                let nearest = self.nearest_of_any(node, line, at, before, free);
                let found = Crossing::select(absorbed, last, nearest);
                let found = Crossing::between(found.t, found.part, after, before);
                Crossing::select(lanes, found, whole)
            },
        )
    }

    /// Whether a node's surface is crossed anywhere between two distances.
    #[inline(always)]
    pub fn node_blocks<S: Simd>(
        &self,
        index: usize,
        line: &Line<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Mask8<S> {
        let node = &self.nodes[index];
        let (enter, exit) = node.aabb.clip(&line.way);
        let lanes = lanes & enter.max(after).le(exit.min(before));
        // Rays that begin or end outside of a union cross its surface if they cross any member's.
        let is_any = enter.gt(after) | exit.lt(before);
        let easy = if node.absorbing && !node.beyond { lanes & is_any } else { lanes.but(lanes) };
        let mut hard = lanes.but(easy);
        let mut blocked = Mask8::no_lanes();
        if let Some(Member::Leaf(leaf)) = node.cut() {
            let far = hard.but(node.boxes.may_meet(&line.way, after, before, hard));
            if far.any() {
                let found = self.leaves[leaf].blocks(&line.rays, after, before, far);
                blocked = far & found;
                hard = hard.but(far);
            }
        }
        let mut rest = easy;
        node.boxes.along(
            &line.way,
            after,
            before,
            easy,
            #[inline(always)]
            |item, _, near| {
                let found = match node.local[item] {
                    Member::Leaf(leaf) => self.leaves[leaf].blocks(&line.rays, after, before, near),
                    Member::Node(node) => {
                        self.nearest_of_node(node, line, after, before, near).is_one()
                    }
                };
                blocked = blocked | (found & near);
                rest = rest.but(blocked);
                (before, rest)
            },
        );
        if hard.any() {
            let found = self.nearest_of_node(index, line, after, before, hard);
            blocked = blocked | (hard & found.is_one());
        }
        blocked
    }

    /// Where no member absorbs: the nearest crossing of any.
    #[inline(always)]
    fn nearest_of_any<S: Simd>(
        &self,
        node: &Node,
        line: &Line<S>,
        after: F32x8<S>,
        before: F32x8<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        let mut best = Crossing { t: before, part: U32x8::splat(0) };
        if lanes.any() {
            for member in &node.wide {
                best = self.nearer(*member, line, after, best, lanes);
            }
        }
        let start = best.t + line.across;
        node.boxes.along(
            &line.way,
            after,
            start,
            lanes,
            #[inline(always)]
            |item, _, near| {
                best = self.nearer(node.local[item], line, after, best, near);
                (best.t + line.across, lanes)
            },
        );
        best
    }

    /// The nearer one of `best` and a member's next crossing; the first one's of walls in one place, in
    /// whatever order they come.
    #[inline(always)]
    fn nearer<S: Simd>(
        &self,
        member: Member,
        line: &Line<S>,
        after: F32x8<S>,
        best: Crossing<S>,
        lanes: Mask8<S>,
    ) -> Crossing<S> {
        let found = self.nearest_of_member(member, line, after, best.t + line.across, lanes);
        let is_first = (found.part - best.part).shr_signed(31).eq(U32x8::splat(u32::MAX));
        let is_nearer = found.t.lt(best.t) | (found.t.eq(best.t) & is_first);
        Crossing::select(lanes & is_nearer, found, best)
    }

    /// In which lanes of `open` a member absorbs at `at`, and there the crossing from which on none does.
    #[inline(always)]
    fn leave_absorbing<S: Simd>(
        &self,
        node: &Node,
        line: &Line<S>,
        at: F32x8<S>,
        before: F32x8<S>,
        open: Mask8<S>,
    ) -> (Mask8<S>, Crossing<S>) {
        let mut search = Search {
            at,
            last: Crossing::none(),
            by: U32x8::splat(u32::MAX),
            open,
            jumped: Mask8::no_lanes(),
            absorbed: Mask8::no_lanes(),
        };
        while search.open.any() {
            for index in 0..node.wide.len() {
                self.jump(node, line, before, index, search.open, &mut search);
            }
            let (points, open) = (line.rays.at(search.at), search.open);
            node.boxes.around(
                points,
                open,
                #[inline(always)]
                |item, near| {
                    self.jump(node, line, before, node.wide.len() + item, near, &mut search);
                    (line.rays.at(search.at), search.open)
                },
            );
            // Who has not jumped was asked by all members, and none absorbs.
            search.open = search.open & search.jumped;
            search.jumped = Mask8::no_lanes();
        }
        (search.absorbed, search.last)
    }

    /// Jumps to the next crossing of a member, by its number among all, in those of `lanes` in which it
    /// absorbs.
    #[inline(always)]
    fn jump<S: Simd>(
        &self,
        node: &Node,
        line: &Line<S>,
        before: F32x8<S>,
        index: usize,
        lanes: Mask8<S>,
        search: &mut Search<S>,
    ) {
        let number = U32x8::splat(index as u32);
        // Back at the member that was jumped to last, all others have been asked.
        let is_done = lanes & search.by.eq(number);
        search.open = search.open.but(is_done);
        let lanes = lanes.but(is_done);
        if !lanes.any() {
            return;
        }
        let local = index.checked_sub(node.wide.len());
        let member = local.map_or_else(|| node.wide[index], |local| node.local[local]);
        let absorbs = self.absorbs(node, member, line.rays.at(search.at), lanes);
        if !absorbs.any() {
            return;
        }
        let ends = local.is_some_and(|local| node.is_bounded[local]);
        let limit = if ends { F32x8::splat(f32::INFINITY) } else { before };
        let found = self.nearest_of_member(member, line, search.at, limit, absorbs);
        let jumps = absorbs & found.is_one();
        search.last = Crossing::select(jumps, found, search.last);
        search.by = jumps.select_words(number, search.by);
        search.at = jumps.select(found.t + line.across, search.at);
        search.jumped = search.jumped | jumps;
        search.absorbed = search.absorbed | jumps;
        search.open = search.open.but(jumps & found.t.ge(before));
        if !ends {
            // It absorbs as far as was asked.
            let is_lost = absorbs.but(jumps);
            search.last = Crossing::select(is_lost, Crossing::none(), search.last);
            search.absorbed = search.absorbed | is_lost;
            search.open = search.open.but(is_lost);
        }
        // Else a surface so near was no more than touched: the member does not count.
    }
}
