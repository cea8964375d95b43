//! Rays, and what they meet.

use glam::DVec3;
use smallvec::SmallVec;

/// A half-line `origin + t · direction`.
///
/// The direction need not have length 1: a ray that is carried into another space keeps its
/// distances `t` that way.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    pub origin: DVec3,
    pub direction: DVec3,
}

impl Ray {
    /// The point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction * t
    }
}

/// The distances that count, both ends included; empty when `min > max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    pub min: f64,
    pub max: f64,
}

impl Interval {
    /// All that lies in front of a ray's origin.
    pub const AHEAD: Interval = Interval { min: 0.0, max: f64::INFINITY };

    /// Everything, behind the origin too.
    pub const WHOLE_LINE: Interval = Interval { min: f64::NEG_INFINITY, max: f64::INFINITY };

    /// Everything in front of the origin up to `max`.
    pub fn up_to(max: f64) -> Interval {
        Interval { min: 0.0, max }
    }

    /// Whether `t` lies inside.
    pub fn holds(&self, t: f64) -> bool {
        self.min <= t && t <= self.max
    }
}

/// A place where a ray passes through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in lengths of the ray's direction.
    pub t: f64,
    /// Outward normal of length 1.
    pub normal: DVec3,
    /// The normal to shade with: that of the smooth surface which a polygon stands for, or
    /// [`Hit::normal`] where there is none.
    pub shading: DVec3,
}

impl Hit {
    /// A hit of a surface that is what it looks like.
    pub fn new(t: f64, normal: DVec3) -> Hit {
        Hit { t, normal, shading: normal }
    }

    /// The same place, seen as a hole sees it: inside and outside exchanged.
    pub fn turned(self) -> Hit {
        Hit { t: self.t, normal: -self.normal, shading: -self.shading }
    }
}

/// A stretch of a ray inside a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    pub enter: Hit,
    pub exit: Hit,
}

/// Spans in ascending order; most solids give one or two.
pub type Spans = SmallVec<[Span; 4]>;
