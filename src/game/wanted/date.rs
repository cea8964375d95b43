//! Dates as PGN writes them, and what of them is unknown.

use std::cmp::Ordering;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// The days that a date may mean: `1962.05.31` one, `1962.05.??`, `1962.05` and `1962` all of a
/// month or year, `196?` of ten years.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Period {
    /// Year, month and day.
    first: [u32; 3],
    last: [u32; 3],
}

/// A text that is no date.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoDate;

impl FromStr for Period {
    type Err = NoDate;

    /// Reads year, month and day with `.`, `-` or `/` between; `?` is a digit that is not known, and so
    /// are months and days of 0.
    fn from_str(text: &str) -> Result<Period, NoDate> {
        let mut parts = text.split(['.', '-', '/']);
        let year = parts.next().filter(|year| year.len() == 4).and_then(numbers).ok_or(NoDate)?;
        let mut within = |all: RangeInclusive<u32>| match parts.next() {
            None => Ok(all),
            Some(part) if part.len() > 2 => Err(NoDate),
            Some("?" | "0" | "00") => Ok(all),
            Some(part) => {
                let found = numbers(part).ok_or(NoDate)?;
                let found = *found.start().max(all.start())..=*found.end().min(all.end());
                if found.is_empty() { Err(NoDate) } else { Ok(found) }
            }
        };
        let (month, day) = (within(1..=12)?, within(1..=31)?);
        if parts.next().is_some() {
            return Err(NoDate);
        }
        Ok(Period {
            first: [*year.start(), *month.start(), *day.start()],
            last: [*year.end(), *month.end(), *day.end()],
        })
    }
}

impl Period {
    /// How the earliest and the latest day of this one stand to all days of `other`; a day that is one of
    /// them is equal.
    pub fn orders(&self, other: &Period) -> [Ordering; 2] {
        [self.first, self.last].map(|day| match () {
            () if day < other.first => Ordering::Less,
            () if day > other.last => Ordering::Greater,
            () => Ordering::Equal,
        })
    }
}

/// The numbers that digits can mean, of which `?` are unknown.
fn numbers(digits: &str) -> Option<RangeInclusive<u32>> {
    let is_digit = |c: char| c.is_ascii_digit() || c == '?';
    let number = |unknown| digits.replace('?', unknown).parse().ok();
    digits.chars().all(is_digit).then_some(number("0")?..=number("9")?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_unknown_spans_all_that_it_may_be() {
        for (text, first, last) in [
            ("1962.05.31", [1962, 5, 31], [1962, 5, 31]),
            ("1962-5-3", [1962, 5, 3], [1962, 5, 3]),
            ("1962/05", [1962, 5, 1], [1962, 5, 31]),
            ("1962.05.??", [1962, 5, 1], [1962, 5, 31]),
            ("1962.??.??", [1962, 1, 1], [1962, 12, 31]),
            ("1962.?.?", [1962, 1, 1], [1962, 12, 31]),
            ("1962.00.00", [1962, 1, 1], [1962, 12, 31]),
            ("1962", [1962, 1, 1], [1962, 12, 31]),
            ("196?.1?.??", [1960, 10, 1], [1969, 12, 31]),
            ("????.05.??", [0, 5, 1], [9999, 5, 31]),
        ] {
            assert_eq!(text.parse(), Ok(Period { first, last }), "{text}");
        }
    }

    #[test]
    fn what_is_no_date_is_none() {
        for text in [
            "",
            "62",
            "1962.",
            "1962.13",
            "1962.5.32",
            "1962.05.31.1",
            "31.05.1962",
            "1962.June",
            "1960-1965",
            "1-0",
            "+962",
            "x962",
            "1962.+5",
            "19６2",
        ] {
            assert_eq!(text.parse::<Period>(), Err(NoDate), "{text}");
        }
    }
}
