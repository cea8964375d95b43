//! Any text as a FEN: the board of one that is accepted comes back the same.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lightsquare::game::fen_position;
use lightsquare::notation::Placement;

fuzz_target!(|text: &str| {
    fen_position(text);
    if let Ok(placement) = Placement::from_fen(text) {
        assert_eq!(Placement::from_fen(&placement.board_fen()).ok(), Some(placement));
    }
});
