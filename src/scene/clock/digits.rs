//! Digits of seven segments, as distances; a digit is 1 high and stands on y = 0.

use glam::DVec2;

/// How wide a digit is, from middle to middle of its upright segments, and how far it is from the
/// middle of one to that of the next.
const WIDTH: f64 = 0.46;
const STEP: f64 = 0.72;

/// The same for colons.
const COLON_STEP: f64 = 0.36;

/// Half of a segment's width, and what it lacks at its ends.
const HALF_PEN: f64 = 0.075;
const GAP: f64 = 0.02;

/// Which segments are lit, from the top clockwise and the middle one last: a to g.
const DIGITS: [[bool; 7]; 10] = {
    const I: bool = true;
    const O: bool = false;
    [
        [I, I, I, I, I, I, O],
        [O, I, I, O, O, O, O],
        [I, I, O, I, I, O, I],
        [I, I, I, I, O, O, I],
        [O, I, I, O, O, I, I],
        [I, O, I, I, O, I, I],
        [I, O, I, I, I, I, I],
        [I, I, I, O, O, O, O],
        [I, I, I, I, I, I, I],
        [I, I, I, I, O, I, I],
    ]
};

const HYPHEN: [bool; 7] = [false, false, false, false, false, false, true];

/// The ends of each segment's middle line.
const SEGMENTS: [[DVec2; 2]; 7] = {
    const LEFT: f64 = -WIDTH / 2.0;
    const RIGHT: f64 = WIDTH / 2.0;
    const LOW: f64 = HALF_PEN;
    const HIGH: f64 = 1.0 - HALF_PEN;
    [
        [DVec2::new(LEFT, HIGH), DVec2::new(RIGHT, HIGH)],
        [DVec2::new(RIGHT, 0.5), DVec2::new(RIGHT, HIGH)],
        [DVec2::new(RIGHT, LOW), DVec2::new(RIGHT, 0.5)],
        [DVec2::new(LEFT, LOW), DVec2::new(RIGHT, LOW)],
        [DVec2::new(LEFT, LOW), DVec2::new(LEFT, 0.5)],
        [DVec2::new(LEFT, 0.5), DVec2::new(LEFT, HIGH)],
        [DVec2::new(LEFT, 0.5), DVec2::new(RIGHT, 0.5)],
    ]
};

/// Where the dots of a colon are.
const DOTS: [f64; 2] = [0.28, 0.72];

/// How wide a text of digits, colons and hyphens is.
pub fn width(text: &str) -> f64 {
    text.chars().map(step).sum()
}

fn step(letter: char) -> f64 {
    if letter == ':' { COLON_STEP } else { STEP }
}

/// How far `point` lies outside what is lit of `text`, which begins at x = 0.
pub fn outside(text: &str, point: DVec2) -> f64 {
    let mut from = 0.0;
    let mut nearest = f64::INFINITY;
    for letter in text.chars() {
        let middle = from + step(letter) / 2.0;
        nearest = nearest.min(lit(letter, point - DVec2::new(middle, 0.0)));
        from += step(letter);
    }
    nearest
}

/// The same of one character, about the upright through its middle.
fn lit(letter: char, point: DVec2) -> f64 {
    if letter == ':' {
        let dot = |y| (point - DVec2::new(0.0, y)).abs().max_element() - HALF_PEN;
        return dot(DOTS[0]).min(dot(DOTS[1]));
    }
    let segments = match letter.to_digit(10) {
        Some(digit) => &DIGITS[digit as usize],
        None => &HYPHEN,
    };
    let lit = SEGMENTS.iter().zip(segments).filter(|(_, is_lit)| **is_lit);
    lit.map(|(ends, _)| segment(*ends, point)).fold(f64::INFINITY, f64::min)
}

/// A bar with bevelled ends, so that two meet at a corner with a hair between them.
fn segment([from, to]: [DVec2; 2], point: DVec2) -> f64 {
    let half = (to - from) / 2.0;
    let length = half.length();
    let from_middle = point - (from + half);
    let along = (from_middle.dot(half) / length).abs();
    let aside = (from_middle.perp_dot(half) / length).abs();
    (aside - HALF_PEN).max((aside + along - (length - GAP)) * std::f64::consts::FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is lit at the middles of the seven segments.
    fn lit_segments(digit: char) -> [bool; 7] {
        let aside = WIDTH / 2.0;
        let places = [
            [0.0, 1.0 - HALF_PEN],
            [aside, 0.72],
            [aside, 0.28],
            [0.0, HALF_PEN],
            [-aside, 0.28],
            [-aside, 0.72],
            [0.0, 0.5],
        ];
        let place = |[x, y]: [f64; 2]| DVec2::new(STEP / 2.0 + x, y);
        places.map(|at| outside(&digit.to_string(), place(at)) < 0.0)
    }

    /// As many segments as everybody counts, and no two digits alike.
    #[test]
    fn digits_have_their_segments() {
        let lit: Vec<[bool; 7]> = "0123456789-".chars().map(lit_segments).collect();
        let counts: Vec<usize> =
            lit.iter().map(|lit| lit.iter().filter(|lit| **lit).count()).collect();
        assert_eq!(counts, [6, 2, 5, 5, 4, 5, 6, 3, 7, 6, 1]);
        for (index, digit) in lit.iter().enumerate() {
            assert!(!lit[..index].contains(digit), "{index}");
        }
        // What tells 2 from 5, and 6 from 9.
        assert_eq!(lit[2].map(u8::from), [1, 1, 0, 1, 1, 0, 1]);
        assert_eq!(lit[6].map(u8::from), [1, 0, 1, 1, 1, 1, 1]);
    }

    #[test]
    fn what_is_lit_keeps_within_the_texts_width_and_height() {
        for text in ["8:88:88", "-:--", "17"] {
            let width = width(text);
            for step in 0..=200 {
                let share = f64::from(step) / 200.0;
                for point in [
                    DVec2::new(0.0, share),
                    DVec2::new(width, share),
                    DVec2::new(width * share, 0.0),
                    DVec2::new(width * share, 1.0),
                ] {
                    assert!(outside(text, point) > -1e-9, "{text} at {point}");
                }
            }
        }
    }

    #[test]
    fn characters_stand_side_by_side() {
        let middle = DVec2::new(STEP + COLON_STEP / 2.0, DOTS[1]);
        assert!(outside("1:23", middle) < 0.0 && outside("1123", middle) > 0.0);
    }
}
