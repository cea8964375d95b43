//! Pieces beside the board: captured ones, or those that players have in hand.

use shakmaty::{ByColor, ByRole};

use super::bodies::Bodies;
use super::pieces::{Mover, Spot, Taken};
use super::tray;
use crate::notation::{Color, Piece, Placement, Role, Square};

/// What stands beside the board at rest.
#[derive(Clone)]
pub enum Beside {
    /// Captured pieces in the order of their capture, on so many columns a player.
    Captured { taken: Vec<Taken>, columns: u32 },
    /// What White has in hand, and Black, by place: who is dropped leaves his own free, and the next one takes the
    /// first that is.
    InHand([Vec<Option<Taken>>; 2]),
}

/// In hand at first they stand in this order.
const ORDER: [Role; 6] =
    [Role::Queen, Role::Rook, Role::Bishop, Role::Knight, Role::Pawn, Role::King];

impl Beside {
    /// Nothing yet, with room for what can be captured of `start`.
    pub fn captured(start: &Placement, bodies: &Bodies) -> Beside {
        Beside::Captured { taken: Vec::new(), columns: tray::columns_for(start, bodies) }
    }

    /// What players have `in_hand` beside the pieces of `start`. Each is named for a square where nothing stands.
    pub fn in_hand(in_hand: &ByColor<ByRole<u8>>, start: &Placement) -> Beside {
        let mut free =
            Square::ALL.into_iter().filter(|square| start.get(*square).is_none()).cycle();
        let mut hands: [Vec<Option<Taken>>; 2] = Default::default();
        for color in Color::ALL {
            for role in ORDER {
                for _ in 0..*in_hand.get(color).get(role) {
                    let identity = free.next().unwrap_or(Square::A1);
                    let piece = Piece { color, role };
                    hands[color.fold_wb(0, 1)].push(Some(Taken { piece, identity }));
                }
            }
        }
        Beside::InHand(hands)
    }

    /// Sets a piece down.
    pub fn add(&mut self, piece: Taken) {
        match self {
            Beside::Captured { taken, .. } => taken.push(piece),
            Beside::InHand(hands) => {
                let hand = &mut hands[piece.piece.color.fold_wb(0, 1)];
                match hand.iter_mut().find(|place| place.is_none()) {
                    Some(place) => *place = Some(piece),
                    None => hand.push(Some(piece)),
                }
            }
        }
    }

    /// The piece in hand that is to be dropped: of several, the one that stands last.
    pub fn next(&self, piece: Piece) -> Option<Taken> {
        let Beside::InHand(hands) = self else {
            return None;
        };
        let hand = &hands[piece.color.fold_wb(0, 1)];
        hand.iter().rev().flatten().find(|held| held.piece == piece).copied()
    }

    /// Takes a piece out of a hand.
    pub fn remove(&mut self, piece: Taken) {
        let Beside::InHand(hands) = self else {
            return;
        };
        let hand = &mut hands[piece.piece.color.fold_wb(0, 1)];
        if let Some(place) = hand.iter_mut().find(|place| **place == Some(piece)) {
            *place = None;
        }
        // Places behind the last piece are none.
        hand.truncate(hand.iter().rposition(Option::is_some).map_or(0, |last| last + 1));
    }

    /// Takes captured pieces away; what is in hand stays.
    pub fn clear(&mut self) {
        if let Beside::Captured { taken, .. } = self {
            taken.clear();
        }
    }

    /// How many columns a player's pieces take.
    pub fn columns(&self, bodies: &Bodies) -> u32 {
        match self {
            Beside::Captured { columns, .. } => *columns,
            Beside::InHand(hands) => {
                let most = hands.iter().map(Vec::len).max().unwrap_or(0);
                tray::columns_in_hand(most, bodies)
            }
        }
    }

    /// Each piece and where it stands.
    pub fn places(&self, bodies: &Bodies) -> Vec<(Taken, Spot)> {
        match self {
            Beside::Captured { taken, columns } => tray::places(taken, *columns, bodies),
            Beside::InHand(hands) => {
                let on_places = hands.iter().flat_map(|hand| hand.iter().enumerate());
                let held = on_places.filter_map(|(place, held)| Some((place, (*held)?)));
                held.map(|(place, held)| {
                    (held, tray::place_in_hand(place, held.piece.color, bodies))
                })
                .collect()
            }
        }
    }

    /// The pieces as frames show them.
    pub fn movers(&self, bodies: &Bodies) -> Vec<Mover> {
        let stand = |(Taken { piece, identity }, spot)| Mover { piece, identity, spot, size: 1.0 };
        self.places(bodies).into_iter().map(stand).collect()
    }
}
