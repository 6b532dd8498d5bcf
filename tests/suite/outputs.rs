//! Results that cannot be lost: one maker at a time for every file, and nothing replaced but files.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

use crate::test_dir::{Said, TestDir, end, has, kill, names};

const STUDY: &str = r#"
base = "hertz"
columns = ["wear_volume_m3"]
[set]
"run.cycles" = 1.0
"numerics.points" = 8
"numerics.steps_per_cycle" = 4
[[axis]]
key = "motion.normal.mean"
linspace = [1e-6, 2e-6, 12]
"#;

fn dir() -> TestDir {
    let dir = TestDir::new();
    dir.write("a.toml", STUDY.as_bytes());
    let other = STUDY.replace("2e-6, 12", "3e-6, 8");
    dir.write("b.toml", other.as_bytes());
    dir
}

/// Fails if a lock or a file under way is left behind.
fn leaves_nothing(dir: &TestDir) {
    let left = names(&dir.path(""));
    assert!(left.iter().all(|name| !name.starts_with('.')), "{left:?}");
}

/// Starts the lines, each a while after the one before, and waits for all.
fn together(dir: &TestDir, lines: &[&str], pause: Duration, fault: &str) -> Vec<Said> {
    let started: Vec<_> = lines
        .iter()
        .map(|line| {
            let child = dir.start(line, &[("MDR_TUI_FAULT", fault)]);
            thread::sleep(pause);
            child
        })
        .collect();
    started.into_iter().map(end).collect()
}

#[test]
fn of_two_studies_into_one_file_no_row_is_lost_and_the_second_hears_of_it() {
    let dir = dir();
    let whole = ["a", "b"].map(|study| {
        dir.done(&format!(
            "sweep {study}.toml --out whole-{study}.csv --quiet"
        ));
        dir.read(&format!("whole-{study}.csv"))
    });
    for fault in ["", "no locks"] {
        for (round, flag) in ["--resume", "--force", ""]
            .iter()
            .cycle()
            .take(24)
            .enumerate()
        {
            let out = format!("x-{round}.csv");
            let lines = ["a", "b"].map(|study| format!("sweep {study}.toml --out {out} {flag}"));
            let pause = Duration::from_millis([0, 2, 7, 20][round % 4]);
            let said = together(&dir, &[&lines[0], &lines[1]], pause, fault);
            let table = dir.read(&out);
            let codes = [said[0].code, said[1].code];
            let kept = match codes {
                [0, 2] => 0,
                [2, 0] => 1,
                // The second one has begun when the first one had ended, as it was asked to.
                [0, 0] if *flag == "--force" => usize::from(table == whole[1]),
                _ => panic!("{codes:?} {flag}: {}{}", said[0].err, said[1].err),
            };
            assert!(table == whole[kept], "{flag} {fault}: {codes:?}");
            fs::remove_file(dir.path(&out)).expect("the table");
            leaves_nothing(&dir);
        }
    }
}

#[test]
fn a_study_under_way_is_refused_to_others_before_they_compute_even_by_force() {
    let dir = dir();
    let long = STUDY.replace("\"run.cycles\" = 1.0", "\"run.cycles\" = 1e9");
    dir.write("long.toml", long.as_bytes());
    for fault in ["", "no locks"] {
        let line = "sweep long.toml --out x.csv --force";
        let mut alive = dir.start(line, &[("MDR_TUI_FAULT", fault)]);
        dir.wait_for(&mut alive, "x.csv");
        for line in [
            "sweep a.toml --out x.csv --force",
            "sweep long.toml --out x.csv --resume",
            "verify --csv x.csv --force",
        ] {
            let said = &together(&dir, &[line], Duration::ZERO, fault)[0];
            let owner = format!("is writing this file (process {} on ", alive.id());
            said.ends(2, &owner);
        }
        kill(alive);
        // What it leaves behind is stale.
        let said = &together(
            &dir,
            &["sweep a.toml --out x.csv --force"],
            Duration::ZERO,
            fault,
        )[0];
        assert_eq!(said.code, 0, "{}", said.err);
        fs::remove_file(dir.path("x.csv")).expect("the table");
    }
    leaves_nothing(&dir);
}

