//! The finely stepped last period against closed forms, the friction work of the run, and where the run stands.

use crate::closed_forms::partial_slip::stiffness_ratio;
use mdr_tui::simulation::{FinePeriod, Simulation};

use crate::common::{Scene, cattaneo, change, energy, load, near, ours, ran, run_setup};
use crate::test_dir::TestDir;

fn period_of(simulation: &Simulation) -> FinePeriod {
    simulation.fine_period().expect("a period")
}

/// The friction work of the last `cycles` cycles of a preset, J per cycle.
fn work(preset: &str, sets: &[&str], end: f64, cycles: f64) -> f64 {
    let at = |cycle| energy(&ran(load(preset, sets), cycle));
    (at(end) - at(end - cycles)) / cycles
}

/// From next to no slip to gross slip, on few steps and cells: the area of the loop is Cattaneo's and Mindlin's energy,
/// its height their force, and its ends are the motion's.
#[test]
fn the_area_is_the_closed_form_on_any_number_of_steps() {
    let border = 0.1 / stiffness_ratio(0.3);
    for share in [0.02, 0.3, 0.9, 1.05, 4.0] {
        let exact = cattaneo(share * border);
        let mut points = Vec::new();
        for steps in [6, 12, 100] {
            let scene = Scene::default().cells(200).steps(steps).domain(1.2);
            let setup = ours(scene.shaken(share * border));
            let period = period_of(&run_setup(setup, 2.0));
            near(
                share,
                period.energy_per_cycle(),
                exact.energy_per_cycle(),
                1e-3,
            );
            let highest = |of: fn(f64, f64) -> f64| {
                let forces = period.points.iter().map(|point| point.tangential_force);
                forces.fold(0.0, of)
            };
            let force = exact.first_loading_force(share * border);
            near(share, highest(f64::max), force, 1e-3);
            near(share, highest(f64::min), -force, 1e-3);
            points.push(period.points.len());
        }
        assert!(points.iter().all(|&points| points < 1000), "{points:?}");
    }
}

/// Cells, which a run's own error covers, are what is left: on any grid the area is the friction work of the springs.
#[test]
fn the_area_is_the_friction_work_of_the_run() {
    let fine = ["numerics.steps_per_cycle=800", "numerics.points=120"];
    for (preset, sets, cycles) in [
        ("mindlin", &[][..], 1.0),
        ("flat-punch", &[], 1.0),
        ("cone", &[], 1.0),
        ("gross-slip", &[], 1.0),
        ("separation", &[], 1.0),
        ("li2019-fig3", &[], 1.0),
        ("mindlin", &["motion.tangential.rig_stiffness=3e7"], 1.0),
        ("li2019-fig3", &["motion.normal.angular_frequency=150"], 2.0),
        (
            "li2019-fig3",
            &[
                "motion.tangential.control=force",
                "motion.tangential.amplitude=1.2",
            ],
            1.0,
        ),
    ] {
        let no_wear = ["wear.coefficient=0"];
        let wears = load(preset, &[]).setup().wear.is_some();
        let sets = [sets, if wears { &no_wear[..] } else { &[] }].concat();
        let due = work(preset, &[&sets[..], &fine].concat(), 3.0 * cycles, cycles);
        for steps in [
            "numerics.steps_per_cycle=12",
            "numerics.steps_per_cycle=100",
        ] {
            let coarse = [&sets[..], &[steps, "numerics.points=120"]].concat();
            let period = period_of(ran(load(preset, &coarse), 2.0 * cycles).simulation());
            assert_eq!(period.cycles, cycles, "{preset}");
            near(
                format_args!("{preset} {sets:?} {steps}"),
                period.energy_per_cycle(),
                due,
                1e-3,
            );
        }
    }
}

/// The period ends where the run stands, also in the middle of a cycle, and where no period is common to both motions.
#[test]
fn the_period_ends_at_the_present_moment() {
    for (ratio, end) in [
        ("100", 3.0),
        ("100", 2.37),
        ("141.42135", 25.3),
        ("141.42135", 0.6),
    ] {
        let ratio = format!("motion.normal.angular_frequency={ratio}");
        let sets = [
            ratio.as_str(),
            "wear.coefficient=0",
            "numerics.steps_per_cycle=200",
        ];
        let session = ran(load("li2019-fig3", &sets), end);
        let (period, moment) = (
            period_of(session.simulation()),
            session.simulation().moment(),
        );
        let (first, last) = (period.points[0], period.points[period.points.len() - 1]);
        assert!((last.cycle - end).abs() < 1e-9 && (first.cycle - end + 1.0).abs() < 1e-9);
        if end < 1.0 {
            continue;
        }
        near("u_x", last.shift, moment.shift, 1e-9);
        near("F_z", last.normal_force, moment.normal_force, 1e-9);
        near("F_x", last.tangential_force, moment.tangential_force, 2e-3);
    }
}

/// After a jump over cycles it is that of a run which steps them.
#[test]
fn after_a_jump_it_is_the_period_of_a_stepped_run() {
    let sets = ["run.cycles=20000"];
    let mut session = ran(load("mild-million", &sets), 20_000.0);
    let jumped = period_of(session.simulation());
    change(&mut session, "numerics.integrator", "direct");
    session.advance_to(20_002.0).expect("two cycles");
    let stepped = period_of(session.simulation());
    near(
        "E_d",
        jumped.energy_per_cycle(),
        stepped.energy_per_cycle(),
        1e-4,
    );
    near(
        "c",
        jumped.permanent_stick_radius(),
        stepped.permanent_stick_radius(),
        1e-3,
    );
    assert_eq!(jumped.points.len(), stepped.points.len());
}

/// A still contact has none.
#[test]
fn there_is_none_without_tangential_motion() {
    assert!(
        ran(load("hertz", &[]), 1.0)
            .simulation()
            .fine_period()
            .is_none()
    );
}

/// Files of a run that chose its own few steps: the polygon in `loop.csv` has the area of the friction work.
#[test]
fn a_run_leaves_a_loop_whose_area_is_its_energy() {
    let dir = TestDir::new();
    for wear in ["wear.coefficient=1e-12", "wear.coefficient=0"] {
        dir.done(&format!(
            "run li2019-fig3 --set numerics.points=60 --set numerics.steps_per_cycle=12 --set {wear} --cycles 5 --out x --quiet --force"
        ));
        let (last, history) = (dir.table("x/loop.csv"), dir.table("x/history.csv"));
        let (shifts, forces) = (last.column("u_x_m"), last.column("F_x_N"));
        let steps = shifts.windows(2).zip(forces.windows(2));
        let area: f64 = steps
            .map(|(u, force)| 0.5 * (force[0] + force[1]) * (u[1] - u[0]))
            .sum();
        let energies = history.column("energy_per_cycle_J");
        near(wear, area, energies[energies.len() - 1], 3e-3);
    }
}
