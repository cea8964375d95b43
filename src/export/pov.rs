//! Scenes for POV-Ray 3.7, such that it computes what the tracer computes.
//!
//! What differs, and is said in the file: coordinates on the frame, which it does not get; smooth
//! normals (its lathes and prisms of straight segments are shaded flat), MIP levels (it reads bitmaps between four texels), a limit of the
//! distance, and wood and marble, which become its own patterns of noise. It also sees nothing of
//! a surface that touches glass from outside (it takes no hit within 0.001 of a ray's origin), and
//! may see faces inside the union of transparent bodies where their walls lie in one plane. Where a
//! face lies on the very border of two copies of a bitmap, it may take the other one.

use std::fmt::{Display, Formatter, Write};
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use crate::assets::Bitmap;
use crate::config::{self, Axis, Filter, Finish};
use crate::geometry::{Csg, Lathe, Operation, Plane, Prism, Root, Segment, Shape, Solid};
use crate::scene::{
    HALF, Joinery, MIDDLE, Mapping, Material, Noise, Object, Projection, SQUARE, Scene, Surface,
    Texture,
};

/// A scene's text, and the pictures that it names.
pub struct PovScene {
    pub text: String,
    /// File names (PNG) with what they should hold; they belong beside the text.
    pub bitmaps: Vec<(String, Arc<Bitmap>)>,
}

/// Writes `scene` for pictures of `width` × `height` pixels. The file names of its bitmaps begin
/// with `name`, which holds nothing but letters, digits and hyphens of ASCII.
pub fn pov(scene: &Scene, width: u32, height: u32, name: &str) -> PovScene {
    let mut writer = Writer { text: String::new(), solids: Vec::new(), bitmaps: Vec::new(), name };
    writer.head(scene, width, height);
    for object in &scene.objects {
        writer.object(object, scene.snell_index);
    }
    PovScene { text: writer.text, bitmaps: writer.bitmaps }
}

/// So many segments of a lathe make one lathe of POV-Ray's: it asks all segments of one for each
/// ray, and bounds each by a box.
const RUN: usize = 8;

/// Cells of its chequer are cubes; ours go on for ever upwards and downwards.
const TALL: f64 = 1e6;

/// It weighs rays otherwise, and drops some that we follow; so it follows fainter ones.
const FAINTER: f64 = 1000.0;

/// Its opacity scales the light that a surface scatters, so what is quite transparent cannot
/// scatter any; this nearly is.
const MOST_TRANSPARENT: f64 = 0.9999;

struct Writer<'a> {
    text: String,
    /// Solids that several objects share, by their address, in the order of their names; each as a
    /// whole or in runs.
    solids: Vec<(*const (), bool)>,
    bitmaps: Vec<(String, Arc<Bitmap>)>,
    name: &'a str,
}

/// A vector as POV-Ray writes it.
struct Angled<'a>(&'a [f64]);

impl Display for Angled<'_> {
    fn fmt(&self, out: &mut Formatter) -> std::fmt::Result {
        for (index, number) in self.0.iter().enumerate() {
            write!(out, "{}{number}", if index == 0 { "<" } else { ", " })?;
        }
        out.write_str(">")
    }
}

macro_rules! line {
    ($writer:expr, $($format:tt)*) => {
        // Writing to a string cannot fail.
        { let _ = writeln!($writer.text, $($format)*); }
    };
}

