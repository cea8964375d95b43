//! Words of the movetext, and tag pairs.

/// What a word of the main line is.
pub enum Word {
    Number(u32),
    Result(String),
    Move(String),
    /// A glyph or symbol; it says nothing about the moves.
    Annotation,
    /// A word that can be no move, but should not be there.
    Odd,
}

/// The move number at the front of a word (`12.`, `12...`, or the whole word), and what follows.
pub fn split_number(word: &str) -> (Option<u32>, &str) {
    let rest = word.trim_start_matches(|c: char| c.is_ascii_digit());
    let digits = &word[..word.len() - rest.len()];
    let after = rest.trim_start_matches(['.', '…']);
    if rest.is_empty() || after.len() < rest.len() {
        (digits.parse().ok(), after)
    } else {
        (None, word)
    }
}

/// Says what a word (without its move number) is; nothing for an empty one.
pub fn classify(word: &str) -> Option<Word> {
    if word.is_empty() {
        return None;
    }
    let ascii_dashes = word.replace(['–', '—', '−', '‐', '‑'], "-");
    let result = match ascii_dashes.as_str() {
        "1-0" | "0-1" | "1/2-1/2" | "*" => Some(ascii_dashes.as_str()),
        "1/2" | "½-½" | "½" => Some("1/2-1/2"),
        _ => None,
    };
    if let Some(result) = result {
        return Some(Word::Result(result.to_owned()));
    }
    let bare = word.trim_end_matches(['!', '?', '.']);
    let null = bare == "--";
    let letters = bare.chars().filter(|c| c.is_alphanumeric()).count();
    Some(match letters {
        0 if !null => Word::Annotation,
        _ if word.starts_with('$') => Word::Annotation,
        // No move is written with a single letter or digit.
        1 => Word::Odd,
        2 if bare.eq_ignore_ascii_case("ep") || bare.eq_ignore_ascii_case("e.p") => {
            Word::Annotation
        }
        _ => Word::Move(bare.to_owned()),
    })
}

/// Name and value of a tag pair; the closing bracket may be missing.
pub fn parse_tag(raw: &str) -> Option<(String, String)> {
    let inner = raw.strip_prefix('[')?.trim();
    let inner = inner.strip_suffix(']').unwrap_or(inner).trim_end();
    let (name, quoted) = inner.split_at(inner.find([' ', '\t', '"'])?);
    let named = name.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    let quoted = quoted.trim_start().strip_prefix('"')?.strip_suffix('"')?;
    let mut value = String::with_capacity(quoted.len());
    let mut characters = quoted.chars();
    while let Some(character) = characters.next() {
        match character {
            '\\' => value.push(characters.next()?),
            '"' => return None,
            other => value.push(other),
        }
    }
    named.then(|| (name.to_owned(), printable(&value)))
}

/// UTF-8 where the bytes are that, else Latin-1.
pub fn decoded(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

/// `text` with nothing in it that moves a cursor or rings a bell.
pub fn printable(text: &str) -> String {
    text.replace(char::is_control, " ")
}
