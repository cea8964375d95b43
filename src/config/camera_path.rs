//! `[CameraPath]`: the camera's key frames, `when = position | look-at | FOV | roll`.

use std::fmt::{self, Write};

use serde::Serialize;

use super::camera::{Camera, Pose, View};
use super::ini::{Entry, Section};
use super::values::{Format, Number, PLACE};
use super::{Fault, camera};

/// Where the camera is at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct KeyFrame {
    pub at: When,
    #[serde(flatten)]
    pub pose: Pose,
}

/// A time of a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum When {
    /// Seconds from the film's beginning.
    Seconds(f64),
    /// The game's start.
    Start,
    /// When the position after a player's move of that number comes to rest.
    After { number: u32, is_blacks: bool },
    /// The game's end.
    End,
}

/// More key frames than any path needs.
const MAX_KEYS: usize = 10_000;

/// The longest time, in seconds.
const LATEST: f64 = 86_400.0;

impl When {
    /// Reads `2.5`, `17w`, `17b`, `start` or `end`, whatever the case.
    fn read(text: &str) -> Option<When> {
        let text = text.to_ascii_lowercase();
        let after = |suffix, is_blacks| {
            let number = text.strip_suffix(suffix)?.parse().ok().filter(|number| *number > 0)?;
            Some(When::After { number, is_blacks })
        };
        match text.as_str() {
            "start" => Some(When::Start),
            "end" => Some(When::End),
            _ => after("w", false).or_else(|| after("b", true)).or_else(|| {
                Number(0.0, LATEST)
                    .read(text.strip_suffix('s').unwrap_or(&text))
                    .ok()
                    .map(When::Seconds)
            }),
        }
    }

    /// Where it stands among times of its kind, where that is known without a game.
    fn order(self) -> (bool, f64) {
        match self {
            When::Seconds(seconds) => (true, seconds),
            When::Start => (false, f64::NEG_INFINITY),
            When::After { number, is_blacks } => {
                (false, f64::from(number) + if is_blacks { 0.5 } else { 0.0 })
            }
            When::End => (false, f64::INFINITY),
        }
    }
}

impl fmt::Display for When {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            When::Seconds(seconds) => write!(f, "{seconds}"),
            When::Start => f.write_str("start"),
            When::After { number, is_blacks } => {
                write!(f, "{number}{}", if *is_blacks { 'b' } else { 'w' })
            }
            When::End => f.write_str("end"),
        }
    }
}

impl Serialize for When {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Reads the section instead of what path `camera` has.
pub fn read(section: &Section, camera: &mut Camera, faults: &mut Vec<Fault>) {
    let mut path: Vec<KeyFrame> = Vec::new();
    let mut is_whole = true;
    for entry in &section.entries {
        match key_frame(entry, path.last()) {
            Ok(key) => path.push(key),
            Err(message) => {
                is_whole = false;
                faults.push(Fault { line: entry.line, message });
            }
        }
    }
    if path.is_empty() && is_whole {
        let message = "[CameraPath] has no key frames, expected lines such as \
                       `17w = 14,40,-30 | 14,0,14 | 60`";
        faults.push(Fault { line: section.line, message: message.to_owned() });
    }
    if path.len() > MAX_KEYS {
        let message =
            format!("[CameraPath] has {} key frames, expected at most {MAX_KEYS}", path.len());
        faults.push(Fault { line: section.line, message });
    }
    camera.path = path;
}

fn key_frame(entry: &Entry, before: Option<&KeyFrame>) -> Result<KeyFrame, String> {
    let Entry { key, value, .. } = entry;
    let at = When::read(key).ok_or_else(|| {
        format!(
            "`{key}` is no time of a film, expected seconds from 0 to {LATEST}, a move as in 17w or \
             17b, start or end"
        )
    })?;
    if let Some(before) = before {
        let (kind, order) = at.order();
        let (other, earlier) = before.at.order();
        if kind == other && order <= earlier {
            return Err(format!(
                "the key frame `{at}` stands behind `{}`, expected each later than the one before",
                before.at
            ));
        }
    }
    let expected = |what: &str| format!("the key frame `{at}` is `{value}`, expected {what}");
    let form = "position | look-at | FOV | roll, as in 14,40,-30 | 14,0,14 | 60 | 0 (roll may be left out)";
    let parts: Vec<&str> = value.split('|').map(str::trim).collect();
    let (position, look_at, fov, roll) = match parts[..] {
        [position, look_at, fov] => (position, look_at, fov, "0"),
        [position, look_at, fov, roll] => (position, look_at, fov, roll),
        _ => return Err(expected(form)),
    };
    let part = |name: &str, expects: String| expected(&format!("{expects} as its {name}"));
    let pose = Pose {
        position: PLACE.read(position).map_err(|expects| part("position", expects))?,
        look_at: PLACE.read(look_at).map_err(|expects| part("look-at", expects))?,
        fov: camera::FOV.read(fov).map_err(|expects| part("FOV", expects))?,
        z_rot: camera::ROLL.read(roll).map_err(|expects| part("roll", expects))?,
    };
    if pose.position.distance(pose.look_at) < 1e-3 {
        return Err(expected("another point to look at than its position"));
    }
    Ok(KeyFrame { at, pose })
}

/// Prints the section, where there is a path.
pub fn show(camera: &Camera, out: &mut String) {
    if camera.path.is_empty() {
        return;
    }
    // Writing to a string cannot fail.
    let _ = writeln!(out, "\n[CameraPath]");
    for KeyFrame { at, pose } in &camera.path {
        let place = |place| PLACE.show(place).unwrap_or_default();
        let (position, look_at) = (place(&pose.position), place(&pose.look_at));
        let _ = writeln!(out, "{at}={position} | {look_at} | {} | {}", pose.fov, pose.z_rot);
    }
}

/// That a view needs a path which is not there.
pub fn missing(camera: &Camera) -> Option<String> {
    let is_missing = camera.view == View::Path && camera.path.is_empty();
    is_missing
        .then(|| "the camera `path` needs a section [CameraPath], and there is none".to_owned())
}

#[cfg(test)]
mod tests {
    use super::super::Config;
    use super::*;

