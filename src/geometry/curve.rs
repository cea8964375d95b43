//! Control polygons that are smoothed by subdivision: open profiles and closed outlines.

use glam::DVec2;

use super::polygon::{Normals, Segment, Vertex, crossing, segments};

/// A point of a control polygon: in a profile (u, v), distance from the axis and height along it;
/// in an outline (x, y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    pub at: DVec2,
    /// Whether the point stays where it is, so that the curve has a corner there.
    pub corner: bool,
}

/// An open control polygon from axis to axis, the outline of a turned body.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile(Vec<ControlPoint>);

/// A closed control polygon, the outline of a prism; the last point is followed by the first one.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline(Vec<ControlPoint>);

/// Why control points make no curve that bounds a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CurveError {
    #[error("a curve needs at least 3 points, found {0}")]
    TooShort(usize),
    #[error("point {point} of the profile has the radius {radius}, expected a number from 0 up")]
    BadRadius { point: usize, radius: f64 },
    #[error("point {point} of the profile has the height {height}, expected a finite number")]
    BadHeight { point: usize, height: f64 },
    #[error("point {point} of the outline is ({x}, {y}), expected two finite numbers")]
    BadPoint { point: usize, x: f64, y: f64 },
    #[error("a profile begins and ends on its axis (radius 0), found {first} and {last}")]
    OffAxis { first: f64, last: f64 },
    #[error("the curve has no body: it bounds an area of 0")]
    NoBody,
    #[error(
        "the curve crosses or touches itself near ({:.4}, {:.4}), expected one that does not",
        .0.x, .0.y
    )]
    CrossesItself(DVec2),
}

impl Profile {
    /// Takes control points along the outside, from one end on the axis to the other.
    ///
    /// # Errors
    /// Too few points, a radius below zero, a number that is not finite, an end off the axis.
    pub fn new(points: Vec<ControlPoint>) -> Result<Profile, CurveError> {
        let (first, last) = ends(&points)?;
        for (index, point) in points.iter().enumerate() {
            let (radius, height) = (point.at.x, point.at.y);
            if !(radius >= 0.0 && radius.is_finite()) {
                return Err(CurveError::BadRadius { point: index + 1, radius });
            }
            if !height.is_finite() {
                return Err(CurveError::BadHeight { point: index + 1, height });
            }
        }
        if first.at.x != 0.0 || last.at.x != 0.0 {
            return Err(CurveError::OffAxis { first: first.at.x, last: last.at.x });
        }
        Ok(Profile(points))
    }

    /// The curve after `steps` subdivisions, from the bottom to the top.
    ///
    /// # Errors
    /// When the curve bounds nothing, or meets itself.
    pub fn segments(&self, steps: u32, normals: Normals) -> Result<Vec<Segment>, CurveError> {
        checked(subdivided(&self.0, steps, false), normals, false)
    }
}

impl Outline {
    /// Takes control points in either sense of rotation.
    ///
    /// # Errors
    /// Too few points, or a number that is not finite.
    pub fn new(points: Vec<ControlPoint>) -> Result<Outline, CurveError> {
        ends(&points)?;
        for (index, point) in points.iter().enumerate() {
            let DVec2 { x, y } = point.at;
            if !point.at.is_finite() {
                return Err(CurveError::BadPoint { point: index + 1, x, y });
            }
        }
        Ok(Outline(points))
    }

    /// The curve after `steps` subdivisions, anticlockwise (from x towards y).
    ///
    /// # Errors
    /// When the curve bounds nothing, or meets itself.
    pub fn segments(&self, steps: u32, normals: Normals) -> Result<Vec<Segment>, CurveError> {
        checked(subdivided(&self.0, steps, true), normals, true)
    }
}

fn ends(points: &[ControlPoint]) -> Result<(ControlPoint, ControlPoint), CurveError> {
    match *points {
        [first, _, .., last] if points.len() >= 3 => Ok((first, last)),
        _ => Err(CurveError::TooShort(points.len())),
    }
}

