//! Bytes of a text with the numbers of their lines.
//!
//! However long a line, a word or a bracket is, only a bounded part of it is kept.

use std::io::{self, Read};

/// The bytes of a stream, with line numbers. CR, LF and CRLF all end a line.
pub struct Bytes<R> {
    reader: R,
    /// Of which `at..end` is still to be read.
    buffer: Box<[u8]>,
    at: usize,
    end: usize,
    /// The line of the next byte, from 1.
    pub line: usize,
    /// Whether only blanks stand before the next byte in its line.
    pub at_line_start: bool,
    /// Whether the next byte is the first of its line.
    pub at_first_column: bool,
}

/// Some bytes, of which so many were kept.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Kept<T> {
    pub text: T,
    /// Whether there was more.
    pub is_cut: bool,
}

/// How many bytes are read at once.
const BUFFER: usize = 128 * 1024;

/// How long a tag or another bracket may be: four times what the longest line of other programs holds.
pub const LONGEST_BRACKET: usize = 8 * 1024;

/// How long a word may be. Moves have few letters, but blanks that are not ASCII do not part words.
const LONGEST_WORD: usize = 8 * 1024;

impl<R: Read> Bytes<R> {
    /// Starts at line 1.
    pub fn new(reader: R) -> Bytes<R> {
        let buffer = vec![0; BUFFER].into_boxed_slice();
        Bytes { reader, buffer, at: 0, end: 0, line: 1, at_line_start: true, at_first_column: true }
    }

