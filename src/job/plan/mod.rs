//! Work that is cut into shards, which any scheduler may hand out: in any order, several at once, the same one again.
//!
//! A plan is a file of lines in JSON: a head, then a line a shard. With the files of games and pictures it is all that
//! there is to know; nothing is asked of whoever runs the shards. Their pictures go where those of one machine go. What a
//! shard reports, and what only a record can tell of its pictures, lies in the folder `.shards` of all output until it is
//! merged; then the folder is as if one machine had written it.

mod check;
mod cut;
mod error;
mod file;
mod make;
mod merge;
mod part;
mod shard;
mod verify;

pub use error::PlanError;
pub use file::Plan;
pub use make::{MOST_SHARDS, PlanSummary, plan};
pub use merge::{Merged, merge};
pub use shard::render_shard;
pub use verify::{Fault, Flaw, Verdict, verify};
