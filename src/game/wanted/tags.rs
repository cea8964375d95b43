//! What a tag must say: `White=Kasparov*`, `WhiteElo>=2500`, `Date<1962`, `ECO=B20-B99`.

use std::cmp::Ordering;
use std::ops::RangeInclusive;
use std::str::FromStr;

use super::date::Period;
use super::wildcard::{Wildcard, plain};
use crate::game::{is_known, tag};

/// A test of one tag: its name, a comparison and a value.
///
/// `=` compares texts, in which `*` is any run of characters and neither case nor accents count; and also
/// whole numbers (`1` is `01`), dates (a game of `1962.05.??` is of `1962`) and codes of openings, of which
/// it takes a range (`B20-B99`). `<`, `<=`, `>` and `>=` compare what is on both sides a whole number, a
/// date or a code of openings. What is unknown makes none of these true: neither a tag that is missing,
/// empty or all `?`, nor parts of a date on which the answer hangs. `!=` holds wherever `=` does not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TagTest {
    name: String,
    comparison: Comparison,
    value: Value,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Comparison {
    Equal,
    Different,
    Less,
    AtMost,
    AtLeast,
    More,
}

/// All that a value can be taken for.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Value {
    text: Wildcard,
    number: Option<i64>,
    period: Option<Period>,
    openings: Option<RangeInclusive<Opening>>,
}

/// A code of the Encyclopaedia of Chess Openings, `B20`: its letter and number.
type Opening = (u8, u8);

/// Why a text is no test of a tag.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseTagTestError {
    #[error(
        "no comparison in it, expected a tag's name, one of = != < <= > >= and a value, as in \
         'WhiteElo>=2500'"
    )]
    NoComparison,
    #[error("`{found}` is no comparison, expected one of = != < <= > >=")]
    Comparison { found: String },
    #[error("`{found}` is no tag's name, expected letters, digits, _ and -")]
    Name { found: String },
    #[error(
        "no value behind the comparison, expected one, as in '{name}=*' for games that have the tag, or \
         '{name}!=*' for those that do not"
    )]
    NoValue { name: String },
    #[error(
        "`{found}` has no order, expected a whole number, a date (1962, 1962.05 or 1962.05.31) or a code \
         of openings (B20) behind {comparison}"
    )]
    NoOrder { found: String, comparison: &'static str },
    #[error("`{found}` is a range that ends before it begins, expected the lower code first")]
    Backwards { found: String },
}

/// The comparisons, the longer before those that they begin with.
const COMPARISONS: [(&str, Comparison); 6] = [
    ("!=", Comparison::Different),
    ("<=", Comparison::AtMost),
    (">=", Comparison::AtLeast),
    ("=", Comparison::Equal),
    ("<", Comparison::Less),
    (">", Comparison::More),
];

impl FromStr for TagTest {
    type Err = ParseTagTestError;

    fn from_str(text: &str) -> Result<TagTest, ParseTagTestError> {
        const SIGNS: [char; 4] = ['=', '!', '<', '>'];
        let at = text.find(SIGNS).ok_or(ParseTagTestError::NoComparison)?;
        let (name, rest) = text.split_at(at);
        let value = rest.trim_start_matches(SIGNS);
        let signs = &rest[..rest.len() - value.len()];
        let (sign, comparison) = COMPARISONS
            .into_iter()
            .find(|(sign, _)| *sign == signs)
            .ok_or_else(|| ParseTagTestError::Comparison { found: signs.to_owned() })?;
        let (name, value) = (name.trim(), value.trim());
        let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || !name.chars().all(is_letter) {
            return Err(ParseTagTestError::Name { found: name.to_owned() });
        }
        if !is_known(value) {
            return Err(ParseTagTestError::NoValue { name: name.to_owned() });
        }
        let is_order = !matches!(comparison, Comparison::Equal | Comparison::Different);
        let found = || value.to_owned();
        let value = Value {
            text: Wildcard::new(value),
            number: value.parse().ok(),
            period: value.parse().ok(),
            openings: openings(value),
        };
        if value.openings.as_ref().is_some_and(RangeInclusive::is_empty) {
            return Err(ParseTagTestError::Backwards { found: found() });
        }
        let is_one = |openings: &RangeInclusive<Opening>| openings.start() == openings.end();
        let has_order = value.number.is_some()
            || value.period.is_some()
            || value.openings.as_ref().is_some_and(is_one);
        if is_order && !has_order {
            return Err(ParseTagTestError::NoOrder { found: found(), comparison: sign });
        }
        Ok(TagTest { name: name.to_owned(), comparison, value })
    }
}

