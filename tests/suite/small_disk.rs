//! Disks that become full, and histories that would fill a memory.
//!
//! The small disk is a tmpfs where one may be mounted; elsewhere a limit on the size of files, which
//! is as small for every directory, has to do.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use crate::test_dir::{TestDir, end, has, kill, names};

/// A directory on a separate file system.
struct SmallDisk(PathBuf);

impl SmallDisk {
    /// None, and a word why, where none may be mounted.
    fn mounted(at: PathBuf, kilobytes: usize) -> Option<Self> {
        fs::create_dir(&at).expect("a directory");
        let size = format!("size={kilobytes}k");
        let mount = Command::new("mount")
            .args(["-t", "tmpfs", "-o", &size, "tmpfs"])
            .arg(&at)
            .stderr(Stdio::null())
            .status();
        if !mount.is_ok_and(|status| status.success()) {
            eprintln!("no tmpfs may be mounted here");
            return None;
        }
        Some(Self(at))
    }

    /// Leaves no byte free.
    fn fill(&self) {
        let filler = vec![0_u8; 8 << 20];
        let written = fs::write(self.0.join("filler"), filler);
        assert!(written.is_err(), "not full");
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg("-l").arg(&self.0).status();
    }
}

const PLAN: &str = "run li2019-fig3 --set numerics.points=400 --snapshot-at 1 --history every-step";

fn start(dir: &TestDir, out: &Path) -> Child {
    let line = format!(
        "{PLAN} --cycles 60 --checkpoint-every 0.02 --out {}",
        out.display()
    );
    let state = dir.path("state").display().to_string();
    let mut child = dir.start(&line, &[("XDG_STATE_HOME", &state)]);
    for name in ["state-1.csv", "run.checkpoint"] {
        let path = out.join(name).display().to_string();
        dir.wait_for(&mut child, &path);
    }
    child
}

#[test]
fn on_a_full_disk_the_newest_state_is_kept_where_there_is_room() {
    let dir = TestDir::new();
    let Some(disk) = SmallDisk::mounted(dir.path("disk"), 4000) else {
        return;
    };
    let out = disk.0.join("x");
    let child = start(&dir, &out);
    disk.fill();
    let said = end(child);
    assert_eq!(said.code, 1, "{}", said.err);
    let lines: Vec<&str> = said.err.lines().collect();
    let [first, .., last] = lines[..] else {
        panic!("{}", said.err);
    };
    has(first, "cannot write");
    has(first, "; checkpoints go to ");
    has(last, "cannot write");
    has(last, "; resume with: ");
    let (_, path) = last
        .split_once("; resume with: mdr-tui run --resume ")
        .expect("a way on");
    assert!(Path::new(path).starts_with(dir.path("state")), "{path}");
    // With room again it goes on at once, where it was, and nothing is missing.
    fs::remove_file(disk.0.join("filler")).expect("a file");
    fs::create_dir(dir.path("roomy")).expect("a directory");
    let roomy = dir.path("roomy/x");
    dir.done(&format!(
        "run --resume {path} --quiet --out {}",
        roomy.display()
    ));
    dir.done(&format!("{PLAN} --cycles 60 --out whole --quiet"));
    dir.alike("whole", "roomy/x");
}

#[test]
fn where_nothing_more_is_kept_the_end_says_from_which_cycle_on() {
    let dir = TestDir::new();
    let out = dir.path("x");
    let child = start(&dir, &out);
    let limit = Command::new("prlimit")
        .args(["--fsize=0:0", "--pid", &child.id().to_string()])
        .status();
    if !limit.is_ok_and(|status| status.success()) {
        eprintln!("skipped: no prlimit here");
        kill(child);
        return;
    }
    let said = end(child);
    assert_eq!(said.code, 1, "{}", said.err);
    has(&said.err, "the run continues without a checkpoint");
    let last = said.err.lines().last().unwrap_or_default();
    let (_, rest) = last.split_once("; resume from cycle ").expect("a way on");
    let (from, rest) = rest
        .split_once(" with: mdr-tui run --resume ")
        .expect("a command");
    let kept = fs::read(out.join("run.checkpoint")).expect("a checkpoint");
    let cycle = format!(" at cycle {from}\n");
    assert!(String::from_utf8_lossy(&kept).contains(&cycle), "{last}");
    let tail = "run.checkpoint (cycles up to 60 could not be saved)";
    assert!(rest.ends_with(tail), "{last}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_history_of_many_rows_takes_neither_memory_nor_checkpoints() {
    let dir = TestDir::new();
    let run = |cycles: &str| {
        let line = "run hertz --set numerics.points=8 --set numerics.steps_per_cycle=1000 --quiet \
                    --history every-step --checkpoint-every 0.05 --cycles";
        let mut command = dir.command(&line.split_whitespace().collect::<Vec<_>>());
        command.args([cycles, "--out", cycles]);
        let mut child = command.spawn().expect("the program starts");
        let checkpoint = dir.path(cycles).join("run.checkpoint");
        let (mut largest, mut peak) = (0, 0);
        while let Ok(None) = child.try_wait() {
            let length = fs::metadata(&checkpoint).map_or(0, |about| about.len());
            largest = largest.max(length);
            peak = peak.max(crate::regressions::memory_of(&child));
            thread::sleep(Duration::from_millis(2));
        }
        assert!(child.wait().expect("an end").success());
        (largest, peak)
    };
    let (_, small) = run("1");
    let (checkpoint, large) = run("40");
    let rows = dir.read("40/history.csv").len();
    eprintln!("{rows} bytes of rows: checkpoint {checkpoint}, memory {small} and {large}");
    assert!(rows > 5 << 20);
    assert!((1..200_000).contains(&checkpoint), "{checkpoint}");
    assert!(large < small + (4 << 20), "{small} and {large}");
    let files = ["history.csv", "scenario.toml", "state.csv"];
    assert_eq!(names(&dir.path("40")), files);
}
