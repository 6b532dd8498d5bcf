//! Hostile input: what the fuzz targets check, on mutations that differ in each run; sizes that are
//! refused before they cost anything; and text that would do something to a terminal.

#[path = "../fuzz/src/lib.rs"]
pub mod fuzzed;

use mdr_tui::scenario::checkpoint::VERSION;
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
    // A directory of that name is written to, and its name printed, without harm.
    let said = dir.say(&["run", "hertz", "--cycles", "0.1", "--out", rude]);
    assert_eq!(said.code, 0, "{}", said.err);
    assert_harmless(&(said.out + &said.err), "--out");
}

/// A table without the characters of a terminal, and with the cells that it should have.
#[track_caller]
fn assert_cells(dir: &TestDir, name: &str, columns: usize, rows: usize) {
    let text = dir.read(name);
    assert_harmless(&text, name);
    let table = dir.table(name);
    assert_eq!(
        (table.columns.len(), table.rows.len()),
        (columns, rows),
        "{text}"
    );
    for cell in table.rows.concat() {
        let is_formula = cell.starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err();
        assert!(!is_formula, "{cell}");
    }
}

#[test]
fn texts_of_a_study_stay_in_their_cells() {
    let dir = TestDir::new();
    let study = r#"base = "li2019-fig3"
columns = ["wear_volume_m3"]
set."run.cycles" = 0.25
set."numerics.points" = 20
[[axis]]
key = "title"
values = ["A\nb,c,1,2,3", "B\u001b]0;x\u0007\u202e", "=cmd|x!A1", "-1+cmd", "@x"]
"#;
    dir.write("s.toml", study.as_bytes());
    dir.done("sweep s.toml --out m.csv --quiet");
    assert_cells(&dir, "m.csv", 3, 5);
    // The rows are found again by their values.
    dir.done("sweep s.toml --out m.csv --resume --quiet");
    assert_cells(&dir, "m.csv", 3, 5);
    dir.done("figure m.csv -o m.svg --quiet");
    assert_cells(&dir, "m-drawn.csv", 6, 5);
    assert_harmless(&dir.done("sweep s.toml --out n.csv --json"), "json");
}

#[test]
fn a_strangers_header_and_file_name_make_a_whole_picture() {
    let dir = TestDir::new();
    dir.done("run hertz --cycles 0 --out x --quiet");
    let title = "A\u{ffff}B \u{202e}\u{9b}<&\u{1}";
    let state = dir.read("x/state.csv");
    let titled = |title: &str| state.replacen("# scenario: ", &format!("# scenario: {title}"), 1);
    // A control character makes a table no text; all else of the title is read.
    dir.write("control.csv", titled(title).as_bytes());
    dir.refuse_line("figure control.csv -o control.svg", "is not a text");
    dir.write("s.csv", titled(&title.replace('\u{1}', "")).as_bytes());
    let name = format!("{}.csv", title.replace('/', ""));
    dir.write(&name, b"r_um,wear_nm\n0,0\n5,1\n9,2\n");
    for figure in [
        vec!["figure", "s.csv", "-o", "s.svg", "-o", "s.pdf"],
        vec![
            "figure",
            "x",
            "--overlay",
            &name,
            "--panel",
            "profile",
            "-o",
            "o.svg",
        ],
    ] {
        let said = dir.say(&figure);
        assert_eq!(said.code, 0, "{}", said.err);
        assert_harmless(&said.out, "figure");
    }
    for picture in ["s.svg", "o.svg"] {
        let picture = dir.read(picture);
        assert_harmless(&picture, "a picture");
        assert!(!picture.contains('\u{ffff}'), "{picture}");
    }
    assert_harmless(&dir.read("s-drawn.csv"), "data");
}

