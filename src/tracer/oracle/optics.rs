//! Where light goes at a surface, and how much of it.

use glam::DVec3;

use crate::geometry::Hit;

/// The normals of the surface itself and of what it is shaded as, on the side of a ray that comes
/// along `direction`.
pub fn facing(hit: Hit, direction: DVec3) -> (DVec3, DVec3) {
    let hit = if direction.dot(hit.normal) > 0.0 { hit.turned() } else { hit };
    // A smooth normal may face away where the polygon just does not.
    let shading = if direction.dot(hit.shading) < 0.0 { hit.shading } else { hit.normal };
    (hit.normal, shading)
}

/// Where a mirror across `normal` sends a ray (Turek 2008, 2.3.2), but never below the surface itself.
pub fn mirrored(direction: DVec3, normal: DVec3, outward: DVec3) -> DVec3 {
    let mirrored = direction - normal * (2.0 * direction.dot(normal));
    if mirrored.dot(outward) > 0.0 {
        mirrored
    } else {
        direction - outward * (2.0 * direction.dot(outward))
    }
}

/// Snell's law: where a ray goes behind a surface with `normal` on its own side. `ratio` is the
/// refractive index here over the one behind. `None` in total internal reflection.
pub fn refracted(direction: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let cos = -direction.dot(normal);
    let cos2_behind = 1.0 - ratio * ratio * (1.0 - cos * cos);
    (cos2_behind >= 0.0)
        .then(|| (direction * ratio + normal * (ratio * cos - cos2_behind.sqrt())).normalize())
}

/// The share of light that a smooth surface throws back: Schlick's approximation of Fresnel's law
/// (C. Schlick, 1994). `cosine` is that of the angle to the normal, `index` the refractive index
/// behind the surface over the one before it.
pub fn fresnel(cosine: f64, index: f64) -> f64 {
    let straight = (index - 1.0) / (index + 1.0);
    let straight = straight * straight;
    straight + (1.0 - straight) * grazing(cosine)
}

/// How near a ray is to grazing a surface, 0 to 1, as Schlick weighs it.
pub fn grazing(cosine: f64) -> f64 {
    let rest = (1.0 - cosine).clamp(0.0, 1.0);
    let squared = rest * rest;
    squared * squared * rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_bends_by_snells_law() {
        for degrees in [0.0_f64, 10.0, 35.0, 60.0, 85.0] {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let direction = DVec3::new(sin, -cos, 0.0);
            let behind = refracted(direction, DVec3::Y, 1.0 / 1.5).unwrap();
            assert!((behind.x * 1.5 - sin).abs() < 1e-12, "{degrees}");
            let back = refracted(behind, DVec3::Y, 1.5).unwrap();
            assert!(back.distance(direction) < 1e-12, "{degrees}");
        }
    }

    /// Fresnel's own formulas for light without polarisation.
    #[test]
    fn schlick_is_near_fresnel() {
        for degrees in [0.0_f64, 30.0, 50.0, 70.0, 85.0] {
            let (sin, cos) = libm::sincos(degrees.to_radians());
            let behind = (1.0 - (sin / 1.5) * (sin / 1.5)).sqrt();
            let across = (cos - 1.5 * behind) / (cos + 1.5 * behind);
            let along = (1.5 * cos - behind) / (1.5 * cos + behind);
            let exact = (across * across + along * along) / 2.0;
            let found = fresnel(cos, 1.5);
            assert!((found - exact).abs() < 0.05, "{degrees}: {found} is not {exact}");
        }
    }

    #[test]
    fn beyond_the_critical_angle_nothing_gets_out() {
        let critical = libm::asin(1.0 / 1.5);
        let towards = |angle: f64| DVec3::new(libm::sin(angle), -libm::cos(angle), 0.0);
        assert!(refracted(towards(critical - 1e-6), DVec3::Y, 1.5).is_some());
        assert!(refracted(towards(critical + 1e-6), DVec3::Y, 1.5).is_none());
    }
}
