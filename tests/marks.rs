//! What the board tells: which squares are marked, and what is painted on them.

use glam::DVec3;
use lightsquare::assets::{Assets, SetName};
use lightsquare::config::{Config, Look};
use lightsquare::game::{Game, Notes, Scanner};
use lightsquare::notation::{Arrow, Circle, Placement, Square};
use lightsquare::scene::{Object, Reach, SQUARE, Scene, Stage};
use lightsquare::timeline::{Frame, Marks, Script, Timeline};
use lightsquare::tracer::{Antialiasing, render};

fn game(text: &str) -> Game {
    let scanned = Scanner::new(text.as_bytes()).next().unwrap().unwrap();
    let game = Game::read(scanned, 1);
    assert_eq!(game.problems, [], "{text}");
    game
}

fn end(game: &Game) -> Marks {
    let plies = game.plies.len();
    let script = Script::default();
    Timeline::new(game, plies, plies, &script).unwrap().frame(0).marks
}

fn square(name: &str) -> Square {
    name.parse().unwrap()
}

/// A game from a position.
fn from(fen: &str, moves: &str) -> String {
    format!("[Variant \"Chess960\"]\n[SetUp \"1\"]\n[FEN \"{fen}\"]\n\n{moves} *")
}

#[test]
fn the_last_move_is_the_squares_that_it_left_and_reached() {
    let cases = [
        ("[Event \"x\"]\n\n*".to_owned(), vec![]),
        ("1. e4 *".to_owned(), vec!["e2", "e4"]),
        ("1. e4 e5 2. Nf3 *".to_owned(), vec!["g1", "f3"]),
        ("1. e4 a6 2. e5 d5 3. exd6 *".to_owned(), vec!["e5", "d6"]),
        ("1. Nf3 a6 2. g3 a5 3. Bg2 a4 4. O-O *".to_owned(), vec!["e1", "g1"]),
        (from("8/4P1k1/8/8/8/8/8/4K3 w - - 0 1", "1. e8=N+"), vec!["e7", "e8"]),
        (from("4k3/8/8/8/8/8/8/1RK5 w Q - 0 1", "1. O-O-O"), vec!["c1"]),
        (from("4k3/8/8/8/8/8/8/RK6 w Q - 0 1", "1. O-O-O"), vec!["b1", "c1"]),
        (from("4k3/8/8/8/8/8/8/1K5R w H - 0 1", "1. O-O"), vec!["b1", "g1"]),
    ];
    for (text, squares) in cases {
        let squares: Vec<Square> = squares.into_iter().map(square).collect();
        assert_eq!(end(&game(&text)).last_move, squares, "{text}");
    }
}

#[test]
fn check_and_mate_mark_the_king() {
    let cases = [
        ("1. e4 e5 *", None, false),
        ("1. e4 f5 2. Qh5+ *", Some("e8"), false),
        ("1. f3 e5 2. g4 Qh4# *", Some("e1"), true),
    ];
    for (text, king, is_mate) in cases {
        let marks = end(&game(text));
        assert_eq!((marks.check, marks.is_mate), (king.map(square), is_mate), "{text}");
    }
}

#[test]
fn a_fen_marks_a_check_where_it_says_who_is_to_move() {
    let cases = [
        ("4k3/8/8/8/8/8/8/4RK2 b - - 0 1", Some("e8")),
        ("4k3/8/8/8/8/8/8/3R1K2 b - - 0 1", None),
        ("4k3/8/8/8/8/8/8/4RK2", None),
        // The king could be taken: nobody can play on.
        ("4k3/8/8/8/8/8/8/4RK2 w - - 0 1", None),
        ("4k3/8/8/8/8/8/8/4R3 b - - 0 1", None),
    ];
    for (fen, king) in cases {
        assert_eq!(Marks::of_fen(fen).check, king.map(square), "{fen}");
    }
}

/// A game whose second position has notes.
fn annotated() -> Game {
    let mut game = game("1. e4 f5 2. Qh5+ g6 *");
    game.plies[2].notes = Notes {
        circles: vec!["Rg6".parse().unwrap()],
        arrows: vec!["Gh5e8".parse().unwrap()],
        ..Notes::default()
    };
    game
}

#[test]
fn drawn_marks_are_those_of_the_position() {
    let game = annotated();
    let script = Script::default();
    let timeline = Timeline::new(&game, 1, 4, &script).unwrap();
    let drawn: Vec<usize> = (0..4)
        .map(|index| timeline.frame(index).marks)
        .map(|marks| marks.circles.len() + marks.arrows.len())
        .collect();
    assert_eq!(drawn, [0, 0, 2, 0]);
}

