//! Solids as POV-Ray writes them.

use std::fmt::Write;

use glam::DVec2;

use super::{Angled, Writer, vector};
use crate::geometry::{Csg, Lathe, Operation, Plane, Prism, Root, Segment, Shape, Solid};

/// So many segments of a lathe make one lathe of POV-Ray's: it asks all segments of one for each
/// ray, and bounds each by a box.
const RUN: usize = 8;

/// What POV-Ray must know of a solid.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// Where its surface is.
    Skin,
    /// Its inside too: something is cut from it, or with it.
    Carved,
    /// Its inside, and no surface within it: it is transparent.
    Clear,
}

impl Use {
    fn carved(self) -> Use {
        if self == Use::Skin { Use::Carved } else { self }
    }
}

impl Writer<'_> {
    pub(super) fn solid(&mut self, solid: &dyn Solid, depth: usize, used: Use) {
        let pad = "  ".repeat(depth);
        match solid.shape() {
            Shape::Plane(Plane { origin, normal }) => {
                let distance = origin.dot(*normal);
                line!(self, "{pad}plane {{ {}, {distance} }}", vector(*normal));
            }
            Shape::Sphere(sphere) => {
                line!(self, "{pad}sphere {{ {}, {} }}", vector(sphere.center), sphere.radius);
            }
            Shape::Cuboid(cuboid) => {
                line!(self, "{pad}box {{ {}, {} }}", vector(cuboid.min), vector(cuboid.max));
            }
            Shape::Lathe(lathe) => self.lathe(lathe, depth, used),
            Shape::Prism(prism) => self.prism(prism, &pad),
            Shape::Csg(csg) => self.csg(csg, depth, used),
            Shape::Placed(placed) => {
                line!(self, "{pad}object {{");
                self.solid(placed.solid(), depth + 1, used);
                self.transform(depth + 1, placed.transform());
                line!(self, "{pad}}}");
            }
        }
    }

    fn lathe(&mut self, lathe: &Lathe, depth: usize, used: Use) {
        let pad = "  ".repeat(depth);
        let segments = lathe.segments();
        self.say_if_smooth(segments, &pad);
        if used != Use::Skin || segments.len() <= RUN {
            self.lathe_run(segments, &pad);
            return;
        }
        line!(self, "{pad}union {{");
        for chain in segments.chunk_by(|one, next| one.to == next.from) {
            for run in chain.chunks(RUN) {
                self.lathe_run(run, &format!("{pad}  "));
            }
        }
        line!(self, "{pad}}}");
    }

    fn lathe_run(&mut self, segments: &[Segment], pad: &str) {
        let mut points: Vec<DVec2> =
            segments.iter().flat_map(|segment| [segment.from, segment.to]).collect();
        points.dedup();
        line!(self, "{pad}lathe {{ linear_spline {}, {} }}", points.len(), listed(&points));
    }

    fn prism(&mut self, prism: &Prism, pad: &str) {
        let segments = prism.segments();
        self.say_if_smooth(segments, pad);
        // Its last point is its first one again.
        let first = segments.first().map(|segment| segment.from);
        let points: Vec<DVec2> = segments.iter().map(|segment| segment.from).chain(first).collect();
        let (back, front) = (prism.bounds().min.z, prism.bounds().max.z);
        line!(self, "{pad}prism {{");
        line!(self, "{pad}  linear_spline linear_sweep {back}, {front}, {},", points.len());
        line!(self, "{pad}  {}", listed(&points));
        // Its outlines lie in the plane of x and z and go along y.
        line!(self, "{pad}  matrix <1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0>");
        line!(self, "{pad}}}");
    }

    fn say_if_smooth(&mut self, segments: &[Segment], pad: &str) {
        if segments.iter().any(|segment| segment.smooth != [segment.normal; 2]) {
            line!(self, "{pad}// Smooth in lightsquare, flat here.");
        }
    }

    fn csg(&mut self, csg: &Csg, depth: usize, used: Use) {
        let (operation, first) = match csg.root() {
            Root::Leaf(solid) => return self.solid(solid, depth, used),
            Root::Pair(operation, ..) => (operation, csg),
        };
        // A chain of the same operation is one list.
        let mut others = Vec::new();
        let mut first = first;
        while let Root::Pair(other, left, right) = first.root()
            && other == operation
        {
            others.push(right);
            first = left;
        }
        let pad = "  ".repeat(depth);
        let (word, used) = match operation {
            Operation::Union if used == Use::Clear => ("merge", used),
            Operation::Union => ("union", used),
            Operation::Intersection => ("intersection", used.carved()),
            Operation::Difference => ("difference", used.carved()),
        };
        line!(self, "{pad}{word} {{");
        for part in [first].into_iter().chain(others.into_iter().rev()) {
            self.csg(part, depth + 1, used);
        }
        line!(self, "{pad}}}");
    }
}

fn listed(points: &[DVec2]) -> String {
    let points: Vec<String> =
        points.iter().map(|point| Angled(&point.to_array()).to_string()).collect();
    points.join(", ")
}
