//! The command line as a user types it: what is refused and how, and what `run` writes.

use std::fs;
use std::path::Path;

use mdr_tui::reading::Curves;
use mdr_tui::scenario::preset;

#[cfg(target_os = "linux")]
use crate::command_table::hold;
use crate::common::{load, ran};
use crate::test_dir::{TestDir, bits};

#[cfg(target_os = "linux")]
#[test]
fn what_is_wrong_is_refused_in_one_line() {
    hold("refusals.txt", |_| {});
}

#[cfg(target_os = "linux")]
#[test]
fn commands_say_and_write_what_the_table_says() {
    hold("commands.txt", |_| {});
}

#[cfg(target_os = "linux")]
#[test]
fn a_run_that_cannot_go_on_keeps_its_last_good_step_and_says_what_would_help() {
    hold("breakdowns.txt", |_| {});
}

/// Every method, unguarded, with wear coefficients that are far too large: what is kept of a run that breaks down is a run
/// of its own, which ends well, to the last bit.
fn breakdowns_replay(scheme: &str, at_least: i32) {
    let dir = TestDir::new();
    let mut breakdowns = 0;
    for method in ["product", "a", "a+b", "b", "benad"] {
        for wear in ["1e-7", "1e-6"] {
            let out = format!("{method}-{wear}");
            let said = dir.line(&format!(
                "run li2019-fig3 --cycles 3.3 --set wear.coefficient={wear} --out {out} --quiet \
                 --set numerics.method={method} --set numerics.scheme={scheme} --set numerics.stability=off"
            ));
            assert!([0, 1].contains(&said.code), "{out}: {}", said.err);
            breakdowns += said.code;
            dir.replays(&out, "again", "--force");
        }
    }
    assert!(breakdowns >= at_least, "{breakdowns}");
}

#[test]
fn a_breakdown_of_the_euler_scheme_replays_to_the_last_bit() {
    breakdowns_replay("euler", 5);
}

#[test]
fn a_breakdown_of_the_trapezoid_replays_to_the_last_bit() {
    breakdowns_replay("trapezoid", 2);
}

#[test]
fn the_numbers_of_the_files_read_back_exactly() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 2 --out x");
    let session = ran(load("li2019-fig3", &[]), 2.0);
    let seen = session.simulation().observe(Curves::all());
    let table = dir.table("x/state.csv");
    for (name, values) in [
        ("r_m", seen.radii()),
        ("f0_m", seen.unworn()),
        ("f_m", seen.profile()),
        ("g_m", seen.profile_1d()),
        ("q_z_N_per_m", seen.normal_load()),
        ("q_x_N_per_m", seen.tangential_load()),
        ("p_Pa", seen.pressure()),
        ("tau_Pa", seen.shear()),
        ("u_x_1d_m", seen.spring()),
        ("u_x_m", seen.surface()),
        ("wear_m", seen.wear()),
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
fn the_trapezoid_has_the_regular_steps_and_a_few_at_turning_points() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 3 --history every-step --out x --quiet");
    let moments = dir.table("x/history.csv").column("cycle");
    assert_eq!((moments.first(), moments.last()), (Some(&0.0), Some(&3.0)));
    assert!(moments.is_sorted_by(|a, b| a < b));
    let step = 0.01;
    let is_regular = |moment: f64| (moment / step - (moment / step).round()).abs() < 1e-9;
    let added = moments.iter().filter(|&&moment| !is_regular(moment));
    let added = added.count();
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
fn json_has_the_names_and_the_values_of_the_files() {
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
            let last = &history.rows[history.rows.len() - 1][27];
            assert_eq!(value.as_str().unwrap_or_default(), last);
            continue;
        }
        let last = history.column(name).pop().expect("a row");
        let value = value.as_f64().map_or(f64::NAN, f64::abs);
        assert_eq!(value.to_bits(), last.abs().to_bits(), "{name}");
    }
    assert_eq!(summary["checks"], "ok");
    assert_eq!(summary["method"], history.header("method"));
}

#[test]
fn presets_are_listed_and_printed_as_they_stand() {
    let dir = TestDir::new();
    let list = dir.done("presets");
    assert_eq!(list.lines().count(), preset::ALL.len());
    for (line, preset) in list.lines().zip(preset::ALL) {
        assert!(line.starts_with(preset.name) && line.ends_with(&preset.title()));
        assert!(line.chars().count() <= 80, "{line}");
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets");
        let file = fs::read_to_string(folder.join(format!("{}.toml", preset.name)));
        let printed = dir.done(&format!("presets {}", preset.name));
        assert_eq!(printed, file.expect("the preset's file"));
    }
    // A preset starts a scenario of one's own.
    dir.write("mine.toml", dir.done("presets cone").as_bytes());
    for (scenario, out) in [("cone", "theirs"), ("mine.toml", "mine")] {
        dir.done(&format!("run {scenario} --cycles 1 --out {out} --quiet"));
    }
    assert!(dir.read("theirs/state.csv") == dir.read("mine/state.csv"));
}

#[test]
fn the_version_is_that_of_the_crate() {
    let version = TestDir::new().done("--version");
    assert_eq!(version, format!("mdr-tui {}\n", env!("CARGO_PKG_VERSION")));
}

/// What bash puts on the line: names with blanks are quoted, and behind `=` comes the value alone.
#[cfg(target_os = "linux")]
#[test]
fn bash_completes_names_with_blanks_and_values_behind_an_equals_sign() {
    let dir = TestDir::new();
    dir.write("my scenario.toml", b"");
    dir.write("completion", dir.done("completions bash").as_bytes());
    let script = r#"
        mdr-tui() { "$BIN" "$@"; }
        compopt() { :; }
        . ./completion
        complete_words() {
            COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMP_WORDBREAKS=$' \t\n"\'><=;|&(:'
            COMP_LINE=$line COMP_POINT=${#line} COMPREPLY=()
            _mdr_tui
            printf '[%s]' "${COMPREPLY[@]}"; echo
        }
        line='mdr-tui run my'; complete_words mdr-tui run my
        line='mdr-tui run "my'; complete_words mdr-tui run '"my'
        line='mdr-tui run my\ sc'; complete_words mdr-tui run 'my\ sc'
        line='mdr-tui run cone --set indenter.shape=co'; complete_words mdr-tui run cone --set indenter.shape = co
        line='mdr-tui run cone --set friction.coeff'; complete_words mdr-tui run cone --set friction.coeff
        line='mdr-tui --theme='; complete_words mdr-tui --theme =
    "#;
    let said = dir.shell(script);
    let due = r"[my\ scenario.toml]
[my scenario.toml]
[my\ scenario.toml]
[cone]
[friction.coefficient=]
[dark][light][mono]
";
    assert_eq!((said.out.as_str(), said.err.as_str()), (due, ""));
}
