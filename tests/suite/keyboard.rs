//! The keyboard in the explorer: reading values, typing commands, editing parameters, going back
//! in time. Keys are played by `--keys`, and the screen comes from `--print`.

use crate::common::{begin, load, rehearsed, rehearsed_on};
use crate::hostile::fuzzed::strokes;
use crate::random::Random;
use crate::random_kinds::words;
use crate::screen_table::{hold, part_of};
use crate::test_dir::{Said, TestDir, has, names};

/// The screen in 80 by 24 after `keys` on a scenario.
fn shot_of(dir: &TestDir, scenario: &str, keys: &str) -> String {
    dir.screen(&[scenario], keys, (80, 24))
}

fn shot(keys: &str) -> String {
    rehearsed("li2019-fig3", keys, (80, 24))
}

fn foot(screen: &str) -> String {
    part_of(screen, "foot")
}

fn body(screen: &str) -> String {
    part_of(screen, "body")
}

#[test]
fn keys_do_what_the_table_says() {
    hold("keyboard", |_| {});
}

/// The number behind `name` in a line of values, in the unit that follows it.
fn value(line: &str, name: &str) -> (f64, String) {
    let words: Vec<&str> = line.split_whitespace().collect();
    let at = words.iter().position(|word| *word == name);
    let at = at.unwrap_or_else(|| panic!("no {name} in {line}"));
    let number = words[at + 1].parse().expect("a number");
    (number, words[at + 2].to_owned())
}

#[test]
fn the_cursor_reads_all_curves_at_its_radius() {
    let dir = TestDir::new();
    let text = shot_of(&dir, "li2019-fig3", ",,x");
    let line = foot(&text);
    let (r, unit) = value(&line, "r");
    assert_eq!(unit, "µm");
    has(&line, " stick ");
    // The same values stand in the file of the same moment, between the nodes around r.
    shot_of(&dir, "li2019-fig3", ",,s");
    let table = dir.table("li2019-fig3-cycle-2/state.csv");
    let radii = table.column("r_m");
    let above = radii
        .iter()
        .position(|node| *node > r * 1e-6)
        .expect("a node");
    for (name, column, factors) in [
        ("f", "f_m", [("nm", 1e-9), ("µm", 1e-6)]),
        ("worn", "wear_m", [("pm", 1e-12), ("nm", 1e-9)]),
        ("p", "p_Pa", [("GPa", 1e9), ("MPa", 1e6)]),
        ("τ", "tau_Pa", [("MPa", 1e6), ("kPa", 1e3)]),
    ] {
        let (number, unit) = value(&line, name);
        let factor = factors.iter().find(|(known, _)| *known == unit);
        let seen = number * factor.unwrap_or_else(|| panic!("{line}")).1;
        let values = table.column(column);
        let (low, high) = (values[above - 1], values[above]);
        let slack = 1e-3 * low.abs().max(high.abs());
        assert!(
            (low.min(high) - slack..=low.max(high) + slack).contains(&seen),
            "{name}: {seen} is not between {low} and {high}"
        );
    }
}

#[test]
fn what_is_fixed_during_a_run_says_why() {
    let at = |up: usize| shot(&format!(",e<End>{}<Enter>", "<Up>".repeat(up)));
    let because = "fixed during a run: it has chosen points and steps before the run";
    assert!((0..14).any(|up| at(up).contains(because)));
}

/// What is typed in the list of parameters finds parameters: no letter changes the run, and Esc leaves no trace.
#[test]
fn typing_in_the_parameter_list_loses_no_run() {
    let start = begin(load("li2019-fig3", &[]));
    let shot = |keys: &str| rehearsed_on(start.clone(), keys, (80, 24));
    let expected = body(&shot(",,,"));
    let mut letters: String = ('!'..='~').filter(|c| !",[]<+-=".contains(*c)).collect();
    letters.push_str("éµ∂");
    assert_eq!(body(&shot(&format!(",,,e{letters}<Esc>"))), expected);
    for letter in letters.chars() {
        has(&shot(&format!(",e{letter}")), "parameters: ");
        has(&shot(&format!(",e{letter}<Backspace>")), "Esc: close)");
    }
    // Of a value that is given up nothing stays.
    for row in 0..20 {
        let keys = format!(
            ",,,e{}<Enter>{letters}<Esc><Esc><Esc>",
            "<Down>".repeat(row)
        );
        assert_eq!(body(&shot(&keys)), expected, "row {row}");
    }
    // What is applied may change the run, and never leaves it.
    let words: Vec<char> = letters
        .chars()
        .filter(char::is_ascii_alphanumeric)
        .collect();
    let mut random = Random::new(29);
    for _ in 0..4 {
        let mut keys = ",,,".to_owned();
        for row in 0..40 {
            let word: String = (0..8).map(|_| random.pick(&words)).collect();
            keys += &format!("e{}<Enter>{word}<Enter><Esc><Esc>", "<Down>".repeat(row));
        }
        has(&shot(&keys), "cycle 3.00/");
    }
}

