//! Frames of films: how many, when, and where the camera is.

use lightsquare::config::{Config, KeyFrame};
use lightsquare::game::{Game, Scanner};
use lightsquare::notation::{Color, Square};
use lightsquare::timeline::{
    Camerawork, Card, Dials, Film, Frame, Lead, PathError, Pause, Script, Timeline,
};

fn game(text: &str) -> Game {
    let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
    let game = Game::read(scanned, 1);
    assert_eq!(game.problems, [], "{text}");
    game
}

fn whole<'a>(game: &Game, script: &'a Script) -> Timeline<'a> {
    Timeline::new(game, 0, game.plies.len(), script).unwrap()
}

fn film() -> Script {
    Script { animate: true, ..Script::default() }
}

fn frames(timeline: &Timeline) -> Vec<Frame> {
    (0..timeline.frames()).map(|index| timeline.frame(index)).collect()
}

#[test]
fn stills_are_one_frame_a_position() {
    let game = game("1. e4 e5 2. Nf3 *");
    let script = Script::default();
    let timeline = whole(&game, &script);
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
        let script = film();
        let timeline = whole(&game, &script);
        assert_eq!(timeline.frames(), (seconds * 25.0_f64).round() as usize, "{text}");
        let last = timeline.frame(timeline.frames() - 1);
        assert_eq!(last.time, (timeline.frames() - 1) as f64 / 25.0);
        assert_eq!(last.placement, game.placement(game.plies.len()));
    }
}

#[test]
fn a_film_shows_every_position_at_rest_in_order() {
    let game = game("1. e4 d5 2. exd5 Qxd5 3. Nc3 *");
    let script = film();
    let timeline = whole(&game, &script);
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
    let script = Script::default();
    let whole = whole(&game, &script);
    let part = Timeline::new(&game, 2, 4, &script).unwrap();
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
    let script = Script::default();
    let timeline = whole(&game, &script);
    assert!(timeline.frame(6).shows_the_same(&timeline.frame(2)));
    // Another move led there.
    assert!(!timeline.frame(4).shows_the_same(&timeline.frame(0)));
}

/// The formula of the README, and the times of all frames.
#[test]
fn frames_and_times_are_those_of_the_formula() {
    let games = ["*", "1. e4 *", "1. e4 e5 2. Nf3 *", "1. e4 d5 2. exd5 Qxd5 3. Nc3 Qa5 *"];
    let films = [
        Film::default(),
        Film { fps: 30.0, pause: Pause::Even(0.0), ..Film::default() },
        Film { fps: 7.5, transition: 0.0, pause: Pause::Even(0.3), ..Film::default() },
        Film { fps: 60.0, first: 0.0, last: 0.0, ..Film::default() },
        Film { fps: 24.0, title: 2.0, result: 3.0, ..Film::default() },
    ];
    for text in games {
        let game = game(&format!("[Event \"x\"]\n\n{text}"));
        let moves = game.plies.len() as f64;
        for film in films {
            let Film { fps, transition, first, last, title, result, .. } = film;
            let Pause::Even(pause) = film.pause else { unreachable!() };
            let seconds =
                title + first + moves * transition + (moves - 1.0).max(0.0) * pause + last + result;
            let script = Script { film, animate: true, ..Script::default() };
            let frames = frames(&whole(&game, &script));
            assert_eq!(frames.len(), ((seconds * fps).round() as usize).max(1), "{text}, {film:?}");
            for (index, frame) in frames.iter().enumerate() {
                assert_eq!(frame.time, index as f64 / fps);
                let card = match frame.time {
                    time if time < title => Some(Card::Title),
                    time if result > 0.0 && time >= seconds - result => Some(Card::Result),
                    _ => None,
                };
                assert_eq!(frame.card, card, "{text}, {film:?}, {index}");
                // Whether a move is under way, as the formula has it, in whole millionths of a second.
                let micro = |seconds: f64| (seconds * 1e6).round() as i64;
                let since_first = micro(frame.time - title - first);
                let (transition, pause) = (micro(transition), micro(pause));
                let moving = since_first >= 0
                    && since_first / (transition + pause).max(1) < moves as i64
                    && since_first % (transition + pause).max(1) < transition;
                assert_eq!(!frame.movers.is_empty(), moving, "{text}, {film:?}, {index}");
            }
        }
    }
}

#[test]
fn without_animation_title_and_result_are_one_picture_each() {
    let game = game("1. e4 e5 *");
    let film = Film { title: 3.0, result: 2.0, ..Film::default() };
    let script = Script { film, ..Script::default() };
    let cards: Vec<_> = frames(&whole(&game, &script)).iter().map(|frame| frame.card).collect();
    assert_eq!(cards, [Some(Card::Title), None, None, None, Some(Card::Result)]);
}

