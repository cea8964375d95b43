//! Frames of films: how many, when, and that pieces go where the rules say.

use lightsquare::game::{Game, Scanner};
use lightsquare::notation::{Color, Role, Square};
use lightsquare::timeline::{Film, Frame, Mover, Spot, Timeline};
use std::collections::BTreeMap;

fn game(text: &str) -> Game {
    let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
    let game = Game::read(scanned, 1);
    assert_eq!(game.problems, [], "{text}");
    game
}

fn stills(game: &Game) -> Timeline {
    Timeline::new(game, 0, game.plies.len(), None, 0.0)
}

fn film(game: &Game) -> Timeline {
    Timeline::new(game, 0, game.plies.len(), Some(Film::default()), 0.0)
}

/// The frame in the middle of the last move.
fn halfway(game: &Game) -> Frame {
    let moves = game.plies.len();
    let film = Film { fps: 100.0, ..Film::default() };
    let timeline = Timeline::new(game, 0, moves, Some(film), 0.0);
    let begins = film.length(moves) - film.last - film.transition;
    timeline.frame(((begins + film.transition / 2.0) * film.fps).round() as usize)
}

fn moving(frame: &Frame, role: Role) -> &Mover {
    frame.movers.iter().find(|mover| mover.piece.role == role).unwrap()
}

#[test]
fn stills_are_one_frame_a_position() {
    let game = game("1. e4 e5 2. Nf3 *");
    let timeline = stills(&game);
    assert_eq!(timeline.frames(), 4);
    for ply in 0..=3 {
        let frame = timeline.frame(ply);
        assert_eq!((frame.ply, frame.placement), (ply, game.placement(ply)));
        assert_eq!(frame.movers, []);
    }
}

#[test]
fn a_films_length_is_first_moves_pauses_and_last() {
    let cases = [
        ("*", 6.0),
        ("1. e4 *", 1.0 + 0.6 + 5.0),
        ("1. e4 e5 2. Nf3 *", 1.0 + 3.0 * 0.6 + 2.0 * 0.8 + 5.0),
    ];
    for (text, seconds) in cases {
        let game = game(&format!("[Event \"x\"]\n\n{text}"));
        let timeline = film(&game);
        assert_eq!(timeline.frames(), (seconds * 25.0_f64).round() as usize, "{text}");
        let last = timeline.frame(timeline.frames() - 1);
        assert_eq!(last.time, (timeline.frames() - 1) as f64 / 25.0);
        assert_eq!(last.placement, game.placement(game.plies.len()));
    }
}

#[test]
fn a_film_shows_every_position_at_rest_in_order() {
    let game = game("1. e4 d5 2. exd5 Qxd5 3. Nc3 *");
    let timeline = film(&game);
    let mut rests = Vec::new();
    for index in 0..timeline.frames() {
        let frame = timeline.frame(index);
        assert_eq!(frame.time, index as f64 / 25.0);
        if frame.movers.is_empty() {
            assert_eq!(frame.placement, game.placement(frame.ply));
            rests.push(frame.ply);
        }
    }
    rests.dedup();
    assert_eq!(rests, [0, 1, 2, 3, 4, 5]);
}

#[test]
fn parts_of_a_game_keep_identities() {
    let game = game("1. e4 d5 2. exd5 Qxd5 *");
    let whole = stills(&game);
    let part = Timeline::new(&game, 2, 4, None, 0.0);
    assert_eq!(part.frames(), 3);
    for index in 0..3 {
        let (a, b) = (part.frame(index), whole.frame(index + 2));
        assert!(a.shows_the_same(&b));
        assert_eq!(a.ply, b.ply);
    }
    assert_eq!(part.frame(2).identities.get(Square::D5), Square::D8);
}

#[test]
fn a_position_that_comes_back_is_the_same_picture() {
    let game = game("1. Nf3 Nf6 2. Ng1 Ng8 3. Nf3 Nf6 *");
    let timeline = stills(&game);
    assert!(timeline.frame(6).shows_the_same(&timeline.frame(2)));
    // Another move led there.
    assert!(!timeline.frame(4).shows_the_same(&timeline.frame(0)));
}

#[test]
fn sliders_glide_and_knights_hop() {
    let pawn = halfway(&game("1. e4 *"));
    let mover = moving(&pawn, Role::Pawn);
    assert_eq!((mover.spot.file, mover.spot.rank), (4.0, 2.0));
    assert!(mover.spot.height < 0.1);
    let knight = halfway(&game("1. Nf3 *"));
    assert!(moving(&knight, Role::Knight).spot.height > 1.67);
    assert_eq!(pawn.placement.get(Square::E2), None);
    assert_eq!(pawn.placement.get(Square::E4), None);
}

