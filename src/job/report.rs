//! The records beside the pictures: `game.json` and the lines of `report.jsonl`.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::OnceLock;

use serde::{Serialize, Serializer};
use serde_json::{Map, Value};

use super::batch::Batch;
use super::settings::SettingsRecord;
use crate::game::{Game, Problem, Variation};
use crate::notation::Color;
use crate::output::{JsonLines, OutputError, remove_file};
use crate::text::shortened;
use crate::timeline::{Card, Film, Frame, Gaze};

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
    /// The run was stopped, or failed, while this game was rendered.
    Stopped,
}

/// `report.jsonl` under way: lines in the order of the games, whichever of them is done first.
pub struct Report {
    lines: JsonLines,
    /// Those that come after one that is still missing, by their places.
    waiting: BTreeMap<usize, ReportLine>,
    next: usize,
}

impl Report {
    /// Begins the report of the games in `folder`. An earlier one is removed: it tells of what is no more.
    pub fn anew(folder: &Path) -> Result<Report, OutputError> {
        let path = folder.join("report.jsonl");
        remove_file(&path)?;
        Report::begin(&path)
    }

    /// Begins a report in the file `path`.
    pub fn begin(path: &Path) -> Result<Report, OutputError> {
        let lines = JsonLines::begin(path)?;
        Ok(Report { lines, waiting: BTreeMap::new(), next: 0 })
    }

    /// How many lines it has.
    pub fn lines(&self) -> usize {
        self.next
    }

    /// Adds the line of the game at `place`, counted from 0.
    pub fn add(&mut self, place: usize, line: ReportLine) -> Result<(), OutputError> {
        self.waiting.insert(place, line);
        while let Some(line) = self.waiting.remove(&self.next) {
            self.lines.add(&line)?;
            self.next += 1;
        }
        Ok(())
    }

    /// Puts it in its place, with all lines that there are.
    pub fn finish(mut self) -> Result<(), OutputError> {
        for line in self.waiting.values() {
            self.lines.add(line)?;
        }
        self.lines.finish()
    }
}

/// A game's line of `report.jsonl`.
#[derive(Serialize)]
pub struct ReportLine {
    /// In the report of a shard.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    game: usize,
    line: usize,
    white: String,
    black: String,
    result: String,
    status: Status,
    /// Half-moves that could be played.
    plies: usize,
    /// Pictures that are there, or went into films.
    frames: u64,
    /// The folder of the pictures, beside the report; of a shard, in the folder of all output.
    folder: Option<String>,
    problems: Vec<Problem>,
    /// Those that were rendered with it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    variations: Vec<VariationLine>,
}

/// A variation in the line of its game.
#[derive(Serialize)]
pub struct VariationLine {
    /// The folder of the pictures, within the game's; none where no move could be played.
    folder: Option<String>,
    /// Half-moves from the game's start.
    plies: usize,
    frames: u64,
    problems: Vec<Problem>,
}

impl VariationLine {
    /// The line of a variation, which `line` has gone on with.
    pub fn new(line: &Game, folder: &Path, frames: u64) -> VariationLine {
        VariationLine {
            folder: Some(folder.to_string_lossy().into_owned()),
            plies: line.plies.len(),
            frames,
            problems: line.problems.clone(),
        }
    }

    /// The line of one of which no move could be played.
    pub fn unplayable(variation: &Variation) -> VariationLine {
        let problems = variation.problems.clone();
        VariationLine { folder: None, plies: variation.ply, frames: 0, problems }
    }
}

impl ReportLine {
    pub fn new(game: &Game, status: Status, frames: u64, folder: Option<String>) -> ReportLine {
        ReportLine {
            file: None,
            game: game.number,
            line: game.line,
            white: game.player(Color::White).to_owned(),
            black: game.player(Color::Black).to_owned(),
            result: game.result.clone(),
            status,
            plies: game.plies.len(),
            frames,
            folder,
            problems: game.problems.clone(),
            variations: Vec::new(),
        }
    }

    /// This line with variations.
    pub fn with(self, variations: Vec<VariationLine>) -> ReportLine {
        ReportLine { variations, ..self }
    }

    /// This line in the report of a shard, of a game in `batch`.
    pub fn of_shard(self, batch: &Batch) -> ReportLine {
        let file = Some(batch.input.name.clone());
        let folder = self.folder.map(|name| batch.folder.join(name).to_string_lossy().into_owned());
        ReportLine { file, folder, ..self }
    }
}

