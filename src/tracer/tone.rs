//! From linear light to what a picture stores.

use std::sync::LazyLock;

use crate::scene::Rgb;

/// From here on the curve bends.
const SHOULDER: f64 = 0.76;

/// How fast the brightest grow pale.
const PALING: f64 = 0.15;

/// What a coat adds to a colour by mirroring the room: 4 % of a room half as bright as white.
const VEIL: f64 = 0.02;

/// Light as a screen can show it: colours stay as they are up to the shoulder, what is brighter
/// tends to white (*Khronos PBR Neutral Tone Mapper*, 2024). It takes away the veil that coats have,
/// which is fainter here than in the all-white room that the original has in mind.
pub fn neutral(light: Rgb) -> Rgb {
    let least = light.min_element().max(0.0);
    let veil = if least < 2.0 * VEIL { least - least * least / (4.0 * VEIL) } else { VEIL };
    let color = light - veil;
    let peak = color.max_element();
    if peak < SHOULDER {
        return color;
    }
    let room = 1.0 - SHOULDER;
    let bent = 1.0 - room * room / (peak + room - SHOULDER);
    let pale = 1.0 - 1.0 / (PALING * (peak - bent) + 1.0);
    (color * (bent / peak)).lerp(Rgb::splat(bent), pale)
}

/// Steps of the curve's table, in roots of light: so fine that it errs by less than 1e-6.
const STEPS: usize = 4096;

/// Linear light as sRGB stores it, each channel 0 to 1 (IEC 61966-2-1).
pub fn stored(light: Rgb) -> Rgb {
    static CURVE: LazyLock<Vec<f64>> = LazyLock::new(|| {
        let roots = (0..=STEPS).map(|step| step as f64 / STEPS as f64);
        roots.map(|root| curve(root * root)).collect()
    });
    let curve = &*CURVE;
    let stored = |channel: f64| {
        let place = channel.clamp(0.0, 1.0).sqrt() * STEPS as f64;
        let step = (place as usize).min(STEPS - 1);
        curve[step] + (curve[step + 1] - curve[step]) * (place - step as f64)
    };
    Rgb::from_array(light.to_array().map(stored))
}

fn curve(channel: f64) -> f64 {
    if channel <= 0.003_130_8 {
        12.92 * channel
    } else {
        1.055 * libm::pow(channel, 1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::linear_light;

    #[test]
    fn storing_is_the_inverse_of_reading() {
        for step in 0..=255 {
            let color = Rgb::splat(f64::from(step) / 255.0);
            assert!(stored(linear_light(color)).distance(color) < 1e-6, "{step}");
        }
    }

    #[test]
    fn the_table_is_the_curve() {
        for step in 0..=200_000 {
            let light = f64::from(step) / 200_000.0;
            assert!((stored(Rgb::splat(light)).x - curve(light)).abs() < 1e-6, "{light}");
        }
    }

    #[test]
    fn the_curve_rises_keeps_base_colors_and_never_burns_out() {
        let mut last = -1.0;
        for step in 0..2000 {
            let light = f64::from(step) * 0.01;
            let shown = neutral(Rgb::new(light, light * 0.8, light * 0.5));
            assert!(shown.x >= last && shown.max_element() < 1.0, "{light}");
            last = shown.x;
        }
        let base = neutral(Rgb::new(0.6, 0.45, 0.2));
        assert!(base.distance(Rgb::new(0.58, 0.43, 0.18)) < 1e-12);
    }
}
