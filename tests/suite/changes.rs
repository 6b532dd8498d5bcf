//! Changes during a run: wear is never lost, and the changes of one cycle are made together.

use mdr_tui::scenario::Scenario;
use mdr_tui::scenario::checkpoint;

use crate::common::{again, begin, change, holds, load, near, planned, ran, refused, volume};
use crate::test_dir::{has, lacks};

/// Fig. 3 of the paper with `changes`, KEY = VALUE at a cycle.
fn figure(sets: &[&str], changes: &[(f64, &str, &str)]) -> Scenario {
    let changes = changes
        .iter()
        .map(|&(at, key, value)| planned(at, key, value))
        .collect();
    load("li2019-fig3", sets).with_changes(changes)
}

/// The scar of 1.45 a₀ lies outside of what can touch at a fifth of the depth.
#[test]
fn a_shallower_contact_keeps_the_scar_of_a_deeper_one() {
    for grid in ["graded", "uniform"] {
        let grid = format!("numerics.grid=\"{grid}\"");
        let changes = [
            (5.0, "motion.normal.mean", "2e-7"),
            (10.0, "motion.normal.mean", "1e-6"),
        ];
        let mut session = begin(figure(&[&grid], &changes));
        let mut before = 0.0;
        for cycle in [4.9999, 5.0, 5.0001, 9.9999, 10.0, 10.0001, 12.0] {
            session.advance_to(cycle).expect("a contact");
            let now = volume(&session);
            let is_kept = now >= before * (1.0 - 2e-3);
            assert!(is_kept, "{grid}, cycle {cycle}: {before:e} -> {now:e}");
            before = now;
        }
        let direct = ran(figure(&[&grid], &[]), 5.0);
        assert!(before > 1.2 * volume(&direct), "{grid}");
        // The books of the energy balance bridge the change of nodes.
        let residual = session.log().period_residual().expect("wear");
        holds(&grid, residual.abs(), 2e-3);
    }
}

#[test]
fn a_domain_that_would_cut_wear_off_is_refused() {
    let mut session = begin(figure(&[], &[]));
    session.advance_to(3.0).expect("a contact");
    let before = (volume(&session), session.simulation().state().clone());
    let told = refused(&mut session, "numerics.domain_radius", "5e-5");
    has(&told, "cut off wear, which reaches");
    has(&told, "numerics.domain_radius");
    lacks(&told, "\n");
    let shape = [
        ("indenter.shape", "flat-punch"),
        ("indenter.radius", "5e-5"),
    ];
    let told = session.assign(&shape).expect_err("too small");
    has(&told.to_string(), "cut off wear");
    let after = (volume(&session), session.simulation().state().clone());
    assert_eq!(after, before);
    assert!(session.changes().is_empty());
}

/// Few cells say another volume than many: a little is booked, a lot is refused.
#[test]
fn a_grid_too_coarse_for_the_scar_is_refused() {
    let mut session = begin(figure(&[], &[]));
    session.advance_to(20.0).expect("a contact");
    let before = volume(&session);
    change(&mut session, "numerics.points", "60");
    near("volume", volume(&session), before, 5e-3);
    let told = refused(&mut session, "numerics.points", "4");
    has(&told, "too few for the worn profile");
    assert_eq!(session.simulation().setup().grid.cells(), 60);
}

/// In either order: a control and the force that it is to hold are one change.
#[test]
fn changes_of_one_cycle_are_made_together() {
    let keys = [
        ("motion.normal.control", "\"force\""),
        ("motion.normal.mean", "30.0"),
        ("motion.normal.amplitude", "3.0"),
    ];
    let run = |order: [usize; 3]| {
        let changes = order.map(|i| (5.0, keys[i].0, keys[i].1));
        let mut session = begin(again(&figure(&[], &changes)));
        session.advance_to(4.999).expect("a contact");
        let before = volume(&session);
        session.advance_to(6.0).expect("a contact");
        let after = volume(&session);
        assert!(after > before, "{before:e} -> {after:e}");
        assert_eq!(session.changes().len(), 3);
        session
    };
    let (first, second) = (run([0, 1, 2]), run([2, 1, 0]));
    assert_eq!(first.simulation().state(), second.simulation().state());
    let force = first.simulation().moment().normal_force;
    assert!((27.0..=33.0).contains(&force), "{force} N");
}

#[test]
fn a_control_without_values_in_its_unit_is_refused() {
    let text = figure(&[], &[(5.0, "motion.normal.control", "\"force\"")]).to_toml();
    let told = Scenario::from_toml(&text, "a.toml", &[]).expect_err("metres as newtons");
    assert_eq!(
        told.to_string(),
        "a.toml: changes[0].set = \"motion.normal.control = \"force\"\": \
         needs motion.normal.mean in N, changed at the same cycle"
    );
    let mut session = begin(figure(&[], &[]));
    let told = refused(&mut session, "motion.tangential.control", "force");
    let needs = "needs motion.tangential.amplitude in N, changed at the same cycle";
    assert!(told.ends_with(needs), "{told}");
    let both = [
        ("motion.tangential.control", "force"),
        ("motion.tangential.amplitude", "0.5"),
    ];
    session.assign(&both).expect("newtons");
    // What stands there already needs no values.
    change(&mut session, "motion.normal.control", "displacement");
}

/// A change that is taken back at the same cycle leaves no trace, and what was done by hand is replayed
/// to the bit, also from a checkpoint between two changes.
#[test]
fn what_was_changed_by_hand_is_replayed_to_the_bit() {
    let mut session = begin(figure(&[], &[]));
    session.advance_to(2.5).expect("a contact");
    let untouched = session.simulation().state().wear.clone();
    change(&mut session, "numerics.points", "30");
    let kept = checkpoint::encode::<()>(&session, None);
    let kept = checkpoint::decode::<()>(&kept[..], "kept").expect("a checkpoint");
    let mut resumed = kept.session;
    for session in [&mut session, &mut resumed] {
        change(session, "numerics.points", "100");
        assert_eq!(session.simulation().state().wear, untouched);
        change(session, "friction.coefficient", "0.12");
        session.advance_to(4.0).expect("a contact");
    }
    assert_eq!(session.simulation().state(), resumed.simulation().state());
    let again = ran(again(&session.as_run(Vec::new())), 4.0);
    assert_eq!(again.simulation().state(), session.simulation().state());
}
