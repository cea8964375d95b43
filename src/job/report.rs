//! The records beside the pictures: `game.json` and the lines of `report.jsonl`.

use serde::Serialize;
use serde_json::{Map, Value};

use super::SettingsRecord;
use crate::game::{Game, Problem};
use crate::notation::Color;
use crate::timeline::{Film, Frame};

/// What became of a game.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// All of it was rendered.
    Rendered,
    /// Rendered up to its last good move.
    Partial,
    /// Not rendered.
    Skipped,
}

/// A game's line of `report.jsonl`.
#[derive(Serialize)]
pub struct ReportLine {
    pub game: usize,
    pub line: usize,
    pub white: String,
    pub black: String,
    pub result: String,
    pub status: Status,
    /// Half-moves that could be played.
    pub plies: usize,
    /// Pictures that were written.
    pub frames: usize,
    /// The folder of the pictures, beside the report.
    pub folder: Option<String>,
    pub problems: Vec<ProblemRecord>,
}

/// A [`Problem`] for machines.
#[derive(Serialize)]
pub struct ProblemRecord {
    line: usize,
    token: String,
    what: String,
    loses_moves: bool,
}

/// `game.json`.
#[derive(Serialize)]
pub struct Manifest<'a> {
    pub file: String,
    pub game: usize,
    pub line: usize,
    pub tags: Map<String, Value>,
    pub result: &'a str,
    pub problems: Vec<ProblemRecord>,
    pub settings: &'a SettingsRecord<'a>,
    pub film: Option<Film>,
    pub orbit: f64,
    pub frames: Vec<FrameRow>,
}

/// One picture of a manifest.
#[derive(Serialize)]
pub struct FrameRow {
    pub file: String,
    /// Seconds from the beginning of the film.
    pub time: f64,
    /// Half-moves before the position that is shown, or that the move under way leaves.
    pub ply: usize,
    pub san: Option<String>,
    pub fen: String,
    pub white: String,
    pub black: String,
}

impl FrameRow {
    pub fn new(file: String, game: &Game, frame: &Frame) -> FrameRow {
        let placement = game.placement(frame.ply);
        FrameRow {
            file,
            // To the microsecond: sums of decimal fractions leave crumbs behind.
            time: (frame.time * 1e6).round() / 1e6,
            ply: frame.ply,
            san: game.san(frame.ply).map(str::to_owned),
            fen: game.fen(frame.ply),
            white: placement.notation(Color::White),
            black: placement.notation(Color::Black),
        }
    }

    /// What the picture itself says.
    pub fn texts(&self, game: &Game) -> Vec<(&'static str, String)> {
        let players = [Color::White, Color::Black].map(|color| game.player(color));
        vec![
            ("Title", players.join(" - ")),
            ("Software", concat!("lightsquare ", env!("CARGO_PKG_VERSION")).to_owned()),
            ("Game", game.number.to_string()),
            ("Ply", self.ply.to_string()),
            ("SAN", self.san.clone().unwrap_or_else(|| "-".to_owned())),
            ("FEN", self.fen.clone()),
        ]
    }
}

pub fn tags(game: &Game) -> Map<String, Value> {
    game.tags.iter().map(|(name, value)| (name.clone(), value.clone().into())).collect()
}

pub fn problems(problems: &[Problem]) -> Vec<ProblemRecord> {
    problems
        .iter()
        .map(|problem| ProblemRecord {
            line: problem.line,
            token: problem.token.clone(),
            what: problem.what.clone(),
            loses_moves: problem.loses_moves,
        })
        .collect()
}

impl ReportLine {
    pub fn new(game: &Game, status: Status, frames: usize, folder: Option<String>) -> ReportLine {
        ReportLine {
            game: game.number,
            line: game.line,
            white: game.player(Color::White).to_owned(),
            black: game.player(Color::Black).to_owned(),
            result: game.result.clone(),
            status,
            plies: game.plies.len(),
            frames,
            folder,
            problems: problems(&game.problems),
        }
    }
}
