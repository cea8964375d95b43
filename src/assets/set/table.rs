//! Tables of TOML whose values are asked for by key and type, and that know where they stand.

use glam::DVec3;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::SetError;
use super::source::File;
use crate::config::unknown;

/// A table, with whose it is: messages begin with that.
pub struct Table<'a> {
    pub file: &'a File,
    pub owner: String,
    pub line: usize,
    table: &'a DeTable<'a>,
}

/// A string in its place.
pub struct Text<'a> {
    pub file: &'a File,
    pub owner: &'a str,
    pub text: &'a str,
    /// Where the text begins in the file, or the value does when it has escapes.
    start: usize,
    has_escapes: bool,
}

impl<'a> Table<'a> {
    /// A whole file.
    pub fn root(file: &'a File, owner: &str, document: &'a Spanned<DeTable<'a>>) -> Table<'a> {
        Table { file, owner: owner.to_owned(), line: 1, table: document.get_ref() }
    }

    /// The keys, in the order of the alphabet.
    pub fn keys(&self) -> impl Iterator<Item = &'a str> + use<'a> {
        self.table.keys().map(|key| &**key.get_ref())
    }

    pub fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// That something is wrong with the whole table.
    pub fn fault(&self, message: String) -> SetError {
        self.file.fault(self.line, &format!("{} {message}", self.owner))
    }

    /// That something is wrong with the value of `key`.
    pub fn wrong(&self, key: &str, expected: &str) -> SetError {
        let line = self.line_of(key);
        self.file.fault(line, &format!("{}: `{key}`: expected {expected}", self.owner))
    }

    /// The line of a key.
    pub fn line_of(&self, key: &str) -> usize {
        self.table.get_key_value(key).map_or(self.line, |(key, _)| self.file.line(key.span().start))
    }

    /// Refuses keys that are not `known`; `what` says what they are.
    pub fn know(&self, what: &str, known: &[&str]) -> Result<(), SetError> {
        match self.keys().find(|key| !known.contains(key)) {
            Some(key) => {
                let message = unknown(what, key, known.iter().copied());
                Err(self.file.fault(self.line_of(key), &format!("{}: {message}", self.owner)))
            }
            None => Ok(()),
        }
    }

    /// A number from `min` to `max`.
    pub fn number(&self, key: &str, min: f64, max: f64) -> Result<Option<f64>, SetError> {
        let Some(value) = self.table.get(key) else { return Ok(None) };
        number(value.get_ref())
            .filter(|number| (min..=max).contains(number))
            .map(Some)
            .ok_or_else(|| self.wrong(key, &format!("a number from {min} to {max}")))
    }

    /// Three numbers, each from `-most` to `most`.
    pub fn vector(&self, key: &str, most: f64) -> Result<Option<DVec3>, SetError> {
        let Some(value) = self.table.get(key) else { return Ok(None) };
        let numbers: Option<Vec<f64>> = value
            .get_ref()
            .as_array()
            .and_then(|array| array.iter().map(|value| number(value.get_ref())).collect());
        match numbers.as_deref() {
            Some(&[x, y, z]) if [x, y, z].iter().all(|number| number.abs() <= most) => {
                Ok(Some(DVec3::new(x, y, z)))
            }
            _ => Err(self.wrong(key, &format!("three numbers from -{most} to {most}"))),
        }
    }

    /// Whether `key` is given and true.
    pub fn is_true(&self, key: &str) -> Result<bool, SetError> {
        let Some(value) = self.table.get(key) else { return Ok(false) };
        value.get_ref().as_bool().ok_or_else(|| self.wrong(key, "true or false"))
    }

    /// The string of `key`.
    pub fn text(&self, key: &str) -> Result<Option<Text<'_>>, SetError> {
        let Some(value) = self.table.get(key) else { return Ok(None) };
        let text = value.get_ref().as_str().ok_or_else(|| self.wrong(key, "a string"))?;
        Ok(Some(self.in_place(value, text)))
    }

    /// The string of a key that is there.
    pub fn needed_text(&self, key: &str) -> Result<Text<'_>, SetError> {
        self.text(key)?.ok_or_else(|| self.fault(format!("has no `{key}`")))
    }

    /// The table of `key`, which belongs to `owner`.
    pub fn table(&self, key: &str, owner: &str) -> Result<Option<Table<'a>>, SetError> {
        let Some(value) = self.table.get(key) else { return Ok(None) };
        let table = value.get_ref().as_table().ok_or_else(|| self.wrong(key, "a table"))?;
        let owner = owner.to_owned();
        Ok(Some(Table { file: self.file, owner, line: self.line_of(key), table }))
    }

    /// The elements of the array of `key`: names of parts, or parts themselves.
    pub fn members(&self, key: &str) -> Result<Vec<Result<Text<'_>, Table<'a>>>, SetError> {
        let expected = "a list of names of parts, or of parts between braces";
        let member = |value: &'a Spanned<DeValue<'a>>| match value.get_ref() {
            DeValue::String(text) => Ok(Ok(self.in_place(value, text))),
            DeValue::Table(table) => Ok(Err(Table {
                file: self.file,
                owner: self.owner.clone(),
                line: self.file.line(value.span().start),
                table,
            })),
            _ => Err(self.wrong(key, expected)),
        };
        let array = self.table.get(key).and_then(|value| value.get_ref().as_array());
        array.ok_or_else(|| self.wrong(key, expected))?.iter().map(member).collect()
    }

    fn in_place<'t>(&'t self, value: &Spanned<DeValue>, text: &'t str) -> Text<'t> {
        let span = value.span();
        let inside = self.file.text[span.clone()].find(text);
        let start = span.start + inside.unwrap_or_default();
        let has_escapes = inside.is_none();
        Text { file: self.file, owner: &self.owner, text, start, has_escapes }
    }
}

impl Text<'_> {
    /// The line of a byte of the text.
    pub fn line(&self, at: usize) -> usize {
        self.file.line(if self.has_escapes { self.start } else { self.start + at })
    }

    /// That something is wrong in a line.
    pub fn fault(&self, line: usize, message: &str) -> SetError {
        self.file.fault(line, &format!("{}: {message}", self.owner))
    }
}

/// The finite number that a value is.
fn number(value: &DeValue) -> Option<f64> {
    let number = match value {
        DeValue::Integer(integer) => {
            i64::from_str_radix(integer.as_str(), integer.radix()).ok()? as f64
        }
        DeValue::Float(float) => float.as_str().parse().ok()?,
        _ => return None,
    };
    Some(number).filter(|number| number.is_finite())
}
