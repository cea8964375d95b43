//! Our pictures beside those that POV-Ray makes of the same scenes, one ray through each pixel's
//! middle. Where there is no `povray`, a word says so and nothing is compared.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;

use crate::{CLOCK, MAPPED, difference, letter, lightsquare, read};
use glam::{DAffine3, DVec2, DVec3};
use image::RgbImage;
use lightsquare::config::{Coat, Config, Finish, Look, Pose};
use lightsquare::export::pov;
use lightsquare::geometry::transform::{rotation_x, rotation_y, translation};
use lightsquare::geometry::{
    ControlPoint, Csg, Cuboid, Lathe, Normals, Outline, Prism, Profile, Sphere,
};
use lightsquare::scene::{Camera, Cells, Material, Object, Scene, Surface, Texture};
use lightsquare::tracer::{Antialiasing, render};

const OPERA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/games/opera-1858.pgn");

const GLASS_BALL: &str = "\
[GlobalSettings]
BackgroundColor=0.5,0.6,0.7
[Render]
MaxDepth=12
[Model0]
Shape=sphere
Material=glass
Center=14,5,14
Radius=5
[Camera]
Position=14,9,-20
LookAt=14,4,14
FOV=60
";

/// Nothing bends, and the limit of depth is met.
const CLEAR: &str = "\
[GlobalSettings]
BackgroundColor=0.3,0.35,0.4
SnellIndex=1
[Render]
MaxDepth=2
[Pieces]
White=glass
Black=smoked-glass
[Camera]
Position=34,16,-24
LookAt=13,2,2
FOV=60
";

const ABOVE: &str = "[Camera]\nPosition=14,60,14\nLookAt=14,0,14\nFOV=80\n";

/// In parallel projection.
const TOP: &str = "[Camera]\nView=top\nOrientation=black\n";

fn has_povray() -> bool {
    let found = Command::new("povray").arg("--version").output().is_ok();
    if !found {
        // Said past the harness, which keeps what tests print.
        let _ = writeln!(std::io::stderr(), "skipped: there is no povray to compare with");
    }
    found
}

/// POV-Ray's picture of `folder`/scene.pov.
fn by_povray(folder: &Path, [width, height]: [u32; 2]) -> RgbImage {
    let output = Command::new("povray")
        .args(["+Iscene.pov", "+Opov.png", "-A", "-D"])
        .args([format!("+W{width}"), format!("+H{height}")])
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "povray failed:\n{messages}");
    read(&folder.join("pov.png"))
}

/// So many pixels in a thousand may differ, and only where a hair decides what is seen: POV-Ray
/// must have seen there what we see in one of the pixels round it.
const PER_MILLE: usize = 2;

fn assert_agreement(name: &str, ours: &RgbImage, theirs: &RgbImage) {
    let (width, height) = ours.dimensions();
    let difference = difference(ours, theirs);
    let beyond = difference.iter().filter(|apart| **apart > 2).count();
    assert!(
        1000 * beyond <= PER_MILLE * difference.len(),
        "{name}: {beyond} of {} pixels differ",
        difference.len()
    );
    let mut unexplained = 0;
    for (index, _) in difference.iter().enumerate().filter(|(_, apart)| **apart > 2) {
        let (x, y) = (index as u32 % width, index as u32 / width);
        let round = (y.max(1) - 1..=(y + 1).min(height - 1))
            .flat_map(|row| (x.max(1) - 1..=(x + 1).min(width - 1)).map(move |col| (col, row)));
        let theirs = theirs.get_pixel(x, y).0;
        let is_between = (0..3).all(|channel| {
            let seen = round.clone().map(|(col, row)| ours.get_pixel(col, row).0[channel]);
            let (low, high) = seen.fold((255, 0), |(low, high), c| (c.min(low), c.max(high)));
            (low.saturating_sub(8)..=high.saturating_add(8)).contains(&theirs[channel])
        });
        unexplained += usize::from(!is_between);
    }
    assert!(unexplained <= 2 + beyond / 20, "{name}: {unexplained} of {beyond} are no edges");
}

/// The set whose pieces are not the thesis's, and its case; from close by.
const STAUNTON: &str = "staunton";

const CLOSE: &str = "[Camera]\nPosition=16,12,-22\nLookAt=14,2.2,12\nFOV=70\n";

#[test]
fn positions_look_as_povray_shows_them() {
    if !has_povray() {
        return;
    }
    let start = "rnbqkbnr/pppppppp/8/8/8/8/PPPPPPPP/RNBQKBNR";
    let cases: [(&str, &[&str], &str); 10] = [
        ("start", &["--fen", start], ""),
        ("opera, mate", &[OPERA, "--at", "17w"], ""),
        ("opera, long castling, from above", &[OPERA, "--at", "12w"], ABOVE),
        ("opera, in parallel projection", &[OPERA, "--at", "9w"], TOP),
        ("a moulded board", &["--white", "KE1PE2", "--theme", "wood"], ""),
        ("clear pieces", &["--white", "DD1PE2", "--black", "SD3"], CLEAR),
        ("bitmaps", &["--white", "KD1"], MAPPED),
        ("a glass ball", &["--white", "PA1", "--black", "KE8"], GLASS_BALL),
        ("the clock", &["--white", "KE1DD1PE2", "--black", "KE8PD4"], CLOCK),
        (STAUNTON, &["--white", "KE4DD4JC4", "--black", "SF4VG4PB4"], CLOSE),
    ];
    for (name, subject, settings) in cases {
        let is_large = ["", ABOVE, TOP, CLOSE].contains(&settings);
        let size = if is_large { [1000, 600] } else { [500, 300] };
        let folder = tempfile::tempdir().unwrap();
        let here = folder.path();
        std::fs::write(here.join("settings.ini"), settings).unwrap();
        letter().save(here.join("letter.bmp")).unwrap();
        let pixels = format!("{}x{}", size[0], size[1]);
        let picture = ["-c", "settings.ini", "--plain", "--aa", "none", "--size", &pixels, "-q"];
        let set = if name == STAUNTON { name } else { "thesis" };
        let look = [&picture[..], &["--set", set, "--look", "thesis"]].concat();
        for command in [["diagram", "-o", "ours.png"], ["export", "-o", "scene.pov"]] {
            lightsquare(here).args(command).args(subject).args(&look).assert().success();
        }
        assert_agreement(name, &read(&here.join("ours.png")), &by_povray(here, size));
    }
}

