//! What keeps plans from being made, or used.

use std::io;
use std::path::PathBuf;

use crate::text::shown;

/// Why a plan cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    #[error("{name}: cannot be read")]
    Io {
        name: String,
        #[source]
        error: io::Error,
    },
    #[error("{name}: is no plan of lightsquare, expected a file that `lightsquare plan` has made")]
    NoPlan { name: String },
    #[error("{name}: is there and is no plan, so it is not replaced; expected another --output")]
    InTheWay { name: String },
    #[error(
        "{name}: was made by lightsquare {theirs}, and this is {ours}; expected the same version, or a new plan"
    )]
    OtherVersion { name: String, theirs: String, ours: String },
    #[error("{name}: is cut short, it has {found} of {expected} shards; expected the whole file")]
    CutShort { name: String, found: usize, expected: usize },
    #[error("{name}: line {line}: was changed, or is damaged; expected the file as it was made")]
    Damaged { name: String, line: usize },
    #[error("{name}: there is no shard {shard}, it has {}", match shards {
        1 => "shard 0 alone".to_owned(),
        _ => format!("shards 0 to {}", shards - 1),
    })]
    NoSuchShard { name: String, shard: usize, shards: usize },
    #[error("{input}: is not there, and {name} was made with it")]
    Missing { name: String, input: String },
    #[error("{input}: has changed since {name} was made; expected the same file, or a new plan")]
    Changed { name: String, input: String },
    #[error(
        "{name}: the settings of pictures (config.ini, a chess set, bitmaps) have changed since it was made; \
         expected the same ones, or a new plan"
    )]
    OtherSettings { name: String },
    #[error(
        "{name}: was made where {} makes MP4, and here {} does; expected the same on all machines",
        encoder(*is_by_ffmpeg), encoder(!is_by_ffmpeg)
    )]
    OtherEncoder { name: String, is_by_ffmpeg: bool },
    #[error(
        "{}: has shards of another plan, this is {ours}; expected another --out, or that folder removed with its pictures",
        shown(folder)
    )]
    OtherPlan { folder: PathBuf, ours: String },
    #[error(
        "{}: has shards of a plan that are not merged; expected `lightsquare merge` first, another --out, or that \
         folder removed if nobody wants them any more",
        shown(folder)
    )]
    NotMerged { folder: PathBuf },
    #[error("{0}: a plan's games are read by every shard, expected files")]
    Stream(String),
    #[error("{0}: has a name that cannot be written into a plan, expected UTF-8")]
    Name(String),
    #[error("{name}: does not fit its games, {found} frames instead of {expected}")]
    Misfit { name: String, found: u64, expected: u64 },
}

fn encoder(is_ffmpeg: bool) -> &'static str {
    if is_ffmpeg { "ffmpeg" } else { "the encoder inside" }
}
