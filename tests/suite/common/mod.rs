//! A dimensionless contact for the tests: R = d = E* = 1, so that a₀ = 1 and K = kE*d/a₀ = k.

#![allow(dead_code, reason = "not every file of tests needs all of it")]

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_4;
use std::fmt::Display;
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, OnceLock};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crate::closed_forms::cattaneo_mindlin::CattaneoMindlin;
use crate::closed_forms::dual_oscillation::{DualOscillation, Frequencies};
use crate::closed_forms::limiting_profile::LimitingProfile;
use crate::closed_forms::partial_slip::stiffness_ratio;
use mdr_tui::contact::indenter::Indenter;
use mdr_tui::contact::material::Material;
use mdr_tui::math::abel::AbelMethod;
use mdr_tui::math::geometry::Geometry;
use mdr_tui::math::grid::RadialGrid;
use mdr_tui::plot::Marker;
use mdr_tui::plot::theme::{Look, Theme};
use mdr_tui::scenario::session::Session;
use mdr_tui::scenario::{Change, Scenario, preset};
use mdr_tui::simulation::drive::{Control, Drive, Oscillation};
use mdr_tui::simulation::{Integrator, Scheme, Setup, Simulation, Spacing, Stability};
use mdr_tui::studies::refinement::resolve_soon;
use mdr_tui::tui::ScriptStep;
use mdr_tui::tui::app::App;
use mdr_tui::tui::event::Event;
use mdr_tui::tui::frame::Frame;
use mdr_tui::tui::keys::parse_script;
use mdr_tui::tui::worker::{Order, Orders, Worker};
use mdr_tui::wear::WearLaw;
use ratatui::layout::Size;

use crate::hostile::fuzzed::rehearse;
use crate::test_dir::fits;

/// The methods of the paper and its reference 9.
pub const PUBLISHED: [AbelMethod; 4] = [
    AbelMethod::A,
    AbelMethod::APlusB,
    AbelMethod::B,
    AbelMethod::Benad,
];

/// The parts of a run as plain values; a test names only what differs from the default.
#[derive(Debug, Clone)]
pub struct Scene {
    pub method: AbelMethod,
    pub cells: usize,
    pub domain: f64,
    pub indenter: Indenter,
    pub modulus: f64,
    pub poisson: f64,
    pub friction: f64,
    pub normal: Control,
    pub tangential: Option<Control>,
    pub law: Option<WearLaw>,
    pub steps: u32,
}

impl Default for Scene {
    /// Depth 1 held, amplitude 0.05, μ = 0.1, ν = 0.3, N = 100 over 1.5 a₀, 40 steps a cycle, no
    /// wear: the contact of the comparison of methods.
    fn default() -> Self {
        Self {
            method: AbelMethod::A,
            cells: 100,
            domain: 1.5,
            indenter: Indenter::paraboloid(1.0).expect("an indenter"),
            modulus: 1.0,
            poisson: 0.3,
            friction: 0.1,
            normal: swing(1.0, 0.0, 1.0, 0.0),
            tangential: Some(swing(0.0, 0.05, 1.0, 0.0)),
            law: None,
            steps: 40,
        }
    }
}

/// A way to set each part that most scenes differ in.
macro_rules! parts {
    ($($part:ident: $type:ty),* $(,)?) => {
        $(pub fn $part(self, $part: $type) -> Self {
            Self { $part, ..self }
        })*
    };
}

impl Scene {
    parts!(
        method: AbelMethod,
        cells: usize,
        steps: u32,
        friction: f64,
        poisson: f64,
        domain: f64,
        modulus: f64,
        indenter: Indenter,
        normal: Control,
    );

    /// The default scene by a method.
    pub fn by(method: AbelMethod) -> Self {
        Self::default().method(method)
    }

    /// With Archard's wear.
    pub fn wear(self, coefficient: f64) -> Self {
        Self {
            law: archard(coefficient),
            ..self
        }
    }

