//! The sections and keys that a `config.ini` may have, and the range of each value.

use glam::DVec3;

use super::ini::{Entry, Section};
use super::{Camera, Config, Fault, Light, nearest};

/// The longest side of a picture, in pixels.
pub const MAX_SIDE: u32 = 16_384;

const MAX_LIGHTS: u32 = 100;

/// A key of a section about a `T`, and what its value does.
type Key<T> = (&'static str, fn(&mut T, &str) -> Result<(), Expected>);

/// What a value should have been.
type Expected = String;

const SECTIONS: [&str; 3] = ["GlobalSettings", "Camera", "Light0"];

/// `[GlobalSettings]`, with the two counts that only announce other sections.
#[derive(Default)]
struct Global {
    config: Config,
    light_count: Option<u32>,
}

const GLOBAL_KEYS: [Key<Global>; 6] = [
    ("ImageWidth", |global, text| {
        integer(text, 1, MAX_SIDE).map(|value| global.config.width = value)
    }),
    ("ImageHeight", |global, text| {
        integer(text, 1, MAX_SIDE).map(|value| global.config.height = value)
    }),
    ("BackgroundColor", |global, text| {
        triple(text, 0.0, 1.0).map(|value| global.config.background = value)
    }),
    ("LightCount", |global, text| {
        integer(text, 0, MAX_LIGHTS).map(|value| global.light_count = Some(value))
    }),
    // The thesis counts extra models here; there are none yet.
    ("ModelCount", |_, text| integer(text, 0, 0).map(|_| ())),
    ("SnellIndex", |global, text| {
        number(text, 1.0, 5.0).map(|value| global.config.snell_index = value)
    }),
];

const CAMERA_KEYS: [Key<Camera>; 4] = [
    ("Position", |camera, text| place(text).map(|value| camera.position = value)),
    ("LookAt", |camera, text| place(text).map(|value| camera.look_at = value)),
    ("FOV", |camera, text| number(text, 1.0, 340.0).map(|value| camera.fov = value)),
    ("ZRot", |camera, text| number(text, -360.0, 360.0).map(|value| camera.z_rot = value)),
];

#[derive(Default)]
struct LightSection {
    position: Option<DVec3>,
    color: Option<DVec3>,
}

const LIGHT_KEYS: [Key<LightSection>; 2] = [
    ("Position", |light, text| place(text).map(|value| light.position = Some(value))),
    ("Color", |light, text| triple(text, 0.0, 100.0).map(|value| light.color = Some(value))),
];

/// Turns sections into settings; whatever cannot be used is added to `faults`.
pub fn interpret(document: &[Section], faults: &mut Vec<Fault>) -> Config {
    let mut global = Global::default();
    let mut camera = global.config.camera;
    let mut camera_line = 0;
    let mut lights: Vec<(usize, u32, LightSection)> = Vec::new();
    let mut seen: Vec<String> = Vec::new();
    for section in document {
        let name = section.name.to_lowercase();
        if seen.contains(&name) {
            faults.push(Fault {
                line: section.line,
                message: format!("the section [{}] stands here a second time", section.name),
            });
            continue;
        }
        let light = name
            .strip_prefix("light")
            .and_then(|digits| digits.parse().ok().filter(|n: &u32| n.to_string() == digits));
        match (name.as_str(), light) {
            ("globalsettings", _) => read_section(section, &GLOBAL_KEYS, &mut global, faults),
            ("camera", _) => {
                camera_line = section.line;
                read_section(section, &CAMERA_KEYS, &mut camera, faults);
            }
            (_, Some(number)) => {
                let mut light = LightSection::default();
                read_section(section, &LIGHT_KEYS, &mut light, faults);
                lights.push((section.line, number, light));
            }
            _ => faults.push(Fault {
                line: section.line,
                message: unknown("section", section.name, SECTIONS),
            }),
        }
        seen.push(name);
    }
    if camera.position.distance(camera.look_at) < 1e-9 {
        faults.push(Fault {
            line: camera_line,
            message: "the camera's LookAt is its own Position, expected another point".to_owned(),
        });
    }
    let mut config = global.config;
    config.camera = camera;
    light_sections(&mut config, global.light_count, lights, faults);
    config
}

fn read_section<T>(section: &Section, keys: &[Key<T>], target: &mut T, faults: &mut Vec<Fault>) {
    let mut seen: Vec<&str> = Vec::new();
    for &Entry { line, key, value } in &section.entries {
        let known = keys.iter().find(|(name, _)| name.eq_ignore_ascii_case(key));
        let message = match known {
            None => Some(unknown("key", key, keys.iter().map(|(name, _)| *name))),
            Some((name, _)) if seen.contains(name) => {
                Some(format!("{name} is given here a second time in [{}]", section.name))
            }
            Some((name, apply)) => {
                seen.push(name);
                apply(target, value)
                    .err()
                    .map(|expected| format!("{name} is `{value}`, expected {expected}"))
            }
        };
        faults.extend(message.map(|message| Fault { line, message }));
    }
}

fn unknown<'a>(what: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("there is no {what} `{name}`, did you mean `{near}`?"),
        None => format!("there is no {what} `{name}`, expected one of {}", known.join(", ")),
    }
}

