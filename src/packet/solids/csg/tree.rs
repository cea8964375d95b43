//! Trees of solids as unions and intersections in turn, with the places of leaves multiplied out.

use glam::DAffine3;

use crate::geometry::{self, Bounds, Csg, Operation, Root, Shape};

/// A solid of many.
pub enum Tree<'a> {
    Leaf(Placed<'a>),
    Node(Joined<'a>),
}

/// A solid in its place.
pub struct Placed<'a> {
    pub solid: &'a dyn geometry::Solid,
    /// From its own space to the whole tree's.
    pub place: DAffine3,
    /// Whether what lies outside is meant.
    pub is_turned: bool,
    bounds: Bounds,
}

/// Members of which one's answer may be that of all.
pub struct Joined<'a> {
    /// The answer that one member alone can give: in a union that a point is inside.
    pub absorbing: bool,
    /// At least two; none is joined as this is.
    pub members: Vec<Tree<'a>>,
}

/// The tree of `solid`, which may be a leaf.
pub fn of(solid: &dyn geometry::Solid) -> Tree<'_> {
    gather(solid, DAffine3::IDENTITY, false)
}

fn gather(solid: &dyn geometry::Solid, place: DAffine3, is_turned: bool) -> Tree<'_> {
    match solid.shape() {
        Shape::Csg(csg) => gather_csg(csg, place, is_turned),
        Shape::Placed(placed) => gather(placed.solid(), place * placed.transform(), is_turned),
        _ => Tree::Leaf(Placed { solid, place, is_turned, bounds: solid.placed_bounds(&place) }),
    }
}

fn gather_csg(csg: &Csg, place: DAffine3, is_turned: bool) -> Tree<'_> {
    match csg.root() {
        Root::Leaf(solid) => gather(solid, place, is_turned),
        Root::Pair(operation, first, second) => {
            let absorbing = (operation == Operation::Union) != is_turned;
            let turns_second = operation == Operation::Difference;
            let members = [
                gather_csg(first, place, is_turned),
                gather_csg(second, place, is_turned != turns_second),
            ];
            let members = members.into_iter().flat_map(|member| match member {
                Tree::Node(node) if node.absorbing == absorbing => node.members,
                member => vec![member],
            });
            Tree::Node(Joined { absorbing, members: members.collect() })
        }
    }
}

impl Tree<'_> {
    /// A box round the whole surface.
    pub fn bounds(&self) -> Bounds {
        match self {
            Tree::Leaf(leaf) => leaf.bounds,
            Tree::Node(node) => node.bounds(),
        }
    }

    /// Whether points outside of the box are inside the solid.
    pub fn beyond(&self) -> bool {
        match self {
            Tree::Leaf(leaf) => leaf.is_turned,
            Tree::Node(node) => node.beyond(),
        }
    }
}

impl Joined<'_> {
    pub fn beyond(&self) -> bool {
        if self.members.iter().any(|member| self.absorbs_outside(member)) {
            self.absorbing
        } else {
            !self.absorbing
        }
    }

    /// Whether a member gives the absorbing answer outside of its box: then nothing of the node is there.
    pub fn absorbs_outside(&self, member: &Tree) -> bool {
        member.beyond() == self.absorbing
    }

    fn bounds(&self) -> Bounds {
        let absorbing = self.members.iter().filter(|member| self.absorbs_outside(member));
        let common = absorbing.map(Tree::bounds).reduce(Bounds::intersection);
        common.unwrap_or_else(|| {
            self.members.iter().map(Tree::bounds).fold(Bounds::EMPTY, Bounds::union)
        })
    }
}

impl Placed<'_> {
    /// Whether this is the solid itself.
    pub fn is_bare(&self) -> bool {
        self.place == DAffine3::IDENTITY && !self.is_turned
    }
}
