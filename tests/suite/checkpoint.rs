//! A run that is saved and resumed is bit-identical to an uninterrupted one.

use std::fs;
use std::path::Path;

use ciborium::Value;
use mdr_tui::export::history::History;
use mdr_tui::export::state;
use mdr_tui::scenario::checkpoint::{SHAPES, VERSION, decode, encode, sealed};
use mdr_tui::scenario::preset;
use mdr_tui::scenario::session::Session;
use mdr_tui::simulation::Simulation;

use crate::common::{apart, begin, change, holds, largest, load, ran, run_setup};
use crate::test_dir::{TestDir, has};

fn session(preset: &str, sets: &[&str]) -> Session {
    begin(load(preset, sets))
}

/// Through a file's bytes and back.
fn through_a_file(session: &Session) -> Session {
    let bytes = encode(session, None::<&()>);
    let kept = decode::<()>(&bytes[..], "a file").expect("a checkpoint");
    // What has been taken up is put away alike.
    assert!(encode(&kept.session, None::<&()>) == bytes);
    kept.session
}

/// Everything that a user can see of a session.
fn seen(session: &Session) -> String {
    let mut history = Vec::new();
    let written = History::default().write(session, Path::new(""), &mut history);
    written.expect("memory");
    let run = session.as_run(Vec::new());
    format!(
        "{}{}{}{:?}",
        state::table(session),
        String::from_utf8_lossy(&history),
        run.to_toml(),
        session.simulation().next_moment().to_bits()
    )
}

/// Steps `straight` and a copy that is put away before every `every`th step; they must stay one.
fn follow(mut straight: Session, steps: usize, every: usize, what: &str) -> Session {
    let mut broken = through_a_file(&straight);
    for step in 0..steps {
        let states = [&straight, &broken].map(|session| session.simulation().state());
        assert!(states[0] == states[1], "{what}: step {step}");
        if step % every == 0 {
            assert!(seen(&straight) == seen(&broken), "{what}: step {step}");
            broken = through_a_file(&broken);
            let is_same = seen(&straight) == seen(&broken);
            assert!(is_same, "{what}: saved at {step}");
        }
        let [one, other] = [&mut straight, &mut broken].map(|session| {
            session
                .step_until(f64::INFINITY)
                .map_err(|error| error.to_string())
        });
        assert_eq!(one, other, "{what}: step {step}");
    }
    assert!(seen(&straight) == seen(&broken), "{what}");
    straight
}

#[test]
fn every_kind_of_run_goes_on_as_if_nothing_had_been() {
    for preset in preset::ALL {
        let start = session(preset.name, &["numerics.points=40"]);
        follow(start, 130, 7, preset.name);
    }
    let fig3 = |sets: &[&str], [steps, every]: [usize; 2]| {
        follow(session("li2019-fig3", sets), steps, every, sets[0])
    };
    // Stiff steps are split.
    fig3(&["wear.coefficient=4e-8", "numerics.points=60"], [90, 7]);
    let mild = ["wear.coefficient=1e-12", "numerics.points=40"];
    let jumped = fig3(
        &["numerics.integrator=cycle-jump", mild[0], mild[1]],
        [140, 3],
    );
    assert!(jumped.simulation().state().stats.jumps > 3);
    // The volume that the scar brought and the moment at which the hardness was exceeded are saved as well.
    let worn = fig3(
        &[
            "wear.initial_radii=[0, 4e-5, 8e-5, 1.1e-4]",
            "wear.initial_depths=[0, 1e-8, 2e-8, 0]",
            "material.hardness=1.56e9",
            "wear.share=0.4",
            "numerics.points=30",
            "numerics.steps_per_cycle=20",
        ],
        [30, 7],
    );
    let passed = worn.log().passed_hardness().expect("passed");
    assert!(passed.cycle > 0.0 && passed.cycle < worn.simulation().cycle());
    let moment = worn.simulation().moment();
    assert!(moment.initial_volume > 0.0 && moment.wear_volume > moment.initial_volume);
}

