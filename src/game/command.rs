//! Commands for programs within comments: `[%clk 1:02:03]`, `[%eval 0.17]`, `[%cal Ge2e4]`.

use super::Problem;
use super::notes::{Eval, Note};
use crate::notation::ParseMarkError;

/// Gives `each` what the commands of a comment say, or what is wrong with one. The comment begins
/// in line `line`; commands that are not known are passed over.
pub fn read(line: usize, comment: &[u8], mut each: impl FnMut(Result<Note, Problem>)) {
    let mut line = line;
    let mut rest = comment;
    while let Some(start) = memchr::memmem::find(rest, b"[%") {
        line += lines(&rest[..start]);
        rest = &rest[start..];
        let end = rest.iter().position(|byte| *byte == b']');
        let raw = &rest[..end.map_or(rest.len(), |end| end + 1)];
        let text = String::from_utf8_lossy(raw);
        let (name, value) = parts(&text);
        if let Some(kind) = Kind::of(name) {
            if end.is_some() {
                kind.read(&text, value, line, &mut each);
            } else {
                let what = "is never closed, expected a `]` in the comment";
                each(Err(Problem::new(line, &text, what, false)));
            }
        }
        line += lines(raw);
        rest = &rest[raw.len()..];
    }
}

fn lines(text: &[u8]) -> usize {
    text.iter().filter(|byte| **byte == b'\n').count()
}

/// Name and value of `[%name value]`.
fn parts(command: &str) -> (&str, &str) {
    let inner = command.trim_start_matches("[%").trim_end_matches(']');
    let (name, value) = inner.split_once(char::is_whitespace).unwrap_or((inner, ""));
    (name, value.trim())
}

#[derive(Clone, Copy)]
enum Kind {
    Clock,
    Elapsed,
    Eval,
    Marks,
}

impl Kind {
    fn of(name: &str) -> Option<Kind> {
        match name {
            "clk" => Some(Kind::Clock),
            "emt" => Some(Kind::Elapsed),
            "eval" => Some(Kind::Eval),
            "csl" | "cal" => Some(Kind::Marks),
            _ => None,
        }
    }

    fn read(
        self,
        command: &str,
        value: &str,
        line: usize,
        each: &mut impl FnMut(Result<Note, Problem>),
    ) {
        const NO_TIME: &str = "is no time, expected hours, minutes and seconds as in 1:02:03";
        const NO_EVAL: &str = "is no evaluation, expected pawns as in 0.17, or a mate as in #-3";
        let one = |note: Option<Note>, what: &str| {
            note.ok_or_else(|| Problem::new(line, command, what, false))
        };
        match self {
            Kind::Clock => each(one(seconds(value).map(Note::Clock), NO_TIME)),
            Kind::Elapsed => each(one(seconds(value).map(Note::Elapsed), NO_TIME)),
            Kind::Eval => each(one(eval(value).map(Note::Eval), NO_EVAL)),
            Kind::Marks => {
                let separates = |c: char| c == ',' || c.is_whitespace();
                for text in value.split(separates).filter(|text| !text.is_empty()) {
                    each(mark(text).map_err(|what| Problem::new(line, text, what, false)));
                }
            }
        }
    }
}

/// Seconds of `h:mm:ss` or `m:ss`, with or without decimals.
fn seconds(text: &str) -> Option<f64> {
    let (rest, seconds) = text.rsplit_once(':')?;
    let (hours, minutes) = rest.rsplit_once(':').unwrap_or(("0", rest));
    let [hours, minutes] = [hours, minutes].map(|text| {
        text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse::<u32>().ok()).flatten()
    });
    Some(3600.0 * f64::from(hours?) + 60.0 * f64::from(minutes?) + decimal(seconds)?)
}

/// Pawns, or moves to mate; the search depth behind a comma is not kept.
fn eval(text: &str) -> Option<Eval> {
    let value = text.split(',').next()?.trim();
    if let Some(moves) = value.strip_prefix('#') {
        return moves.parse().ok().map(Eval::Mate);
    }
    let unsigned = value.strip_prefix(['+', '-']).unwrap_or(value);
    let pawns = decimal(unsigned)?;
    Some(Eval::Pawns(if value.starts_with('-') { -pawns } else { pawns }))
}