impl Writer<'_> {
    fn head(&mut self, scene: &Scene, width: u32, height: u32) {
        let [right, up, forward] = scene.camera.axes();
        let across = scene.camera.width();
        let tall = across * f64::from(height) / f64::from(width);
        line!(self, "// By lightsquare {}, to be rendered with", env!("CARGO_PKG_VERSION"));
        line!(self, "// povray +Iscene.pov +W{width} +H{height} -A");
        if scene.max_distance < config::FARTHEST {
            line!(self, "// Rays that end after {} units have no end here.", scene.max_distance);
        }
        line!(self, "#version 3.7;");
        // One more than reflections: the ray from the camera is the first.
        line!(
            self,
            "global_settings {{ assumed_gamma srgb max_trace_level {} adc_bailout {} }}",
            scene.max_depth + 1,
            scene.min_weight / FAINTER
        );
        match scene.background {
            Some(color) => line!(self, "background {{ rgb {} }}", vector(color)),
            None => {
                line!(self, "// Transparent where there is nothing, with +UA.");
                line!(self, "background {{ rgbt <0, 0, 0, 1> }}");
            }
        }
        line!(self, "camera {{");
        let projection = match scene.camera.projection() {
            Projection::Perspective => "perspective",
            Projection::Parallel => "orthographic",
        };
        line!(self, "  {projection} location {}", vector(scene.camera.position()));
        line!(self, "  right {} up {}", vector(right * across), vector(up * tall));
        line!(self, "  direction {}", vector(forward));
        line!(self, "}}");
        for light in &scene.lights {
            line!(
                self,
                "light_source {{ {} rgb {} }}",
                vector(light.position),
                vector(light.color)
            );
        }
    }

    fn object(&mut self, object: &Object, snell_index: f64) {
        let solid = object.body.solid();
        let is_clear = object.surface.is_transparent();
        let key = (std::ptr::from_ref(solid).cast::<()>(), is_clear);
        let number = self.solids.iter().position(|known| *known == key).unwrap_or_else(|| {
            line!(self, "#declare Solid{} =", self.solids.len());
            // A ray within glass must know the whole of what it is in.
            self.solid(solid, 1, if is_clear { Use::Clear } else { Use::Skin });
            self.solids.push(key);
            self.solids.len() - 1
        });
        line!(self, "object {{");
        line!(self, "  Solid{number}");
        self.surface(&object.surface);
        if is_clear {
            line!(self, "  interior {{ ior {snell_index} }}");
        }
        self.transform(1, object.body.transform());
        line!(self, "}}");
    }

    fn solid(&mut self, solid: &dyn Solid, depth: usize, used: Use) {
        let pad = "  ".repeat(depth);
        match solid.shape() {
            Shape::Plane(Plane { origin, normal }) => {
                let distance = origin.dot(*normal);
                line!(self, "{pad}plane {{ {}, {distance} }}", vector(*normal));
            }
            Shape::Sphere(sphere) => {
                line!(self, "{pad}sphere {{ {}, {} }}", vector(sphere.center), sphere.radius);
            }
            Shape::Cuboid(cuboid) => {
                line!(self, "{pad}box {{ {}, {} }}", vector(cuboid.min), vector(cuboid.max));
            }
            Shape::Lathe(lathe) => self.lathe(lathe, depth, used),
            Shape::Prism(prism) => self.prism(prism, &pad),
            Shape::Csg(csg) => self.csg(csg, depth, used),
            Shape::Placed(placed) => {
                line!(self, "{pad}object {{");
                self.solid(placed.solid(), depth + 1, used);
                self.transform(depth + 1, placed.transform());
                line!(self, "{pad}}}");
            }
        }
    }

    fn lathe(&mut self, lathe: &Lathe, depth: usize, used: Use) {
        let pad = "  ".repeat(depth);
        let segments = lathe.segments();
        self.say_if_smooth(segments, &pad);
        if used != Use::Skin || segments.len() <= RUN {
            self.lathe_run(segments, &pad);
            return;
        }
        line!(self, "{pad}union {{");
        for chain in segments.chunk_by(|one, next| one.to == next.from) {
            for run in chain.chunks(RUN) {
                self.lathe_run(run, &format!("{pad}  "));
            }
        }
        line!(self, "{pad}}}");
    }

    fn lathe_run(&mut self, segments: &[Segment], pad: &str) {
        let mut points: Vec<DVec2> =
            segments.iter().flat_map(|segment| [segment.from, segment.to]).collect();
        points.dedup();
        line!(self, "{pad}lathe {{ linear_spline {}, {} }}", points.len(), listed(&points));
    }

    fn prism(&mut self, prism: &Prism, pad: &str) {
        let segments = prism.segments();
        self.say_if_smooth(segments, pad);
        // Its last point is its first one again.
        let first = segments.first().map(|segment| segment.from);
        let points: Vec<DVec2> = segments.iter().map(|segment| segment.from).chain(first).collect();
        let (back, front) = (prism.bounds().min.z, prism.bounds().max.z);
        line!(self, "{pad}prism {{");
        line!(self, "{pad}  linear_spline linear_sweep {back}, {front}, {},", points.len());
        line!(self, "{pad}  {}", listed(&points));
        // Its outlines lie in the plane of x and z and go along y.
        line!(self, "{pad}  matrix <1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0>");
        line!(self, "{pad}}}");
    }

    fn say_if_smooth(&mut self, segments: &[Segment], pad: &str) {
        if segments.iter().any(|segment| segment.smooth != [segment.normal; 2]) {
            line!(self, "{pad}// Smooth in lightsquare, flat here.");
        }
    }

    fn csg(&mut self, csg: &Csg, depth: usize, used: Use) {
        let (operation, first) = match csg.root() {
            Root::Leaf(solid) => return self.solid(solid, depth, used),
            Root::Pair(operation, ..) => (operation, csg),
        };
        // A chain of the same operation is one list.
        let mut others = Vec::new();
        let mut first = first;
        while let Root::Pair(other, left, right) = first.root()
            && other == operation
        {
            others.push(right);
            first = left;
        }
        let pad = "  ".repeat(depth);
        let (word, used) = match operation {
            Operation::Union if used == Use::Clear => ("merge", used),
            Operation::Union => ("union", used),
            Operation::Intersection => ("intersection", used.carved()),
            Operation::Difference => ("difference", used.carved()),
        };
        line!(self, "{pad}{word} {{");
        for part in [first].into_iter().chain(others.into_iter().rev()) {
            self.csg(part, depth + 1, used);
        }
        line!(self, "{pad}}}");
    }

    fn surface(&mut self, surface: &Surface) {
        match surface {
            Surface::Uniform(material) => self.material(material, 1, DAffine3::IDENTITY),
            Surface::Board(joinery) => self.joinery(joinery),
            Surface::Chequer { origin, side, materials: [even, odd] } => {
                self.chequer(*origin, *side, [even, odd], 1);
            }
        }
    }

    /// Frame, inlay and squares, one within the other.
    fn joinery(&mut self, joinery: &Joinery) {
        let [dark, light, frame, inlay] = &joinery.materials;
        let within = |half: f64| {
            let half = DVec3::new(half, TALL, half);
            format!("box {{ {}, {} }}", vector(MIDDLE - half), vector(MIDDLE + half))
        };
        line!(self, "  texture {{ object {{ {}", within(HALF + joinery.inlay_width()));
        self.material(frame, 2, DAffine3::IDENTITY);
        line!(self, "  texture {{ object {{ {}", within(HALF));
        self.material(inlay, 2, DAffine3::IDENTITY);
        self.chequer(DVec2::splat(-SQUARE / 2.0), SQUARE, [dark, light], 2);
        line!(self, "  }} }} }} }}");
    }

    fn chequer(&mut self, origin: DVec2, side: f64, materials: [&Material; 2], depth: usize) {
        let pad = "  ".repeat(depth);
        // What scales the chequer would scale the materials in it, too.
        let place = DAffine3 {
            matrix3: DMat3::from_diagonal(DVec3::new(side, TALL, side)),
            translation: DVec3::new(origin.x, -TALL / 2.0, origin.y),
        };
        line!(self, "{pad}texture {{");
        line!(self, "{pad}  checker");
        for material in materials {
            self.material(material, depth + 1, place.inverse());
        }
        self.transform(depth + 1, place);
        line!(self, "{pad}}}");
    }

    fn material(&mut self, material: &Material, depth: usize, place: DAffine3) {
        let pad = "  ".repeat(depth);
        let Finish { ambient, diffuse, specular, shininess, reflectivity, transparency } =
            material.finish;
        let transparency = transparency.min(MOST_TRANSPARENT);
        let opacity = 1.0 - transparency;
        line!(self, "{pad}texture {{");
        self.pigment(&material.texture, depth + 1, transparency);
        line!(
            self,
            "{pad}  finish {{ ambient {} diffuse {} phong {specular} phong_size {shininess} \
             reflection {reflectivity} }}",
            ambient / opacity,
            diffuse / opacity,
        );
        if place != DAffine3::IDENTITY {
            self.transform(depth + 1, place);
        }
        line!(self, "{pad}}}");
    }

    fn pigment(&mut self, texture: &Texture, depth: usize, transparency: f64) {
        let pad = "  ".repeat(depth);
        let color = |color: DVec3| format!("rgb {} transmit {transparency}", vector(color));
        match texture {
            Texture::Plain(plain) => line!(self, "{pad}pigment {{ {} }}", color(*plain)),
            Texture::Timber { colors: [ground, ring], ring: size, grain } => {
                let stretch = along(*grain) * *size;
                line!(self, "{pad}pigment {{ bozo");
                line!(self, "{pad}  color_map {{ [0 {}] [1 {}] }}", color(*ground), color(*ring));
                line!(self, "{pad}  scale {}", vector(stretch));
                line!(self, "{pad}}}");
            }
            Texture::Wood { colors: [ring, ground], noise: Noise { size, octaves }, grain } => {
                let stretch = along(*grain) * *size;
                let turbulence = turbulence(*octaves);
                line!(self, "{pad}pigment {{ bozo frequency 20 {turbulence}");
                line!(self, "{pad}  color_map {{ [0 {}] [1 {}] }}", color(*ring), color(*ground));
                line!(self, "{pad}  scale {}", vector(stretch));
                line!(self, "{pad}}}");
            }
            Texture::Marble { colors: [ground, vein], noise: Noise { size, octaves } } => {
                let turbulence = turbulence(*octaves);
                line!(self, "{pad}pigment {{ gradient <0.6, 0.7, 0.4> triangle_wave {turbulence}");
                line!(
                    self,
                    "{pad}  color_map {{ [0 {}] [0.2 {}] [1 {}] }}",
                    color(*vein),
                    color(ground.lerp(*vein, 0.2)),
                    color(*ground)
                );
                line!(self, "{pad}  scale {size}");
                line!(self, "{pad}}}");
            }
            Texture::Lettered { ground, .. } => {
                line!(self, "{pad}// Coordinates in lightsquare, none here.");
                self.pigment(ground, depth, transparency);
            }
            Texture::Bitmap { bitmap, mapping, filter, .. } => {
                let name = self.bitmap(bitmap);
                let (kind, place) = laid(mapping);
                let interpolate = match filter {
                    Filter::Nearest => "",
                    Filter::Bilinear | Filter::Mip => " interpolate 2",
                };
                if *filter == Filter::Mip {
                    line!(self, "{pad}// MIP levels in lightsquare, none here.");
                }
                line!(self, "{pad}pigment {{");
                line!(
                    self,
                    "{pad}  image_map {{ png \"{name}\" map_type {kind}{interpolate} \
                     transmit all {transparency} }}"
                );
                self.transform(depth + 1, place);
                line!(self, "{pad}}}");
            }
        }
    }

    /// The file name of a picture.
    fn bitmap(&mut self, bitmap: &Arc<Bitmap>) -> String {
        if let Some((name, _)) = self.bitmaps.iter().find(|(_, known)| Arc::ptr_eq(known, bitmap)) {
            return name.clone();
        }
        let name = format!("{}-bitmap{}.png", self.name, self.bitmaps.len());
        self.bitmaps.push((name.clone(), bitmap.clone()));
        name
    }

    /// Its rows are where the axes and the origin go.
    fn transform(&mut self, depth: usize, transform: DAffine3) {
        if transform != DAffine3::IDENTITY {
            let rows = transform.to_cols_array();
            line!(self, "{}matrix {}", "  ".repeat(depth), Angled(&rows));
        }
    }
}

