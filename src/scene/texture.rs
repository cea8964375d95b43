//! Colours over a surface; one entry a kind.

use glam::{DVec2, DVec3};

use super::Rgb;
use super::noise::perlin;

/// The colour at each point of a body, in the body's own space.
#[derive(Clone, Debug)]
pub enum Texture {
    /// One colour everywhere.
    Plain(Rgb),
    /// Squares in the plane of x and z, by planar mapping: `origin` is a corner, `side` the width.
    Chequer {
        origin: DVec2,
        side: f64,
        /// Colours where the sum of column and row is even, and where it is odd.
        colors: [Rgb; 2],
    },
    /// Rings of wood, with the grain along z.
    Wood {
        /// The two colours that a ring runs between.
        colors: [Rgb; 2],
        /// World units that one unit of noise is stretched over.
        size: f64,
    },
}

impl Texture {
    /// The colour at `point`.
    pub fn color(&self, point: DVec3) -> Rgb {
        match self {
            Texture::Plain(color) => *color,
            Texture::Chequer { origin, side, colors } => {
                let cell = ((DVec2::new(point.x, point.z) - origin) / side).floor();
                colors[usize::from((cell.x + cell.y).rem_euclid(2.0) >= 1.0)]
            }
            Texture::Wood { colors, size } => colors[0].lerp(colors[1], wood(point / size)),
        }
    }
}

/// Where in its ring a point of a log lies, 0 to 1: twenty rings a unit of noise, which changes
/// twenty times more slowly along the grain (Turek 2008, 3.8.2). The thesis casts to an integer
/// and so jumps where the noise is negative; the floor does not.
fn wood(point: DVec3) -> f64 {
    let bumps = perlin(DVec3::new(point.x, point.y, point.z * 0.05)) * 20.0;
    bumps - bumps.floor()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chequer_has_a_dark_a1_and_a_light_h1() {
        let board = Texture::Chequer {
            origin: DVec2::splat(-2.0),
            side: 4.0,
            colors: [DVec3::ZERO, DVec3::ONE],
        };
        let square = |file: f64, rank: f64| board.color(DVec3::new(4.0 * file, 0.0, 4.0 * rank));
        assert_eq!(square(0.0, 0.0), DVec3::ZERO);
        assert_eq!(square(7.0, 0.0), DVec3::ONE);
        assert_eq!(square(0.0, 7.0), DVec3::ONE);
        assert_eq!(square(7.0, 7.0), DVec3::ZERO);
    }
}
