//! The job template, by Open Job Description's own command line.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{LIGHTSQUARE, assert_as_plain, done, plan_and_plain, repository, skip};

/// In `PATH`, or with the other judges.
fn openjd() -> Option<PathBuf> {
    let path = env::var_os("PATH").unwrap_or_default();
    let judges = repository().join("target/oracle/bin");
    env::split_paths(&path)
        .chain([judges])
        .map(|folder| folder.join("openjd"))
        .find(|file| file.is_file())
}

/// Its sessions' folders are made in `folder` too.
fn run(openjd: &Path, folder: &Path, arguments: &[&str]) {
    let mut command = Command::new(openjd);
    command.current_dir(folder).env("TMPDIR", folder).args(arguments);
    let output = command.output().unwrap();
    let (out, err) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{arguments:?}: {}\n{out}\n{err}", output.status);
}

#[test]
fn openjd_runs_all_shards_and_merges() {
    let Some(openjd) = openjd() else {
        return skip("openjd");
    };
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path();
    let array = plan_and_plain(folder, "draft");
    let shards = array.strip_prefix("--array=").unwrap();
    let template = repository().join("cluster/openjd/lightsquare.yaml").display().to_string();
    run(&openjd, folder, &["check", &template]);
    let program = format!("Program={LIGHTSQUARE}");
    let shards = format!("Shards={shards}");
    let job = ["-p", "Plan=plan.jsonl", "-p", &shards, "-p", "Cpu=1", "-p", &program];
    let steps = ["run", &template, "--step", "Merge", "--run-dependencies"];
    run(&openjd, folder, &[&steps, &job[..]].concat());
    done(folder, &["verify", "plan.jsonl"]);
    assert_as_plain(folder);
    eprintln!(
        "openjd: its template is right, all shards are rendered and merged as by one process"
    );
}
