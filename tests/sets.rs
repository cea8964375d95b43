//! Piece sets: what the built-in ones hold to, and what is said of files that make none.

use std::fs;
use std::path::Path;

use glam::DVec3;
use lightsquare::assets::{PieceSet, SetName, piece_set};
use lightsquare::geometry::{Bounds, Csg, Interval, Normals, Ray, Solid};
use tempfile::TempDir;

/// World units of a millimetre.
const MILLIMETRE: f64 = 4.0 / 57.0;

const BUILT_IN: [SetName; 2] = [SetName::Staunton, SetName::Thesis];

fn built(set: &SetName) -> PieceSet {
    piece_set(set, 4, Normals::Flat).unwrap()
}

fn all(set: &PieceSet) -> [(&'static str, &Csg); 6] {
    [
        ("king", &set.king),
        ("queen", &set.queen),
        ("bishop", &set.bishop),
        ("knight", &set.knight),
        ("rook", &set.rook),
        ("pawn", &set.pawn),
    ]
}

/// The farthest that rays from `direction` (along an axis) find of a piece, from the origin.
fn extent(piece: &Csg, direction: DVec3) -> f64 {
    let Bounds { min, max } = piece.bounds();
    let share = |step: i32| 0.01 * (f64::from(step) + 0.5);
    let grid = (0..100).flat_map(|a| (0..100).map(move |b| (share(a), share(b))));
    let hits = grid.filter_map(|(a, b)| {
        let [side, other] = match direction {
            DVec3::Y => [DVec3::X, DVec3::Z],
            _ => [DVec3::Y, direction.cross(DVec3::Y)],
        };
        let across = |axis: DVec3, share: f64| {
            let (low, high) = ((min * axis).element_sum(), (max * axis).element_sum());
            axis * (low + (high - low) * share)
        };
        let origin = direction * 9.0 + across(side, a) + across(other, b);
        let ray = Ray { origin, direction: -direction };
        piece.nearest(&ray, Interval::AHEAD).map(|hit| 9.0 - hit.t)
    });
    hits.fold(0.0, f64::max)
}

/// The diameter of what stands on the board, in world units.
fn base(piece: &Csg) -> f64 {
    let ray = Ray { origin: DVec3::new(0.0, 0.1, 9.0), direction: DVec3::NEG_Z };
    2.0 * (9.0 - piece.nearest(&ray, Interval::AHEAD).unwrap().t)
}

#[test]
fn heights_follow_the_equipment_standard() {
    for set in &BUILT_IN {
        let heights = [95.0, 85.0, 70.0, 60.0, 55.0, 50.0];
        for ((name, piece), height) in all(&built(set)).into_iter().zip(heights) {
            let found = extent(piece, DVec3::Y) / MILLIMETRE;
            assert!((found - height).abs() < 0.02 * height, "{set} {name}: {found} mm");
        }
    }
}

#[test]
fn bases_are_in_proportion() {
    // Base through height; the thesis's keeps to 40 to 50 %, real sets have wider small pieces.
    let shares = [0.44, 0.46, 0.49, 0.56, 0.61, 0.59];
    for ((name, piece), share) in all(&built(&SetName::Staunton)).into_iter().zip(shares) {
        let found = base(piece) / extent(piece, DVec3::Y);
        assert!((found - share).abs() < 0.015, "{name}: {found}");
    }
    for (name, piece) in all(&built(&SetName::Thesis)) {
        let found = base(piece) / extent(piece, DVec3::Y);
        assert!((0.40..=0.51).contains(&found), "thesis {name}: {found}");
    }
    for set in &BUILT_IN {
        let of_square = base(&built(set).king) / 4.0;
        assert!((0.7..0.8).contains(&of_square), "{set}: {of_square}");
    }
}

#[test]
fn a_diagonal_mover_clears_any_two_neighbours() {
    for set in &BUILT_IN {
        let sides = [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z];
        let mut reaches = all(&built(set)).map(|(_, piece)| {
            sides.map(|side| extent(piece, side)).into_iter().fold(0.0, f64::max)
        });
        reaches.sort_by(f64::total_cmp);
        let widest = reaches[4] + reaches[5];
        assert!(widest < 8.0_f64.sqrt(), "{set}: {widest}");
    }
}

#[test]
fn knights_face_x_and_kings_show_their_cross_from_the_side() {
    let PieceSet { knight, king, .. } = built(&SetName::Staunton);
    assert!(extent(&knight, DVec3::X) > extent(&knight, DVec3::NEG_X) + 0.1);
    let arm = DVec3::new(0.045, 0.955, 0.0) * 95.0 * MILLIMETRE;
    assert!(king.contains(arm) && !king.contains(DVec3::new(0.0, arm.y, arm.x)));
}

#[test]
fn sets_can_be_built_as_coarse_and_as_fine_as_settings_allow() {
    for set in &BUILT_IN {
        for subdivisions in [0, 1, 2, 3, 5, 7] {
            if let Err(error) = piece_set(set, subdivisions, Normals::Smooth) {
                panic!("{subdivisions} steps: {error}");
            }
        }
    }
}

/// A copy of the built-in set in a folder.
fn copied() -> TempDir {
    let folder = TempDir::new().unwrap();
    let set = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/assets/sets/staunton");
    for file in fs::read_dir(set).unwrap() {
        let file = file.unwrap();
        fs::copy(file.path(), folder.path().join(file.file_name())).unwrap();
    }
    folder
}

fn fault(folder: &TempDir) -> String {
    let name = SetName::Folder(folder.path().to_owned());
    match piece_set(&name, 4, Normals::Flat) {
        Ok(_) => "no fault".to_owned(),
        Err(error) => error.to_string(),
    }
}

/// A rook of one part.
const PEG: &str = "height = 55\n[piece]\n";

#[test]
fn what_makes_no_piece_is_told_with_its_line() {
    let heads: [(&str, &str); 8] = [
        ("[piece]\nsphere = 0.5", "line 1: the rook has no `height`, expected millimetres"),
        (
            "height = 5\n[piece]\nsphere = 1",
            "line 1: the rook: `height`: expected a number from 10",
        ),
        ("height = nan\n[piece]\nsphere = 1", "line 1: the rook: `height`: expected a number"),
        ("height = 55\n[body]\nsphere = 1", "line 1: the rook has no part [piece]"),
        (
            "height = 55\nwidth = 3\n[piece]\nsphere = 1",
            "line 2: the rook: `width`: expected a table",
        ),
        ("height = 55\n[piece\n", "line 2: "),
        ("height = 55\nheight = 60", "line 2: duplicate key"),
        ("height = 55\n[piece]\n", "line 2: the rook has no shape, expected one of lathe, prism"),
    ];
    let parts: [(&str, &str); 34] = [
        (
            "union = ['eye']\n[eye]\nspher = 1",
            "line 5: the rook's part `eye`: there is no shape `spher`, did you mean `sphere`?",
        ),
        ("at = [0, 1, 0]", "line 2: the rook has no shape"),
        ("sphere = 1\nbox = [1, 1, 1]", "line 2: the rook has two shapes, `sphere` and `box`"),
        ("sphere = 1\ncolour = 3", "line 4: the rook: there is no key `colour`"),
        ("sphere = 1\nhalf = 3", "line 4: the rook: `half` is for a prism"),
        ("sphere = -1", "line 3: the rook: `sphere`: expected a number from 0 to 10"),
        ("sphere = 0", "line 3: the rook: `sphere`: expected a radius above 0"),
        ("sphere = '1'", "line 3: the rook: `sphere`: expected a number"),
        ("box = [1, 0, 1]", "line 3: the rook: `box`: expected three half-sizes above 0"),
        ("box = [1, 1]", "line 3: the rook: `box`: expected three numbers"),
        (
            "sphere = 1\nscale = [1, 0, 1]",
            "line 4: the rook: `scale`: expected factors from 0.001 to 1000",
        ),
        ("sphere = 1\nscale = [1, inf, 1]", "line 4: the rook: `scale`: expected three numbers"),
        ("sphere = 1\naround = 1.5", "line 4: the rook: `around`: expected a whole number"),
        (
            "sphere = 1\naround = 1000",
            "line 4: the rook: `around`: expected a number from 1 to 360",
        ),
        ("sphere = 1\nboth = 1", "line 4: the rook: `both`: expected true or false"),
        ("union = []", "line 3: the rook: `union`: expected at least 1 part"),
        (
            "difference = [{ sphere = 1 }]",
            "line 3: the rook: `difference`: expected at least 2 parts",
        ),
        ("union = [\n  3,\n]", "line 3: the rook: `union`: expected a list of names of parts"),
        (
            "union = [\n  'boddy',\n]\n[body]\nsphere = 1",
            "line 4: the rook: there is no part `boddy`, did you mean `body`?",
        ),
        (
            "union = [\n  { spere = 1 },\n]",
            "line 4: the rook: there is no shape `spere`, did you mean `sphere`?",
        ),
        (
            "union = ['a']\n[a]\nunion = ['b']\n[b]\npart = 'a'",
            "line 6: the rook's part `b`: the part `a` contains itself",
        ),
        ("sphere = 1\n[ears]\nsphere = 1", "line 4: the rook's part `ears` is used nowhere"),
        (
            "intersection = [{ sphere = 1 }, { sphere = 1, at = [3, 0, 0] }]",
            "line 2: the rook: its parts have nothing in common",
        ),
        (
            "union = [{ part = 'a', around = 300 }]\n[a]\nsphere = 1\nat = [1, 0, 0]\nboth = true",
            "line 3: the rook: it is made of 600 solids, expected up to 500",
        ),
        (
            "prism = '0,0* 1,0* 1,1*'",
            "line 2: the rook is a prism, expected `half`, or `from` and `to`",
        ),
        (
            "prism = '0,0* 1,0* 1,1*'\nfrom = 1\nto = 1",
            "line 5: the rook: `to`: expected more than `from`",
        ),
        (
            "prism = '0,0* 2,2* 2,0* 0,2*'\nhalf = 1",
            "line 3: the rook: the curve crosses or touches itself",
        ),
        (
            "lathe = '''\n0,0*\n.3,0*\n-.2,.5\n0,1*'''",
            "line 6: the rook: point 3 of the profile has the radius -0.2",
        ),
        (
            "lathe = '''\n0,0*\n.3,0*\n.2,1*\n'''",
            "line 6: the rook: a profile begins and ends on its axis",
        ),
        (
            "lathe = '''\n.1,0* .3,0*\n0,1*\n'''",
            "line 4: the rook: a profile begins and ends on its axis",
        ),
        (
            "lathe = '''\n0,0* .3,0* # the foot\n.2;.3\n'''",
            "line 5: the rook: `.2;.3` is no point, expected two numbers",
        ),
        (
            "lathe = '0,0* nan,1 0,1*'",
            "line 3: the rook: `nan,1` is no point, expected two numbers",
        ),
        ("lathe = '0,0* 99,1 0,1*'", "line 3: the rook: `99,1` is no point"),
        (
            "lathe = '''\nbase:0.2\nbasse:0.2\n'''",
            "line 5: the rook: there is no curve `basse`, did you mean `base`?",
        ),
    ];
    let heads = heads.map(|(text, message)| (text.to_owned(), message));
    let parts = parts.map(|(text, message)| (format!("{PEG}{text}"), message));
    let folder = copied();
    for (text, message) in heads.into_iter().chain(parts) {
        fs::write(folder.path().join("rook.toml"), &text).unwrap();
        let fault = fault(&folder);
        let place = format!("{}: {message}", folder.path().join("rook.toml").display());
        assert!(fault.starts_with(&place), "{text}\ngives {fault}\nnot   {message}");
    }
    // What all these are faulty beside.
    fs::write(folder.path().join("rook.toml"), format!("{PEG}sphere = 0.5\nat = [0, 0.5, 0]"))
        .unwrap();
    assert_eq!(fault(&folder), "no fault");
}

#[test]
fn what_cannot_stand_on_a_square_is_no_piece() {
    let nothing = "its parts leave nothing, expected a body";
    let cases = [
        ("difference = [{ sphere = 0.5 }, { sphere = 0.6 }]", nothing),
        ("intersection = [{ sphere = 0.3 }, { sphere = 0.3, at = [0.5, 0.5, 0] }]", nothing),
        ("sphere = 0.5", "its top is at y = 0.500, expected 1"),
        ("sphere = 0.3\nat = [0, 0.7, 0]", "its foot is at y = 0.400, expected 0"),
        ("sphere = 0.5\nat = [0.4, 0.5, 0]", "it reaches 0.8"),
    ];
    let folder = copied();
    for (part, message) in cases {
        fs::write(folder.path().join("rook.toml"), format!("{PEG}{part}")).unwrap();
        let fault = fault(&folder);
        assert!(fault.contains(&format!("the rook: {message}")), "{part} gives {fault}");
    }
}

#[test]
fn nothing_is_too_much_to_be_refused() {
    let folder = copied();
    let rook = folder.path().join("rook.toml");
    let chain: String =
        (0..100).map(|n| format!("[a{n}]\nunion = ['a{}']\n", n + 1)).collect::<Vec<_>>().concat();
    let doubled: String =
        (0..10).map(|n| format!("[a{n}]\nunion = ['a{0}', 'a{0}']\n", n + 1)).collect();
    let points: String = (0..300).map(|n| format!(".3,{:.3} ", 0.001 * f64::from(n))).collect();
    let inline = "{ union = [".repeat(200) + &"] }".repeat(200);
    let cases = [
        (format!("{PEG}part = 'a0'\n{chain}[a100]\nsphere = 1\n"), "more than 24 deep"),
        (format!("{PEG}part = 'a0'\n{doubled}[a10]\nsphere = 1\n"), "solids, expected up to 500"),
        (format!("{PEG}lathe = '{points}'\n"), "too many points, expected 200"),
        (format!("{PEG}union = [{inline}]\n"), "cannot recurse further"),
        (format!("{PEG}# {}", "x".repeat(300_000)), "is too large, expected at most 262144 bytes"),
    ];
    for (text, message) in cases {
        fs::write(&rook, text).unwrap();
        let fault = fault(&folder);
        assert!(fault.contains("rook.toml: ") && fault.contains(message), "{message}: {fault}");
    }
    let quoted = format!("{PEG}lathe = \"\\u001b[31m{}\"", "x".repeat(9999));
    fs::write(&rook, quoted).unwrap();
    let told = fault(&folder);
    assert!(told.len() < 600 && !told.contains('\u{1b}'), "{told}");
    fs::write(&rook, b"height = \xff").unwrap();
    assert!(fault(&folder).ends_with("rook.toml: is no text, expected UTF-8"));
}

#[test]
fn a_set_needs_all_its_files() {
    for file in ["set", "pawn", "knight", "bishop", "rook", "queen", "king"] {
        let folder = copied();
        let path = folder.path().join(format!("{file}.toml"));
        fs::remove_file(&path).unwrap();
        assert!(fault(&folder).starts_with(&format!("{}: no such file", path.display())));
        fs::create_dir(&path).unwrap();
        assert!(fault(&folder).starts_with(&format!("{}: is no file", path.display())));
    }
}

#[test]
fn a_set_of_curves_has_nothing_else() {
    let cases = [
        ("nmae = 'x'", "set.toml: line 1: the set: there is no key `nmae`, did you mean `name`?"),
        ("[curves]\nbase = 3", "set.toml: line 2: the set's curves: `base`: expected a string"),
        (
            "[curves]\nbase = 'foot:2'",
            "set.toml: line 2: the set's curves: there is no curve `foot`",
        ),
    ];
    let folder = copied();
    for (text, message) in cases {
        fs::write(folder.path().join("set.toml"), text).unwrap();
        let fault = fault(&folder);
        assert!(fault.contains(message), "{fault}");
    }
}

/// Runs the command in `folder`; exit code and messages.
fn run(folder: &Path, line: &str) -> (i32, String) {
    let output = assert_cmd::Command::cargo_bin("lightsquare")
        .unwrap()
        .current_dir(folder)
        .args(line.split(' '))
        .output()
        .unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_copy_of_the_set_gives_the_same_bytes() {
    let set = copied();
    let here = set.path();
    let king = "diagram --white KE1DD1JG1 --size 60x40 --aa none -q -o";
    assert_eq!(run(here, &format!("{king} built-in.png")).0, 0);
    assert_eq!(run(here, &format!("{king} copy.png --set .")).0, 0);
    assert_eq!(run(here, &format!("{king} thesis.png --set thesis")).0, 0);
    let bytes = |name: &str| fs::read(here.join(name)).unwrap();
    assert_eq!(bytes("built-in.png"), bytes("copy.png"));
    assert_ne!(bytes("built-in.png"), bytes("thesis.png"));
}

#[test]
fn the_files_of_a_set_are_never_written_over() {
    let set = copied();
    let here = set.path();
    fs::write(here.join("g.pgn"), "1. e4 *\n").unwrap();
    fs::create_dir(here.join("out")).unwrap();
    fs::create_dir(here.join("out/g")).unwrap();
    for file in fs::read_dir(here).unwrap().map(Result::unwrap) {
        let name = file.file_name();
        if Path::new(&name).extension().is_some_and(|ending| ending == "toml") {
            fs::copy(file.path(), here.join("out/g").join(name)).unwrap();
        }
    }
    let (code, message) = run(here, "render g.pgn --set out/g --size 8x8 -o out");
    assert_eq!(code, 1, "{message}");
    assert!(message.contains("lies in a folder that is written to"), "{message}");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("rook.toml", here.join("rook.png")).unwrap();
        let (code, message) = run(here, "diagram --white KE1 --set . --size 8x8 -o rook.png");
        assert_eq!(code, 1, "{message}");
        assert!(message.contains("rook.png: is the file that is read"), "{message}");
    }
}

#[test]
fn the_manifest_names_the_set() {
    let set = copied();
    let here = set.path();
    fs::create_dir(here.join("mine")).unwrap();
    for file in ["set", "pawn", "knight", "bishop", "rook", "queen", "king"] {
        let name = format!("{file}.toml");
        fs::rename(here.join(&name), here.join("mine").join(&name)).unwrap();
    }
    fs::write(here.join("g.pgn"), "1. e4 *\n").unwrap();
    for (option, name) in [("", "staunton"), (" --set thesis", "thesis"), (" --set mine", "mine")] {
        let line = format!("render g.pgn --size 8x8 --aa none -q -o {name}.out{option}");
        assert_eq!(run(here, &line).0, 0);
        let folder = here.join(format!("{name}.out/g"));
        let game = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let game = game.filter(|path| path.is_dir()).min().unwrap();
        let manifest = fs::read_to_string(game.join("game.json")).unwrap();
        let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
        assert_eq!(manifest["settings"]["set"], name);
    }
}

#[test]
fn the_example_of_the_docs_is_a_set() {
    let docs = include_str!("../docs/piece-sets.md");
    let example = |first: &str| {
        let begin = docs.find(&format!("```toml\n{first}")).unwrap() + "```toml\n".len();
        &docs[begin..begin + docs[begin..].find("```").unwrap()]
    };
    let folder = copied();
    fs::write(folder.path().join("pawn.toml"), example("height")).unwrap();
    assert_eq!(fault(&folder), "no fault");
    fs::write(folder.path().join("set.toml"), example("name")).unwrap();
    assert_eq!(fault(&folder), "no fault");
}
