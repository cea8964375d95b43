//! The sections that a `config.ini` may have, and what holds between them.

use std::path::Path;

use super::checks::{PartLines, Use, check_material, check_materials};
use super::ini::Section;
use super::keys::{Key, Lines, key, read_section, show_section, unknown};
use super::values::{
    Choice, ColorOrTransparent, Integer, Name, Number, Optional, PLACE, Time, Triple, YES_NO,
};
use super::{
    CAPTURED, Clock, Config, FARTHEST, Fault, Filter, Knights, Light, MAX_RAYS, MAX_SIDE, Model,
    Normals, Render, Room, Sampling, Shading, Shape, ShowClock, View, WithoutTimes, camera,
    camera_path, captions, marks, material, model, theme,
};

const MAX_LIGHTS: u32 = 100;
const MAX_MODELS: u32 = 1000;

const SECTIONS: [&str; 14] = [
    "GlobalSettings",
    "Camera",
    "CameraPath",
    "Light0",
    "Room",
    "Model0",
    "Render",
    "Board",
    "Pieces",
    "Marks",
    "Clock",
    "Captions",
    "Material white",
    "Theme wood",
];

/// `[GlobalSettings]`, with the two counts that only announce other sections.
#[derive(Default)]
struct Global {
    config: Config,
    light_count: Option<u32>,
    model_count: Option<u32>,
}

const GLOBAL_KEYS: [Key<Global>; 7] = [
    key!("ImageWidth", Global, config.width: Integer(1, MAX_SIDE)),
    key!("ImageHeight", Global, config.height: Integer(1, MAX_SIDE)),
    key!("Theme", Global, config.theme: Name),
    key!("BackgroundColor", Global, config.parts.background: Optional(ColorOrTransparent)),
    key!("LightCount", Global, light_count: Optional(Integer(0, MAX_LIGHTS))),
    key!("ModelCount", Global, model_count: Optional(Integer(0, MAX_MODELS))),
    key!("SnellIndex", Global, config.snell_index: Number(1.0, 5.0)),
];

const LIGHT_KEYS: [Key<Light>; 4] = [
    key!("Position", Light, position: PLACE),
    key!("Color", Light, color: Triple(0.0, 100.0)),
    key!("Width", Light, width: Number(0.0, 1e6)),
    key!("Height", Light, height: Number(0.0, 1e6)),
];

const ROOM_KEYS: [Key<Room>; 5] = [
    key!("Horizon", Room, horizon: Triple(0.0, 100.0)),
    key!("Sky", Room, sky: Triple(0.0, 100.0)),
    key!("Zenith", Room, zenith: Triple(0.0, 100.0)),
    key!("Bounce", Room, bounce: Number(0.0, 1.0)),
    key!("LightsTurn", Room, turns: YES_NO),
];

const RENDER_KEYS: [Key<Render>; 10] = [
    key!("Shading", Render, shading: SHADINGS),
    key!("Antialiasing", Render, sampling: SAMPLINGS),
    key!("Rays", Render, rays: Integer(1, MAX_RAYS)),
    key!("Threshold", Render, threshold: Number(0.0, 1.0)),
    key!("MaxDepth", Render, max_depth: Integer(0, 50)),
    key!("MaxDistance", Render, max_distance: Number(1.0, FARTHEST)),
    key!("Subdivisions", Render, subdivisions: Integer(0, 7)),
    key!("Normals", Render, normals: NORMALS),
    key!("Filter", Render, filter: FILTERS),
    key!("Plain", Render, plain: YES_NO),
];

const SHADINGS: Choice<Shading> = Choice(&[("phong", Shading::Phong), ("studio", Shading::Studio)]);

const SAMPLINGS: Choice<Sampling> = Choice(&[
    ("none", Sampling::None),
    ("grid", Sampling::Grid),
    ("adaptive", Sampling::Adaptive),
    ("0", Sampling::None),
    ("1", Sampling::Grid),
    ("2", Sampling::Adaptive),
]);

const NORMALS: Choice<Normals> = Choice(&[("flat", Normals::Flat), ("smooth", Normals::Smooth)]);

const FILTERS: Choice<Filter> =
    Choice(&[("nearest", Filter::Nearest), ("bilinear", Filter::Bilinear), ("mip", Filter::Mip)]);