/// The control points after `steps` subdivisions, without repeats.
///
/// One step halves every edge and moves each old vertex to `(P₋ + 6·P + P₊) / 8`, the uniform
/// cubic B-spline's rule; corners and the ends of an open curve stay, new midpoints may move in the
/// next step (Turek 2008, 3.7.4 and figure 3.3).
fn subdivided(points: &[ControlPoint], steps: u32, is_closed: bool) -> Vec<ControlPoint> {
    let mut points = points.to_vec();
    for _ in 0..steps {
        points = subdivide(&points, is_closed);
    }
    let repeats = |a: &mut ControlPoint, b: &mut ControlPoint| {
        b.corner |= a.corner && a.at == b.at;
        a.at == b.at
    };
    points.dedup_by(repeats);
    while is_closed && points.len() > 1 && points[0].at == points[points.len() - 1].at {
        let corner = points.pop().is_some_and(|point| point.corner);
        points[0].corner |= corner;
    }
    points
}

fn subdivide(points: &[ControlPoint], is_closed: bool) -> Vec<ControlPoint> {
    let mut finer = Vec::with_capacity(2 * points.len());
    for (index, &point) in points.iter().enumerate() {
        let [before, after] = neighbours(points, index, is_closed);
        let at = match before.zip(after) {
            Some((before, after)) if !point.corner => (before.at + 6.0 * point.at + after.at) / 8.0,
            _ => point.at,
        };
        finer.push(ControlPoint { at, ..point });
        if let Some(after) = after {
            finer.push(ControlPoint { at: (point.at + after.at) / 2.0, corner: false });
        }
    }
    finer
}

/// The points before and behind the one at `index`, where there are any.
fn neighbours(points: &[ControlPoint], index: usize, is_closed: bool) -> [Option<ControlPoint>; 2] {
    let last = points.len() - 1;
    let round = |end: usize| is_closed.then_some(points[end]);
    let before = if index > 0 { Some(points[index - 1]) } else { round(last) };
    let after = if index < last { Some(points[index + 1]) } else { round(0) };
    [before, after]
}

/// The curve through `points` as segments with the outside to their right.
fn checked(
    mut points: Vec<ControlPoint>,
    normals: Normals,
    is_closed: bool,
) -> Result<Vec<Segment>, CurveError> {
    if signed_area(&points) < 0.0 {
        points.reverse();
    }
    let mut vertices: Vec<Vertex> =
        (0..points.len()).map(|index| vertex(&points, index, is_closed)).collect();
    if is_closed {
        vertices.extend(vertices.first().copied());
    }
    let segments = segments(&vertices, normals);
    // A stretch of a profile along its axis bounds nothing.
    let segments: Vec<Segment> = segments
        .into_iter()
        .filter(|segment| is_closed || segment.from.x > 0.0 || segment.to.x > 0.0)
        .collect();
    if let Some(place) = crossing(&segments) {
        return Err(CurveError::CrossesItself(place));
    }
    if signed_area(&points) == 0.0 {
        return Err(CurveError::NoBody);
    }
    Ok(segments)
}

/// A vertex with the directions of the limit curve there. At a point that may move it runs as the
/// chord of its neighbours does (the left eigenvector of the subdivision rule for ½); a point that
/// stays is the end of two curves, which leave it towards their next points.
fn vertex(points: &[ControlPoint], index: usize, is_closed: bool) -> Vertex {
    let here = points[index];
    let [before, after] = neighbours(points, index, is_closed)
        .map(|neighbour| neighbour.map_or(here.at, |point| point.at));
    let direction = |from: DVec2, to: DVec2| (to - from).normalize_or_zero();
    let (arrives, leaves) = (direction(before, here.at), direction(here.at, after));
    let chord = direction(before, after);
    // Where the curve doubles back there is no chord, and at an open end only one side.
    let is_end = before == here.at || after == here.at;
    if here.corner || is_end || chord == DVec2::ZERO {
        Vertex { at: here.at, arrives, leaves }
    } else {
        Vertex { at: here.at, arrives: chord, leaves: chord }
    }
}

