//! Whitted's recursion with Phong's sum (Turek 2008, 2.1 to 2.3 and 4.4).

use super::RayCounts;
use crate::config::Light;
use crate::geometry::{Range, Ray, Solid};
use crate::scene::{Object, Rgb, Scene};

/// How far off a surface its secondary rays begin, along the normal, in world units: enough not
/// to meet the surface itself, too little to miss what touches it.
const OFFSET: f64 = 1e-4;

/// The colour that comes back along a ray from the camera.
pub fn trace(scene: &Scene, ray: &Ray, counts: &mut RayCounts) -> Rgb {
    counts.primary += 1;
    radiance(scene, ray, 0, counts)
}

fn radiance(scene: &Scene, ray: &Ray, depth: u32, counts: &mut RayCounts) -> Rgb {
    let Some((object, crossing)) = nearest(scene, ray) else {
        return scene.background;
    };
    let material = &object.material;
    let point = ray.at(crossing.t);
    let normal = crossing.normal;
    let leaving = point + normal * OFFSET;
    let mirrored = ray.direction - normal * (2.0 * ray.direction.dot(normal));
    let color = material.texture.color(object.body.own_point(point));

    let mut sum = color * material.ambient;
    for light in &scene.lights {
        let to_light = light.position - leaving;
        let distance = to_light.length();
        let to_light = to_light / distance;
        let facing = normal.dot(to_light);
        if facing <= 0.0 {
            continue;
        }
        counts.shadow += 1;
        let shadow_ray = Ray {
            origin: leaving,
            direction: to_light,
        };
        if !blocked(scene, &shadow_ray, distance) {
            let highlight = mirrored.dot(to_light).max(0.0);
            sum += phong(light, color, material.diffuse * facing);
            if highlight > 0.0 {
                sum += light.color * (material.specular * libm::pow(highlight, material.shininess));
            }
        }
    }
    if material.reflectivity > 0.0 && depth < scene.max_depth {
        counts.reflected += 1;
        let reflected = Ray {
            origin: leaving,
            direction: mirrored,
        };
        sum += radiance(scene, &reflected, depth + 1, counts) * material.reflectivity;
    }
    sum.clamp(Rgb::ZERO, Rgb::ONE)
}

fn phong(light: &Light, color: Rgb, strength: f64) -> Rgb {
    light.color * color * strength
}

fn nearest<'a>(scene: &'a Scene, ray: &Ray) -> Option<(&'a Object, crate::geometry::Crossing)> {
    let mut range = Range::AHEAD;
    let mut found = None;
    for object in &scene.objects {
        if let Some(crossing) = object.body.nearest(ray, range) {
            range.max = crossing.t;
            found = Some((object, crossing));
        }
    }
    found
}

fn blocked(scene: &Scene, ray: &Ray, distance: f64) -> bool {
    scene.objects.iter().any(|object| object.body.blocks(ray, Range::up_to(distance)))
}
