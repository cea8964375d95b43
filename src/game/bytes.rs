//! Bytes of a text with the numbers of their lines.

use std::io::{self, BufRead};

use super::word::decoded;

/// The bytes of a stream, with line numbers. CR, LF and CRLF all end a line.
pub struct Bytes<R> {
    reader: R,
    /// The line of the next byte, from 1.
    pub line: usize,
    /// Whether only blanks stand before the next byte in its line.
    pub at_line_start: bool,
    /// Whether the next byte is the first of its line.
    pub at_first_column: bool,
}

impl<R: BufRead> Bytes<R> {
    /// Starts at line 1.
    pub fn new(reader: R) -> Bytes<R> {
        Bytes { reader, line: 1, at_line_start: true, at_first_column: true }
    }

    /// The next byte, which stays.
    pub fn peek(&mut self) -> io::Result<Option<u8>> {
        loop {
            match self.reader.fill_buf() {
                Ok(buffer) => return Ok(buffer.first().copied()),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// The next byte, with any line end as `\n`.
    pub fn bump(&mut self) -> io::Result<Option<u8>> {
        let Some(mut byte) = self.peek()? else {
            return Ok(None);
        };
        self.reader.consume(1);
        if byte == b'\r' {
            if self.peek()? == Some(b'\n') {
                self.reader.consume(1);
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

    /// The bytes up to the end of the line, which stays.
    pub fn rest_of_line(&mut self) -> io::Result<Vec<u8>> {
        self.until(|byte| byte == b'\n' || byte == b'\r')
    }

    /// A word: up to a blank or one of `{}()[]<;*`, or up to a `$` within.
    pub fn word(&mut self) -> io::Result<Vec<u8>> {
        let mut word =
            self.until(|byte| byte.is_ascii_whitespace() || b"{}()[]<;*$".contains(&byte))?;
        if word.is_empty() {
            word.extend(self.bump()?);
            if word == b"$" {
                word.extend(self.until(|byte| !byte.is_ascii_digit())?);
            }
        }
        Ok(word)
    }

    /// From a `[` to the `]` that closes it (one in quotes does not), or to the end of the line.
    /// Quotes that are open there go on in the next line, unless that is blank or a tag.
    pub fn bracket(&mut self) -> io::Result<String> {
        let mut raw = Vec::new();
        let mut quoted = false;
        let mut escaped = false;
        while let Some(byte) = self.peek()? {
            if byte == b'\n' || byte == b'\r' {
                if !quoted {
                    break;
                }
                self.bump()?;
                if self.peek()?.is_none_or(|next| b"[\r\n".contains(&next)) {
                    break;
                }
                raw.push(b' ');
                continue;
            }
            self.bump()?;
            raw.push(byte);
            match byte {
                b'"' if !escaped => quoted = !quoted,
                b']' if !quoted => break,
                _ => {}
            }
            escaped = byte == b'\\' && !escaped;
        }
        Ok(decoded(raw.trim_ascii_end()))
    }

    /// The bytes before the first that `ends` them.
    pub fn until(&mut self, ends: impl Fn(u8) -> bool) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        while let Some(byte) = self.peek()?.filter(|byte| !ends(*byte)) {
            self.bump()?;
            bytes.push(byte);
        }
        Ok(bytes)
    }
}
