//! Moves under way: who goes where, and that nothing passes through anything.

mod seen;

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec3;
use lightsquare::geometry::Solid;
use shakmaty::Position;
use shakmaty::san::SanPlus;
use shakmaty::variant::{Variant, VariantPosition};

use lightsquare::assets::{Assets, SetName};
use lightsquare::config::{Config, Look, VIEWS};
use lightsquare::game::{Game, Scanner, Source};
use lightsquare::notation::{Color, Role, Square};
use lightsquare::scene::{Reach, Stage, bodies};
use lightsquare::timeline::{Bodies, Envelope, Film, Frame, Mover, SLICE, Script, Spot, Timeline};

fn set(name: SetName) -> Bodies {
    bodies(&Assets::load(&Config::new(Look::Thesis), &name).unwrap().set)
}

fn staunton() -> Bodies {
    set(SetName::Staunton)
}

/// Drums that fill their squares, as tall as two of them.
fn drums() -> Bodies {
    let drum = Envelope::new(vec![0.5; (2.0 / SLICE) as usize]);
    Bodies { envelopes: [(); 6].map(|()| drum.clone()), ..staunton() }
}

fn script(bodies: &Bodies) -> Script {
    Script { animate: true, bodies: bodies.clone(), keeps_captured: true, ..Script::default() }
}

fn game(text: &str) -> Game {
    let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
    let game = Game::read(scanned, 1);
    assert_eq!(game.problems, [], "{text}");
    game
}

/// The frame in the middle of the last move.
fn halfway(game: &Game) -> Frame {
    let film = Film { fps: 100.0, first: 0.0, ..Film::default() };
    let script = Script { film, ..script(&staunton()) };
    let plies = game.plies.len();
    let timeline = Timeline::new(game, plies - 1, plies, &script).unwrap();
    timeline.frame((film.transition / 2.0 * film.fps).round() as usize)
}

/// The last position at rest.
fn at_the_end(game: &Game) -> Frame {
    let script = script(&staunton());
    let plies = game.plies.len();
    Timeline::new(game, plies, plies, &script).unwrap().frame(0)
}

