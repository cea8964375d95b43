//! A Slurm of two nodes on this machine, for as long as a test needs it. Everything that it writes is in one
//! folder, and everything that it started is gone when it is dropped.

use std::env;
use std::ffi::OsStr;
use std::fmt::Write as _;
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write as _};
use std::net::{TcpListener, TcpStream};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};
use std::process::{self, Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const NODES: [&str; 2] = ["n1", "n2"];

/// How long a daemon may take to come up, and a process to go.
const PATIENCE: Duration = Duration::from_secs(30);

/// How long jobs may wait and run.
const JOB_PATIENCE: Duration = Duration::from_secs(240);

/// Slurm with two nodes of one core each, so two tasks run at a time.
pub struct Slurm {
    folder: PathBuf,
    daemons: Vec<Child>,
}

impl Slurm {
    /// None, with a word, where Slurm or Munge is not installed. The folder must be new, and its path short:
    /// sockets are made in it.
    pub fn start(folder: &Path) -> Option<Slurm> {
        let needed = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel"];
        if let Some(missing) = needed.iter().find(|name| installed(name).is_none()) {
            crate::skip(missing);
            return None;
        }
        fs::create_dir(folder).unwrap();
        let folder = folder.canonicalize().unwrap();
        fs::create_dir(folder.join("state")).unwrap();
        fs::create_dir(folder.join("spool")).unwrap();
        // From here on what was started is ended even if the next step fails.
        let mut slurm = Slurm { folder, daemons: Vec::new() };
        slurm.start_munge();
        let control = slurm.configure();
        slurm.launch("slurmctld", "slurmctld", &["-D"]);
        // A node that finds nobody would ask again only after seconds.
        slurm.until("slurmctld listens", || TcpStream::connect(("127.0.0.1", control)).is_ok());
        for node in NODES {
            slurm.launch(node, "slurmd", &["-D", "-N", node]);
        }
        slurm.until("both nodes are idle", || {
            slurm.try_run("sinfo", &["-h", "-N", "-o", "%T"]).is_ok_and(|states| {
                states.lines().filter(|&state| state == "idle").count() == NODES.len()
            })
        });
        Some(slurm)
    }

    /// Slurm's programs tell one another who they are by Munge.
    fn start_munge(&mut self) {
        let mut key = [0; 128];
        File::open("/dev/urandom").unwrap().read_exact(&mut key).unwrap();
        let mut options = OpenOptions::new();
        let options = options.write(true).create_new(true).mode(0o600);
        options.open(self.folder.join("munge.key")).unwrap().write_all(&key).unwrap();
        let file = |option: &str, name: &str| format!("--{option}={}", self.path(name));
        let arguments = [
            "--foreground".to_string(),
            // A temporary folder is closed to others, which Munge does not like; but nobody else is to come.
            "--force".to_string(),
            // Without it the host's name is looked up.
            "--origin=127.0.0.1".to_string(),
            file("key-file", "munge.key"),
            file("socket", "munge.socket"),
            file("pid-file", "munged.pid"),
            file("seed-file", "munged.seed"),
        ];
        self.launch("munged", "munged", &arguments.each_ref().map(String::as_str));
        let socket = self.folder.join("munge.socket");
        self.until("munged listens", || socket.exists());
    }

    /// Returns the controller's port.
    fn configure(&self) -> u16 {
        let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap();
        let host = host.trim().split('.').next().unwrap_or_default();
        let user =
            String::from_utf8(Command::new("id").arg("-un").output().unwrap().stdout).unwrap();
        let user = user.trim();
        let [control, ports @ ..] = free_ports();
        let folder = self.folder.display();
        let mut lines = format!(
            "ClusterName=chess\n\
             SlurmctldHost={host}(127.0.0.1)\n\
             SlurmctldPort={control}\n\
             SlurmUser={user}\n\
             SlurmdUser={user}\n\
             AuthType=auth/munge\n\
             AuthInfo=socket={folder}/munge.socket\n\
             CredType=cred/munge\n\
             StateSaveLocation={folder}/state\n\
             SlurmdSpoolDir={folder}/spool/%n\n\
             SlurmctldPidFile={folder}/slurmctld.pid\n\
             SlurmdPidFile={folder}/%n.pid\n\
             SlurmctldLogFile={folder}/slurmctld.log\n\
             SlurmdLogFile={folder}/%n.log\n\
             ProctrackType=proctrack/linuxproc\n\
             TaskPlugin=task/none\n\
             SelectType=select/cons_tres\n\
             SelectTypeParameters=CR_Core\n\
             SlurmdParameters=config_overrides\n\
             SchedulerParameters=sched_interval=1,sched_min_interval=0,bf_interval=1\n\
             ReturnToService=2\n\
             KillWait=5\n\
             MailProg=/bin/true\n\
             PartitionName=main Nodes={} Default=YES MaxTime=INFINITE State=UP\n",
            NODES.join(",")
        );
        for (node, port) in NODES.iter().zip(ports) {
            writeln!(
                lines,
                "NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=1"
            )
            .unwrap();
        }
        fs::write(self.folder.join("slurm.conf"), lines).unwrap();
        // No group is made by it; the one for version 2 would ask for systemd.
        fs::write(self.folder.join("cgroup.conf"), "CgroupPlugin=cgroup/v1\n").unwrap();
        control
    }

    /// Submits a batch job from `folder`, with the environment of this process but for `PATH`; returns the
    /// job's number.
    pub fn sbatch<S: AsRef<OsStr>>(&self, folder: &Path, path: &OsStr, arguments: &[S]) -> u32 {
        let mut command = self.command("sbatch");
        command.current_dir(folder).env("PATH", path).arg("--parsable").args(arguments);
        let answer = said(command).unwrap_or_else(|error| self.fail(&error));
        answer.trim().parse().unwrap_or_else(|_| self.fail(&format!("sbatch says {answer}")))
    }

    /// The states of a job's tasks in order, or the one of a job without an array: PENDING, RUNNING, FAILED…
    pub fn states(&self, job: u32) -> Vec<String> {
        let all = ["-h", "-r", "--states=all", "-o", "%F %K %T"];
        let list = self.try_run("squeue", &all).unwrap_or_else(|error| self.fail(&error));
        let mut states: Vec<(u32, String)> = list
            .lines()
            .filter_map(|line| {
                let mut words = line.split_whitespace();
                let of = words.next()?.parse::<u32>().ok()?;
                // A job without an array has N/A.
                let index = words.next()?.parse().unwrap_or(0);
                (of == job).then_some((index, words.next()?.to_string()))
            })
            .collect();
        states.sort();
        states.into_iter().map(|(_, state)| state).collect()
    }

    pub fn state(&self, job: u32, index: usize) -> String {
        self.states(job).get(index).cloned().unwrap_or_default()
    }

    /// Whether no task waits or runs.
    pub fn is_over(&self, job: u32) -> bool {
        let on = ["PENDING", "CONFIGURING", "RUNNING", "SUSPENDED", "COMPLETING", "REQUEUED"];
        !self.states(job).iter().any(|state| on.contains(&state.as_str()))
    }

    /// Waits until the job is over; returns what `states` then says.
    pub fn wait(&self, job: u32) -> Vec<String> {
        self.until_within(JOB_PATIENCE, &format!("job {job} is over"), || self.is_over(job));
        self.states(job)
    }

    /// Kills a running task the hard way, so that it can clean up nothing, and waits until it is gone.
    pub fn kill_task(&self, job: u32, index: usize) {
        // Without --batch, whatever the signal, a task gets SIGTERM and time to stop.
        let arguments = ["--batch", "--signal=KILL", &format!("{job}_{index}")];
        self.try_run("scancel", &arguments).unwrap_or_else(|error| self.fail(&error));
        let gone = || !["RUNNING", "COMPLETING"].contains(&self.state(job, index).as_str());
        self.until(&format!("task {index} of job {job} is gone"), gone);
    }

    /// Waits for what comes within `JOB_PATIENCE`.
    pub fn until_job(&self, what: &str, condition: impl FnMut() -> bool) {
        self.until_within(JOB_PATIENCE, what, condition);
    }

    fn until(&self, what: &str, condition: impl FnMut() -> bool) {
        self.until_within(PATIENCE, what, condition);
    }

    fn until_within(&self, limit: Duration, what: &str, mut condition: impl FnMut() -> bool) {
        let start = Instant::now();
        while !condition() {
            if start.elapsed() > limit {
                self.fail(&format!("not within {} s: {what}", limit.as_secs()));
            }
            thread::sleep(Duration::from_millis(50));
        }
    }

    /// What stands in the queue, and the last lines of all logs.
    pub fn logs(&self) -> String {
        let mut text =
            self.try_run("squeue", &["-r", "--states=all"]).unwrap_or_else(|error| error);
        let mut files: Vec<PathBuf> =
            fs::read_dir(&self.folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        // A daemon's log; or, if it did not come to one, what it said.
        let told = |file: &PathBuf| {
            let end = file.extension().and_then(OsStr::to_str);
            end == Some("log") || end == Some("out") && !file.with_extension("log").exists()
        };
        files.retain(told);
        files.sort();
        for file in &files {
            let bytes = fs::read(file).unwrap_or_default();
            let log = String::from_utf8_lossy(&bytes);
            let lines: Vec<&str> = log.lines().collect();
            let last = &lines[lines.len().saturating_sub(25)..];
            write!(text, "\n{}:\n{}\n", file.display(), last.join("\n")).unwrap();
        }
        text
    }

    fn fail(&self, why: &str) -> ! {
        panic!("{why}\n{}", self.logs())
    }

    fn path(&self, name: &str) -> String {
        self.folder.join(name).display().to_string()
    }

    fn launch(&mut self, name: &str, program: &str, arguments: &[&str]) {
        let output = || Stdio::from(File::create(self.folder.join(format!("{name}.out"))).unwrap());
        let mut command = self.command(program);
        // What runs in the folder is known to be ours.
        command.args(arguments).current_dir(&self.folder).stdin(Stdio::null());
        let child = command.stdout(Stdio::null()).stderr(output()).spawn();
        let child = child.unwrap_or_else(|error| self.fail(&format!("{program}: {error}")));
        self.daemons.push(child);
    }

    /// A program that knows this Slurm and no other, even where the test is itself a task of one.
    fn command(&self, name: &str) -> Command {
        let mut command = Command::new(installed(name).unwrap_or_else(|| name.into()));
        for (variable, _) in env::vars_os() {
            let foreign = ["SLURM", "SBATCH_", "SQUEUE_", "SCANCEL_", "SINFO_", "SRUN_"];
            if foreign.iter().any(|start| variable.to_string_lossy().starts_with(start)) {
                command.env_remove(variable);
            }
        }
        command.env("SLURM_CONF", self.folder.join("slurm.conf"));
        command
    }

    fn try_run(&self, program: &str, arguments: &[&str]) -> Result<String, String> {
        let mut command = self.command(program);
        command.args(arguments);
        said(command)
    }

    /// Processes that work in the folder of this Slurm, have a file of it open, or its settings in their
    /// environment. Those that see to jobs leave the daemon that started them, so parents do not tell.
    fn processes(&self) -> Vec<u32> {
        let conf = format!("SLURM_CONF={}\0", self.path("slurm.conf"));
        let inside =
            |link: PathBuf| fs::read_link(link).is_ok_and(|at| at.starts_with(&self.folder));
        let ours = |process: &Path| {
            let mut environment = fs::read(process.join("environ")).unwrap_or_default();
            environment.push(0);
            environment.windows(conf.len()).any(|part| part == conf.as_bytes())
                || inside(process.join("cwd"))
                || fs::read_dir(process.join("fd"))
                    .is_ok_and(|files| files.flatten().any(|file| inside(file.path())))
        };
        let Ok(entries) = fs::read_dir("/proc") else { return Vec::new() };
        let id = |path: &Path| path.file_name()?.to_str()?.parse::<u32>().ok();
        entries
            .flatten()
            .map(|entry| entry.path())
            .filter_map(|path| id(&path).filter(|&id| id != process::id() && ours(&path)))
            .collect()
    }
}

impl Drop for Slurm {
    fn drop(&mut self) {
        // The controller before the nodes, so that nothing new begins.
        for daemon in &mut self.daemons {
            let _ = daemon.kill();
            let _ = daemon.wait();
        }
        let start = Instant::now();
        loop {
            let left = self.processes();
            if left.is_empty() || start.elapsed() > PATIENCE {
                break;
            }
            for id in left {
                kill(id);
            }
            thread::sleep(Duration::from_millis(20));
        }
    }
}

/// By the shell, whose `kill` is always there.
fn kill(id: u32) {
    let _ = Command::new("sh")
        .args(["-c", "kill -KILL \"$1\"", "sh", &id.to_string()])
        .stderr(Stdio::null())
        .status();
}

/// What a program printed, or how it failed.
fn said(mut command: Command) -> Result<String, String> {
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr);
        return Err(format!("{command:?}: {}: {message}", output.status));
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Daemons are often where a user's `PATH` does not lead.
fn installed(name: &str) -> Option<PathBuf> {
    let path = env::var_os("PATH").unwrap_or_default();
    env::split_paths(&path)
        .chain(["/usr/local/sbin", "/usr/sbin", "/sbin"].map(PathBuf::from))
        .map(|folder| folder.join(name))
        .find(|file| file.is_file())
}

/// All are held before the first is let go, so no two are the same.
fn free_ports() -> [u16; 1 + NODES.len()] {
    let held = [(); 1 + NODES.len()].map(|()| TcpListener::bind("127.0.0.1:0").unwrap());
    held.map(|listener| listener.local_addr().unwrap().port())
}