/// What POV-Ray must know of a solid.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Use {
    /// Where its surface is.
    Skin,
    /// Its inside too: something is cut from it, or with it.
    Carved,
    /// Its inside, and no surface within it: it is transparent.
    Clear,
}

impl Use {
    fn carved(self) -> Use {
        if self == Use::Skin { Use::Carved } else { self }
    }
}

/// How wood is stretched that grew along `grain`.
fn along(grain: Axis) -> DVec3 {
    match grain {
        Axis::X => DVec3::new(20.0, 1.0, 1.0),
        Axis::Y => DVec3::new(1.0, 20.0, 1.0),
        Axis::Z => DVec3::new(1.0, 1.0, 20.0),
    }
}

/// How POV-Ray lays a picture as `mapping` does: the number of its kind, and the way from the unit
/// square, cylinder or sphere that it lays it on.
fn laid(mapping: &Mapping) -> (u8, DAffine3) {
    let origin = mapping.origin;
    let [start, up, right] = mapping.axes();
    match mapping.kind {
        config::Mapping::Planar => {
            let across = mapping.u.cross(mapping.v).normalize();
            (
                0,
                DAffine3::from_mat3_translation(
                    DMat3::from_cols(mapping.u, mapping.v, across),
                    origin,
                ),
            )
        }
        config::Mapping::Cylindrical => {
            (2, DAffine3::from_mat3_translation(DMat3::from_cols(start, mapping.v, right), origin))
        }
        config::Mapping::Spherical => {
            (1, DAffine3::from_mat3_translation(DMat3::from_cols(start, up, right), origin))
        }
    }
}

fn turbulence(octaves: u32) -> String {
    if octaves > 1 { format!("turbulence 0.5 octaves {}", octaves.min(10)) } else { String::new() }
}

fn vector(vector: DVec3) -> String {
    Angled(&vector.to_array()).to_string()
}

fn listed(points: &[DVec2]) -> String {
    let points: Vec<String> =
        points.iter().map(|point| Angled(&point.to_array()).to_string()).collect();
    points.join(", ")
}