#[test]
fn pipes_and_huge_files_are_refused_at_once() {
    let dir = TestDir::new();
    let made = std::process::Command::new("mkfifo")
        .arg(dir.path("p.toml"))
        .status();
    assert!(made.expect("mkfifo").success());
    std::os::unix::fs::symlink("p.toml", dir.path("run.checkpoint")).expect("a link");
    dir.write(
        "s.toml",
        b"base = \"p.toml\"\n[[axis]]\nkey = \"friction.coefficient\"\nvalues = [0.1]\n",
    );
    for line in [
        "run p.toml --cycles 1 --out x",
        "p.toml --print 80x24",
        "sweep p.toml --out x",
        "sweep s.toml --out x",
        "run --resume run.checkpoint",
        "figure p.toml -o x.svg",
        "fit hertz --scar p.toml --free wear.coefficient",
    ] {
        // The test itself must not read the pipe either.
        dir.line(line)
            .fails(2, "is not a file (but a pipe, a device or a socket)");
    }
    std::fs::remove_file(dir.path("p.toml")).expect("the pipe");
    std::fs::remove_file(dir.path("run.checkpoint")).expect("the link");
    // The standard input is read where a user asks for it.
    let preset = dir.done("presets hertz");
    dir.write("hertz.toml", preset.as_bytes());
    let bash = format!(
        "'{}' run - --cycles 0 --out y --quiet < hertz.toml",
        env!("CARGO_BIN_EXE_mdr-tui")
    );
    let mut command = std::process::Command::new("bash");
    let status = command
        .args(["-c", &bash])
        .current_dir(dir.path(""))
        .status();
    assert!(status.expect("bash").success());
    dir.done("run hertz.toml --cycles 0 --out z --quiet");
    let [one, other] = ["y", "z"].map(|out| dir.read(&format!("{out}/state.csv")));
    assert_eq!(one, other);
    dir.refuse_line("run hertz --cycles 0 --out -", "is not a name for files");
    // A checkpoint is not read into memory before it is known to be one.
    let head = format!("mdr-tui checkpoint {VERSION}\n4000000000 bytes, CRC-32 00000000\n");
    dir.write("big.checkpoint", head.as_bytes());
    let big = std::fs::File::options()
        .write(true)
        .open(dir.path("big.checkpoint"));
    big.expect("a file")
        .set_len(300 << 20)
        .expect("a sparse file");
    dir.refuse_line("run --resume big.checkpoint", "is damaged");
}

#[test]
fn many_unknown_keys_are_counted_not_compared() {
    let keys: String = (0..60_000).map(|k| format!("kxyz{k} = 1\n")).collect();
    let error = mdr_tui::scenario::Scenario::from_toml(&keys, "x.toml", &[]).expect_err("unknown");
    let error = error.to_string();
    assert_eq!(error.lines().count(), 20, "{error}");
    assert!(error.ends_with("more errors"), "{error}");
    let long = format!("{} = 1\n", "k".repeat(500_000));
    assert!(mdr_tui::scenario::Scenario::from_toml(&long, "x.toml", &[]).is_err());
}

#[cfg(target_os = "linux")]
#[test]
fn names_of_any_bytes_and_dashes_are_taken() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let dir = TestDir::new();
    let name = OsStr::from_bytes(b"caf\xe9.toml");
    std::fs::write(dir.path("").join(name), dir.done("presets hertz")).expect("a file");
    std::fs::write(dir.path("").join("-5C.toml"), dir.done("presets hertz")).expect("a file");
    let say = |words: &[&OsStr]| {
        let mut command = dir.command(&[]);
        let output = command.args(words).output().expect("the program starts");
        (
            output.status.code(),
            String::from_utf8_lossy(&output.stderr).into_owned(),
        )
    };
    let words = |line: &'static str| line.split(' ').map(OsStr::new).collect::<Vec<_>>();
    for (line, code) in [
        ("run % --cycles 0 --out x --quiet", 0),
        ("% --print 80x24", 0),
        ("figure % -o f.svg --cycles 0 --quiet", 0),
        ("figure x -o g.svg --overlay % --quiet", 0),
        ("trade % --cycles nothing", 2),
        ("fit hertz --scar % --free wear.coefficient", 2),
        ("%", 2),
    ] {
        let words: Vec<&OsStr> = words(line)
            .into_iter()
            .map(|word| if word == "%" { name } else { word })
            .collect();
        let (found, err) = say(&words);
        assert_eq!(found, Some(code), "{line}: {err}");
        assert!(!err.contains("panicked") && !err.contains("bug"), "{err}");
    }
    dir.done("run ./-5C.toml --cycles 0 --quiet");
    dir.done("figure ./-5C-run -o d.svg --quiet");
    dir.refuse_line("run ./-5C.toml --cycles 0 --out ./-5C-run", "not empty");
}
