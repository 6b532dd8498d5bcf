//! Hostile input: what the fuzz targets check, on mutations that are made up anew each time; sizes
//! that are refused before they cost anything; and text that would do something to a terminal.

#[path = "../fuzz/src/lib.rs"]
pub mod fuzzed;

use mdr_tui::scenario::preset;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::common::text_of;
use crate::test_dir::{TestDir, bits, end, has, names};

/// A preset with some of its characters replaced, doubled or left out.
fn bent_preset() -> impl Strategy<Value = String> {
    let edits = vec(
        (any::<prop::sample::Index>(), 0..4_u8, any::<char>()),
        0..12,
    );
    (0..preset::ALL.len(), edits).prop_map(|(preset, edits)| {
        let mut text: Vec<char> = preset::ALL[preset].text.chars().collect();
        for (at, kind, other) in edits {
            let at = at.index(text.len());
            match kind {
                0 => text[at] = other,
                1 => text.insert(at, other),
                2 => drop(text.remove(at)),
                _ => {
                    text[at] = "0123456789-.e=\"[]#\n"
                        .chars()
                        .nth(other as usize % 19)
                        .unwrap_or('0')
                }
            }
        }
        text.into_iter().collect()
    })
}

/// An assignment that begins like a right one.
fn assignment() -> impl Strategy<Value = String> {
    const KEYS: &[&str] = &[
        "numerics.points",
        "numerics.steps_per_cycle",
        "indenter.radius",
        "wear",
        "wear.coefficient",
        "motion.normal.mean",
        "motion.tangential.phase",
        "run.snapshot_at",
        "changes",
        "title",
        "",
    ];
    let number = any::<f64>().prop_map(|number| number.to_string());
    let value = prop_oneof![number, "[-\\[\\]{}\"'.,=#\\PC]{0,20}", any::<String>()];
    (prop::sample::select(KEYS), value).prop_map(|(key, value)| format!("{key}={value}"))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..Default::default() })]

    #[test]
    fn bent_scenarios_are_refused_in_a_line_or_run(text in bent_preset()) {
        fuzzed::scenario(&text);
    }

    #[test]
    fn any_assignment_is_refused_in_a_line_or_made(text in assignment()) {
        fuzzed::set(&text);
    }

    #[test]
    fn any_script_is_refused_in_a_line_or_played(text in "(<[A-Za-z-]{0,5}>?|\\PC|[a-z?])*") {
        fuzzed::keys(&text);
    }

    #[test]
    fn bent_checkpoints_are_refused_in_a_line_or_go_on(bytes in vec(any::<u8>(), 0..24)) {
        fuzzed::checkpoint(&bytes);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..Default::default() })]

    #[test]
    fn any_sequence_of_keys_is_a_session(bytes in vec(any::<u8>(), 0..60)) {
        fuzzed::session(&bytes);
    }
}

/// Everything a terminal would act on.
const RUDE: &str = "\u{1b}[31mred\u{7}\r\n\u{9b}2J\u{202e}back\u{0}";

fn assert_harmless(text: &str, what: &str) {
    let rude = |c: char| (c.is_control() && c != '\n') || ('\u{202a}'..='\u{202e}').contains(&c);
    assert!(!text.contains(rude), "{what}: {text:?}");
}

#[test]
fn a_rude_title_reaches_no_terminal() {
    let dir = TestDir::new();
    let escaped: String = RUDE
        .chars()
        .map(|c| format!("\\U{:08x}", c as u32))
        .collect();
    // TOML knows no escape of the null character that it would take.
    let escaped = escaped.replace("\\U00000000", "");
    let is_other = |line: &&str| !line.starts_with("title") && !line.starts_with("desc");
    let lines: Vec<&str> = text_of("li2019-fig3").lines().filter(is_other).collect();
    let lines = lines.join("\n");
    let text = format!("title = \"{escaped}\"\ndescription = \"{escaped}\"\n{lines}");
    dir.write("rude.toml", text.as_bytes());
    let said = end(dir.start("run rude.toml --cycles 1 --out x", &[]));
    assert_eq!(said.code, 0, "{}", said.err);
    assert_harmless(&said.out, "summary");
    for name in names(&dir.path("x")) {
        assert_harmless(&dir.read(&format!("x/{name}")), &name);
    }
    let state = dir.table("x/state.csv");
    has(state.header("scenario"), "red");
    assert_eq!((state.columns.len(), state.rows[0].len()), (13, 13));
    assert_eq!(bits(&state.column("r_m"))[0], 0);
    let json = dir.done("run rude.toml --cycles 1 --json --out y");
    assert_harmless(&json, "json");
    for keys in ["", "?", "a", "s", "p"] {
        let arguments = ["rude.toml", "--print", "120x30", "--keys", keys];
        let said = dir.say(&arguments);
        assert_eq!(said.code, 0, "{}", said.err);
        assert_harmless(&said.out, keys);
    }
}

#[test]
fn rude_paths_and_arguments_reach_no_terminal() {
    let dir = TestDir::new();
    let rude = RUDE.replace(['\0', '\n'], "");
    let rude = rude.as_str();
    let path = format!("{rude}.toml");
    dir.write(&path, b"title = 1\n");
    let checkpoint = format!("{rude}.checkpoint");
    dir.write(&checkpoint, b"mdr-tui checkpoint 1\n");
    let set = format!("numerics.points={rude}");
    let key = format!("{rude}=1");
    for arguments in [
        vec!["run", &path],
        vec!["run", rude],
        vec![rude],
        vec!["run", "--resume", &checkpoint],
        vec!["--resume", rude],
        vec!["run", "hertz", "--set", &set],
        vec!["run", "hertz", "--set", &key],
        vec!["run", "hertz", "--cycles", rude],
        vec!["run", "hertz", "--snapshot-at", rude],
        vec!["run", "hertz", "--checkpoint-every", rude],
        vec!["presets", rude],
        vec!["verify", "--problem", rude],
        vec!["completions", rude],
        vec!["--keys", rude, "--print", "80x24"],
        vec!["--print", rude],
        vec!["--marker", rude],
        vec![rude, rude],
    ] {
        assert_harmless(&dir.refuse(&arguments, ""), &format!("{arguments:?}"));
    }
    // A directory of that name is written to, and told of, without harm.
    let said = dir.say(&["run", "hertz", "--cycles", "0.1", "--out", rude]);
    assert_eq!(said.code, 0, "{}", said.err);
    assert_harmless(&(said.out + &said.err), "--out");
}
