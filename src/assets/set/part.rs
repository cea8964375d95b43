//! Parts: a table of a piece's file as a shape in its place.

use glam::{DAffine3, DVec3};

use super::SetError;
use super::points::{Curve, Curves};
use super::table::Table;
use crate::config::unknown;
use crate::geometry::Operation;
use crate::geometry::transform::{rotation_x, rotation_y, rotation_z, translation};

/// A shape, where it stands, and how often.
pub struct Part {
    /// What messages call it, and where it begins.
    pub owner: String,
    pub line: usize,
    pub shape: Shape,
    pub place: DAffine3,
    /// Whether its mirror image in z belongs to it.
    pub both: bool,
    /// How many copies stand evenly about the y axis, 1 to [`MAX_AROUND`].
    pub around: u32,
}

pub enum Shape {
    Lathe(Curve),
    /// An outline pushed along z from one height to another.
    Prism(Curve, [f64; 2]),
    /// By its radius.
    Sphere(f64),
    /// By its half-sizes.
    Box(DVec3),
    /// Another part of the piece.
    Part(String),
    Joined(Operation, Vec<Part>),
}

const SHAPES: [&str; 8] =
    ["lathe", "prism", "sphere", "box", "part", "union", "intersection", "difference"];

/// What a part of any shape may have, and what only a prism has.
const PLACING: [&str; 5] = ["scale", "turn", "at", "both", "around"];
const OF_PRISMS: [&str; 4] = ["half", "from", "to", "mirrored"];

/// No length is greater, in heights of the piece.
const FARTHEST: f64 = 10.0;

/// The least and the greatest factor of a scale.
const SCALES: (f64, f64) = (0.001, 1000.0);

const MAX_AROUND: f64 = 360.0;

impl Part {
    /// Reads a part; its curves may name some of `curves`.
    pub fn read(table: &Table, curves: &Curves) -> Result<Part, SetError> {
        let shape = the_shape(table)?;
        let known = SHAPES.iter().chain(&PLACING).chain(&OF_PRISMS).copied();
        table.know("key", &known.collect::<Vec<_>>())?;
        if let Some(key) = OF_PRISMS.into_iter().find(|key| table.has(key) && shape != "prism") {
            let message = format!("{}: `{key}` is for a prism, and this is none", table.owner);
            return Err(table.file.fault(table.line_of(key), &message));
        }
        let scale = table.vector("scale", SCALES.1)?.unwrap_or(DVec3::ONE);
        if scale.abs().min_element() < SCALES.0 {
            let (least, most) = SCALES;
            return Err(table.wrong("scale", &format!("factors from {least} to {most}")));
        }
        let turn = table.vector("turn", 360.0)?.unwrap_or(DVec3::ZERO);
        let at = table.vector("at", FARTHEST)?.unwrap_or(DVec3::ZERO);
        let turn = rotation_z(turn.z) * rotation_y(turn.y) * rotation_x(turn.x);
        let around = table.number("around", 1.0, MAX_AROUND)?.unwrap_or(1.0);
        if around.fract() != 0.0 {
            return Err(table.wrong("around", "a whole number of copies"));
        }
        Ok(Part {
            owner: table.owner.clone(),
            line: table.line,
            shape: Shape::read(table, shape, curves)?,
            place: translation(at) * turn * DAffine3::from_scale(scale),
            both: table.is_true("both")?,
            around: around as u32,
        })
    }

    /// Another part, where it stands by itself.
    fn named(name: &str, owner: &str, line: usize) -> Part {
        Part {
            owner: owner.to_owned(),
            line,
            shape: Shape::Part(name.to_owned()),
            place: DAffine3::IDENTITY,
            both: false,
            around: 1,
        }
    }
}

/// The one shape that a part has.
fn the_shape(table: &Table) -> Result<&'static str, SetError> {
    let mut given = SHAPES.into_iter().filter(|shape| table.has(shape));
    match (given.next(), given.next()) {
        (Some(shape), None) => Ok(shape),
        (Some(one), Some(other)) => {
            let message = format!("has two shapes, `{one}` and `{other}`, expected one");
            Err(table.fault(message))
        }
        (None, _) => {
            let is_other = |key: &&str| !PLACING.contains(key) && !OF_PRISMS.contains(key);
            match table.keys().find(is_other) {
                Some(key) => {
                    let message = format!("{}: {}", table.owner, unknown("shape", key, SHAPES));
                    Err(table.file.fault(table.line_of(key), &message))
                }
                None => {
                    let shapes = SHAPES.join(", ");
                    Err(table.fault(format!("has no shape, expected one of {shapes}")))
                }
            }
        }
    }
}

impl Shape {
    fn read(table: &Table, shape: &'static str, curves: &Curves) -> Result<Shape, SetError> {
        let joined = |operation, least: usize| {
            let members = table.members(shape)?.into_iter().map(|member| match member {
                Ok(name) => Ok(Part::named(name.text, name.owner, name.line(0))),
                Err(table) => Part::read(&table, curves),
            });
            let members: Vec<Part> = members.collect::<Result<_, _>>()?;
            if members.len() < least {
                return Err(table.wrong(shape, &format!("at least {least} parts")));
            }
            Ok(Shape::Joined(operation, members))
        };
        Ok(match shape {
            "lathe" => Shape::Lathe(Curve::read(&table.needed_text(shape)?, curves)?),
            "prism" => {
                let outline = Curve::read(&table.needed_text(shape)?, curves)?;
                let is_half = table.is_true("mirrored")?;
                let outline = if is_half { outline.mirrored() } else { outline };
                Shape::Prism(outline, thickness(table)?)
            }
            "sphere" => {
                let radius = table.number(shape, 0.0, FARTHEST)?.unwrap_or_default();
                if radius == 0.0 {
                    return Err(table.wrong(shape, "a radius above 0"));
                }
                Shape::Sphere(radius)
            }
            "box" => {
                let half = table.vector(shape, FARTHEST)?.unwrap_or_default();
                if half.min_element() <= 0.0 {
                    return Err(table.wrong(shape, "three half-sizes above 0"));
                }
                Shape::Box(half)
            }
            "part" => Shape::Part(table.needed_text(shape)?.text.to_owned()),
            "union" => joined(Operation::Union, 1)?,
            "intersection" => joined(Operation::Intersection, 2)?,
            _ => joined(Operation::Difference, 2)?,
        })
    }
}

/// From where to where along z a prism goes: `half` its thickness to both sides, or `from` and `to`.
fn thickness(table: &Table) -> Result<[f64; 2], SetError> {
    let number = |key| table.number(key, -FARTHEST, FARTHEST);
    match (number("half")?, number("from")?, number("to")?) {
        (Some(half), None, None) if half > 0.0 => Ok([-half, half]),
        (Some(_), None, None) => Err(table.wrong("half", "a thickness above 0")),
        (None, Some(from), Some(to)) if from < to => Ok([from, to]),
        (None, Some(_), Some(_)) => Err(table.wrong("to", "more than `from`")),
        _ => Err(table.fault("is a prism, expected `half`, or `from` and `to`".to_owned())),
    }
}
