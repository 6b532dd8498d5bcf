//! The guide and the README hold: their commands parse, their scenarios load, their examples run,
//! and what they list is what the program knows.
//!
//! `UPDATE_DOCS=1 cargo test guide::` rewrites the lists, to be reviewed before they are kept.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use mdr_tui::charts::on_paper;
use mdr_tui::export::field;
use mdr_tui::guide::TOPICS;
use mdr_tui::math::abel::AbelMethod;
use mdr_tui::reading::Column;
use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::key::{Default, Key, Kind, Parameter};
use mdr_tui::tui::command::{COMMANDS, CommandRow};
use mdr_tui::tui::manual;

use crate::test_dir::{Said, TestDir, has};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The README and all topics, with their names.
fn texts() -> Vec<(String, String)> {
    let readme = fs::read_to_string(root().join("README.md")).expect("the README");
    let topics = TOPICS
        .iter()
        .map(|topic| (format!("guide {}", topic.name), topic.text.to_owned()));
    topics.chain([("README.md".to_owned(), readme)]).collect()
}

/// The code blocks of a text with this word after the fence.
fn blocks<'a>(text: &'a str, word: &str) -> Vec<&'a str> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some((_, after)) = rest.split_once("```") {
        let (info, body) = after.split_once('\n').expect("a fence has a line");
        let (body, after) = body.split_once("```").expect("a block ends");
        if info == word {
            found.push(body);
        }
        rest = after;
    }
    found
}

/// The program's own commands in a block of shell, without comments.
fn commands(block: &str) -> impl Iterator<Item = Vec<&str>> {
    block
        .lines()
        .map(|line| line.split(" #").next().unwrap_or_default())
        .map(|line| line.split(" > ").next().unwrap_or_default())
        .filter_map(|line| line.trim().strip_prefix("mdr-tui"))
        .map(|line| line.split_whitespace().collect())
}

#[test]
fn every_command_that_is_shown_is_one() {
    let dir = TestDir::new();
    for (name, text) in texts() {
        for block in ["sh", "sh run"].iter().flat_map(|word| blocks(&text, word)) {
            for mut command in commands(block) {
                // Arguments are judged before the help is shown.
                command.push("--help");
                let said = dir.say(&command);
                assert_eq!(said.code, 0, "{name}: {command:?}: {}", said.err);
            }
        }
    }
}

#[test]
fn every_scenario_that_is_shown_loads() {
    for (name, text) in texts() {
        for block in blocks(&text, "toml") {
            if let Err(error) = Scenario::from_toml(block, &name, &[]) {
                panic!("{error}");
            }
        }
    }
}

#[test]
fn examples_that_can_run_do() {
    for (name, text) in texts() {
        let dir = TestDir::new();
        files_of_the_chapter_on_measuring(&dir, &text);
        for block in blocks(&text, "sh run") {
            for command in commands(block) {
                let said = dir.say(&command);
                assert_eq!(said.code, 0, "{name}: {command:?}: {}", said.err);
            }
        }
    }
}

/// The files of a rig that `guide measuring` reads, and its scenario.
fn files_of_the_chapter_on_measuring(dir: &TestDir, text: &str) {
    dir.write("record.txt", include_bytes!("../fixtures/rig/record.txt"));
    for trace in ["trace.csv", "a.csv", "b.csv"] {
        dir.write(trace, include_bytes!("../fixtures/rig/trace.csv"));
    }
    // Some 4 µJ a cycle at 1e-14 1/Pa, 7800 kg/m³.
    let masses = (1..=8).map(|i| format!("{};{:e}\n", 600 * i, 1.9e-13 * f64::from(i)));
    let masses = masses.fold("cycle;mass_kg\n".to_owned(), |text, line| text + &line);
    dir.write("mass.txt", masses.as_bytes());
    let scenario = blocks(text, "toml file rig.toml").concat();
    dir.write("rig.toml", scenario.as_bytes());
}

