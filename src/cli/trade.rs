//! `mdr-tui trade`: speed against accuracy, measured on this machine.

use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};
use ratatui::style::Style;

use super::args::Trade;
use super::job::end;
use super::{FAILED, Misuse, complain, progress, results, small_multiples, stop};
use crate::export::header::number;
use crate::math::abel::AbelMethod;
use crate::plot::{Axis, Curve, Plot, Scale};
use crate::scenario::Scenario;
use crate::studies::refinement::Verdict;
use crate::studies::trade::report::{Trial, cheapest, cheapest_for_scar, front, points, table};
use crate::studies::trade::{self, Adaptive, Errors, Ladder, Sample, Setting};

/// Accuracies whose own search for a level is timed beside the fixed settings.
const ACCURACIES: [f64; 2] = [1e-2, 1e-3];

/// The longest that such a search may take, s.
const PATIENCE: f64 = 60.0;

/// Runs the study and prints, draws and writes what was asked for.
pub fn trade(options: &Trade) -> Result<ExitCode> {
    options.rows.check()?;
    let scenario = Scenario::load(&options.scenario, &options.changes.set)?;
    let cycles = end(options.cycles.or(scenario.run().cycles), &options.scenario)?;
    if scenario.setup().wear.is_none() {
        let message = format!(
            "{}: nothing wears, so there is no worn profile to compare; see mdr-tui verify",
            options.scenario
        );
        return Err(Misuse(message).into());
    }
    let mut ladder = Ladder {
        points: options.points.clone(),
        steps: options.steps.clone(),
        ..Ladder::default()
    };
    if !options.methods.is_empty() {
        ladder.methods.clone_from(&options.methods);
    }
    let study = Study {
        settings: ladder.settings(&scenario),
        reference: ladder.reference(&scenario),
        scenario,
        cycles,
    };
    let stop = stop::signal()?;
    let Some(found) = study.run(&stop, options.printing.quiet)? else {
        complain("interrupted before the reference was computed: no results");
        return Ok(ExitCode::from(FAILED));
    };
    let rows = || table(&found.trials, &found.trials);
    let notes = study.notes(&found);
    options.rows.write("trade", &notes, || rows().csv())?;
    let mut out = io::stdout().lock();
    if let Some(accuracy) = options.accuracy {
        return recommend(&found, accuracy, options.printing.json, &mut out);
    }
    if options.printing.json {
        results::print_json(&rows(), &mut out)?;
    } else {
        write!(out, "{}", text(&notes, &found, options))?;
    }
    Ok(match found.interrupted {
        true => ExitCode::from(FAILED),
        false => ExitCode::SUCCESS,
    })
}

/// The cheapest setting for an accuracy, as assignments that `--set` takes.
fn recommend(found: &Found, accuracy: f64, json: bool, out: &mut impl Write) -> Result<ExitCode> {
    let Some(trial) = cheapest(&found.trials, accuracy) else {
        complain(&format!(
            "no setting reached an error of {accuracy:e}; try larger --points or --steps"
        ));
        return Ok(ExitCode::from(FAILED));
    };
    if json {
        results::print_json(&table([trial], &found.trials), out)?;
        return Ok(ExitCode::SUCCESS);
    }
    if let Ok((sample, errors)) = &trial.outcome {
        writeln!(
            out,
            "# error {:.1e} of the largest depth (rms), in {:.1e} s",
            errors.rms, sample.seconds
        )?;
    }
    for (key, value) in trial.setting.keys() {
        writeln!(out, "--set {key}={value}")?;
    }
    Ok(ExitCode::SUCCESS)
}

struct Study {
    scenario: Scenario,
    cycles: f64,
    settings: Vec<Setting>,
    reference: Setting,
}

struct Found {
    reference: Sample,
    /// The error of the reference, from a level half as fine.
    convergence: Option<Errors>,
    trials: Vec<Trial>,
    /// What accuracies cost that find their level by themselves.
    adaptive: Vec<Adaptive>,
    interrupted: bool,
}

impl Study {
    /// The reference first, then every setting, the cheapest first; `None` without a reference.
    fn run(&self, stop: &AtomicBool, quiet: bool) -> Result<Option<Found>> {
        let half = Setting {
            points: self.reference.points / 2,
            steps: self.reference.steps / 2,
            tolerance: self.reference.tolerance.map(|tolerance| 4.0 * tolerance),
            ..self.reference
        };
        let efforts = [self.reference, half]
            .into_iter()
            .chain(self.settings.iter().copied());
        let length = efforts.map(|setting| setting.effort(self.cycles)).sum();
        let bar = progress::bar(length, progress::TIMES, quiet);
        let run = |setting: &Setting, what: &str| {
            bar.set_message(format!(
                "{what}{} {}, N = {}, {} steps",
                setting.method, setting.scheme, setting.points, setting.steps
            ));
            let (begin, effort) = (bar.position(), setting.effort(self.cycles));
            let go_on = |share: f64| {
                bar.set_position(begin + (share * effort as f64) as u64);
                !stop.load(Ordering::Relaxed)
            };
            let outcome = trade::run(&self.scenario, setting, self.cycles, &go_on);
            bar.set_position(begin + effort);
            outcome
        };
        let Some(reference) = run(&self.reference, "reference, ") else {
            return Ok(None);
        };
        let reference = reference.context("the reference")?;
        let half = run(&half, "reference, ");
        let interrupted = half.is_none();
        let mut found = Found {
            convergence: half.and_then(|half| Some(half.ok()?.against(&reference))),
            reference,
            trials: Vec::new(),
            adaptive: Vec::new(),
            interrupted,
        };
        for setting in &self.settings {
            let Some(outcome) = run(setting, "") else {
                found.interrupted = true;
                break;
            };
            let outcome = outcome.map(|sample| {
                let errors = sample.against(&found.reference);
                (sample, errors)
            });
            found.trials.push(Trial {
                setting: *setting,
                outcome: outcome.map_err(|error| error.to_string()),
            });
        }
        for accuracy in ACCURACIES.into_iter().filter(|_| !found.interrupted) {
            bar.set_message(format!("numerics.accuracy = {accuracy:e}"));
            let go_on = || !stop.load(Ordering::Relaxed);
            // An accuracy that no level meets has no cost to tell.
            if let Ok(adaptive) =
                trade::adaptive(&self.scenario, accuracy, self.cycles, PATIENCE, &go_on)
            {
                found.adaptive.push(adaptive);
            }
        }
        bar.finish_and_clear();
        Ok(Some(found))
    }