const MATTE: Finish = Finish {
    ambient: 0.2,
    diffuse: 0.6,
    specular: 0.3,
    shininess: 30.0,
    reflectivity: 0.0,
    transparency: 0.0,
};

fn object(solid: Csg, finish: Finish, color: [f64; 3], place: DAffine3) -> Object {
    let material =
        Material { finish, coat: Coat::default(), texture: Texture::Plain(color.into()) };
    let surface = Surface::Uniform(material);
    Object::placed(Arc::new(solid), place, surface)
}

fn control(points: &[(f64, f64, bool)]) -> Vec<ControlPoint> {
    points.iter().map(|&(x, y, corner)| ControlPoint { at: DVec2::new(x, y), corner }).collect()
}

/// A scene of what no piece has: prisms, and lathes that are cut.
fn carvings() -> Scene {
    let leaf = [
        (-2.0, 0.2, true),
        (0.0, -1.0, false),
        (2.5, 0.0, true),
        (1.0, 1.5, false),
        (1.2, 4.0, false),
        (-1.0, 3.0, false),
    ];
    let outline = Outline::new(control(&leaf)).unwrap();
    let prism = || Csg::leaf(Prism::new(&outline, 3, Normals::Flat, -0.8, 1.0).unwrap());
    let vase = [
        (0.0, 0.0, true),
        (1.5, 0.0, true),
        (0.4, 2.0, false),
        (1.8, 3.5, false),
        (1.0, 4.5, true),
        (0.0, 4.5, true),
    ];
    let profile = Profile::new(control(&vase)).unwrap();
    let lathe = || Csg::leaf(Lathe::new(&profile, 3, Normals::Flat).unwrap());
    let ball = |at: [f64; 3], radius: f64| Csg::leaf(Sphere { center: at.into(), radius });
    let block = Csg::leaf(Cuboid::centered(DVec3::new(0.6, 9.0, 9.0)));
    let floor = Csg::leaf(Cuboid {
        min: DVec3::new(-20.0, -1.0, -20.0),
        max: DVec3::new(20.0, -0.01, 30.0),
    });
    let clear = Finish { transparency: 0.8, diffuse: 0.1, ambient: 0.05, ..MATTE };
    let at = |x: f64, z: f64| translation(DVec3::new(x, 1.0, z));
    let carved = lathe().minus(ball([1.0, 3.0, -1.0], 1.0)).minus(block.placed(rotation_y(40.0)));
    let crossed = prism().and(lathe().placed(rotation_x(20.0))).or(ball([0.0, 4.0, 0.0], 0.7));
    Scene {
        objects: vec![
            object(floor, Finish { reflectivity: 0.2, ..MATTE }, [0.5, 0.5, 0.4], at(0.0, 0.0)),
            object(prism(), MATTE, [0.8, 0.3, 0.2], at(-6.0, 4.0) * rotation_y(30.0)),
            object(carved, MATTE, [0.2, 0.6, 0.3], at(-1.5, 0.0)),
            object(crossed, MATTE, [0.3, 0.3, 0.8], at(4.0, 1.0) * rotation_y(-20.0)),
            object(lathe().minus(ball([0.0, 4.5, 0.0], 0.8)), clear, [0.9; 3], at(7.0, -4.0)),
            object(lathe(), MATTE, [0.7, 0.7, 0.2], at(6.0, 9.0)),
        ],
        lights: Config::new(Look::Thesis).lights,
        camera: Camera::free(&Pose {
            position: DVec3::new(2.0, 10.0, -22.0),
            look_at: DVec3::new(1.0, 2.5, 2.0),
            fov: 80.0,
            z_rot: -5.0,
        }),
        room: None,
        cells: Cells::default(),
        background: Some(DVec3::new(0.3, 0.4, 0.5)),
        max_depth: 8,
        min_weight: 1.0 / 1024.0,
        max_distance: 1e9,
        snell_index: 1.4,
    }
}

#[test]
fn carved_bodies_look_as_povray_shows_them() {
    if !has_povray() {
        return;
    }
    let scene = carvings();
    let folder = tempfile::tempdir().unwrap();
    let [width, height] = [500, 300];
    let written = pov(&scene, width, height, "scene");
    assert!(written.bitmaps.is_empty());
    std::fs::write(folder.path().join("scene.pov"), written.text).unwrap();
    let (ours, _) = render(&scene, width, height, Antialiasing::None);
    let theirs = by_povray(folder.path(), [width, height]);
    assert_agreement("carvings", &ours.into_rgb8(), &theirs);
}
