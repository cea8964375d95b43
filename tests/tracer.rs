//! Scenes whose pictures are known on paper.

use std::sync::Arc;

use glam::{DAffine3, DVec3};
use lightsquare::config::{self, Light};
use lightsquare::geometry::{Cuboid, Placed, Solid, Sphere};
use lightsquare::scene::{Camera, Material, Object, Scene, Texture};
use lightsquare::tracer::{Antialiasing, RayCounts, render};

const WHITE: DVec3 = DVec3::ONE;

fn matte(solid: impl Solid + 'static, color: DVec3) -> Object {
    Object {
        body: Placed::new(Arc::new(solid), DAffine3::IDENTITY),
        material: Material {
            ambient: 0.2,
            diffuse: 0.5,
            specular: 0.0,
            shininess: 1.0,
            reflectivity: 0.0,
            texture: Texture::Plain(color),
        },
    }
}

fn ball(center: DVec3, radius: f64) -> Sphere {
    Sphere { center, radius }
}

fn floor() -> Cuboid {
    Cuboid { min: DVec3::new(-50.0, -1.0, -50.0), max: DVec3::new(50.0, 0.0, 50.0) }
}

/// Seen from above (0, 10, 0), with a light of intensity 1 straight above everything.
fn from_above(objects: Vec<Object>) -> Scene {
    Scene {
        objects,
        lights: vec![Light { position: DVec3::new(0.0, 1000.0, 0.0), color: WHITE }],
        camera: Camera::new(&config::Camera {
            position: DVec3::new(0.0, 10.0, 0.0),
            look_at: DVec3::ZERO,
            fov: 90.0,
            z_rot: 0.0,
        }),
        background: DVec3::new(0.0, 0.0, 0.4),
        max_depth: 5,
    }
}

/// The pixel in the middle, as shares of 255, and the rays it took.
fn middle(scene: &Scene) -> ([f64; 3], RayCounts) {
    let (picture, rays) = render(scene, 1, 1, Antialiasing::None);
    (picture.get_pixel(0, 0).0.map(|byte| f64::from(byte) / 255.0), rays)
}

fn assert_color(found: [f64; 3], expected: [f64; 3]) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found - expected).abs() < 0.5 / 255.0 + 1e-9, "{found} is not {expected}");
    }
}

#[test]
fn nothing_is_the_background() {
    let (color, rays) = middle(&from_above(vec![]));
    assert_color(color, [0.0, 0.0, 0.4]);
    assert_eq!((rays.primary, rays.shadow, rays.reflected), (1, 0, 0));
}

#[test]
fn a_surface_that_faces_its_light_is_ambient_and_diffuse() {
    let (color, rays) = middle(&from_above(vec![matte(floor(), DVec3::new(1.0, 0.5, 0.0))]));
    assert_color(color, [0.7, 0.35, 0.0]);
    assert_eq!((rays.primary, rays.shadow, rays.reflected), (1, 1, 0));
}

#[test]
fn what_is_in_shadow_is_ambient_alone() {
    // A ball between the floor and the light, but above the camera.
    let scene = from_above(vec![matte(floor(), WHITE), matte(ball(DVec3::Y * 50.0, 5.0), WHITE)]);
    assert_color(middle(&scene).0, [0.2, 0.2, 0.2]);
}

#[test]
fn a_body_behind_the_light_casts_no_shadow() {
    let scene = from_above(vec![matte(floor(), WHITE), matte(ball(DVec3::Y * 2000.0, 5.0), WHITE)]);
    assert_color(middle(&scene).0, [0.7, 0.7, 0.7]);
}

#[test]
fn a_mirror_adds_its_share_of_what_it_shows() {
    let mut mirror = matte(floor(), WHITE);
    mirror.material.reflectivity = 0.5;
    let (color, rays) = middle(&from_above(vec![mirror]));
    assert_color(color, [0.7, 0.7, 0.7 + 0.5 * 0.4]);
    assert_eq!(rays.reflected, 1);
}

#[test]
fn between_two_mirrors_the_depth_ends_the_ray() {
    let mut below = matte(floor(), WHITE);
    below.material.reflectivity = 0.5;
    let mut above = matte(
        Cuboid { min: DVec3::new(-50.0, 20.0, -50.0), max: DVec3::new(50.0, 21.0, 50.0) },
        WHITE,
    );
    above.material.reflectivity = 0.5;
    let mut scene = from_above(vec![below, above]);
    scene.max_depth = 3;
    assert_eq!(middle(&scene).1.reflected, 3);
}

#[test]
fn the_highlight_is_the_lights_color_where_the_mirror_shows_the_light() {
    let mut shiny = matte(floor(), DVec3::new(1.0, 0.0, 0.0));
    shiny.material.specular = 0.25;
    shiny.material.shininess = 50.0;
    assert_color(middle(&from_above(vec![shiny])).0, [0.95, 0.25, 0.25]);
}

#[test]
fn a_grid_takes_the_mean_of_its_rays() {
    // Half of the pixel sees the floor, half sees the background.
    let half = Cuboid { min: DVec3::new(0.0, -1.0, -50.0), max: DVec3::new(50.0, 0.0, 50.0) };
    let scene = from_above(vec![matte(half, WHITE)]);
    let (picture, rays) = render(&scene, 1, 1, Antialiasing::Grid(4));
    assert_eq!(rays.primary, 16);
    let blue = f64::from(picture.get_pixel(0, 0).0[2]) / 255.0;
    assert!((blue - (0.7 + 0.4) / 2.0).abs() < 0.03, "{blue}");
}
