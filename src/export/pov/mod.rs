//! Scenes for POV-Ray 3.7, such that it computes what the tracer computes.
//!
//! What differs, and is said in the file: marks on the squares and coordinates on the frame, which it
//! does not get; smooth normals (its lathes and prisms of straight segments are shaded flat), MIP
//! levels (it reads bitmaps between four texels), a limit of the distance, and wood and marble, which
//! become its own patterns of noise. It also sees nothing of a surface that touches glass from outside
//! (it takes no hit within 0.001 of a ray's origin), and may see faces inside the union of transparent
//! bodies where their walls lie in one plane. Where a face lies on the very border of two copies of a
//! bitmap, it may take the other one.

macro_rules! line {
    ($writer:expr, $($format:tt)*) => {
        // Writing to a string cannot fail.
        { let _ = writeln!($writer.text, $($format)*); }
    };
}

mod solid;
mod surface;

use std::fmt::{Display, Formatter, Write};
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use solid::Use;

use crate::assets::Bitmap;
use crate::config;

use crate::scene::{Object, Projection, Scene};

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

/// It weighs rays otherwise, and drops some that we follow; so it follows fainter ones.
const FAINTER: f64 = 1000.0;

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
        if object.paint.is_some() {
            line!(self, "// Marks in lightsquare, none here.");
        }
        line!(self, "object {{");
        line!(self, "  Solid{number}");
        self.surface(&object.surface);
        if is_clear {
            line!(self, "  interior {{ ior {snell_index} }}");
        }
        self.transform(1, object.body.transform());
        line!(self, "}}");
    }

    /// Its rows are where the axes and the origin go.
    fn transform(&mut self, depth: usize, transform: DAffine3) {
        if transform != DAffine3::IDENTITY {
            let rows = transform.to_cols_array();
            line!(self, "{}matrix {}", "  ".repeat(depth), Angled(&rows));
        }
    }
}

fn vector(vector: DVec3) -> String {
    Angled(&vector.to_array()).to_string()
}
