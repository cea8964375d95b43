//! Profiles: control polygons that are smoothed by subdivision.

use glam::DVec2;

/// A point of a control polygon, in (u, v): distance from the axis, and height along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    pub at: DVec2,
    /// Whether the point stays where it is, so that the curve has a corner there.
    pub corner: bool,
}

/// An open control polygon from axis to axis, the outline of a turned body.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile(Vec<ControlPoint>);

/// Why a list of control points is no profile.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProfileError {
    #[error("a profile needs at least 3 points, found {0}")]
    TooShort(usize),
    #[error("point {point} of the profile has the radius {radius}, expected a number from 0 up")]
    BadRadius { point: usize, radius: f64 },
    #[error("point {point} of the profile has the height {height}, expected a finite number")]
    BadHeight { point: usize, height: f64 },
    #[error("a profile begins and ends on its axis (radius 0), found {first} and {last}")]
    OffAxis { first: f64, last: f64 },
    #[error("all points of the profile lie on its axis, expected a radius above 0")]
    NoBody,
}

impl Profile {
    /// Takes control points from the bottom of the axis, round the outside, to its top.
    ///
    /// # Errors
    /// Too few points, a radius below zero, a number that is not finite, an end off the axis, or all
    /// points on it.
    pub fn new(points: Vec<ControlPoint>) -> Result<Profile, ProfileError> {
        let [first, .., last] = points.as_slice() else {
            return Err(ProfileError::TooShort(points.len()));
        };
        if points.len() < 3 {
            return Err(ProfileError::TooShort(points.len()));
        }
        for (index, point) in points.iter().enumerate() {
            let (radius, height) = (point.at.x, point.at.y);
            if !(radius >= 0.0 && radius.is_finite()) {
                return Err(ProfileError::BadRadius { point: index + 1, radius });
            }
            if !height.is_finite() {
                return Err(ProfileError::BadHeight { point: index + 1, height });
            }
        }
        if first.at.x != 0.0 || last.at.x != 0.0 {
            return Err(ProfileError::OffAxis { first: first.at.x, last: last.at.x });
        }
        if points.iter().all(|point| point.at.x == 0.0) {
            return Err(ProfileError::NoBody);
        }
        Ok(Profile(points))
    }

    /// The curve after `steps` subdivisions, as a polygon without repeated points.
    ///
    /// One step halves every edge and moves each old vertex to `(P₋ + 6·P + P₊) / 8`, the uniform
    /// cubic B-spline's rule; corners and the two ends stay, new midpoints may move in the next
    /// step (Turek 2008, 3.7.4 and figure 3.3).
    pub fn subdivided(&self, steps: u32) -> Vec<DVec2> {
        let mut points = self.0.clone();
        for _ in 0..steps {
            points = subdivide(&points);
        }
        let mut polygon: Vec<DVec2> = points.into_iter().map(|point| point.at).collect();
        polygon.dedup();
        polygon
    }
}

fn subdivide(points: &[ControlPoint]) -> Vec<ControlPoint> {
    let mut finer = Vec::with_capacity(2 * points.len());
    for (index, &point) in points.iter().enumerate() {
        let neighbours = index.checked_sub(1).map(|i| points[i]).zip(points.get(index + 1));
        let at = match neighbours {
            Some((before, after)) if !point.corner => (before.at + 6.0 * point.at + after.at) / 8.0,
            _ => point.at,
        };
        finer.push(ControlPoint { at, ..point });
        if let Some(after) = points.get(index + 1) {
            finer.push(ControlPoint { at: (point.at + after.at) / 2.0, corner: false });
        }
    }
    finer
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64, bool)]) -> Vec<ControlPoint> {
        list.iter().map(|&(u, v, corner)| ControlPoint { at: DVec2::new(u, v), corner }).collect()
    }

    #[test]
    fn one_step_halves_edges_and_moves_the_free_vertices() {
        let profile = Profile::new(points(&[
            (0.0, 0.0, false),
            (8.0, 0.0, false),
            (8.0, 8.0, true),
            (0.0, 8.0, false),
        ]))
        .unwrap();
        let expected =
            [(0.0, 0.0), (4.0, 0.0), (7.0, 1.0), (8.0, 4.0), (8.0, 8.0), (4.0, 8.0), (0.0, 8.0)]
                .map(DVec2::from);
        assert_eq!(profile.subdivided(1), expected);
    }

    #[test]
    fn no_step_gives_the_control_polygon_without_repeats() {
        let profile = Profile::new(points(&[
            (0.0, 0.0, true),
            (1.0, 0.0, true),
            (1.0, 0.0, true),
            (0.0, 2.0, true),
        ]))
        .unwrap();
        assert_eq!(profile.subdivided(0).len(), 3);
    }

    #[test]
    fn what_is_no_profile_is_refused_with_its_place() {
        let cases = [
            (vec![], "at least 3 points, found 0"),
            (
                points(&[(0.0, 0.0, true), (-1.0, 1.0, true), (0.0, 2.0, true)]),
                "point 2 of the profile has the radius -1",
            ),
            (
                points(&[(0.0, 0.0, true), (1.0, f64::NAN, true), (0.0, 2.0, true)]),
                "point 2 of the profile has the height NaN",
            ),
            (points(&[(0.0, 0.0, true), (1.0, 1.0, true), (0.5, 2.0, true)]), "found 0 and 0.5"),
            (
                points(&[(0.0, 0.0, true), (0.0, 1.0, true), (0.0, 2.0, true)]),
                "all points of the profile lie on its axis",
            ),
        ];
        for (list, message) in cases {
            let error = Profile::new(list).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
