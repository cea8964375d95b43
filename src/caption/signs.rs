//! Signs of annotators that no font at hand has, drawn out of bars: `∓`, `⩲`, `⩱`.

/// How wide a sign is with the white beside it, in ems; that of a plus.
pub const ADVANCE: f32 = 0.66;

/// An upright rectangle in ems: from the origin to the right, and up from the baseline.
pub struct Bar {
    pub left: f32,
    pub right: f32,
    pub bottom: f32,
    pub top: f32,
}

const SIGNS: [char; 3] = ['∓', '⩲', '⩱'];

pub fn is_sign(letter: char) -> bool {
    SIGNS.contains(&letter)
}

/// The bars of a sign, so thick; `None` for what is no sign.
pub fn bars(letter: char, stroke: f32) -> Option<Vec<Bar>> {
    let bars = match letter {
        '∓' => [level(0.545, stroke)].into_iter().chain(plus(0.03, 0.40, stroke)).collect(),
        '⩲' => equals(-0.04, stroke).into_iter().chain(plus(0.31, 0.73, stroke)).collect(),
        '⩱' => equals(0.445, stroke).into_iter().chain(plus(-0.04, 0.38, stroke)).collect(),
        _ => return None,
    };
    Some(bars)
}

/// A level bar below the height `top`, as wide as a sign is.
fn level(top: f32, stroke: f32) -> Bar {
    Bar { left: 0.10, right: ADVANCE - 0.10, bottom: top - stroke, top }
}

fn equals(bottom: f32, stroke: f32) -> [Bar; 2] {
    [level(bottom + stroke, stroke), level(bottom + 0.285, stroke)]
}

/// A plus between two heights.
fn plus(bottom: f32, top: f32, stroke: f32) -> [Bar; 2] {
    let half = stroke / 2.0;
    let upright = Bar { left: ADVANCE / 2.0 - half, right: ADVANCE / 2.0 + half, bottom, top };
    [level((bottom + top) / 2.0 + half, stroke), upright]
}