impl TagTest {
    /// Whether a game with these tags passes.
    pub fn holds(&self, tags: &[(String, String)]) -> bool {
        let found = tag(tags, &self.name).map(str::trim).filter(|value| is_known(value));
        let is_equal = || found.is_some_and(|found| self.value.is(found));
        let is = |will_do| found.is_some_and(|found| self.value.orders(found, will_do));
        match self.comparison {
            Comparison::Equal => is_equal(),
            Comparison::Different => !is_equal(),
            Comparison::Less => is(Ordering::is_lt),
            Comparison::AtMost => is(Ordering::is_le),
            Comparison::AtLeast => is(Ordering::is_ge),
            Comparison::More => is(Ordering::is_gt),
        }
    }
}

impl Value {
    /// Whether `found` is the same, as a text or as whatever else both are.
    fn is(&self, found: &str) -> bool {
        let within = self.openings.as_ref().zip(opening(found));
        self.orders(found, Ordering::is_eq)
            || within.is_some_and(|(range, found)| range.contains(&found))
            || self.text.matches(&plain(found))
    }

    /// Whether `found` stands to this in an order that will do, as far as that is certain.
    fn orders(&self, found: &str, will_do: fn(Ordering) -> bool) -> bool {
        if let Some((found, number)) = found.parse::<i64>().ok().zip(self.number) {
            return will_do(found.cmp(&number));
        }
        if let Some((found, period)) = found.parse::<Period>().ok().zip(self.period) {
            return found.orders(&period).into_iter().all(will_do);
        }
        let first = self.openings.as_ref().map(RangeInclusive::start);
        opening(found).zip(first).is_some_and(|(found, first)| will_do(found.cmp(first)))
    }
}

/// A code of openings, or two with a hyphen.
fn openings(text: &str) -> Option<RangeInclusive<Opening>> {
    let exact = |text: &str| opening(text.trim()).filter(|_| text.trim().len() == 3);
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    Some(exact(first)?..=exact(last)?)
}