fn with(camerawork: Camerawork) -> Script {
    Script { camerawork, ..Script::default() }
}

#[test]
fn the_camera_turns_evenly_over_the_whole() {
    let game = game("1. e4 e5 2. Nf3 *");
    let turns = |work| -> Vec<f64> {
        let script = with(work);
        frames(&whole(&game, &script)).iter().map(|frame| frame.gaze.orbit).collect()
    };
    let orbit = Camerawork { orbit: 90.0, ..Camerawork::default() };
    assert_eq!(turns(orbit.clone()), [0.0, 30.0, 60.0, 90.0]);
    assert_eq!(turns(Camerawork { each_move: true, ..orbit }), [0.0, 90.0, 180.0, 270.0]);
    let mover = Camerawork { lead: Lead::Mover { turn: -130.0 }, ..Camerawork::default() };
    assert_eq!(turns(mover), [0.0, -130.0, 0.0, -130.0]);
}

/// How far the camera turns or leans between two frames at most.
fn steps(script: &Script, of: impl Fn(&Frame) -> f64) -> (f64, f64) {
    let game = game("1. e4 d5 2. exd5 Qxd5 3. Nc3 *");
    let values: Vec<f64> = frames(&whole(&game, script)).iter().map(of).collect();
    let step = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    (step, values.iter().copied().fold(0.0, f64::max))
}

#[test]
fn the_camera_never_jumps() {
    let film =
        |lead| Script { animate: true, ..with(Camerawork { lead, ..Camerawork::default() }) };
    // A half-turn in 0.64 s is 16 frames: 17° a frame where it is quickest.
    let (step, most) = steps(&film(Lead::Mover { turn: 180.0 }), |frame| frame.gaze.orbit);
    assert!(step < 17.5 && most == 180.0, "{step}, {most}");
    let (step, most) = steps(&film(Lead::Piece), |frame| frame.gaze.lean[0] + 4.0);
    assert!(step < 0.4 && most > 3.5, "{step}, {most}");
}

fn keys(lines: &str) -> Vec<KeyFrame> {
    Config::parse(&format!("[CameraPath]\n{lines}")).unwrap().camera.path
}

fn path(lines: &str) -> Script {
    let lead = Lead::Path(keys(lines));
    Script { animate: true, ..with(Camerawork { lead, ..Camerawork::default() }) }
}

#[test]
fn a_path_goes_through_its_key_frames_and_smoothly_between_them() {
    let game = game("1. e4 e5 2. Nf3 Nc6 *");
    let script = path(
        "0.2 = 0,10,-30 | 14,0,14 | 60\n1w = 10,20,-30 | 14,0,14 | 80 | 10\n\
         2w = 30,20,-20 | 10,0,14 | 80\n99w = 40,20,0 | 14,0,14 | 60",
    );
    let timeline = whole(&game, &script);
    let pose = |index: usize| timeline.frame(index).gaze.pose.unwrap();
    // 0.2 s is frame 5; the first move rests at 1.6 s, White's second at 4.4 s.
    for (index, x, fov, roll) in
        [(0, 0.0, 60.0, 0.0), (5, 0.0, 60.0, 0.0), (40, 10.0, 80.0, 10.0), (110, 30.0, 80.0, 0.0)]
    {
        let pose = pose(index);
        for (found, expected) in [(pose.position.x, x), (pose.fov, fov), (pose.z_rot, roll)] {
            assert!((found - expected).abs() < 1e-9, "frame {index}: {pose:?}");
        }
    }
    let places: Vec<f64> = (0..timeline.frames()).map(|index| pose(index).position.x).collect();
    assert!(places.windows(2).all(|pair| pair[1] >= pair[0]), "it goes on, never back");
    // No kinks: the step changes little from frame to frame.
    let steps: Vec<f64> = places.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let kink = steps.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    assert!(kink < 0.05, "{kink}");
    // A move that the game does not have is where it would be: the camera is still on its way.
    assert!(places[places.len() - 1] < 40.0);
}

