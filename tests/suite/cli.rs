//! The command line as a user types it: what is refused and how, and what `run` writes.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

use mdr_tui::export::history;
use mdr_tui::reading::Curves;
use mdr_tui::scenario::preset;

use crate::common::{load, near, ran};
use crate::test_dir::{Said, Table, TestDir, bits, cases, end, has, names};

#[test]
fn a_bad_scenario_is_a_line_an_error_and_nothing_written() {
    let dir = TestDir::new();
    dir.write("unknown.toml", b"[indenter]\nradious = 0.01\n");
    dir.write("type.toml", b"[indenter]\nradius = \"big\"\n");
    dir.write("syntax.toml", b"title = \n");
    dir.write("empty.toml", b"");
    dir.write("binary.toml", &[0xff, 0xfe, 0x00, 0x80]);
    fs::create_dir(dir.path("folder.toml")).expect("a directory");
    for (scenario, expected) in [
        ("missing.toml", "missing.toml: no such file"),
        ("folder.toml", "folder.toml: is a directory"),
        ("./", "is a directory"),
        ("unknown.toml", "did you mean indenter.radius?"),
        ("type.toml", "indenter.radius = \"big\": must be"),
        ("syntax.toml", "syntax.toml: line 1"),
        ("empty.toml", "indenter.shape is missing"),
        ("binary.toml", "not UTF-8"),
        ("mindlyn", "did you mean mindlin?"),
        ("a\u{1b}[31mb\n.toml", "a\\u{1b}[31mb\\n.toml: no such file"),
    ] {
        dir.refuse(
            &["run", scenario, "--cycles", "0.1", "--out", "new"],
            expected,
        );
        dir.refuse(&[scenario, "--print", "80x24"], expected);
        dir.refuse(&[scenario], expected);
    }
}

#[test]
fn what_is_wrong_is_refused_in_one_line() {
    for section in include_str!("refusals.txt").split("\n== ").skip(1) {
        let dir = TestDir::new();
        let mut before = "";
        let mut lines = section.lines().skip(1).filter(|line| !line.is_empty());
        while let Some(line) = lines.next() {
            if let Some(name) = line.strip_prefix("> ") {
                let text: Vec<&str> = lines.by_ref().take_while(|line| *line != "<").collect();
                fs::create_dir_all(dir.path(name).parent().expect("a place")).expect("a directory");
                dir.write(name, (text.join("\n") + "\n").as_bytes());
            } else if let Some(line) = line.strip_prefix("$ ") {
                dir.done(line);
            } else if let Some(words) = line.strip_prefix("@ ") {
                before = words;
            } else {
                let (arguments, text) = line.split_once(" | ").expect(line);
                dir.refuse_line(&format!("{before} {arguments}"), text);
            }
        }
    }
}

/// What would do something to a terminal is escaped.
#[test]
fn rude_arguments_are_told_without_harm() {
    let dir = TestDir::new();
    for (arguments, expected) in [
        (
            &["presets", "no\u{1b}[31mpe"][..],
            "presets no\\u{1b}[31mpe: no such",
        ),
        (&["--keys", "m\u{1b}", "--print", "80x24"], "is not a key"),
        (
            &["run", "cone", "--set", "ra\u{1b}[2J\u{7}dius=1"],
            "ra\\u{1b}[2J\\u{7}dius",
        ),
        (
            &["run", "cone", "--set", "a\u{1b}[2J=1\n2"],
            "--set a\\u{1b}[2J=1\\n2: unknown key",
        ),
        (
            &["run", "cone", "--set", "wear.coefficient_per_load=1 mm"],
            "a unit compatible with m^3/(N*m)",
        ),
    ] {
        dir.refuse(arguments, expected);
    }
}