/// The chapter's record and trace are read, and lead to the values that they were made with.
#[test]
fn the_chapter_on_measuring_finds_mu_and_k() {
    let dir = TestDir::new();
    let page = TOPICS.iter().find(|topic| topic.name == "measuring");
    files_of_the_chapter_on_measuring(&dir, page.expect("a topic").text);
    let record = dir.done("inspect record.txt --load 30N");
    for part in [
        "windows-1252, separated by semicolons, decimal commas",
        "3 whole cycles",
        "Displacement Displacement_m",
    ] {
        has(&record, part);
    }
    has(
        &dir.done("inspect trace.csv"),
        "2 of 201 rows have missing values",
    );
    let keys = "--free friction.coefficient,wear.coefficient --json --quiet --out fitted.toml";
    let told = dir.done(&format!(
        "fit rig.toml --loop record.txt@2 --scar trace.csv {keys}"
    ));
    let told: serde_json::Value = serde_json::from_str(&told).expect("JSON");
    for (key, expected, share) in [
        ("friction.coefficient", 0.55, 0.01),
        ("wear.coefficient", 1e-14, 0.03),
    ] {
        let [value, error] =
            ["value", "stderr"].map(|part| told[key][part].as_f64().expect("a number"));
        assert!(
            (value - expected).abs() < 2.5 * error && error < share * expected,
            "{key}: {value:e} ± {error:e}"
        );
    }
    // What was fitted makes the loops that were measured, a row and a loop of the log for each.
    let text = dir.done("inspect record.txt@2 --scenario fitted.toml --marker ascii");
    assert_eq!(text.matches("\nmodel ").count(), 3, "{text}");
    has(&text, "F_x up to");
    let beside = dir.done("inspect record.txt@2 --scenario fitted.toml --json");
    let beside: serde_json::Value = serde_json::from_str(&beside).expect("JSON");
    for (figure, share) in [
        ("energy_per_cycle_J", 0.05),
        ("F_x_amplitude_N", 0.03),
        ("u_x_amplitude_m", 0.02),
        ("friction", 0.1),
    ] {
        let ratio = beside["beside"]["ratio"][figure].as_f64().expect("a ratio");
        assert!((ratio - 1.0).abs() < share, "{figure}: {ratio}");
        for (model, measured) in
            [0, 1, 2].map(|k| (&beside["beside"]["model"][k], &beside["cycles"][k]))
        {
            let [model, measured] =
                [model, measured].map(|row| row[figure].as_f64().expect("a figure"));
            assert!(
                (measured / model - 1.0).abs() < share,
                "{figure}: {measured} {model}"
            );
        }
    }
    let nuisance = |set: usize, k: usize| {
        told["data"][set]["nuisances"][k]["value"]
            .as_f64()
            .expect("a number")
    };
    // Scars come first: a baseline of 6 nm, a centre 9 µm off, then forces off by 1.8 N and displacements by 0.31 µm.
    for (value, expected, error) in [
        (nuisance(0, 0), 6e-9, 3e-10),
        (nuisance(0, 1), 9e-6, 5e-7),
        (nuisance(1, 0), 1.8, 0.2),
        (nuisance(1, 1), 0.31e-6, 2e-8),
    ] {
        assert!(
            (value - expected).abs() < error,
            "{value:e} for {expected:e}"
        );
    }
    assert_eq!(
        told["remarks"].as_array().expect("remarks").len(),
        0,
        "{}",
        told["remarks"]
    );
}

/// The Python function runs, with pandas or with what it needs of it, and the other lines are Python.
#[test]
fn the_function_for_python_runs() {
    let python = |dir: &TestDir, arguments: &[&str]| {
        let program = PathBuf::from(env!("CARGO_BIN_EXE_mdr-tui"));
        let home = program.parent().expect("a directory").to_owned();
        let known = std::env::var_os("PATH").unwrap_or_default();
        let path = std::iter::once(home).chain(std::env::split_paths(&known));
        let path = std::env::join_paths(path).expect("a path");
        Command::new("python3")
            .args(arguments)
            .env("PATH", path)
            .current_dir(dir.path(""))
            .output()
    };
    let dir = TestDir::new();
    match python(&dir, &["-c", "import pandas"]) {
        // No Python, nothing to be tried.
        Err(_) => return,
        Ok(said) if said.status.success() => {}
        Ok(_) => dir.write("pandas.py", include_bytes!("../fixtures/python/pandas.py")),
    }
    let page = TOPICS.iter().find(|topic| topic.name == "python");
    let page = page.expect("a topic").text;
    let script = blocks(page, "python run").concat() + include_str!("../fixtures/python/try.py");
    dir.write("function.py", script.as_bytes());
    let said = python(&dir, &["function.py"]).expect("python3");
    let Said { code, out, err } = said.into();
    assert_eq!((code, err.as_str()), (0, ""));
    has(&out, "friction.coefficient");
    assert_eq!(out.lines().count(), 1, "{out}");
    for block in blocks(page, "python") {
        dir.write("lines.py", block.as_bytes());
        let said = python(&dir, &["-m", "py_compile", "lines.py"]).expect("python3");
        Said::from(said).ends(0, "");
    }
}

#[test]
fn topics_are_listed_shown_and_found() {
    let dir = TestDir::new();
    let list = dir.line("guide").out;
    for topic in TOPICS {
        has(&list, &format!("  {} ", topic.name));
        assert_eq!(dir.say(&["guide", topic.name]).out, topic.text);
        let file = format!("src/guide/{}.md", topic.name);
        assert!(root().join(file).exists());
    }
    let said = dir.line("guide fils");
    said.ends(2, "no such topic; did you mean files?\n");
    assert!(said.err.ends_with("files?\n"), "{}", said.err);
}

/// What stands in a file between two marks, which must be `wanted`.
fn hold(file: &Path, mark: &str, wanted: &str) {
    let text = fs::read_to_string(file).expect("a text");
    let (start, end) = (format!("<!-- {mark} -->\n"), format!("<!-- /{mark} -->"));
    let (before, rest) = text.split_once(&start).expect("the first mark");
    let (found, after) = rest.split_once(&end).expect("the second mark");
    if found == wanted {
        return;
    }
    if std::env::var_os("UPDATE_DOCS").is_some() {
        let updated = format!("{before}{start}{wanted}{end}{after}");
        return fs::write(file, updated).expect("a text");
    }
    panic!(
        "{} has\n{found}\nbut it is\n{wanted}\nUPDATE_DOCS=1 cargo test guide:: writes it",
        file.display()
    );
}

