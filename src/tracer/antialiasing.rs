//! Where in a pixel rays go through.

/// How many rays a pixel gets, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Antialiasing {
    /// One, through the middle (the thesis's mode 0).
    None,
    /// N × N, through the middles of as many equal parts (the thesis's mode 1); N from 1 up.
    Grid(u32),
    /// At most N × N, where they are needed. In Phong's pictures one, and then all of them where it
    /// saw something else than one of the eight pixels round it did (the thesis's mode 2); in the
    /// studio so many that the error of their mean is small enough.
    Adaptive {
        rays: u32,
        /// 0 to 1. How far apart two pixels may be in the colour of what they saw and in the light
        /// on it, in its normal eight times as far; or the error, of white.
        threshold: f32,
    },
}
