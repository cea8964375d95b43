//! A plan's shards, by a real Slurm and by Open Job Description's own runner, against plain `render`.

mod openjd;
#[cfg(unix)]
mod slurm;
#[path = "../trees/mod.rs"]
mod trees;

use std::env;
use std::ffi::OsString;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use trees::{assert_same, tree};

const LIGHTSQUARE: &str = env!("CARGO_BIN_EXE_lightsquare");

const LOOK: &[&str] = &["--size", "160x120", "--animate", "--fps", "4", "--film", "gif"];

/// The repository, where the scripts are.
fn repository() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs the program in `folder`.
fn lightsquare(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(LIGHTSQUARE).current_dir(folder).args(arguments).output().unwrap()
}

/// The same, and it must end well; returns what it printed.
fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = lightsquare(folder, arguments);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {}: {message}", output.status);
    String::from_utf8(output.stdout).unwrap()
}

/// Makes a plan of four shards for a game, whose pictures are to be in `shared`, and renders the same by one
/// process in `plain`. Returns what `plan` printed.
fn plan_and_plain(folder: &Path, quality: &str) -> String {
    let look = [LOOK, &["--quality", quality]].concat();
    fs::copy(repository().join("games/opera-1858.pgn"), folder.join("opera-1858.pgn")).unwrap();
    done(folder, &[&["render", "opera-1858.pgn", "-o", "plain"], &look[..]].concat());
    let plan = ["plan", "opera-1858.pgn", "--shards", "4", "-o", "plan.jsonl", "--out", "shared"];
    let array = done(folder, &[&plan, &look[..]].concat());
    assert_eq!(array, "--array=0-3\n");
    array.trim_end().to_string()
}

/// A judge is not there: no test, unless all are wanted, as in the gate.
fn skip(what: &str) {
    assert!(env::var_os("LIGHTSQUARE_NO_SKIP").is_none(), "there is no {what}");
    eprintln!("skipped: there is no {what}");
}

/// The first frame of a shard of `plan.jsonl`, and the one behind its last.
fn frames_of(folder: &Path, shard: usize) -> Range<u64> {
    let plan = fs::read_to_string(folder.join("plan.jsonl")).unwrap();
    let line: Value = serde_json::from_str(plan.lines().nth(1 + shard).unwrap()).unwrap();
    let [first, frames] = ["frame", "frames"].map(|key| line[key].as_u64().unwrap());
    first..first + frames
}

/// How many pictures of such frames are there, in a folder in which others are at work.
fn pictures(folder: &Path, frames: Range<u64>) -> usize {
    let Ok(games) = fs::read_dir(folder.join("shared/opera-1858")) else { return 0 };
    let games = games.flatten().map(|entry| entry.path()).filter(|path| path.is_dir());
    let is_there = |game: &Path| {
        let name = |frame: &u64| game.join(format!("frame_{frame:05}.png"));
        frames.clone().filter(|frame| name(frame).is_file()).count()
    };
    games.map(|game| is_there(&game)).sum()
}

/// What the shards have left is what one process left.
fn assert_as_plain(folder: &Path) {
    assert_same(&tree(&folder.join("shared")), &tree(&folder.join("plain")), "shared and plain");
}

/// `PATH` with the program's folder in front.
fn path() -> OsString {
    let own = Path::new(LIGHTSQUARE).parent().unwrap().to_path_buf();
    let others = env::var_os("PATH").unwrap_or_default();
    env::join_paths([own].into_iter().chain(env::split_paths(&others))).unwrap()
}

#[cfg(unix)]
#[test]
fn a_killed_task_is_found_and_sent_again() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let Some(slurm) = slurm::Slurm::start(&folder.join("slurm")) else { return };
    // Slow enough that a task is met at work.
    let array = plan_and_plain(folder, "high");
    let path = path();
    // A node has one core.
    let submit = |argument: &str, script: &str| {
        let script = repository().join("cluster/slurm").join(script);
        let script = script.to_str().unwrap();
        slurm.sbatch(folder, &path, &[argument, "--cpus-per-task=1", script, "plan.jsonl"])
    };

    let job = submit(&array, "array.sh");
    let frames = frames_of(folder, 1);
    slurm.until_job("task 1 is midway", || pictures(folder, frames.clone()) >= 10);
    assert_eq!(slurm.state(job, 1), "RUNNING", "{}", slurm.logs());
    slurm.kill_task(job, 1);
    let states = slurm.wait(job);
    let kept = pictures(folder, frames.clone());
    assert!((10..frames.clone().count()).contains(&kept), "{kept} of {frames:?}");
    eprintln!("Slurm's tasks, the second killed midway, at {kept} of {frames:?}: {states:?}");
    assert_eq!(states, ["COMPLETED", "FAILED", "COMPLETED", "COMPLETED"], "{}", slurm.logs());

    let verify = lightsquare(folder, &["verify", "plan.jsonl"]);
    assert_eq!(verify.status.code(), Some(3));
    let missing = String::from_utf8(verify.stdout).unwrap();
    let missing = missing.lines().next().unwrap();
    assert_eq!(missing, "--array=1");
    eprintln!("verify: exit 3, {missing}");

    let job = submit(missing, "array.sh");
    let merge = submit(&format!("--dependency=afterany:{job}"), "merge.sh");
    assert_eq!(slurm.wait(merge), ["COMPLETED"], "{}", slurm.logs());
    assert_eq!(slurm.wait(job), ["COMPLETED"], "{}", slurm.logs());
    let log = fs::read_to_string(folder.join(format!("lightsquare-{job}_1.log"))).unwrap();
    assert!(log.contains(&format!("({kept} of them were there)")), "{log}");
    done(folder, &["verify", "plan.jsonl"]);
    assert_as_plain(folder);
    eprintln!(
        "sent again and merged: {} files, the same as one process leaves",
        tree(&folder.join("shared")).len()
    );
}
