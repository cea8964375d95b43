//! Whitted's recursion with Phong's sum (Turek 2008, 2.1 to 2.3 and 4.4).

use glam::DVec3;

use super::optics::{facing, mirrored, refracted};
use super::world::{OFFSET, World};
use crate::geometry::Ray;
use crate::scene::{Rgb, Scene};
use crate::tracer::RayCounts;
use crate::tracer::eye::Eye;
use crate::tracer::footprint::Footprint;
use crate::tracer::phong::{Places, Seen, Shade};
use crate::tracer::ties::Ties;

/// How often a ray may go straight through a surface before each further time counts as refraction.
const MAX_PASSES: u32 = 100;

/// Phong's eye on a world, for a picture of a size.
pub struct Phong<'a> {
    world: World<'a>,
    size: [u32; 2],
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
    /// The objects that were met, in order.
    bodies: Vec<Option<usize>>,
    /// Of normals, colours and light that were met, by their shares.
    sums: [DVec3; 3],
    /// The width that a ray stands for at distance 1.
    spread: f64,
}

impl<'a> Phong<'a> {
    pub fn new(scene: &'a Scene, size: [u32; 2]) -> Phong<'a> {
        Phong { world: World { scene }, size }
    }

    /// What comes back along a ray from the camera, which stands for a width of `spread` at
    /// distance 1.
    fn trace(&self, ray: Ray, spread: f64, counts: &mut RayCounts) -> Seen {
        counts.primary += 1;
        let mut walk = Walk { counts, bodies: Vec::new(), sums: [DVec3::ZERO; 3], spread };
        let index = self.world.index_at(ray.origin);
        let flight = Flight { ray, depth: 0, passes: 0, length: 0.0, weight: 1.0, index };
        let color = self.radiance(&flight, &mut walk);
        let [normal, color_seen, light] = walk.sums.map(|sum| sum.as_vec3());
        let footprint = Footprint::new(&walk.bodies, normal, color_seen, light);
        let shade = Shade { color: color.as_vec3(), hits: walk.bodies[0].is_some() };
        Seen { shade, footprint }
    }

    fn radiance(&self, flight: &Flight, walk: &mut Walk) -> Rgb {
        let ray = &flight.ray;
        let scene = self.world.scene;
        let Some((index, hit)) = self.world.nearest(ray, scene.max_distance) else {
            walk.bodies.push(None);
            return scene.background.unwrap_or(Rgb::ZERO);
        };
        let object = &scene.objects[index];
        let point = ray.at(hit.t);
        let length = flight.length + hit.t;
        let (outward, normal) = facing(hit, ray.direction);
        let leaving = point + outward * OFFSET;
        let mirrored = mirrored(ray.direction, normal, outward);

        let (material, place) = object.material(point, hit.normal);
        let finish = &material.finish;
        let color = object.color(material, place, length * walk.spread);

        let (mut scattered, mut highlights) = (Rgb::splat(finish.ambient), Rgb::ZERO);
        for light in &scene.lights {
            let towards = light.position - leaving;
            let distance = towards.length();
            let towards = towards / distance;
            let incidence = normal.dot(towards);
            if incidence <= 0.0 {
                continue;
            }
            walk.counts.shadow += 1;
            let way = Ray { origin: leaving, direction: towards };
            let light = light.color * self.world.transmission(&way, distance);
            if light == Rgb::ZERO {
                continue;
            }
            scattered += light * (finish.diffuse * incidence);
            let highlight = mirrored.dot(towards);
            if highlight > 0.0 {
                highlights += light * (finish.specular * libm::pow(highlight, finish.shininess));
            }
        }
        walk.bodies.push(Some(index));
        for (sum, met) in walk.sums.iter_mut().zip([normal, color, scattered + highlights]) {
            *sum += met * flight.weight;
        }
        let mut sum = color * scattered + highlights;
        if flight.depth >= scene.max_depth {
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
            let index = self.world.index_at(behind);
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
        flight.weight > 0.0 && flight.weight >= self.world.scene.min_weight
    }
}

impl Eye<Places, Seen> for Phong<'_> {
    fn see(&self, places: &Places, seen: &mut Vec<Seen>, _: Option<&mut Vec<Ties>>) -> RayCounts {
        // It does not know.
        let mut counts = RayCounts::default();
        let ([width, height], camera) = (self.size, &self.world.scene.camera);
        let spread = camera.spread(width) / f64::from(places.side);
        seen.extend(places.x.iter().zip(&places.y).map(|(x, y)| {
            let ray = camera.ray(f64::from(*x), f64::from(*y), width, height);
            self.trace(ray, spread, &mut counts)
        }));
        counts
    }
}

impl Eye<Places, Shade> for Phong<'_> {
    fn see(
        &self,
        places: &Places,
        seen: &mut Vec<Shade>,
        ties: Option<&mut Vec<Ties>>,
    ) -> RayCounts {
        let mut all: Vec<Seen> = Vec::new();
        let counts = self.see(places, &mut all, ties);
        seen.extend(all.iter().map(|seen| seen.shade));
        counts
    }
}
