//! What a picture shows, ready to be traced: bodies with materials, lights and a camera.
//!
//! A [`Stage`] holds what stays from frame to frame (set, board, clock, lights); with a
//! [`crate::timeline::Frame`] it makes a [`Scene`]. Here squares and pieces end: the tracer knows
//! bodies alone.

mod board;
mod bodies;
mod camera;
mod clock;
pub(crate) mod coordinates;
mod facing;
mod framing;
pub(crate) mod glyphs;
pub(crate) mod joinery;
mod mapping;
mod material;
mod materials;
pub(crate) mod measures;
mod models;
pub(crate) mod noise;
pub(crate) mod paint;
mod room;
mod stage;
mod surface;
pub(crate) mod texture;
pub(crate) mod timber;
mod view;

pub use bodies::bodies;
pub use camera::{Camera, Projection};
pub use coordinates::{Readers, Side};
pub use joinery::Joinery;
pub use mapping::Mapping;
pub use material::{Material, Rgb};
pub use materials::MaterialError;
pub use measures::{HALF, MIDDLE, SQUARE};
pub use paint::{Painting, repainted};
pub use room::{Daylight, NARROW, Room, Softbox};
pub use stage::{Stage, StageError};
pub use surface::Surface;
pub use texture::{Noise, Place, Texture, linear_light};
pub use view::{Reach, TO_MOVER};

use materials::Materials;

use crate::config::Light;
use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};

use crate::geometry::{Bounds, Placed, Solid};

/// A solid in its place, with what it is made of.
#[derive(Clone)]
pub struct Object {
    pub body: Placed,
    pub surface: Surface,
    /// Which tree or block it is cut from.
    pub seed: u64,
    /// What is painted on its top, where anything is.
    pub paint: Option<Arc<Painting>>,
    /// A part of its surface that is level and higher than all else of it, as a rectangle in x and z. It changes
    /// nothing in a picture: who comes from above finds it sooner.
    pub roof: Option<[DVec2; 2]>,
}

impl Object {
    /// A body where it was made.
    pub fn standing(solid: impl Solid + 'static, surface: Surface) -> Object {
        Object::placed(Arc::new(solid), DAffine3::IDENTITY, surface)
    }

    /// A body that was carried to its `place`.
    pub fn placed(solid: Arc<dyn Solid>, place: DAffine3, surface: Surface) -> Object {
        Object { body: Placed::new(solid, place), surface, seed: 0, paint: None, roof: None }
    }

    /// The material at a `point` of the surface with the outward `normal`, and the place as its
    /// texture sees it. Both are those a hair below it: a flat face may be the very border
    /// between two squares or two pictures, where rounding would choose.
    pub fn material(&self, point: DVec3, normal: DVec3) -> (&Material, Place) {
        let point = self.body.own_point(point - normal * HAIR);
        self.surface.material(Place { on_body: point, point, seed: self.seed })
    }

    /// The colour of a `material` of it at `place`, paint and all, where a width of `seen` world units
    /// is seen at once.
    pub fn color(&self, material: &Material, place: Place, seen: f64) -> Rgb {
        let ground = material.texture.color(place, seen);
        match &self.paint {
            Some(painting) => painting.over(ground, place.on_body, seen),
            None => ground,
        }
    }
}

/// In world units.
const HAIR: f64 = 1e-6;

/// A grid in the plane of x and z, of at most 8 × 8 cells, on which bodies stand. It changes nothing in a
/// picture: what stands in a cell is found sooner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    /// The middle of the first cell.
    pub origin: DVec2,
    /// The cells' width.
    pub side: f64,
    /// How far what stands reaches from the middle of its cell at most, up to half of `side`.
    pub reach: f64,
    /// From how low to how high.
    pub heights: [f64; 2],
}

/// Cells in which nothing can stand.
impl Default for Cells {
    fn default() -> Cells {
        Cells { origin: DVec2::ZERO, side: 1.0, reach: 0.0, heights: [0.0, 0.0] }
    }
}

impl Cells {
    /// How many rows there are, and cells in each.
    const SIDE: f64 = 8.0;

    /// The cell in which a body stands, row by row; none where it does not keep to one.
    pub fn cell(&self, body: &Placed) -> Option<usize> {
        let Bounds { min, max } = body.bounds();
        let Cells { origin, side, reach, heights: [low, high] } = *self;
        let middle = (min + max) / 2.0;
        let place = [middle.x - origin.x, middle.z - origin.y].map(|at| (at / side).round());
        let [column, row] = place;
        let is_there = place.iter().all(|index| (0.0..Cells::SIDE).contains(index));
        let (x, z) = (origin.x + column * side, origin.y + row * side);
        let asides = [x - min.x, max.x - x, z - min.z, max.z - z];
        let keeps = asides.iter().all(|aside| *aside <= reach) && min.y >= low && max.y <= high;
        (is_there && keeps).then_some((Cells::SIDE * row + column) as usize)
    }
}

impl Object {
    /// Whether both are the same body of the same material, whatever is painted on them.
    pub fn is_same(&self, other: &Object) -> bool {
        self.is_same_body(other) && self.surface == other.surface && self.seed == other.seed
    }

    /// Whether both are the same body in the same place.
    pub fn is_same_body(&self, other: &Object) -> bool {
        let (one, another) = (&self.body, &other.body);
        Arc::ptr_eq(one.shared(), another.shared()) && one.transform() == another.transform()
    }
}

/// Everything that a picture depends on, but its size and sampling.
#[derive(Clone)]
pub struct Scene {
    pub objects: Vec<Object>,
    /// Where most of them stand.
    pub cells: Cells,
    /// For Phong's sum.
    pub lights: Vec<Light>,
    /// What gives the studio its light; without it, Phong's sum is what is seen.
    pub room: Option<Room>,
    pub camera: Camera,
    /// The colour of a ray that meets nothing, as it is written to the picture; where there is none,
    /// the picture is transparent.
    pub background: Option<Rgb>,
    /// How often a ray may be reflected or refracted; beyond it Phong's sum is black, and
    /// the studio sees its room.
    pub max_depth: u32,
    /// The least share of a pixel's colour, 0 to 1, that a ray is followed for.
    pub min_weight: f64,
    /// How far a ray sees; beyond it is the background.
    pub max_distance: f64,
    /// Refractive index of all that is transparent.
    pub snell_index: f64,
}