/// A number of few digits, without sign or exponent.
pub fn decimal(text: &str) -> Option<f64> {
    const LONGEST: usize = 12;
    let is_plain = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    if is_plain && text.len() <= LONGEST { text.parse().ok() } else { None }
}

/// A mark; programs write circles into `[%cal …]` too, and arrows into `[%csl …]`.
fn mark(text: &str) -> Result<Note, &'static str> {
    if let Ok(circle) = text.parse() {
        return Ok(Note::Circle(circle));
    }
    match text.parse() {
        Ok(arrow) => Ok(Note::Arrow(arrow)),
        Err(ParseMarkError::ToItself) => Err("goes from a square to itself, expected two squares"),
        Err(_) => Err("is no mark, expected G, R, Y or B and one square or two"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(comment: &str) -> Vec<Result<Note, String>> {
        let mut told = Vec::new();
        read(7, comment.as_bytes(), |note| {
            told.push(note.map_err(|problem| problem.to_string()));
        });
        told
    }

    #[test]
    fn commands_are_read_as_programs_write_them() {
        let cases = [
            ("[%clk 1:02:03.5]", Note::Clock(3723.5)),
            ("[%clk 0:00:00]", Note::Clock(0.0)),
            ("[%clk 9:59]", Note::Clock(599.0)),
            ("[%clk 100:00:00]", Note::Clock(360_000.0)),
            ("so [%emt 00:00:09] far", Note::Elapsed(9.0)),
            ("[%eval 0.17]", Note::Eval(Eval::Pawns(0.17))),
            ("[%eval -1.5,20]", Note::Eval(Eval::Pawns(-1.5))),
            ("[%eval +3]", Note::Eval(Eval::Pawns(3.0))),
            ("[%eval #-3]", Note::Eval(Eval::Mate(-3))),
            ("[%eval #4,30]", Note::Eval(Eval::Mate(4))),
        ];
        for (comment, note) in cases {
            assert_eq!(told(comment), [Ok(note)], "{comment}");
        }
        let marks = told("[%csl Gd5,Ra1][%cal Ge2e4, \nBa1h8]");
        assert!(marks.iter().all(Result::is_ok) && marks.len() == 4, "{marks:?}");
    }

    #[test]
    fn what_is_not_for_us_is_passed_over() {
        for comment in ["", "[", "[%", "[%tqu \"x\"]", "[%evp 1,2", "[clk 1:02]", "[%]", "[%csl]"] {
            assert_eq!(told(comment), [], "{comment}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_told_with_its_line() {
        let time = "is no time, expected hours, minutes and seconds as in 1:02:03";
        let eval = "is no evaluation, expected pawns as in 0.17, or a mate as in #-3";
        let mark = "is no mark, expected G, R, Y or B and one square or two";
        let cases = [
            ("[%clk]", format!("line 7: `[%clk]` {time}")),
            ("a\nb\n[%clk 1:xx]", format!("line 9: `[%clk 1:xx]` {time}")),
            ("[%tqu\n]\n[%emt -0:01]", format!("line 9: `[%emt -0:01]` {time}")),
            ("[%clk 1::2]", format!("line 7: `[%clk 1::2]` {time}")),
            ("[%clk 1:2:3:4]", format!("line 7: `[%clk 1:2:3:4]` {time}")),
            ("[%eval inf]", format!("line 7: `[%eval inf]` {eval}")),
            ("[%eval 1e9]", format!("line 7: `[%eval 1e9]` {eval}")),
            ("[%eval #]", format!("line 7: `[%eval #]` {eval}")),
            ("[%csl Pd5]", format!("line 7: `Pd5` {mark}")),
            ("[%cal Ge2e9]", format!("line 7: `Ge2e9` {mark}")),
            (
                "[%cal Ge2e2]",
                "line 7: `Ge2e2` goes from a square to itself, expected two squares".into(),
            ),
            (
                "[%clk 0:01",
                "line 7: `[%clk 0:01` is never closed, expected a `]` in the comment".into(),
            ),
        ];
        for (comment, problem) in cases {
            assert_eq!(told(comment), [Err(problem)], "{comment}");
        }
    }
}
