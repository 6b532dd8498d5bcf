//! Results that cannot be lost: one maker at a time for every file, and nothing replaced but files.

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
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
            "sweep --sensitivity a.toml --out x.csv --force",
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
fn links_and_devices_are_not_replaced_and_stdout_is_written_through() {
    let dir = dir();
    dir.write("mine", b"mine");
    for (name, target) in [
        ("link.svg", "mine"),
        ("link.csv", "mine"),
        ("nowhere.csv", "x"),
    ] {
        symlink(dir.path(target), dir.path(name)).expect("a link");
    }
    for line in [
        "sweep a.toml --out link.csv --force",
        "sweep a.toml --out nowhere.csv",
        "sweep a.toml --out /dev/null --force",
        "figure hertz --cycles 1 -o link.svg --force",
        "verify --csv link.csv --force",
    ] {
        dir.refuse_line(line, "is not a regular file");
    }
    assert_eq!(dir.read("mine"), "mine");
    let table = "sweep --sensitivity a.toml --quiet --out";
    dir.done(&format!("{table} table.csv"));
    assert_eq!(
        dir.done(&format!("{table} /dev/stdout")),
        dir.read("table.csv")
    );
    dir.done("sweep a.toml --quiet --out rows.csv");
    assert_eq!(
        dir.done("sweep a.toml --out /dev/stdout"),
        dir.read("rows.csv")
    );
}

#[test]
fn locks_and_rows_of_a_run_are_not_followed_through_links() {
    for own in [".mdr-tui-lock", ".mdr-tui-history"] {
        let dir = dir();
        dir.write("mine", b"mine");
        fs::create_dir(dir.path("x")).expect("a directory");
        symlink(dir.path("mine"), dir.path(&format!("x/{own}"))).expect("a link");
        let said = dir.line("run hertz --cycles 2 --out x");
        assert!(
            said.code != 0 && said.err.contains("not a regular file") && said.err.contains(own),
            "{}",
            said.err
        );
        assert_eq!(dir.read("mine"), "mine");
    }
}

#[test]
fn a_forced_run_takes_the_old_run_s_files_away_and_no_others() {
    let dir = dir();
    let small = "--set numerics.points=8 --quiet --out x";
    dir.done(&format!(
        "run hertz --cycles 2 --snapshot-at 0.5,1 --field {small}"
    ));
    let mine = ["state-best.csv", "notes.txt", "state-1.5.csv"];
    for name in mine {
        dir.write(&format!("x/{name}"), b"mine\n1\n");
    }
    // What is refused takes nothing away.
    let refused = dir.line("run cone --cycles -1 --out x --force");
    assert!(refused.code == 2 && dir.path("x/field.csv").exists());
    dir.done(&format!("run cone --cycles 1 --force {small}"));
    let mut expected = vec!["history.csv", "loop.csv", "scenario.toml", "state.csv"];
    expected.extend(mine);
    expected.sort_unstable();
    assert_eq!(names(&dir.path("x")), expected);
    for name in mine {
        assert_eq!(dir.read(&format!("x/{name}")), "mine\n1\n");
    }
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
fn a_run_tells_how_it_was_made_and_its_tables_do_not_hang_on_it() {
    let dir = dir();
    let made = |epoch: &str, out: &str| {
        let arguments = ["run", "hertz", "--cycles", "1", "--quiet", "--out", out];
        let mut command = dir.command(&[&arguments[..], &["--set", "title=a b"]].concat());
        let output = command.env("SOURCE_DATE_EPOCH", epoch).output();
        assert!(output.expect("the program starts").status.success());
        dir.read(&format!("{out}/provenance.toml"))
    };
    let text = made("951782400", "x");
    let table: toml::Table = text.parse().expect("TOML");
    let of = |key: &str| table[key].as_str().expect("a text").to_owned();
    assert_eq!(of("date"), "2000-02-29T00:00:00Z");
    assert_eq!(
        of("command"),
        "mdr-tui run hertz --cycles 1 --quiet --out x --set 'title=a b'"
    );
    assert!(of("version").starts_with(env!("CARGO_PKG_VERSION")));
    has(&of("arithmetic"), std::env::consts::ARCH);
    // Later, elsewhere.
    assert_ne!(made("1", "y"), text);
    for name in names(&dir.path("x")) {
        assert_eq!(
            dir.read(&format!("x/{name}")),
            dir.read(&format!("y/{name}"))
        );
    }
    fs::remove_dir_all(dir.path("x")).expect("a directory");
    assert_eq!(made("951782400", "x"), text);
}

/// What a supplement to a paper holds: a run from its `scenario.toml` writes the same files, snapshots with the error
/// that is known at the end alone included, and figures of both are the same.
#[test]
fn a_supplement_gives_the_same_files() {
    let dir = dir();
    dir.done(
        "run li2019-fig3 --set numerics.points=40 --set numerics.steps_per_cycle=24 --cycles 3 --snapshot-at 1,2.5 \
         --estimate-error --out x --quiet",
    );
    dir.done("run x/scenario.toml --out y --quiet");
    for out in ["x", "y"] {
        dir.done(&format!(
            "figure {out} --panel profile --panel loop -o {out}.pdf"
        ));
        fs::remove_file(dir.path(&format!("{out}/provenance.toml"))).expect("a file");
    }
    let mut names: Vec<String> = names(&dir.path("x")).into_iter().collect();
    names.sort();
    for name in &names {
        let [first, again] = ["x", "y"].map(|out| dir.read(&format!("{out}/{name}")));
        assert!(first == again, "{name}");
    }
    assert!(names.contains(&"state-2.5.csv".to_owned()), "{names:?}");
    has(&dir.read("x/state-2.5.csv"), "# estimated_error_volume: ");
    let [first, again] = ["x.pdf", "y.pdf"].map(|name| fs::read(dir.path(name)).expect("a file"));
    assert!(first == again);
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
