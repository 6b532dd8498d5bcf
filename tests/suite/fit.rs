//! `fit`: parameters come back from data that were made with them, with errors that are honest.

use std::fmt::Write;

use mdr_tui::reading::Curves;
use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::columns::Columns;
use mdr_tui::studies::fit::{Fit, FitOptions, Fitted};
use mdr_tui::studies::measured::Measured;

use crate::common::{load, ran};
use crate::random::Random;
use crate::test_dir::{TestDir, has};

const TRUE: [(&str, f64); 2] = [("wear.coefficient", 2e-9), ("friction.coefficient", 0.12)];

/// A scene that runs in a millisecond, with these values of k and μ.
fn scenario(k: f64, mu: f64) -> Scenario {
    let sets = [
        &format!("wear.coefficient={k:e}"),
        &format!("friction.coefficient={mu:e}"),
        "numerics.points=16",
        "numerics.steps_per_cycle=20",
        "numerics.grid=uniform",
        "run.cycles=2",
        "run.snapshot_at=[]",
    ];
    load("li2019-fig3", &sets)
}

/// Normal noise, the same in every run.
struct Noise(Random);

impl Noise {
    fn normal(&mut self) -> f64 {
        let (u, v) = (1.0 - self.0.unit(), self.0.unit());
        (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    }
}

/// The scar and the loop of the true values, as tables without noise.
fn exact() -> [(&'static str, Vec<(f64, f64)>); 2] {
    let [(_, k), (_, mu)] = TRUE;
    let session = ran(scenario(k, mu), 2.0);
    let period = session.simulation().fine_period().expect("a period");
    // A rig takes as many points as a run has steps.
    let points = period.points.iter().step_by(period.points.len() / 20);
    let fretting_loop = points.map(|at| (at.shift, at.tangential_force)).collect();
    let seen = session.simulation().observe(Curves::PROFILE);
    let scar = seen
        .radii()
        .iter()
        .copied()
        .zip(seen.wear().iter().copied())
        .collect();
    [("r_m,wear_m", scar), ("u_m,F_N", fretting_loop)]
}

/// The tables with noise of `share` of their largest value.
fn with_noise(
    exact: &[(&'static str, Vec<(f64, f64)>); 2],
    share: f64,
    noise: &mut Noise,
) -> [String; 2] {
    exact.each_ref().map(|(head, rows)| {
        let largest = rows.iter().map(|row| row.1.abs()).fold(0.0, f64::max);
        let mut text = format!("{head}\n");
        for (at, value) in rows {
            let _ = writeln!(
                text,
                "{at:e},{:e}",
                value + share * largest * noise.normal()
            );
        }
        text
    })
}

fn fitted(texts: &[String; 2], robust: bool) -> Fitted {
    let columns = |text: &str| Columns::parse(text, "data.csv").expect("columns");
    let data = vec![
        Measured::scar(&columns(&texts[0])).expect("a scar"),
        Measured::fretting_loop(&columns(&texts[1]), None).expect("a loop"),
    ];
    let free = TRUE.map(|(key, _)| key.to_owned());
    let start = scenario(3e-9, 0.1);
    let options = FitOptions {
        robust,
        ..FitOptions::default()
    };
    let fit = Fit::new(start, data, &free, options).expect("a fit");
    fit.run(&|| ()).expect("a minimum")
}

/// Within twice the standard error in 94 of 100 draws, were all linear: Student's t with the 15 degrees of freedom that the
/// scar leaves. Over 2000 draws we find 93.
#[test]
fn the_errors_of_k_and_mu_are_honest_both_ways() {
    let (exact, mut noise) = (exact(), Noise(Random::new(7)));
    let (mut within, mut remarks) = ([0; 2], 0);
    for _ in 0..100 {
        let fitted = fitted(&with_noise(&exact, 0.02, &mut noise), false);
        for (i, (key, expected)) in TRUE.into_iter().enumerate() {
            let value = &fitted.values[i];
            assert_eq!(value.key, key);
            let error = value.stderr.expect("an error");
            within[i] += i32::from((value.value - expected).abs() < 2.0 * error);
            // 2 % of noise and some 50 points: errors near 1 %, neither 0 nor useless.
            let share = error / expected;
            assert!((1e-4..0.05).contains(&share), "{key}: {share:e}");
        }
        // A χ² above 2 is always said; of 17 points it comes by chance.
        remarks += fitted.remarks.len();
        let is_chance = |remark: &String| remark.contains("may be no noise");
        assert!(fitted.remarks.iter().all(is_chance), "{:?}", fitted.remarks);
    }
    assert!(remarks <= 5, "{remarks} of 100 are said to be no noise");
    eprintln!("within two standard errors: {within:?} of 100");
    let is_honest = within.iter().all(|count| (90..=99).contains(count));
    assert!(is_honest, "{within:?}");
}

/// One value in five is far off: least squares follow, the robust loss does not.
#[test]
fn outliers_weigh_less_with_the_robust_loss() {
    let exact = exact();
    let mut texts = with_noise(&exact, 0.005, &mut Noise(Random::new(3)));
    for text in &mut texts {
        let lines: Vec<String> = text
            .lines()
            .enumerate()
            .map(|(i, line)| match line.split_once(',') {
                Some((at, value)) if i % 5 == 1 => {
                    let value: f64 = value.parse().expect("a number");
                    format!("{at},{:e}", 3.0 * value)
                }
                _ => line.to_owned(),
            })
            .collect();
        *text = lines.join("\n");
    }
    let error = |robust| (fitted(&texts, robust).values[0].value / TRUE[0].1 - 1.0).abs();
    let (plain, robust) = (error(false), error(true));
    eprintln!("wear: {plain:.2e} by squares, {robust:.2e} robust");
    assert!(robust < 0.05 && plain > 3.0 * robust, "{plain} {robust}");
}

/// A trace through the axis with noise of 1 %: its places, and its depths.
fn trace(noise: &mut Noise) -> Vec<(f64, f64)> {
    let [(_, scar), _] = exact();
    let (last, largest) = scar
        .iter()
        .fold((0.0f64, 0.0f64), |(r, w), row| (r.max(row.0), w.max(row.1)));
    let depth = |r: f64| {
        let above = scar.iter().position(|row| row.0 >= r)?;
        let [(r0, w0), (r1, w1)] = [scar[above.saturating_sub(1)], scar[above]];
        let share = if r1 > r0 {
            (r * r - r0 * r0) / (r1 * r1 - r0 * r0)
        } else {
            0.0
        };
        Some(w0 + share * (w1 - w0))
    };
    let places = (-80..=80).map(|i| 1.5 * last * f64::from(i) / 80.0);
    places
        .map(|x| {
            (
                x,
                depth(x.abs()).unwrap_or(0.0) + 0.01 * largest * noise.normal(),
            )
        })
        .collect()
}

fn table(head: &str, rows: impl IntoIterator<Item = (f64, f64)>) -> String {
    rows.into_iter()
        .fold(format!("{head}\n"), |text, (at, value)| {
            text + &format!("{at:e},{value:e}\n")
        })
}

/// Zeros, signs, directions and centres are chosen by instruments; k and μ do not depend on them.
#[test]
fn faults_of_instruments_do_not_move_the_keys() {
    let mut noise = Noise(Random::new(23));
    let trace = trace(&mut noise);
    let ([_, (_, exact_loop)], plain) = (exact(), with_noise(&exact(), 0.01, &mut noise));
    let cycle: Vec<(f64, f64)> = {
        let rows = plain[1]
            .lines()
            .skip(1)
            .map(|line| line.split_once(',').expect("two columns"));
        rows.map(|(u, force)| (u.parse().expect("u"), force.parse().expect("F")))
            .collect()
    };
    let lowest = |rows: &[(f64, f64)]| {
        (0..rows.len())
            .min_by(|&i, &j| rows[i].0.total_cmp(&rows[j].0))
            .expect("rows")
    };
    // From its least displacement on, and closed there.
    let mut closed = cycle.clone();
    closed.rotate_left(lowest(&exact_loop));
    let three: Vec<(f64, f64)> = closed
        .iter()
        .cycle()
        .take(3 * closed.len() + 1)
        .copied()
        .collect();
    let size = exact_loop.iter().map(|row| row.1).fold(0.0, f64::max);
    let (width, deepest) = (
        trace[160].0,
        trace.iter().map(|row| row.1).fold(0.0, f64::max),
    );
    let one = || table("u_m,F_N", cycle.iter().copied());
    let scar = || table("x_m,wear_m", trace.iter().copied());
    let of_trace = |head, change: &dyn Fn(f64, f64) -> (f64, f64)| {
        table(head, trace.iter().map(|&(x, w)| change(x, w)))
    };
    let cases = [
        ("plain", scar(), one()),
        ("three cycles", scar(), table("u_m,F_N", three)),
        (
            "backwards",
            scar(),
            table("u_m,F_N", cycle.iter().rev().copied()),
        ),
        (
            "force turned",
            scar(),
            table("u_m,F_N", cycle.iter().map(|&(u, force)| (u, -force))),
        ),
        (
            "zeros off",
            scar(),
            table(
                "u_m,F_N",
                cycle
                    .iter()
                    .map(|&(u, force)| (u + 4e-8, force + 0.3 * size)),
            ),
        ),
        (
            "baseline",
            of_trace("x_m,wear_m", &|x, w| (x, w + 0.3 * deepest)),
            one(),
        ),
        (
            "tilt",
            of_trace("x_m,wear_m", &|x, w| (x, w + 0.2 * deepest * x / width)),
            one(),
        ),
        (
            "off centre",
            of_trace("x_m,wear_m", &|x, w| (x + 0.1 * width, w)),
            one(),
        ),
        (
            "from 0 on",
            of_trace("x_m,wear_m", &|x, w| (x + width, w)),
            one(),
        ),
        ("downwards", of_trace("x_m,wear_m", &|x, w| (x, -w)), one()),
        (
            "profile, lowest point 0",
            of_trace("x_m,z_m", &|x, w| (x, x * x / 0.02 + w - 0.1 * deepest)),
            one(),
        ),
        (
            "profile upside down",
            of_trace("x_m,z_m", &|x, w| (x, -x * x / 0.02 - w)),
            one(),
        ),
    ];
    for (name, scar, fretting_loop) in cases {
        let fitted = fitted(&[scar, fretting_loop], false);
        for (value, (_, expected)) in fitted.values.iter().zip(TRUE) {
            let error = value.stderr.expect("an error");
            let off = (value.value - expected).abs();
            assert!(
                off < 3.5 * error && error < 0.03 * expected,
                "{name}: {} {:e} ± {error:e}",
                value.key,
                value.value
            );
        }
        assert!(fitted.remarks.is_empty(), "{name}: {:?}", fitted.remarks);
    }
}

/// From a factor of 100 away on either side.
#[test]
fn far_starts_lead_to_the_same_minimum() {
    let texts = with_noise(&exact(), 0.01, &mut Noise(Random::new(29)));
    let columns = Columns::parse(&texts[0], "scar.csv").expect("columns");
    let [(key, expected), _] = TRUE;
    let found = [1e-2, 1.0, 1e2].map(|factor| {
        let start = scenario(factor * expected, 0.12);
        let data = vec![Measured::scar(&columns).expect("a scar")];
        let fit = Fit::new(start, data, &[key.to_owned()], FitOptions::default()).expect("a fit");
        fit.run(&|| ()).expect("a minimum").values[0].value
    });
    for value in found {
        assert!(
            (value / found[1] - 1.0).abs() < 2e-3 && (value / expected - 1.0).abs() < 0.05,
            "{found:?}"
        );
    }
}

/// A model that misses something is reported, whatever the errors are.
#[test]
fn residuals_that_are_no_noise_are_said() {
    let [_, (_, rows)] = exact();
    // A loop that hardens at both ends.
    let bent = rows
        .iter()
        .map(|&(u, force)| (u, force + 2e15 * force.abs().max(1e-3) * u.powi(3) * 1e6));
    let columns = Columns::parse(&table("u_m,F_N", bent), "loop.csv").expect("columns");
    let data = vec![Measured::fretting_loop(&columns, None).expect("a loop")];
    let free = ["friction.coefficient".to_owned()];
    let fit = Fit::new(scenario(2e-9, 0.1), data, &free, FitOptions::default()).expect("a fit");
    let fitted = fit.run(&|| ()).expect("a minimum");
    assert!(
        fitted
            .remarks
            .iter()
            .any(|remark| remark.contains("the residuals are no noise")),
        "{:?}",
        fitted.remarks
    );
}

/// Another stroke is refused, or taken by name.
#[test]
fn a_loop_of_another_stroke_is_refused_or_taken() {
    let [_, (_, rows)] = exact();
    let wide = table("u_m,F_N", rows.iter().map(|&(u, force)| (1.4 * u, force)));
    let columns = Columns::parse(&wide, "loop.csv").expect("columns");
    let fit = |takes_stroke| {
        let data = vec![Measured::fretting_loop(&columns, None).expect("a loop")];
        let options = FitOptions {
            takes_stroke,
            ..FitOptions::default()
        };
        Fit::new(
            scenario(2e-9, 0.1),
            data,
            &["friction.coefficient".to_owned()],
            options,
        )
    };
    has(
        &fit(false).expect_err("refused").to_string(),
        "--stroke from-data takes that of the file",
    );
    assert!(fit(true).is_ok());
}

#[test]
fn what_data_do_not_determine_is_said() {
    let exact = exact();
    let texts = with_noise(&exact, 0.01, &mut Noise(Random::new(5)));
    let scar = Columns::parse(&texts[0], "scar.csv").expect("columns");
    let scar = || vec![Measured::scar(&scar).expect("a scar")];
    // Archard's law does not use the exponent.
    let with_power = scenario(2e-9, 0.12)
        .assigned(&[("wear.stress_exponent", "1.5")])
        .expect("a key");
    let free = ["wear.coefficient", "wear.stress_exponent"].map(str::to_owned);
    let fit = Fit::new(with_power, scar(), &free, FitOptions::default()).expect("a fit");
    let fitted = fit.run(&|| ()).expect("a minimum");
    assert_eq!(fitted.values[1].stderr, None);
    let remark = "the data do not determine wear.stress_exponent".to_owned();
    assert!(fitted.remarks.contains(&remark), "{:?}", fitted.remarks);
    let none =
        Fit::new(scenario(3e-9, 0.1), scar(), &[], FitOptions::default()).expect_err("refused");
    has(&none.to_string(), "needs a key to fit");
}

#[test]
fn the_command_prints_json_and_writes_the_fitted_scenario() {
    let dir = TestDir::new();
    let [scar, fretting_loop] = with_noise(&exact(), 0.01, &mut Noise(Random::new(11)));
    dir.write("start.toml", scenario(3e-9, 0.1).to_toml().as_bytes());
    dir.write("scar.csv", scar.as_bytes());
    dir.write("loop.csv", fretting_loop.as_bytes());
    let keys = "--free wear.coefficient,friction.coefficient --quiet";
    let line =
        format!("fit start.toml --scar scar.csv --loop loop.csv {keys} --json --out fitted.toml");
    let told: serde_json::Value = serde_json::from_str(&dir.done(&line)).expect("JSON");
    for (key, expected) in TRUE {
        let value = told[key]["value"].as_f64().expect("a value");
        let error = told[key]["stderr"].as_f64().expect("an error");
        assert!(
            (value / expected - 1.0).abs() < 0.05 && error > 0.0,
            "{told}"
        );
        let path = dir.path("fitted.toml").display().to_string();
        let written = load(&path, &[]).value(key).expect("a value");
        assert_eq!(written.parse(), Ok(value));
    }
    dir.line(&line).ends(2, "already exists");
    let text = dir.done(&format!(
        "fit start.toml --scar scar.csv {keys} --plot --marker ascii"
    ));
    for word in [
        "wear.coefficient",
        "±",
        "correlation",
        " mm^3/J",
        "scar.csv: 17 points",
        "scar.csv: residual",
    ] {
        has(&text, word);
    }
}
