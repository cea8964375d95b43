//! Whitted's recursion with Phong's sum (Turek 2008, 2.1 to 2.3 and 4.4).

use glam::DVec3;

use super::RayCounts;
use super::hierarchy::Hierarchy;
use crate::geometry::Ray;
use crate::scene::{Rgb, Scene};

/// How far off a surface its secondary rays begin, along the normal, in world units: enough not
/// to meet the surface itself, too little to miss what touches it.
const OFFSET: f64 = 1e-4;

/// A scene with what is needed to trace rays through it.
pub struct Tracer<'a> {
    scene: &'a Scene,
    hierarchy: Hierarchy<'a>,
}

impl<'a> Tracer<'a> {
    pub fn new(scene: &'a Scene) -> Tracer<'a> {
        Tracer { scene, hierarchy: Hierarchy::new(&scene.objects) }
    }

    /// The colour that comes back along a ray from the camera.
    pub fn trace(&self, ray: &Ray, counts: &mut RayCounts) -> Rgb {
        counts.primary += 1;
        self.radiance(ray, 0, counts)
    }

    fn radiance(&self, ray: &Ray, depth: u32, counts: &mut RayCounts) -> Rgb {
        let Some((object, hit)) = self.hierarchy.nearest(ray) else {
            return self.scene.background;
        };
        let material = &object.material;
        let point = ray.at(hit.t);
        let normal = hit.normal;
        let leaving = point + normal * OFFSET;
        let mirrored = ray.direction - normal * (2.0 * ray.direction.dot(normal));
        let color = material.texture.color(object.body.own_point(point));

        let mut sum = color * material.ambient;
        for light in &self.scene.lights {
            let towards = light.position - leaving;
            let distance = towards.length();
            let towards = towards / distance;
            let facing = normal.dot(towards);
            if facing <= 0.0 || self.is_shadowed(leaving, towards, distance, counts) {
                continue;
            }
            sum += light.color * color * (material.diffuse * facing);
            let highlight = mirrored.dot(towards);
            if highlight > 0.0 {
                sum += light.color * (material.specular * libm::pow(highlight, material.shininess));
            }
        }
        if material.reflectivity > 0.0 && depth < self.scene.max_depth {
            counts.reflected += 1;
            let reflected = Ray { origin: leaving, direction: mirrored };
            sum += self.radiance(&reflected, depth + 1, counts) * material.reflectivity;
        }
        sum.clamp(Rgb::ZERO, Rgb::ONE)
    }

    fn is_shadowed(
        &self,
        origin: DVec3,
        direction: DVec3,
        distance: f64,
        counts: &mut RayCounts,
    ) -> bool {
        counts.shadow += 1;
        self.hierarchy.blocks(&Ray { origin, direction }, distance)
    }
}
