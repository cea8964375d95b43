//! What a clock shows of its settings or of a game.

use crate::config::{self, ShowClock, WithoutTimes};
use crate::notation::Color;
use crate::timeline::{Dials, digital};

/// What one half of the clock shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Where the hands point, in seconds since twelve o'clock.
    pub hands: u32,
    /// Digits, colons and hyphens.
    pub window: String,
    /// How far the flag is lifted, 0 (it hangs) to 1 (it stands).
    pub flag: f64,
    /// Whether the time is over.
    pub is_out: bool,
    pub is_running: bool,
}

/// Seconds before twelve at which the minute hand touches the flag, and in which it lifts it.
const FLAG: [u32; 2] = [180, 120];

const TWELVE_HOURS: u32 = 12 * 3600;

/// What both halves show, White's first; nothing where there is to be no clock.
pub fn readings(settings: &config::Clock, dials: Option<&Dials>) -> Option<[Reading; 2]> {
    match (settings.show, dials) {
        (ShowClock::No, _) | (ShowClock::Game, None) => None,
        (ShowClock::Fixed, _) => Some([settings.white, settings.black].map(Reading::at)),
        (ShowClock::Game, Some(Dials::Times { left, running })) => {
            let [white, black] = left.map(Reading::left);
            Some(running_for(*running, [white, black]))
        }
        (ShowClock::Game, Some(Dials::Moves { .. }))
            if settings.without_times == WithoutTimes::Absent =>
        {
            None
        }
        (ShowClock::Game, Some(Dials::Moves { made, to_move })) => {
            Some(running_for(Some(*to_move), made.map(Reading::of_moves)))
        }
    }
}

fn running_for(player: Option<Color>, [white, black]: [Reading; 2]) -> [Reading; 2] {
    [
        Reading { is_running: player == Some(Color::White), ..white },
        Reading { is_running: player == Some(Color::Black), ..black },
    ]
}

impl Reading {
    /// A clock that stands, with its hands `seconds` after twelve.
    fn at(seconds: u32) -> Reading {
        Reading {
            hands: seconds % TWELVE_HOURS,
            window: digital(seconds),
            flag: 0.0,
            is_out: false,
            is_running: false,
        }
    }

    /// So many seconds are left. Mechanical chess clocks know of no time left: they run forwards, and
    /// are set before a game such that the time is over at twelve. In the last minutes the minute hand
    /// lifts the flag; at twelve the flag slips off it and falls.
    fn left(seconds: Option<u32>) -> Reading {
        let Some(seconds) = seconds else {
            return Reading { window: "-:--".to_owned(), ..Reading::at(0) };
        };
        let [touched, lifting] = FLAG;
        let is_out = seconds == 0;
        let lifted = f64::from(touched.saturating_sub(seconds)) / f64::from(lifting);
        Reading {
            hands: (TWELVE_HOURS - seconds % TWELVE_HOURS) % TWELVE_HOURS,
            window: digital(seconds),
            flag: if is_out { 0.0 } else { lifted.min(1.0) },
            is_out,
            is_running: false,
        }
    }

    /// A clock that only counts moves.
    fn of_moves(moves: u32) -> Reading {
        Reading { window: moves.to_string(), ..Reading::at(0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Config, Look};

    fn game(dials: Dials) -> [Reading; 2] {
        let clock = config::Clock { show: ShowClock::Game, ..Config::new(Look::Studio).clock };
        readings(&clock, Some(&dials)).unwrap()
    }

    #[test]
    fn hands_reach_twelve_when_the_time_is_over_and_the_flag_falls() {
        // Seconds left, hands, window, flag, out.
        let cases = [
            (5400, TWELVE_HOURS - 5400, "1:30:00", 0.0, false),
            (181, TWELVE_HOURS - 181, "3:01", 0.0, false),
            (120, TWELVE_HOURS - 120, "2:00", 0.5, false),
            (9, TWELVE_HOURS - 9, "0:09", 1.0, false),
            (0, 0, "0:00", 0.0, true),
            (14 * 3600, 10 * 3600, "14:00:00", 0.0, false),
        ];
        for (left, hands, window, flag, is_out) in cases {
            let dials = Dials::Times { left: [Some(left), None], running: Some(Color::White) };
            let [white, black] = game(dials);
            let window = window.to_owned();
            assert_eq!(white, Reading { hands, window, flag, is_out, is_running: true });
            assert_eq!((black.window.as_str(), black.is_running), ("-:--", false));
        }
    }

    #[test]
    fn moves_are_counted_where_there_are_no_times() {
        let cases = [
            ([17, 16], Color::Black, ["17", "16"], [false, true]),
            ([17, 17], Color::White, ["17", "17"], [true, false]),
        ];
        for (made, to_move, windows, running) in cases {
            let readings = game(Dials::Moves { made, to_move });
            assert_eq!(readings.clone().map(|reading| reading.window), windows);
            assert_eq!(readings.map(|reading| reading.is_running), running);
        }
    }

    #[test]
    fn a_clock_is_absent_where_it_is_told_to() {
        let moment = Dials::Moves { made: [17, 16], to_move: Color::Black };
        let times = Dials::Times { left: [Some(1), Some(2)], running: None };
        let (no, fixed, game) = (ShowClock::No, ShowClock::Fixed, ShowClock::Game);
        let (moves, absent) = (WithoutTimes::Moves, WithoutTimes::Absent);
        let cases = [
            (no, moves, Some(&times), false),
            (fixed, absent, None, true),
            (fixed, absent, Some(&moment), true),
            (game, moves, None, false),
            (game, moves, Some(&moment), true),
            (game, absent, Some(&moment), false),
            (game, absent, Some(&times), true),
        ];
        for (show, without_times, dials, is_there) in cases {
            let settings = config::Clock { show, without_times, ..Config::new(Look::Studio).clock };
            assert_eq!(readings(&settings, dials).is_some(), is_there, "{show:?}, {dials:?}");
        }
    }
}
