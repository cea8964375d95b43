//! Qualities: how many rays a picture is worth, in words.

use super::{Render, Sampling, Shading};

/// How good a picture is to be, and how long it may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// To see what will be in the picture.
    Draft,
    /// For films and screens.
    Normal,
    /// For pictures that are looked at for long.
    High,
    /// For paper.
    Print,
}

impl Quality {
    /// Sets where rays go, how many, and how far pixels may err.
    pub fn apply(self, render: &mut Render) {
        let (sampling, rays) = match (render.shading, self) {
            (Shading::Phong, Quality::Draft) => (Sampling::None, 1),
            (Shading::Phong, Quality::Normal) => (Sampling::Grid, 2),
            (Shading::Phong, Quality::High) => (Sampling::Adaptive, 3),
            (Shading::Phong, Quality::Print) => (Sampling::Adaptive, 5),
            (Shading::Studio, Quality::Draft) => (Sampling::Grid, 2),
            (Shading::Studio, Quality::Normal) => (Sampling::Adaptive, 8),
            (Shading::Studio, Quality::High) => (Sampling::Adaptive, 16),
            (Shading::Studio, Quality::Print) => (Sampling::Adaptive, 24),
        };
        (render.sampling, render.rays) = (sampling, rays);
        if render.shading == Shading::Studio {
            render.threshold = match self {
                Quality::Draft | Quality::Normal => 0.02,
                Quality::High => 0.01,
                Quality::Print => 0.006,
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Config, Look};

    #[test]
    fn each_quality_has_more_rays_than_the_one_before() {
        for look in [Look::Studio, Look::Thesis] {
            let rays = [Quality::Draft, Quality::Normal, Quality::High, Quality::Print].map(|q| {
                let mut render = Config::new(look).render;
                q.apply(&mut render);
                render.rays
            });
            assert!(rays.is_sorted_by(|a, b| a < b), "{look:?}: {rays:?}");
            // What pictures have that ask for no quality.
            let mut normal = Config::new(look).render;
            Quality::Normal.apply(&mut normal);
            assert_eq!(normal, Config::new(look).render);
        }
    }
}
