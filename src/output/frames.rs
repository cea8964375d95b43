//! Names of numbered pictures, films and manifests.

use std::ops::RangeInclusive;

use super::film::FilmFormat;
use super::picture::{FORMATS, PictureFormat};

/// Names of numbered pictures in one folder: `frame_00000.png`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameNames {
    before: String,
    /// At least so many digits.
    digits: usize,
    after: String,
    format: PictureFormat,
}

/// Digits of a number that no name asks otherwise for, and the most that one may ask for.
const DIGITS: usize = 5;
const MOST_DIGITS: usize = 20;

impl FrameNames {
    /// `frame_00000` with the ending of a format.
    pub fn new(format: PictureFormat) -> FrameNames {
        let after = format!(".{}", format.ending());
        FrameNames { before: "frame_".to_owned(), digits: DIGITS, after, format }
    }

    /// Names after a pattern, where the number stands as `%05d` or as `#####`. The ending says the format; there may be
    /// none where `format` says it.
    ///
    /// # Errors
    /// What is wrong with the pattern, in words.
    pub fn parse(pattern: &str, format: Option<PictureFormat>) -> Result<FrameNames, String> {
        let wrong = |what: &str| {
            Err(format!(
                "`{pattern}` {what}, expected a name such as frame_%05d.png or frame_#####.png"
            ))
        };
        let Some((before, digits, after)) = number_in(pattern) else {
            return wrong("has no number as %05d or #####, or more than one");
        };
        if !(1..=MOST_DIGITS).contains(&digits) {
            return wrong("asks for no digits, or too many");
        }
        let is_plain = |c: char| {
            !c.is_control() && !matches!(c, '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|')
        };
        if !pattern.chars().all(is_plain) || pattern.starts_with('.') || pattern.starts_with(' ') {
            return wrong("is no file name");
        }
        if pattern.ends_with('.') {
            return wrong("ends with a dot");
        }
        // A number on either side would be read as part of this one.
        if before.ends_with(|c: char| c.is_ascii_digit())
            || after.starts_with(|c: char| c.is_ascii_digit())
        {
            return wrong("has digits beside the number");
        }
        let (stem, ending) = after.rsplit_once('.').unwrap_or((after, ""));
        let found = PictureFormat::named(ending);
        let format = match (found, format) {
            (Some(found), Some(format)) if found != format => {
                return Err(format!(
                    "`{pattern}` ends as {} does, and --format asks for {}",
                    found.ending(),
                    format.ending()
                ));
            }
            (Some(found), _) => {
                let after = after.to_owned();
                return Ok(FrameNames { before: before.to_owned(), digits, after, format: found });
            }
            (None, _)
                if !stem.is_empty() && !ending.is_empty()
                    || (stem.is_empty() && after.starts_with('.')) =>
            {
                let known: Vec<&str> = FORMATS.iter().map(|(ending, _)| *ending).collect();
                return Err(format!(
                    "`{pattern}` ends as no picture does, expected .{}",
                    known.join(", .")
                ));
            }
            (None, format) => format.unwrap_or(PictureFormat::Png),
        };
        let after = format!("{after}.{}", format.ending());
        Ok(FrameNames { before: before.to_owned(), digits, after, format })
    }

    pub fn format(&self) -> PictureFormat {
        self.format
    }

    /// The file name of picture `index`.
    pub fn name(&self, index: usize) -> String {
        let FrameNames { before, digits, after, .. } = self;
        format!("{before}{index:0digits$}{after}")
    }

    /// Which picture has that name, if one has.
    fn index(&self, name: &str) -> Option<usize> {
        let digits = name.strip_prefix(self.before.as_str())?.strip_suffix(self.after.as_str())?;
        let is_number = digits.len() >= self.digits && digits.bytes().all(|b| b.is_ascii_digit());
        is_number.then(|| digits.parse().unwrap_or(usize::MAX))
    }
}

/// What stands before the only number of a pattern, how many digits it has, and what stands behind it.
fn number_in(pattern: &str) -> Option<(&str, usize, &str)> {
    if let Some((before, rest)) = pattern.split_once('%') {
        let (digits, after) = rest.split_once('d')?;
        let is_alone = !pattern.contains('#') && !after.contains('%');
        let width =
            if digits.is_empty() { Some(1) } else { digits.strip_prefix('0')?.parse().ok() };
        return width.filter(|_| is_alone).map(|width| (before, width, after));
    }
    let (before, rest) = pattern.split_once('#')?;
    let after = rest.trim_start_matches('#');
    (!after.contains('#')).then(|| (before, 1 + rest.len() - after.len(), after))
}

/// Which picture has that name, by `names` or usually.
pub(super) fn frame_index(name: &str, names: Option<&FrameNames>) -> Option<usize> {
    let usual = || FORMATS.iter().find_map(|(_, format)| FrameNames::new(*format).index(name));
    names.and_then(|names| names.index(name)).or_else(usual)
}

/// The name of a game's manifest, or of that of a part of its frames.
pub fn manifest_name(part: Option<&RangeInclusive<usize>>) -> String {
    match part {
        None => "game.json".to_owned(),
        Some(part) => format!("game_{:05}-{:05}.json", part.start(), part.end()),
    }
}

/// The name of a game's film, or of that of a part of its frames.
pub fn film_name(format: FilmFormat, part: Option<&RangeInclusive<usize>>) -> String {
    let ending = format.ending();
    match part {
        None => format!("film.{ending}"),
        Some(part) => format!("film_{:05}-{:05}.{ending}", part.start(), part.end()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_named_as_a_frame_is_one() {
        let usual = FrameNames::new(PictureFormat::Png);
        let own = FrameNames::parse("my %03d.jpg", None).unwrap();
        for index in [0, 7, 1_234_567] {
            for names in [&usual, &own] {
                assert_eq!(names.index(&names.name(index)), Some(index));
                assert_eq!(frame_index(&names.name(index), Some(&own)), Some(index));
            }
        }
        assert_eq!(frame_index("frame_00007.webp", None), Some(7));
        for other in
            ["frame_1.png", "frame_0000x.png", "frame_00001.gif", "a_frame_00001.png", "my 12.jpg"]
        {
            assert_eq!(frame_index(other, Some(&own)), None, "{other}");
        }
    }

    #[test]
    fn names_follow_their_pattern() {
        let (png, jpeg) = (PictureFormat::Png, PictureFormat::Jpeg);
        for (pattern, format, expected) in [
            ("frame_%05d.png", None, "frame_00042.png"),
            ("#####", None, "00042.png"),
            ("f%d", Some(jpeg), "f42.jpg"),
            ("a.b-##", None, "a.b-42.png"),
            ("###_x.JPEG", Some(jpeg), "042_x.JPEG"),
            ("#.tif", None, "42.tif"),
        ] {
            let names = FrameNames::parse(pattern, format).unwrap();
            assert_eq!(names.name(42), expected, "{pattern}");
        }
        for (pattern, format, expected) in [
            ("frame.png", None, "no number"),
            ("%d-%d.png", None, "more than one"),
            ("#a#.png", None, "more than one"),
            ("%5d.png", None, "no number"),
            ("%099d.png", None, "too many"),
            ("%d_a.", None, "ends with a dot"),
            ("a/%d.png", None, "no file name"),
            (".%d.png", None, "no file name"),
            ("1%d.png", None, "digits beside"),
            ("%d.gif", None, "ends as no picture"),
            ("%d.jpg", Some(png), "--format asks for png"),
        ] {
            let error = FrameNames::parse(pattern, format).unwrap_err();
            assert!(error.contains(expected), "{error}");
        }
    }
}