/// A file that speaks of lights describes all of them: as many sections as `LightCount` says.
fn light_sections(
    config: &mut Config,
    count: Option<u32>,
    sections: Vec<(usize, u32, LightSection)>,
    faults: &mut Vec<Fault>,
) {
    if count.is_none() && sections.is_empty() {
        return;
    }
    let highest = sections.iter().map(|(_, number, _)| number.saturating_add(1)).max();
    let count = count.or(highest).unwrap_or_default().min(MAX_LIGHTS);
    let mut lights: Vec<Option<Light>> = vec![None; count as usize];
    let mut described = vec![false; count as usize];
    for (line, number, section) in sections {
        let mut fault = |message| faults.push(Fault { line, message });
        let Some(light) = lights.get_mut(number as usize) else {
            fault(format!("there is a [Light{number}], but there are {count} lights"));
            continue;
        };
        described[number as usize] = true;
        match (section.position, section.color) {
            (Some(position), Some(color)) => *light = Some(Light { position, color }),
            (None, _) => fault(format!("[Light{number}] has no usable Position, expected one")),
            (_, None) => fault(format!("[Light{number}] has no usable Color, expected one")),
        }
    }
    for (number, _) in described.iter().enumerate().filter(|(_, described)| !**described) {
        let message = format!("{count} lights are spoken of, expected a section [Light{number}]");
        faults.push(Fault { line: 0, message });
    }
    config.lights = lights.into_iter().flatten().collect();
}

fn integer(text: &str, min: u32, max: u32) -> Result<u32, Expected> {
    text.parse().ok().filter(|value| (min..=max).contains(value)).ok_or_else(|| {
        if min == max { format!("{min}") } else { format!("a whole number from {min} to {max}") }
    })
}

fn number(text: &str, min: f64, max: f64) -> Result<f64, Expected> {
    text.parse()
        .ok()
        .filter(|value| (min..=max).contains(value))
        .ok_or_else(|| format!("a number from {min} to {max}"))
}

fn triple(text: &str, min: f64, max: f64) -> Result<DVec3, Expected> {
    let expected = || format!("three numbers from {min} to {max} with commas between them");
    let numbers: Vec<f64> = text
        .split(',')
        .map(|part| number(part.trim(), min, max))
        .collect::<Result<_, _>>()
        .map_err(|_| expected())?;
    <[f64; 3]>::try_from(numbers).map(DVec3::from).map_err(|_| expected())
}

/// A point of the world.
fn place(text: &str) -> Result<DVec3, Expected> {
    triple(text, -1e6, 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

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
            ("[GlobalSettings]\nModelCount=1", "line 2: ModelCount is `1`, expected 0"),
            (
                "[Camera]\nXyzzy=0",
                "line 2: there is no key `Xyzzy`, expected one of Position, LookAt, FOV, ZRot",
            ),
            ("[Camera]\nFOV=0", "line 2: FOV is `0`, expected a number from 1 to 340"),
            ("[Camera]\nFOV=90\nfov=80", "line 3: FOV is given here a second time in [Camera]"),
            ("[Camera]\nPosition=1,2,inf", "line 2: Position is `1,2,inf`, expected three numbers"),
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
                "line 1: [Light0] has no usable Color",
            ),
            (
                "[GlobalSettings]\nLightCount=0\n[Light0]\nPosition=0,1,0\nColor=1,1,1",
                "line 3: there is a [Light0], but there are 0 lights",
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
    fn the_thesis_excerpt_is_read_when_it_names_its_second_light() {
        let text = "[GlobalSettings]\r\nImageWidth=300\r\nImageHeight=300\r\n\
            BackgroundColor=0,0,0\r\nLightCount=2\r\nModelCount=0\r\nSnellIndex=1.0\r\n\
            [Light0]\r\nPosition=0,150,-50\r\nColor=0.8,0.8,0.8\r\n\
            [Light1]\r\nPosition=90, 90, 20\r\nColor=.5,.5,.5 ; ours\r\n\
            [Camera]\r\nPosition=45,15,-30\r\nLookAt=14,0,14\r\nFOV=90\r\nZRot=10\r\n";
        let config = Config::parse(text).unwrap();
        assert_eq!((config.width, config.height), (300, 300));
        assert_eq!(config.lights, Config::default().lights);
        assert_eq!(config.camera.z_rot, 10.0);
    }

    #[test]
    fn an_empty_file_is_the_default() {
        assert_eq!(Config::parse("\u{feff}; nothing\n").unwrap(), Config::default());
    }
}
