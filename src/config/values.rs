//! How the values of keys are written: what is accepted, what is expected, and how it is printed.

use std::path::PathBuf;

use glam::DVec3;

use super::nearest;

/// What a value should have been.
pub type Expected = String;

/// A way to write values of a type.
pub trait Format<V> {
    /// The value that `text` stands for.
    fn read(&self, text: &str) -> Result<V, Expected>;
    /// The text that stands for `value`; nothing when the key is better left out.
    fn show(&self, value: &V) -> Option<String>;
}

/// A whole number within a range, ends included.
pub struct Integer(pub u32, pub u32);

/// A number within a range, ends included.
pub struct Number(pub f64, pub f64);

/// Three numbers within a range, ends included.
pub struct Triple(pub f64, pub f64);

/// One of a few words.
pub struct Choice<V: 'static>(pub &'static [(&'static str, V)]);

/// The name of something.
pub struct Name;

/// The name of a file.
pub struct File;

/// A time of day or of play, as in 1:30:00 or 5:00, in seconds.
pub struct Time;

/// A value that may be left out.
pub struct Optional<F>(pub F);

/// A name, or the word `none`.
pub struct NameOrNone;

/// A colour, or the word `transparent`.
pub struct ColorOrTransparent;

/// A point of the world.
pub const PLACE: Triple = Triple(-1e6, 1e6);

/// A colour as it is written to a picture.
pub const COLOR: Triple = Triple(0.0, 1.0);

pub const YES_NO: Choice<bool> = Choice(&[("yes", true), ("no", false)]);

impl Format<u32> for Integer {
    fn read(&self, text: &str) -> Result<u32, Expected> {
        let Integer(min, max) = *self;
        text.parse()
            .ok()
            .filter(|value| (min..=max).contains(value))
            .ok_or_else(|| format!("a whole number from {min} to {max}"))
    }

    fn show(&self, value: &u32) -> Option<String> {
        Some(value.to_string())
    }
}

impl Format<f64> for Number {
    fn read(&self, text: &str) -> Result<f64, Expected> {
        let Number(min, max) = *self;
        text.parse()
            .ok()
            .filter(|value| (min..=max).contains(value))
            .ok_or_else(|| format!("a number from {min} to {max}"))
    }

    fn show(&self, value: &f64) -> Option<String> {
        Some(value.to_string())
    }
}

impl Format<DVec3> for Triple {
    fn read(&self, text: &str) -> Result<DVec3, Expected> {
        let Triple(min, max) = *self;
        let expected = || format!("three numbers from {min} to {max} with commas between them");
        let numbers: Vec<f64> = text
            .split(',')
            .map(|part| Number(min, max).read(part.trim()))
            .collect::<Result<_, _>>()
            .map_err(|_| expected())?;
        <[f64; 3]>::try_from(numbers).map(DVec3::from).map_err(|_| expected())
    }

    fn show(&self, value: &DVec3) -> Option<String> {
        Some(format!("{},{},{}", value.x, value.y, value.z))
    }
}

impl<V: Copy + PartialEq> Format<V> for Choice<V> {
    fn read(&self, text: &str) -> Result<V, Expected> {
        let found = self.0.iter().find(|(word, _)| word.eq_ignore_ascii_case(text));
        found.map(|(_, value)| *value).ok_or_else(|| {
            let words: Vec<&str> = self.0.iter().map(|(word, _)| *word).collect();
            let meant = nearest(text, words.iter().copied());
            let meant = meant.map_or(String::new(), |near| format!(" (did you mean `{near}`?)"));
            format!("one of {}{meant}", words.join(", "))
        })
    }

    fn show(&self, value: &V) -> Option<String> {
        self.0.iter().find(|(_, other)| other == value).map(|(word, _)| (*word).to_owned())
    }
}

impl Format<String> for Name {
    fn read(&self, text: &str) -> Result<String, Expected> {
        let words: Vec<String> = text.split_whitespace().map(str::to_lowercase).collect();
        if words.is_empty() { Err("a name".to_owned()) } else { Ok(words.join(" ")) }
    }

    fn show(&self, value: &String) -> Option<String> {
        Some(value.clone())
    }
}

impl Format<Option<String>> for NameOrNone {
    fn read(&self, text: &str) -> Result<Option<String>, Expected> {
        Name.read(text)
            .map(|name| Some(name).filter(|name| name != "none"))
            .map_err(|_| "a name, or none".to_owned())
    }

    fn show(&self, value: &Option<String>) -> Option<String> {
        Some(value.clone().unwrap_or_else(|| "none".to_owned()))
    }
}

impl Format<Option<DVec3>> for ColorOrTransparent {
    fn read(&self, text: &str) -> Result<Option<DVec3>, Expected> {
        if text.eq_ignore_ascii_case("transparent") {
            return Ok(None);
        }
        COLOR.read(text).map(Some).map_err(|expected| format!("{expected}, or transparent"))
    }

    fn show(&self, value: &Option<DVec3>) -> Option<String> {
        value.map_or(Some("transparent".to_owned()), |color| COLOR.show(&color))
    }
}

impl Format<PathBuf> for File {
    fn read(&self, text: &str) -> Result<PathBuf, Expected> {
        if text.is_empty() { Err("the name of a file".to_owned()) } else { Ok(text.into()) }
    }

    fn show(&self, value: &PathBuf) -> Option<String> {
        if value.as_os_str().is_empty() {
            return None;
        }
        // What is printed may be saved in another folder.
        let path = std::path::absolute(value).unwrap_or_else(|_| value.clone());
        let text = path.display().to_string();
        Some(if text.contains([';', '#']) { format!("\"{text}\"") } else { text })
    }
}

impl Format<u32> for Time {
    fn read(&self, text: &str) -> Result<u32, Expected> {
        let expected = || "a time up to 99:59:59, as in 1:30:00 or 5:00".to_owned();
        let parts: Vec<u32> = text
            .split(':')
            .map(|part| part.bytes().all(|b| b.is_ascii_digit()).then(|| part.parse().ok())?)
            .collect::<Option<_>>()
            .ok_or_else(expected)?;
        match *parts {
            [minutes, seconds] if minutes < 60 && seconds < 60 => Ok(60 * minutes + seconds),
            [hours, minutes, seconds] if hours < 100 && minutes < 60 && seconds < 60 => {
                Ok(3600 * hours + 60 * minutes + seconds)
            }
            _ => Err(expected()),
        }
    }

    fn show(&self, value: &u32) -> Option<String> {
        Some(format!("{}:{:02}:{:02}", value / 3600, value / 60 % 60, value % 60))
    }
}

impl<V, F: Format<V>> Format<Option<V>> for Optional<F> {
    fn read(&self, text: &str) -> Result<Option<V>, Expected> {
        self.0.read(text).map(Some)
    }

    fn show(&self, value: &Option<V>) -> Option<String> {
        value.as_ref().and_then(|value| self.0.show(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_and_shown() {
        for (text, seconds) in [("1:30:00", 5400), ("0:05", 5), ("99:59:59", 359_999)] {
            assert_eq!(Time.read(text), Ok(seconds));
            assert_eq!(Time.read(&Time.show(&seconds).unwrap()), Ok(seconds));
        }
        for text in ["", "5", "61:00", "1:60", "1:00:60", "100:00:00", "1:+5", "1::5", "-1:00"] {
            assert!(Time.read(text).is_err(), "{text}");
        }
    }
}