#[test]
fn the_keys_of_the_explorer_are_those_of_its_table() {
    let mut keys = "| | key | does |\n|---|---|---|\n".to_owned();
    for (group, rows) in manual::groups() {
        for (i, row) in rows.iter().enumerate() {
            let names = row.key_names().into_iter();
            let names: Vec<String> = names.map(|key| format!("`{key}`")).collect();
            let group = if i == 0 { group } else { "" };
            keys += &format!("| {group} | {} | {} |\n", names.join(" "), row.help);
        }
    }
    assert!(
        COMMANDS
            .iter()
            .flat_map(CommandRow::key_names)
            .all(|key| keys.contains(&format!("`{key}`")))
    );
    hold(&root().join("src/guide/explorer.md"), "keys", &keys);
}

#[test]
fn the_default_configuration_is_shown_as_it_is() {
    let config = fs::read_to_string(root().join("src/cli/config.toml")).expect("a file");
    hold(
        &root().join("src/guide/configuration.md"),
        "config",
        &format!("```text\n{config}```\n"),
    );
}

#[test]
fn the_columns_of_files_are_those_of_their_table() {
    let table = |columns: &[Column]| {
        let rows = columns.iter().map(|column| {
            let (name, meaning, unit) = (column.name(), column.meaning(), column.unit());
            format!("| `{name}` | {} | {unit} |\n", meaning.replace('|', "\\|"))
        });
        "| column | meaning | unit |\n|---|---|---|\n".to_owned() + &rows.collect::<String>()
    };
    let page = root().join("src/guide/files.md");
    // The displacement of the surface is named like the indenter's.
    let springs = Column::STATE
        .iter()
        .position(|column| *column == Column::SpringShift);
    let mut state = Column::STATE.to_vec();
    state.insert(springs.expect("a column") + 1, Column::Shift);
    for (mark, columns) in [
        ("state", &state[..]),
        ("history", &Column::HISTORY),
        ("further", &Column::FURTHER),
        ("errors", &Column::ERRORS),
        ("field", &field::COLUMNS),
    ] {
        hold(&page, mark, &table(columns));
    }
}

#[test]
fn the_charts_of_figures_are_those_that_have_a_name() {
    let mut list = String::new();
    for chart in on_paper() {
        list += &format!("| `{}` | {} |\n", chart.name, chart.title);
    }
    let list = format!("| chart | shows |\n|---|---|\n{list}");
    hold(&root().join("src/guide/figures.md"), "charts", &list);
}

#[test]
fn the_keys_of_a_scenario_are_those_of_the_schema() {
    let mut text = String::new();
    let mut section = None;
    for parameter in Key::all() {
        if section != Some(parameter.section()) {
            section = Some(parameter.section());
            let heading = match parameter.section() {
                "" => "General".to_owned(),
                "changes" => "`[[changes]]`, recorded during a run".to_owned(),
                section => format!("`[{section}]`"),
            };
            text += &format!("\n### {heading}\n\n| key | meaning | default |\n|---|---|---|\n");
        }
        text += &row(&parameter);
    }
    text += "\n";
    hold(&root().join("src/guide/scenarios.md"), "schema", &text);
}

fn row(parameter: &Parameter) -> String {
    let mut meaning = parameter.meaning.to_owned();
    match parameter.kind {
        kind @ Kind::Choice(_) => {
            let words = kind.words().unwrap_or_default();
            let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
            meaning += &format!(": {}", words.join(", "));
        }
        _ => {
            let range = parameter.range.to_string();
            for (before, part) in [(", ", parameter.unit), ("; ", range.as_str())] {
                if !part.is_empty() {
                    meaning += &format!("{before}{part}");
                }
            }
        }
    }
    let default = match (&parameter.default, parameter.default.value()) {
        (_, Some(toml::Value::Float(small))) if (f64::MIN_POSITIVE..1e-3).contains(small) => {
            format!("`{small:e}`")
        }
        (_, Some(value)) => format!("`{value}`"),
        (Default::Derived(words), _) => (*words).to_owned(),
        _ => String::new(),
    };
    format!("| `{}` | {meaning} | {default} |\n", parameter.key())
}

/// The page on methods says of each what the program asks of its traits.
#[test]
fn the_table_of_methods_is_that_of_their_traits() {
    let page = include_str!("../../src/guide/methods.md");
    for method in AbelMethod::ALL {
        let begins = format!("| `{method}` ");
        let row = page.lines().find(|line| line.starts_with(&begins));
        let row = row.unwrap_or_else(|| panic!("no row of {method}"));
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let traits = method.traits();
        let keeps = if traits.is_causal { "yes" } else { "**no**" };
        let runs = if traits.is_published {
            "uniform, euler"
        } else {
            "graded, trapezoid"
        };
        assert_eq!(cells[3..5], [keeps, runs], "{method}");
    }
}
