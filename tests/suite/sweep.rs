//! `mdr-tui sweep`: studies of many points, their files and their shards.

use std::fs;
use std::thread;
use std::time::Duration;

use crate::common::near;
use crate::screen_table::hold;
use crate::test_dir::{Table, TestDir, end, has, lacks, signal};
use mdr_tui::studies::sweep::record::Record;
use mdr_tui::studies::sweep::slice::Slice;

/// 4 × 3 points that take some milliseconds each.
const STUDY: &str = r#"
base = "li2019-fig3"
columns = ["wear_volume_m3", "dissipated_energy_J", "regime", "energy_ratio", "cycle"]

[set]
"run.cycles" = 3.0
"numerics.points" = 30
"numerics.steps_per_cycle" = 20

[[axis]]
key = "motion.normal.mean"
linspace = [6e-7, 2e-6, 4]

[[axis]]
key = "motion.tangential.amplitude"
logspace = [1e-8, 1e-6, 3]
"#;

fn dir_with(study: &str) -> TestDir {
    let dir = TestDir::new();
    dir.write("study.toml", study.as_bytes());
    dir
}

#[test]
fn a_row_a_point_in_the_order_of_the_axes() {
    let dir = dir_with(STUDY);
    let said = dir.done("sweep study.toml --out map.csv");
    assert_eq!(said, "12 points in map.csv\n");
    let table = dir.table("map.csv");
    assert_eq!(
        table.columns,
        [
            "motion.normal.mean",
            "motion.tangential.amplitude",
            "wear_volume_m3",
            "dissipated_energy_J",
            "regime",
            "energy_ratio",
            "cycle",
            "status"
        ]
    );
    let amplitudes = table.column("motion.tangential.amplitude");
    assert_eq!(amplitudes[..3], [1e-8, 1e-7, 1e-6]);
    let means = table.column("motion.normal.mean");
    assert_eq!(means[..4], [6e-7, 6e-7, 6e-7, means[3]]);
    assert_eq!((means[0], means[11]), (6e-7, 2e-6));
    assert!(
        table.rows.iter().all(|row| row[7] == "ok"),
        "{:?}",
        table.rows
    );
    let regime = |row: usize| table.rows[row][4].as_str();
    assert_eq!(
        (regime(2), regime(10), regime(9)),
        ("gross", "partial", "partial")
    );
    // The header holds the study and its base.
    let text = dir.read("map.csv");
    has(&text, "\n# study: base = \"li2019-fig3\"\n");
    has(&text, "\n# base: shape = \"paraboloid\"\n");
}

#[test]
fn a_point_is_an_ordinary_run() {
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out map.csv");
    fs::write(dir.path("p.toml"), dir.done("sweep study.toml --point 7")).expect("a file");
    dir.done("run p.toml --out p --quiet");
    let (map, run) = (dir.table("map.csv"), dir.table("p/history.csv"));
    for name in ["wear_volume_m3", "dissipated_energy_J", "energy_ratio"] {
        let last = *run.column(name).last().expect("a row");
        assert_eq!(map.column(name)[7].to_bits(), last.to_bits(), "{name}");
    }
}

#[test]
fn rows_are_the_same_on_any_number_of_threads_and_in_any_number_of_shards() {
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out one.csv --threads 1");
    dir.done("sweep study.toml --out many.csv --threads 7");
    let whole = dir.read("one.csv");
    assert_eq!(dir.read("many.csv"), whole);
    for shard in 0..5 {
        dir.done(&format!("sweep study.toml --shard {shard}/5 --quiet"));
    }
    assert_eq!(dir.done("sweep --merge study.shards"), whole);
    dir.done("sweep --merge study.shards --out merged.csv");
    assert_eq!(dir.read("merged.csv"), whole);
    // Under Slurm the index comes from the task, the number from the command line.
    let task = [
        ("SLURM_ARRAY_TASK_ID", "3"),
        ("SLURM_ARRAY_TASK_COUNT", "1"),
    ];
    dir.line_with("sweep study.toml --shards 5 --out s.csv", &task)
        .ends(0, "");
    assert_eq!(dir.read("s.csv"), dir.read("study.shards/shard-3.csv"));
}

