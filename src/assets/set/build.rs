//! From parts to one solid.

use std::collections::BTreeMap;

use glam::{DAffine3, DVec3};

use super::SetError;
use super::part::{Part, Shape};
use super::points::Curve;
use super::source::File;
use crate::config::unknown;
use crate::geometry::transform::rotation_y;
use crate::geometry::{
    Csg, Cuboid, CurveError, Lathe, Normals, Operation, Outline, Prism, Profile, Solid, Sphere,
};

/// More solids and control points than any piece needs: rays and memory have an end.
const MAX_SOLIDS: usize = 500;
const MAX_POINTS: usize = 4000;

/// How deep parts may lie in parts: trees are walked by recursion.
const MAX_DEPTH: usize = 24;

/// Builds the part `piece` of `parts`, in which every other one has to be used.
///
/// # Errors
/// Parts that are not there or contain themselves, curves that bound no body, too much of anything.
pub fn build(
    file: &File,
    piece: &str,
    parts: &BTreeMap<String, Part>,
    subdivisions: u32,
    normals: Normals,
) -> Result<Csg, SetError> {
    let mut builder =
        Builder { file, parts, subdivisions, normals, made: BTreeMap::new(), points: 0 };
    let (solid, _) = builder.named("piece", &format!("the {piece}"), 1, 0)?;
    if let Some((_, part)) = parts.iter().find(|(name, _)| !builder.made.contains_key(*name)) {
        let message = format!("{} is used nowhere, expected it in another part", part.owner);
        return Err(file.fault(part.line, &message));
    }
    Ok(solid)
}

/// A solid, and of how many it is made.
type Made = (Csg, usize);

struct Builder<'a> {
    file: &'a File,
    parts: &'a BTreeMap<String, Part>,
    subdivisions: u32,
    normals: Normals,
    /// What is built, by name; `None` while it is being built.
    made: BTreeMap<String, Option<Made>>,
    /// Control points so far.
    points: usize,
}