#[test]
fn an_unwritable_out_is_one_line_and_nothing_written() {
    let dir = TestDir::new();
    dir.write("file", b"in the way");
    fs::create_dir(dir.path("full")).expect("a directory");
    dir.write("full/notes.txt", b"mine");
    for (out, expected) in cases([
        "file => file: is not a directory",
        "file/below => file/below: cannot write: Not a directory",
        "full => full: not empty; choose another",
        "file/\u{1b}[31m\n => file/\\u{1b}[31m\\n: cannot write: Not a directory",
        " => --out <DIR>",
    ]) {
        dir.refuse(&["run", "hertz", "--cycles", "0.1", "--out", out], expected);
    }
    if cfg!(target_os = "linux") {
        dir.refuse_line("run hertz --out /proc/mdr-tui", "cannot write");
    }
}

#[test]
fn run_writes_the_files_of_the_contract() {
    let dir = TestDir::new();
    let summary = dir.done("run li2019-fig3 --cycles 3.25 --snapshot-at 1.50,2 --out x");
    assert!(summary.starts_with("Dual oscillation of a paraboloid: 3.25 cycles\n"));
    assert_eq!(
        names(&dir.path("x")),
        [
            "history.csv",
            "loop.csv",
            "scenario.toml",
            "state-1.50.csv",
            "state-2.csv",
            "state.csv"
        ]
    );
    for (name, cycle) in [
        ("state-1.50.csv", "1.5"),
        ("state-2.csv", "2"),
        ("state.csv", "3.25"),
    ] {
        let table = dir.table(&format!("x/{name}"));
        assert_eq!(
            table.columns.join(", "),
            "r_m, f0_m, f_m, g_m, u_z_1d_m, q_z_N_per_m, q_x_N_per_m, p_Pa, tau_Pa, u_x_1d_m, u_x_m, wear_m, zone"
        );
        assert_eq!(table.header[0].0, "mdr-tui");
        assert_eq!(table.header("mdr-tui"), env!("CARGO_PKG_VERSION"));
        assert_eq!(table.header("scenario"), "Dual oscillation of a paraboloid");
        assert_eq!(table.header("cycle"), cycle);
        assert_eq!(table.header("method"), "product");
        assert_eq!(table.header("law"), "archard");
        assert_eq!(table.header("points"), "100");
        assert_eq!(table.header("steps_per_cycle"), "100");
        assert_eq!(table.rows.len(), 101);
        let zones: Vec<&str> = table.rows.iter().map(|row| row[12].as_str()).collect();
        let mut seen = zones.clone();
        seen.dedup();
        assert_eq!(seen, ["stick", "slip", "open"]);
    }
    let table = dir.table("x/history.csv");
    assert_eq!(
        table.columns.join(", "),
        "cycle, time_s, u_z_m, u_x_m, F_z_N, F_x_N, contact_radius_m, stick_radius_m, permanent_stick_radius_m, wear_volume_m3, dissipated_energy_J, energy_residual, max_pressure_Pa, period_energy_residual, force_residual, steps, transforms, evaluated_cycles, rejected_jumps, stability_margin, parts, energy_per_cycle_J, force_ratio, slip_ratio, sliding_ratio, energy_ratio, energy_ratio_B, regime, wear_per_energy_m3_per_J, rig_displacement_m, scar_depth_m, scar_radius_m"
    );
    assert_eq!(table.columns, history::COLUMNS);
    assert_eq!(table.column("cycle"), [0.0, 1.0, 2.0, 3.0, 3.25]);
    // k in the units of the field: 1/Pa = m³/J = 1e9 mm³/(N·m) = 1e18 µm³/J.
    let k = |unit: &str| -> f64 {
        let value = table.header(&format!("wear_coefficient_{unit}"));
        value.parse().expect("a number")
    };
    assert_eq!(k("per_Pa"), 1.3e-10);
    near("k", k("mm3_per_Nm"), 0.13, 1e-12);
    near("k", k("um3_per_J"), 1.3e8, 1e-12);
    let regimes: Vec<&str> = table.rows.iter().map(|row| row[27].as_str()).collect();
    assert_eq!(regimes, ["", "partial", "partial", "partial", "partial"]);
}