#[test]
fn every_method_scheme_and_grid_goes_on_as_if_nothing_had_been() {
    for method in ["product", "a", "a+b", "b", "benad"] {
        for scheme in ["euler", "trapezoid"] {
            for grid in ["graded", "uniform"] {
                let words = [("method", method), ("scheme", scheme), ("grid", grid)];
                let sets = words.map(|(key, word)| format!("numerics.{key}={word}"));
                let sets = ["numerics.points=30", &sets[0], &sets[1], &sets[2]];
                follow(session("li2019-fig3", &sets), 110, 9, &sets.join(" "));
            }
        }
    }
}

#[test]
fn a_run_with_changes_goes_on_as_if_nothing_had_been() {
    let mut session = session("li2019-fig3", &["numerics.points=40"]);
    for (key, value) in [
        ("numerics.method", "b"),
        ("wear.law", "power"),
        ("numerics.points", "57"),
        ("motion.tangential.amplitude", "2e-7"),
        ("numerics.method", "product"),
        ("friction.coefficient", "0.25"),
        ("numerics.grid", "uniform"),
        ("wear.law", "archard"),
        ("material.effective_modulus", "1.9e11"),
        ("numerics.grid", "graded"),
    ] {
        session = follow(session, 37, 5, key);
        change(&mut session, key, value);
        let again = through_a_file(&session);
        assert_eq!(again.changes(), session.changes());
        assert_eq!(again.loaded(), session.loaded());
        assert_eq!(again.scenario(), session.scenario());
    }
    follow(session, 120, 11, "all changes");
}

#[test]
fn changes_that_are_still_to_come_come() {
    let mut first = session("li2019-fig3", &["numerics.points=30"]);
    first.advance_to(0.5).expect("half a cycle");
    change(&mut first, "numerics.method", "a");
    first.advance_to(1.25).expect("a cycle");
    change(&mut first, "wear.law", "power");
    let planned = begin(first.as_run(Vec::new()));
    let end = follow(planned, 180, 10, "planned changes");
    assert_eq!(end.changes(), first.changes());
}

/// The checkpoint of a run on few cells, a part of a cycle on.
fn small() -> Vec<u8> {
    let session = ran(load("li2019-fig3", &["numerics.points=8"]), 0.31);
    encode(&session, None::<&()>)
}

/// Takes one value off every list of the saved state in turn: none of them may be believed.
#[test]
fn a_state_of_another_length_is_refused() {
    let whole = small();
    let contents = {
        let mut ends = whole.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
        let start = ends.nth(2).expect("three lines").0 + 1;
        &whole[start..]
    };
    let body: Value = ciborium::from_reader(contents).expect("CBOR");
    let mut lists = 0;
    loop {
        let (mut bent, mut left) = (body.clone(), lists);
        if !shorten(&mut bent, &mut left, false) {
            break;
        }
        lists += 1;
        let mut contents = b"\n".to_vec();
        ciborium::into_writer(&bent, &mut contents).expect("CBOR");
        refusal(&sealed(&contents));
    }
    // Nodes, wear, springs, holds, and what the last step left.
    assert!(lists >= 8, "{lists} lists");
}

/// Shortens the list of the state that comes after `left` others; false if there is none.
fn shorten(value: &mut Value, left: &mut usize, inside: bool) -> bool {
    match value {
        Value::Map(fields) => fields.iter_mut().any(|(key, value)| {
            let inside = inside || matches!(key.as_text(), Some("state" | "nodes"));
            shorten(value, left, inside)
        }),
        // Lists of maps are breaks, of which there can be any number.
        Value::Array(list) if inside && list.len() > 2 && !list[0].is_map() => {
            let found = *left == 0;
            *left = left.wrapping_sub(1);
            if found {
                list.pop();
            }
            found
        }
        _ => false,
    }
}

/// Replaces every saved number in turn by extreme values: each is refused in one line, or the run continues.
#[test]
fn no_saved_number_is_believed() {
    let session = ran(load("li2019-fig3", &["numerics.points=4"]), 0.31);
    let whole = encode(&session, None::<&()>);
    let start = whole.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
    let start = start.map(|(at, _)| at + 1).nth(2).expect("three lines");
    let body: Value = ciborium::from_reader(&whole[start..]).expect("CBOR");
    let (mut place, mut refused) = (0, 0);
    loop {
        let mut bent = body.clone();
        let mut left = place;
        if !bend(&mut bent, &mut left, place) {
            break;
        }
        place += 1;
        let mut contents = b"\n".to_vec();
        ciborium::into_writer(&bent, &mut contents).expect("CBOR");
        match decode::<()>(&sealed(&contents)[..], "x.checkpoint") {
            Ok(kept) => {
                let mut session = kept.session;
                for _ in 0..2 {
                    let _ = session.step_until(session.simulation().cycle() + 0.01);
                }
                seen(&session);
            }
            Err(error) => {
                refused += 1;
                assert_eq!(error.to_string().lines().count(), 1, "{error}");
            }
        }
    }
    assert!(place > 80 && refused > 20, "{refused} of {place}");
}