#[test]
fn a_folder_of_many_users_is_nobody_s_alone() {
    let dir = dir();
    let open = |name: &str, mode: u32| {
        let mode = fs::Permissions::from_mode(mode);
        fs::set_permissions(dir.path(name), mode).expect("its mode");
    };
    open("", 0o1777);
    fs::create_dir(dir.path("closed")).expect("a directory");
    open("closed", 0o755);
    let program = dir.command(&[]).get_program().to_owned();
    let as_nobody = |arguments: &[&str]| {
        let mut command = std::process::Command::new("setpriv");
        command.args(["--reuid=65534", "--regid=65534", "--clear-groups"]);
        let command = command.arg(&program).args(arguments);
        let output = command.current_dir(dir.path("")).output();
        output.map(Said::from)
    };
    if !as_nobody(&["--version"]).is_ok_and(|said| said.code == 0) {
        eprintln!("not held here: only root can be somebody else");
        return;
    }
    let line = ["sweep", "a.toml", "--quiet", "--out"];
    let say = |out: &str| as_nobody(&[&line[..], &[out]].concat()).expect("it starts");
    // What another user's process has left behind, which only that user can remove.
    dir.write(".mdr-tui-x.csv.lock", b"999999999 here\n");
    let said = say("x.csv");
    assert_eq!((said.code, &*said.err), (0, ""));
    let held = fs::File::open(dir.path(".mdr-tui-x.csv.lock")).expect("the lock");
    held.lock().expect("a lock");
    let said = say("x.csv");
    said.ends(2, "is writing this file");
    let said = say("closed/x.csv");
    has(&said.err, " closed/x.csv: cannot write: Permission denied");
}

#[test]
fn force_removes_what_the_earlier_run_has_written_and_nothing_else() {
    let dir = TestDir::new();
    let line = "run li2019-fig3 --set numerics.points=20 --quiet --cycles 2";
    dir.done(&format!("{line} --snapshot-at 1,1.5 --field --out x"));
    dir.done(&format!("{line} --snapshot-at 0.5 --out other"));
    // Another run's table, one that replaces the run's, and a figure's data.
    fs::copy(dir.path("other/state-0.5.csv"), dir.path("x/state-0.5.csv")).expect("a copy");
    dir.write("x/state-1.5.csv", b"r_m,f_m\n0,0\n");
    dir.done("figure x -o x/state.svg --panel profile --quiet");
    dir.done("figure x -o again.svg --panel profile --quiet");
    let mine = [
        "state-0.5.csv",
        "state-1.5.csv",
        "state.svg",
        "state-drawn.csv",
    ];
    let before = mine.map(|name| dir.read(&format!("x/{name}")));
    dir.done(&format!("{line} --out x --force"));
    assert_eq!(mine.map(|name| dir.read(&format!("x/{name}"))), before);
    let left = names(&dir.path("x"));
    assert!(!left.contains(&"state-1.csv".into()) && !left.contains(&"field.csv".into()));
    dir.done(&format!("{line} --out whole"));
    for name in names(&dir.path("whole")) {
        let [one, other] = ["x", "whole"].map(|of| dir.read(&format!("{of}/{name}")));
        assert!(one == other, "{name}");
    }
}

/// Calls of the system by which files come to be as they are.
const CALLS: &str =
    "openat write pwrite64 fsync rename renameat renameat2 unlink flock ftruncate lseek";

#[cfg(target_os = "linux")]
#[test]
fn a_kill_at_every_system_call_of_a_study_resumes_to_the_same_bytes() {
    let dir = dir();
    let arguments = ["sweep", "s.toml", "--threads", "1", "--quiet", "--resume"];
    dir.write("s.toml", STUDY.replace("2e-6, 12", "2e-6, 3").as_bytes());
    let traced = std::process::Command::new("strace").arg("true").output();
    if !traced.is_ok_and(|output| output.status.success()) {
        eprintln!("not held here: there is no strace, or it may not trace");
        return;
    }
    dir.done("sweep s.toml --quiet --out whole.csv");
    let whole = dir.read("whole.csv");
    let mut kills = 0;
    for call in CALLS.split(' ') {
        for count in 1.. {
            let _ = fs::remove_file(dir.path("s.csv"));
            let program = dir.command(&arguments);
            let mut tracer = std::process::Command::new("strace");
            tracer
                .args(["-f", "-o", "/dev/null"])
                .args(["-e", &format!("trace={call}"), "-e"])
                .arg(format!("inject={call}:signal=SIGKILL:when={count}"))
                .arg(program.get_program())
                .args(program.get_args())
                .current_dir(dir.path(""))
                .env("XDG_CONFIG_HOME", dir.path(""))
                .stdin(Stdio::null());
            // The tracer dies as its program does.
            if tracer.status().expect("strace").success() {
                break;
            }
            kills += 1;
            dir.done(&arguments.join(" "));
            assert!(dir.read("s.csv") == whole, "{call} {count}");
            leaves_nothing(&dir);
        }
    }
    assert!(kills > 30, "{kills}");
}