/// The area that the closed polygon bounds, positive when it runs anticlockwise. (The stretch of
/// axis that closes a profile adds nothing.)
fn signed_area(points: &[ControlPoint]) -> f64 {
    let origin = points[0].at;
    let parts = points.windows(2).map(|p| (p[0].at - origin).perp_dot(p[1].at - origin));
    parts.sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64, bool)]) -> Vec<ControlPoint> {
        list.iter().map(|&(u, v, corner)| ControlPoint { at: DVec2::new(u, v), corner }).collect()
    }

    fn places(points: &[ControlPoint]) -> Vec<(f64, f64)> {
        points.iter().map(|point| point.at.into()).collect()
    }

    #[test]
    fn one_step_halves_edges_and_moves_the_free_vertices() {
        let control =
            points(&[(0.0, 0.0, false), (8.0, 0.0, false), (8.0, 8.0, true), (0.0, 8.0, false)]);
        let open =
            [(0.0, 0.0), (4.0, 0.0), (7.0, 1.0), (8.0, 4.0), (8.0, 8.0), (4.0, 8.0), (0.0, 8.0)];
        assert_eq!(places(&subdivided(&control, 1, false)), open);
        let closed = [
            (1.0, 1.0),
            (4.0, 0.0),
            (7.0, 1.0),
            (8.0, 4.0),
            (8.0, 8.0),
            (4.0, 8.0),
            (1.0, 7.0),
            (0.0, 4.0),
        ];
        assert_eq!(places(&subdivided(&control, 1, true)), closed);
    }

    #[test]
    fn no_step_gives_the_control_polygon_without_repeats() {
        let control =
            points(&[(0.0, 0.0, true), (1.0, 0.0, true), (1.0, 0.0, true), (0.0, 2.0, true)]);
        assert_eq!(subdivided(&control, 0, false).len(), 3);
    }

    /// The outline of a square whose corners may move tends to a rounded curve; from its middle all
    /// limit normals point away, and finer polygons come ever nearer to them.
    #[test]
    fn smooth_normals_are_those_that_finer_polygons_tend_to() {
        let control =
            points(&[(0.0, 0.0, false), (8.0, 0.0, false), (8.0, 8.0, true), (0.0, 8.0, false)]);
        let outline = Outline::new(control).unwrap();
        let coarse = outline.segments(2, Normals::Smooth).unwrap();
        let fine = outline.segments(9, Normals::Flat).unwrap();
        for segment in &coarse {
            // Seven steps later the segment is 128 of them, its first vertex moved a little.
            let index = coarse.iter().position(|s| s.from == segment.from).unwrap() * 128;
            for (found, smooth) in [
                (fine[index].normal, segment.smooth[0]),
                (fine[index + 127].normal, segment.smooth[1]),
            ] {
                assert!(found.angle_to(smooth).abs() < 0.01, "{found} is not {smooth}");
            }
        }
    }

    #[test]
    fn either_sense_gives_the_same_body() {
        let control = points(&[(0.0, 0.0, true), (2.0, 1.0, false), (0.0, 2.0, true)]);
        let reversed = control.iter().rev().copied().collect();
        let ends = |points| {
            let segments = Profile::new(points).unwrap().segments(3, Normals::Flat).unwrap();
            segments.iter().map(|segment| (segment.from, segment.to)).collect::<Vec<_>>()
        };
        assert_eq!(ends(control), ends(reversed));
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
            (points(&[(0.0, 0.0, true), (0.0, 1.0, true), (0.0, 2.0, true)]), "no body"),
            (
                points(&[
                    (0.0, 0.0, true),
                    (2.0, 2.0, true),
                    (2.0, 0.0, true),
                    (1.0, 3.0, true),
                    (0.0, 3.0, true),
                ]),
                "crosses or touches itself near (2.0000, 2.0000)",
            ),
        ];
        for (list, message) in cases {
            let made = Profile::new(list).and_then(|profile| profile.segments(0, Normals::Flat));
            let error = made.unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }

    #[test]
    fn what_is_no_outline_is_refused_with_its_place() {
        let bow = [(0.0, 0.0, true), (2.0, 2.0, true), (2.0, 0.0, true), (0.0, 2.0, true)];
        let touching = [
            (0.0, 0.0, true),
            (4.0, 0.0, true),
            (4.0, 4.0, true),
            (2.0, 0.0, true),
            (0.0, 4.0, true),
        ];
        let spike = [(0.0, 0.0, true), (4.0, 0.0, true), (2.0, 0.0, true), (2.0, 2.0, true)];
        let cases = [
            (points(&[(0.0, 0.0, true), (1.0, 0.0, true)]), "at least 3 points, found 2"),
            (
                points(&[(0.0, 0.0, true), (1.0, f64::INFINITY, true), (0.0, 1.0, true)]),
                "point 2 of the outline is (1, inf)",
            ),
            (points(&[(0.0, 0.0, true), (1.0, 1.0, true), (2.0, 2.0, true)]), "touches itself"),
            (points(&bow), "crosses or touches itself"),
            (points(&touching), "crosses or touches itself"),
            (points(&spike), "crosses or touches itself"),
        ];
        for (list, message) in cases {
            let made = Outline::new(list).and_then(|outline| outline.segments(0, Normals::Flat));
            let error = made.unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