#[test]
fn merging_names_what_is_missing_double_or_of_another_study() {
    let dir = dir_with(STUDY);
    for shard in 0..3 {
        dir.done(&format!("sweep study.toml --shard {shard}/3 --quiet"));
    }
    let merge = ["sweep", "--merge", "study.shards"];
    let shard = dir.read("study.shards/shard-1.csv");
    fs::remove_file(dir.path("study.shards/shard-1.csv")).expect("a file");
    let said = dir.say(&merge);
    said.ends(
        1,
        "4 of 12 points are missing: point 1 (motion.normal.mean = 6e-7",
    );
    assert!(said.err.ends_with("of 3 shards, these are incomplete: 1\n"));

    dir.write("study.shards/shard-1.csv", shard.as_bytes());
    dir.write("study.shards/again.csv", shard.as_bytes());
    let said = dir.say(&merge);
    assert_eq!(said.code, 0);
    has(&said.err, "4 identical duplicate rows were dropped");
    let changed = shard.replace(",partial,", ",gross,");
    assert_ne!(changed, shard);
    dir.write("study.shards/again.csv", changed.as_bytes());
    let said = dir.say(&merge);
    assert_eq!(said.code, 1);
    has(&said.err, "points have two rows that differ");

    let other = shard.replace("\"run.cycles\" = 3.0", "\"run.cycles\" = 4.0");
    dir.write("study.shards/again.csv", other.as_bytes());
    dir.refuse(&merge, "holds another study: study: \"run.cycles\" = ");
    dir.write("study.shards/again.csv", b"r_m\n1\n");
    dir.refuse(&merge, "again.csv: is not a table of mdr-tui sweep");
}

#[test]
fn zipped_sampled_and_tied_axes() {
    let zipped = r#"
base = "hertz"
design = "zip"
columns = ["F_z_N"]
set = { "run.cycles" = 0.0 }
axis = [
    { key = "indenter.radius", values = [0.01, 0.02] },
    { key = "motion.normal.mean", values = [1e-6, 5e-7], tied = { "motion.normal.amplitude" = 0.25 } },
]
"#;
    let dir = dir_with(zipped);
    dir.done("sweep study.toml");
    let table = dir.table("study.csv");
    assert_eq!(table.column("indenter.radius"), [0.01, 0.02]);
    let force = table.column("F_z_N");
    // F = 4/3 E* √R d^1.5.
    near("ratio of forces", force[0] / force[1], 2.0, 1e-9);
    let point = dir.done("sweep study.toml --point 1");
    has(&point, "mean = 5e-7 ");
    has(&point, "amplitude = 1.25e-7 ");

    for design in ["latin-hypercube", "sobol"] {
        let sampled = format!(
            "base = \"hertz\"\ndesign = \"{design}\"\nsamples = 8\nseed = 3\ncolumns = []\n\
             set.run.cycles = 0\n[[axis]]\nkey = \"indenter.radius\"\nlogspace = [1e-3, 1e-1]\n\
             [[axis]]\nkey = \"motion.normal.mean\"\nlinspace = [1e-7, 1e-6]\n"
        );
        dir.write("sampled.toml", sampled.as_bytes());
        dir.done("sweep sampled.toml --force");
        let table = dir.table("sampled.csv");
        let mut strata: Vec<usize> = table
            .column("indenter.radius")
            .iter()
            .map(|radius| ((radius / 1e-3).log10() * 4.0) as usize)
            .collect();
        strata.sort_unstable();
        assert_eq!(strata, (0..8).collect::<Vec<_>>(), "{design}");
    }
}

#[test]
fn a_study_that_was_interrupted_goes_on_to_the_same_bytes() {
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out whole.csv");
    let whole = dir.read("whole.csv");
    // What a kill leaves: some rows in any order, the last one torn.
    let lines: Vec<&str> = whole.split_inclusive('\n').collect();
    let head: String = lines.iter().take(lines.len() - 12).copied().collect();
    let rows = &lines[lines.len() - 12..];
    let torn = format!("{head}{}{}{}", rows[7], rows[2], &rows[5][..20]);
    dir.write("map.csv", torn.as_bytes());
    dir.refuse_line(
        "sweep study.toml --out map.csv",
        "map.csv: already exists; --resume continues it",
    );
    dir.done("sweep study.toml --out map.csv --resume");
    assert_eq!(dir.read("map.csv"), whole);
    // The rows that were there were not computed again.
    let marked = torn.replace(rows[2], &rows[2].replace(",ok\n", ",a reason\n"));
    dir.write("map.csv", marked.as_bytes());
    let said = dir.line("sweep study.toml --out map.csv --resume");
    has(&said.err, "1 of 12 points failed");
    has(&dir.read("map.csv"), ",a reason\n");
    // Those that failed are, on demand.
    dir.done("sweep study.toml --out map.csv --resume --failed");
    assert_eq!(dir.read("map.csv"), whole);
    // Another study does not go on with it.
    dir.refuse_line(
        "sweep study.toml --out map.csv --resume --set friction.coefficient=0.2",
        "map.csv: holds another study: ",
    );
    assert_eq!(dir.read("map.csv"), whole);
}