#[test]
fn the_numbers_of_the_files_read_back_exactly() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 2 --out x");
    let session = ran(load("li2019-fig3", &[]), 2.0);
    let seen = session.simulation().observe(Curves::all());
    let table = dir.table("x/state.csv");
    for (name, values) in [
        ("r_m", &seen.radii[..]),
        ("f0_m", &seen.unworn[..]),
        ("f_m", &seen.profile[..]),
        ("g_m", &seen.profile_1d[..]),
        ("q_z_N_per_m", &seen.normal_load[..]),
        ("q_x_N_per_m", &seen.tangential_load[..]),
        ("p_Pa", &seen.pressure[..]),
        ("tau_Pa", &seen.shear[..]),
        ("u_x_1d_m", &seen.spring[..]),
        ("u_x_m", &seen.surface[..]),
        ("wear_m", &seen.wear[..]),
    ] {
        assert_eq!(bits(&table.column(name)), bits(values), "{name}");
    }
    let moment = session.simulation().moment();
    let table = dir.table("x/history.csv");
    for (name, value) in [
        ("time_s", moment.time),
        ("F_z_N", moment.normal_force),
        ("F_x_N", moment.tangential_force),
        ("contact_radius_m", moment.contact_radius),
        ("wear_volume_m3", moment.wear_volume),
        ("dissipated_energy_J", moment.dissipated_energy),
    ] {
        let last = table.column(name).last().copied().expect("a row");
        assert_eq!(last.to_bits(), value.to_bits(), "{name}");
    }
}

#[test]
fn scenario_toml_gives_the_same_numbers_to_the_last_bit() {
    let dir = TestDir::new();
    for (i, line) in [
        "run li2019-fig3 --cycles 150.24 --snapshot-at 50.72,100",
        "run two-frequencies --cycles 3.3 --set numerics.points=57 --set numerics.method=b",
        "run li2019-fig3 --cycles 2 --set wear.coefficient=1.7e-10 --set friction.coefficient=0.3",
        "run power-law --cycles 2",
        "run li2019-fig3 --cycles 20.5 --snapshot-at 3.3 --set numerics.method=a --set numerics.scheme=euler",
        r#"run cone --cycles 1.111 --set title="a\"cone\"\n=#1""#,
    ]
    .into_iter()
    .enumerate()
    {
        let (first, second) = (format!("first-{i}"), format!("second-{i}"));
        dir.done(&format!("{line} --out {first} --quiet"));
        dir.done(&format!("run {first}/scenario.toml --out {second} --quiet"));
        assert_eq!(names(&dir.path(&first)), names(&dir.path(&second)));
        for name in names(&dir.path(&first)) {
            let read = |directory: &str| dir.read(&format!("{directory}/{name}"));
            assert!(read(&first) == read(&second), "{first}: {name} differs");
        }
    }
}

#[test]
fn looking_between_two_steps_does_not_change_the_run() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 3 --out plain --quiet");
    let moments = "1.2345,0.0001,2.999,3,0";
    dir.done(&format!(
        "run li2019-fig3 --cycles 3 --out looking --quiet --snapshot-at {moments}"
    ));
    for name in ["state.csv", "history.csv"] {
        let (plain, looking) = (format!("plain/{name}"), format!("looking/{name}"));
        assert!(dir.read(&plain) == dir.read(&looking), "{name} differs");
    }
    dir.done("run li2019-fig3 --cycles 1.2345 --out ending --quiet");
    assert!(dir.read("looking/state-1.2345.csv") == dir.read("ending/state.csv"));
    assert!(dir.read("looking/state-3.csv") == dir.read("plain/state.csv"));
    let start = dir.table("looking/state-0.csv");
    assert!(start.column("wear_m").iter().all(|&wear| wear == 0.0));
}

