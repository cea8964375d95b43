//! How the pieces of a move get where they go without touching anything.
//!
//! Each piece takes the first way of a short list that is free: low before high, all at once before
//! one after the other. The last of the list is straight up, across above everything and straight down
//! again; who makes way is out of the way, or high above, while the other one moves.

use super::bodies::{Bodies, Envelope};
use super::flight::{Flight, ease};
use super::motion::{Captured, Drop, Motion, Step};
use super::pieces::{Mover, Position, Spot, Taken};
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
/// The way from a hand to a square.
const COME: Manner = Manner { settles: false, ..LEAVE };

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

/// Of a capture that blows pieces up: when who is captured has shrunk away, the times at which who captures
/// may set out, and when he has arrived and all the others go.
const CLEARED: f64 = 0.4;
const STRIKES: [f64; 5] = [0.0, 0.1, 0.2, 0.3, CLEARED];
const STRUCK: f64 = 0.7;

/// How far pieces that are blown up rise while they shrink away, in squares, and their least size.
const BLAST: f64 = 0.5;
const LEAST: f64 = 0.04;

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
    /// The square that it leaves, unless it comes from beside the board.
    from: Option<Square>,
    piece: Piece,
    identity: Square,
    flight: Flight,
    fate: Fate,
}

/// What is to become of a piece that moves.
#[derive(Clone, Copy, Debug)]
enum Fate {
    Stays,
    /// Once it has arrived it gives way to another one.
    Becomes(Piece),
    /// It shrinks away between two times, and rises so far.
    Vanishes {
        begin: f64,
        end: f64,
        rises: f64,
    },
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
        if !motion.exploded.is_empty() {
            return Plan::explosion(motion, before, bodies);
        }
        let mut tasks: Vec<Task> = Vec::new();
        // Who makes way comes last.
        tasks.extend(motion.steps.iter().filter_map(|step| go(step, before, bodies)));
        tasks.extend(motion.dropped.and_then(|drop| come(drop, before, bodies)));
        let captured = motion.captured.and_then(|captured| leave(captured, before, bodies));
        let times: &[Times] = if captured.is_some() { &CAPTURES } else { &CASTLINGS };
        tasks.extend(captured);
        let field = Field::new(tasks.iter().map(|task| &task.leg), before, bodies);
        let mut tasks = tasks.into_iter();
        let legs = match (tasks.next(), tasks.next()) {
            (Some(alone), None) => vec![field.alone(&alone)],
            (Some(main), Some(other)) => field.together(&main, &other, times),
            (None, _) => Vec::new(),
        };
        Plan(legs)
    }

    /// Who is captured shrinks away, and who captured him with all the others that are blown up.
    fn explosion(motion: &Motion, before: &Position, bodies: &Bodies) -> Plan {
        let at = |square, fate| {
            let flight = level(Spot::on(square), Spot::on(square));
            let piece = before.placement.get(square)?;
            let identity = before.identities.get(square);
            Some(Leg { from: Some(square), piece, identity, flight, fate })
        };
        let fate = Fate::Vanishes { begin: STRUCK, end: 1.0, rises: BLAST };
        let step = motion.steps.first();
        let mut legs = Vec::new();
        if let Some(step) = step
            && let Some(mut main) = go(step, before, bodies)
        {
            (main.leg.fate, main.leg.flight.end) = (fate, STRUCK);
            let victim = at(step.to, Fate::Vanishes { begin: 0.0, end: CLEARED, rises: 0.0 });
            let gone = victim.iter().chain([&main.leg]);
            let field = Field::new(gone, before, bodies);
            let free = field.alone(&main);
            let flight = victim.as_ref().map_or(free.flight, |victim| {
                let begin = STRIKES.iter().find(|begin| {
                    let flight = Flight { begin: **begin, ..free.flight };
                    strikes_free(&flight, main.envelope, victim, bodies)
                });
                Flight { begin: *begin.unwrap_or(&CLEARED), ..free.flight }
            });
            legs.push(Leg { flight, ..free });
            legs.extend(victim);
        }
        let ends = |square: &&Square| step.is_none_or(|s| s.from != **square && s.to != **square);
        legs.extend(motion.exploded.iter().filter(ends).filter_map(|square| at(*square, fate)));
        Plan(legs)
    }

    /// What stands and what moves when the part `passed` (0 to 1) of the move's time is over.
    pub fn under_way(&self, before: &Position, passed: f64) -> (Placement, Vec<Mover>) {
        let mut standing = before.placement;
        let mut movers = Vec::new();
        for leg in &self.0 {
            let Leg { from, piece, identity, flight, fate } = leg;
            if let Some(from) = from {
                standing.set(*from, None);
            }
            let spot = flight.at(passed);
            let mut add = |piece, size| {
                movers.push(Mover { piece, identity: *identity, spot, size });
            };
            match fate {
                Fate::Stays => add(*piece, 1.0),
                Fate::Vanishes { rises, .. } => {
                    let Some(size) = leg.size(passed) else { continue };
                    let height = spot.height + rises * (1.0 - size);
                    let spot = Spot { height, ..spot };
                    movers.push(Mover { piece: *piece, identity: *identity, spot, size });
                }
                Fate::Becomes(becomes) => {
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

impl Leg {
    /// How large a piece that vanishes is, as a share of its own size; nothing once it is gone.
    fn size(&self, passed: f64) -> Option<f64> {
        let Fate::Vanishes { begin, end, .. } = self.fate else {
            return Some(1.0);
        };
        let share = (passed - begin) / (end - begin);
        (share < 1.0).then(|| (1.0 - ease(share)).max(LEAST))
    }
}

/// Whether a piece on its way keeps clear of one that shrinks away, whatever their heights.
fn strikes_free(flight: &Flight, envelope: &Envelope, victim: &Leg, bodies: &Bodies) -> bool {
    let radius = bodies.of(victim.piece.role).radius();
    looks().all(|passed| {
        let reach = victim.size(passed).map(|size| radius * size + envelope.radius() + CLEAR);
        reach.is_none_or(|reach| flight.at(passed).apart(victim.flight.from) >= reach)
    })
}

/// The task of a piece that goes from a square to another one.
fn go<'a>(step: &Step, before: &Position, bodies: &'a Bodies) -> Option<Task<'a>> {
    let piece = before.placement.get(step.from)?;
    let manner = if step.hops { HOP } else { GLIDE };
    let end = if step.becomes.is_some() { ARRIVED } else { 1.0 };
    let flight = Flight { end, ..level(Spot::on(step.from), Spot::on(step.to)) };
    let fate = step.becomes.map_or(Fate::Stays, |role| Fate::Becomes(Piece { role, ..piece }));
    let identity = before.identities.get(step.from);
    let leg = Leg { from: Some(step.from), piece, identity, flight, fate };
    Some(Task { leg, envelope: bodies.of(piece.role), manner })
}

/// The task of a captured piece. In a hand it becomes one of who has it there.
fn leave<'a>(captured: Captured, before: &Position, bodies: &'a Bodies) -> Option<Task<'a>> {
    let Captured { on, held } = captured;
    let piece = before.placement.get(on)?;
    let identity = before.identities.get(on);
    let mut beside = before.beside.clone();
    beside.add(Taken { piece: held.unwrap_or(piece), identity });
    let places = beside.places(bodies);
    let (_, place) = places.iter().find(|(taken, _)| taken.identity == identity)?;
    let end = if held.is_some() { ARRIVED } else { 1.0 };
    let flight = Flight { end, ..level(Spot::on(on), *place) };
    let fate = held.map_or(Fate::Stays, Fate::Becomes);
    let leg = Leg { from: Some(on), piece, identity, flight, fate };
    Some(Task { leg, envelope: bodies.of(piece.role), manner: LEAVE })
}

