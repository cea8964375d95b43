//! Whitted's recursion with Phong's sum (Turek 2008, 2.1 to 2.3 and 4.4).

use glam::DVec3;

use super::footprint::Footprint;
use super::hierarchy::Hierarchy;
use super::{RayCounts, Sample};
use crate::geometry::{Hit, Ray, Solid};
use crate::scene::{Rgb, Scene};

/// How far off a surface its secondary rays begin, along the normal, in world units: enough not
/// to meet the surface itself, too little to miss what touches it.
const OFFSET: f64 = 1e-4;

/// How often a ray may go straight through a surface before each further time counts as refraction.
const MAX_PASSES: u32 = 100;

/// A scene with what is needed to trace rays through it.
pub struct Tracer<'a> {
    scene: &'a Scene,
    hierarchy: Hierarchy<'a>,
    /// Which objects are transparent.
    transparent: Vec<usize>,
}

/// A ray on its way.
struct Flight {
    ray: Ray,
    /// How often it was reflected or refracted.
    depth: u32,
    /// How often it went straight through a surface: between bodies of glass that touch or overlap.
    passes: u32,
    /// How far it has come from the camera.
    length: f64,
    /// Its share of the pixel's colour.
    weight: f64,
    /// The refractive index of what it is in.
    index: f64,
}

/// What is found on the way.
struct Walk<'a> {
    counts: &'a mut RayCounts,
    footprint: Footprint,
    /// The width that a ray stands for at distance 1.
    spread: f64,
}