/// The code that a text begins with; programs add to them (`B90/05`, `B90a`).
fn opening(text: &str) -> Option<Opening> {
    let [letter, tens, units, rest @ ..] = text.as_bytes() else {
        return None;
    };
    let letter = letter.to_ascii_uppercase();
    let is_code = (b'A'..=b'E').contains(&letter)
        && [tens, units].into_iter().all(u8::is_ascii_digit)
        && !rest.first().is_some_and(u8::is_ascii_digit);
    is_code.then(|| (letter, 10 * (tens - b'0') + units - b'0'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(test: &str, name: &str, value: &str) -> bool {
        let test: TagTest = test.parse().unwrap_or_else(|error| panic!("{test}: {error}"));
        test.holds(&[(name.to_owned(), value.to_owned())])
    }

    /// What holds, and what does not, of values of the tag that a test is of.
    #[test]
    fn values_are_compared_as_what_they_are() {
        for (test, yes, no) in [
            (
                "White=kasparov*",
                &["Kasparov, Garry", "KASPAROV"][..],
                &["Karpov, A", "A. Kasparov"][..],
            ),
            ("White=Reti*", &["Réti, Richárd"], &["Tartakower"]),
            ("White=*", &["x", "0", "-"], &["?", "", " ", "????.??.??"]),
            ("White!=*", &["?", "", "????.??.??"], &["x"]),
            ("White!=Kasparov*", &["Karpov", "?", ""], &["Kasparov, G"]),
            (
                "WhiteElo>=2500",
                &["2500", " 2851 ", "+2500"],
                &["2499", "?", "", "-", "2500?", "GM"],
            ),
            ("WhiteElo > 2500", &["2501", "10000"], &["2500", "900"]),
            ("WhiteElo<2500", &["2499", "0", "-5"], &["2500", "?", ""]),
            ("WhiteElo<=2500", &["2500"], &["2501"]),
            ("WhiteElo=2500", &["2500", "02500"], &["2501", "25"]),
            ("WhiteElo!=2500", &["2501", "?", ""], &["2500"]),
            ("Round=1", &["1", "01"], &["1.1", "11"]),
            ("Round=1.1", &["1.1"], &["1.10", "1"]),
            ("Round>1", &["2"], &["1.2", "-"]),
            (
                "Date<1962",
                &["1961.12.31", "1961.??.??", "1961", "195?.??.??"],
                &["1962.??.??", "1962.01.01", "196?.??.??", "????.??.??", "", "summer"],
            ),
            (
                "Date<=1962",
                &["1962.12.31", "1962.??.??", "1858.11.02"],
                &["1963.01.01", "196?.??.??"],
            ),
            (
                "Date>1962",
                &["1963.01.01", "1963.??.??"],
                &["1962.12.31", "1962.??.??", "196?.??.??"],
            ),
            ("Date>=1962", &["1962.??.??", "1962.01.01", "2000"], &["1961.12.31", "196?.??.??"]),
            (
                "Date<1962.05.02",
                &["1962.05.01", "1962.04.??"],
                &["1962.05.02", "1962.05.??", "1962.??.??"],
            ),
            ("Date<1962-05-02", &["1962.05.01"], &["1962.05.02"]),
            ("Date>1962.05", &["1962.06.01"], &["1962.05.31", "1962.??.??"]),
            (
                "Date=1962",
                &["1962.05.31", "1962.??.??", "1962"],
                &["1961.05.31", "196?.??.??", "?"],
            ),
            ("Date=1962.05", &["1962.05.31", "1962.05.??"], &["1962.??.??", "1962.06.01"]),
            ("Date=1962.??.??", &["1962.??.??", "1962.05.31"], &["1963.??.??"]),
            ("Date=1962.05.*", &["1962.05.31"], &["1962.06.01"]),
            ("Date!=1962", &["1961.05.31", "196?.??.??", "?"], &["1962.05.31"]),
            ("ECO=B20", &["B20", "b20", "B20/05", "B20a"], &["B21", "B2", "B200"]),
            (
                "ECO=B20-B99",
                &["B20", "B99", "B50", "B90/05", "b90"],
                &["B19", "C00", "A20", "?", "Sicilian"],
            ),
            ("ECO=A80-B09", &["A80", "A99", "B00", "B09"], &["A79", "B10"]),
            ("ECO=B9*", &["B90", "B99"], &["B89"]),
            ("ECO>=B20", &["B20", "C00", "E99"], &["B19", "A99", ""]),
            ("ECO<B20", &["B19", "A99"], &["B20", "F00"]),
            ("Result=1-0", &["1-0"], &["0-1", "*"]),
            (r"Result=\*", &["*"], &["1-0"]),
            ("white=X", &["x"], &["y"]),
            ("Event=a=b", &["A=B"], &["a"]),
        ] {
            let name = test.split(['=', '!', '<', '>']).next().unwrap().trim();
            for value in yes {
                assert!(holds(test, name, value), "{test} {value:?}");
            }
            for value in no {
                assert!(!holds(test, name, value), "{test} {value:?}");
            }
        }
    }

    #[test]
    fn a_tag_that_is_not_there_is_different_and_nothing_else() {
        for (test, expected) in [
            ("White=*", false),
            ("White!=*", true),
            ("White!=Kasparov", true),
            ("WhiteElo<3000", false),
            ("WhiteElo>=0", false),
        ] {
            assert_eq!(holds(test, "Black", "Kasparov"), expected, "{test}");
        }
    }

    #[test]
    fn names_of_tags_are_as_good_in_small_letters() {
        assert!(holds("whiteelo>2000", "WhiteElo", "2100"));
    }

    #[test]
    fn what_is_no_test_is_told() {
        for (text, part) in [
            ("Foo", "no comparison in it, expected a tag's name"),
            ("", "no comparison in it"),
            ("WhiteElo>>2500", "`>>` is no comparison, expected one of = != < <= > >="),
            ("White==x", "`==` is no comparison"),
            ("White!x", "`!` is no comparison"),
            ("WhiteElo=>2500", "`=>` is no comparison"),
            ("=x", "`` is no tag's name"),
            ("White Elo>2500", "`White Elo` is no tag's name"),
            ("White=", "no value behind the comparison, expected one, as in 'White=*'"),
            ("White!=?", "'White!=*' for those that do not"),
            ("Date<????.??.??", "no value behind the comparison"),
            ("White<Kasparov", "`Kasparov` has no order, expected a whole number, a date"),
            ("Round>1.1", "`1.1` has no order"),
            ("Date<1962.13", "`1962.13` has no order"),
            ("WhiteElo>2500*", "`2500*` has no order"),
            ("ECO>B20-B99", "`B20-B99` has no order"),
            ("ECO=B99-B20", "`B99-B20` is a range that ends before it begins"),
        ] {
            let error = text.parse::<TagTest>().unwrap_err().to_string();
            assert!(error.contains(part), "{text:?} gave {error:?}");
        }
    }
}
