//! The plan's file.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;
use sha2::{Digest, Sha256};

use super::error::PlanError;
use crate::job::fingerprint::PICTURES;
use crate::job::share::{Place, Shard};
use crate::output::{OutputError, write_together};
use crate::text::{printable, shown};

/// The version of the file.
const FORMAT: u32 = 1;

/// A plan as its file has it.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The file, as messages show it.
    pub name: String,
    pub(super) head: Head,
    /// Where each shard begins.
    pub(super) shards: Vec<ShardLine>,
}

/// The first line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Head {
    /// The version of the file.
    pub plan: u32,
    /// The version of the program, and of its pictures.
    pub lightsquare: String,
    pub pictures: u32,
    /// Of all else that is in the file.
    pub id: String,
    /// From the plan's folder to the one where paths begin that are not absolute.
    pub folder: String,
    /// The command line that made the plan: what is rendered, and how.
    pub arguments: Vec<String>,
    /// Whether films in MP4 are wanted, and ffmpeg makes them.
    pub is_by_ffmpeg: bool,
    /// The fingerprint of all settings of pictures, and of what is in the files that they name.
    pub settings: String,
    pub inputs: Vec<PlannedInput>,
    /// Of all inputs.
    pub frames: u64,
    pub shards: usize,
    /// Behind the last frame of all.
    pub end: Place,
}

/// A file of games.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct PlannedInput {
    pub path: String,
    pub bytes: u64,
    pub sha256: String,
    /// What of it is rendered.
    pub games: usize,
    pub frames: u64,
}

/// A line of a shard.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct ShardLine {
    pub shard: usize,
    pub frames: u64,
    /// Its first frame; its last is the one before the next shard's first.
    #[serde(flatten)]
    pub begin: Place,
}

/// More bytes than any plan needs.
const LONGEST: u64 = 1 << 28;

fn version(lightsquare: &str, pictures: u32, plans: u32) -> String {
    format!("{lightsquare} (pictures {pictures}, plans {plans})")
}

impl Default for Head {
    /// The head of a plan by this program, of nothing yet.
    fn default() -> Head {
        Head {
            plan: FORMAT,
            lightsquare: env!("CARGO_PKG_VERSION").to_owned(),
            pictures: PICTURES,
            id: String::new(),
            folder: String::new(),
            arguments: Vec::new(),
            is_by_ffmpeg: false,
            settings: String::new(),
            inputs: Vec::new(),
            frames: 0,
            shards: 0,
            end: Place::default(),
        }
    }
}

impl Plan {
    /// A plan whose shards begin at `begins`, each after so many frames of all.
    pub(super) fn new(path: &Path, head: Head, begins: &[(u64, Place)]) -> io::Result<Plan> {
        let ends = begins.iter().skip(1).map(|(at, _)| *at).chain([head.frames]);
        let shards = begins.iter().zip(ends).enumerate();
        let shards = shards
            .map(|(shard, ((at, begin), end))| ShardLine { shard, frames: end - at, begin: *begin })
            .collect();
        let mut plan = Plan { name: shown(path), head, shards };
        plan.head.id = plan.id()?;
        Ok(plan)
    }

    /// What all lines say but the id itself.
    fn id(&self) -> io::Result<String> {
        let head = Head { id: String::new(), ..self.head.clone() };
        let mut lines = serde_json::to_vec(&head)?;
        for shard in &self.shards {
            lines.extend(serde_json::to_vec(shard)?);
        }
        let digest = Sha256::digest(&lines);
        Ok(digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect())
    }

    /// Writes it.
    pub(super) fn write(&self, path: &Path) -> Result<(), OutputError> {
        let content = |out: &mut dyn Write| {
            serde_json::to_writer(&mut *out, &self.head)?;
            writeln!(out)?;
            for shard in &self.shards {
                serde_json::to_writer(&mut *out, shard)?;
                writeln!(out)?;
            }
            Ok(())
        };
        write_together(&[(path.to_owned(), &content)])
    }

    /// Reads a plan that this version of the program has made, and nobody has changed.
    ///
    /// # Errors
    /// When there is none in the file, or not such a one.
    pub fn read(path: &Path) -> Result<Plan, PlanError> {
        let name = shown(path);
        let no_plan = || PlanError::NoPlan { name: name.clone() };
        let failed = |error| PlanError::Io { name: name.clone(), error };
        let mut text = Vec::new();
        let file = File::open(path).map_err(failed)?;
        file.take(LONGEST).read_to_end(&mut text).map_err(failed)?;
        let text = String::from_utf8(text).map_err(|_| no_plan())?;
        let mut lines = text.lines();
        let first = lines.next().unwrap_or_default();
        let head: Value = serde_json::from_str(first).map_err(|_| match text.contains('\n') {
            false if first.starts_with("{\"plan\":") => {
                PlanError::CutShort { name: name.clone(), found: 0, expected: 1 }
            }
            _ => no_plan(),
        })?;
        let number = |key: &str| head[key].as_u64().and_then(|number| u32::try_from(number).ok());
        let (Some(format), Some(theirs)) = (number("plan"), head["lightsquare"].as_str()) else {
            return Err(no_plan());
        };
        let theirs = version(&printable(theirs), number("pictures").unwrap_or(0), format);
        let ours = version(env!("CARGO_PKG_VERSION"), PICTURES, FORMAT);
        if theirs != ours {
            return Err(PlanError::OtherVersion { name, theirs, ours });
        }
        let damaged = |line| PlanError::Damaged { name: name.clone(), line };
        let head: Head = serde_json::from_value(head).map_err(|_| damaged(1))?;
        let cut = |found| PlanError::CutShort { name: name.clone(), found, expected: head.shards };
        let mut shards = Vec::new();
        for (number, line) in (2..).zip(lines) {
            match serde_json::from_str(line) {
                Ok(shard) => shards.push(shard),
                Err(_) if shards.len() < head.shards && text.ends_with(line) => {
                    return Err(cut(shards.len()));
                }
                Err(_) => return Err(damaged(number)),
            }
        }
        if shards.len() < head.shards {
            return Err(cut(shards.len()));
        }
        let plan = Plan { name: name.clone(), head, shards };
        let is_counted = !plan.shards.is_empty() && plan.shards.len() == plan.head.shards;
        let places = plan.shards.iter().map(|shard| shard.begin).chain([plan.head.end]);
        let is_as_made = plan.id().ok().as_deref() == Some(&plan.head.id);
        if !is_counted || !places.is_sorted() || !is_as_made {
            return Err(damaged(1));
        }
        Ok(plan)
    }

