//! Piece sets as data: a folder with a file `set.toml` and one file a piece.
//!
//! `source` finds the files, `table` reads TOML and keeps the lines, `points` reads curves, `part`
//! makes typed parts of tables, and `build` makes solids of parts. `docs/piece-sets.md` is the
//! format's description. The built-in sets go the same way as a folder of one's own.

mod build;
mod part;
mod points;
mod source;
mod stand;
mod table;

pub use source::SetName;

use std::collections::BTreeMap;

use build::build;
use part::Part;
use points::{Curve, Curves};
use source::File;
use table::Table;

use crate::geometry::transform::scale;
use crate::geometry::{Csg, Normals};

/// World units of a millimetre: a square is 57 mm and 4 units wide.
const MILLIMETRE: f64 = 4.0 / 57.0;

/// Half of a square's width in millimetres.
const HALF_SQUARE: f64 = 28.5;

/// The least and the greatest height of a piece in millimetres.
const HEIGHTS: (f64, f64) = (10.0, 200.0);

/// More parts than any piece needs.
const MAX_PARTS: usize = 200;

/// A set of chessmen, each standing on the origin, y up, in world units (4 a square).
#[derive(Clone)]
pub struct PieceSet {
    pub pawn: Csg,
    pub knight: Csg,
    pub bishop: Csg,
    pub rook: Csg,
    pub queen: Csg,
    pub king: Csg,
}

impl PieceSet {
    /// Pawn, knight, bishop, rook, queen and king.
    pub fn men(&self) -> [&Csg; 6] {
        [&self.pawn, &self.knight, &self.bishop, &self.rook, &self.queen, &self.king]
    }
}

/// Why a set cannot be had: the file, the line where there is one, and what is wrong.
#[derive(Debug, thiserror::Error)]
#[error("{file}: {}{message}", .line.map(|line| format!("line {line}: ")).unwrap_or_default())]
pub struct SetError {
    file: String,
    line: Option<usize>,
    message: String,
}

/// Reads a set and builds it: lathes get `subdivisions` steps, prisms one less.
///
/// # Errors
/// A file that is missing or cannot be read, or data that make no piece, with file and line.
pub fn piece_set(
    name: &SetName,
    subdivisions: u32,
    normals: Normals,
) -> Result<PieceSet, SetError> {
    let curves = curves(&name.read("set")?)?;
    let piece = |piece: &'static str| {
        let Figure { file, height, solid } = figure(name, piece, &curves, subdivisions, normals)?;
        // Those of the repository stand, as a test sees to.
        if let SetName::Folder(_) = name
            && let Some(fault) = stand::fault(&solid, HALF_SQUARE / height)
        {
            let message = format!("the {piece}: {fault}");
            return Err(SetError { file, line: None, message });
        }
        Ok(solid.placed(scale(height * MILLIMETRE)))
    };
    Ok(PieceSet {
        pawn: piece("pawn")?,
        knight: piece("knight")?,
        bishop: piece("bishop")?,
        rook: piece("rook")?,
        queen: piece("queen")?,
        king: piece("king")?,
    })
}

/// A piece in units of its own height.
struct Figure {
    /// What messages call its file.
    file: String,
    /// In millimetres.
    height: f64,
    solid: Csg,
}

fn figure(
    name: &SetName,
    piece: &'static str,
    curves: &Curves,
    subdivisions: u32,
    normals: Normals,
) -> Result<Figure, SetError> {
    let file = name.read(piece)?;
    let (height, parts) = parts(&file, piece, curves)?;
    let solid = build(&file, piece, &parts, subdivisions, normals)?;
    Ok(Figure { file: file.name, height, solid })
}

/// The curves that `set.toml` names for all pieces.
fn curves(file: &File) -> Result<Curves, SetError> {
    let document = file.parse()?;
    let root = Table::root(file, "the set", &document);
    root.know("key", &["name", "curves"])?;
    root.text("name")?;
    let Some(table) = root.table("curves", "the set's curves")? else {
        return Ok(Curves::new());
    };
    let none = Curves::new();
    table
        .keys()
        .map(|name| Ok((name.to_owned(), Curve::read(&table.needed_text(name)?, &none)?)))
        .collect()
}

/// The height in millimetres and the parts of a piece, by name.
fn parts(
    file: &File,
    piece: &str,
    curves: &Curves,
) -> Result<(f64, BTreeMap<String, Part>), SetError> {
    let document = file.parse()?;
    let root = Table::root(file, &format!("the {piece}"), &document);
    let (least, most) = HEIGHTS;
    let height = root.number("height", least, most)?.ok_or_else(|| {
        root.fault(format!("has no `height`, expected millimetres from {least} to {most}"))
    })?;
    let names: Vec<&str> = root.keys().filter(|key| *key != "height").collect();
    if names.len() > MAX_PARTS {
        return Err(root.fault(format!("has {} parts, expected at most {MAX_PARTS}", names.len())));
    }
    let mut parts = BTreeMap::new();
    for name in names {
        let owner = match name {
            "piece" => format!("the {piece}"),
            _ => format!("the {piece}'s part `{name}`"),
        };
        let Some(table) = root.table(name, &owner)? else { continue };
        parts.insert(name.to_owned(), Part::read(&table, curves)?);
    }
    if !parts.contains_key("piece") {
        return Err(root.fault("has no part [piece], expected it to be what all parts make".into()));
    }
    Ok((height, parts))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_of_the_repository_stand_on_their_squares() {
        for set in [SetName::Staunton, SetName::Thesis] {
            let curves = set.read("set").and_then(|file| curves(&file)).expect("curves");
            for piece in ["pawn", "knight", "bishop", "rook", "queen", "king"] {
                for subdivisions in [0, 1, 2, 4, 7] {
                    let figure = figure(&set, piece, &curves, subdivisions, Normals::Smooth);
                    let Figure { height, solid, .. } = figure.expect("a figure");
                    let fault = stand::fault(&solid, HALF_SQUARE / height);
                    assert_eq!(fault, None, "{piece} of {set}, {subdivisions}");
                    let narrow = stand::fault(&solid, 0.1);
                    assert!(narrow.is_some(), "{piece} of {set}, {subdivisions}");
                }
            }
        }
    }
}