fn moving(frame: &Frame, role: Role) -> &Mover {
    frame.movers.iter().find(|mover| mover.piece.role == role).unwrap()
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

/// The room of a piece that is as large as the share `size` of itself: a drum, where it is less.
fn sized(envelope: &Envelope, size: f64) -> Envelope {
    if size == 1.0 {
        return envelope.clone();
    }
    let slices = (envelope.height() * size / SLICE).ceil() as usize;
    Envelope::new(vec![envelope.radius() * size; slices])
}

/// Two pieces of a frame that overlap, or one that goes through the board.
fn collision(frame: &Frame, bodies: &Bodies) -> Option<String> {
    let pieces = pieces(frame);
    let envelope = |mover: &Mover| sized(bodies.of(mover.piece.role), mover.size);
    for (index, mover) in pieces[..frame.movers.len()].iter().enumerate() {
        for other in &pieces[index + 1..] {
            let is_exchange = mover.identity == other.identity;
            let gap = envelope(mover).gap(mover.spot, &envelope(other), other.spot);
            // Drums touch their neighbours at rest; sums of decimal fractions leave crumbs.
            if gap < -1e-6 && !is_exchange {
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
fn sliders_glide_and_knights_hop() {
    let pawn = halfway(&game("1. e4 *"));
    let mover = moving(&pawn, Role::Pawn);
    assert_eq!((mover.spot.file, mover.spot.rank), (4.0, 2.0));
    assert!(mover.spot.height < 0.1);
    let knight = halfway(&game("1. Nf3 *"));
    // Over the pawns beside its way, which are 0.88 squares tall.
    assert!(moving(&knight, Role::Knight).spot.height > 0.88);
    assert_eq!(pawn.placement.get(Square::E2), None);
    assert_eq!(pawn.placement.get(Square::E4), None);
}

#[test]
fn a_captured_piece_leaves_and_only_that_one() {
    let frame = halfway(&game("1. e4 d5 2. exd5 *"));
    assert_eq!(frame.movers.len(), 2);
    let taken = frame.movers.iter().find(|mover| mover.piece.color == Color::Black).unwrap();
    assert_eq!(taken.identity, Square::D7);
    // It is on its way to White's right hand, and nothing lies below.
    assert!(taken.spot.file > 3.0 && taken.spot.rank < 4.0 && taken.spot.height > 0.3);
}

#[test]
fn en_passant_takes_the_pawn_beside() {
    let frame = halfway(&game("1. e4 a6 2. e5 d5 3. exd6 *"));
    let taken = frame.movers.iter().find(|mover| mover.piece.color == Color::Black).unwrap();
    assert_eq!(taken.identity, Square::D7);
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
    let last = at_the_end(&game);
    assert_eq!(last.identities.get(Square::D1), Square::A1);
    assert_eq!(last.identities.get(Square::C1), Square::C1);
}

#[test]
fn a_promoted_pawn_stays_who_it_was() {
    let fen = "[SetUp \"1\"]\n[FEN \"8/4P1k1/8/8/8/8/8/4K3 w - - 0 1\"]\n\n";
    let game = game(&format!("{fen}1. e8=N+ *"));
    assert_eq!(halfway(&game).movers[0].piece.role, Role::Pawn);
    let last = at_the_end(&game);
    assert_eq!(last.placement.get(Square::E8).unwrap().role, Role::Knight);
    assert_eq!(last.identities.get(Square::E8), Square::E7);
}

fn no_collision(game: &Game, bodies: &Bodies, name: &str) -> usize {
    let script = script(bodies);
    let timeline = Timeline::new(game, 0, game.plies.len(), &script).unwrap();
    let mut moving = 0;
    for index in 0..timeline.frames() {
        let frame = timeline.frame(index);
        moving += usize::from(!frame.movers.is_empty());
        let met = collision(&frame, bodies);
        assert_eq!(met, None, "{name}, frame {index}, after ply {}", frame.ply);
    }
    moving
}

#[test]
fn nothing_passes_through_anything_in_any_sample_game() {
    let bodies = staunton();
    let mut seen = 0;
    for entry in std::fs::read_dir("games").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "pgn") {
            continue;
        }
        for game in games(&path) {
            seen += no_collision(&game, &bodies, &path.display().to_string());
        }
    }
    assert!(seen > 10_000, "{seen}");
}

/// A game of legal moves chosen by chance, captures, promotions and drops first.
fn random_game(variant: Variant, mut seed: u64, plies: usize) -> String {
    let mut position = VariantPosition::new(variant);
    let mut text = format!("[Variant \"{variant}\"]\n\n");
    for ply in 0..plies {
        let moves = position.legal_moves();
        if moves.is_empty() {
            break;
        }
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let special: Vec<_> =
            moves.iter().filter(|m| m.is_capture() || m.is_promotion()).copied().collect();
        let drops: Vec<_> = moves.iter().filter(|m| m.from().is_none()).copied().collect();
        let special = if seed >> 63 == 0 && !drops.is_empty() { drops } else { special };
        let from = if special.is_empty() || seed >> 62 == 0 { moves.to_vec() } else { special };
        let played = from[(seed >> 33) as usize % from.len()];
        if ply % 2 == 0 {
            text += &format!("{}. ", ply / 2 + 1);
        }
        text += &format!("{} ", SanPlus::from_move_and_play_unchecked(&mut position, played));
    }
    text + "*"
}

#[test]
fn nothing_passes_through_anything_in_games_of_chance_with_any_set() {
    for (name, bodies) in
        [("staunton", staunton()), ("thesis", set(SetName::Thesis)), ("drums", drums())]
    {
        let mut captured = 0;
        for seed in 0..4 {
            let text = random_game(Variant::Chess, seed, 120);
            let game = game(&text);
            no_collision(&game, &bodies, &format!("{name}, {text}"));
            captured += at_the_end(&game).taken.len();
        }
        assert!(captured > 60, "{captured}");
    }
}

#[test]
fn nothing_passes_through_anything_in_games_by_other_rules() {
    let bodies = staunton();
    for variant in Variant::ALL {
        for seed in 0..3 {
            let text = random_game(variant, seed, 100);
            no_collision(&game(&text), &bodies, &text);
        }
    }
}

#[test]
fn a_dropped_piece_comes_from_the_hand_through_the_air() {
    let text = "[Variant \"crazyhouse\"]\n\n1. e4 d5 2. exd5 Qxd5 3. @e6 *";
    let frame = halfway(&game(text));
    let [mover] = frame.movers[..] else { panic!("{:?}", frame.movers) };
    assert_eq!((mover.piece.color, mover.piece.role), (Color::White, Role::Pawn));
    // Half of the way from White's right hand, higher than pawns.
    assert!(mover.spot.file > 4.0 && mover.spot.height > 0.5, "{mover:?}");
    assert_eq!(frame.placement.get(Square::E6), None);
    assert_eq!(frame.taken.len(), 1, "it is out of the hand");
}

#[test]
fn who_is_captured_changes_colour_where_he_is_in_hand() {
    let game = game("[Variant \"crazyhouse\"]\n\n1. e4 d5 2. exd5 *");
    let script = script(&staunton());
    let timeline = Timeline::new(&game, 2, 3, &script).unwrap();
    let frames: Vec<Frame> = (0..timeline.frames()).map(|index| timeline.frame(index)).collect();
    let way = frames.iter().flat_map(|frame| &frame.movers);
    let way: Vec<&Mover> = way.filter(|mover| mover.identity == Square::D7).collect();
    let is_white = |mover: &&Mover| mover.piece.color == Color::White;
    let (hers, his) = way.iter().partition::<Vec<&Mover>, _>(|mover| is_white(mover));
    assert!(hers.len() >= 2 && his.len() > 2, "{way:?}");
    let end = frames.last().unwrap().taken[0];
    assert!(hers.iter().all(|mover| mover.size <= 1.0 && mover.spot.apart(end.spot) < 1e-9));
    assert!(his[0].size == 1.0 && his[0].spot.apart(end.spot) > 1.0);
}

#[test]
fn all_that_a_capture_blows_up_is_gone_and_nobody_else() {
    let game = game("[Variant \"atomic\"]\n\n1. Nf3 a6 2. Ne5 a5 3. Nxd7 *");
    let script = script(&staunton());
    let timeline = Timeline::new(&game, 4, 5, &script).unwrap();
    let frames: Vec<Frame> = (0..timeline.frames()).map(|index| timeline.frame(index)).collect();
    let most = frames.iter().max_by_key(|frame| frame.movers.len()).unwrap();
    let who: Vec<Square> = most.movers.iter().map(|mover| mover.identity).collect();
    // The knight, whom it takes, and all round but pawns.
    let round = [Square::G1, Square::D7, Square::C8, Square::D8, Square::E8];
    assert_eq!(who, round);
    let last = frames.last().unwrap();
    assert!(last.movers.is_empty() && last.taken.is_empty());
    assert_eq!(last.placement.iter().count(), 32 - round.len());
    // They shrink, and rise but for who is taken.
    let sizes: Vec<f64> = frames.iter().flat_map(|f| &f.movers).map(|mover| mover.size).collect();
    assert!(sizes.iter().any(|size| *size < 0.2) && sizes.iter().all(|size| *size > 0.0));
}

/// Every pair of files that a king and the rook that it castles with can have, both ways.
#[test]
fn chess960_castling_passes_through_nothing_in_all_its_forms() {
    let bodies = staunton();
    let mut forms = 0;
    for king in 1..7 {
        for rook in (0..8).filter(|rook| *rook != king) {
            let (king_to, rook_to) = if rook > king { (6, 5) } else { (2, 3) };
            let way = [king, rook, king_to, rook_to];
            let (first, last) = (way.iter().min().unwrap(), way.iter().max().unwrap());
            // Neighbours stand wherever they do not hinder.
            let rank: String = (0..8)
                .map(|file| match file {
                    _ if file == king => 'K',
                    _ if file == rook => 'R',
                    _ if (first..=last).contains(&&file) => '1',
                    _ => 'N',
                })
                .collect();
            let right = char::from(b'A' + rook as u8);
            let san = if rook > king { "O-O" } else { "O-O-O" };
            let text = format!(
                "[Variant \"Chess960\"]\n[SetUp \"1\"]\n\
                 [FEN \"4k3/8/8/8/8/8/PPPPPPPP/{rank} w {right} - 0 1\"]\n\n1. {san} *"
            );
            let game = game(&text);
            no_collision(&game, &bodies, &text);
            let end = at_the_end(&game);
            let identity = |file: u32| Square::new(file);
            let at = |file: u32| end.identities.get(identity(file));
            assert_eq!((at(king_to), at(rook_to)), (identity(king), identity(rook)), "{text}");
            forms += 1;
        }
    }
    assert_eq!(forms, 42);
}

#[test]
fn captured_pieces_stand_beside_the_board_in_their_order() {
    let text = "1. e4 d5 2. exd5 Qxd5 3. Nc3 Qxd2+ 4. Bxd2 a6 5. Nb5 axb5 *";
    let game = game(text);
    let frame = at_the_end(&game);
    let taken = |color: Color| -> Vec<&Mover> {
        frame.taken.iter().filter(|mover| mover.piece.color == color).collect()
    };
    let who = |movers: &[&Mover]| movers.iter().map(|mover| mover.identity).collect::<Vec<_>>();
    let (white, black) = (taken(Color::White), taken(Color::Black));
    assert_eq!(who(&white), [Square::E2, Square::D2, Square::B1]);
    assert_eq!(who(&black), [Square::D7, Square::D8]);
    // At the right hand of who took them, from his end on, off the frame and on the table.
    let edge = staunton().edge;
    assert!(white.iter().all(|mover| mover.spot.file < 3.5 - edge && mover.spot.height < 0.0));
    assert!(black.iter().all(|mover| mover.spot.file > 3.5 + edge && mover.spot.height < 0.0));
    assert!(white[0].spot.rank > 7.0 && black[0].spot.rank < 0.0);
    assert!(white.windows(2).all(|pair| pair[1].spot.rank < pair[0].spot.rank));
    // Where a film begins does not matter, nor whether it moves.
    for (first, animate) in [(0, true), (8, true), (10, false)] {
        let script = Script { animate, ..script(&staunton()) };
        let timeline = Timeline::new(&game, first, 10, &script).unwrap();
        let last = timeline.frame(timeline.frames() - 1);
        assert!(last.shows_the_same(&frame), "{first}, {animate}");
    }
}

#[test]
fn captured_pieces_are_gone_where_they_are_not_kept() {
    let game = game("1. e4 d5 2. exd5 Qxd5 *");
    let script = Script { keeps_captured: false, ..script(&staunton()) };
    let timeline = Timeline::new(&game, 0, 4, &script).unwrap();
    let frames: Vec<Frame> = (0..timeline.frames()).map(|index| timeline.frame(index)).collect();
    assert!(frames.iter().all(|frame| frame.taken.is_empty()));
    assert!(frames.iter().any(|frame| frame.movers.len() == 2), "they leave nevertheless");
}

#[test]
fn a_pawn_gives_way_to_what_it_becomes() {
    let fen = "[SetUp \"1\"]\n[FEN \"1r5k/P7/8/8/8/8/8/4K3 w - - 0 1\"]\n\n";
    for (san, square) in [("a8=Q", Spot::on(Square::A8)), ("axb8=N", Spot::on(Square::B8))] {
        let game = game(&format!("{fen}1. {san} *"));
        let script = script(&staunton());
        let timeline = Timeline::new(&game, 0, 1, &script).unwrap();
        let mut sizes = Vec::new();
        for index in 0..timeline.frames() {
            for mover in timeline.frame(index).movers {
                if mover.identity == Square::A7 && mover.size < 1.0 {
                    assert_eq!(mover.spot, Spot { height: mover.spot.height, ..square });
                    sizes.push((mover.piece.role, mover.size));
                }
            }
        }
        let (pawn, other): (Vec<_>, Vec<_>) =
            sizes.iter().copied().partition(|(role, _): &(Role, f64)| *role == Role::Pawn);
        assert!(pawn.len() >= 2 && pawn.windows(2).all(|pair| pair[1].1 < pair[0].1), "{sizes:?}");
        assert!(
            other.len() >= 2 && other.windows(2).all(|pair| pair[1].1 > pair[0].1),
            "{sizes:?}"
        );
        assert!(sizes[..pawn.len()] == pawn[..], "one after the other: {sizes:?}");
    }
}

/// Where each piece is, by identity.
fn places(frame: &Frame) -> BTreeMap<Square, Spot> {
    pieces(frame).into_iter().map(|mover| (mover.identity, mover.spot)).collect()
}

#[test]
fn no_piece_jumps_or_vanishes() {
    let game = game("1. e4 d5 2. exd5 Nf6 3. Nf3 Nxd5 4. Bc4 e6 5. O-O *");
    let script = script(&staunton());
    let timeline = Timeline::new(&game, 0, game.plies.len(), &script).unwrap();
    let mut last = places(&timeline.frame(0));
    for index in 1..timeline.frames() {
        let now = places(&timeline.frame(index));
        assert_eq!(now.len(), 32);
        for (identity, a) in &last {
            let b = now[identity];
            let far = a.apart(b).hypot(a.height - b.height);
            assert!(far < 1.0, "{identity} by {far} squares in frame {index}");
        }
        last = now;
    }
}

/// What the envelopes promise: no point of a piece lies outside.
#[test]
fn envelopes_hold_their_pieces() {
    for name in [SetName::Staunton, SetName::Thesis] {
        let set = Assets::load(&Config::new(Look::Thesis), &name).unwrap().set;
        let bodies = bodies(&set);
        for (role, piece) in [
            (Role::Pawn, &set.pawn),
            (Role::Knight, &set.knight),
            (Role::Bishop, &set.bishop),
            (Role::Rook, &set.rook),
            (Role::Queen, &set.queen),
            (Role::King, &set.king),
        ] {
            let envelope = bodies.of(role);
            // A needle that stands beside the axis touches the envelope where there is anything.
            let needle = Envelope::new(vec![0.0]);
            let mut inside = 0;
            for index in 0..40 * 40 * 60 {
                let (i, j, k) = (index % 40, index / 40 % 40, index / 1600);
                let share = |n: i32, of: f64| (f64::from(n) + 0.37) / of;
                let (x, z) = (share(i, 40.0) - 0.5, share(j, 40.0) - 0.5);
                let y = share(k, 60.0) * 1.8;
                if piece.contains(DVec3::new(x, y, z) * 4.0) {
                    let at = Spot { file: x, rank: z, height: y };
                    let axis = Spot { file: 0.0, rank: 0.0, height: 0.0 };
                    assert!(envelope.gap(axis, &needle, at) <= 0.0, "{role:?}: {at:?}");
                    inside += 1;
                }
            }
            assert!(inside > 1000, "{role:?}: {inside}");
        }
    }
}

#[test]
fn pictures_hold_all_that_moves_in_any_sample_game() {
    let views = ["white", "black", "top", "side", "player", "mover"];
    let stages = views.map(|name| {
        let mut config = Config { width: 300, height: 200, ..Config::default() };
        config.camera.view = VIEWS.iter().find(|(known, _)| *known == name).unwrap().1;
        let assets = Assets::load(&config, &SetName::Staunton).unwrap();
        let reach = Reach { moves: true, captured: true, ..Reach::default() };
        (name, Stage::new(&config, &assets, reach).unwrap())
    });
    let bodies = staunton();
    let script = script(&bodies);
    let still = Frame::still(lightsquare::notation::Placement::EMPTY);
    let cameras = stages.map(|(name, stage)| (name, stage.scene(&still).camera));
    for entry in std::fs::read_dir("games").unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "pgn") {
            continue;
        }
        for game in games(&path) {
            let timeline = Timeline::new(&game, 0, game.plies.len(), &script).unwrap();
            for index in 0..timeline.frames() {
                let frame = timeline.frame(index);
                for mover in frame.movers.iter().chain(&frame.taken) {
                    let Spot { file, rank, height } = mover.spot;
                    let top = height + bodies.of(mover.piece.role).height();
                    let top = DVec3::new(file, top, rank) * 4.0;
                    for (name, camera) in &cameras {
                        let beyond = seen::beyond(camera, top, 1.5);
                        let what = format!("{name}, {}, frame {index}: {mover:?}", path.display());
                        assert!(beyond < 1.0, "{what}: {beyond}");
                    }
                }
            }
        }
    }
}
