//! Phong's pictures: one ray a pixel, a grid, or a grid where neighbours differ.

use glam::Vec3;

use super::eye::Eye;
use super::footprint::Footprint;
use super::phong::{Place, Seen};
use super::pixel::{Pixel, Stored};
use super::plane::{Plane, Spot};
use super::silhouette::Silhouette;
use super::{Antialiasing, RayCounts};
use crate::scene::Scene;

/// Paints a picture of `scene` through `eye`.
pub fn render(
    eye: &impl Eye<Sample = Place, Seen = Seen>,
    scene: &Scene,
    size: [u32; 2],
    mode: Antialiasing,
) -> (Plane<Stored>, RayCounts) {
    let background = scene.background.map(|color| color.as_vec3());
    let nothing = Seen {
        color: background.unwrap_or(Vec3::ZERO),
        hits: false,
        footprint: Footprint::of_nothing(),
    };
    let is_transparent = background.is_none();
    let easel = Easel { eye, silhouette: Silhouette::new(scene, size), is_transparent, nothing };
    let mut picture = Plane::new(size[0], size[1], easel.pixel(&nothing).stored());
    let counts = match mode {
        Antialiasing::None => easel.grid(&mut picture, 1),
        Antialiasing::Grid(side) => easel.grid(&mut picture, side),
        Antialiasing::Adaptive { rays, threshold } => easel.adaptive(&mut picture, rays, threshold),
    };
    (picture, counts)
}

struct Easel<'a, E> {
    eye: &'a E,
    silhouette: Silhouette,
    /// Whether what meets nothing is transparent.
    is_transparent: bool,
    /// What is seen where nothing is met.
    nothing: Seen,
}

impl<E: Eye<Sample = Place, Seen = Seen>> Easel<'_, E> {
    fn grid(&self, picture: &mut Plane<Stored>, side: u32) -> RayCounts {
        let counts = picture.fill(
            |spot| self.silhouette.may_show(spot),
            |spots, made| self.means(spots, side, made),
        );
        counts + self.skipped(picture, side * side)
    }

    fn adaptive(&self, picture: &mut Plane<Stored>, side: u32, threshold: f32) -> RayCounts {
        let mut looks = Plane::new(picture.width, picture.height, self.nothing);
        let look = |spots: &[Spot], made: &mut Vec<Seen>| {
            self.eye
                .see(&spots.iter().map(|spot| place(*spot, [0.5; 2], 1)).collect::<Vec<_>>(), made)
        };
        let first = looks.fill(|spot| self.silhouette.may_show(spot), look);
        let differs = |spot: Spot| {
            let here = looks.at(spot);
            looks.round(spot).any(|there| there.footprint.differs(&here.footprint, threshold))
        };
        let more = picture.fill(differs, |spots, made| self.means(spots, side, made));
        picture.fill(
            |spot| !differs(spot),
            |spots, made| {
                made.extend(spots.iter().map(|spot| self.pixel(&looks.at(*spot)).stored()));
                RayCounts::default()
            },
        );
        first + more + self.skipped(picture, 1)
    }

    /// The rays that are known to meet nothing, so many a pixel.
    fn skipped(&self, picture: &Plane<Stored>, rays: u32) -> RayCounts {
        let empty = self.silhouette.empty([picture.width, picture.height]);
        RayCounts { primary: empty * u64::from(rays), ..RayCounts::default() }
    }

    /// The means over the middles of `side` × `side` parts of pixels.
    fn means(&self, spots: &[Spot], side: u32, made: &mut Vec<Stored>) -> RayCounts {
        let parts = (side * side) as usize;
        let middle = |index: u32| (index as f32 + 0.5) / side as f32;
        let within = |part: u32| [middle(part % side), middle(part / side)];
        let places: Vec<Place> = spots
            .iter()
            .flat_map(|spot| (0..side * side).map(move |part| place(*spot, within(part), side)))
            .collect();
        let mut seen = Vec::with_capacity(places.len());
        let counts = self.eye.see(&places, &mut seen);
        made.extend(seen.chunks_exact(parts).map(|seen| {
            let sum = seen.iter().fold(Pixel::default(), |sum, seen| sum + self.pixel(seen));
            (sum / parts as f32).stored()
        }));
        counts
    }

    fn pixel(&self, seen: &Seen) -> Pixel {
        if self.is_transparent && !seen.hits {
            return Pixel::default();
        }
        // What is too bright is as bright as can be, also beside what is not.
        Pixel { color: seen.color.min(Vec3::ONE), cover: 1.0 }
    }
}

/// The place at a share of a pixel's width and height from its upper left corner.
fn place([x, y]: Spot, [dx, dy]: [f32; 2], side: u32) -> Place {
    Place { x: x as f32 + dx, y: y as f32 + dy, side: side as f32 }
}
