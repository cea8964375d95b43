//! What shards leave beside pictures until they are merged: whose they are, their reports, and sums of those pictures that
//! do not tell themselves what they are.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::PlanError;
use crate::job::JobError;
use crate::output::{OutputError, prepare_inside};
use crate::text::printable;

/// Within the folder of all output.
const FOLDER: &str = ".shards";

/// The records of one plan: `.shards/<id>/shard_00007.jsonl`.
pub struct Records {
    out: PathBuf,
    id: String,
}

/// What a picture's file was when its shard was done.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Sum {
    /// From the folder of all output on.
    pub file: String,
    pub fingerprint: String,
    /// CRC-32 of all its bytes, in hexadecimal.
    pub crc32: String,
}

/// The sums of one shard, by file.
pub type Sums = BTreeMap<String, Sum>;

impl Records {
    /// Those of the plan `id` in the folder `out`.
    pub fn new(out: &Path, id: &str) -> Records {
        Records { out: out.to_owned(), id: id.to_owned() }
    }

    /// Says in `out` whose shards are there.
    ///
    /// # Errors
    /// When they are another plan's, or that cannot be written.
    pub fn claim(&self) -> Result<(), JobError> {
        let folder = prepare_inside(&self.out, &self.inside())?;
        // Both of two plans that begin at once see the other, or one does.
        self.refuse_others().inspect_err(|_| {
            // Others may have records in it.
            let _ = fs::remove_dir(folder);
        })?;
        Ok(())
    }

    /// # Errors
    /// When the shards in `out` are another plan's.
    pub fn refuse_others(&self) -> Result<(), PlanError> {
        let names = fs::read_dir(self.out.join(FOLDER)).into_iter().flatten().flatten();
        let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
        match names.filter(|name| *name != self.id).min() {
            Some(theirs) => Err(PlanError::OtherPlan {
                folder: self.out.join(FOLDER),
                theirs: printable(&theirs),
                ours: self.id.clone(),
            }),
            None => Ok(()),
        }
    }

    fn inside(&self) -> PathBuf {
        Path::new(FOLDER).join(&self.id)
    }

    /// The report of a shard.
    pub fn report(&self, shard: usize) -> PathBuf {
        self.out.join(self.inside()).join(format!("shard_{shard:05}.jsonl"))
    }

    /// What a shard's report tells of its pictures. What cannot be read is as if it were not there.
    pub fn sums(&self, shard: usize) -> Sums {
        #[derive(Deserialize)]
        struct Line {
            #[serde(default)]
            pictures: Vec<Sum>,
        }
        let text = fs::read_to_string(self.report(shard)).unwrap_or_default();
        let lines = text.lines().filter_map(|line| serde_json::from_str::<Line>(line).ok());
        lines.flat_map(|line| line.pictures).map(|sum| (sum.file.clone(), sum)).collect()
    }

    /// Takes all away.
    ///
    /// # Errors
    /// When that cannot be done.
    pub fn remove(&self) -> Result<(), OutputError> {
        let path = self.out.join(FOLDER);
        match fs::remove_dir_all(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(OutputError { path, error })
            }
            _ => Ok(()),
        }
    }
}

/// Whether shards have left records in the folder `out`.
pub fn has_shards(out: &Path) -> Option<PathBuf> {
    Some(out.join(FOLDER)).filter(|folder| folder.is_dir())
}

impl Sum {
    /// Of the file `inside` the folder `out`.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn of(out: &Path, inside: &Path, fingerprint: &str) -> io::Result<Sum> {
        let mut sum = Crc(crc32fast::Hasher::new());
        io::copy(&mut File::open(out.join(inside))?, &mut sum)?;
        Ok(Sum {
            file: inside.to_string_lossy().into_owned(),
            fingerprint: fingerprint.to_owned(),
            crc32: format!("{:08x}", sum.0.finalize()),
        })
    }
}

struct Crc(crc32fast::Hasher);

impl io::Write for Crc {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