/// The task of a piece that comes from a hand.
fn come<'a>(drop: Drop, before: &Position, bodies: &'a Bodies) -> Option<Task<'a>> {
    let Taken { piece, identity } = before.beside.next(drop.piece)?;
    let places = before.beside.places(bodies);
    let (_, place) = places.iter().find(|(held, _)| held.identity == identity)?;
    let flight = level(*place, Spot::on(drop.to));
    let leg = Leg { from: None, piece, identity, flight, fate: Fate::Stays };
    Some(Task { leg, envelope: bodies.of(piece.role), manner: COME })
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
    /// All of `before` but those that go the ways of `legs`.
    fn new<'b>(
        legs: impl Iterator<Item = &'b Leg> + Clone,
        before: &Position,
        bodies: &'a Bodies,
    ) -> Field<'a> {
        let stays = |identity: Square| legs.clone().all(|leg| leg.identity != identity);
        let standing = before.placement.iter();
        let standing = standing.filter(|(square, _)| stays(before.identities.get(*square)));
        let standing = standing.map(|(square, piece)| (bodies.of(piece.role), Spot::on(square)));
        let beside = before.beside.places(bodies).into_iter();
        let beside = beside.filter(|(taken, _)| stays(taken.identity));
        let beside = beside.map(|(taken, spot)| (bodies.of(taken.piece.role), spot));
        Field {
            standing: standing.chain(beside).collect(),
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
            ways.iter().map(move |way| (Flight { end: ends * way.end, ..*way }, main))
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
