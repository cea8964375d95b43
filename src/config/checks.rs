//! What single keys of a file cannot show: whether materials make sense, and are there for what uses
//! them.

use std::path::Path;

use super::keys::{Lines, unknown};
use super::{Config, Fault, Finish, MAX_SIDE, Mapping, Material, SHORTEST, Texture};

/// The lines of a theme's parts, or of those that stand over all themes.
pub type PartLines = (Option<String>, Lines);

/// A name of a material in use, and the line that uses it.
pub struct Use {
    line: usize,
    key: &'static str,
    name: String,
    of: Part,
}

/// What a material is used for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Body,
    Plane,
    /// A part of the board that is cut from one material.
    Square,
}

impl Use {
    /// A body's, by the key of a section.
    pub fn new(lines: &Lines, key: &'static str, name: &str) -> Use {
        Use { line: lines.of(key), key, name: name.to_owned(), of: Part::Body }
    }

    /// The same for a plane.
    pub fn on_plane(self) -> Use {
        Use { of: Part::Plane, ..self }
    }
}

/// Checks the materials of `uses`, those of the theme in force, of the themes that a file changes, and of
/// what stands over them: what a file does not mention may be of a material that it changes.
pub fn check_materials(
    config: &Config,
    part_lines: &[PartLines],
    mut uses: Vec<Use>,
    faults: &mut Vec<Fault>,
) {
    let part = |key: &str| match key {
        "Light" | "Dark" | "Frame" | "Inlay" => Part::Square,
        "Table" => Part::Plane,
        _ => Part::Body,
    };
    let is_given = |theme: &str| part_lines.iter().any(|(of, _)| of.as_deref() == Some(theme));
    let themes = config.themes.iter().filter(|(name, _)| **name == config.theme || is_given(name));
    let themes = themes.map(|(name, parts)| (Some(name), parts));
    for (theme, parts) in themes.chain([(None, &config.parts)]) {
        for (key, name) in parts.materials() {
            let mut lines = part_lines.iter().filter(|(of, _)| of.as_ref() == theme);
            let line = lines.find(|(_, lines)| lines.give(key)).map_or(0, |(_, l)| l.of(key));
            uses.push(Use { of: part(key), line, key, name: name.clone() });
        }
    }
    if !uses.iter().any(|used| used.key == "Case") {
        uses.push(Use::new(&Lines::default(), "Case", &config.clock.case));
    }
    for used in uses {
        check_use(config, &used, faults);
    }
}

/// Checks what single keys of a material cannot show; its bitmap is sought from `folder` on.
pub fn check_material(
    material: &mut Material,
    section: &str,
    folder: &Path,
    lines: &Lines,
    faults: &mut Vec<Fault>,
) {
    let mut fault = |key, message| faults.push(Fault { line: lines.of(key), message });
    let Finish { reflectivity, transparency, .. } = material.finish;
    // Each surface splits a ray in two; together they must not become more than it was.
    if reflectivity + transparency > 1.0 + 1e-9 {
        let sum = reflectivity + transparency;
        let message = format!("Reflectivity and Transparency are {sum} together, expected up to 1");
        fault(if lines.give("Transparency") { "Transparency" } else { "Reflectivity" }, message);
    }
    if material.texture != Texture::Bitmap {
        return;
    }
    if lines.failed("Bitmap") {
        return;
    }
    if lines.give("Bitmap") {
        material.bitmap = folder.join(&material.bitmap);
    }
    if material.bitmap.as_os_str().is_empty() {
        fault("Texture", format!("[{section}] has no Bitmap, expected the name of a picture"));
    } else if let Some(found) = unusable(&material.bitmap) {
        let path = material.bitmap.display();
        fault("Bitmap", format!("the picture `{path}` {found}, expected a BMP or PNG file"));
    }
    for (key, vector) in [("U", material.u), ("V", material.v)] {
        if vector.length() < SHORTEST {
            fault(key, format!("{key} has no length, expected a direction"));
        }
    }
    let both = material.u.cross(material.v).length();
    let area = material.u.length() * material.v.length();
    if area > 0.0 && both < 1e-9 * area {
        let expected = match material.mapping {
            Mapping::Planar => "two sides of the picture",
            Mapping::Cylindrical | Mapping::Spherical => "an axis and a direction from it",
        };
        fault("V", format!("U and V have the same direction, expected {expected}"));
    }
}

/// What is wrong with a picture, as far as its first bytes tell.
fn unusable(path: &Path) -> Option<String> {
    if !path.exists() {
        return Some("is not there".to_owned());
    }
    if !path.is_file() {
        return Some("is no file".to_owned());
    }
    match image::image_dimensions(path) {
        Err(error) => Some(format!("cannot be read ({error})")),
        Ok((width, height)) if width.max(height) > MAX_SIDE => {
            Some(format!("is {width} x {height} pixels, at most {MAX_SIDE} a side are read"))
        }
        Ok(_) => None,
    }
}

fn check_use(config: &Config, used: &Use, faults: &mut Vec<Fault>) {
    let Use { line, key, name, of } = used;
    let message = match config.materials.get(name) {
        None => {
            let known = config.materials.keys().map(String::as_str);
            format!("{key}: {}", unknown("material", name, known))
        }
        Some(material) if *of == Part::Plane && material.is_transparent() => format!(
            "{key} `{name}` is transparent, expected another: a plane has no inside to look through"
        ),
        Some(material) if *of == Part::Square && material.texture == Texture::Chequer => {
            format!("{key} `{name}` is a chequer, expected a material of one kind")
        }
        Some(_) => return,
    };
    faults.push(Fault { line: *line, message });
}
