//! Instructions of a step and of each transform, counted by callgrind: a shared machine does not disturb them.
//!
//! `cargo bench --bench instructions` compares with what `benches/instructions.toml` has, and fails where a count
//! differs by more than 3 %; `-- --update` writes that file. Another compiler makes other code: the counts of the one
//! that is named in the file are compared, and those of others only printed. Needs `valgrind`.

#![allow(clippy::print_stdout, reason = "a program whose output is its result")]

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

use anyhow::{Context, Result, bail, ensure};
use mdr_tui::math::abel::{AbelMethod, AbelPlan, fast};
use mdr_tui::math::grid::RadialGrid;
use mdr_tui::scenario::Scenario;
use mdr_tui::simulation::Simulation;

/// How far a count may be from the pinned one.
const TOLERANCE: f64 = 0.03;

/// What is counted: a name, and how often it is done in the shorter and in the longer of two runs.
const COUNTED: [(&str, [u32; 2]); 12] = [
    ("step product 100", [200, 2200]),
    ("step a 100", [200, 2200]),
    ("step product 1000", [100, 300]),
    ("profile dense 100", [1, 101]),
    ("displacement dense 100", [1, 101]),
    ("stress dense 100", [1, 101]),
    ("worn dense 100", [1, 101]),
    ("profile fast 4000", [1, 11]),
    ("displacement fast 4000", [1, 11]),
    ("stress fast 4000", [1, 11]),
    ("worn fast 4000", [1, 11]),
    ("stress a 100", [1, 101]),
];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let outcome = match arguments.iter().position(|word| word == "--do") {
        Some(at) => perform(&arguments[at + 1], &arguments[at + 2]),
        None => compare(arguments.iter().any(|word| word == "--update")),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("instructions: {error:#}");
            ExitCode::FAILURE
        }
    }
}

type Transform = Box<dyn Fn(&[f64], &mut [f64])>;

/// Runs `what` the given number of `times`.
fn perform(what: &str, times: &str) -> Result<()> {
    let times: u32 = times.parse().context("not a number of times")?;
    let words: Vec<&str> = what.split(' ').collect();
    let [what, method, cells] = words[..] else {
        bail!("{what}: not a thing to count");
    };
    let cells: usize = cells.parse().context("not a number of cells")?;
    if what == "step" {
        let points = cells.to_string();
        let preset = Scenario::load("li2019-fig3", &[])?;
        let scenario = preset.assigned(&[
            ("numerics.points", points.as_str()),
            ("numerics.method", method),
        ])?;
        let mut simulation = Simulation::new(scenario.setup().clone())?;
        for _ in 0..times {
            simulation.step()?;
        }
        black_box(simulation.cycle());
        return Ok(());
    }
    let grid = match what {
        "worn" => RadialGrid::graded(cells, 0.5, 1.5)?,
        _ => RadialGrid::uniform(cells, 1.5)?,
    };
    let values: Vec<f64> = grid.nodes().iter().map(|r| (3.0 * r * r).cos()).collect();
    let mut out = vec![0.0; grid.len()];
    let plan = match method {
        "fast" => AbelPlan::fast(&grid, fast::TOLERANCE).context("no plan")?,
        "dense" => AbelPlan::dense(AbelMethod::Product, &grid),
        method => AbelPlan::dense(method.parse()?, &grid),
    };
    let transform: Transform = match what {
        "profile" => Box::new(move |from, to| plan.profile(from, to)),
        "worn" => Box::new(move |from, to| plan.image(from, to)),
        "displacement" => Box::new(move |from, to| plan.displacement(from, to)),
        "stress" => Box::new(move |from, to| plan.stress(from, to)),
        _ => bail!("{what}: not a thing to count"),
    };
    for _ in 0..times {
        transform(black_box(&values), black_box(&mut out));
    }
    Ok(())
}

/// The instructions that this program executes to run `what` the given number of `times`.
fn count(what: &str, times: u32) -> Result<u64> {
    let child = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe()?)
        .args(["--do", what, &times.to_string()])
        .stdout(Stdio::null())
        .output()
        .context("valgrind does not start; on Debian: apt install valgrind")?;
    let said = String::from_utf8_lossy(&child.stderr);
    ensure!(child.status.success(), "{what}: {said}");
    let collected = said
        .lines()
        .find_map(|line| line.split_once("Collected :"))
        .with_context(|| format!("{what}: no count in {said}"))?;
    Ok(collected.1.trim().parse()?)
}

fn compiler() -> Result<String> {
    let rustc = std::env::var_os("RUSTC").map_or_else(|| PathBuf::from("rustc"), PathBuf::from);
    let output = Command::new(rustc).arg("--version").output()?;
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}

fn compare(update: bool) -> Result<()> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/instructions.toml");
    let pinned: toml::Table = std::fs::read_to_string(&path).unwrap_or_default().parse()?;
    let compiler = compiler()?;
    let known = pinned.get("compiler").and_then(toml::Value::as_str) == Some(&compiler);
    let mut table = toml::Table::new();
    table.insert("compiler".into(), compiler.into());
    let mut off = 0;
    println!("{:24} {:>10} {:>10}", "instructions of", "now", "pinned");
    for (what, [few, many]) in COUNTED {
        let each = (count(what, many)? - count(what, few)?) / u64::from(many - few);
        let before = pinned.get(what).and_then(toml::Value::as_integer);
        let change = before.map(|before| each as f64 / before as f64 - 1.0);
        let told = change.map_or(String::new(), |change| format!("{:+.1} %", 100.0 * change));
        let before = before.map_or("-".into(), |before| before.to_string());
        println!("{what:24} {each:>10} {before:>10} {told}");
        off += usize::from(change.is_none_or(|change| change.abs() > TOLERANCE));
        table.insert(what.into(), i64::try_from(each)?.into());
    }
    if update {
        let text = format!("# Written by `cargo bench --bench instructions -- --update`.\n{table}");
        return Ok(std::fs::write(&path, text)?);
    }
    if !known {
        println!("the pinned counts are of another compiler: nothing is compared");
        return Ok(());
    }
    ensure!(
        off == 0,
        "{off} counts differ by more than 3 %; where that is meant, add -- --update"
    );
    Ok(())
}
