//! Materials and what they are laid on, as POV-Ray writes them.

use std::fmt::Write;
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::{Writer, vector};
use crate::assets::Bitmap;
use crate::config::{self, Axis, Filter, Finish};
use crate::scene::{HALF, Joinery, MIDDLE, Mapping, Material, Noise, SQUARE, Surface, Texture};

/// Cells of its chequer are cubes; ours go on for ever upwards and downwards.
const TALL: f64 = 1e6;

/// Its opacity scales the light that a surface scatters, so what is quite transparent cannot
/// scatter any; this nearly is.
const MOST_TRANSPARENT: f64 = 0.9999;

impl Writer<'_> {
    pub(super) fn surface(&mut self, surface: &Surface) {
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

    pub(super) fn material(&mut self, material: &Material, depth: usize, place: DAffine3) {
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