#[test]
fn the_history_of_every_step_has_a_row_more_than_steps() {
    let dir = TestDir::new();
    for (out, cycles, rows) in [("whole", "2", 201), ("part", "1.2345", 125)] {
        dir.done(&format!(
            "run hertz --cycles {cycles} --history every-step --out {out} --quiet --set numerics.scheme=euler"
        ));
        let table = dir.table(&format!("{out}/history.csv"));
        let moments = table.column("cycle");
        assert_eq!(moments.len(), rows);
        assert!(moments.is_sorted_by(|a, b| a < b));
        assert_eq!(moments.last(), cycles.parse().ok().as_ref());
        // Without tangential motion there is no stick radius to write.
        assert!(table.column("stick_radius_m").iter().all(|c| c.is_nan()));
    }
}

#[test]
fn the_trapezoid_has_the_regular_steps_and_a_few_at_turning_points() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 3 --history every-step --out x --quiet");
    let moments = dir.table("x/history.csv").column("cycle");
    assert_eq!((moments.first(), moments.last()), (Some(&0.0), Some(&3.0)));
    assert!(moments.is_sorted_by(|a, b| a < b));
    let step = 0.01;
    let is_regular = |moment: f64| (moment / step - (moment / step).round()).abs() < 1e-9;
    let added = moments
        .iter()
        .filter(|&&moment| !is_regular(moment))
        .count();
    assert!((3..=30).contains(&added), "{added} steps added in 3 cycles");
    // No step is longer than a regular one and a tenth, and no whole cycle is left out.
    for pair in moments.windows(2) {
        assert!(pair[1] - pair[0] < 1.1 * step + 1e-9, "{pair:?}");
    }
    for whole in [1.0, 2.0, 3.0] {
        assert!(moments.contains(&whole), "no step ends at cycle {whole}");
    }
    // Where a regular moment is missing, a turning point stands within a tenth of a step of it.
    for regular in (0..=300).map(|i| f64::from(i) * step) {
        let distance = |moment: &f64| (moment - regular).abs();
        let nearest = moments.iter().map(distance).fold(f64::INFINITY, f64::min);
        assert!(nearest < 0.1 * step + 1e-9, "{regular}");
    }
}

#[test]
fn json_parses_and_quiet_is_quiet() {
    let dir = TestDir::new();
    let summary = dir.done("run mindlin --out a --json");
    let summary: serde_json::Value = serde_json::from_str(&summary).expect("a JSON value");
    assert_eq!(summary["directory"], "a");
    assert_eq!(summary["cycle"].as_f64(), load("mindlin", &[]).run().cycles);
    // The names and the values of the files.
    let history = dir.table("a/history.csv");
    for name in &history.columns {
        let value = &summary[name.as_str()];
        if name == "regime" {
            assert_eq!(
                value.as_str().unwrap_or_default(),
                history.rows[history.rows.len() - 1][27]
            );
            continue;
        }
        let last = history.column(name).pop().expect("a row");
        assert_eq!(
            value.as_f64().map_or(f64::NAN, f64::abs).to_bits(),
            last.abs().to_bits(),
            "{name}"
        );
    }
    assert_eq!(summary["checks"], "ok");
    assert_eq!(summary["method"], history.header("method"));
    assert_eq!(dir.done("run mindlin --out b --quiet"), "");
    let quiet =
        dir.done("run li2019-fig3 --cycles 3 --set numerics.accuracy=1e-1 --out c --quiet --json");
    let summary: serde_json::Value = serde_json::from_str(&quiet).expect("a JSON value");
    let error: f64 = dir
        .table("c/state.csv")
        .header("estimated_error")
        .parse()
        .expect("a number");
    assert_eq!(summary["estimated_error"].as_f64(), Some(error));
    let list: serde_json::Value =
        serde_json::from_str(&dir.done("presets --json")).expect("a JSON value");
    assert_eq!(list.as_array().map(Vec::len), Some(preset::ALL.len()));
}

