//! `mdr-tui sweep`: studies of many points, their files and their shards.

use std::fs;
use std::thread;
use std::time::Duration;

use crate::common::near;
use crate::regressions::memory_of;
use crate::screen_table::hold;
use crate::test_dir::{TestDir, end, has, lacks, signal};

/// 4 × 3 points that take some tens of milliseconds each, fine enough to pass every check.
const STUDY: &str = r#"
base = "li2019-fig3"
columns = ["wear_volume_m3", "dissipated_energy_J", "regime", "energy_ratio", "cycle"]

[set]
"run.cycles" = 3.0
"numerics.points" = 150
"numerics.steps_per_cycle" = 60

[[axis]]
key = "motion.normal.mean"
linspace = [6e-7, 2e-6, 4]

[[axis]]
key = "motion.tangential.amplitude"
logspace = [1e-8, 1e-6, 3]
"#;

#[cfg(target_os = "linux")]
#[test]
fn studies_do_what_the_table_says() {
    let study = |dir: &TestDir| dir.write("study.toml", STUDY.as_bytes());
    crate::command_table::hold("sweeps.txt", study);
}

fn dir_with(study: &str) -> TestDir {
    let dir = TestDir::new();
    dir.write("study.toml", study.as_bytes());
    dir
}

#[test]
fn killed_studies_go_on_to_the_same_bytes() {
    // Three kills a round, more than 50 in all.
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out whole.csv");
    let whole = dir.read("whole.csv");
    let line = "sweep study.toml --out map.csv --resume --threads 2 --quiet";
    for round in 0..17 {
        let _ = fs::remove_file(dir.path("map.csv"));
        for _ in 0..3 {
            let mut child = dir.start(line, &[]);
            thread::sleep(Duration::from_millis(10 + 5 * round));
            // SIGKILL.
            let _ = child.kill();
            let _ = child.wait();
        }
        dir.done(line);
        assert_eq!(dir.read("map.csv"), whole, "round {round}");
    }
}

#[cfg(unix)]
#[test]
fn a_signal_keeps_what_is_done() {
    let coarse = STUDY.replace(" = 150", " = 30").replace(" = 60", " = 20");
    let dir = dir_with(&coarse.replace("\"run.cycles\" = 3.0", "\"run.cycles\" = 400.0"));
    let child = dir.start("sweep study.toml --threads 1 --quiet", &[]);
    let rows = || match fs::read_to_string(dir.path("study.csv")) {
        Ok(text) => text.lines().filter(|line| line.ends_with(",ok")).count(),
        Err(_) => 0,
    };
    while rows() < 2 {
        thread::sleep(Duration::from_millis(2));
    }
    // A scheduler sends it twice.
    for _ in 0..2 {
        signal(&child, "TERM");
    }
    let hint = "of 12 points are in study.csv; continue with the same command and --resume";
    end(child).ends(75, hint);
    assert!((2..12).contains(&rows()));
    dir.table("study.csv");
}

#[test]
fn whatever_a_text_holds_its_table_reads_back_and_stays_on_its_line() {
    let value = "\"a\u{a0}b \\u001b[2J\\nc \u{301}\u{202e} \\\"quotes\\\" \u{e000}\"";
    let study = format!("title = {value}\n{STUDY}")
        .replace("[set]\n", &format!("[set]\ndescription = {value}\n"))
        .replace(
            "key = \"motion.tangential.amplitude\"\nlogspace = [1e-8, 1e-6, 3]",
            &format!("key = \"title\"\nvalues = [{value}, \"plain\"]"),
        );
    let dir = dir_with(&study);
    dir.done("sweep study.toml --out whole.csv");
    let whole = dir.read("whole.csv");
    let is_plain = |text: &str| !text.chars().any(|c| c.is_control() && c != '\n');
    assert!(is_plain(&whole) && whole.lines().all(|line| line.contains(['#', ',', '='])));
    for shard in 0..3 {
        dir.done(&format!("sweep study.toml --shard {shard}/3"));
    }
    assert_eq!(dir.done("sweep --merge study.shards"), whole);
    dir.done("sweep study.toml --out whole.csv --resume --quiet");
    assert_eq!(dir.read("whole.csv"), whole);
    // The point is a scenario with that title.
    let point = dir.done("sweep study.toml --point 0");
    assert!(
        is_plain(&point) && point.starts_with("# point 0"),
        "{point}"
    );
    dir.write("point.toml", point.as_bytes());
    dir.done("run point.toml --quiet --out point");
    dir.done("sweep --view whole.csv --print 80x24");
    let slurm = ["sweep", "study.toml", "--slurm", "--shards", "2"];
    let rude = ["--out", "a\nb", "--set", "description=\u{1b}\n"];
    let script = dir.say(&[&slurm[..], &rude].concat());
    assert!(script.code == 0 && is_plain(&script.out), "{}", script.err);
    lacks(&script.out, "\nb");
}

