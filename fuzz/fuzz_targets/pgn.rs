//! Any bytes as PGN: every game is read, and each of its positions follows from the one before.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lightsquare::game::{Game, Scanner};

fuzz_target!(|bytes: &[u8]| {
    for (number, scanned) in (1..).zip(Scanner::new(bytes)) {
        let Ok(scanned) = scanned else { continue };
        let game = Game::read(scanned, number);
        let problems = game.problems.iter().map(ToString::to_string);
        for said in problems.chain(game.unread_tags.iter().cloned()) {
            assert!(!said.contains(char::is_control), "{said}");
        }
        if game.start_is_known {
            for ply in 0..=game.plies.len() {
                game.fen(ply);
                game.placement(ply);
            }
        }
        for branch in game.branches() {
            assert!(game.with_variation(&branch.path).is_some());
        }
    }
});
