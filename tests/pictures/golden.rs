//! Small pictures as they were when somebody looked at them last.
//!
//! `LIGHTSQUARE_BLESS=1 cargo test --test pictures` takes the pictures of today instead, and fails
//! all the same, so that a blessing is seen; then look at them.

use std::path::Path;

use crate::{CLOCK, MAPPED, difference, letter, lightsquare, read};
use image::RgbImage;

const ITALIAN: &str = "r1bqkb1r/pppp1ppp/2n2n2/4p3/2B1P3/5N2/PPPP1PPP/RNBQK2R";

const CLOSE: &str = "[Camera]\nPosition=34,18,-22\nLookAt=18,1,4\nFOV=60\n";

const WOOD: &str = "[Pieces]\nWhite=boxwood\nBlack=walnut\n[Render]\nNormals=smooth\n";

const MARBLE: &str = "\
[Pieces]
White=white-marble
Black=black-marble
[Board]
Light=white-marble
Dark=black-marble
Table=walnut
";

const GLASS: &str = "\
[GlobalSettings]
BackgroundColor=0.3,0.34,0.4
[Render]
MaxDepth=8
[Pieces]
White=glass
Black=smoked-glass
[Board]
Table=boxwood
";

/// Seen from White's side, with names of files and ranks, knights in profile.
const COORDINATES: &str = "\
[Camera]
View=white
[Board]
Coordinates=yes
[Pieces]
Knights=left
";

/// Of the thesis's set and look: name, settings, antialiasing.
fn cases() -> Vec<(&'static str, String, &'static str)> {
    let filtered = |filter: &str| format!("{MAPPED}[Render]\nFilter={filter}\n");
    vec![
        ("thesis", String::new(), "none"),
        ("adaptive", String::new(), "adaptive"),
        ("wood", format!("{WOOD}{CLOSE}"), "grid"),
        ("marble", format!("{MARBLE}{CLOSE}"), "grid"),
        ("glass", format!("{GLASS}{CLOSE}"), "none"),
        ("coordinates", COORDINATES.to_owned(), "grid"),
        ("clock", format!("{CLOCK}[Render]\nFilter=mip\n"), "grid"),
        ("bitmaps-nearest", filtered("nearest"), "none"),
        ("bitmaps-bilinear", filtered("bilinear"), "none"),
        ("bitmaps-mip", filtered("mip"), "none"),
    ]
}

/// Of the default set and look: name, options.
const STUDIO: [(&str, &[&str]); 5] = [
    ("studio-wood", &["--quality", "normal"]),
    ("studio-marble", &["--theme", "marble", "--camera", "player", "--quality", "draft"]),
    ("studio-glass", &["--theme", "glass", "--camera", "side", "--quality", "draft"]),
    ("studio-tournament", &["--theme", "tournament", "--camera", "top", "--quality", "draft"]),
    ("studio-print", &["--theme", "print", "--transparent", "--quality", "normal"]),
];

/// Rounding may differ from machine to machine: so many steps of 255 may pixels be apart.
const STEPS: u8 = 2;

fn differs(found: &RgbImage, expected: &RgbImage) -> bool {
    difference(found, expected).iter().any(|apart| *apart > STEPS)
}

/// What was expected, what was found, and eight times their difference, side by side.
fn panels(expected: &RgbImage, found: &RgbImage) -> RgbImage {
    let (width, height) = expected.dimensions();
    RgbImage::from_fn(3 * width, height, |x, y| {
        let [a, b] = [expected, found].map(|picture| picture.get_pixel(x % width, y));
        match x / width {
            0 => *a,
            1 => *b,
            _ => image::Rgb([0, 1, 2].map(|c| a.0[c].abs_diff(b.0[c]).saturating_mul(8))),
        }
    })
}

#[test]
fn pictures_are_as_they_were_when_they_were_looked_at() {
    let mut complaints = Vec::new();
    for (name, settings, mode) in cases() {
        let thesis = ["--set", "thesis", "--look", "thesis", "--aa", mode];
        complaints.extend(complaint(name, &settings, &thesis));
    }
    for (name, options) in STUDIO {
        complaints.extend(complaint(name, "", options));
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

/// What is to be said of a picture, if anything.
fn complaint(name: &str, settings: &str, options: &[&str]) -> Option<String> {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let failures = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::write(here.join("settings.ini"), settings).unwrap();
    letter().save(here.join("letter.bmp")).unwrap();
    lightsquare(here)
        .args(["diagram", "--fen", ITALIAN, "-c", "settings.ini", "-q", "-o", "found.png"])
        .args(["--size", "200x120"])
        .args(options)
        .assert()
        .success();
    let (found, path) = (read(&here.join("found.png")), golden.join(format!("{name}.png")));
    if std::env::var_os("LIGHTSQUARE_BLESS").is_some() {
        std::fs::copy(here.join("found.png"), &path).unwrap();
        return Some(format!("{name} is blessed: look at {}", path.display()));
    }
    if !path.exists() {
        return Some(format!("{name} has no picture at {}", path.display()));
    }
    differs(&found, &read(&path)).then(|| {
        let shown = failures.join(format!("{name}.png"));
        panels(&read(&path), &found).save(&shown).unwrap();
        let shown = shown.display();
        format!("{name} differs: expected, found, 8 × the difference are in {shown}")
    })
}
