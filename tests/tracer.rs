//! Scenes whose pictures are known on paper.

use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use image::RgbImage;
use lightsquare::config::{Coat, Finish, Light, Pose};
use lightsquare::geometry::{Cuboid, Placed, Plane, Solid, Sphere};
use lightsquare::scene::{Camera, Cells, Material, Object, Scene, Surface, Texture};
use lightsquare::tracer::{self, Antialiasing, RayCounts};

const WHITE: DVec3 = DVec3::ONE;

const MATTE: Finish = Finish {
    ambient: 0.2,
    diffuse: 0.5,
    specular: 0.0,
    shininess: 1.0,
    reflectivity: 0.0,
    transparency: 0.0,
};

fn material(finish: Finish, color: DVec3) -> Material {
    Material { finish, coat: Coat::default(), texture: Texture::Plain(color) }
}

fn made_of(solid: impl Solid + 'static, finish: Finish, color: DVec3) -> Object {
    Object {
        body: Placed::new(Arc::new(solid), DAffine3::IDENTITY),
        surface: Surface::Uniform(material(finish, color)),
        seed: 0,
        paint: None,
        roof: None,
    }
}

fn matte(solid: impl Solid + 'static, color: DVec3) -> Object {
    made_of(solid, MATTE, color)
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
        lights: vec![Light {
            position: DVec3::new(0.0, 1000.0, 0.0),
            color: WHITE,
            ..Light::default()
        }],
        camera: Camera::free(&Pose {
            position: DVec3::new(0.0, 10.0, 0.0),
            look_at: DVec3::ZERO,
            fov: 90.0,
            z_rot: 0.0,
        }),
        room: None,
        cells: Cells::default(),
        background: Some(DVec3::new(0.0, 0.0, 0.4)),
        max_depth: 5,
        min_weight: 0.0,
        max_distance: 1e9,
        snell_index: 1.5,
    }
}

fn render(scene: &Scene, width: u32, height: u32, mode: Antialiasing) -> (RgbImage, RayCounts) {
    let (picture, rays) = tracer::render(scene, width, height, mode);
    (picture.into_rgb8(), rays)
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
    let mirror = made_of(floor(), Finish { reflectivity: 0.5, ..MATTE }, WHITE);
    let (color, rays) = middle(&from_above(vec![mirror]));
    assert_color(color, [0.7, 0.7, 0.7 + 0.5 * 0.4]);
    assert_eq!(rays.reflected, 1);
}

#[test]
fn between_two_mirrors_the_depth_ends_the_ray() {
    let mirror = Finish { reflectivity: 0.5, ..MATTE };
    let ceiling = Cuboid { min: DVec3::new(-50.0, 20.0, -50.0), max: DVec3::new(50.0, 21.0, 50.0) };
    let mut scene =
        from_above(vec![made_of(floor(), mirror, WHITE), made_of(ceiling, mirror, WHITE)]);
    scene.max_depth = 3;
    assert_eq!(middle(&scene).1.reflected, 3);
}