/// `game.json`. It is written before the first picture, with all that are to come.
#[derive(Serialize)]
pub struct Manifest<'a> {
    pub file: &'a str,
    pub game: usize,
    pub line: usize,
    pub tags: Map<String, Value>,
    pub unread_tags: &'a [String],
    /// The folder that names a variation, within the game's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variation: Option<String>,
    pub result: &'a str,
    pub problems: &'a [Problem],
    pub settings: SettingsRecord,
    pub film: Option<Film>,
    pub orbit: f64,
    /// Whether the camera turns so far with each move.
    pub orbits_each_move: bool,
    /// Of all that follows: a film is the same where this is.
    pub fingerprint: &'a str,
    /// The films beside it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub films: Vec<String>,
    pub frames: Vec<&'a FrameRow>,
}

/// One picture of a manifest.
#[derive(Serialize)]
pub struct FrameRow {
    /// Nothing where the frame is only in films.
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    /// Of what is in the file.
    fingerprint: String,
    /// Of all bytes of a file that does not tell itself what it is, once it is there.
    #[serde(skip_serializing_if = "is_unknown", serialize_with = "known")]
    crc32: OnceLock<u32>,
    /// Seconds from the beginning of the film.
    time: f64,
    /// Half-moves before the position that is shown, or that the move under way leaves; so `san`,
    /// `fen`, `white` and `black`.
    ply: usize,
    san: Option<String>,
    /// The move under way.
    moving: Option<String>,
    fen: String,
    white: String,
    black: String,
    /// Words over the position, before or behind the game.
    #[serde(skip_serializing_if = "Option::is_none")]
    card: Option<Card>,
    /// Where the camera is, unless it stands where it began.
    #[serde(skip_serializing_if = "Gaze::is_still")]
    camera: Gaze,
}

impl FrameRow {
    pub fn new(file: Option<String>, fingerprint: String, game: &Game, frame: &Frame) -> FrameRow {
        let placement = game.placement(frame.ply);
        FrameRow {
            file,
            fingerprint,
            crc32: OnceLock::new(),
            // To the microsecond: sums of decimal fractions leave crumbs behind.
            time: (frame.time * 1e6).round() / 1e6,
            ply: frame.ply,
            san: game.san(frame.ply),
            moving: moving(game, frame),
            fen: game.fen(frame.ply),
            white: placement.notation(Color::White),
            black: placement.notation(Color::Black),
            card: frame.card,
            camera: frame.gaze,
        }
    }

    pub fn file(&self) -> Option<&str> {
        self.file.as_deref()
    }

    pub fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// The CRC-32 of its file, where that is known.
    pub fn crc32(&self) -> &OnceLock<u32> {
        &self.crc32
    }

    /// What is shown, and when.
    pub fn shows(&self) -> (&str, f64) {
        (&self.fingerprint, self.time)
    }
}

fn is_unknown(crc32: &OnceLock<u32>) -> bool {
    crc32.get().is_none()
}

fn known<S: Serializer>(crc32: &OnceLock<u32>, serializer: S) -> Result<S::Ok, S::Error> {
    crc32.get().serialize(serializer)
}

fn moving(game: &Game, frame: &Frame) -> Option<String> {
    game.san(frame.ply + 1).filter(|_| !frame.movers.is_empty())
}

/// What the picture of a frame says of itself: keywords and texts.
pub fn texts(game: &Game, frame: &Frame) -> Vec<(&'static str, String)> {
    let players = [Color::White, Color::Black].map(|color| shortened(game.player(color), 100));
    let mut texts = vec![
        ("Title", players.join(" - ")),
        ("Software", concat!("lightsquare ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("Game", game.number.to_string()),
        ("Ply", frame.ply.to_string()),
        ("SAN", game.san(frame.ply).unwrap_or_else(|| "-".to_owned())),
        ("FEN", game.fen(frame.ply)),
    ];
    texts.extend(moving(game, frame).map(|san| ("Moving", san)));
    texts
}

pub fn tags(game: &Game) -> Map<String, Value> {
    game.tags.iter().map(|(name, value)| (name.clone(), value.clone().into())).collect()
}
