//! Any two lines as the pieces of White and Black: what is accepted comes back the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lightsquare::notation::{Color, Placement};

fuzz_target!(|text: &str| {
    let (white, black) = text.split_once('\n').unwrap_or((text, ""));
    if let Ok(placement) = Placement::parse(white, black) {
        let [white, black] = [Color::White, Color::Black].map(|color| placement.notation(color));
        assert_eq!(Placement::parse(&white, &black).ok(), Some(placement));
    }
});
