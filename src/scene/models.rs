//! Bodies that settings add to the scene.

use std::sync::Arc;

use super::Object;
use super::materials::{MaterialError, Materials};
use crate::config::{Model, Shape};
use crate::geometry::transform::{rotation_x, rotation_y, rotation_z, translation};
use crate::geometry::{Cuboid, Plane, Sphere};

/// The body that `model` describes.
pub fn model(model: &Model, materials: &Materials) -> Result<Object, MaterialError> {
    let surface = materials.surface(&model.material)?;
    Ok(match model.shape {
        Shape::Plane => Object::standing(Plane::new(model.origin, model.normal), surface),
        Shape::Sphere => {
            Object::standing(Sphere { center: model.center, radius: model.radius }, surface)
        }
        Shape::Box => {
            let turn = rotation_z(model.rotation.z)
                * rotation_y(model.rotation.y)
                * rotation_x(model.rotation.x);
            // Its own space is the world before the turn, so that textures lie where they are told.
            let middle = model.min.midpoint(model.max);
            let place = translation(middle) * turn * translation(-middle);
            let block = Cuboid { min: model.min, max: model.max };
            Object::placed(Arc::new(block), place, surface)
        }
    })
}