/// Replaces the number that comes after `left` others by an extreme value; false if there is no such number.
fn bend(value: &mut Value, left: &mut usize, which: usize) -> bool {
    let extreme = match value {
        Value::Map(fields) => {
            return fields.iter_mut().any(|(_, value)| bend(value, left, which));
        }
        Value::Array(list) => return list.iter_mut().any(|value| bend(value, left, which)),
        Value::Integer(_) => Value::from([u64::MAX, 1 << 40, u64::MAX - 1][which % 3]),
        Value::Float(_) => Value::from([f64::NAN, f64::INFINITY, -1.0, 1e300][which % 4]),
        _ => return false,
    };
    let found = *left == 0;
    *left = left.wrapping_sub(1);
    if found {
        *value = extreme;
    }
    found
}

/// Returns the refusals of a file of another kind and of an incomplete one.
const FOREIGN: &str = "is not a checkpoint of mdr-tui";
const TORN: &str = "is damaged: ";

fn refusal(bytes: &[u8]) -> String {
    let Err(error) = decode::<()>(bytes, "x.checkpoint") else {
        panic!("no refusal");
    };
    let line = error.to_string();
    assert!(line.starts_with("x.checkpoint: "), "{line}");
    assert!(!line.chars().any(char::is_control), "{line:?}");
    line
}

#[test]
fn a_torn_file_is_told_from_a_whole_one() {
    let whole = small();
    for length in 0..whole.len() {
        let error = refusal(&whole[..length]);
        let early = length < "mdr-tui checkpoint ".len();
        assert_eq!(error.contains(FOREIGN), early, "{length}: {error}");
        assert_eq!(error.contains(TORN), !early, "{length}: {error}");
    }
    for at in 0..whole.len() {
        let mut bent = whole.clone();
        bent[at] ^= 0x10;
        refusal(&bent);
    }
    let longer = [&whole[..], b"x"].concat();
    assert!(refusal(&longer).contains(TORN));
}

#[test]
fn what_is_no_checkpoint_of_this_version_is_refused() {
    let whole = encode(&session("hertz", &["numerics.points=8"]), None::<&()>);
    let body = whole.splitn(2, |&byte| byte == b'\n').nth(1);
    let body = body.expect("a body");
    let other = [b"mdr-tui checkpoint 7\n", body].concat();
    let program = env!("CARGO_PKG_VERSION");
    let due = format!(
        "x.checkpoint: is a checkpoint of version 7, written by mdr-tui {program}; \
         this mdr-tui ({program}) reads version {VERSION}"
    );
    assert_eq!(refusal(&other), due);
    let rude = [b"mdr-tui checkpoint \x1b[31m1\n", body].concat();
    assert!(refusal(&rude).contains("is a checkpoint of version"));
    for bytes in [&b""[..], b"title = \"x\"\n", &[0; 4096], b"\xff\xfe"] {
        assert!(refusal(bytes).contains(FOREIGN));
    }
    let huge = format!("mdr-tui checkpoint {VERSION}\n99999999999999 bytes, CRC-32 00000000\nx");
    has(&refusal(huge.as_bytes()), "larger than 4 GiB");
}