#[test]
fn a_captured_piece_leaves_and_only_that_one() {
    let frame = halfway(&game("1. e4 d5 2. exd5 *"));
    assert_eq!(frame.movers.len(), 2);
    let taken = frame.movers.iter().find(|mover| mover.piece.color == Color::Black).unwrap();
    assert_eq!((taken.identity, taken.spot.file, taken.spot.rank), (Square::D7, 3.0, 4.0));
    assert!(taken.spot.height > 1.0);
}

#[test]
fn en_passant_takes_the_pawn_beside() {
    let frame = halfway(&game("1. e4 a6 2. e5 d5 3. exd6 *"));
    let taken = frame.movers.iter().find(|mover| mover.piece.color == Color::Black).unwrap();
    assert_eq!((taken.identity, taken.spot.file, taken.spot.rank), (Square::D7, 3.0, 4.0));
    assert_eq!(frame.placement.get(Square::D5), None);
}

#[test]
fn castling_moves_both_and_the_rook_hops() {
    let cases = [
        ("1. Nf3 a6 2. g3 a5 3. Bg2 a4 4. O-O *", 5.0, 6.0),
        ("1. Nc3 a6 2. b3 a5 3. Bb2 a4 4. e3 h6 5. Qe2 h5 6. O-O-O *", 3.0, 1.5),
    ];
    for (text, king, rook) in cases {
        let frame = halfway(&game(text));
        assert_eq!(frame.movers.len(), 2);
        let (k, r) = (moving(&frame, Role::King), moving(&frame, Role::Rook));
        assert!(((k.spot.file - king).abs() < 1.0) && (r.spot.file - rook).abs() < 0.6, "{text}");
        assert!(r.spot.height > 1.67 && k.spot.height < 0.1);
    }
}

#[test]
fn chess960_castling_moves_what_has_to_move() {
    // The king stands on its square already: only the rook moves.
    let fen = "[Variant \"Chess960\"]\n[SetUp \"1\"]\n[FEN \"4k3/8/8/8/8/8/8/R1K5 w Q - 0 1\"]\n\n";
    let game = game(&format!("{fen}1. O-O-O *"));
    let frame = halfway(&game);
    assert_eq!(frame.movers.len(), 1);
    assert_eq!(moving(&frame, Role::Rook).identity, Square::A1);
    let last = stills(&game).frame(1);
    assert_eq!(last.identities.get(Square::D1), Square::A1);
    assert_eq!(last.identities.get(Square::C1), Square::C1);
}

#[test]
fn a_promoted_pawn_stays_who_it_was() {
    let fen = "[SetUp \"1\"]\n[FEN \"8/4P1k1/8/8/8/8/8/4K3 w - - 0 1\"]\n\n";
    let game = game(&format!("{fen}1. e8=N+ *"));
    assert_eq!(halfway(&game).movers[0].piece.role, Role::Pawn);
    let last = stills(&game).frame(1);
    assert_eq!(last.placement.get(Square::E8).unwrap().role, Role::Knight);
    assert_eq!(last.identities.get(Square::E8), Square::E7);
}

/// Where each piece is, by identity.
fn places(frame: &Frame) -> BTreeMap<Square, Spot> {
    let standing =
        frame.placement.iter().map(|(square, _)| (frame.identities.get(square), Spot::on(square)));
    standing.chain(frame.movers.iter().map(|mover| (mover.identity, mover.spot))).collect()
}

#[test]
fn no_piece_jumps_or_vanishes_but_a_captured_one() {
    let game = game("1. e4 d5 2. exd5 Nf6 3. Nf3 Nxd5 4. Bc4 e6 5. O-O *");
    let timeline = film(&game);
    let mut last = places(&timeline.frame(0));
    assert_eq!(last.len(), 32);
    let mut vanished = Vec::new();
    for index in 1..timeline.frames() {
        let now = places(&timeline.frame(index));
        for (identity, a) in &last {
            match now.get(identity) {
                None => vanished.push((*identity, *a)),
                Some(b) => {
                    let far = (a.file - b.file).hypot(a.rank - b.rank).hypot(a.height - b.height);
                    assert!(far < 1.0, "{identity} by {far} squares in frame {index}");
                }
            }
        }
        last = now;
    }
    let identities: Vec<Square> = vanished.iter().map(|(identity, _)| *identity).collect();
    assert_eq!(identities, [Square::D7, Square::E2]);
    // They have left the board when they are gone.
    assert!(vanished.iter().all(|(_, spot)| spot.height > 3.0));
}

#[test]
fn the_camera_turns_evenly_over_the_whole() {
    let game = game("1. e4 e5 2. Nf3 *");
    let timeline = Timeline::new(&game, 0, 3, None, 90.0);
    let turns: Vec<f64> = (0..4).map(|index| timeline.frame(index).gaze.orbit).collect();
    assert_eq!(turns, [0.0, 30.0, 60.0, 90.0]);
}
