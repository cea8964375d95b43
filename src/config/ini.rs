//! Lines of a Windows-style INI file, with their numbers. (rust-ini knows no line numbers, and
//! turns the backslashes of Windows paths into escapes.)

use super::Fault;

/// A `[section]` with its keys, in the order of the file.
pub struct Section<'a> {
    pub line: usize,
    pub name: &'a str,
    pub entries: Vec<Entry<'a>>,
}

/// A `key = value`, both without the blanks round them.
pub struct Entry<'a> {
    pub line: usize,
    pub key: &'a str,
    pub value: &'a str,
}

/// Cuts `text` into sections; what is neither a section, an entry, a comment nor blank is a fault.
pub fn read(text: &str) -> (Vec<Section<'_>>, Vec<Fault>) {
    let mut sections: Vec<Section> = Vec::new();
    let mut faults = Vec::new();
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    for (index, line) in text.lines().enumerate() {
        let number = index + 1;
        let content = without_comment(line).trim();
        if content.is_empty() {
            continue;
        }
        let name = content.strip_prefix('[').and_then(|rest| rest.strip_suffix(']'));
        let complaint = match (name, content.split_once('='), sections.last_mut()) {
            (Some(name), ..) => {
                sections.push(Section { line: number, name: name.trim(), entries: Vec::new() });
                continue;
            }
            (_, Some((key, value)), Some(section)) => {
                let value = value.trim();
                let quoted = value.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
                let value = quoted.unwrap_or(value);
                section.entries.push(Entry { line: number, key: key.trim(), value });
                continue;
            }
            (_, Some(_), None) => "stands before the first [section]",
            (_, None, _) => "is neither a [section] nor a key=value",
        };
        let begin: String = content.chars().take(60).collect();
        let rest = if begin.len() < content.len() { "…" } else { "" };
        faults.push(Fault { line: number, message: format!("`{begin}{rest}` {complaint}") });
    }
    (sections, faults)
}

/// The part of a line before a `;` or `#` that stands first or behind a blank. (Within a value,
/// a path say, they are its own; and so is everything between double quotes.)
fn without_comment(line: &str) -> &str {
    let begins = |(at, _): &(usize, &str)| {
        let before = &line[..*at];
        let is_quoted = before.matches('"').count() % 2 == 1;
        !is_quoted && (before.is_empty() || before.ends_with(char::is_whitespace))
    };
    line.match_indices([';', '#']).find(begins).map_or(line, |(at, _)| &line[..at])
}
