//! The shelf that surfaces are taken from by name.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::texture::{Noise, linear_light};
use super::{Mapping, Material, Rgb, Surface, Texture};
use crate::assets::Bitmap;
use crate::config::{self, Config, Shading};

/// A material that settings name but do not have, or a picture that was not read for it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MaterialError {
    #[error("there is no material `{0}`")]
    Unknown(String),
    #[error("the picture {} was not read", .0.display())]
    NoBitmap(PathBuf),
}

/// The shelf that surfaces are taken from by name.
pub(super) struct Materials<'a> {
    pub config: &'a Config,
    pub bitmaps: &'a BTreeMap<PathBuf, Arc<Bitmap>>,
}

impl Materials<'_> {
    /// The surface that settings call `name`.
    pub fn surface(&self, name: &str) -> Result<Surface, MaterialError> {
        let settings = self.settings(name)?;
        let config::Material { finish, coat, .. } = *settings;
        if settings.texture == config::Texture::Chequer {
            let plain =
                |color| Material { finish, coat, texture: Texture::Plain(self.color(color)) };
            return Ok(Surface::Chequer {
                origin: DVec2::new(settings.origin.x, settings.origin.z),
                side: settings.size,
                materials: [settings.color, settings.second_color].map(plain),
            });
        }
        Ok(Surface::Uniform(self.material(name)?))
    }

    /// The material that settings call `name`; of a chequer the one of its even squares.
    pub fn material(&self, name: &str) -> Result<Material, MaterialError> {
        let settings = self.settings(name)?;
        let noise = Noise { size: settings.size, octaves: settings.octaves };
        let colors = [settings.color, settings.second_color].map(|color| self.color(color));
        let texture = match settings.texture {
            config::Texture::Plain | config::Texture::Chequer => Texture::Plain(colors[0]),
            config::Texture::Wood => Texture::Wood { colors, noise, grain: settings.grain },
            config::Texture::Timber => {
                Texture::Timber { colors, ring: settings.size, grain: settings.grain }
            }
            config::Texture::Marble => Texture::Marble { colors, noise },
            config::Texture::Bitmap => Texture::Bitmap {
                bitmap: self
                    .bitmaps
                    .get(&settings.bitmap)
                    .cloned()
                    .ok_or_else(|| MaterialError::NoBitmap(settings.bitmap.clone()))?,
                mapping: Mapping {
                    kind: settings.mapping,
                    origin: settings.origin,
                    u: settings.u,
                    v: settings.v,
                },
                filter: self.config.render.filter,
                linear: self.is_linear(),
            },
        };
        let texture = if self.config.render.plain { texture.plain() } else { texture };
        Ok(Material { finish: settings.finish, coat: settings.coat, texture })
    }

    /// Whether colours are linear light.
    pub fn is_linear(&self) -> bool {
        self.config.render.shading == Shading::Studio
    }

    /// A colour of the settings as light is summed up.
    pub fn color(&self, written: DVec3) -> Rgb {
        if self.is_linear() { linear_light(written) } else { written }
    }

    fn settings(&self, name: &str) -> Result<&config::Material, MaterialError> {
        let found = self.config.materials.get(name);
        found.ok_or_else(|| MaterialError::Unknown(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Place;

    #[test]
    fn the_chequer_has_a_dark_a1_and_a_light_h1() {
        let settings = Config::new(config::Look::Thesis);
        let materials = Materials { config: &settings, bitmaps: &BTreeMap::new() };
        let [dark, light] = ["dark", "light"].map(|name| materials.material(name).unwrap());
        let board = Surface::Chequer {
            origin: DVec2::splat(-2.0),
            side: 4.0,
            materials: [dark.clone(), light.clone()],
        };
        let at = |point| Place { on_body: point, point, seed: 0 };
        let color = |material: &Material| material.texture.color(at(DVec3::ZERO), 0.0);
        for (file, rank, expected) in [(0, 0, &dark), (7, 0, &light), (0, 7, &light), (7, 7, &dark)]
        {
            let point = DVec3::new(f64::from(4 * file), 0.0, f64::from(4 * rank));
            assert_eq!(color(board.material(at(point)).0), color(expected));
        }
    }
}