#[test]
fn force_writes_over_the_files_of_another_run() {
    let dir = TestDir::new();
    dir.done("run hertz --cycles 1 --out x --quiet --force");
    dir.write("x/notes.txt", b"mine");
    dir.refuse_line("run cone --out x", "--force");
    dir.done("run cone --cycles 1 --out x --quiet --force");
    let table = dir.table("x/state.csv");
    assert_eq!(table.header("scenario"), "Dual oscillation of a cone");
    assert_eq!(dir.read("x/notes.txt"), "mine");
}

#[test]
fn without_out_a_run_takes_a_new_directory_each_time() {
    let dir = TestDir::new();
    for _ in 0..2 {
        dir.done("run hertz --cycles 0.1 --quiet");
    }
    assert_eq!(names(&dir.path("")), ["hertz-run", "hertz-run-2"]);
}

#[test]
fn a_run_that_breaks_down_keeps_the_last_good_cycle() {
    let dir = TestDir::new();
    let line = "run li2019-fig3 --cycles 50 --set numerics.method=benad --set wear.coefficient=1e-7 --out x";
    let said = dir.line(line);
    said.fails(1, "");
    assert_eq!(said.out, "");
    let after = said
        .err
        .split_once("stopped after ")
        .and_then(|(_, rest)| rest.split_once(" cycles: "));
    let (cycle, cause) = after.expect("the cycle and the cause");
    assert!(cause.len() > 20 && cause.contains("numerics."), "{cause}");
    assert_eq!(
        names(&dir.path("x")),
        ["history.csv", "scenario.toml", "state.csv"]
    );
    let state = dir.table("x/state.csv");
    assert_eq!(state.header("cycle"), cycle);
    let cycle: f64 = cycle.parse().expect("a number");
    assert!(0.0 < cycle && cycle < 50.0);
    assert!(state.column("f_m").iter().all(|f| f.is_finite()));
    let history = dir.table("x/history.csv");
    assert_eq!(history.column("cycle").last(), Some(&cycle));
    // What was kept is a run of its own, which ends well, in every column of both files.
    assert_replays(&dir, "x", "again");
}

/// The kept run in `first` runs again into `second` without a complaint, bit for bit.
fn assert_replays(dir: &TestDir, first: &str, second: &str) {
    dir.done(&format!("run {first}/scenario.toml --out {second} --quiet"));
    for name in ["state.csv", "history.csv"] {
        let text = [first, second].map(|directory| dir.read(&format!("{directory}/{name}")));
        let [kept, again] = text.each_ref().map(|text| Table::parse(text));
        assert_eq!(kept.columns, again.columns, "{name}");
        let differing: Vec<&String> = (0..kept.columns.len())
            .filter(|&i| {
                let column = |table: &Table| -> Vec<String> {
                    table.rows.iter().map(|row| row[i].clone()).collect()
                };
                column(&kept) != column(&again)
            })
            .map(|i| &kept.columns[i])
            .collect();
        assert!(differing.is_empty(), "{first}/{name}: {differing:?} differ");
        assert!(text[0] == text[1], "{first}/{name}: the headers differ");
    }
}

/// Every method, unguarded, with a wear coefficient that is far too large; returns how many broke down.
fn broken_down(scheme: &str) -> i32 {
    let dir = TestDir::new();
    let mut breakdowns = 0;
    for method in ["product", "a", "a+b", "b", "benad"] {
        for wear in ["1e-7", "1e-6"] {
            let out = format!("{method}-{wear}");
            let line = format!(
                "run li2019-fig3 --cycles 3.3 --set wear.coefficient={wear} --out {out} --quiet \
                 --set numerics.method={method} --set numerics.scheme={scheme} \
                 --set numerics.stability=off"
            );
            let said = dir.line(&line);
            assert!([0, 1].contains(&said.code), "{out}: {}", said.err);
            breakdowns += said.code;
            assert_replays(&dir, &out, &format!("{out}-again"));
        }
    }
    breakdowns
}

#[test]
fn a_breakdown_of_the_euler_scheme_replays_to_the_last_bit() {
    assert!(broken_down("euler") >= 5);
}

