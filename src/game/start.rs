//! Where a game starts: the tags `FEN`, `SetUp` and `Variant`.

use shakmaty::fen::Fen;
use shakmaty::{CastlingMode, Chess, EnPassantMode, FromSetup, PositionError, Setup};

use super::tag;

/// Names of standard chess and of Chess960, in lower case without blanks, `-` and `_`.
const STANDARD: [&str; 6] = ["", "?", "standard", "chess", "normal", "fromposition"];
const CHESS960: [&str; 4] = ["chess960", "960", "fischerandom", "fischerrandom"];

/// Why a game cannot be replayed from its tags: the tag in question, and a clause about it.
pub struct Refusal {
    pub token: String,
    pub what: String,
}

/// The start position that `tags` describe.
pub fn setup(tags: &[(String, String)]) -> Result<Setup, Refusal> {
    let variant = tag(tags, "Variant").unwrap_or_default();
    let plain: String =
        variant.to_lowercase().chars().filter(|c| !matches!(c, ' ' | '-' | '_')).collect();
    if !STANDARD.contains(&plain.as_str()) && !CHESS960.contains(&plain.as_str()) {
        return Err(Refusal {
            token: format!("[Variant \"{variant}\"]"),
            what: "is a variant that cannot be played yet, expected standard chess or Chess960"
                .to_owned(),
        });
    }
    match tag(tags, "FEN").map(str::trim).filter(|fen| !fen.is_empty() && *fen != "?") {
        Some(fen) => fen.parse::<Fen>().map(Fen::into_setup).map_err(|error| Refusal {
            token: format!("[FEN \"{fen}\"]"),
            what: format!("is no position: {error}"),
        }),
        None if tag(tags, "SetUp").map(str::trim) == Some("1") => Err(Refusal {
            token: "[SetUp \"1\"]".to_owned(),
            what: "promises a FEN, but there is none".to_owned(),
        }),
        None if CHESS960.contains(&plain.as_str()) => Err(Refusal {
            token: format!("[Variant \"{variant}\"]"),
            what: "needs a FEN, but there is none".to_owned(),
        }),
        None => Ok(Setup::initial()),
    }
}

/// The position to play from, or why there is none; castling is read in the Chess960 way, which covers both. What does
/// not hinder play (too many pieces, castling rights without a rook) is let pass.
pub fn position(setup: &Setup) -> Result<Chess, String> {
    Chess::from_setup(setup.clone(), CastlingMode::Chess960)
        .or_else(PositionError::ignore_too_much_material)
        .or_else(PositionError::ignore_invalid_castling_rights)
        .or_else(PositionError::ignore_invalid_ep_square)
        .or_else(PositionError::ignore_impossible_check)
        .map_err(|error| error.to_string())
}

/// The position of a FEN, where it is one that can be played.
pub fn fen_position(fen: &str) -> Option<Chess> {
    let fen: Fen = fen.trim().parse().ok()?;
    position(fen.as_setup()).ok()
}

/// `setup` as a FEN, cleaned by the rules where it is a position that can be played.
pub fn fen(setup: &Setup) -> String {
    match position(setup) {
        Ok(position) => Fen::from_position(&position, EnPassantMode::Legal).to_string(),
        Err(_) => match Fen::try_from_setup(setup.clone()) {
            Ok(fen) => fen.to_string(),
            Err(lossy) => lossy.ignore().to_string(),
        },
    }
}