    /// Shard `number`, from 0 on.
    ///
    /// # Errors
    /// When there are fewer.
    pub fn shard(&self, number: usize) -> Result<Shard, PlanError> {
        let Some(ShardLine { frames, begin, .. }) = self.shards.get(number).copied() else {
            let (name, shards) = (self.name.clone(), self.shards.len());
            return Err(PlanError::NoSuchShard { name, shard: number, shards });
        };
        let end = self.shards.get(number + 1).map_or(self.head.end, |next| next.begin);
        Ok(Shard { number, frames, begin, end })
    }

    /// The shard that a frame belongs to.
    pub(super) fn shard_of(&self, place: Place) -> usize {
        self.shards.partition_point(|shard| shard.begin <= place).saturating_sub(1)
    }

    /// The command line that made it, without the program's name.
    pub fn arguments(&self) -> impl Iterator<Item = &str> {
        self.head.arguments.iter().map(String::as_str)
    }

    /// The folder where paths begin that are not absolute, for a plan that was read from `path`.
    ///
    /// # Errors
    /// When nothing is there any more.
    pub fn folder(&self, path: &Path) -> io::Result<PathBuf> {
        let path = fs::canonicalize(path)?;
        Ok(path.parent().unwrap_or(Path::new("")).join(&self.head.folder))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(file: usize, game: usize, frame: u64) -> Place {
        Place { file, game, frame }
    }

    fn sample() -> Plan {
        let input = |path: &str, frames| PlannedInput {
            path: path.to_owned(),
            bytes: 7,
            sha256: "ab".to_owned(),
            games: 1,
            frames,
        };
        let inputs = vec![input("a.pgn", 10), input("b.pgn", 20)];
        let head = Head { inputs, frames: 30, shards: 3, end: place(1, 1, 20), ..Head::default() };
        let begins = [(0, place(0, 1, 0)), (8, place(0, 3, 2)), (10, place(1, 1, 0))];
        Plan::new(Path::new("plan.jsonl"), head, &begins).unwrap()
    }

    #[test]
    fn shards_have_every_frame_once() {
        let plan = sample();
        let shards: Vec<Shard> = (0..3).map(|number| plan.shard(number).unwrap()).collect();
        assert_eq!(shards.iter().map(|shard| shard.frames).collect::<Vec<_>>(), [8, 2, 20]);
        // The last one is behind all that is wanted.
        for (file, game, frames) in [(0, 1, 4), (0, 2, 2), (0, 3, 4), (1, 1, 20), (1, 2, 5)] {
            let mut all: Vec<u64> = Vec::new();
            for shard in &shards {
                let range = shard.of(file, game, frames);
                assert_eq!(!range.is_empty(), shard.games(file).contains(&game));
                for frame in range {
                    assert_eq!(plan.shard_of(place(file, game, frame)), shard.number);
                    all.push(frame);
                }
            }
            let expected = if game == 2 && file == 1 { 0 } else { frames };
            assert_eq!(all, (0..expected).collect::<Vec<_>>(), "game {game} of file {file}");
        }
    }

    #[test]
    fn a_plan_is_read_as_it_was_written_or_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.jsonl");
        let plan = sample();
        plan.write(&path).unwrap();
        let text = fs::read_to_string(&path).unwrap();
        let read = Plan::read(&path).unwrap();
        assert_eq!((&read.head, &read.shards), (&plan.head, &plan.shards));
        for length in 0..text.len() - 1 {
            fs::write(&path, &text[..length]).unwrap();
            let error = Plan::read(&path).unwrap_err().to_string();
            let is_told = ["cut short", "is no plan"].iter().any(|told| error.contains(told));
            assert!(is_told, "{length}: {error}");
        }
        // Every byte counts.
        for at in 0..text.len() - 1 {
            let mut bytes = text.clone().into_bytes();
            bytes[at] = if bytes[at] == b'1' { b'2' } else { b'1' };
            fs::write(&path, bytes).unwrap();
            assert!(Plan::read(&path).is_err(), "{at}");
        }
    }
}