/// A study of many points that take no time.
fn many(points: usize) -> String {
    format!(
        "base = \"hertz\"\ncolumns = []\n[set]\n\"run.cycles\" = 0\n\"numerics.points\" = 4\n\
         [[axis]]\nkey = \"motion.normal.mean\"\nlinspace = [1e-6, 2e-6, {}]\n\
         [[axis]]\nkey = \"friction.coefficient\"\nlogspace = [0.1, 0.9, {}]\n",
        points / 10,
        10
    )
}

#[cfg(target_os = "linux")]
#[test]
fn of_a_million_points_the_first_row_comes_soon_and_none_takes_much_memory() {
    let dir = dir_with(&many(1_000_000));
    let start = std::time::Instant::now();
    let child = dir.start("sweep study.toml --threads 2 --quiet", &[]);
    let rows = || match fs::read(dir.path("study.csv")) {
        Ok(text) => text.iter().filter(|&&byte| byte == b'\n').count(),
        Err(_) => 0,
    };
    while rows() < 100 {
        assert!(start.elapsed() < Duration::from_secs(20), "no row");
        thread::sleep(Duration::from_millis(5));
    }
    // Two seconds, on a machine that others use too.
    assert!(start.elapsed() < Duration::from_secs(8));
    let before = (rows(), memory_of(&child) as f64);
    while rows() < before.0 + 4000 {
        thread::sleep(Duration::from_millis(50));
    }
    let taken = memory_of(&child) as f64 - before.1;
    let per_row = taken / (rows() - before.0) as f64;
    signal(&child, "TERM");
    end(child).ends(75, "of 1000000 points are in study.csv");
    assert!(per_row < 400.0, "{per_row} bytes");
}

/// The screen that `--view` prints, line by line.
fn screen(dir: &TestDir, file: &str, keys: &str) -> Vec<String> {
    let said = dir.say(&[
        "sweep", "--view", file, "--print", "80x24", "--keys", keys, "--color", "never",
    ]);
    assert_eq!((said.code, said.err.as_str()), (0, ""), "{keys}");
    said.out.lines().map(str::to_owned).collect()
}

#[test]
fn the_map_shows_two_axes_and_reads_points() {
    let study = |dir: &TestDir| dir.write("study.toml", STUDY.as_bytes());
    hold("sweep", study);
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out map.csv");
    // The lowest depth is the lowest row, which ends by sliding.
    let lines = screen(&dir, "map.csv", "<Tab><Tab>");
    let lowest = lines.iter().rfind(|line| line.contains('~'));
    let lowest = lowest.expect("a row of the map");
    let last = lowest.chars().rfind(|sign| "s~#".contains(*sign));
    assert_eq!(last, Some('#'), "{lines:?}");
    // The cursor: two to the right, three up; the point is the row's.
    let lines = screen(&dir, "map.csv", "ll<Up>kk");
    let is_read = |line: &&String| line.starts_with("worn volume V ") && line.contains("regime");
    let read = lines.iter().rfind(is_read).expect("readings");
    has(read, " µm³  ");
    let shown = read.split_whitespace().nth(3).expect("V");
    let shown: f64 = shown.parse().expect("V");
    let volume = dir.table("map.csv").column("wear_volume_m3")[11];
    near("V", 1e-18 * shown, volume, 1e-3);
    // The axes change places, and the last tick is there, too.
    let turned = screen(&dir, "map.csv", "x");
    assert!(turned.iter().any(|line| line.ends_with(" 2.2")));
}

#[test]
fn the_studies_of_the_guide_are_studies() {
    let topic = mdr_tui::guide::Topic::find("studies").expect("the topic");
    let blocks = topic.text.split("```toml study\n").skip(1);
    let blocks: Vec<&str> = blocks.filter_map(|rest| rest.split("```").next()).collect();
    let dir = TestDir::new();
    for block in &blocks {
        dir.write("study.toml", block.as_bytes());
        dir.line("sweep study.toml --point 0").ends(0, "");
    }
    assert!(!blocks.is_empty());
}

/// By its own command: `tests/slurm/run.sh PROGRAM`.
#[cfg(target_os = "linux")]
#[test]
fn a_slurm_array_gives_the_rows_of_a_local_run() {
    let dir = TestDir::new();
    let programs = "sbatch slurmctld slurmd munged python3";
    let there = format!("PATH=/usr/bin:/usr/sbin:/bin; type {programs} && test $(id -u) = 0");
    if dir.shell(&there).code != 0 {
        eprintln!("skipped: Slurm is not installed, or this is not root");
        return;
    }
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/slurm/run.sh");
    let said = dir.shell(&format!("bash '{script}' \"$BIN\" \"$PWD/cluster\""));
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    has(&said.out, "1000 points, the same bytes as the local run");
}
