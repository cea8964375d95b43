//! The promise of the camera from White's side: no piece is less than half visible.

use std::path::Path;

use lightsquare::assets::{Assets, SetName};
use lightsquare::config::{Config, View};
use lightsquare::game::Source;
use lightsquare::geometry::{Interval, Solid};
use lightsquare::notation::{Board, Piece, Placement, Square};
use lightsquare::scene::{Reach, Stage};
use lightsquare::timeline::Frame;
use rayon::prelude::*;

/// 3:2; the smallest pieces still cover about a hundred pixels.
const SIZE: [u32; 2] = [240, 160];

/// What must be seen of every piece.
const PROMISED: f64 = 0.5;

/// Half-moves after which games are looked at.
const PLIES: [usize; 4] = [16, 24, 32, 40];

struct Seen {
    position: String,
    square: Square,
    piece: Piece,
    /// The part of its own pixels where nothing stands before it.
    share: f64,
}

fn stage(view: View) -> Stage {
    let mut config = Config::default();
    [config.width, config.height] = SIZE;
    config.camera.view = view;
    let assets = Assets::load(&config, &SetName::default()).unwrap();
    Stage::new(&config, &assets, Reach::default()).unwrap()
}

/// The piece of `placement` that is seen least of.
fn least_seen(stage: &Stage, position: &str, placement: Placement) -> Seen {
    let scene = stage.scene(&Frame::still(placement));
    // The board comes first, the pieces after it in their order.
    let board = scene.objects.len() - placement.iter().count();
    let bodies: Vec<_> = scene.objects[board..].iter().map(|object| &object.body).collect();
    let (mut alone, mut nearest) = (vec![0_u32; bodies.len()], vec![0_u32; bodies.len()]);
    for pixel in 0..SIZE[0] * SIZE[1] {
        let place = [pixel % SIZE[0], pixel / SIZE[0]].map(|at| f64::from(at) + 0.5);
        let ray = scene.camera.ray(place[0], place[1], SIZE[0], SIZE[1]);
        let mut first = None;
        for (index, body) in bodies.iter().enumerate() {
            if let Some(hit) = body.nearest(&ray, Interval::AHEAD) {
                alone[index] += 1;
                first = first.filter(|(t, _)| *t < hit.t).or(Some((hit.t, index)));
            }
        }
        if let Some((_, index)) = first {
            nearest[index] += 1;
        }
    }
    let seen = placement.iter().zip(alone.into_iter().zip(nearest));
    let seen = seen.map(|((square, piece), (alone, nearest))| {
        assert!(alone > 30, "{position}: {piece:?} on {square} is out of the picture");
        let share = f64::from(nearest) / f64::from(alone);
        Seen { position: position.to_owned(), square, piece, share }
    });
    seen.min_by(|a, b| a.share.total_cmp(&b.share)).expect("a position has pieces")
}

/// The start position, and middlegames of all games in `games/`.
fn positions() -> Vec<(String, Placement)> {
    let mut positions = vec![("start".to_owned(), Placement::from(&Board::default()))];
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("games");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "pgn"));
    files.sort();
    for path in files {
        for game in Source::open(&path).unwrap().games() {
            let game = game.unwrap();
            let file = path.file_name().unwrap().to_string_lossy();
            let plies = PLIES.into_iter().filter(|ply| *ply <= game.plies.len());
            positions.extend(plies.map(|ply| (format!("{file}, ply {ply}"), game.placement(ply))));
        }
    }
    positions
}

fn least_of_all(view: View) -> Vec<Seen> {
    let stage = stage(view);
    let mut seen: Vec<Seen> = positions()
        .into_par_iter()
        .map(|(position, placement)| least_seen(&stage, &position, placement))
        .collect();
    seen.sort_by(|a, b| a.share.total_cmp(&b.share));
    seen
}

#[test]
fn no_piece_is_less_than_half_visible_from_whites_side() {
    let seen = least_of_all(View::White);
    assert!(seen.len() > 50, "{} positions", seen.len());
    let Seen { position, square, piece, share } = &seen[0];
    assert!(*share >= PROMISED, "{position}: {share:.2} of {piece:?} on {square} is seen");
}

#[test]
fn the_thesis_camera_keeps_no_such_promise() {
    let start = Placement::from(&Board::default());
    let least = least_seen(&stage(View::Thesis), "start", start);
    assert!(least.share < PROMISED / 2.0, "{}", least.share);
}
