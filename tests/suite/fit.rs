//! `fit`: parameters come back from data that were made with them, with errors that are honest.

use std::fmt::Write;

use mdr_tui::reading::Curves;
use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::columns::Columns;
use mdr_tui::studies::fit::{Fit, Fitted};
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
    let scar = seen.radii.iter().copied().zip(seen.wear).collect();
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
        Measured::fretting_loop(&columns(&texts[1])).expect("a loop"),
    ];
    let free = TRUE.map(|(key, _)| key.to_owned());
    let start = scenario(3e-9, 0.1);
    let fit = Fit::new(start, data, &free, None, robust).expect("a fit");
    fit.run(&|| ()).expect("a minimum")
}

/// Within twice the standard error in 94 of 100 draws, were all linear: Student's t with the 15 degrees of freedom that the
/// scar leaves. Over 2000 draws we find 93.
#[test]
fn the_errors_of_k_and_mu_are_honest_both_ways() {
    let (exact, mut noise) = (exact(), Noise(Random::new(7)));
    let mut within = [0; 2];
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
        assert!(fitted.remarks.is_empty(), "{:?}", fitted.remarks);
    }
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

#[test]
fn what_data_do_not_determine_is_said() {
    let exact = exact();
    let texts = with_noise(&exact, 0.01, &mut Noise(Random::new(5)));
    let scar = Columns::parse(&texts[0], "scar.csv").expect("columns");
    let scar = || vec![Measured::scar(&scar).expect("a scar")];
    // Archard's law does not use the exponent.
    let with_power = scenario(2e-9, 0.12)
        .with("wear.stress_exponent", "1.5")
        .expect("a key");
    let free = ["wear.coefficient", "wear.stress_exponent"].map(str::to_owned);
    let fit = Fit::new(with_power, scar(), &free, None, false).expect("a fit");
    let fitted = fit.run(&|| ()).expect("a minimum");
    assert_eq!(fitted.values[1].stderr, None);
    let remark = "the data do not determine wear.stress_exponent".to_owned();
    assert!(fitted.remarks.contains(&remark), "{:?}", fitted.remarks);
    let none = Fit::new(scenario(3e-9, 0.1), scar(), &[], None, false).expect_err("refused");
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
