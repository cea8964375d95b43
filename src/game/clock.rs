//! The players' clocks: what `[%clk]`, `[%emt]` and the tag `TimeControl` say of them, ply by ply.

use shakmaty::Color;

use super::{Game, Ply, command};

/// The times of a game. A ply counts half-moves: 0 is the start, and a move leads to each other one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clocks {
    /// One more than there are plies.
    left: Vec<[Option<f64>; 2]>,
    /// One a ply.
    thought: Vec<Option<f64>>,
    flag: Option<Color>,
    is_known: bool,
}

impl Clocks {
    /// Seconds that White and Black have left after `ply` half-moves, where that is known; never
    /// negative. At the start it is what they began with.
    pub fn left(&self, ply: usize) -> [Option<f64>; 2] {
        self.left.get(ply).copied().unwrap_or_default()
    }

    /// Seconds that the move took which leads to `ply`, where that is known; never negative.
    pub fn thought(&self, ply: usize) -> Option<f64> {
        self.thought.get(ply.checked_sub(1)?).copied().flatten()
    }

    /// Who lost on time, if that ended the game.
    pub fn flag(&self) -> Option<Color> {
        self.flag
    }

    /// Whether the game says anything of times beside what the players began with.
    pub fn is_known(&self) -> bool {
        self.is_known
    }
}

impl Game {
    /// The clocks of the main line.
    pub fn clocks(&self) -> Clocks {
        let control = self.tag("TimeControl").and_then(TimeControl::parse);
        let start = control.as_ref().map(TimeControl::start).or(self.start_notes.clock);
        let has_gains = gains(&self.plies);
        let knows_berserk =
            self.tag("Site").is_some_and(|site| site.to_lowercase().contains("lichess"));
        let mut players = [Color::White, Color::Black].map(|color| {
            let first = self.plies.iter().find(|ply| ply.mover() == color);
            let first = first.filter(|_| knows_berserk).and_then(|ply| ply.notes.clock);
            Player::new(start, first)
        });
        let mut clocks =
            Clocks { left: vec![[players[0].left, players[1].left]], ..Clocks::default() };
        for ply in &self.plies {
            let player = &mut players[ply.mover().fold_wb(0, 1)];
            let gain = match &control {
                _ if player.is_berserk => Some(Gain::default()),
                Some(control) => Some(control.gain(ply.number())),
                // A clock that never goes up has no increment; what another one has is not known.
                None => (!has_gains).then(Gain::default),
            };
            clocks.thought.push(player.moves(ply, gain));
            clocks.left.push([players[0].left, players[1].left]);
        }
        clocks.is_known = clocks.thought.iter().any(Option::is_some)
            || self.plies.iter().any(|ply| ply.notes.clock.is_some());
        clocks.flag = self.lost_on_time();
        if let (Some(color), true, Some(last)) =
            (clocks.flag, clocks.is_known, clocks.left.last_mut())
        {
            last[color.fold_wb(0, 1)] = Some(0.0);
        }
        clocks
    }

    /// Who lost on time. A game that is not whole is not shown to its end.
    fn lost_on_time(&self) -> Option<Color> {
        let loser = match self.result.as_str() {
            "1-0" => Color::Black,
            "0-1" => Color::White,
            _ => return None,
        };
        let says_time = self.tag("Termination").is_some_and(|how| {
            how.to_lowercase()
                .split(|c: char| !c.is_alphabetic())
                .any(|word| matches!(word, "time" | "timeout"))
        });
        (says_time && self.is_whole()).then_some(loser)
    }
}

/// Whether a player's clock ever goes up.
fn gains(plies: &[Ply]) -> bool {
    let mut last = [None; 2];
    plies.iter().any(|ply| {
        let last = &mut last[ply.mover().fold_wb(0, 1)];
        let before = std::mem::replace(last, ply.notes.clock);
        matches!((before, ply.notes.clock), (Some(before), Some(after)) if after > before)
    })
}

/// One player's clock.
struct Player {
    left: Option<f64>,
    /// Seconds of further periods that the clock may not have shown yet: some add them when a
    /// period's moves are made, some when its time is up.
    owed: f64,
    has_moved: bool,
    /// Whether the player gave up half the time, and the increment, as some servers allow.
    is_berserk: bool,
}

