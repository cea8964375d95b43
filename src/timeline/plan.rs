//! How the pieces of a move get where they go without touching anything.
//!
//! Each piece takes the first way of a short list that is free: low before high, all at once before
//! one after the other. The last of the list is straight up, across above everything and straight down
//! again; who makes way is out of the way, or high above, while the other one moves.

use super::bodies::{Bodies, Envelope};
use super::flight::{Flight, ease};
use super::motion::{Motion, Step};
use super::pieces::{Mover, Position, Spot, Taken};
use super::tray;
use crate::notation::{Piece, Placement, Square};

/// How far moving pieces keep from others at least, in squares, unless they stand nearer at rest.
const CLEAR: f64 = 0.02;

/// At so many times of a move it is looked whether pieces touch; between two of them a piece goes a
/// tenth of a square or so.
const LOOKS: u32 = 128;

/// Heights are tried in steps of this, in squares.
const STEP: f64 = 0.05;

/// The part of a move's time after which a pawn that becomes something else has arrived.
const ARRIVED: f64 = 0.62;

/// The least size of a pawn and of what it becomes: small enough to change into each other, and never nothing.
const SEED: f64 = 0.3;

/// A manner of moving.
struct Manner {
    /// The least height, in squares.
    least: f64,
    /// Shares of the time to rise in, and to go straight up in, from the fairest to the safest; and whether
    /// it settles gently, but in the last of them.
    shapes: [(f64, f64); 3],
    settles: bool,
}

/// A slight lift.
const GLIDE: Manner =
    Manner { least: 0.05, shapes: [(0.25, 0.0), (0.25, 0.1), (0.3, 0.3)], settles: false };
const HOP: Manner =
    Manner { least: 1.0, shapes: [(0.5, 0.0), (0.4, 0.1), (0.3, 0.3)], settles: false };
/// A captured piece's way out.
const LEAVE: Manner =
    Manner { least: 0.6, shapes: [(0.4, 0.12), (0.35, 0.2), (0.3, 0.3)], settles: true };

/// When who makes way ends, and when the other one begins and how early it has to be there.
type Times = (f64, f64, f64);

const CAPTURES: [Times; 6] = [
    (1.0, 0.0, 1.0),
    (1.0, 0.1, 1.0),
    (1.0, 0.2, 1.0),
    (0.9, 0.3, 1.0),
    (0.75, 0.4, 1.0),
    (0.5, 0.5, 1.0),
];
/// The rook has gone up before the king comes, and comes down behind it.
const CASTLINGS: [Times; 3] = [(1.0, 0.0, 1.0), (1.0, 0.15, 0.85), (1.0, 0.3, 0.7)];

/// How far above the tallest piece pieces are lifted at most, in squares.
const ABOVE: f64 = 0.1;

/// The greatest height that a piece is lifted to, in squares.
pub fn ceiling(bodies: &Bodies) -> f64 {
    bodies.tallest()[0] + ABOVE
}

/// The ways of all pieces that a move moves.
#[derive(Clone, Debug)]
pub struct Plan(Vec<Leg>);

/// The way of one piece.
#[derive(Clone, Debug)]
struct Leg {
    from: Square,
    piece: Piece,
    identity: Square,
    flight: Flight,
    becomes: Option<Piece>,
}

/// A piece that is to go somewhere.
struct Task<'a> {
    leg: Leg,
    envelope: &'a Envelope,
    manner: Manner,
}

impl Plan {
    /// The ways of `motion`, which leaves the position `before`.
    pub fn new(motion: &Motion, before: &Position, bodies: &Bodies) -> Plan {
        let mut tasks: Vec<Task> = Vec::new();
        // Who makes way comes last.
        tasks.extend(motion.steps.iter().filter_map(|step| go(step, before, bodies)));
        let captured = motion.captured.and_then(|square| leave(square, before, bodies));
        let times: &[Times] = if captured.is_some() { &CAPTURES } else { &CASTLINGS };
        tasks.extend(captured);
        let field = Field::new(&tasks, before, bodies);
        let mut tasks = tasks.into_iter();
        let legs = match (tasks.next(), tasks.next()) {
            (Some(alone), None) => vec![field.alone(&alone)],
            (Some(main), Some(other)) => field.together(&main, &other, times),
            (None, _) => Vec::new(),
        };
        Plan(legs)
    }

    /// What stands and what moves when the part `passed` (0 to 1) of the move's time is over.
    pub fn under_way(&self, before: &Position, passed: f64) -> (Placement, Vec<Mover>) {
        let mut standing = before.placement;
        let mut movers = Vec::new();
        for Leg { from, piece, identity, flight, becomes } in &self.0 {
            standing.set(*from, None);
            let spot = flight.at(passed);
            let mut add = |piece, size| {
                movers.push(Mover { piece, identity: *identity, spot, size });
            };
            match becomes {
                None => add(*piece, 1.0),
                Some(becomes) => {
                    // The pawn shrinks away, and the other one grows where it stood.
                    let share = (passed - ARRIVED) / (1.0 - ARRIVED);
                    if share < 0.5 {
                        add(*piece, (1.0 - ease(2.0 * share)).max(SEED));
                    } else {
                        add(*becomes, ease(2.0 * share - 1.0).max(SEED));
                    }
                }
            }
        }
        (standing, movers)
    }
}

/// The task of a piece that goes from a square to another one.
fn go<'a>(step: &Step, before: &Position, bodies: &'a Bodies) -> Option<Task<'a>> {
    let piece = before.placement.get(step.from)?;
    let manner = if step.hops { HOP } else { GLIDE };
    let end = if step.becomes.is_some() { ARRIVED } else { 1.0 };
    let flight = Flight { end, ..level(Spot::on(step.from), Spot::on(step.to)) };
    let becomes = step.becomes.map(|role| Piece { role, ..piece });
    let leg =
        Leg { from: step.from, piece, identity: before.identities.get(step.from), flight, becomes };
    Some(Task { leg, envelope: bodies.of(piece.role), manner })
}