#[test]
fn a_breakdown_of_the_trapezoid_replays_to_the_last_bit() {
    assert!(broken_down("trapezoid") >= 2);
}

#[test]
fn presets_are_listed_and_printed_as_they_stand() {
    let dir = TestDir::new();
    let list = dir.done("presets");
    assert_eq!(list.lines().count(), preset::ALL.len());
    for (line, preset) in list.lines().zip(preset::ALL) {
        assert!(line.starts_with(preset.name) && line.ends_with(&preset.title()));
        assert!(line.chars().count() <= 80, "{line}");
        let file = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("presets")
            .join(format!("{}.toml", preset.name));
        let printed = dir.done(&format!("presets {}", preset.name));
        assert_eq!(
            printed,
            fs::read_to_string(file).expect("the preset's file")
        );
    }
    // A preset starts a scenario of one's own.
    dir.write("mine.toml", dir.done("presets cone").as_bytes());
    for (scenario, out) in [("cone", "theirs"), ("mine.toml", "mine")] {
        dir.done(&format!("run {scenario} --cycles 1 --out {out} --quiet"));
    }
    assert!(dir.read("theirs/state.csv") == dir.read("mine/state.csv"));
}

#[test]
fn stability_draws_a_map_and_writes_its_runs() {
    let dir = TestDir::new();
    let line = "stability li2019-fig3 --cycles 3 --points 25 --methods a --wear-numbers 1000,1 --steps 50 \
                --guard both --csv map.csv";
    let said = dir.line(line);
    assert_eq!(said.code, 0, "{}", said.err);
    for map in [
        "a, guard off\n    25 ....|. ######\n",
        "a, guard on\n    25 ....|. ......\n",
    ] {
        has(&said.out, map);
    }
    has(&said.out, "critical K");
    let rows = dir.read("map.csv");
    let rows: Vec<&str> = rows.lines().filter(|line| !line.starts_with('#')).collect();
    assert_eq!(rows.len(), 5, "{rows:?}");
    assert!(
        rows[1].starts_with("a,off,25,50,1e0,stable,"),
        "{}",
        rows[1]
    );
    assert!(rows[4].starts_with("a,on,25,50,1e3,stable,"), "{}", rows[4]);
    dir.refuse_line(line, "already exists");
}

/// What the program answers a shell that asks for the last of `words`.
fn completed(dir: &TestDir, words: &[&str]) -> Vec<String> {
    let output = dir
        .command(&["--"])
        .args(words)
        .env("MDR_TUI_COMPLETE", "bash")
        .env("_CLAP_COMPLETE_INDEX", (words.len() - 1).to_string())
        .output()
        .expect("the program starts");
    let text = String::from_utf8(output.stdout).expect("text");
    text.lines().map(str::to_owned).collect()
}

#[test]
fn shells_complete_presets_files_keys_and_words() {
    let dir = TestDir::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = dir.done(&format!("completions {shell}"));
        assert!(script.contains("MDR_TUI_COMPLETE"), "{shell}: {script}");
    }
    std::fs::write(dir.path("mine.toml"), "").expect("a file");
    std::fs::write(dir.path("mine.csv"), "").expect("a file");
    for (words, wanted) in [
        (&["mdr-tui", "run", "li2"][..], "li2019-fig3"),
        (&["mdr-tui", "min"], "mine.toml"),
        (&["mdr-tui", "presets", "tw"], "two-frequencies"),
        (&["mdr-tui", "guide", "gl"], "glossary"),
        (
            &["mdr-tui", "run", "cone", "--set", "friction"],
            "friction.coefficient=",
        ),
        (
            &["mdr-tui", "run", "cone", "--set", "numerics.method=be"],
            "numerics.method=benad",
        ),
        (&["mdr-tui", "run", "cone", "--snap"], "--snapshot-at"),
    ] {
        let found = completed(&dir, words);
        assert!(
            found.iter().any(|word| word == wanted),
            "{words:?}: {found:?}"
        );
        assert!(!found.iter().any(|word| word == "mine.csv"), "{found:?}");
    }
}

