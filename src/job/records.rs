//! What shards leave beside pictures until they are merged: whose they are, their reports, and sums of those pictures that
//! do not tell themselves what they are.

use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, OnceLock, PoisonError};

use serde::{Deserialize, Serialize};

use super::plan::PlanError;
use crate::output::{OutputError, crc32_of, prepare_inside};
use crate::text::printable;

/// Within the folder of all output.
const FOLDER: &str = ".shards";

/// The folder of records in `out`, if shards have left some.
pub fn has_shards(out: &Path) -> Option<PathBuf> {
    Some(out.join(FOLDER)).filter(|folder| folder.is_dir())
}

/// The records of one plan, in `.shards/<id>`.
pub struct Records {
    out: PathBuf,
    id: String,
}

impl Records {
    /// Those of the plan `id` in the folder `out`.
    pub fn new(out: &Path, id: &str) -> Records {
        Records { out: out.to_owned(), id: id.to_owned() }
    }

    /// Says in `out` whose shards are there.
    ///
    /// # Errors
    /// When that cannot be written.
    pub fn claim(&self) -> Result<(), OutputError> {
        prepare_inside(&self.out, &Path::new(FOLDER).join(&self.id)).map(|_| ())
    }

    /// # Errors
    /// When there are shards of another plan in `out`.
    pub fn refuse_others(&self) -> Result<(), PlanError> {
        let entries = fs::read_dir(self.out.join(FOLDER)).into_iter().flatten().flatten();
        let folders = entries.filter(|entry| entry.path().is_dir());
        let names = folders.map(|entry| entry.file_name().to_string_lossy().into_owned());
        match names.filter(|name| *name != self.id).min() {
            Some(theirs) => {
                let folder = self.out.join(FOLDER).join(printable(&theirs));
                Err(PlanError::OtherPlan { folder, ours: self.id.clone() })
            }
            None => Ok(()),
        }
    }

    /// Whether there are any.
    pub fn are_there(&self) -> bool {
        self.folder().is_dir()
    }

    fn folder(&self) -> PathBuf {
        self.out.join(FOLDER).join(&self.id)
    }

    /// The report of a shard.
    pub fn report(&self, shard: usize) -> PathBuf {
        self.folder().join(format!("shard_{shard:05}.jsonl"))
    }

    /// What a shard has told of its pictures, in all its runs. What cannot be read is as if it were not there.
    pub fn sums(&self, shard: usize) -> Sums {
        let start = sums_of(shard);
        let mut sums = Sums::new();
        for entry in fs::read_dir(self.folder()).into_iter().flatten().flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            if name.starts_with(&start) && name.ends_with(SUMS) {
                let text = fs::read(entry.path()).unwrap_or_default();
                let lines = text.split(|byte| *byte == b'\n');
                let told = lines.filter_map(|line| serde_json::from_slice::<Sum>(line).ok());
                for sum in told {
                    sums.entry(sum.file.clone()).or_default().push(sum);
                }
            }
        }
        sums
    }

    /// Where a shard is to tell of its pictures.
    pub fn ledger(&self, shard: usize) -> Ledger {
        let Records { out, .. } = self;
        Ledger { out: out.clone(), folder: self.folder(), shard, file: OnceLock::new() }
    }

    /// Takes back what [`Records::claim`] has said, if nobody has said more.
    pub fn take_back(&self) {
        let _ = fs::remove_dir(self.folder());
        let _ = fs::remove_dir(self.out.join(FOLDER));
    }

    /// Takes all away.
    ///
    /// # Errors
    /// When that cannot be done.
    pub fn remove(&self) -> Result<(), OutputError> {
        let path = self.folder();
        match fs::remove_dir_all(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(OutputError { path, error });
            }
            _ => {}
        }
        // Another plan may have come meanwhile.
        let _ = fs::remove_dir(self.out.join(FOLDER));
        Ok(())
    }
}

/// How files of sums begin and end.
fn sums_of(shard: usize) -> String {
    format!("shard_{shard:05}-")
}
const SUMS: &str = ".sums";

/// What a picture's file was when it was written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sum {
    /// From the folder of all output on.
    file: String,
    fingerprint: String,
    /// CRC-32 of all its bytes.
    crc32: u32,
}

/// The sums of one shard, by file; of each run that has written it one.
pub type Sums = BTreeMap<String, Vec<Sum>>;

/// Whether a file in the folder `out` is as one of `sums` tells, of that fingerprint.
pub fn holds(sums: &[Sum], out: &Path, fingerprint: &str) -> bool {
    let Some(Sum { file, .. }) = sums.first() else { return false };
    let found = crc32_of(&out.join(file)).ok();
    sums.iter().any(|sum| sum.fingerprint == fingerprint && found == Some(sum.crc32))
}

/// A file to which one run of a shard adds sums as it goes, so that a kill loses none. Each run has its own.
pub struct Ledger {
    out: PathBuf,
    folder: PathBuf,
    shard: usize,
    file: OnceLock<Result<Mutex<File>, io::ErrorKind>>,
}

impl Ledger {
    /// Adds the picture at `path`, which was written with bytes of that sum.
    ///
    /// # Errors
    /// When that cannot be written.
    pub fn add(&self, path: &Path, fingerprint: &str, crc32: u32) -> Result<(), OutputError> {
        let file = path.strip_prefix(&self.out).unwrap_or(path).to_string_lossy().into_owned();
        let sum = Sum { file, fingerprint: fingerprint.to_owned(), crc32 };
        let added = || {
            let mut line = serde_json::to_vec(&sum)?;
            line.push(b'\n');
            let file = self.file.get_or_init(|| self.begin().map_err(|error| error.kind()));
            let file = file.as_ref().map_err(|kind| io::Error::from(*kind))?;
            file.lock().unwrap_or_else(PoisonError::into_inner).write_all(&line)
        };
        added().map_err(|error| OutputError { path: self.folder.clone(), error })
    }

    fn begin(&self) -> io::Result<Mutex<File>> {
        let name = tempfile::Builder::new()
            .prefix(&sums_of(self.shard))
            .suffix(SUMS)
            .make_in(&self.folder, |path| {
                OpenOptions::new().append(true).create_new(true).open(path)
            })?;
        Ok(Mutex::new(name.keep().map_err(|error| error.error)?.0))
    }
}