const PIECES_KEYS: [Key<Config>; 4] = [
    key!("White", Config, parts.white: Optional(Name)),
    key!("Black", Config, parts.black: Optional(Name)),
    key!("Knights", Config, knights: KNIGHTS),
    key!("Captured", Config, captured: Choice(&CAPTURED)),
];

const KNIGHTS: Choice<Knights> = Choice(&[
    ("left", Knights::Left),
    ("right", Knights::Right),
    ("enemy", Knights::Enemy),
    ("kingside", Knights::Kingside),
]);

const CLOCK_KEYS: [Key<Clock>; 5] = [
    key!("Show", Clock, show: SHOW_CLOCK),
    key!("WithoutTimes", Clock, without_times: WITHOUT_TIMES),
    key!("White", Clock, white: Time),
    key!("Black", Clock, black: Time),
    key!("Case", Clock, case: Name),
];

const SHOW_CLOCK: Choice<ShowClock> =
    Choice(&[("no", ShowClock::No), ("yes", ShowClock::Fixed), ("game", ShowClock::Game)]);

const WITHOUT_TIMES: Choice<WithoutTimes> =
    Choice(&[("absent", WithoutTimes::Absent), ("moves", WithoutTimes::Moves)]);

/// A section with a number in its name.
struct Numbered<T> {
    number: u32,
    name: String,
    value: T,
    lines: Lines,
}

/// Turns sections into settings over those of `base`; whatever cannot be used is added to `faults`.
/// Files that are named are sought from `folder` on.
pub fn interpret(
    document: &[Section],
    base: Config,
    folder: &Path,
    faults: &mut Vec<Fault>,
) -> Config {
    let mut global = Global { config: base, ..Global::default() };
    let mut lights: Vec<Numbered<Light>> = Vec::new();
    let mut models: Vec<Numbered<Model>> = Vec::new();
    let mut uses: Vec<Use> = Vec::new();
    let mut global_lines = Lines::default();
    let mut part_lines: Vec<PartLines> = Vec::new();
    let mut seen: Vec<String> = Vec::new();
    let mut names_view = false;
    let mut path_line = None;
    for section in document {
        let words: Vec<String> = section.name.split_whitespace().map(str::to_lowercase).collect();
        let name = words.join(" ");
        if seen.contains(&name) {
            let message = format!("the section [{}] stands here a second time", section.name);
            faults.push(Fault { line: section.line, message });
            continue;
        }
        if name.contains('"') {
            let message = format!("[{}] has a quote in its name, expected none", section.name);
            faults.push(Fault { line: section.line, message });
            continue;
        }
        let config = &mut global.config;
        match name.as_str() {
            "globalsettings" => {
                global_lines = read_section(section, &GLOBAL_KEYS, &mut global, faults);
            }
            "camera" => names_view = camera::read(section, &mut config.camera, faults),
            "camerapath" => {
                camera_path::read(section, &mut config.camera, faults);
                path_line = Some(section.line);
            }
            "render" => {
                read_section(section, &RENDER_KEYS, &mut config.render, faults);
            }
            "room" => {
                read_section(section, &ROOM_KEYS, &mut config.room, faults);
            }
            "board" => {
                let lines = read_section(section, &theme::BOARD_KEYS, &mut config.parts, faults);
                part_lines.push((None, lines));
            }
            "pieces" => {
                let lines = read_section(section, &PIECES_KEYS, config, faults);
                part_lines.push((None, lines));
            }
            "marks" => {
                read_section(section, &marks::KEYS, &mut config.marks, faults);
            }
            _ if let Some(theme) = name.strip_prefix("theme ") => {
                let begin = config.themes.get(theme).or(config.themes.get(theme::BASE)).cloned();
                let parts =
                    config.themes.entry(theme.to_owned()).or_insert(begin.unwrap_or_default());
                let lines = read_section(section, &theme::keys(), parts, faults);
                part_lines.push((Some(theme.to_owned()), lines));
            }
            "clock" => {
                let lines = read_section(section, &CLOCK_KEYS, &mut config.clock, faults);
                uses.push(Use::new(&lines, "Case", &config.clock.case));
            }
            "captions" => {
                read_section(section, &captions::KEYS, &mut config.captions, faults);
            }
            "theme" | "material" => {
                let message = format!("[{}] has no name, expected one behind it", section.name);
                faults.push(Fault { line: section.line, message });
            }
            "material none" => {
                let message = "a material cannot be named none, expected another name".to_owned();
                faults.push(Fault { line: section.line, message });
            }
            _ if let Some(material) = name.strip_prefix("material ") => {
                let value = config.materials.entry(material.to_owned()).or_default();
                let lines = read_section(section, &material::KEYS, value, faults);
                check_material(value, section.name, folder, &lines, faults);
            }
            _ if let Some(number) = number_after(&name, "light") => {
                lights.push(numbered(section, number, &LIGHT_KEYS, faults));
            }
            _ if let Some(number) = number_after(&name, "model") => {
                let section: Numbered<Model> = numbered(section, number, &model::KEYS, faults);
                section.value.check(&section.name, &section.lines, faults);
                let used = Use::new(&section.lines, "Material", &section.value.material);
                let is_plane = section.value.shape == Shape::Plane;
                uses.push(if is_plane { used.on_plane() } else { used });
                models.push(section);
            }
            _ => faults.push(Fault {
                line: section.line,
                message: unknown("section", section.name, SECTIONS),
            }),
        }
        seen.push(name);
    }
    let Global { mut config, light_count, model_count } = global;
    for light in &lights {
        if let Some(missing) = light.lines.first_missing(&["Position", "Color"]) {
            let message = format!("[{}] has no {missing}, expected one", light.name);
            faults.push(Fault { line: light.lines.of(""), message });
        }
    }
    if let Some(lights) = counted(
        "Light",
        light_count.zip(Some(global_lines.of("LightCount"))),
        MAX_LIGHTS,
        lights,
        faults,
    ) {
        config.lights = lights;
    }
    if let Some(models) = counted(
        "Model",
        model_count.zip(Some(global_lines.of("ModelCount"))),
        MAX_MODELS,
        models,
        faults,
    ) {
        config.models = models;
    }
    if path_line.is_some() && !names_view {
        config.camera.view = View::Path;
    }
    if let Some(message) = camera_path::missing(&config.camera).filter(|_| path_line.is_none()) {
        faults.push(Fault { line: 0, message });
    }
    if !config.themes.contains_key(&config.theme) && !global_lines.failed("Theme") {
        let known = config.themes.keys().map(String::as_str);
        let message = format!("Theme: {}", unknown("theme", &config.theme, known));
        faults.push(Fault { line: global_lines.of("Theme"), message });
    }
    check_materials(&config, &part_lines, uses, faults);
    config
}