impl<'a> Tracer<'a> {
    pub fn new(scene: &'a Scene) -> Tracer<'a> {
        let is_transparent = |index: &usize| scene.objects[*index].surface.is_transparent();
        Tracer {
            scene,
            hierarchy: Hierarchy::new(&scene.objects),
            transparent: (0..scene.objects.len()).filter(is_transparent).collect(),
        }
    }

    /// What comes back along a ray from the camera, which stands for a width of `spread` at
    /// distance 1.
    pub fn trace(&self, ray: Ray, spread: f64, counts: &mut RayCounts) -> Sample {
        counts.primary += 1;
        let mut walk = Walk { counts, footprint: Footprint::default(), spread };
        let index = self.index_at(ray.origin);
        let flight = Flight { ray, depth: 0, passes: 0, length: 0.0, weight: 1.0, index };
        let color = self.radiance(&flight, &mut walk);
        Sample { color, footprint: walk.footprint }
    }

    /// The refractive index at `point`: that of all that is transparent, where it lies inside any of
    /// it (Turek 2008, 4.2).
    fn index_at(&self, point: DVec3) -> f64 {
        let holds = |index: &usize| self.scene.objects[*index].body.contains(point);
        if self.transparent.iter().any(holds) { self.scene.snell_index } else { 1.0 }
    }

    fn radiance(&self, flight: &Flight, walk: &mut Walk) -> Rgb {
        let ray = &flight.ray;
        let Some((index, hit)) = self.hierarchy.nearest(ray, self.scene.max_distance) else {
            walk.footprint.meet_nothing();
            return self.scene.background;
        };
        let object = &self.scene.objects[index];
        let point = ray.at(hit.t);
        let length = flight.length + hit.t;
        let (outward, normal) = facing(hit, ray.direction);
        let leaving = point + outward * OFFSET;
        let mirrored = mirrored(ray.direction, normal, outward);

        let (material, own_point) = object.material(point, hit.normal);
        let finish = &material.finish;
        let color = material.texture.color(own_point, length * walk.spread);

        let (mut scattered, mut highlights) = (Rgb::splat(finish.ambient), Rgb::ZERO);
        for light in &self.scene.lights {
            let towards = light.position - leaving;
            let distance = towards.length();
            let towards = towards / distance;
            let incidence = normal.dot(towards);
            if incidence <= 0.0 {
                continue;
            }
            walk.counts.shadow += 1;
            let way = Ray { origin: leaving, direction: towards };
            let light = light.color * self.hierarchy.transmission(&way, distance);
            if light == Rgb::ZERO {
                continue;
            }
            scattered += light * (finish.diffuse * incidence);
            let highlight = mirrored.dot(towards);
            if highlight > 0.0 {
                highlights += light * (finish.specular * libm::pow(highlight, finish.shininess));
            }
        }
        walk.footprint.meet(flight.weight, index, normal, color, scattered + highlights);
        let mut sum = color * scattered + highlights;
        if flight.depth >= self.scene.max_depth {
            return sum;
        }
        let on = |ray: Ray, share: f64, index: f64| Flight {
            ray,
            depth: flight.depth + 1,
            passes: flight.passes,
            length,
            weight: flight.weight * share,
            index,
        };
        let mut mirror = finish.reflectivity;
        if finish.transparency > 0.0 {
            let behind = point - outward * OFFSET;
            let index = self.index_at(behind);
            match refracted(ray.direction, normal, flight.index / index) {
                Some(direction) => {
                    let ray = Ray { origin: behind, direction };
                    let mut next = on(ray, finish.transparency, index);
                    // What does not bend does not count, as long as there is an end to it.
                    if index == flight.index && flight.passes < MAX_PASSES {
                        next.depth = flight.depth;
                        next.passes += 1;
                    }
                    if self.is_followed(&next) {
                        walk.counts.refracted += 1;
                        sum += self.radiance(&next, walk) * finish.transparency;
                    }
                }
                // The reflection is total: all that comes this way is thrown back.
                None => mirror = 1.0,
            }
        }
        let next = on(Ray { origin: leaving, direction: mirrored }, mirror, flight.index);
        if self.is_followed(&next) {
            walk.counts.reflected += 1;
            sum += self.radiance(&next, walk) * mirror;
        }
        sum
    }

    /// Whether a ray is worth its while.
    fn is_followed(&self, flight: &Flight) -> bool {
        flight.weight > 0.0 && flight.weight >= self.scene.min_weight
    }
}

/// The normals of the surface itself and of what it is shaded as, on the side of a ray that comes
/// along `direction`.
fn facing(hit: Hit, direction: DVec3) -> (DVec3, DVec3) {
    let hit = if direction.dot(hit.normal) > 0.0 { hit.turned() } else { hit };
    // A smooth normal may face away where the polygon just does not.
    let shading = if direction.dot(hit.shading) < 0.0 { hit.shading } else { hit.normal };
    (hit.normal, shading)
}

/// Where a mirror across `normal` sends a ray (Turek 2008, 2.3.2), but never below the surface itself.
fn mirrored(direction: DVec3, normal: DVec3, outward: DVec3) -> DVec3 {
    let mirrored = direction - normal * (2.0 * direction.dot(normal));
    if mirrored.dot(outward) > 0.0 {
        mirrored
    } else {
        direction - outward * (2.0 * direction.dot(outward))
    }
}

/// Snell's law: where a ray goes behind a surface with `normal` on its own side. `ratio` is the
/// refractive index here over the one behind. `None` in total internal reflection.
fn refracted(direction: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let cos = -direction.dot(normal);
    let cos2_behind = 1.0 - ratio * ratio * (1.0 - cos * cos);
    (cos2_behind >= 0.0)
        .then(|| (direction * ratio + normal * (ratio * cos - cos2_behind.sqrt())).normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_bends_by_snells_law() {
        for degrees in [0.0_f64, 10.0, 35.0, 60.0, 85.0] {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let direction = DVec3::new(sin, -cos, 0.0);
            let behind = refracted(direction, DVec3::Y, 1.0 / 1.5).unwrap();
            assert!((behind.x * 1.5 - sin).abs() < 1e-12, "{degrees}");
            let back = refracted(behind, DVec3::Y, 1.5).unwrap();
            assert!(back.distance(direction) < 1e-12, "{degrees}");
        }
    }

    #[test]
    fn beyond_the_critical_angle_nothing_gets_out() {
        let critical = libm::asin(1.0 / 1.5);
        let towards = |angle: f64| DVec3::new(libm::sin(angle), -libm::cos(angle), 0.0);
        assert!(refracted(towards(critical - 1e-6), DVec3::Y, 1.5).is_some());
        assert!(refracted(towards(critical + 1e-6), DVec3::Y, 1.5).is_none());
    }
}