/// What a move puts on a clock, in seconds.
#[derive(Default)]
struct Gain {
    increment: f64,
    /// Of the next period, when the move is the last one of a period.
    period: f64,
}

impl Player {
    /// A player who begins with `start` seconds, and of whose first clock the game says `first`.
    fn new(start: Option<f64>, first: Option<f64>) -> Player {
        let half = start.map(|start| start / 2.0).filter(|half| first == Some(*half));
        Player { left: half.or(start), owed: 0.0, has_moved: false, is_berserk: half.is_some() }
    }

    /// Makes a move; gives the seconds that it took.
    fn moves(&mut self, ply: &Ply, gain: Option<Gain>) -> Option<f64> {
        let is_first = !std::mem::replace(&mut self.has_moved, true);
        let before = self.left.take();
        let elapsed = ply.notes.elapsed;
        self.owed += gain.as_ref().map_or(0.0, |gain| gain.period);
        let Some(after) = ply.notes.clock else {
            if let (Some(before), Some(elapsed), Some(gain)) = (before, elapsed, &gain) {
                let owed = std::mem::take(&mut self.owed);
                self.left = Some((before - elapsed + gain.increment + owed).max(0.0));
            }
            return elapsed;
        };
        self.left = Some(after);
        let (before, gain) = (before?, gain?);
        // On some servers no time runs before a player's first move, and none is added.
        let stood = is_first && after == before && gain.increment > 0.0;
        let spent = before + gain.increment - after;
        let by_clock = if stood {
            None
        } else if spent >= -ROUNDING {
            Some(spent.max(0.0))
        } else if self.owed > 0.0 && spent + self.owed >= -ROUNDING {
            Some((spent + std::mem::take(&mut self.owed)).max(0.0))
        } else {
            None
        };
        elapsed.or(by_clock)
    }
}

/// Clocks that show whole seconds may seem to go up by so many.
const ROUNDING: f64 = 1.0;

/// The tag `TimeControl`.
struct TimeControl {
    first: Period,
    further: Vec<Period>,
}

/// Seconds for so many moves, or for the rest of the game.
#[derive(Clone, Copy)]
struct Period {
    moves: Option<u32>,
    seconds: f64,
    increment: f64,
}

impl TimeControl {
    /// Reads `600+5` or `40/7200:3600+30`; `None` for what gives no times (`?`, `-`), and for
    /// hourglasses (`*180`).
    fn parse(text: &str) -> Option<TimeControl> {
        let mut periods = text.split(':').map(|period| Period::parse(period.trim()));
        Some(TimeControl { first: periods.next()??, further: periods.collect::<Option<_>>()? })
    }

    /// Seconds at the start.
    fn start(&self) -> f64 {
        self.first.seconds
    }

    /// What a player's move of that number brings. The last period begins anew when its moves are
    /// made.
    fn gain(&self, number: u32) -> Gain {
        let mut rest = number;
        let mut period = self.first;
        let mut further = self.further.iter().copied();
        loop {
            let next = further.next();
            match (period.moves, next) {
                (Some(moves), Some(next)) if rest > moves => {
                    rest -= moves;
                    period = next;
                }
                (Some(moves), next) => {
                    let is_last = rest.is_multiple_of(moves);
                    let seconds = if is_last { next.unwrap_or(period).seconds } else { 0.0 };
                    return Gain { increment: period.increment, period: seconds };
                }
                (None, _) => return Gain { increment: period.increment, period: 0.0 },
            }
        }
    }
}

impl Period {
    fn parse(text: &str) -> Option<Period> {
        let (moves, time) = match text.split_once('/') {
            Some((moves, time)) => (Some(moves.parse().ok().filter(|moves| *moves > 0)?), time),
            None => (None, text),
        };
        let (seconds, increment) = time.split_once('+').unwrap_or((time, "0"));
        let [seconds, increment] = [seconds, increment].map(command::decimal);
        Some(Period { moves, seconds: seconds?, increment: increment? })
    }
}
