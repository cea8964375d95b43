//! Moves under way: who goes where, and that nothing passes through anything.

use std::path::Path;

use lightsquare::assets::{Assets, SetName};
use lightsquare::config::Config;
use lightsquare::game::{Game, Source};
use lightsquare::notation::{Color, Role, Square};
use lightsquare::scene::bodies;
use lightsquare::timeline::{Bodies, Camerawork, Film, Frame, Mover, Script, Spot, Timeline};

fn staunton() -> Bodies {
    let config = Config::default();
    bodies(&Assets::load(&config, &SetName::Staunton).unwrap().set)
}

fn script(bodies: &Bodies) -> Script {
    Script {
        film: Film::default(),
        animate: true,
        camerawork: Camerawork::default(),
        bodies: bodies.clone(),
        keeps_captured: true,
    }
}

/// All pieces of a frame that stand or move, each where it is.
fn pieces(frame: &Frame) -> Vec<Mover> {
    let standing = frame.placement.iter().map(|(square, piece)| Mover {
        piece,
        identity: frame.identities.get(square),
        spot: Spot::on(square),
        size: 1.0,
    });
    frame.movers.iter().copied().chain(standing).chain(frame.taken.iter().copied()).collect()
}

/// Two pieces of a frame that overlap, or one that goes through the board.
fn collision(frame: &Frame, bodies: &Bodies) -> Option<String> {
    let pieces = pieces(frame);
    let envelope = |mover: &Mover| bodies.of(mover.piece.role);
    for (index, mover) in pieces[..frame.movers.len()].iter().enumerate() {
        for other in &pieces[index + 1..] {
            let is_exchange = mover.identity == other.identity && other.size < 1.0;
            let gap = envelope(mover).gap(mover.spot, envelope(other), other.spot);
            if gap <= 0.0 && !is_exchange {
                return Some(format!("{mover:?} and {other:?}: {gap}"));
            }
        }
        let over_board = mover.spot.from_middle() < bodies.edge + envelope(mover).radius();
        if over_board && mover.spot.height < 0.0 {
            return Some(format!("{mover:?} and the board"));
        }
    }
    None
}

fn games(path: &Path) -> Vec<Game> {
    Source::open(path).unwrap().games().map(Result::unwrap).collect()
}

#[test]
fn nothing_passes_through_anything_in_any_sample_game() {
    let bodies = staunton();
    let script = script(&bodies);
    let mut seen = 0;
    for entry in std::fs::read_dir("games").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "pgn") {
            continue;
        }
        for game in games(&path) {
            let timeline = Timeline::new(&game, 0, game.plies.len(), &script).unwrap();
            for index in 0..timeline.frames() {
                let frame = timeline.frame(index);
                seen += usize::from(!frame.movers.is_empty());
                let met = collision(&frame, &bodies);
                assert_eq!(met, None, "{}, frame {index}, after ply {}", path.display(), frame.ply);
            }
        }
    }
    assert!(seen > 10_000, "{seen}");
}
