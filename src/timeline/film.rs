//! A film's times.

use serde::Serialize;

/// Times of a film, in seconds, and its frames a second.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Film {
    pub fps: f64,
    /// How long a move takes.
    pub transition: f64,
    /// How long each position stands, but the first and the last.
    pub pause: Pause,
    /// How long the first position stands.
    pub first: f64,
    /// How long the last position stands.
    pub last: f64,
    /// How long the title stands before the first position, and the result behind the last one.
    pub title: f64,
    pub result: f64,
}

/// How long positions stand.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Pause {
    /// All as long, in seconds.
    Even(f64),
    /// As long as the players thought, scaled: 0.8 s for the median, no less than 0.4 s, no more than 2 s.
    #[serde(serialize_with = "real")]
    Real,
}

fn real<S: serde::Serializer>(serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str("real")
}

impl Default for Film {
    fn default() -> Film {
        let pause = Pause::Even(TYPICAL);
        Film { fps: 25.0, transition: 0.6, pause, first: 1.0, last: 5.0, title: 0.0, result: 0.0 }
    }
}

/// The median of pauses that follow the players' clocks, and the least and the longest of them, in seconds.
const TYPICAL: f64 = 0.8;
const SHORTEST: f64 = 0.4;
const LONGEST: f64 = 2.0;

/// Pauses in proportion to the times, in seconds, that players thought: the median becomes 0.8 s, none
/// is shorter than 0.4 s or longer than 2 s. Where a time is not known, it is 0.8 s.
pub fn paced(thought: &[Option<f64>]) -> Vec<f64> {
    let mut known: Vec<f64> = thought.iter().flatten().copied().collect();
    known.sort_by(f64::total_cmp);
    let middle = known.len() / 2;
    let median = match known.len() {
        0 => 0.0,
        length if length % 2 == 1 => known[middle],
        _ => known[middle - 1].midpoint(known[middle]),
    };
    let pause = |seconds: f64| {
        // Where half of the moves took no time at all, any time is long.
        let scaled =
            if median > 0.0 { seconds / median * TYPICAL } else { seconds * f64::INFINITY };
        if scaled.is_nan() { TYPICAL } else { scaled.clamp(SHORTEST, LONGEST) }
    };
    thought.iter().map(|seconds| seconds.map_or(TYPICAL, pause)).collect()
}

/// Less than any step of time that a film can show, in seconds.
const CRUMB: f64 = 1e-6;

/// When everything happens in one game's film.
#[derive(Clone, Debug)]
pub struct Schedule {
    film: Film,
    /// When each move begins, in seconds from the film's beginning.
    moves: Vec<f64>,
    /// When the last position comes to rest, in seconds.
    rests: f64,
}

/// What happens at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moment {
    Title,
    /// A position stands after so many moves, for the share `passed` (0 to 1) of its time.
    Rest {
        moves: usize,
        passed: f64,
    },
    /// After so many moves the next one is under way, for the share `passed` (0 to 1) of its time.
    Move {
        moves: usize,
        passed: f64,
    },
    /// The words behind the game, over the position after so many moves.
    Result {
        moves: usize,
    },
}

impl Schedule {
    /// The times of a film with `pauses` between its moves: one less than there are moves.
    pub fn new(film: Film, moves: usize, pauses: &[f64]) -> Schedule {
        let mut begins = Vec::with_capacity(moves);
        let mut time = film.title + film.first;
        for index in 0..moves {
            begins.push(time);
            time += film.transition + pauses.get(index).copied().unwrap_or(0.0);
        }
        let rests = begins.last().map_or(film.title + film.first, |begin| begin + film.transition);
        Schedule { film, moves: begins, rests }
    }

    /// The film's length in seconds: title + first + moves × transition + all pauses + last + result.
    pub fn length(&self) -> f64 {
        self.rests + self.film.last + self.film.result
    }

    /// The number of frames, at least 1.
    pub fn frames(&self) -> usize {
        ((self.length() * self.film.fps).round() as usize).max(1)
    }

    /// The time of a frame in seconds.
    pub fn time(&self, frame: usize) -> f64 {
        frame as f64 / self.film.fps
    }

    /// When the position after so many moves comes to rest, in seconds; before the first shown position
    /// and behind the last one, when it would if the film had more of the game.
    pub fn reached(&self, moves: i64) -> f64 {
        let Film { title, transition, pause, .. } = self.film;
        let pause = if let Pause::Even(seconds) = pause { seconds } else { TYPICAL };
        let beyond = |moves: i64| moves as f64 * (transition + pause);
        match usize::try_from(moves - 1).ok().map(|index| self.moves.get(index)) {
            None => title + beyond(moves),
            Some(Some(begin)) => begin + transition,
            Some(None) => self.rests + beyond(moves - self.moves.len() as i64),
        }
    }

    /// What happens at a `time` in seconds.
    pub fn at(&self, time: f64) -> Moment {
        // Sums of decimal fractions leave crumbs, and frames often fall on the very borders.
        let is_past = |border: f64| time + CRUMB >= border;
        let Film { title, transition, last, .. } = self.film;
        if !is_past(title) {
            return Moment::Title;
        }
        if is_past(self.rests + last) && self.film.result > 0.0 {
            return Moment::Result { moves: self.moves.len() };
        }
        let begun = self.moves.partition_point(|begin| is_past(*begin));
        let share = |from: f64, to: f64| {
            if to > from { ((time - from) / (to - from)).clamp(0.0, 1.0) } else { 1.0 }
        };
        let Some(index) = begun.checked_sub(1) else {
            let first = self.moves.first().copied().unwrap_or(self.rests);
            return Moment::Rest { moves: 0, passed: share(title, first) };
        };
        let begin = self.moves[index];
        if !is_past(begin + transition) {
            return Moment::Move { moves: index, passed: share(begin, begin + transition) };
        }
        let next = self.moves.get(begun).copied().unwrap_or(self.rests + last);
        Moment::Rest { moves: begun, passed: share(begin + transition, next) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_follow_the_clock_between_their_bounds() {
        let seconds = |list: &[f64]| list.iter().copied().map(Some).collect::<Vec<_>>();
        let cases = [
            (seconds(&[]), vec![]),
            (seconds(&[10.0]), vec![0.8]),
            (seconds(&[5.0, 10.0, 20.0]), vec![0.4, 0.8, 1.6]),
            (seconds(&[1.0, 10.0, 100.0]), vec![0.4, 0.8, 2.0]),
            (seconds(&[10.0, 30.0]), vec![0.4, 1.2]),
            (seconds(&[0.0, 0.0, 3.0]), vec![0.8, 0.8, 2.0]),
            (vec![None, Some(4.0), None], vec![0.8; 3]),
            (vec![None, None], vec![0.8; 2]),
        ];
        for (thought, expected) in cases {
            let paced = paced(&thought);
            let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-12;
            let all_near = paced.iter().zip(&expected).all(near);
            assert!(paced.len() == expected.len() && all_near, "{thought:?}: {paced:?}");
        }
    }
}