    /// What was compared with what.
    fn notes(&self, found: &Found) -> Vec<String> {
        let Setting { points, steps, .. } = self.reference;
        let converged = found.convergence.map_or(String::new(), |errors| {
            format!(
                "; a level half as fine differs by {:.1e} rms, {:.1e} at most",
                errors.rms, errors.largest
            )
        });
        let mut notes = vec![
            format!(
                "{}, {} cycles: error of the worn profile at the end, relative to the largest \
                 depth",
                self.scenario.title(),
                number(self.cycles)
            ),
            format!(
                "reference: {}, N = {points}, {steps} steps per cycle, {:.1e} s{converged}",
                self.reference.method, found.reference.seconds
            ),
        ];
        notes.extend(found.adaptive.iter().map(|adaptive| cost(adaptive, found)));
        if found.interrupted {
            notes.push(format!(
                "interrupted: {} of {} settings were tried",
                found.trials.len(),
                self.settings.len()
            ));
        }
        notes
    }
}

/// What an accuracy cost, beside the cheapest fixed setting that would have done.
fn cost(adaptive: &Adaptive, found: &Found) -> String {
    let Adaptive {
        accuracy,
        level,
        verdict,
        sample,
    } = adaptive;
    let error = sample.against(&found.reference).scar;
    let met = match verdict {
        Verdict::Met => "",
        _ => ", not reached",
    };
    let beside = match cheapest_for_scar(&found.trials, *accuracy) {
        Some(trial) => {
            let fixed = trial
                .outcome
                .as_ref()
                .map_or(f64::NAN, |(run, _)| run.seconds);
            let Setting {
                method,
                points,
                steps,
                ..
            } = trial.setting;
            format!(
                "{:.1} times the cheapest fixed setting ({method}, N = {points}, {steps} steps, \
                 {fixed:.1e} s)",
                sample.seconds / fixed
            )
        }
        None => "no fixed setting tried is as good".into(),
    };
    format!(
        "numerics.accuracy = {accuracy:e}{met}: {:.1e} s in all, ends at N = {}, {} steps per cycle; error of \
         scar and volume {error:.1e}; {beside}",
        sample.seconds, level.points, level.steps
    )
}

/// The table under what was compared, and the plots under it.
fn text(notes: &[String], found: &Found, options: &Trade) -> String {
    let mut text = String::new();
    for note in notes {
        text.push_str(note);
        text.push('\n');
    }
    let shown: Vec<&Trial> = if options.all {
        found.trials.iter().collect()
    } else {
        front(&found.trials)
    };
    text.push_str(&table(shown, &found.trials).text());
    if options.drawing.plot {
        text.push_str(&plots(found, options));
    }
    text
}

/// Times and errors.
type Points = (Vec<f64>, Vec<f64>);

/// Error against time: one plot per method with its front; the overall front is dashed.
fn plots(found: &Found, options: &Trade) -> String {
    let all = points(front(&found.trials));
    let fronts: Vec<(AbelMethod, Points)> = AbelMethod::ALL
        .into_iter()
        .map(|method| {
            let mine = found
                .trials
                .iter()
                .filter(|trial| trial.setting.method == method);
            (method, points(front(mine)))
        })
        .filter(|(_, (times, _))| !times.is_empty())
        .collect();
    let every = |pick: fn(&Points) -> &Vec<f64>| {
        small_multiples::decades(fronts.iter().flat_map(|(_, front)| pick(front)).copied())
    };
    let (Some(times), Some(errors)) = (every(|front| &front.0), every(|front| &front.1)) else {
        return String::new();
    };
    let names: Vec<String> = fronts
        .iter()
        .map(|(method, _)| format!("{method}: error"))
        .collect();
    let plots: Vec<Plot> = fronts
        .iter()
        .zip(&names)
        .map(|((_, mine), name)| {
            Plot::new(
                Axis::new("time", "s").bounds(times).scale(Scale::Log),
                Axis::new(name, "").bounds(errors).scale(Scale::Log),
            )
            .curve(Curve::new("", &all.0, &all.1, Style::new()).dashed())
            .curve(Curve::new("", &mine.0, &mine.1, Style::new()))
            .marker(options.drawing.marker.into())
        })
        .collect();
    small_multiples::draw(&plots)
}