#[test]
fn a_move_under_way_has_its_own_squares_and_nothing_else() {
    let game = annotated();
    let script = Script { animate: true, ..Script::default() };
    let timeline = Timeline::new(&game, 0, 4, &script).unwrap();
    let frames: Vec<Frame> = (0..timeline.frames()).map(|index| timeline.frame(index)).collect();
    let mut moving = 0;
    for frame in frames.iter().filter(|frame| !frame.movers.is_empty()) {
        let squares = end(&self::game(
            ["1. e4 *", "1. e4 f5 *", "1. e4 f5 2. Qh5+ *", "1. e4 f5 2. Qh5+ g6 *"][frame.ply],
        ));
        let expected = Marks { last_move: squares.last_move, ..Marks::default() };
        assert_eq!(frame.marks, expected, "{}", frame.time);
        moving += 1;
    }
    assert!(moving > 40, "{moving}");
    assert!(frames.iter().any(|frame| frame.marks.check.is_some()));
}

fn stage(look: Look, change: impl Fn(&mut Config)) -> Stage {
    let mut config = Config { width: 90, height: 60, ..Config::new(look) };
    config.render.subdivisions = 2;
    change(&mut config);
    let assets = Assets::load(&config, &SetName::Staunton).unwrap();
    Stage::new(&config, &assets, Reach::default()).unwrap()
}

/// Kings on e1 and e8, with marks.
fn frame(marks: Marks) -> Frame {
    Frame { marks, ..Frame::still(Placement::from_fen("4k3/8/8/8/8/8/8/4K3").unwrap()) }
}

/// The board's colour at a point on or below its top.
fn color(board: &Object, point: DVec3) -> DVec3 {
    let (material, place) = board.material(point, DVec3::Y);
    board.color(material, place, 0.01)
}

/// Which of the squares have another colour than without marks, anywhere on a grid.
fn painted(stage: &Stage, marks: Marks) -> Vec<Square> {
    let [plain, marked] =
        [Marks::default(), marks].map(|marks| stage.scene(&frame(marks)).objects[0].clone());
    let grid = (0..20).flat_map(|x| (0..20).map(move |z| [x, z]));
    let offsets: Vec<DVec3> = grid
        .map(|at| at.map(|step| (f64::from(step) - 9.5) / 20.0 * 0.999 * SQUARE))
        .map(|[x, z]| DVec3::new(x, 0.0, z))
        .collect();
    let is_painted = |square: &Square| {
        let (file, rank) = (square.file() as u32, square.rank() as u32);
        let middle = DVec3::new(f64::from(file), 0.0, f64::from(rank)) * SQUARE;
        offsets
            .iter()
            .any(|offset| color(&plain, middle + offset) != color(&marked, middle + offset))
    };
    Square::ALL.into_iter().filter(is_painted).collect()
}

fn marks(circles: &[&str], arrows: &[&str]) -> Marks {
    Marks {
        circles: circles.iter().map(|text| text.parse::<Circle>().unwrap()).collect(),
        arrows: arrows.iter().map(|text| text.parse::<Arrow>().unwrap()).collect(),
        ..Marks::default()
    }
}

#[test]
fn paint_is_on_the_marked_squares_alone() {
    let last_move = Marks { last_move: vec![Square::D2, Square::D4], ..Marks::default() };
    let check = Marks { check: Some(Square::E8), ..Marks::default() };
    let mate = Marks { is_mate: true, ..check.clone() };
    let cases = [
        (last_move, vec!["d2", "d4"]),
        (check, vec!["e8"]),
        (mate, vec!["e8"]),
        (marks(&["Gd5", "Rh8"], &[]), vec!["d5", "h8"]),
        (marks(&[], &["Ga1a3"]), vec!["a1", "a2", "a3"]),
        // A shaft is wider than the corner where squares meet.
        (marks(&[], &["Ba1c3"]), vec!["a1", "a2", "b1", "b2", "b3", "c2", "c3"]),
        (marks(&[], &["Yb1c3"]), vec!["b1", "b2", "b3", "c3"]),
        // They begin and end outside the kings' feet, but within their squares.
        (marks(&[], &["Re1e3", "Re6e8"]), vec!["e1", "e2", "e3", "e6", "e7", "e8"]),
    ];
    // A moulded board, and one with a step.
    for theme in ["wood", "thesis"] {
        let stage = stage(Look::Studio, |config| config.theme = theme.to_owned());
        for (marks, squares) in &cases {
            let squares: Vec<String> = squares.iter().map(|name| (*name).to_owned()).collect();
            let mut found: Vec<String> =
                painted(&stage, marks.clone()).iter().map(Square::to_string).collect();
            found.sort();
            assert_eq!(found, squares, "{theme}: {marks:?}");
        }
    }
}

#[test]
fn paint_is_on_top_of_the_board_alone() {
    let stage = stage(Look::Studio, |config| config.theme = "thesis".to_owned());
    let [plain, marked] = [Marks::default(), marks(&[], &["Ra1a8"])]
        .map(|marks| stage.scene(&frame(marks)).objects[0].clone());
    let at = |y: f64| DVec3::new(0.0, y, 2.0 * SQUARE);
    assert_ne!(color(&plain, at(0.0)), color(&marked, at(0.0)));
    assert_eq!(color(&plain, at(-0.1)), color(&marked, at(-0.1)));
}