/// Whatever is added to a checkpoint, to the columns of a history or to the state of a run needs a new version: programs
/// of before would refuse it for a reason that tells a user nothing, or take it for something else.
#[test]
fn the_version_rises_with_the_shape_of_what_is_saved() {
    let mut session = session(
        "li2019-fig3",
        &[
            "numerics.integrator=cycle-jump",
            "wear.coefficient=1e-12",
            "material.hardness=1.56e9",
            "numerics.points=40",
        ],
    );
    session.advance_to(40.0).expect("jumps");
    change(&mut session, "friction.coefficient", "0.2");
    let dir = TestDir::new();
    dir.say(&[
        "run",
        "li2019-fig3",
        "--snapshot-at",
        "1",
        "--budget",
        "0s",
        "--out",
        "x",
    ]);
    let of_run = fs::read(dir.path("x/run.checkpoint")).expect("a checkpoint");
    let shapes = [encode(&session, None::<&()>), of_run].map(|whole| {
        let mut parts = whole.splitn(4, |&byte| byte == b'\n');
        let body: Value = ciborium::from_reader(parts.nth(3).expect("a body")).expect("CBOR");
        shape(&body)
    });
    let found = crc32fast::hash(shapes.concat().as_bytes());
    assert!(
        SHAPES.last() == Some(&(VERSION, found)),
        "what a checkpoint holds has changed: raise VERSION, and add (VERSION, {found:#010x}) to SHAPES\n{shapes:#?}"
    );
    let rises = |pair: &[(u32, u32)]| pair[0].0 < pair[1].0 && pair[0].1 != pair[1].1;
    assert!(SHAPES.windows(2).all(rises));
}

/// The names of all fields and the kinds of their values; of lists, each kind once; the names of columns as they are.
fn shape(value: &Value) -> String {
    match value {
        Value::Map(fields) => {
            let fields = fields.iter().map(|(key, value)| {
                let name = key.as_text().unwrap_or_default();
                let columns = value.as_array().filter(|_| name == "columns");
                let columns = columns.map(|columns| format!("{columns:?}"));
                format!("{name}: {}", columns.unwrap_or_else(|| shape(value)))
            });
            format!("{{{}}}", fields.collect::<Vec<_>>().join(", "))
        }
        Value::Array(list) => {
            let mut kinds: Vec<String> = list.iter().map(shape).collect();
            kinds.sort();
            kinds.dedup();
            format!("[{}]", kinds.join(", "))
        }
        Value::Float(_) | Value::Integer(_) => "number".into(),
        Value::Text(_) => "text".into(),
        other => format!("{other:?}"),
    }
}

/// Fig. 3 under a `method` after so many cycles.
fn fig3(method: &str, cycles: f64) -> Simulation {
    let scenario = load("li2019-fig3", &[&format!("numerics.method={method}")]);
    run_setup(scenario.setup().clone(), cycles)
}

/// The entry of a CBOR map.
fn entry<'a>(value: &'a mut Value, name: &str) -> &'a mut Value {
    let map = value.as_map_mut().expect("a map");
    let entry = map.iter_mut().find(|(key, _)| key.as_text() == Some(name));
    &mut entry.expect("an entry").1
}

#[test]
fn saved_breaks_that_lie_outside_of_the_grid_are_refused() {
    let simulation = fig3("product", 0.3);
    let whole = Value::serialized(&simulation.save()).expect("a value");
    let restored = |saved: Value| {
        let saved = saved.deserialized().expect("a saved run");
        Simulation::restore(simulation.setup().clone(), saved)
    };
    assert!(restored(whole.clone()).is_ok());
    for at in [-1.0, 1.0, f64::NAN, f64::INFINITY] {
        for (breaks, what) in [("spring", "springs' kinks"), ("load", "line load's kinks")] {
            let mut bent = whole.clone();
            let contact = entry(entry(&mut bent, "state"), "contact");
            let breaks = entry(entry(contact, breaks), "kinks").as_array_mut();
            *entry(&mut breaks.expect("a list")[0], "at") = Value::Float(at);
            let refusal = restored(bent).expect_err("a refusal").to_string();
            let due = format!("the saved {what} do not lie in the grid");
            assert_eq!(refusal, due, "{at}");
        }
    }
}

/// What the steps have added up is the image of the wear as a whole.
#[test]
fn the_image_that_steps_add_up_is_that_of_the_wear() {
    for method in ["product", "a", "benad"] {
        let simulation = fig3(method, 20.0);
        let restored = Simulation::resume(simulation.setup().clone(), simulation.state().clone());
        let restored = restored.expect("a run");
        let [one, other] = [&simulation, &restored].map(|run| &*run.state().image);
        let deepest = largest(one.iter().copied());
        assert!(deepest > 0.0);
        holds(method, apart(one, other), 1e-12 * deepest);
    }
}