/// The number behind `word` in `name`, written plainly.
fn number_after(name: &str, word: &str) -> Option<u32> {
    let digits = name.strip_prefix(word)?;
    digits.parse().ok().filter(|number: &u32| number.to_string() == digits)
}

fn numbered<T: Default>(
    section: &Section,
    number: u32,
    keys: &[Key<T>],
    faults: &mut Vec<Fault>,
) -> Numbered<T> {
    let mut value = T::default();
    let lines = read_section(section, keys, &mut value, faults);
    Numbered { number, name: section.name.to_owned(), value, lines }
}

/// A file that speaks of lights (or models) describes all of them: as many sections as their count,
/// which stands in a line, says. `None` when it does not speak of them.
fn counted<T>(
    what: &str,
    count: Option<(u32, usize)>,
    max: u32,
    mut sections: Vec<Numbered<T>>,
    faults: &mut Vec<Fault>,
) -> Option<Vec<T>> {
    if count.is_none() && sections.is_empty() {
        return None;
    }
    let missing = |count: u32| {
        (0..count).find(|number| !sections.iter().any(|section| section.number == *number))
    };
    let mut fault = |line, message| faults.push(Fault { line, message });
    match count {
        Some((count, line)) => {
            for section in sections.iter().filter(|section| section.number >= count) {
                let message = format!("there is a [{}], but {what}Count is {count}", section.name);
                fault(section.lines.of(""), message);
            }
            if let Some(number) = missing(count) {
                let message =
                    format!("{what}Count is {count}, expected a section [{what}{number}]");
                fault(line, message);
            }
        }
        None => {
            for section in &sections {
                let Numbered { number, name, lines, .. } = section;
                if *number >= max {
                    let message = format!("there is a [{name}], expected numbers below {max}");
                    fault(lines.of(""), message);
                } else if let Some(number) = missing(*number) {
                    let message = format!("there is a [{name}], but no [{what}{number}]");
                    fault(lines.of(""), message);
                }
            }
        }
    }
    sections.sort_by_key(|section| section.number);
    Some(sections.into_iter().map(|section| section.value).collect())
}

