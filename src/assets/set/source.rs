//! Where the files of a set are: within the program, or in a folder.

use std::fmt::{Display, Formatter};
use std::io::Read;
use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::DeTable;

use super::SetError;
use crate::config::nearest;

/// The files of a set, without their ending.
const FILES: [&str; 7] = ["set", "pawn", "knight", "bishop", "rook", "queen", "king"];

/// More bytes than any file of a set needs.
const MAX_BYTES: u64 = 256 * 1024;

/// The most characters of a message: a quoted word may be as long as its file.
const LONGEST: usize = 400;

/// Which set of chessmen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum SetName {
    /// After the Staunton pattern.
    #[default]
    Staunton,
    /// The thesis's: plain turnings, a cross, a knight cut out of a box.
    Thesis,
    /// That of a folder.
    Folder(PathBuf),
}

/// `built_in!("thesis")`: the texts of a set of the repository, in the order of [`FILES`].
macro_rules! built_in {
    ($set:literal) => {
        [
            include_str!(concat!("../sets/", $set, "/set.toml")),
            include_str!(concat!("../sets/", $set, "/pawn.toml")),
            include_str!(concat!("../sets/", $set, "/knight.toml")),
            include_str!(concat!("../sets/", $set, "/bishop.toml")),
            include_str!(concat!("../sets/", $set, "/rook.toml")),
            include_str!(concat!("../sets/", $set, "/queen.toml")),
            include_str!(concat!("../sets/", $set, "/king.toml")),
        ]
    };
}

const STAUNTON: [&str; 7] = built_in!("staunton");
const THESIS: [&str; 7] = built_in!("thesis");

/// A file of a set: its name as messages show it, and its text.
pub struct File {
    pub name: String,
    pub text: String,
}

impl SetName {
    /// The set that `text` names: a built-in one, or else a folder.
    ///
    /// # Errors
    /// When it is neither; the message says which was meant.
    pub fn parse(text: &str) -> Result<SetName, String> {
        match text {
            "staunton" => return Ok(SetName::Staunton),
            "thesis" => return Ok(SetName::Thesis),
            _ if Path::new(text).is_dir() => return Ok(SetName::Folder(text.into())),
            _ => {}
        }
        Err(match nearest(text, ["staunton", "thesis"]) {
            Some(near) => format!("there is no set or folder `{text}`, did you mean `{near}`?"),
            None => format!(
                "there is no set or folder `{text}`, expected staunton, thesis or a set's folder"
            ),
        })
    }

    /// The files that are read of a folder.
    pub fn files(&self) -> Vec<PathBuf> {
        match self {
            SetName::Staunton | SetName::Thesis => Vec::new(),
            SetName::Folder(folder) => {
                FILES.map(|file| folder.join(format!("{file}.toml"))).to_vec()
            }
        }
    }

    /// The text of one of [`FILES`].
    pub(super) fn read(&self, file: &str) -> Result<File, SetError> {
        let built_in = |texts: [&str; 7]| {
            let index = FILES.iter().position(|name| *name == file).unwrap_or_default();
            let name = format!("{self}/{file}.toml");
            Ok(File { name, text: texts[index].to_owned() })
        };
        match self {
            SetName::Staunton => built_in(STAUNTON),
            SetName::Thesis => built_in(THESIS),
            SetName::Folder(folder) => read(&folder.join(format!("{file}.toml"))),
        }
    }
}

impl Display for SetName {
    fn fmt(&self, out: &mut Formatter) -> std::fmt::Result {
        match self {
            SetName::Staunton => out.write_str("staunton"),
            SetName::Thesis => out.write_str("thesis"),
            SetName::Folder(folder) => write!(out, "{}", folder.display()),
        }
    }
}

fn read(path: &Path) -> Result<File, SetError> {
    let name = path.display().to_string();
    let fault = |message: String| SetError { file: name.clone(), line: None, message };
    if !path.exists() {
        let files = FILES.map(|file| format!("{file}.toml")).join(", ");
        return Err(fault(format!("no such file, expected the files of a set: {files}")));
    }
    if !path.is_file() {
        return Err(fault("is no file, expected one".to_owned()));
    }
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(MAX_BYTES + 1).read_to_end(&mut bytes))
        .map_err(|error| fault(format!("cannot be read: {error}")))?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(fault(format!("is too large, expected at most {MAX_BYTES} bytes")));
    }
    let text =
        String::from_utf8(bytes).map_err(|_| fault("is no text, expected UTF-8".to_owned()))?;
    Ok(File { name, text })
}

impl File {
    /// The file as TOML whose parts know where they stand.
    pub fn parse(&self) -> Result<Spanned<DeTable<'_>>, SetError> {
        DeTable::parse(&self.text).map_err(|error| {
            let line = error.span().map_or(1, |span| self.line(span.start));
            self.fault(line, error.message())
        })
    }

    /// The line of a byte, from 1.
    pub fn line(&self, at: usize) -> usize {
        1 + self.text.bytes().take(at).filter(|byte| *byte == b'\n').count()
    }

    /// That something is wrong in a line; what the message quotes may hold anything.
    pub fn fault(&self, line: usize, message: &str) -> SetError {
        let plain = |letter: char| if letter.is_control() { ' ' } else { letter };
        let message = message.chars().take(LONGEST).map(plain).collect();
        SetError { file: self.name.clone(), line: Some(line), message }
    }
}
