//! Marks on the board, as paint on its squares: it is lit, mirrored and smoothed as they are.
//!
//! Lengths are in squares; (0, 0) is the middle of a1, x goes to the h-file and y to rank 8.

mod arrow;
pub(crate) mod shape;

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::materials::Materials;
use super::measures::SQUARE;
use super::{Object, Rgb};
use crate::config;
use crate::notation::{Brush, Placement, Square};
use crate::timeline::Marks;

use shape::Shape;

/// How far a piece's foot reaches from the middle of its square: that of a king, the widest.
const FOOT: f64 = 0.37;

/// How far below the board's surface its top may seem to be, in world units.
pub const TOP: f64 = 1e-4;

/// No point of a square is farther from its middle.
const HALF_DIAGONAL: f64 = 0.71;

/// How wide the dark edge round an arrow or a ring is, and its share of the colour beneath.
const EDGE: f64 = 0.02;
const EDGE_OPACITY: f64 = 0.7;

/// How much of a colour an edge has.
const SHADE: f64 = 0.12;

/// What is painted on the squares, from the lowest layer up.
#[derive(Debug)]
pub struct Painting {
    layers: Vec<Layer>,
    /// By square, a1, b1, … h8: the layers that reach it, the lowest first.
    on: [Vec<usize>; 64],
}

/// One shape in one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    pub shape: Shape,
    pub color: Rgb,
    /// Share of the colour where it covers, 0 to 1.
    pub opacity: f64,
}

impl Painting {
    fn new(layers: Vec<Layer>) -> Painting {
        let reaching = |square: Square| {
            let middle = middle(square);
            let reaches = |index: &usize| layers[*index].shape.reaches(middle, HALF_DIAGONAL);
            (0..layers.len()).filter(reaches).collect()
        };
        let on = std::array::from_fn(|index| reaching(Square::new(index as u32)));
        Painting { layers, on }
    }

    /// By square, a1, b1, … h8: the layers that reach it, the lowest first.
    pub fn squares(&self) -> impl Iterator<Item = impl Iterator<Item = &Layer>> {
        self.on.iter().map(|layers| layers.iter().map(|index| &self.layers[*index]))
    }

    /// The colour at a `point` of the board, of the colour `ground` before, where a width of `seen`
    /// world units is seen at once.
    pub fn over(&self, ground: Rgb, point: DVec3, seen: f64) -> Rgb {
        let place = DVec2::new(point.x, point.z) / SQUARE;
        let cell = (place + 0.5).floor();
        if point.y < -TOP || cell.min_element() < 0.0 || cell.max_element() > 7.0 {
            return ground;
        }
        let layers = &self.on[8 * cell.y as usize + cell.x as usize];
        layers.iter().map(|index| &self.layers[*index]).fold(ground, |color, layer| {
            let cover = layer.shape.cover(place, seen / SQUARE);
            color.lerp(layer.color, cover * layer.opacity)
        })
    }
}

/// The squares, by bits (a1, b1, … h8), on which two paintings are not the same.
pub fn repainted(one: &Painting, other: &Painting) -> u64 {
    let layers = |painting: &Painting, square: usize| {
        painting.on[square].iter().map(|index| painting.layers[*index].clone()).collect::<Vec<_>>()
    };
    let differs = |square: &usize| layers(one, *square) != layers(other, *square);
    (0..64).filter(differs).fold(0, |squares, square| squares | 1 << square)
}

fn middle(square: Square) -> DVec2 {
    DVec2::new(f64::from(square.file() as u32), f64::from(square.rank() as u32))
}

/// The colours that marks are painted in, as light is summed up.
pub struct Paints {
    settings: config::Marks,
}

impl Paints {
    pub(super) fn new(materials: &Materials) -> Paints {
        let mut settings = materials.config.marks;
        let config::Marks {
            last_move_color,
            check_color,
            mate_color,
            green,
            red,
            yellow,
            blue,
            ..
        } = &mut settings;
        for color in [last_move_color, check_color, mate_color, green, red, yellow, blue] {
            *color = materials.color(*color);
        }
        Paints { settings }
    }

    /// Paints `marks` on the board `squares`, where pieces stand as in `placement`. Where marks of any kind
    /// may be shown there is a painting, be it empty.
    pub fn paint(&self, squares: &mut Object, marks: &Marks, placement: &Placement) {
        let config::Marks { last_move, check, mate, drawn, .. } = self.settings;
        let may_paint = last_move || check || mate || drawn;
        let painting = || Arc::new(Painting::new(self.layers(marks, placement)));
        squares.paint = may_paint.then(painting);
    }

    fn layers(&self, marks: &Marks, placement: &Placement) -> Vec<Layer> {
        let settings = &self.settings;
        let mut layers = Vec::new();
        if settings.last_move {
            for square in &marks.last_move {
                layers.extend(last_move(middle(*square), settings.last_move_color));
            }
        }
        if let Some(king) = marks.check.map(middle) {
            if marks.is_mate && settings.mate {
                layers.extend(mate(king, settings.mate_color));
            } else if settings.check {
                let shape = Shape::Glow { middle: king };
                layers.push(Layer { shape, color: settings.check_color, opacity: 0.95 });
            }
        }
        if settings.drawn {
            for circle in &marks.circles {
                layers.extend(ring(middle(circle.square), self.brush(circle.brush)));
            }
            for arrow in &marks.arrows {
                let ends = [arrow.from, arrow.to]
                    .map(|square| (middle(square), placement.get(square).is_some()));
                let shape = Shape::Arrow(arrow::Arrow::new(ends));
                layers.extend(edged(shape, self.brush(arrow.brush)));
            }
        }
        layers
    }

    fn brush(&self, brush: Brush) -> Rgb {
        match brush {
            Brush::Green => self.settings.green,
            Brush::Red => self.settings.red,
            Brush::Yellow => self.settings.yellow,
            Brush::Blue => self.settings.blue,
        }
    }
}

/// A tint, and a dark line within the square's border: in greys a tinted dark square is a light one.
fn last_move(middle: DVec2, color: Rgb) -> [Layer; 2] {
    [
        Layer { shape: Shape::Square { middle }, color, opacity: 0.5 },
        Layer {
            shape: Shape::Frame { middle, to: 0.455, width: 0.028 },
            color: color * SHADE,
            opacity: EDGE_OPACITY,
        },
    ]
}

/// The whole square, and strokes from its corners towards the king: it is crossed out.
fn mate(middle: DVec2, color: Rgb) -> [Layer; 2] {
    [
        Layer { shape: Shape::Square { middle }, color, opacity: 0.9 },
        Layer { shape: Shape::Cross { middle }, color: Rgb::splat(0.9), opacity: 0.95 },
    ]
}

/// A ring outside a foot and inside the square, and a light tint in it.
fn ring(middle: DVec2, color: Rgb) -> Vec<Layer> {
    let tint = Layer { shape: Shape::Disc { middle, radius: 0.435 }, color, opacity: 0.2 };
    let ring = Shape::Ring { middle, radius: 0.435, width: 0.08 };
    std::iter::once(tint).chain(edged(ring, color)).collect()
}

/// A shape with a dark edge round it, so that it stands off grounds of its own brightness.
fn edged(shape: Shape, color: Rgb) -> [Layer; 2] {
    let edge = Shape::Grown(Box::new(shape.clone()), EDGE);
    [
        Layer { shape: edge, color: color * SHADE, opacity: EDGE_OPACITY },
        Layer { shape, color, opacity: 0.92 },
    ]
}