#[test]
fn paths_that_cannot_be_taken_are_refused() {
    let game = game("1. e4 e5 2. Nf3 Nc6 *");
    // In seconds and moves they may be mixed; the second move rests at 3 s.
    let script = path("4 = 0,10,-30 | 14,0,14 | 60\n1b = 10,20,-30 | 14,0,14 | 80");
    let error = Timeline::new(&game, 0, 4, &script).err().unwrap();
    assert!(matches!(error, PathError::OutOfOrder { .. }), "{error}");
    assert!(error.to_string().contains("`1b` comes at 3.00 s, and `4` before it at 4.00 s"));
    let script = path("0 = 14,0,0 | 14,0,14 | 60\n4 = 14,0,28 | 14,0,14 | 60");
    let error = Timeline::new(&game, 0, 4, &script).err().unwrap();
    assert!(matches!(error, PathError::ThroughLookAt { .. }), "{error}");
}

#[test]
fn a_real_pause_follows_the_moves_times() {
    let by_moves = "1. e4 {[%emt 0:00:02]} e5 {[%emt 0:00:10]} 2. Nf3 {[%emt 0:00:20]} \
                    Nc6 {[%emt 0:01:40]} 3. Bb5 {[%emt 0:00:01]} *";
    let by_clocks = "[TimeControl \"300+1\"]\n\n\
                     1. e4 {[%clk 0:04:59]} e5 {[%clk 0:04:51]} 2. Nf3 {[%clk 0:04:40]} \
                     Nc6 {[%clk 0:03:12]} 3. Bb5 {[%clk 0:04:40]} *";
    for text in [by_moves, by_clocks] {
        let game = game(text);
        let film = Film { pause: Pause::Real, fps: 100.0, ..Film::default() };
        let script = Script { film, animate: true, ..Script::default() };
        let frames = frames(&whole(&game, &script));
        // The median of 10, 20, 100 and 1 is 15 s.
        let pauses = [10.0 / 15.0 * 0.8, 20.0 / 15.0 * 0.8, 2.0, 0.4];
        let seconds = 1.0 + 5.0 * 0.6 + pauses.iter().sum::<f64>() + 5.0;
        assert_eq!(frames.len(), (seconds * 100.0_f64).round() as usize);
        for (index, pause) in pauses.into_iter().enumerate() {
            let resting = |frame: &&Frame| frame.movers.is_empty() && frame.ply == index + 1;
            let rests = frames.iter().filter(resting).count() as f64 / 100.0;
            assert!((rests - pause).abs() < 0.011, "{index}: {rests}");
        }
    }
}

fn dials(game: &Game, script: Script) -> Vec<Dials> {
    let script = Script { has_clock: true, ..script };
    frames(&whole(game, &script)).into_iter().filter_map(|frame| frame.dials).collect()
}

#[test]
fn the_clock_shows_what_is_left_and_runs_down_in_the_pause() {
    let text = "[TimeControl \"60+2\"]\n[Result \"1-0\"]\n[Termination \"Time forfeit\"]\n\n\
                1. e4 {[%clk 0:00:57]} e5 {[%clk 0:01:00]} 2. Nf3 {[%clk 0:00:39]} 1-0";
    let game = game(text);
    let times = |left: [u32; 2], running| Dials::Times { left: left.map(Some), running };
    let (white, black) = (Some(Color::White), Some(Color::Black));
    assert_eq!(
        dials(&game, Script::default()),
        [
            times([60, 60], white),
            times([57, 60], black),
            times([57, 60], white),
            times([39, 0], black),
        ]
    );
    let shown = dials(&game, film());
    let mut seconds: Vec<u32> = Vec::new();
    for (index, dials) in shown.iter().enumerate() {
        let Dials::Times { left: [Some(white), Some(_)], running } = dials else {
            panic!("{index}: {dials:?}")
        };
        assert!(running.is_some(), "{index}");
        seconds.push(*white);
    }
    seconds.dedup();
    // White thinks 5 s and gets 2 back; 20 s in the second pause, and 2 back.
    let expected: Vec<u32> = (55..=60).rev().chain((37..=57).rev()).chain([39]).collect();
    assert!(seconds.iter().all(|second| expected.contains(second)), "{seconds:?}");
    assert!(seconds.len() > 20, "{seconds:?}");
    // Black's flag falls while the last position stands, 3 s of its 5, and not before.
    let fallen = shown.iter().filter(|dials| **dials == times([39, 0], black)).count();
    assert_eq!((fallen, shown.last()), (50, Some(&times([39, 0], black))));
}

#[test]
fn without_times_the_clock_tells_the_move() {
    let game = game("1. e4 e5 *");
    let moves = |made, to_move| Dials::Moves { made, to_move };
    assert_eq!(
        dials(&game, Script::default()),
        [moves([0, 0], Color::White), moves([1, 0], Color::Black), moves([1, 1], Color::White)]
    );
}