    /// Moved sideways.
    pub fn moved(self, motion: Control) -> Self {
        Self {
            tangential: Some(motion),
            ..self
        }
    }

    /// Moved to and fro by an amplitude.
    pub fn shaken(self, amplitude: f64) -> Self {
        self.moved(swing(0.0, amplitude, 1.0, 0.0))
    }

    /// Not moved sideways at all.
    pub fn still(self) -> Self {
        Self {
            tangential: None,
            ..self
        }
    }

    /// Fig. 3 of the paper at a wear number K, on the default domain.
    pub fn fig3(wear_number: f64) -> Self {
        Self::default()
            .normal(swing(1.0, 0.1, 1.0, 0.0))
            .moved(swing(0.0, 0.1, 1.0, FRAC_PI_4))
            .wear(wear_number)
    }
}

impl From<Scene> for Setup {
    fn from(scene: Scene) -> Self {
        Self {
            grid: RadialGrid::uniform(scene.cells, scene.domain).expect("a grid"),
            material: Material::new(scene.modulus, scene.poisson, scene.friction)
                .expect("a material"),
            indenter: scene.indenter,
            geometry: Geometry::Round,
            drive: Drive::new(scene.normal, scene.tangential),
            wear: scene.law,
            method: scene.method,
            spacing: Spacing::Uniform,
            scheme: Scheme::Euler,
            stability: Stability::Off,
            running_in: None,
            scar: None,
            hardness: None,
            steps_per_cycle: scene.steps,
            integrator: Integrator::Direct,
        }
    }
}

/// The scene with the default numerics in place of the paper's.
pub fn ours(scene: Scene) -> Setup {
    Setup {
        method: AbelMethod::Product,
        spacing: Spacing::Graded,
        scheme: Scheme::Trapezoid,
        stability: Stability::SubStep,
        ..Setup::from(scene)
    }
}

/// The setup by a method with the numerics that its paper has.
pub fn as_published(method: AbelMethod, setup: Setup) -> Setup {
    Setup {
        method,
        spacing: Spacing::Uniform,
        scheme: Scheme::Euler,
        ..setup
    }
}

/// The setup with this many steps per cycle.
pub fn in_steps(steps_per_cycle: u32, setup: Setup) -> Setup {
    Setup {
        steps_per_cycle,
        ..setup
    }
}

/// Partial slip of the default scene at an amplitude.
pub fn cattaneo(amplitude: f64) -> CattaneoMindlin {
    CattaneoMindlin {
        e_star: 1.0,
        g_star: stiffness_ratio(0.3),
        mu: 0.1,
        radius: 1.0,
        depth: 1.0,
        amplitude,
    }
}

/// What endless fretting of the default scene leaves outside of a stick radius.
pub fn limit(stick_radius: f64) -> LimitingProfile {
    LimitingProfile {
        e_star: 1.0,
        radius: 1.0,
        depth: 1.0,
        stick_radius,
    }
}

/// The motion of Fig. 3 in the default scene.
pub fn fig3_motion() -> DualOscillation {
    DualOscillation {
        e_star: 1.0,
        g_star: stiffness_ratio(0.3),
        mu: 0.1,
        depth: 1.0,
        normal_amplitude: 0.1,
        normal_phase: 0.0,
        tangential_amplitude: 0.1,
        tangential_phase: FRAC_PI_4,
        frequencies: Frequencies::Equal,
    }
}

/// The root of the mean square.
pub fn rms(differences: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = differences.fold((0.0, 0.0), |(sum, count), e| (sum + e * e, count + 1.0));
    f64::sqrt(sum / count)
}

/// The largest size of some errors; NaN stays.
pub fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    let worse = |worst: f64, e: f64| {
        if e.abs() > worst || e.is_nan() {
            e.abs()
        } else {
            worst
        }
    };
    errors.into_iter().fold(0.0, worse)
}