#[test]
fn every_command_has_a_man_page_with_its_options_and_their_values() {
    let dir = TestDir::new();
    let page = dir.done("man");
    has(&page, ".TH mdr-tui 1");
    for command in ["run", "presets", "verify", "trade", "completions", "man"] {
        let title = format!(".TH mdr-tui-{command} 1");
        assert_eq!(page.matches(&title).count(), 1, "{command}");
    }
    has(&page, "\\-\\-keys");
    dir.done("man --out pages");
    let section = |name: &str, title: &str| -> String {
        let page = dir.read(&format!("pages/{name}.1"));
        let (_, after) = page.split_once(&format!(".SH {title}\n")).expect(title);
        let (lines, _) = after.split_once("\n.SH").expect("an end");
        let mut plain = lines.replace("\\-", "-").replace("\\ ", " ");
        for font in ["\\fB", "\\fI", "\\fR"] {
            plain = plain.replace(font, "");
        }
        plain
    };
    let options = section("mdr-tui-run", "OPTIONS");
    for option in [
        "--cycles <X>\n",
        "--snapshot-at <C1,C2,...>\n",
        "--set <KEY=VALUE>\n",
        "--history <HISTORY>",
        "every-step",
        "--json\n",
    ] {
        has(&options, option);
    }
    assert!(section("mdr-tui-run", "SYNOPSIS").starts_with("mdr-tui run [OPTIONS] <SCENARIO>"));
    has(&section("mdr-tui-figure", "SYNOPSIS"), "-o|--out");
    assert_eq!(dir.read("pages/mdr-tui-fit.1"), dir.done("man fit"));
}

#[test]
fn every_help_has_an_example() {
    let dir = TestDir::new();
    for command in [
        "run",
        "presets",
        "verify",
        "trade",
        "completions",
        "man",
        "",
    ] {
        let help = dir.done(&format!("{command} --help"));
        let (_, examples) = help
            .split_once("Example")
            .unwrap_or_else(|| panic!("{command} --help without an example"));
        has(examples, "\n  mdr-tui");
    }
    let help = dir.done("--help");
    for command in ["run", "presets", "verify", "trade", "completions", "man"] {
        has(&help, &format!("\n  {command} "));
    }
    let version = dir.done("--version");
    assert_eq!(version, format!("mdr-tui {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn a_reader_who_leaves_early_is_no_error() {
    let dir = TestDir::new();
    for arguments in [
        vec!["presets"],
        vec!["presets", "hertz"],
        vec!["man"],
        vec!["completions", "bash"],
        vec!["--help"],
        vec!["--print", "200x50"],
        vec!["run", "hertz", "--cycles", "0.1"],
    ] {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = dir.command(&arguments).stdout(writer).output();
        let said = Said::from(output.expect("the program starts"));
        assert_eq!((said.code, said.err.as_str()), (0, ""), "{arguments:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure_in_one_line() {
    let dir = TestDir::new();
    for arguments in [vec!["presets"], vec!["man"], vec!["--print", "80x24"]] {
        let full = fs::File::create("/dev/full").expect("the full device");
        let output = dir.command(&arguments).stdout(full).output();
        let said = Said::from(output.expect("the program starts"));
        assert_eq!(said.code, 1, "{arguments:?}");
        assert_eq!(said.err.lines().count(), 1, "{}", said.err);
    }
}

#[test]
fn a_scenario_can_come_through_a_pipe() {
    if !cfg!(unix) {
        return;
    }
    let dir = TestDir::new();
    let mut child = dir
        .command(&["run", "/dev/stdin", "--cycles", "1", "--out", "x"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let text = preset::find("hertz").expect("a preset").text;
    let mut stdin = child.stdin.take().expect("a pipe");
    stdin.write_all(text.as_bytes()).expect("a reader");
    drop(stdin);
    let said = end(child);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
}
