//! Where a game starts, and by which rules: the tags `FEN`, `SetUp` and `Variant`.

use shakmaty::fen::Fen;
use shakmaty::variant::{Variant, VariantPosition};
use shakmaty::{ByColor, ByRole, CastlingMode, EnPassantMode, Position, PositionError, Setup};

use super::tag;
use super::variant::Rules;

/// Why a game cannot be replayed from its tags: the tag in question, and a clause about it.
pub struct Refusal {
    pub token: String,
    pub what: String,
}

/// The rules and the start position that `tags` describe.
pub fn setup(tags: &[(String, String)]) -> Result<(Variant, Setup), Refusal> {
    let name = tag(tags, "Variant").unwrap_or_default();
    let refusal = |what: String| Refusal { token: format!("[Variant \"{name}\"]"), what };
    let Rules { variant, is_shuffled } = Rules::of_tag(name).map_err(refusal)?;
    match tag(tags, "FEN").map(str::trim).filter(|fen| !fen.is_empty() && *fen != "?") {
        Some(fen) => match fen.parse::<Fen>() {
            // Where nobody says it, the FEN may.
            Ok(fen) if name.trim().is_empty() => Ok((told_by(fen.as_setup()), fen.into_setup())),
            Ok(fen) => Ok((variant, fen.into_setup())),
            Err(error) => Err(Refusal {
                token: format!("[FEN \"{fen}\"]"),
                what: format!("is no position: {error}"),
            }),
        },
        None if tag(tags, "SetUp").map(str::trim) == Some("1") => Err(Refusal {
            token: "[SetUp \"1\"]".to_owned(),
            what: "promises a FEN, but there is none".to_owned(),
        }),
        None if is_shuffled => Err(refusal("needs a FEN, but there is none".to_owned())),
        None => Ok((variant, VariantPosition::new(variant).to_setup(EnPassantMode::Always))),
    }
}

/// The variant that has what a FEN tells: pieces in hand, checks to be given.
fn told_by(setup: &Setup) -> Variant {
    match (setup.pockets, setup.remaining_checks) {
        (Some(_), _) => Variant::Crazyhouse,
        (None, Some(_)) => Variant::ThreeCheck,
        (None, None) => Variant::Chess,
    }
}

/// The position to play from, or why there is none; castling is read in the Chess960 way, which covers both.
/// What does not hinder play (too many pieces, castling rights without a rook) is let pass.
pub fn position(variant: Variant, setup: &Setup) -> Result<VariantPosition, String> {
    VariantPosition::from_setup(variant, setup.clone(), CastlingMode::Chess960)
        .or_else(PositionError::ignore_too_much_material)
        .or_else(PositionError::ignore_invalid_castling_rights)
        .or_else(PositionError::ignore_invalid_ep_square)
        .or_else(PositionError::ignore_impossible_check)
        .map_err(|error| error.to_string())
}

/// The position of a FEN, where it is one that can be played: of crazyhouse or three-check where it has pieces
/// in hand or checks to be given, else of standard chess.
pub fn fen_position(fen: &str) -> Option<VariantPosition> {
    let fen: Fen = fen.trim().parse().ok()?;
    position(told_by(fen.as_setup()), fen.as_setup()).ok()
}

/// What a FEN says that players have in hand, where it does.
pub fn fen_in_hand(fen: &str) -> Option<ByColor<ByRole<u8>>> {
    fen.trim().parse::<Fen>().ok()?.as_setup().pockets
}

/// `setup` as a FEN, cleaned by the rules where it is a position that can be played.
pub fn fen(variant: Variant, setup: &Setup) -> String {
    match position(variant, setup) {
        Ok(position) => Fen::from_position(&position, EnPassantMode::Legal).to_string(),
        Err(_) => match Fen::try_from_setup(setup.clone()) {
            Ok(fen) => fen.to_string(),
            Err(lossy) => lossy.ignore().to_string(),
        },
    }
}