    fn read(lines: &str) -> Result<Vec<KeyFrame>, String> {
        let config = Config::parse(&format!("[CameraPath]\n{lines}"));
        config.map(|config| config.camera.path).map_err(|error| error.to_string())
    }

    #[test]
    fn key_frames_are_read_and_printed() {
        let text = "start = 0,1,2 | 3,4,5 | 60\n9W=1,1,2|3,4,5|60|-5\n9b = 2,1,2 | 3,4,5 | 1\n2.5s = \
                    3,1,2 | 3,4,5 | 340\nEND = 4,1,2 | 3,4,5 | 60";
        let path = read(text).unwrap();
        let times: Vec<String> = path.iter().map(|key| key.at.to_string()).collect();
        assert_eq!(times, ["start", "9w", "9b", "2.5", "end"]);
        assert_eq!((path[1].pose.z_rot, path[1].pose.fov), (-5.0, 60.0));
        let config = Config::parse(&format!("[CameraPath]\n{text}")).unwrap();
        assert_eq!(config.camera.view, View::Path);
        assert_eq!(Config::parse(&config.to_ini()).unwrap(), config);
        // Another view, told of in the file, stays.
        let named = Config::parse(&format!("[CameraPath]\n{text}\n[Camera]\nView=top")).unwrap();
        assert_eq!((named.camera.view, named.camera.path.len()), (View::Top, 5));
    }

    #[test]
    fn what_is_no_path_is_told_with_its_line() {
        let cases = [
            ("", "line 1: [CameraPath] has no key frames"),
            ("soon = 0,1,2 | 3,4,5 | 60", "line 2: `soon` is no time of a film, expected seconds"),
            ("-1 = 0,1,2 | 3,4,5 | 60", "line 2: `-1` is no time of a film"),
            ("0w = 0,1,2 | 3,4,5 | 60", "line 2: `0w` is no time of a film"),
            (
                "1 = 0,1,2 | 3,4,5",
                "the key frame `1` is `0,1,2 | 3,4,5`, expected position | look-at",
            ),
            ("1 = 0,1 | 3,4,5 | 60", "expected three numbers"),
            ("1 = 0,1,2 | 3,4,5 | 0", "expected a number from 1 to 340 as its FOV"),
            ("1 = 0,1,2 | 3,4,5 | 9 | 400", "expected a number from -360 to 360 as its roll"),
            ("1 = 0,1,2 | 0,1,2 | 60", "expected another point to look at than its position"),
            (
                "2 = 0,1,2 | 3,4,5 | 9\n1 = 0,1,2 | 3,4,5 | 9",
                "line 3: the key frame `1` stands behind `2`",
            ),
            (
                "9b = 0,1,2 | 3,4,5 | 9\n9w = 0,1,2 | 3,4,5 | 9",
                "line 3: the key frame `9w` stands behind `9b`",
            ),
            ("end = 0,1,2 | 3,4,5 | 9\n9w = 0,1,2 | 3,4,5 | 9", "`9w` stands behind `end`"),
        ];
        for (lines, message) in cases {
            let error = read(lines).unwrap_err();
            assert!(error.contains(message), "{lines:?} gave {error:?}");
        }
        let error = Config::parse("[Camera]\nView=path").unwrap_err().to_string();
        assert!(error.contains("needs a section [CameraPath]"), "{error}");
    }
}
