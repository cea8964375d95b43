//! A plan's shards, by a real Slurm and by Open Job Description's own runner, against plain `render`.

mod openjd;
#[cfg(unix)]
mod slurm;
#[path = "../trees/mod.rs"]
mod trees;

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

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

/// Whether there is a picture below a folder in which others are at work, so that files come and go.
fn has_picture(folder: &Path) -> bool {
    let Ok(entries) = fs::read_dir(folder) else { return false };
    entries.flatten().map(|entry| entry.path()).any(|path| {
        has_picture(&path) || path.extension().is_some_and(|extension| extension == "png")
    })
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
    slurm.until_job("task 1 runs and there is a picture", || {
        has_picture(&folder.join("shared")) && slurm.state(job, 1) == "RUNNING"
    });
    slurm.kill_task(job, 1);
    let states = slurm.wait(job);
    assert_eq!(states, ["COMPLETED", "FAILED", "COMPLETED", "COMPLETED"], "{}", slurm.logs());

    let verify = lightsquare(folder, &["verify", "plan.jsonl"]);
    assert_eq!(verify.status.code(), Some(3));
    let missing = String::from_utf8(verify.stdout).unwrap();
    let missing = missing.lines().next().unwrap();
    assert_eq!(missing, "--array=1");

    let job = submit(missing, "array.sh");
    let merge = submit(&format!("--dependency=afterany:{job}"), "merge.sh");
    assert_eq!(slurm.wait(merge), ["COMPLETED"], "{}", slurm.logs());
    assert_eq!(slurm.wait(job), ["COMPLETED"], "{}", slurm.logs());
    done(folder, &["verify", "plan.jsonl"]);
    assert_as_plain(folder);
}
