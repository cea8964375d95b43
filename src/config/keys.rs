//! Keys: a name, what its value does to a section's settings, and how it is printed.

use std::fmt::Write;

use super::ini::{Entry, Section};
use super::values::Expected;
use super::{Fault, nearest};

/// A key of a section about a `T`.
pub struct Key<T> {
    pub name: &'static str,
    pub read: fn(&mut T, &str) -> Result<(), Expected>,
    pub show: fn(&T) -> Option<String>,
    /// Where the key only means something beside other values: which these are.
    pub only: Option<Only<T>>,
}

/// What a key is for, and whether that is so.
pub struct Only<T> {
    what: &'static str,
    holds: fn(&T) -> bool,
}

/// `key!("Radius", Model, radius: Number(0.0, 1.0))`: a key, the type that its section is about, the
/// field that it fills and the format of its value.
macro_rules! key {
    ($name:literal, $target:ty, $($field:ident).+ : $format:expr) => {
        $crate::config::keys::Key {
            name: $name,
            read: |target: &mut $target, text| {
                $crate::config::values::Format::read(&$format, text)
                    .map(|value| target.$($field).+ = value)
            },
            show: |target: &$target| {
                $crate::config::values::Format::show(&$format, &target.$($field).+)
            },
            only: None,
        }
    };
}
pub(super) use key;

impl<T> Key<T> {
    /// This key, for `what` alone.
    pub const fn only(self, what: &'static str, holds: fn(&T) -> bool) -> Key<T> {
        let only = Some(Only { what, holds });
        Key { name: self.name, read: self.read, show: self.show, only }
    }
}

/// Where the keys of a section stand; line 0 for a section that is not there.
#[derive(Default)]
pub struct Lines {
    section: usize,
    keys: Vec<(&'static str, usize)>,
    failed: Vec<&'static str>,
}

impl Lines {
    /// The line of a key, or that of its section when it is not given.
    pub fn of(&self, key: &str) -> usize {
        self.keys.iter().find(|(name, _)| *name == key).map_or(self.section, |(_, line)| *line)
    }

    /// Whether the section gives a key.
    pub fn give(&self, key: &str) -> bool {
        self.keys.iter().any(|(name, _)| *name == key)
    }

    /// Whether the section gives a key a value that it cannot have.
    pub fn failed(&self, key: &str) -> bool {
        self.failed.contains(&key)
    }

    /// The first of `keys` that the section does not give.
    pub fn first_missing(&self, keys: &[&'static str]) -> Option<&'static str> {
        keys.iter().copied().find(|key| !self.give(key))
    }
}

/// Applies the entries of `section` to `target`; what cannot be used is added to `faults`.
pub fn read_section<T>(
    section: &Section,
    keys: &[Key<T>],
    target: &mut T,
    faults: &mut Vec<Fault>,
) -> Lines {
    let mut lines = Lines { section: section.line, keys: Vec::new(), failed: Vec::new() };
    for &Entry { line, key, value } in &section.entries {
        let mut fault = |message| faults.push(Fault { line, message });
        let Some(known) = keys.iter().find(|known| known.name.eq_ignore_ascii_case(key)) else {
            fault(unknown("key", key, keys.iter().map(|key| key.name)));
            continue;
        };
        let name = known.name;
        if lines.give(name) {
            fault(format!("{name} is given here a second time in [{}]", section.name));
            continue;
        }
        lines.keys.push((name, line));
        if let Err(expected) = (known.read)(target, value) {
            fault(format!("{name} is `{value}`, expected {expected}"));
            lines.failed.push(name);
        }
    }
    for key in keys {
        if let Some(only) = &key.only
            && lines.give(key.name)
            && !["Shape", "Texture", "View", "Aperture"].iter().any(|key| lines.failed(key))
            && !(only.holds)(target)
        {
            let Only { what, .. } = only;
            let message = format!("{} is for {what}, which [{}] is not", key.name, section.name);
            faults.push(Fault { line: lines.of(key.name), message });
        }
    }
    lines
}

/// Prints a section with all its keys that mean something; nothing where there are none.
pub fn show_section<T>(name: &str, keys: &[Key<T>], target: &T, out: &mut String) {
    let shown = keys.iter().filter_map(|key| {
        let means_something = key.only.as_ref().is_none_or(|only| (only.holds)(target));
        (key.show)(target).filter(|_| means_something).map(|value| (key.name, value))
    });
    for (index, (key, value)) in shown.enumerate() {
        if index == 0 {
            let separator = if out.is_empty() { "" } else { "\n" };
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{separator}[{name}]");
        }
        let _ = writeln!(out, "{key}={value}");
    }
}

/// That a name is not known, and which one was meant.
pub fn unknown<'a>(what: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("there is no {what} `{name}`, did you mean `{near}`?"),
        None => format!("there is no {what} `{name}`, expected one of {}", known.join(", ")),
    }
}