/// The task of a captured piece.
fn leave<'a>(square: Square, before: &Position, bodies: &'a Bodies) -> Option<Task<'a>> {
    let piece = before.placement.get(square)?;
    let identity = before.identities.get(square);
    let taken = [&before.taken[..], &[Taken { piece, identity }]].concat();
    let (_, place) = tray::places(&taken, bodies).last()?;
    let flight = level(Spot::on(square), place);
    let leg = Leg { from: square, piece, identity, flight, becomes: None };
    Some(Task { leg, envelope: bodies.of(piece.role), manner: LEAVE })
}

fn level(from: Spot, to: Spot) -> Flight {
    Flight { from, to, over: 0.0, rise: 0.5, settles: false, steep: 0.0, begin: 0.0, end: 1.0 }
}

/// What stands round the pieces that move.
struct Field<'a> {
    standing: Vec<(&'a Envelope, Spot)>,
    /// From the board's middle to its outer edge, in squares.
    edge: f64,
    ceiling: f64,
}

impl<'a> Field<'a> {
    fn new(tasks: &[Task], before: &Position, bodies: &'a Bodies) -> Field<'a> {
        let stays = |square: &Square| tasks.iter().all(|task| task.leg.from != *square);
        let standing = before.placement.iter().filter(|(square, _)| stays(square));
        let standing = standing.map(|(square, piece)| (bodies.of(piece.role), Spot::on(square)));
        let taken = tray::places(&before.taken, bodies);
        let taken = taken.map(|(taken, spot)| (bodies.of(taken.piece.role), spot));
        Field {
            standing: standing.chain(taken).collect(),
            edge: bodies.edge,
            ceiling: ceiling(bodies),
        }
    }

    /// The lowest free way of one piece.
    fn alone(&self, task: &Task) -> Leg {
        let mut ways = self.ways(task);
        Leg { flight: ways.next().unwrap_or_else(|| self.safest(task)), ..task.leg.clone() }
    }

    /// Ways of two pieces that meet neither others nor each other; `other` makes way for `main`.
    fn together(&self, main: &Task, other: &Task, times: &[Times]) -> Vec<Leg> {
        let free = self.alone(main);
        let ways: Vec<Flight> = self.ways(other).chain([self.safest(other)]).collect();
        let with = |(ends, begins, there): &Times| {
            let (begin, end) = (begins * free.flight.end, there * free.flight.end);
            let (ends, main) = (*ends, Flight { begin, end, ..free.flight });
            ways.iter().map(move |way| (Flight { end: ends, ..*way }, main))
        };
        let pairs: Vec<(Flight, Flight)> = times.iter().flat_map(with).collect();
        let are_apart = |(way, flight): &&(Flight, Flight)| {
            let gap = |passed| other.envelope.gap(way.at(passed), main.envelope, flight.at(passed));
            let least = CLEAR.min(gap(0.0)).min(gap(1.0)) - ROUNDING;
            looks().all(|passed| gap(passed) >= least)
        };
        let chosen = pairs.iter().find(are_apart).or(pairs.last());
        let (way, flight) = chosen.copied().unwrap_or((self.safest(other), free.flight));
        // The piece that goes somewhere is told of first.
        vec![Leg { flight, ..free }, Leg { flight: way, ..other.leg.clone() }]
    }

    /// All ways of a piece that meet nothing that stands, from the fairest to the safest.
    fn ways<'b>(&'b self, task: &'b Task) -> impl Iterator<Item = Flight> + 'b {
        let Task { leg, manner, .. } = task;
        let heights = ((self.ceiling - manner.least) / STEP).ceil().max(0.0) as u32;
        let flights = manner.shapes.iter().flat_map(move |(rise, steep)| {
            (0..=heights).map(move |step| {
                let over = (manner.least + f64::from(step) * STEP).min(self.ceiling);
                let settles = manner.settles && *steep < *rise;
                Flight { over, rise: *rise, settles, steep: *steep, ..leg.flight }
            })
        });
        flights.filter(|flight| self.is_free(task.envelope, flight))
    }

    /// Straight up, across above everything, straight down.
    fn safest(&self, task: &Task) -> Flight {
        let [.., (rise, steep)] = task.manner.shapes;
        Flight { over: self.ceiling, rise, steep, ..task.leg.flight }
    }

    fn is_free(&self, envelope: &Envelope, flight: &Flight) -> bool {
        let reach = self.edge + envelope.radius();
        let sinks = |spot: Spot| spot.height < 0.0 && spot.from_middle() < reach;
        !looks().any(|passed| sinks(flight.at(passed))) && self.clears(envelope, flight)
    }

    /// Whether it keeps clear of all that stands.
    fn clears(&self, envelope: &Envelope, flight: &Flight) -> bool {
        let mut near = self.standing.iter().filter(|(other, spot)| {
            let most = envelope.radius() + other.radius() + CLEAR;
            spot.apart(flight.nearest(*spot)) < most
        });
        near.all(|(other, spot)| {
            let gap = |place| envelope.gap(place, other, *spot);
            let least = CLEAR.min(gap(flight.from)).min(gap(flight.to)) - ROUNDING;
            looks().all(|passed| gap(flight.at(passed)) >= least)
        })
    }
}

/// What sums of decimal fractions leave behind.
const ROUNDING: f64 = 1e-9;

/// Shares of a move's time.
fn looks() -> impl Iterator<Item = f64> {
    (0..=LOOKS).map(|look| f64::from(look) / f64::from(LOOKS))
}