#[test]
fn killed_studies_go_on_to_the_same_bytes() {
    // Three kills a round, more than 50 in all.
    let dir = dir_with(&STUDY.replace("\"run.cycles\" = 3.0", "\"run.cycles\" = 20.0"));
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
    let dir = dir_with(&STUDY.replace("\"run.cycles\" = 3.0", "\"run.cycles\" = 400.0"));
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
fn a_table_that_a_spreadsheet_has_saved_is_read_by_the_names_of_its_columns() {
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out whole.csv");
    let whole = dir.read("whole.csv");
    let (head, rows): (Vec<&str>, Vec<&str>) =
        whole.lines().partition(|line| line.starts_with('#'));
    let moved = rows.iter().map(|row| {
        let mut fields: Vec<&str> = row.split(',').collect();
        fields.rotate_left(3);
        fields.join(",").replace("e-7", "E-07")
    });
    // The last rows are missing.
    let moved: Vec<String> = moved.take(10).collect();
    let saved = format!(
        "\u{feff}{}\r\n{}\r\n",
        head.join("\r\n"),
        moved.join("\r\n")
    );
    let again = |saved: &str| {
        dir.write("map.csv", saved.as_bytes());
        dir.line("sweep study.toml --out map.csv --resume")
    };
    let said = again(&saved);
    assert_eq!((said.code, &*said.err), (0, ""));
    assert_eq!(dir.read("map.csv"), whole);
    fs::create_dir(dir.path("parts")).expect("a directory");
    let all: String = rows.iter().map(|row| row.to_string() + "\r\n").collect();
    dir.write(
        "parts/a.csv",
        format!("{}\r\n{all}", head.join("\r\n")).as_bytes(),
    );
    assert_eq!(dir.done("sweep --merge parts"), whole);
    let shown = dir.done("sweep --view parts/a.csv --print 80x24");
    has(&shown, "12 of 12 points");
    for (from, to, why) in [
        (
            "cycle,",
            "cycles,",
            "has a column cycles, which the study does not have",
        ),
        (",cycle,", ",status,", "has no column cycle"),
        ("# study: base", "\"# study: base", "in quotes"),
    ] {
        let said = again(&saved.replace(from, to));
        said.ends(2, why);
    }
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

#[test]
fn a_table_names_the_arithmetic_of_all_machines_that_have_run_its_points() {
    let dir = dir_with(STUDY);
    for shard in 0..2 {
        dir.done(&format!("sweep study.toml --shard {shard}/2"));
    }
    let path = "study.shards/shard-1.csv";
    let (text, line) = (dir.read(path), "# arithmetic: ");
    let here = text
        .lines()
        .find(|text| text.starts_with(line))
        .expect("the line");
    assert_eq!(
        dir.done("sweep --merge study.shards").matches(here).count(),
        1
    );
    // The same digits, as it happens.
    dir.write(path, text.replace(here, "# arithmetic: abacus").as_bytes());
    let both = format!("# arithmetic: abacus; {}\n", &here[line.len()..]);
    let merged = dir.done("sweep --merge study.shards");
    has(&merged, &both);
    dir.done(&format!(
        "sweep study.toml --shard 1/2 --out {path} --resume --quiet"
    ));
    has(&dir.read(path), &both);
    dir.write("m.csv", merged.as_bytes());
    dir.done("sweep --view m.csv --print 80x24");
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

#[test]
fn long_axes_are_written_by_their_ends_and_shards_of_them_merge() {
    let dir = dir_with(&many(20_000));
    let sampled = "base = \"hertz\"\ndesign = \"latin-hypercube\"\nsamples = 2000\ncolumns = []\n\
                   [set]\n\"run.cycles\" = 0\n\"numerics.points\" = 4\n\
                   [[axis]]\nkey = \"motion.normal.mean\"\nlinspace = [1e-6, 2e-6]\n\
                   [[axis]]\nkey = \"indenter.radius\"\nlogspace = [1e-3, 1e-2]\n";
    dir.write("sampled.toml", sampled.as_bytes());
    for study in ["study", "sampled"] {
        for shard in 0..3 {
            dir.done(&format!("sweep {study}.toml --shard {shard}/3"));
        }
        dir.done(&format!(
            "sweep {study}.toml --out whole.csv --force --quiet"
        ));
        let whole = dir.read("whole.csv");
        assert!(
            whole
                .lines()
                .next_back()
                .is_some_and(|line| line.ends_with(",ok"))
        );
        assert!(whole.lines().all(|line| line.len() < 200));
        assert_eq!(dir.done(&format!("sweep --merge {study}.shards")), whole);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_number_of_points_and_the_first_row_comes_soon() {
    let peak = |points: usize| {
        let dir = dir_with(&many(points));
        let start = std::time::Instant::now();
        let child = dir.start("sweep study.toml --threads 2 --quiet", &[]);
        let status = format!("/proc/{}/status", child.id());
        let rows = || fs::metadata(dir.path("study.csv")).map_or(0, |about| about.len());
        while rows() < 4000 {
            assert!(start.elapsed() < Duration::from_secs(20), "no row");
            thread::sleep(Duration::from_millis(5));
        }
        let first = start.elapsed();
        while rows() < 100_000 {
            thread::sleep(Duration::from_millis(5));
        }
        let status = fs::read_to_string(status).expect("its status");
        let line = status
            .lines()
            .find(|line| line.starts_with("VmHWM"))
            .expect("its memory");
        let memory = line
            .split_whitespace()
            .nth(1)
            .and_then(|number| number.parse::<f64>().ok());
        signal(&child, "TERM");
        let said = end(child);
        assert!([0, 75].contains(&said.code), "{}", said.err);
        (memory.expect("a number"), first)
    };
    let (few, _) = peak(10_000);
    let (many, first) = peak(1_000_000);
    assert!(many < 1.2 * few, "{few} kB, {many} kB");
    // Two seconds, on a machine that others use too.
    assert!(first < Duration::from_secs(8), "{first:?}");
}

#[test]
fn a_point_that_is_found_invalid_while_others_run_stops_them() {
    // Far from the ends of the axes, which are checked first.
    let values = (1..=10_000).map(|at| match at {
        7_500 => "-1.0".to_owned(),
        at => format!("{at}e-20"),
    });
    let values: Vec<String> = values.collect();
    let study = many(100_000).replace(
        "\"motion.normal.mean\"\nlinspace = [1e-6, 2e-6, 10000]",
        &format!("\"wear.coefficient\"\nvalues = [{}]", values.join(", ")),
    );
    let dir = dir_with(&study);
    let said = dir.line("sweep study.toml --quiet");
    assert_eq!(said.code, 2, "{}", said.err);
    has(&said.err, "point 7499");
    has(&said.err, "--skip-invalid");
}

#[test]
fn failed_points_are_rows_with_their_reason() {
    // Deeper than the domain allows: found out during the run.
    let study = r#"
base = "li2019-fig3"
columns = ["wear_volume_m3"]
[set]
"run.cycles" = 2.0
"numerics.points" = 20
"numerics.steps_per_cycle" = 12
"numerics.domain_radius" = 1.2e-4
[[axis]]
key = "motion.normal.mean"
values = [1e-6, 3e-6]
"#;
    let dir = dir_with(study);
    // A queueing system must not take it for done.
    let said = dir.line("sweep study.toml");
    assert_eq!((said.code, said.out.as_str()), (1, ""));
    has(&said.err, "1 of 2 points failed");
    let text = dir.read("study.csv");
    let last = text.lines().last().expect("a row");
    assert!(
        last.starts_with("3e-6,,\"") || last.starts_with("3e-6,,"),
        "{last}"
    );
    has(last, "domain");
}

/// The slip ring of a tiny amplitude is narrower than cells can be; without wear there is no accuracy to reach.
#[test]
fn a_point_that_misses_its_accuracy_says_so_and_stays_on_the_map() {
    let study = r#"
base = "li2019-fig3"
columns = ["wear_volume_m3", "estimated_error"]
[set]
"run.cycles" = 0.3
"numerics.accuracy" = 1e-3
"motion.tangential.amplitude" = 1e-9
"motion.normal.amplitude" = 0.0
[[axis]]
key = "wear.coefficient"
values = [0.0, 1e-10]
"#;
    let dir = dir_with(study);
    let said = dir.line("sweep study.toml");
    assert_eq!(
        (said.code, said.out.as_str()),
        (0, "2 points in study.csv\n")
    );
    let line = "1 of 2 points did not reach numerics.accuracy; their status says what they reached";
    assert_eq!(said.err, format!("mdr-tui: {line}\n"));
    let map = dir.read("study.csv");
    let table = Table::parse(&map);
    let [unworn, worn] = &table.rows[..] else {
        panic!("{map}")
    };
    assert_eq!(unworn[3], "ok");
    let reached = worn[3].strip_prefix("accuracy ");
    let reached = reached.and_then(|rest| rest.strip_suffix(" instead of 1e-3"));
    let reached: f64 = reached.expect(&worn[3]).parse().expect("a number");
    assert!(reached > 1e-3 && reached >= table.column("estimated_error")[1]);
    // It has its result: there is nothing to run again, and a figure shows it.
    dir.done("sweep study.toml --resume --failed --quiet");
    assert_eq!(dir.read("study.csv"), map);
    dir.done("figure study.csv --column wear_volume_m3 -o map.svg");
    let record = Record::open(fs::File::open(dir.path("study.csv")).expect("a file"), "");
    let record = record.expect("a table");
    let mut slice = Slice::new(record.study().expect("a study"), "").expect("an axis");
    slice.renew(record, "").expect("its rows");
    assert!(
        slice
            .number(1, "wear_volume_m3")
            .is_some_and(|volume| volume > 0.0)
    );
}

#[test]
fn invalid_points_are_named_before_anything_runs() {
    let study = STUDY.replace("linspace = [6e-7, 2e-6, 4]", "values = [1e-6, -1.0]");
    let dir = dir_with(&study);
    let point = "point 3 (motion.normal.mean = -1, motion.tangential.amplitude = 1e-8)";
    let said = dir.refuse(&["sweep", "study.toml"], point);
    has(&said, "--skip-invalid");
    let said = dir.line("sweep study.toml --skip-invalid");
    assert_eq!(said.code, 0);
    let text = dir.read("study.csv");
    assert_eq!(text.matches(",ok\n").count(), 3);
    assert_eq!(text.matches("invalid: ").count(), 3);
}

#[test]
fn a_disk_that_fills_up_leaves_whole_rows() {
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out whole.csv");
    let whole = dir.read("whole.csv");
    // In blocks of 1024 bytes; the header takes most of them.
    let blocks = whole.len() / 1024;
    let line = "exec $BIN sweep study.toml --out map.csv --quiet";
    let said = dir.shell(&format!("trap '' XFSZ; ulimit -f {blocks}; {line}"));
    said.ends(1, "of 12 points are in map.csv");
    let kept = dir.read("map.csv");
    assert!(kept.ends_with(",ok\n") && kept.len() < whole.len());
    dir.done("sweep study.toml --out map.csv --resume");
    assert_eq!(dir.read("map.csv"), whole);
}

#[test]
fn json_lines_stand_in_the_order_of_the_axes() {
    let dir = dir_with(STUDY);
    let lines = dir.done("sweep study.toml --json --threads 4");
    let table = dir.table("study.csv");
    assert_eq!(lines.lines().count(), 12);
    for (line, volume) in lines.lines().zip(table.column("wear_volume_m3")) {
        let row: serde_json::Value = serde_json::from_str(line).expect("JSON");
        assert_eq!(row["status"], "ok");
        let number = line
            .split_once("\"wear_volume_m3\":")
            .and_then(|(_, rest)| rest.split_once(','));
        let (number, _) = number.expect("a member");
        assert_eq!(
            number.parse::<f64>().map(f64::to_bits),
            Ok(volume.to_bits())
        );
    }
}

#[test]
fn points_end_where_they_are_told_to() {
    let study = |stop: &str| {
        format!(
            "base = \"gross-slip\"\ncolumns = [\"cycle\", \"scar_depth_m\", \"wear_volume_m3\"]\n\
             [set]\n\"run.cycles\" = 40\n\"numerics.points\" = 30\n\
             \"numerics.steps_per_cycle\" = 20\n[stop]\n{stop}\n\
             [[axis]]\nkey = \"friction.coefficient\"\nvalues = [0.1]\n"
        )
    };
    let dir = dir_with(&study("worn_depth = 1e3"));
    dir.done("sweep study.toml");
    let last = dir.table("study.csv");
    assert_eq!(last.column("cycle"), [40.0]);
    let (depth, volume) = (
        last.column("scar_depth_m")[0],
        last.column("wear_volume_m3")[0],
    );
    for stop in [
        format!("worn_depth = {:e}", 0.5 * depth),
        format!("volume = {:e}", 0.5 * volume),
        // The volume grows evenly, so the second half of the cycles wears half of it.
        "settled = 0.6".to_owned(),
    ] {
        dir.write("study.toml", study(&stop).as_bytes());
        dir.done("sweep study.toml --force");
        let table = dir.table("study.csv");
        let cycle = table.column("cycle")[0];
        assert!(
            (2.0..40.0).contains(&cycle) && cycle.fract() == 0.0,
            "{stop}: {cycle}"
        );
        if stop.starts_with("volume") {
            assert!(table.column("wear_volume_m3")[0] >= 0.5 * volume);
        }
    }
}

#[test]
fn bad_studies_are_refused_in_one_line() {
    let axis = "[[axis]]\nkey = \"friction.coefficient\"\nvalues = [0.1]\n";
    let studies = [
        (String::new(), "base is missing"),
        ("base = \"hertz\"\n".into(), "there is no axis: add [[axis]]"),
        (format!("bass = \"hertz\"\n{axis}"), "unknown key bass; did you mean base?"),
        (format!("base = \"herz\"\n{axis}"), "herz: no such preset; did you mean hertz?"),
        (format!("base = \"hertz\"\ncolumns = [\"wear_volume\"]\n{axis}"), "did you mean wear_volume_m3?"),
        (format!("base = \"hertz\"\ncolumns = [\"cycle\", \"cycle\"]\n{axis}"), "stands twice"),
        (format!("base = \"hertz\"\n{}", axis.replace("friction", "frictoin")), "did you mean friction.coefficient?"),
        (format!("base = \"hertz\"\n{}", axis.replace("[0.1]", "[]")), "a list of one value or more"),
        (format!("base = \"hertz\"\n{}linspace = [0, 1, 2]\n", axis), "must have one of values"),
        (format!("base = \"hertz\"\n{axis}{axis}"), "friction.coefficient is given twice"),
        (format!("base = \"hertz\"\ndesign = \"gird\"\n{axis}"), "unknown value gird; did you mean grid?"),
        (format!("base = \"hertz\"\n{}", axis.replace("key", "kye")), "unknown key kye; did you mean key?"),
        ("base = \"hertz\"\n[[axis]]\nvalues = [1]\n".into(), "key is missing"),
        (format!("base = \"hertz\"\n{axis}scale = \"lgo\"\n"), "unknown value lgo; did you mean log?"),
        (format!("base = \"hertz\"\nseed = -1\n{axis}"), "a whole number from 0 to 4294967295"),
        (format!("base = \"hertz\"\ndesign = \"sobol\"\n{axis}"), "samples is missing"),
        (format!("base = \"hertz\"\nsamples = 3\n{axis}"), "go with design"),
        (format!("base = \"hertz\"\nset = {{ \"numerics.pionts\" = 3 }}\n{axis}"), "did you mean numerics.points?"),
        (format!("base = \"hertz\"\nstop = {{ volume = -1 }}\n{axis}"), "stop.volume = -1: must be a number"),
        ("base = \"hertz\"\n[[axis]]\nkey = \"friction.coefficient\"\nlogspace = [0, 1, 3]".into(), "greater than 0"),
        ("base = \"hertz\"\n[[axis]]\nkey = \"friction.coefficient\"\nlinspace = [0, 1]".into(), "[from, to, number]"),
        ("base = \"hertz\"\n[[axis]]\nkey = \"friction.coefficient\"\nlinspace = [0, 1, 100000000]".into(), "from 1 to 10000000"),
        ("base = \n".into(), "line 1"),
    ];
    let dir = TestDir::new();
    for (study, word) in studies {
        dir.write("study.toml", study.as_bytes());
        dir.refuse_line("sweep study.toml", word);
    }
}

#[test]
fn the_job_script_has_what_a_centre_asks_for() {
    let dir = dir_with(STUDY);
    let line = "sweep study.toml --shards 4 --slurm";
    has(
        &dir.done(line),
        "\n#SBATCH --time=01:00:00\n#SBATCH --signal",
    );
    let script = dir.done(&format!(
        "{line} --account a1 --partition long,short --time 2-12:00 --mem 2G --module gcc/13 --module x"
    ));
    for word in [
        "#SBATCH --time=2-12:00\n#SBATCH --account=a1\n#SBATCH --partition=long,short\n#SBATCH --mem=2G\n",
        "\nmodule load gcc/13\nmodule load x\nprogram= signals=0\n",
    ] {
        has(&script, word);
    }
    for word in ["a b", "a\nb", "$(x)", ""] {
        let line = ["sweep", "study.toml", "--shards", "4", "--slurm"];
        dir.refuse(
            &[&line[..], &["--account", word]].concat(),
            "without blanks",
        );
    }
}

#[test]
fn the_job_script_is_a_script() {
    let dir = dir_with(STUDY);
    let script = dir.done("sweep study.toml --shards 16 --slurm --set friction.coefficient=0.2");
    for word in [
        "#SBATCH --array=0-15\n",
        "#SBATCH --signal=B:TERM@60\n",
        "#SBATCH --requeue\n",
        "#SBATCH --open-mode=append\n",
        "mdr-tui sweep study.toml --shards 16 --resume --out study.shards/shard-\"$SLURM_ARRAY_TASK_ID\".csv",
        " --set 'friction.coefficient=0.2'",
        "[ \"$status\" = 75 ] && [ \"${SLURM_RESTART_COUNT:-0}\" -lt 100 ]",
    ] {
        has(&script, word);
    }
    dir.write("job.sh", script.as_bytes());
    // The task of an array, with stand-ins for what Slurm provides: interrupted, it asks for its
    // next turn; with its next turn it ends well.
    dir.write("scontrol", b"#!/bin/sh\necho \"$@\" >> requeued\n");
    dir.write(
        "mdr-tui",
        b"#!/bin/sh\n[ -e ready ] && exec \"$BIN\" \"$@\"\ntouch ready\nexit 75\n",
    );
    let task = |code: i32| {
        let slurm = "PATH=.:$PATH SLURM_ARRAY_TASK_ID=2 SLURM_JOB_ID=77";
        let said = dir.shell(&format!(
            "chmod +x scontrol mdr-tui; {slurm} exec bash job.sh"
        ));
        assert_eq!(said.code, code, "{}", said.err);
    };
    task(75);
    assert_eq!(dir.read("requeued"), "requeue 77\n");
    task(0);
    assert_eq!(dir.read("requeued"), "requeue 77\n");
    has(&dir.read("study.shards/shard-2.csv"), "# shard: 2/16\n");
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
    hold("sweep", include_str!("sweep.txt"), study);
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out map.csv");
    // The lowest depth is the lowest row, which ends by sliding.
    let lines = screen(&dir, "map.csv", "<Tab><Tab>");
    let lowest = lines
        .iter()
        .rfind(|line| line.contains('~'))
        .expect("a row of the map");
    assert_eq!(
        lowest.chars().rfind(|sign| "s~#".contains(*sign)),
        Some('#'),
        "{lines:?}"
    );
    // The cursor: two to the right, three up; the point is that of the row.
    let lines = screen(&dir, "map.csv", "ll<Up>kk");
    let is_read = |line: &&String| line.starts_with("worn volume V ") && line.contains("regime");
    let read = lines.iter().rfind(is_read).expect("readings");
    has(read, " µm³  ");
    let shown: f64 = read
        .split_whitespace()
        .nth(3)
        .expect("V")
        .parse()
        .expect("V");
    let volume = dir.table("map.csv").column("wear_volume_m3")[11];
    near("V", 1e-18 * shown, volume, 1e-3);
    // The axes change places, and the last tick is there, too.
    assert!(
        screen(&dir, "map.csv", "x")
            .iter()
            .any(|line| line.ends_with(" 2.00"))
    );
}

#[test]
fn the_map_shows_a_study_that_is_under_way() {
    let dir = dir_with(STUDY);
    dir.done("sweep study.toml --out map.csv");
    let whole = dir.read("map.csv");
    let lines: Vec<&str> = whole.split_inclusive('\n').collect();
    let some = lines[..lines.len() - 7].concat() + "2e-6,1e-";
    dir.write("some.csv", some.as_bytes());
    let lines = screen(&dir, "some.csv", "llkkk");
    assert!(lines[0].ends_with("5 of 12 points"), "{}", lines[0]);
    assert!(
        lines.iter().any(|line| line == "not there yet"),
        "{lines:?}"
    );
}

#[test]
fn one_axis_is_a_curve() {
    let study = "base = \"hertz\"\ncolumns = [\"F_z_N\"]\nset.run.cycles = 0\n\
        [[axis]]\nkey = \"motion.normal.mean\"\nlinspace = [1e-7, 1e-6, 10]\n";
    let dir = dir_with(study);
    dir.done("sweep study.toml");
    let lines = screen(&dir, "study.csv", "<Right><Right>");
    let text = lines.join("\n");
    has(&text, "point 2: mean depth d 300.0 nm");
    has(&lines[2], "[N]");
    has(&text, "mean depth d [µm]");
}

/// The border between partial and gross slip on a line of amplitudes: halfway between the last point
/// of partial slip and the first one of gross slip.
/// `rig` is μNC over the amplitude at the border of a stiff rig, and N (N) the load.
fn border_of(indenter: &str, (rig, load): (f64, f64)) -> f64 {
    // U_t = d/κ = d μE*/G*, and (1 + ρ) times as much on a compliant rig.
    let stiff = 1e-6 * 0.1 * 1.7 / 1.4;
    let closed = stiff * (1.0 + rig);
    let rig = if rig > 0.0 {
        format!(
            "\"motion.tangential.rig_stiffness\" = {:e}\n",
            0.1 * load / (rig * stiff)
        )
    } else {
        String::new()
    };
    let study = format!(
        "base = \"li2019-fig3\"\ncolumns = [\"regime\"]\n[set]\n{indenter}\n{rig}\
         \"motion.normal.amplitude\" = 0.0\n\"wear.coefficient\" = 0.0\n\"run.cycles\" = 2.0\n\
         \"numerics.points\" = 200\n\"numerics.steps_per_cycle\" = 40\n[[axis]]\n\
         key = \"motion.tangential.amplitude\"\nlinspace = [{:e}, {:e}, 21]\n",
        0.9 * closed,
        1.1 * closed
    );
    let dir = dir_with(&study);
    dir.done("sweep study.toml");
    let table = dir.table("study.csv");
    let amplitudes = table.column("motion.tangential.amplitude");
    let regimes: Vec<&str> = table.rows.iter().map(|row| row[1].as_str()).collect();
    let gross = regimes
        .iter()
        .position(|regime| *regime == "gross")
        .expect("gross slip");
    let (before, after) = regimes.split_at(gross);
    assert!(
        gross > 0 && before.iter().all(|regime| *regime == "partial"),
        "{regimes:?}"
    );
    assert!(after.iter().all(|regime| *regime == "gross"), "{regimes:?}");
    0.5 * (amplitudes[gross - 1] + amplitudes[gross]) / closed
}

#[test]
fn the_map_finds_the_border_of_gross_slip() {
    // Loads at d = 1 µm: 2n/(n+1) E* d a, with a of g(a) = d.
    let load = |n: f64, radius: f64| 2.0 * n / (n + 1.0) * 2.3077e11 * 1e-6 * radius;
    let cone = 2.0 / std::f64::consts::PI * 1e-6 / 0.02_f64.tan();
    let quartic = (1e-6_f64 * 3.0 / 8.0 / 3.75e9).powf(0.25);
    for (indenter, load) in [
        ("\"indenter.shape\" = \"paraboloid\"", load(2.0, 1e-4)),
        (
            "\"indenter.shape\" = \"cone\"\n\"indenter.angle\" = 0.02",
            load(1.0, cone),
        ),
        (
            "\"indenter.shape\" = \"power\"\n\"indenter.exponent\" = 4.0\n\"indenter.coefficient\" = 3.75e9",
            load(4.0, quartic),
        ),
    ] {
        for rig in [0.0, 1.0, 3.0] {
            let found = border_of(indenter, (rig, load));
            assert!(
                (found - 1.0).abs() < 0.01,
                "{indenter}, rig {rig}: {found} of the closed form"
            );
        }
    }
}

#[test]
fn sensitivities_are_those_of_the_closed_forms() {
    // Hertz: F = 4/3 E* √R d^1.5, a = √(R d).
    let study = "base = \"hertz\"\ncolumns = [\"F_z_N\", \"contact_radius_m\", \"wear_volume_m3\"]\n\
        [set]\n\"run.cycles\" = 0.0\n\"motion.normal.amplitude\" = 0.0\n[sensitivity]\n\"indenter.radius\" = 1e-3\n\
        \"motion.normal.mean\" = 0\n\"material.effective_modulus\" = 2.3077e10\n";
    let dir = dir_with(study);
    let json = dir.done("sweep study.toml --sensitivity --json");
    let rows: Vec<serde_json::Value> = serde_json::from_str(&json).expect("JSON");
    let find = |key: &str, column: &str| {
        let found = rows
            .iter()
            .find(|row| row["key"] == key && row["column"] == column);
        found.unwrap_or_else(|| panic!("{key} {column}: {json}"))
    };
    for (key, force, radius) in [
        ("indenter.radius", 0.5, 0.5),
        ("motion.normal.mean", 1.5, 0.5),
        ("material.effective_modulus", 1.0, 0.0),
    ] {
        for (column, expected) in [("F_z_N", force), ("contact_radius_m", radius)] {
            let row = find(key, column);
            let (found, error) = (row["elasticity"].as_f64(), row["error"].as_f64());
            let (found, error) = (found.expect("a number"), error.expect("a number"));
            assert!((found - expected).abs() < 2e-3, "{key} {column}: {found}");
            assert!(error < 0.01, "{key} {column}: {error}");
        }
        // Nothing wears: there is nothing to take a logarithm of.
        assert!(find(key, "wear_volume_m3")["elasticity"].is_null());
    }
    // 10 % of R and of E*: √((0.5·0.1)² + (1·0.1)²).
    let spread = find("all", "F_z_N")["relative_spread"]
        .as_f64()
        .expect("a spread");
    assert!((spread - 0.05f64.hypot(0.1)).abs() < 1e-3, "{spread}");
    let text = dir.done("sweep study.toml --sensitivity --out s.csv");
    has(&text, "elasticity");
    has(&dir.read("s.csv"), "\nindenter.radius,");
    dir.refuse_line("sweep study.toml", "the study has no axis");
    dir.write(
        "none.toml",
        study
            .replace("indenter.radius", "motion.normal.phase")
            .as_bytes(),
    );
    let rule = "motion.normal.phase: must be a number greater than 0";
    dir.refuse_line("sweep none.toml --sensitivity", rule);
}

#[test]
fn the_studies_of_the_guide_are_studies() {
    let text = mdr_tui::guide::Topic::find("studies")
        .expect("the topic")
        .text;
    let blocks = text.split("```toml study\n").skip(1);
    let blocks: Vec<&str> = blocks.filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(blocks.len(), 2);
    let dir = TestDir::new();
    let few = "--set numerics.points=12 --set numerics.steps_per_cycle=12 --set run.cycles=1";
    for block in blocks {
        dir.write("study.toml", block.as_bytes());
        let line = match block.contains("[[axis]]") {
            true => "sweep study.toml --point 0".to_owned(),
            false => format!("sweep study.toml --sensitivity --quiet {few}"),
        };
        dir.line(&line).ends(0, "");
    }
}

/// By its own command: `tests/slurm/run.sh PROGRAM`.
#[cfg(target_os = "linux")]
#[test]
fn a_slurm_array_gives_the_rows_of_a_local_run() {
    let there = |program: &str| {
        ["/usr/bin", "/usr/sbin"]
            .iter()
            .any(|place| std::path::Path::new(place).join(program).exists())
    };
    let id = std::process::Command::new("id").arg("-u").output();
    let is_root = id.is_ok_and(|id| id.stdout == b"0\n");
    if !is_root
        || !["sbatch", "slurmctld", "slurmd", "munged", "python3"]
            .iter()
            .all(|p| there(p))
    {
        eprintln!("skipped: Slurm is not installed, or this is not root");
        return;
    }
    let dir = TestDir::new();
    let output = std::process::Command::new("bash")
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/slurm/run.sh"))
        .arg(env!("CARGO_BIN_EXE_mdr-tui"))
        .arg(dir.path("cluster"))
        .output()
        .expect("a shell");
    let said = String::from_utf8_lossy(&output.stdout);
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}{err}");
    has(&said, "1000 points, the same bytes as the local run");
}
