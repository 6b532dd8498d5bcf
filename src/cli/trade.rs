//! `mdr-tui trade`: speed against accuracy, measured on this machine.

use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};

use super::args::Trade;
use super::job::end;
use super::{FAILED, Misuse, complain, progress, results, small_multiples, stop};
use crate::export::header::number;
use crate::math::abel::AbelMethod;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Scale};
use crate::scenario::Scenario;
use crate::studies::refinement::Verdict;
use crate::studies::trade::report::{Trial, cheapest, front, points, table};
use crate::studies::trade::{self, Adaptive, Errors, Ladder, Sample, Setting};

/// Accuracies whose own search for a level is timed beside the fixed settings.
const ACCURACIES: [f64; 2] = [1e-2, 1e-3];

/// Errors below this one are small enough for any figure: the search ends there, or where the reference blurs.
const FINE: f64 = 1e-3;

/// By how many times more work a setting may still be tried after one that is fine enough: work tells the time of
/// different methods only roughly.
const SLOWER: f64 = 2.0;

/// The longest that such a search may take, s.
const PATIENCE: f64 = 10.0;

/// The accuracy that a setting is recommended for where none is asked for.
const USUAL: f64 = ACCURACIES[0];

/// Runs the study and prints, draws and writes what was asked for.
pub fn trade(options: &Trade) -> Result<ExitCode> {
    let target = options.rows.claim()?;
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
        is_usual: options.points == trade::POINTS && options.steps == trade::STEPS,
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
    results::write(target.as_ref(), "trade", &notes, || rows().csv())?;
    let mut out = io::stdout().lock();
    if let Some(accuracy) = options.accuracy {
        return recommend(&found, accuracy, options.printing.json, &mut out);
    }
    if options.printing.json {
        results::print_json(&rows(), &mut out)?;
    } else {
        write!(out, "{}", text(&notes, &found, options))?;
        writeln!(out, "{}", advice(&found))?;
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
    if let Some((seconds, error)) = trial.point() {
        writeln!(
            out,
            "# error {error:.1e} at worst (depth, V, E_d, F_x), in {seconds:.1e} s"
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
    /// Whether nobody chose what is tried; then the slow rest is left out.
    is_usual: bool,
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
        // Settings that take longer than one that is as good as the reference can tell add nothing.
        let resolved = found.convergence.map_or(0.0, |errors| errors.worst());
        let mut enough = f64::INFINITY;
        for setting in &self.settings {
            let is_slow = setting.effort(self.cycles) as f64 > SLOWER * enough;
            if self.is_usual && is_slow {
                bar.inc(setting.effort(self.cycles));
                continue;
            }
            let Some(outcome) = run(setting, "") else {
                found.interrupted = true;
                break;
            };
            let outcome = outcome.map(|sample| {
                let errors = sample.against(&found.reference);
                (sample.judged_by(&found.reference), errors)
            });
            let trial = Trial {
                setting: *setting,
                outcome: outcome.map_err(|error| error.to_string()),
            };
            if trial
                .point()
                .is_some_and(|(_, error)| error <= resolved.max(FINE))
            {
                enough = enough.min(setting.effort(self.cycles) as f64);
            }
            found.trials.push(trial);
        }
        // Those that the result names are timed well.
        bar.set_message("timing");
        let named: Vec<Setting> = front(&found.trials)
            .iter()
            .map(|trial| trial.setting)
            .collect();
        for trial in &mut found.trials {
            if let Ok((sample, _)) = &mut trial.outcome
                && named.contains(&trial.setting)
            {
                let go_on = |_| !stop.load(Ordering::Relaxed);
                sample.seconds = trade::median_time(
                    &self.scenario,
                    &trial.setting,
                    self.cycles,
                    sample.seconds,
                    &go_on,
                );
            }
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
                "; a level half as fine differs by {:.1e} at worst",
                errors.worst()
            )
        });
        let mut notes = vec![
            format!(
                "{}, {} cycles: errors at the end of depth (rms, in largest depths), V, E_d and F_x; the \
                 worst counts, and only runs that pass their own checks",
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
    let errors = sample.against(&found.reference);
    let error = errors.rms.max(errors.volume);
    let met = match verdict {
        Verdict::Met => "",
        _ => ", not reached",
    };
    let fixed =
        cheapest(&found.trials, *accuracy).and_then(|trial| Some((trial, trial.point()?.0)));
    let beside = match fixed {
        Some((trial, fixed)) => {
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

/// The last line: what to use, and what it costs beside the accuracy that chooses by itself.
fn advice(found: &Found) -> String {
    let adaptive = found
        .adaptive
        .iter()
        .find(|adaptive| adaptive.accuracy == USUAL);
    let beside = adaptive.map_or(String::new(), |adaptive| {
        format!(
            "; numerics.accuracy={USUAL:e} takes {:.1e} s, for any values of the other keys",
            adaptive.sample.seconds
        )
    });
    let best = cheapest(&found.trials, USUAL);
    match best.and_then(|trial| Some((trial, trial.point()?))) {
        Some((trial, (seconds, error))) => {
            let keys = trial.setting.keys().into_iter();
            let sets: Vec<String> = keys
                .map(|(key, value)| format!("--set {key}={value}"))
                .collect();
            format!(
                "use this: {}  (error {error:.1e} at worst, {seconds:.1e} s{beside})",
                sets.join(" ")
            )
        }
        None => format!(
            "use this: --set numerics.accuracy={USUAL:e}  (no fixed setting has an error of at most {USUAL:e} and \
             passes its own checks{beside})"
        ),
    }
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
    let charts = fronts.into_iter().map(|(method, mine)| {
        let ordinate = Axis::new(format!("{method}: error"), "");
        let curve = |(times, errors): Points| Curve::new("", times, errors, Role::Profile);
        Chart::new(
            "",
            Axis::new("time", "s").bounds(times).scale(Scale::Log),
            ordinate.bounds(errors).scale(Scale::Log),
        )
        .curve(curve(all.clone()).dashed())
        .curve(curve(mine))
    });
    small_multiples::draw(&charts.collect::<Vec<_>>(), options.drawing.marker.into())
}
