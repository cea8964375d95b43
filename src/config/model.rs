//! `[Model0]` and so on: bodies beside the game.

use glam::DVec3;
use serde::Serialize;

use super::keys::{Key, Lines, key};
use super::values::{Choice, Name, Number, PLACE, Triple};
use super::{Fault, SHORTEST};

/// What a `[Model…]` section says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Model {
    pub shape: Shape,
    /// The name of its material.
    pub material: String,
    /// World units: a point of a plane.
    pub origin: DVec3,
    /// Out of the ground that the plane covers; any length above 0.
    pub normal: DVec3,
    /// World units: the middle of a sphere, and its radius above 0.
    pub center: DVec3,
    pub radius: f64,
    /// World units: the corners of a box.
    pub min: DVec3,
    pub max: DVec3,
    /// Degrees that a box is turned about its middle: first about x (from y towards z), then about
    /// y (from x towards z), then about z (from x towards y).
    pub rotation: DVec3,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    Plane,
    Sphere,
    Box,
}

const SHAPES: Choice<Shape> =
    Choice(&[("plane", Shape::Plane), ("sphere", Shape::Sphere), ("box", Shape::Box)]);

pub const KEYS: [Key<Model>; 9] = [
    key!("Shape", Model, shape: SHAPES),
    key!("Material", Model, material: Name),
    key!("Origin", Model, origin: PLACE).only("a plane", |m| m.shape == Shape::Plane),
    key!("Normal", Model, normal: PLACE).only("a plane", |m| m.shape == Shape::Plane),
    key!("Center", Model, center: PLACE).only("a sphere", |m| m.shape == Shape::Sphere),
    key!("Radius", Model, radius: Number(1e-3, 1e6)).only("a sphere", |m| m.shape == Shape::Sphere),
    key!("Min", Model, min: PLACE).only("a box", |m| m.shape == Shape::Box),
    key!("Max", Model, max: PLACE).only("a box", |m| m.shape == Shape::Box),
    key!("Rotation", Model, rotation: Triple(-360.0, 360.0))
        .only("a box", |m| m.shape == Shape::Box),
];

impl Default for Model {
    fn default() -> Model {
        Model {
            shape: Shape::Sphere,
            material: "white".to_owned(),
            origin: DVec3::ZERO,
            normal: DVec3::Y,
            center: DVec3::ZERO,
            radius: 1.0,
            min: DVec3::ZERO,
            max: DVec3::ONE,
            rotation: DVec3::ZERO,
        }
    }
}

impl Model {
    /// Checks what single keys cannot show.
    pub(super) fn check(&self, name: &str, lines: &Lines, faults: &mut Vec<Fault>) {
        if lines.failed("Shape") {
            return;
        }
        let mut fault = |key, message| faults.push(Fault { line: lines.of(key), message });
        let needed: &[&str] = match self.shape {
            Shape::Plane => &["Shape", "Origin", "Normal"],
            Shape::Sphere => &["Shape", "Center", "Radius"],
            Shape::Box => &["Shape", "Min", "Max"],
        };
        if let Some(missing) = lines.first_missing(needed) {
            fault("", format!("[{name}] has no {missing}, expected one"));
        }
        if self.normal.length() < SHORTEST {
            fault("Normal", "Normal has no length, expected a direction".to_owned());
        }
        if self.shape == Shape::Box && !self.min.cmplt(self.max).all() {
            let message = "Min is not below Max in each of its numbers, expected a box";
            fault("Max", message.to_owned());
        }
    }
}