/// The largest difference of two lists.
pub fn apart(one: &[f64], other: &[f64]) -> f64 {
    largest(one.iter().zip(other).map(|(a, b)| a - b))
}

/// Fails unless a number is the expected one but for a share of it.
#[track_caller]
pub fn near(what: impl Display, found: f64, expected: f64, share: f64) {
    holds(what, (found / expected - 1.0).abs(), share);
}

/// A prescribed displacement mean + amplitude · sin(ωt + φ).
pub fn swing(mean: f64, amplitude: f64, frequency: f64, phase: f64) -> Control {
    Control::Displacement(Oscillation::new(mean, amplitude, frequency, phase).expect("a motion"))
}

/// A prescribed force mean + amplitude · sin(ωt).
pub fn force(mean: f64, amplitude: f64) -> Control {
    Control::Force(Oscillation::new(mean, amplitude, 1.0, 0.0).expect("a force"))
}

/// Archard's law.
pub fn archard(coefficient: f64) -> Option<WearLaw> {
    Some(WearLaw::archard(coefficient).expect("a law"))
}

/// The contact after `cycles`; a breakdown fails the test.
pub fn run(scene: Scene, cycles: f64) -> Simulation {
    run_setup(scene.into(), cycles)
}

/// The contact of a whole setup after `cycles`; long runs that several tests ask for are made once.
pub fn run_setup(setup: Setup, cycles: f64) -> Simulation {
    static RUNS: Mutex<BTreeMap<String, Arc<OnceLock<Simulation>>>> = Mutex::new(BTreeMap::new());
    if cycles < 100.0 {
        return run_anew(setup, cycles);
    }
    let key = format!("{cycles} {setup:?}");
    let cell = RUNS
        .lock()
        .expect("no panic")
        .entry(key)
        .or_default()
        .clone();
    cell.get_or_init(|| run_anew(setup, cycles)).clone()
}

fn run_anew(setup: Setup, cycles: f64) -> Simulation {
    let mut simulation = Simulation::new(setup).expect("a contact");
    simulation.advance_to(cycles).expect("a run to the end");
    simulation
}

/// A preset or a file with `sets`, or the line that refuses it.
pub fn try_load(name: &str, sets: &[&str]) -> Result<Scenario, String> {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    Scenario::load(name, &sets).map_err(|error| error.to_string())
}

/// A preset or a file with `sets`, which must be a scenario.
#[track_caller]
pub fn load(name: &str, sets: &[&str]) -> Scenario {
    try_load(name, sets).unwrap_or_else(|error| panic!("{error}"))
}

/// The scenario at its start.
#[track_caller]
pub fn begin(scenario: Scenario) -> Session {
    Session::start(scenario).expect("a contact")
}

/// The scenario after `cycles`; a breakdown fails the test.
#[track_caller]
pub fn ran(scenario: Scenario, cycles: f64) -> Session {
    let mut session = begin(scenario);
    session.advance_to(cycles).expect("a run to the end");
    session
}

/// Changes a key of a session, which must take it.
#[track_caller]
pub fn change(session: &mut Session, key: &str, value: &str) {
    session.assign(&[(key, value)]).expect("a change");
}

/// Returns the error of a change that a session refuses.
#[track_caller]
pub fn refused(session: &mut Session, key: &str, value: &str) -> String {
    let refusal = session.assign(&[(key, value)]);
    refusal.expect_err("a refusal").to_string()
}

/// V of a session.
pub fn volume(session: &Session) -> f64 {
    session.simulation().wear_volume()
}

/// E_d of a session.
pub fn energy(session: &Session) -> f64 {
    session.simulation().moment().dissipated_energy
}

/// Reads a scenario back from its own text.
#[track_caller]
pub fn again(scenario: &Scenario) -> Scenario {
    let text = scenario.to_toml();
    Scenario::from_toml(&text, scenario.origin(), &[])
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The text of a preset.
pub fn text_of(preset: &str) -> &'static str {
    preset::find(preset).expect("a preset").text
}