    /// Reads more behind the bytes that are there; `false` at the end of the text. There must be
    /// room, which there is as long as no more than half of the buffer is asked for.
    #[cold]
    fn refill(&mut self) -> io::Result<bool> {
        self.buffer.copy_within(self.at..self.end, 0);
        self.end -= self.at;
        self.at = 0;
        loop {
            match self.reader.read(&mut self.buffer[self.end..]) {
                Ok(read) => {
                    self.end += read;
                    return Ok(read > 0);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// What has been read ahead; nothing at the end of the text.
    #[inline]
    pub fn unread(&mut self) -> io::Result<&[u8]> {
        if self.at == self.end {
            self.refill()?;
        }
        Ok(&self.buffer[self.at..self.end])
    }

    /// Passes over so many of the unread bytes, which hold no line end.
    #[inline]
    pub fn pass(&mut self, count: usize) {
        self.at += count;
        self.at_line_start &= count == 0;
        self.at_first_column &= count == 0;
    }

    /// The next byte, which stays.
    #[inline]
    pub fn peek(&mut self) -> io::Result<Option<u8>> {
        Ok(self.unread()?.first().copied())
    }

    /// The next byte, with any line end as `\n`.
    #[inline]
    pub fn bump(&mut self) -> io::Result<Option<u8>> {
        let Some(mut byte) = self.peek()? else {
            return Ok(None);
        };
        self.at += 1;
        if byte == b'\r' {
            if self.peek()? == Some(b'\n') {
                self.at += 1;
            }
            byte = b'\n';
        }
        self.at_first_column = byte == b'\n';
        if byte == b'\n' {
            self.line += 1;
            self.at_line_start = true;
        } else if !byte.is_ascii_whitespace() {
            self.at_line_start = false;
        }
        Ok(Some(byte))
    }

    /// A word: up to a blank or one of `{}()[]<;*`, or up to a `$` within; what a pawn becomes may
    /// stand in brackets (`b8(Q)`). Of one that is too long, a part.
    pub fn word(&mut self) -> io::Result<Kept<&[u8]>> {
        let mut length = 0;
        let is_cut = loop {
            let unread = &self.buffer[self.at..self.end];
            let found = unread[length..].iter().position(|byte| ENDS_WORD[usize::from(*byte)]);
            length += found.unwrap_or(unread.len() - length);
            // A promotion needs the bytes behind the bracket.
            let needed = length + if found.is_some() { PROMOTION } else { 1 };
            if length >= LONGEST_WORD {
                break true;
            }
            if found.is_some() && unread[length] == b'$' && length == 0 {
                length = 1 + self.digits()?;
                break false;
            }
            let is_bracket = found.is_some() && unread[length] == b'(';
            if found.is_some() && !(is_bracket && unread.len() < needed) {
                let is_promotion = is_bracket && promotes(&unread[..length], &unread[length..]);
                match (is_promotion, length) {
                    (true, _) => length += PROMOTION,
                    (false, 0) => {
                        length = 1;
                        break false;
                    }
                    (false, _) => break false,
                }
            } else if !self.refill()? {
                length = length.max(1).min(self.end - self.at);
                break false;
            }
        };
        let start = self.at;
        self.pass(length);
        Ok(Kept { text: &self.buffer[start..start + length], is_cut })
    }

    /// How many digits stand behind the next byte; no more than a word is long.
    fn digits(&mut self) -> io::Result<usize> {
        let mut digits = 0;
        loop {
            let behind = self.buffer[self.at..self.end].get(1 + digits).copied();
            match behind {
                Some(byte) if byte.is_ascii_digit() && digits < LONGEST_WORD => digits += 1,
                Some(_) => return Ok(digits),
                None if self.refill()? => {}
                None => return Ok(digits),
            }
        }
    }

    /// From a `[` to the `]` that closes it (one in quotes does not), or to the end of the line.
    /// Quotes that are open there go on in the next line, unless that is blank or a tag.
    pub fn bracket(&mut self) -> io::Result<Kept<Vec<u8>>> {
        let mut kept = Kept { text: Vec::with_capacity(64), is_cut: false };
        let (mut quoted, mut escaped) = (false, false);
        loop {
            let unread = self.unread()?;
            if unread.is_empty() {
                break;
            }
            let mut closed = false;
            let end = unread.iter().position(|&byte| {
                match byte {
                    _ if closed => return true,
                    b'\n' | b'\r' => return true,
                    b'"' if !escaped => quoted = !quoted,
                    b']' if !quoted => closed = true,
                    _ => {}
                }
                escaped = byte == b'\\' && !escaped;
                false
            });
            let length = end.unwrap_or(unread.len());
            kept.add(&unread[..length], LONGEST_BRACKET);
            self.pass(length);
            if closed {
                break;
            }
            if end.is_some() {
                if !quoted {
                    break;
                }
                self.bump()?;
                if self.peek()?.is_none_or(|next| b"[\r\n".contains(&next)) {
                    break;
                }
                kept.add(b" ", LONGEST_BRACKET);
            }
        }
        kept.text.truncate(kept.text.trim_ascii_end().len());
        Ok(kept)
    }

    /// The bytes before the first `end` or the end of the line; `longest` of them are kept.
    pub fn until(&mut self, end: u8, longest: usize) -> io::Result<Kept<Vec<u8>>> {
        let mut kept = Kept::default();
        loop {
            let unread = self.unread()?;
            let found = memchr::memchr3(end, b'\n', b'\r', unread);
            let length = found.unwrap_or(unread.len());
            kept.add(&unread[..length], longest);
            let has_ended = found.is_some() || unread.is_empty();
            self.pass(length);
            if has_ended {
                return Ok(kept);
            }
        }
    }
}

impl Kept<Vec<u8>> {
    /// Adds what there is room for, if no more than `longest` bytes are kept.
    pub fn add(&mut self, bytes: &[u8], longest: usize) {
        let room = longest - self.text.len();
        self.is_cut |= bytes.len() > room;
        self.text.extend_from_slice(&bytes[..bytes.len().min(room)]);
    }
}

/// How long `(Q)` is.
const PROMOTION: usize = 3;

/// Whether a word goes on with what its pawn becomes, in brackets.
fn promotes(word: &[u8], behind: &[u8]) -> bool {
    let at_last_rank = matches!(word, [.., b'a'..=b'h', b'1' | b'8'] | [.., b'1' | b'8', b'=']);
    at_last_rank && matches!(behind, [b'(', b'A'..=b'Z' | b'a'..=b'z', b')', ..])
}

/// The bytes that end a word.
static ENDS_WORD: [bool; 256] = {
    let mut table = [false; 256];
    let mut index = 0;
    let ends = b" \t\n\x0C\r{}()[]<;*$";
    while index < ends.len() {
        table[ends[index] as usize] = true;
        index += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives one byte at a time.
    struct Slow<'a>(&'a [u8]);

    impl Read for Slow<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let Some((first, rest)) = self.0.split_first() else {
                return Ok(0);
            };
            buffer[0] = *first;
            self.0 = rest;
            Ok(1)
        }
    }

    fn words(text: &str) -> Vec<String> {
        let mut bytes = Bytes::new(Slow(text.as_bytes()));
        let mut words = Vec::new();
        while bytes.peek().unwrap().is_some() {
            let word = bytes.word().unwrap();
            words.push(String::from_utf8_lossy(word.text).into_owned());
        }
        words
    }

    #[test]
    fn words_end_at_blanks_and_brackets() {
        let cases: [(&str, &[&str]); 8] = [
            ("e4 e5", &["e4", " ", "e5"]),
            ("e4*", &["e4", "*"]),
            ("Nf3$10$2x", &["Nf3", "$10", "$2", "x"]),
            ("b8(Q)+ x", &["b8(Q)+", " ", "x"]),
            ("b8=(q)", &["b8=(q)"]),
            ("e4(Q)", &["e4", "(", "Q", ")"]),
            ("b8(Qd5)", &["b8", "(", "Qd5", ")"]),
            ("b8(", &["b8", "("]),
        ];
        for (text, expected) in cases {
            assert_eq!(words(text), expected, "{text}");
        }
    }

    #[test]
    fn what_is_too_long_comes_in_parts() {
        let long = "x".repeat(20_000);
        let mut bytes = Bytes::new(long.as_bytes());
        let mut lengths = Vec::new();
        while bytes.peek().unwrap().is_some() {
            let word = bytes.word().unwrap();
            lengths.push((word.text.len(), word.is_cut));
        }
        assert_eq!(lengths.iter().map(|(length, _)| length).sum::<usize>(), 20_000);
        assert!(lengths[0].1, "{lengths:?}");
        let mut bytes = Bytes::new(io::Read::chain(&b"["[..], io::repeat(b'a').take(1_000_000)));
        let bracket = bytes.bracket().unwrap();
        assert_eq!((bracket.text.len(), bracket.is_cut), (LONGEST_BRACKET, true));
        assert_eq!(bytes.peek().unwrap(), None);
    }
}