/// In linear light; in greys the four are told apart, too.
#[test]
fn brushes_have_their_colors() {
    let stage = stage(Look::Studio, |_| {});
    let shaft = DVec3::new(0.0, 0.0, 2.0 * SQUARE);
    let [green, red, yellow, blue] = ["G", "R", "Y", "B"].map(|brush| {
        let arrow = format!("{brush}a1a8");
        color(&stage.scene(&frame(marks(&[], &[&arrow]))).objects[0], shaft)
    });
    assert!(green.y > 2.0 * green.x && green.y > 2.0 * green.z, "{green}");
    assert!(red.x > 5.0 * red.y && red.x > 5.0 * red.z, "{red}");
    assert!(yellow.x > 5.0 * yellow.z && yellow.y > 5.0 * yellow.z, "{yellow}");
    assert!(blue.z > 4.0 * blue.x && blue.z > 4.0 * blue.y, "{blue}");
    let brightness = [blue, red, green, yellow].map(|c| c.dot(DVec3::new(0.21, 0.72, 0.07)));
    assert!(brightness.is_sorted() && brightness.windows(2).all(|pair| pair[1] > 1.4 * pair[0]));
}

#[test]
fn settings_leave_marks_out() {
    let all = Marks {
        last_move: vec![Square::D2],
        check: Some(Square::E8),
        is_mate: true,
        ..marks(&["Ga4"], &["Gh1h2"])
    };
    let names = |squares: Vec<Square>| squares.iter().map(Square::to_string).collect::<String>();
    let shown = |change: fn(&mut Config)| names(painted(&stage(Look::Studio, change), all.clone()));
    assert_eq!(shown(|_| {}), "h1d2h2a4e8");
    assert_eq!(shown(|config| config.marks.last_move = false), "h1h2a4e8");
    assert_eq!(shown(|config| config.marks.drawn = false), "d2e8");
    assert_eq!(
        shown(|config| (config.marks.check, config.marks.mate) = (false, false)),
        "h1d2h2a4"
    );
    // A mate is a check, too.
    assert_eq!(shown(|config| config.marks.mate = false), "h1d2h2a4e8");
    // The thesis knows none.
    assert_eq!(names(painted(&stage(Look::Thesis, |_| {}), all.clone())), "");
}

#[test]
fn mate_is_another_mark_than_check() {
    let at = |change: fn(&mut Config), place: DVec3| {
        let check = Marks { check: Some(Square::E8), is_mate: true, ..Marks::default() };
        let board = stage(Look::Studio, change).scene(&frame(check)).objects[0].clone();
        color(&board, DVec3::new(4.0, 0.0, 7.0) * SQUARE + place * SQUARE)
    };
    let corner = DVec3::new(0.38, 0.0, 0.38);
    // A stroke of the cross, where a glow is faint.
    assert!(at(|_| {}, corner).min_element() > 0.6);
    assert!(at(|config| config.marks.mate = false, corner).min_element() < 0.4);
}

/// How red a picture is, all pixels together.
fn redness(scene: &Scene) -> i64 {
    let picture = render(scene, 90, 60, Antialiasing::Grid(2)).0.into_rgb8();
    picture.pixels().map(|pixel| i64::from(pixel.0[0]) - i64::from(pixel.0[2])).sum()
}

/// A mirror leans over the board, and hides it from a camera that sees nothing else.
#[test]
fn marks_are_seen_in_a_mirror() {
    let text = "[Camera]\nPosition=14,30,-40\nLookAt=14,31,0\nFOV=30\n\
        [Model0]\nShape=box\nMin=-20,20,8\nMax=48,60,10\nRotation=-40,0,0\nMaterial=brass\n\
        [Material brass]\nColor=1,1,1\nRoughness=0\n";
    let config = Config::parse(text).unwrap();
    let stage = stage(Look::Studio, |settings| {
        *settings = Config { width: 90, height: 60, ..config.clone() };
    });
    let red = Square::ALL.map(|square| format!("R{square}"));
    let red: Vec<&str> = red.iter().map(String::as_str).collect();
    let [plain, marked] =
        [Marks::default(), marks(&red, &[])].map(|marks| redness(&stage.scene(&frame(marks))));
    assert!(marked > plain + 20_000, "{plain}, {marked}");
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let stage =
        stage(Look::Studio, |config| config.clock.show = lightsquare::config::ShowClock::Fixed);
    let scene = stage.scene(&frame(marks(&["Gd5"], &["Re1e8", "Bb1c3"])));
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| render(&scene, 90, 60, Antialiasing::Adaptive { rays: 4, threshold: 0.02 }))
    };
    assert_eq!(with(1), with(2));
}