/// Fails unless `error` is at most `bound` (so NaN fails); the numbers are printed.
#[track_caller]
pub fn holds(what: impl Display, error: f64, bound: f64) {
    eprintln!("{what}: {error:.3e} of {bound:.3e}");
    assert!(error <= bound, "{what}: {error:e} exceeds {bound:e}");
}

/// Fig. 3 over some cycles, without a word on how finely it is computed.
pub fn without_numerics(cycles: f64) -> Scenario {
    let (parts, _) = text_of("li2019-fig3")
        .split_once("[numerics]")
        .expect("numerics");
    let text = format!("{parts}[run]\ncycles = {cycles:e}\n");
    Scenario::from_toml(&text, "without numerics", &[]).expect("a scenario")
}

/// The screen of `size` after `keys` on a preset, as [`TestDir::screen`] has it of a process; the keys must write no file.
///
/// [`TestDir::screen`]: crate::test_dir::TestDir::screen
#[track_caller]
pub fn rehearsed(preset: &str, keys: &str, size: (usize, usize)) -> String {
    rehearsed_on(begin(load(preset, &[])), keys, size)
}

/// [`rehearsed`] on a session.
#[track_caller]
pub fn rehearsed_on(session: Session, keys: &str, size: (usize, usize)) -> String {
    let theme = Theme::new(Look::Dark, Marker::Braille);
    let strokes = ScriptStep::script(keys).expect("a script");
    let area = Size::new(size.0 as u16, size.1 as u16);
    fits(rehearse(session, theme, &strokes, area), size, keys)
}

/// An explorer's worker in a separate thread, which ends with it.
pub struct LiveWorker {
    /// The way to it.
    pub orders: Orders,
    /// What it tells.
    pub events: Receiver<Event>,
    thread: Option<JoinHandle<()>>,
}

impl LiveWorker {
    /// A worker that publishes at most every `interval`.
    pub fn on(scenario: Scenario, interval: Duration, running: bool) -> Self {
        let (orders, to_worker) = Orders::channel();
        let (sender, events) = channel();
        let mut worker = Worker::new(begin(scenario), sender, interval, running);
        Self {
            orders,
            events,
            thread: Some(thread::spawn(move || worker.serve(&to_worker))),
        }
    }
}

impl Drop for LiveWorker {
    fn drop(&mut self) {
        self.orders.send(Order::Quit);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// The explorer on a separate worker, without a terminal and without a process.
pub struct Explorer {
    /// The screen's side.
    pub app: App,
    /// The worker's.
    pub worker: LiveWorker,
}

impl Explorer {
    /// A preset, paused at its start.
    pub fn on(preset: &str, theme: Theme) -> Self {
        let found = resolve_soon(&load(preset, &[])).expect("points and steps");
        let worker = LiveWorker::on(found.scenario, Duration::from_secs(1), false);
        let frame = worker.orders.frame().expect("a worker");
        let app = App::new(theme, worker.orders.clone(), frame);
        Self { app, worker }
    }

    /// The worker's present frame.
    pub fn frame(&self) -> Arc<Frame> {
        self.worker.orders.frame().expect("a worker")
    }

    /// Presses keys, each when the worker has answered the one before.
    pub fn press(&mut self, keys: &str) {
        for key in parse_script(keys).expect("a script") {
            self.app.press(key);
            self.app.explorer.show_frame(self.frame());
            for event in self.worker.events.try_iter() {
                if let Event::Notice(text) = event {
                    self.app.explorer.notice = Some(text);
                }
            }
        }
    }
}

/// A change of `key` to `value`, TOML or a bare word.
pub fn planned(at_cycle: f64, key: &str, value: &str) -> Change {
    Change::parse(at_cycle, &format!("{key} = {value}")).expect("a change")
}