/// Keys do what the topmost overlay says: none changes the run below, its pace or its plan. Keys that step the run under
/// an overlay are left out, and Enter, which chooses.
#[test]
fn no_key_of_an_overlay_changes_the_run() {
    let sets = ["numerics.points=20", "numerics.steps_per_cycle=10"];
    let start = begin(load("li2019-fig3", &sets));
    let told = |keys: &str| {
        let screen = rehearsed_on(start.clone(), &format!(",,,+{keys}"), (110, 24));
        ["status", "timeline"].map(|part| part_of(&screen, part))
    };
    let expected = told("");
    let study = ":sweep friction.coefficient 0.1..0.2<Enter>";
    for (open, acts) in [
        ("p", ""),
        ("?", ""),
        ("/", ""),
        (":", ""),
        ("i", ""),
        ("e", "<Space> , [ ] + = - <Left> <Right>"),
        ("efric", "<Left> <Right>"),
        ("e<Down><Enter>", ""),
        ("<Enter>", "<Space> . ,"),
        ("a", "<Space> . , + = -"),
        ("a<Tab>", "<Space> . , + = -"),
        (study, ""),
        (&format!("{study}?"), ""),
    ] {
        let acts: Vec<&str> = acts.split(' ').chain(["<Enter>"]).collect();
        let more = [
            "a",
            "b",
            "q",
            "Q",
            "R",
            "s",
            "S",
            "{",
            "}",
            ">",
            "2",
            "<paste:load cone>",
        ];
        let keys = strokes::KEYS.split_whitespace().chain(more);
        let keys = keys.filter(|key| !acts.contains(key));
        let script: String = match open.starts_with(study) {
            // Opened once, since that takes long: q would close it.
            true => open.to_owned() + &keys.filter(|key| *key != "q").collect::<String>(),
            false => keys
                .map(|key| format!("{open}{key}<Esc><Esc><Esc>"))
                .collect(),
        };
        assert_eq!(
            told(&format!("{script}<Esc><Esc><Esc>")),
            expected,
            "{open}"
        );
    }
}

/// Scenarios of the user's own, and what is none.
fn own_files(dir: &TestDir) {
    let mine = dir
        .done("presets cone")
        .replace("title = \"", "title = \"Mine: ");
    dir.write("mine.toml", mine.as_bytes());
    dir.write("broken.toml", b"[indenter]\nshape = \"ball\"\n");
    dir.write("notes.txt", b"no scenario");
    std::fs::create_dir_all(dir.path("deeper/down")).expect("a directory");
    dir.write("deeper/other.toml", mine.as_bytes());
}

#[test]
fn the_library_shows_presets_and_the_users_own_files() {
    hold("library", own_files);
}

#[test]
fn themes_and_markers_change_the_look_and_nothing_else() {
    let dir = TestDir::new();
    let with = |options: &str| dir.done(&format!("{options} --keys , --print 80x24"));
    for theme in ["dark", "light"] {
        assert_eq!(with(&format!("--theme {theme}")), shot(","), "{theme}");
    }
    // Without colour, dashes and letters tell things apart.
    assert_eq!(with("--theme mono"), with("--color never"));
    has(&with("--theme mono"), "s~");
    assert_eq!(dir.line("--theme pink --keys , --print 80x24").code, 2);
    // The console of Linux has half blocks alone.
    let on_console = |more: &[&str]| {
        let arguments = [&["--keys", ",", "--print", "80x24"], more].concat();
        let output = dir.command(&arguments).env("TERM", "linux").output();
        Said::from(output.expect("the program starts")).out
    };
    let braille = |text: &str| text.contains(|sign| ('\u{2801}'..='\u{28ff}').contains(&sign));
    let text = on_console(&[]);
    assert!(!braille(&text) && text.contains('▄'), "{text}");
    assert!(braille(&on_console(&["--marker", "braille"])));
}

/// The status line and the files call each law by its word in `keys.toml`.
#[test]
fn w_goes_through_every_law_by_its_word() {
    let mut laws = words("wear.law");
    laws.rotate_left(1);
    for (at, law) in laws.into_iter().enumerate() {
        let keys = format!(",{}", "w".repeat(at + 1));
        let screen = rehearsed("li2019-fig3", &keys, (200, 50));
        has(&part_of(&screen, "status"), &format!("│ {law} "));
        let dir = TestDir::new();
        dir.screen(&["li2019-fig3"], &format!("{keys}s"), (200, 50));
        let [name] = &names(&dir.path(""))[..] else {
            panic!("not one snapshot");
        };
        let table = dir.table(&format!("{name}/state.csv"));
        assert_eq!(table.header("law"), law);
    }
}