impl Builder<'_> {
    /// The part of a name that `owner` gives in a line.
    fn named(
        &mut self,
        name: &str,
        owner: &str,
        line: usize,
        depth: usize,
    ) -> Result<Made, SetError> {
        let fault = |message: String| self.file.fault(line, &format!("{owner}: {message}"));
        match self.made.get(name) {
            Some(Some(made)) => return Ok(made.clone()),
            Some(None) => return Err(fault(format!("the part `{name}` contains itself"))),
            None if depth > MAX_DEPTH => {
                return Err(fault(format!("parts lie in parts more than {MAX_DEPTH} deep")));
            }
            None => {}
        }
        let part = self
            .parts
            .get(name)
            .ok_or_else(|| fault(unknown("part", name, self.parts.keys().map(String::as_str))))?;
        self.made.insert(name.to_owned(), None);
        let made = self.part(part, depth)?;
        self.made.insert(name.to_owned(), Some(made.clone()));
        Ok(made)
    }

    fn part(&mut self, part: &Part, depth: usize) -> Result<Made, SetError> {
        let fault =
            |message: String| self.file.fault(part.line, &format!("{}: {message}", part.owner));
        if depth > MAX_DEPTH {
            return Err(fault(format!("parts lie in parts more than {MAX_DEPTH} deep")));
        }
        let places = places(part);
        let (solids, count) = match &part.shape {
            // A ball is one wherever it stands; a stretched one has to be placed.
            Shape::Sphere(radius) if places.iter().all(keeps_lengths) => {
                let ball = |place: &DAffine3| {
                    Csg::leaf(Sphere { center: place.translation, radius: *radius })
                };
                (places.iter().map(ball).collect(), 1)
            }
            shape => {
                let (solid, count) = self.shape(shape, part, depth)?;
                let placed = |place: &DAffine3| {
                    let solid = solid.clone();
                    if *place == DAffine3::IDENTITY { solid } else { solid.placed(*place) }
                };
                (places.iter().map(placed).collect::<Vec<_>>(), count)
            }
        };
        let count = count * solids.len();
        if count > MAX_SOLIDS {
            return Err(fault(format!(
                "it is made of {count} solids, expected up to {MAX_SOLIDS}"
            )));
        }
        Ok((joined(Operation::Union, solids), count))
    }

    fn shape(&mut self, shape: &Shape, part: &Part, depth: usize) -> Result<Made, SetError> {
        let prism_steps = self.subdivisions.saturating_sub(1);
        let solid = match shape {
            Shape::Lathe(curve) => {
                self.count(curve, part)?;
                let lathe = Profile::new(curve.points.clone())
                    .and_then(|profile| Lathe::new(&profile, self.subdivisions, self.normals));
                Csg::leaf(lathe.map_err(|error| self.bad_curve(curve, part, &error))?)
            }
            Shape::Prism(curve, [back, front]) => {
                self.count(curve, part)?;
                let prism = Outline::new(curve.points.clone()).and_then(|outline| {
                    Prism::new(&outline, prism_steps, self.normals, *back, *front)
                });
                Csg::leaf(prism.map_err(|error| self.bad_curve(curve, part, &error))?)
            }
            Shape::Sphere(radius) => Csg::leaf(Sphere { center: DVec3::ZERO, radius: *radius }),
            Shape::Box(half) => Csg::leaf(Cuboid::centered(*half)),
            Shape::Part(name) => return self.named(name, &part.owner, part.line, depth + 1),
            Shape::Joined(operation, members) => {
                let members: Vec<Made> = members
                    .iter()
                    .map(|member| self.part(member, depth + 1))
                    .collect::<Result<_, _>>()?;
                let count = members.iter().map(|(_, count)| count).sum();
                let solid =
                    joined(*operation, members.into_iter().map(|(solid, _)| solid).collect());
                let bounds = solid.bounds();
                if bounds.min.cmpgt(bounds.max).any() {
                    let message = format!("{}: its parts have nothing in common", part.owner);
                    return Err(self.file.fault(part.line, &message));
                }
                return Ok((solid, count));
            }
        };
        Ok((solid, 1))
    }

    fn count(&mut self, curve: &Curve, part: &Part) -> Result<(), SetError> {
        self.points += curve.points.len();
        if self.points <= MAX_POINTS {
            return Ok(());
        }
        let message = format!("{}: the piece has more than {MAX_POINTS} points", part.owner);
        Err(self.file.fault(part.line, &message))
    }

    fn bad_curve(&self, curve: &Curve, part: &Part, error: &CurveError) -> SetError {
        let line = curve.line_of(error).unwrap_or(part.line);
        self.file.fault(line, &format!("{}: {error}", part.owner))
    }
}

/// Where a part and its copies stand.
fn places(part: &Part) -> Vec<DAffine3> {
    let mirror = DAffine3::from_scale(DVec3::new(1.0, 1.0, -1.0));
    let sides = [Some(part.place), part.both.then(|| mirror * part.place)];
    let angle = 360.0 / f64::from(part.around);
    let turned = |index: u32, place: DAffine3| match index {
        0 => place,
        _ => rotation_y(angle * f64::from(index)) * place,
    };
    (0..part.around)
        .flat_map(|index| sides.into_iter().flatten().map(move |place| turned(index, place)))
        .collect()
}

/// Whether `place` turns and moves alone, as far as a ball can tell.
fn keeps_lengths(place: &DAffine3) -> bool {
    let axes = place.matrix3;
    [axes.x_axis, axes.y_axis, axes.z_axis].iter().all(|axis| (axis.length() - 1.0).abs() < 1e-12)
}

/// Joins solids pairwise, so that trees stay flat; a difference takes all others from the first.
fn joined(operation: Operation, mut solids: Vec<Csg>) -> Csg {
    if operation == Operation::Difference && solids.len() > 2 {
        let others = solids.split_off(1);
        solids.push(joined(Operation::Union, others));
    }
    while solids.len() > 1 {
        let mut pairs = Vec::with_capacity(solids.len().div_ceil(2));
        let mut rest = solids.into_iter();
        while let Some(first) = rest.next() {
            pairs.push(match rest.next() {
                Some(second) => match operation {
                    Operation::Union => first.or(second),
                    Operation::Intersection => first.and(second),
                    Operation::Difference => first.minus(second),
                },
                None => first,
            });
        }
        solids = pairs;
    }
    solids.swap_remove(0)
}