/// Prints `config` so that [`interpret`] reads the same again.
pub fn show(config: &Config) -> String {
    let mut out = String::new();
    let global = Global {
        light_count: Some(config.lights.len() as u32),
        model_count: Some(config.models.len() as u32),
        config: config.clone(),
    };
    show_section("GlobalSettings", &GLOBAL_KEYS, &global, &mut out);
    for (number, light) in config.lights.iter().enumerate() {
        show_section(&format!("Light{number}"), &LIGHT_KEYS, light, &mut out);
    }
    show_section("Room", &ROOM_KEYS, &config.room, &mut out);
    show_section("Camera", &camera::KEYS, &config.camera, &mut out);
    camera_path::show(&config.camera, &mut out);
    show_section("Render", &RENDER_KEYS, &config.render, &mut out);
    show_section("Board", &theme::BOARD_KEYS, &config.parts, &mut out);
    show_section("Pieces", &PIECES_KEYS, config, &mut out);
    show_section("Marks", &marks::KEYS, &config.marks, &mut out);
    show_section("Clock", &CLOCK_KEYS, &config.clock, &mut out);
    show_section("Captions", &captions::KEYS, &config.captions, &mut out);
    for (number, model) in config.models.iter().enumerate() {
        show_section(&format!("Model{number}"), &model::KEYS, model, &mut out);
    }
    for (name, theme) in &config.themes {
        show_section(&format!("Theme {name}"), &theme::keys(), theme, &mut out);
    }
    for (name, material) in &config.materials {
        show_section(&format!("Material {name}"), &material::KEYS, material, &mut out);
    }
    out
}
#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Look, View};

    #[test]
    fn every_fault_is_reported_with_its_line() {
        let cases = [
            (
                "[GlobalSettings]\nImageWidht=3",
                "line 2: there is no key `ImageWidht`, did you mean `ImageWidth`?",
            ),
            ("[Global]\n", "line 1: there is no section `Global`, did you mean `GlobalSettings`?"),
            (
                "[GlobalSettings]\nImageWidth=-3",
                "line 2: ImageWidth is `-3`, expected a whole number from 1 to 16384",
            ),
            ("[GlobalSettings]\nImageWidth=NaN", "line 2: ImageWidth is `NaN`, expected"),
            ("[GlobalSettings]\nSnellIndex=nan", "line 2: SnellIndex is `nan`, expected a number"),
            (
                "[GlobalSettings]\nBackgroundColor=0,0",
                "line 2: BackgroundColor is `0,0`, expected three numbers from 0 to 1",
            ),
            (
                "[GlobalSettings]\nModelCount=1",
                "line 2: ModelCount is 1, expected a section [Model0]",
            ),
            ("[Model0]\nShape=cone", "line 2: Shape is `cone`, expected one of plane, sphere, box"),
            ("[Model0]\nShape=sphere\nCenter=0,0,0", "line 1: [Model0] has no Radius"),
            ("[Model0]\nShape=plane\nOrigin=0,0,0\nNormal=0,0,0", "line 4: Normal has no length"),
            (
                "[Model0]\nShape=sphere\nCenter=0,0,0\nRadius=1\nMin=0,0,0",
                "line 5: Min is for a box, which [Model0] is not",
            ),
            (
                "[Model0]\nShape=box\nMin=0,0,0\nMax=1,0,1",
                "line 4: Min is not below Max in each of its numbers",
            ),
            (
                "[Model0]\nShape=plane\nOrigin=0,0,0\nNormal=0,1,0\nMaterial=glass",
                "line 5: Material `glass` is transparent, expected another: a plane has no inside",
            ),
            ("[Board]\nTable=glass", "line 2: Table `glass` is transparent"),
            (
                "[Pieces]\nWhite=boxwod",
                "line 2: White: there is no material `boxwod`, did you mean `boxwood`?",
            ),
            ("[Material m]\nTexture=bitmap", "line 2: [Material m] has no Bitmap"),
            (
                "[Material m]\nTexture=bitmap\nBitmap=no/such.png",
                "line 3: the picture `no/such.png` is not there, expected a BMP or PNG file",
            ),
            (
                "[Material m]\nTexture=bitmap\nBitmap=docs/hero.png\nU=0,0,0",
                "line 4: U has no length, expected a direction",
            ),
            (
                "[Material m]\nTexture=bitmap\nBitmap=docs/hero.png\nU=0,0,2\nV=0,0,-1",
                "line 5: U and V have the same direction",
            ),
            (
                "[Material m]\nReflectivity=0.5\nTransparency=0.6",
                "line 3: Reflectivity and Transparency are 1.1 together, expected up to 1",
            ),
            ("[Material m]\nGrain=x", "line 2: Grain is for a texture of wood"),
            ("[Board]\nLight=c\n[Material c]\nTexture=chequer", "line 2: Light `c` is a chequer"),
            (
                "[GlobalSettings]\nTheme=thesis\n[Material light]\nTexture=chequer",
                "Light `light` is a chequer",
            ),
            ("[Theme]", "line 1: [Theme] has no name, expected one behind it"),
            ("[Theme \"a\"]", "line 1: [Theme \"a\"] has a quote in its name"),
            (
                "[Camera]\nView=sied",
                "player, mover, follow, thesis, free, path (did you mean `side`?)",
            ),
            ("[Camera]\nAperture=x\nFocus=1,2,3", "line 2: Aperture is `x`, expected a number"),
            (
                "[GlobalSettings]\nTheme=marbel",
                "line 2: Theme: there is no theme `marbel`, did you mean `marble`?",
            ),
            (
                "[Theme mine]\nLight=mapel",
                "line 2: Light: there is no material `mapel`, did you mean `maple`?",
            ),
            ("[Theme glass]\nTable=glass", "line 2: Table `glass` is transparent"),
            (
                "[GlobalSettings]\nBackgroundColor=red",
                "line 2: BackgroundColor is `red`, expected three numbers from 0 to 1 with commas \
                 between them, or transparent",
            ),
            ("[Camera]\nFocus=1,2,3", "line 2: Focus is for a camera with an Aperture"),
            ("[Room]\nBounce=2", "line 2: Bounce is `2`, expected a number from 0 to 1"),
            ("[Material none]\n", "line 1: a material cannot be named none"),
            (
                "[Material a]\n[Material  A]\n",
                "line 2: the section [Material  A] stands here a second",
            ),
            ("[Light4294967295]\nPosition=0,1,0\nColor=1,1,1", "expected numbers below 100"),
            (
                "[Light5]\nPosition=0,1,0\nColor=1,1,1",
                "line 1: there is a [Light5], but no [Light0]",
            ),
            ("[Clock]\nWhite=61:00", "line 2: White is `61:00`, expected a time"),
            (
                "[Clock]\nShow=gmae",
                "line 2: Show is `gmae`, expected one of no, yes, game (did you mean `game`?)",
            ),
            ("[Marks]\nArrows=yes", "line 2: there is no key `Arrows`, expected one of LastMove"),
            ("[Marks]\nCheck=maybe", "line 2: Check is `maybe`, expected one of yes, no"),
            (
                "[Camera]\nXyzzy=0",
                "line 2: there is no key `Xyzzy`, expected one of View, Orientation, Aperture",
            ),
            ("[Camera]\nFOV=0", "line 2: FOV is `0`, expected a number from 1 to 340"),
            ("[Camera]\nFOV=90\nfov=80", "line 3: FOV is given here a second time in [Camera]"),
            ("[Camera]\nPosition=1,2,inf", "line 2: Position is `1,2,inf`, expected three numbers"),
            (
                "[Camera]\nView=wite\nFOV=80",
                "line 2: View is `wite`, expected one of white, black, top",
            ),
            (
                "[Camera]\nFOV=80\nView=top",
                "line 2: FOV is for a camera with View=free, which [Camera] is not",
            ),
            ("[Pieces]\nKnights=up", "line 2: Knights is `up`, expected one of left, right, enemy"),
            ("[Camera]\nPosition=14,0,14", "line 1: the camera's LookAt is its own Position"),
            ("[Camera]\n[Camera]\n", "line 2: the section [Camera] stands here a second time"),
            ("ZRot=10", "line 1: `ZRot=10` stands before the first [section]"),
            ("[Camera]\n\nZRot", "line 3: `ZRot` is neither a [section] nor a key=value"),
            (
                "[GlobalSettings]\nLightCount=2\n[Light0]\nPosition=0,1,0\nColor=1,1,1",
                "expected a section [Light1]",
            ),
            (
                "[Light0]\nPosition=0,1,0\n[Light1]\nPosition=0,1,0\nColor=1,1,1",
                "line 1: [Light0] has no Color",
            ),
            (
                "[GlobalSettings]\nLightCount=0\n[Light0]\nPosition=0,1,0\nColor=1,1,1",
                "line 3: there is a [Light0], but LightCount is 0",
            ),
        ];
        for (text, message) in cases {
            let error = Config::parse(text).unwrap_err().to_string();
            assert!(error.contains(message), "{text:?} gave {error:?}");
        }
    }

    #[test]
    fn all_faults_come_together_in_the_order_of_their_lines() {
        let text = "[Camera]\nFOV=x\n[GlobalSettings]\nImageWidth=0\nrubbish\n";
        let lines: Vec<usize> =
            Config::parse(text).unwrap_err().faults.iter().map(|fault| fault.line).collect();
        assert_eq!(lines, [2, 4, 5]);
    }

    #[test]
    fn what_follows_from_a_fault_is_no_fault() {
        let cone = "[Model0]\nShape=cone\nMin=0,0,0\nMax=1,1,1";
        assert_eq!(Config::parse(cone).unwrap_err().faults.len(), 1);
    }

    #[test]
    fn the_thesis_excerpt_is_read_when_it_names_its_second_light() {
        let text = "[GlobalSettings]\r\nImageWidth=300\r\nImageHeight=300\r\n\
            BackgroundColor=0,0,0\r\nLightCount=2\r\nModelCount=0\r\nSnellIndex=1.0\r\n\
            [Light0]\r\nPosition=0,150,-50\r\nColor=0.8,0.8,0.8\r\n\
            [Light1]\r\nPosition=90, 90, 20\r\nColor=.5,.5,.5 ; ours\r\n\
            [Camera]\r\nPosition=45,15,-30\r\nLookAt=14,0,14\r\nFOV=90\r\nZRot=10\r\n";
        let config = Config::parse(text).unwrap();
        assert_eq!((config.width, config.height), (300, 300));
        assert_eq!(config.lights, Config::new(Look::Thesis).lights);
        assert_eq!((config.camera.view, config.camera.pose.z_rot), (View::Free, 10.0));
    }

    #[test]
    fn what_is_printed_is_read_the_same() {
        let text = "[GlobalSettings]\nImageWidth=7\n[Light0]\nPosition=1,2.5,-3e2\nColor=1,0.1,0\n\
            [Camera]\nZRot=-0.1\n[Render]\nAntialiasing=2\nFilter=mip\n[Board]\nTable=Walnut\n\
            [Pieces]\nWhite=own\n[Clock]\nShow=yes\nWhite=1:02:03\nWithoutTimes=absent\n[Marks]\nCheck=no\nBlue=0,0,1\n\
            [Theme club]\n[Room]\nLightsTurn=no\n\
            [Model0]\nShape=plane\nOrigin=0,-9,0\nNormal=0,1,0\nMaterial=floor\n\
            [Model1]\nShape=box\nMin=0,0,0\nMax=1,1,1\nRotation=0,45,0\n\
            [Material own]\nTexture=marble\nOctaves=3\n[Material white]\nShininess=7\n\
            [Material floor]\nTexture=bitmap\nBitmap=docs/hero.png\nMapping=spherical\nU=0,0,2\n";
        let looks = [Config::default(), Config::new(Look::Thesis)];
        for config in [looks[0].clone(), looks[1].clone(), Config::parse(text).unwrap()] {
            let printed = config.to_ini();
            for base in looks.clone() {
                let again = base.with(&printed, Path::new("")).unwrap();
                // Beside the settings a look has materials of its own, all printed, but not those that
                // mean nothing to others.
                assert_eq!(again.to_ini(), printed);
                assert_eq!(again.scheme(), config.scheme());
                let settings = |config: Config| Config { materials: [].into(), ..config };
                assert_eq!(settings(again), settings(config.clone()));
            }
        }
    }

    #[test]
    fn an_empty_file_is_the_default() {
        assert_eq!(Config::parse("\u{feff}; nothing\n").unwrap(), Config::default());
    }
}