#[test]
fn the_highlight_is_the_lights_color_where_the_mirror_shows_the_light() {
    let finish = Finish { specular: 0.25, shininess: 50.0, ..MATTE };
    let shiny = made_of(floor(), finish, DVec3::X);
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

/// Glass that scatters nothing and lets everything through.
const CLEAR: Finish = Finish { ambient: 0.0, diffuse: 0.0, transparency: 1.0, ..MATTE };

/// A slab between the camera and the floor.
fn pane() -> Cuboid {
    Cuboid { min: DVec3::new(-50.0, 4.0, -50.0), max: DVec3::new(50.0, 5.0, 50.0) }
}

#[test]
fn what_stands_behind_glass_is_seen_through_both_of_its_faces() {
    let tinted = Finish { transparency: 0.5, ..CLEAR };
    let floor = || matte(floor(), WHITE);
    let (clear, rays) = middle(&from_above(vec![made_of(pane(), CLEAR, WHITE), floor()]));
    assert_color(clear, [0.7, 0.7, 0.7]);
    // Into the pane and out of it; both of its faces and the floor ask for the light.
    assert_eq!((rays.refracted, rays.shadow), (2, 3));
    // Light loses half at each face on its way to the floor, and again on its way back.
    let shaded = 0.2 + 0.5 * 0.25;
    let (half, _) = middle(&from_above(vec![made_of(pane(), tinted, WHITE), floor()]));
    assert_color(half, [shaded * 0.25; 3]);
}

/// Through a ball the picture stands on its head: what is on the left is seen on the right.
#[test]
fn a_glass_ball_turns_the_picture_over() {
    let half = Cuboid { min: DVec3::new(0.0, -1.0, -50.0), max: DVec3::new(50.0, 0.0, 50.0) };
    let mut scene = from_above(vec![
        matte(half, DVec3::X),
        made_of(ball(DVec3::new(0.0, 6.0, 0.0), 0.8), CLEAR, WHITE),
    ]);
    scene.lights.clear();
    let (picture, _) = render(&scene, 21, 21, Antialiasing::None);
    let red = |x: u32| picture.get_pixel(x, 10).0[0] > 0;
    // Beside the ball as it is, within it the other way round.
    assert_eq!([0, 20].map(red), [false, true]);
    assert_eq!([8, 12].map(red), [true, false]);
}

#[test]
fn within_one_glass_another_of_the_same_index_is_not_seen() {
    let mut scene = from_above(vec![
        matte(
            Cuboid { min: DVec3::new(1.0, -1.0, -50.0), max: DVec3::new(50.0, 0.0, 50.0) },
            WHITE,
        ),
        made_of(pane(), CLEAR, WHITE),
    ]);
    let alone = render(&scene, 40, 1, Antialiasing::None).0;
    let inner = Cuboid { min: DVec3::new(-3.0, 4.2, -3.0), max: DVec3::new(2.0, 4.8, 3.0) };
    scene.objects.push(made_of(inner, CLEAR, WHITE));
    scene.max_depth = 9;
    assert_eq!(render(&scene, 40, 1, Antialiasing::None).0, alone);
}

#[test]
fn a_camera_within_glass_sees_out_of_it() {
    let around = Cuboid { min: DVec3::splat(-20.0), max: DVec3::splat(20.0) };
    let mut scene = from_above(vec![made_of(around, CLEAR, WHITE)]);
    assert_color(middle(&scene).0, [0.0, 0.0, 0.4]);
    // From within, a wide view meets the walls beyond the critical angle: they are mirrors.
    scene.camera = Camera::free(&Pose {
        position: DVec3::new(0.0, 10.0, 0.0),
        look_at: DVec3::new(1.0, 9.0, 0.0),
        fov: 10.0,
        z_rot: 0.0,
    });
    scene.max_depth = 1;
    assert_color(middle(&scene).0, [0.0, 0.0, 0.0]);
}

#[test]
fn a_plane_has_no_end_but_sight_may() {
    let mut scene = from_above(vec![matte(Plane::new(DVec3::ZERO, DVec3::Y * 7.0), WHITE)]);
    assert_color(middle(&scene).0, [0.7, 0.7, 0.7]);
    scene.max_distance = 9.0;
    assert_color(middle(&scene).0, [0.0, 0.0, 0.4]);
}

/// Glass on the floor is in contact with it: the floor is seen, whichever of the two surfaces
/// rounding finds first, and no light is lost between them.
#[test]
fn glass_in_contact_shows_what_it_stands_on() {
    let block =
        |x: f64| Cuboid { min: DVec3::new(x - 5.0, 0.0, -5.0), max: DVec3::new(x + 5.0, 2.0, 5.0) };
    for order in [[0, 1], [1, 0]] {
        let objects = [matte(floor(), DVec3::X), made_of(block(0.0), CLEAR, WHITE)];
        let mut scene = from_above(order.map(|index| objects[index].clone()).to_vec());
        scene.lights.clear();
        let (picture, rays) = render(&scene, 31, 31, Antialiasing::None);
        assert!(picture.pixels().all(|pixel| pixel.0 == [51, 0, 0]), "{order:?}");
        // In at the top; below there is no way out.
        assert_eq!(rays.refracted, rays.primary);
    }
    // Two blocks side by side are one.
    let pair = [made_of(block(-5.0), CLEAR, WHITE), made_of(block(5.0), CLEAR, WHITE)];
    let whole = Cuboid { min: DVec3::new(-10.0, 0.0, -5.0), max: DVec3::new(10.0, 2.0, 5.0) };
    let mut scene = from_above([&pair[..], &[matte(floor(), DVec3::X)]].concat());
    let two = render(&scene, 31, 31, Antialiasing::None).0;
    scene.objects = vec![made_of(whole, CLEAR, WHITE), matte(floor(), DVec3::X)];
    assert_eq!(render(&scene, 31, 31, Antialiasing::None).0, two);
}

/// The walls of a glass block are mirrors from within, beyond the critical angle, whatever shares
/// its material has.
#[test]
fn total_reflection_throws_everything_back() {
    let faint = Finish { reflectivity: 0.1, transparency: 0.5, ..CLEAR };
    let around = Cuboid { min: DVec3::new(-9.0, 0.0, -9.0), max: DVec3::new(9.0, 40.0, 9.0) };
    // A red ball at the camera's feet, seen only by way of the wall.
    let mut scene = from_above(vec![
        made_of(around, faint, WHITE),
        made_of(ball(DVec3::new(0.0, 4.0, 0.0), 2.0), Finish { ambient: 1.0, ..MATTE }, DVec3::X),
    ]);
    scene.lights.clear();
    scene.camera = Camera::free(&Pose {
        position: DVec3::new(0.0, 23.0, 0.0),
        look_at: DVec3::new(9.0, 13.5, 0.0),
        fov: 4.0,
        z_rot: 0.0,
    });
    assert_color(middle(&scene).0, [1.0, 0.0, 0.0]);
}

/// Squares and pictures may end exactly at a face.
#[test]
fn a_face_on_the_border_of_two_squares_has_the_color_inside() {
    let mut block =
        matte(Cuboid { min: DVec3::new(-4.0, 0.0, -4.0), max: DVec3::new(0.0, 4.0, 0.0) }, WHITE);
    let squares = |color| material(MATTE, color);
    block.surface = Surface::Chequer {
        origin: DVec2::ZERO,
        side: 4.0,
        materials: [squares(DVec3::X), squares(DVec3::Z)],
    };
    let mut scene = from_above(vec![block]);
    scene.lights.clear();
    scene.background = Some(DVec3::Y);
    // The sides at x = 0 and z = 0 seen at a slant.
    scene.camera = Camera::free(&Pose {
        position: DVec3::new(11.3, 5.7, 13.1),
        look_at: DVec3::new(-1.0, 2.0, -1.0),
        fov: 40.0,
        z_rot: 0.0,
    });
    let (picture, _) = render(&scene, 60, 60, Antialiasing::None);
    let colors: std::collections::BTreeSet<[u8; 3]> = picture.pixels().map(|p| p.0).collect();
    assert_eq!(colors.into_iter().collect::<Vec<_>>(), [[0, 255, 0], [51, 0, 0]]);
}

#[test]
fn half_transparent_squares_shade_by_halves() {
    let glass = Finish { transparency: 0.5, ..CLEAR };
    let squares = |finish| material(finish, WHITE);
    let mut screen = matte(pane(), WHITE);
    screen.surface = Surface::Chequer {
        origin: DVec2::splat(-25.0),
        side: 25.0,
        materials: [squares(MATTE), squares(glass)],
    };
    // Above the camera, between the floor and the light.
    screen.body = Placed::new(Arc::new(pane()), DAffine3::from_translation(DVec3::Y * 20.0));
    let scene = from_above(vec![matte(floor(), WHITE), screen]);
    let (picture, _) = render(&scene, 2, 2, Antialiasing::None);
    let found: Vec<u8> = picture.pixels().map(|pixel| pixel.0[0]).collect();
    // Through both faces a quarter of the light comes; through the opaque squares none.
    let [dark, half] = [51, ((0.2 + 0.5 * 0.25 * 0.998) * 255.0_f64).round() as u8];
    let mut sorted = found.clone();
    sorted.sort_unstable();
    assert!(sorted[..2] == [dark; 2] && sorted[2].abs_diff(half) <= 1, "{found:?}");
}

/// A picture with edges of bodies, shadows and squares.
fn busy() -> Scene {
    let squares = |color| material(MATTE, color);
    let mut chequered = matte(floor(), WHITE);
    chequered.surface = Surface::Chequer {
        origin: DVec2::ZERO,
        side: 1.7,
        materials: [squares(DVec3::X), squares(DVec3::Z)],
    };
    let mut scene = from_above(vec![chequered, matte(ball(DVec3::new(1.0, 2.0, 0.5), 1.5), WHITE)]);
    scene.lights[0].position = DVec3::new(-30.0, 40.0, 10.0);
    scene
}

#[test]
fn adaptive_pixels_are_those_of_the_grid_or_of_a_single_ray() {
    let scene = busy();
    // More rows than are in hand at a time.
    let (width, height) = (50, 150);
    let picture = |mode| render(&scene, width, height, mode);
    let (adaptive, rays) = picture(Antialiasing::Adaptive { rays: 3, threshold: 0.05 });
    let (grid, all) = picture(Antialiasing::Grid(3));
    let (single, _) = picture(Antialiasing::None);
    let pixels = adaptive.pixels().zip(grid.pixels()).zip(single.pixels());
    assert!(pixels.clone().all(|((pixel, grid), single)| pixel == grid || pixel == single));
    // Where the two differ much, an edge is, and the grid is right.
    let far = |a: u8, b: u8| a.abs_diff(b) > 20;
    for ((pixel, grid), single) in pixels {
        let is_edge = grid.0.iter().zip(single.0).any(|(a, b)| far(*a, b));
        assert!(!is_edge || pixel == grid);
    }
    assert!(2 * rays.total() < all.total(), "{rays:?} of {all:?}");
}

#[test]
fn adaptive_pixels_depend_on_no_thread() {
    let scene = busy();
    let mode = Antialiasing::Adaptive { rays: 2, threshold: 0.05 };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&scene, 70, 140, mode))
    };
    assert_eq!(with(1), with(3));
}
