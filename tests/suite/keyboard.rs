//! The keyboard in the explorer: reading values, typing commands, editing parameters, going back
//! in time. Keys are played by `--keys`, and the screen comes from `--print`.

use insta::assert_snapshot;

use crate::test_dir::{TestDir, cases, has};

/// The screen in 80 by 24 after `keys` on a scenario.
fn shot_of(dir: &TestDir, scenario: &str, keys: &str) -> String {
    dir.screen(&[scenario], keys, (80, 24))
}

fn shot(keys: &str) -> String {
    shot_of(&TestDir::new(), "li2019-fig3", keys)
}

/// The line at the foot of the screen.
fn foot(text: &str) -> &str {
    text.lines().last().unwrap_or_default().trim()
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
    let line = foot(&text).to_owned();
    let (r, unit) = value(&line, "r");
    assert_eq!(unit, "µm");
    has(&line, " stick ");
    // The same values stand in the file of the same moment, between the nodes around r.
    shot_of(&dir, "li2019-fig3", ",,s");
    let table = crate::test_dir::Table::parse(&dir.read("li2019-fig3-cycle-2/state.csv"));
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
fn the_cursor_moves_and_goes() {
    let radius = |keys: &str| value(foot(&shot(keys)), "r").0;
    let start = radius(",x");
    assert!(radius(",xl") > start && radius(",xh") < start);
    assert_eq!(radius(",xl<Right>h<Left>"), start);
    assert_eq!(radius(&format!(",x{}", "h".repeat(40))), 0.0);
    assert_eq!(shot(",xx"), shot(","));
    // Without it, the arrows move the focus as Tab does.
    assert_eq!(shot(",lz"), shot(",<Tab>z"));
    assert_eq!(shot(",<Left>z"), shot(",<S-Tab>z"));
    // Beyond the contact there is no stress.
    let outside = shot(&format!(",x{}", "l".repeat(60)));
    has(foot(&outside), " open ");
    has(foot(&outside), " p 0 ");
}

#[test]
fn the_cursor_reads_curves_of_hidden_panels_too() {
    // What one page shows, the other reads as well.
    let line = foot(&shot(",x")).to_owned();
    for keys in [",xv", ",xz", ",vx", ",xvz"] {
        assert_eq!(foot(&shot(keys)), line, "{keys}");
    }
    // And a comparison on the second page has its pressures.
    assert_eq!(body(&shot(",cv")), body(&shot(",c")));
}

#[test]
fn the_cursor_in_the_plots() {
    assert_snapshot!("cursor-80x24", shot(",,x"));
    let dir = TestDir::new();
    let zoomed = ["li2019-fig3", "--keys", ",,x<Tab>z", "--print", "120x30"];
    assert_snapshot!("cursor-zoomed-120x30", dir.say(&zoomed).out);
}

#[test]
fn the_palette_does_what_the_key_does() {
    for (typed, key) in [
        (":method<Enter>", "m"),
        (":METHOD back<Enter>", "M"),
        (":cyc<Enter>", ","),
        (":zoom<Enter>", "z"),
        (":presets<Enter>", "p"),
        (":next wear<Enter>", "w"),
    ] {
        assert_eq!(
            shot(&format!(",{typed}")),
            shot(&format!(",{key}")),
            "{typed}"
        );
    }
    let plain = shot(",");
    for closed in [":<Esc>", ":method<Esc>", ":x<Backspace><Backspace>"] {
        assert_eq!(shot(&format!(",{closed}")), plain, "{closed}");
    }
    // What is typed is text: q and Space are characters there; Ctrl-C is not.
    has(&shot(",:q <lt>"), " :q <");
    has(&shot(":q<C-c>,,,"), "cycle 0.00/");
}

#[test]
fn the_palette_completes_keys_and_their_values() {
    let text = shot(",:fric");
    has(&text, " set friction.coefficient= ");
    let text = shot(",:fric<Tab>0.25<Enter>");
    assert_eq!(foot(&text), "friction.coefficient = 0.25 at cycle 1.00");
    let text = shot(",:set numerics.method=be<Enter>");
    assert_eq!(foot(&text), "numerics.method = benad at cycle 1.00");
    let text = shot(",:set numerics.method=<Down><Down><Enter>.");
    assert!(
        text.lines()
            .next()
            .is_some_and(|line| line.contains(" a+b ")),
        "{text}"
    );
    for (typed, refusal) in cases([
        "set friction.coefficient=-1 => friction.coefficient = -1: must be 0 or greater",
        "set frictoin.coefficient=1 => unknown key frictoin.coefficient; did you mean",
        "set run.cycles=3 => run.cycles cannot change during a run",
        "no such thing => no such command: no such thing",
    ]) {
        let text = shot(&format!(",:{typed}<Enter>"));
        assert!(foot(&text).contains(refusal), "{typed}: {}", foot(&text));
    }
    // A key is found for a sweep as well, and a range may be written as it comes.
    let text = shot(",:friction");
    has(&text, "sweep friction.coefficient");
    let text = shot(",:sweep friction 0.1 to 0.5");
    has(&text, "runs 25 values on all cores");
    let text = shot(",:load her<Enter>");
    has(&text, "cycle 0.00/2.5");
    assert_snapshot!("palette-80x24", shot(",:we"));
}

#[test]
fn help_is_searched_by_words() {
    let text = shot("/wear law");
    for (word, is_there) in [("next wear law", true), ("run or pause", false)] {
        assert_eq!(text.contains(word), is_there, "{word}\n{text}");
    }
    has(&shot("?/zzz"), "no command matches");
    assert_eq!(shot(",?/wear<Esc>"), shot(",?"));
    assert_eq!(shot(",/wear<Enter>"), shot(","));
    assert_snapshot!("help-search-80x24", shot("/cycle"));
}

#[test]
fn the_form_edits_parameters_while_it_runs() {
    assert_snapshot!("form-80x24", shot(",e<Down><Down><Down><Enter>"));
    let dir = TestDir::new();
    let wide = ["li2019-fig3", "--keys", ",e", "--print", "200x50"];
    assert_snapshot!("form-200x50", dir.say(&wide).out);
    // Typed, stepped, and chosen.
    for (keys, told) in [
        (
            "e<Down><Enter><C-u>0.02 m<Enter>",
            "indenter.radius = 0.02 m at cycle 1.00",
        ),
        (
            // A bare number is in the unit that is shown.
            "e<Down>25<Backspace>6<Enter>",
            "indenter.radius = 26 mm at cycle 1.00",
        ),
        ("ejjjj+", "friction.coefficient = 0.11 at cycle 1.00"),
        ("ejjjj++-", "friction.coefficient = 0.11 at cycle 1.00"),
    ] {
        let text = shot(&format!(",{keys}"));
        assert!(text.contains(told), "{keys}: {told}\n{text}");
    }
    // The run goes on below it, and it closes without a trace.
    has(&shot("e,,"), "cycle 2.00/");
    assert_eq!(shot(",e<Esc>"), shot(","));
    assert_eq!(shot(",ejj5<Esc><Esc>"), shot(","));
    // The default edge of the domain is no number yet: nothing to step from, but a place to type one.
    let text = shot(",e<Up><Up><Up><Up><Up><Up>+");
    has(&text, "Enter applies");
    // Every shape brings its own keys.
    let text = shot(",e<Enter><Down><Enter>");
    has(&text, "indenter.angle is missing");
}

#[test]
fn the_form_shows_refusals_and_changes_nothing() {
    for (keys, refusal) in cases([
        "ejjj<Enter><C-u>0.7<Enter> => material.poisson = 0.7: must be from 0 to 0.5",
        "ejjj<Enter><C-u>soft<Enter> => material.poisson = soft: must be a finite number",
        "ejjj<Enter><C-u>nan<Enter> => must be a finite number",
    ]) {
        let text = shot(&format!(",{keys}"));
        assert!(text.contains(refusal), "{keys}: {refusal}\n{text}");
        // What was refused stays, to be mended; Esc leaves the value as it was.
        let typed = keys
            .split("<C-u>")
            .nth(1)
            .and_then(|rest| rest.split('<').next());
        let typed = typed.expect("what was typed");
        let line = format!("material.poisson                     {typed}");
        has(&text, &line);
        let left = shot(&format!(",{keys}<Esc>"));
        has(&left, "material.poisson                     0.3");
    }
    // Mended in place and taken.
    let text = shot(",ejjj<Enter><C-u>0.7<Enter><Backspace>2<Enter>");
    has(&text, "material.poisson                     0.2");
}

#[test]
fn parameters_have_units_on_the_screen_and_as_input() {
    let form = shot(",e");
    for shown in ["10 mm", "230.77 GPa", "1 µm", "15.91549 Hz"] {
        has(&form, &format!(" {shown} "));
    }
    for (typed, taken) in cases([
        ":set indenter.radius=12 mm<Enter>e => 12 mm",
        ":set motion.normal.angular_frequency=50 Hz<Enter>e => 50 Hz",
        ":set material.effective_modulus=210 GPa<Enter>e => 210 GPa",
        "e<Down>12 mm<Enter> => 12 mm",
        "e<Down><Down>+ => 240 GPa",
    ]) {
        let text = shot(&format!(",{typed}"));
        assert!(text.contains(&format!(" {taken} ")), "{typed}\n{text}");
    }
    let text = shot(",:set indenter.radius=12 mn<Enter>");
    has(foot(&text), "mn is not a unit");
    // A change with a unit is recorded, and runs again to the last bit.
    assert_runs_again(",:set motion.tangential.phase=50 deg<Enter>,s", 1);
}

/// What a snapshot of `keys` holds, and the same run again without a screen.
fn replayed(keys: &str) -> (String, String) {
    let dir = TestDir::new();
    let text = shot_of(&dir, "li2019-fig3", keys);
    let name = crate::test_dir::names(&dir.path("."));
    let [name] = name.as_slice() else {
        panic!("{keys}: {name:?}\n{text}");
    };
    let state = dir.read(&format!("{name}/state.csv"));
    dir.done(&format!("run {name}/scenario.toml --out again --quiet"));
    (state, dir.read("again/state.csv"))
}

/// A snapshot of `keys` tells so many changes and runs again to the last bit.
fn assert_runs_again(keys: &str, changes: usize) {
    let (state, again) = replayed(keys);
    assert_eq!(
        state.matches("# at cycle ").count(),
        changes,
        "{keys}\n{state}"
    );
    assert!(state == again, "{keys}: the states differ");
}

/// Whatever is typed in the list of parameters is a value: a run is neither restarted nor left, and goes on. A value
/// that is given up leaves no trace.
#[test]
fn letters_in_the_list_lose_no_run() {
    const LETTERS: &str = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.*;_";
    let letters: Vec<char> = LETTERS.chars().collect();
    let mut random = crate::random::Random::new(29);
    let mut typed = |end: &str| -> String {
        let row = |row: usize, random: &mut crate::random::Random| {
            let word: String = (0..8).map(|_| random.pick(&letters)).collect();
            // Down first: the list has letters for it as well.
            format!("e{}{word}{end}<Esc><Esc>", "<Down>".repeat(row))
        };
        (0..40).map(|at| row(at, &mut random)).collect()
    };
    assert_eq!(shot(&format!(",,,{}", typed(""))), shot(",,,"));
    for _ in 0..4 {
        let text = shot(&format!(",,,{}", typed("<Enter>")));
        has(&text, "cycle 3.00/");
    }
}

#[test]
fn edits_are_recorded_and_run_again_bit_for_bit() {
    for (keys, changes) in [
        (",,ejjjj+<Esc>,...ejjjj--<Esc>,s", 3),
        (
            ",e<Down>0.011<Enter><Esc>,:set wear.coefficient=1e-9<Enter>..:set numerics.points=60<Enter>,s",
            3,
        ),
        (
            ",:set motion.tangential.amplitude=2e-7<Enter>.,:set wear.law=power<Enter>,s",
            2,
        ),
    ] {
        assert_runs_again(keys, changes);
    }
}

#[test]
fn a_note_goes_into_both_files() {
    let (state, again) = replayed(",Sworn \"through\", ask k.<Backspace>?<Enter>");
    has(&state, "\n# note: worn \"through\", ask k?\n");
    assert!(state == again);
    assert_eq!(shot(",Sabc<Esc>"), shot(","));
}

/// A screen's text without its foot, which tells of the last key.
fn body(text: &str) -> Vec<&str> {
    let lines: Vec<&str> = text.lines().collect();
    lines[..lines.len() - 1].to_vec()
}

/// Without the status line and the timeline too, which tell of the present.
fn panels(text: &str) -> Vec<&str> {
    body(text)[2..].to_vec()
}

#[test]
fn time_goes_back_and_forth() {
    let status = |keys: &str| shot(keys).lines().next().unwrap_or_default().to_owned();
    has(&status(",,,,[["), "cycle 2.00/199.24   │ present 4.00 ");
    assert!(status(",,,,[[").starts_with(" ◂ past    │"));
    // There and back again is where it was, down to the last dot of the fretting loop.
    for (there, plain) in [(",,,,[[]]", ",,,,"), (",...[[[]]]", ",...")] {
        assert_eq!(body(&shot(there)), body(&shot(plain)), "{there}");
    }
    // A state of the past looks as it did, but for the words that say so.
    let (past, then) = (shot(",,,,[["), shot(",,"));
    assert_eq!(panels(&past), panels(&then));
    // Single steps are kept as well.
    assert!(status(",..[").contains("cycle 1.01/"));
    assert_eq!(foot(&shot(",[[[")), "this is the start of the run");
    assert_eq!(foot(&shot(",]")), "this is the present");
    assert_snapshot!("past-80x24", shot(",,,,[["));
}

#[test]
fn a_branch_from_the_past_is_the_run_without_what_came_after() {
    // Run on from there: the same as if there had been no way back.
    assert_eq!(body(&shot(",,,,[[,")), body(&shot(",,,")));
    let text = shot(",,,,[[.");
    assert!(foot(&text).starts_with("branch at cycle 2.00; [ leads back to the run up to "));
    // Later changes are dropped, earlier ones stay, and all of it runs again bit for bit.
    for (keys, changes) in [
        (",m,w,[,s", 1),
        (",,ejjjj+<Esc>,,[[[ejjjj-<Esc>.,s", 1),
        (",m,[[[[.,m.,s", 1),
        (",..m..[[,s", 0),
        (",m.[s", 0),
    ] {
        assert_runs_again(keys, changes);
    }
}

#[test]
fn the_way_back_leads_to_what_a_branch_a_restart_and_an_edit_left() {
    // A branch with another friction, and back in the run before it.
    let branch = ",,,[[ejjjj+<Esc>,";
    assert_eq!(panels(&shot(&format!("{branch}[["))), panels(&shot(",,,")));
    let (state, again) = replayed(&format!("{branch}[[.s"));
    assert!(!state.contains("# at cycle ") && state == again);
    // A restart says so, and is undone.
    assert_eq!(
        foot(&shot(",,,r")),
        "restarted; [ leads back to the run up to cycle 3.00"
    );
    assert_eq!(panels(&shot(",,,r[")), panels(&shot(",,,")));
    assert_eq!(body(&shot(",,,r[,")), body(&shot(",,,,")));
    has(&shot(",,,r[]"), "⏸ paused  │ cycle 0.00/");
    has(
        &shot(",,,:load cone<Enter>["),
        "◂ past    │ cycle 3.00/199.24",
    );
    // So are a method, a law and a value.
    for edit in ["m", "w", "ejjjj+[<Esc>]"] {
        assert_eq!(
            panels(&shot(&format!(",,,{edit}["))),
            panels(&shot(",,,")),
            "{edit}"
        );
    }
}

/// Printable keys edit a value; none of them is a command, whatever parameter is selected.
#[test]
fn typing_in_the_parameter_list_loses_no_run() {
    let plain = shot(",,,");
    let expected = body(&plain);
    let mut letters: String = ('!'..='~').filter(|c| !"?:,[]<+-=".contains(*c)).collect();
    letters.push_str("éµ∂");
    for row in 0..20 {
        let down = "<Down>".repeat(row);
        let keys = format!(",,,e{down}{letters}<Esc><Esc>");
        assert_eq!(body(&shot(&keys)), expected, "row {row}");
    }
    // One by one, and the list stays open.
    for letter in letters.chars().filter(|c| !"jk".contains(*c)) {
        let text = shot(&format!(",e{letter}"));
        assert!(text.contains("cancels)"), "{letter}\n{text}");
    }
}

#[test]
fn choices_are_listed_with_what_each_is() {
    assert_snapshot!("methods-80x24", shot(",i"));
    let text = shot(",i<Down><Enter><Esc>");
    assert!(
        foot(&text).is_empty() || !text.contains("product, N"),
        "{text}"
    );
    has(&shot(",I"), "by friction work");
    has(
        &shot(",ip<Down><Enter>"),
        "numerics.method = a at cycle 1.00",
    );
    has(foot(&shot_of(&TestDir::new(), "hertz", "I")), "no wear.law");
}

#[test]
fn what_is_fixed_during_a_run_says_why() {
    let at = |up: usize| shot(&format!(",e<End>{}5", "k".repeat(up)));
    let because = "fixed during a run: it has chosen points and steps before the run";
    assert!((0..14).any(|up| at(up).contains(because)));
}

#[test]
fn the_library_shows_presets_and_the_users_own_files() {
    let dir = TestDir::new();
    let mine = dir
        .done("presets cone")
        .replace("title = \"", "title = \"Mine: ");
    dir.write("mine.toml", mine.as_bytes());
    dir.write("broken.toml", b"[indenter]\nshape = \"ball\"\n");
    dir.write("notes.txt", b"no scenario");
    std::fs::create_dir_all(dir.path("deeper/down")).expect("a directory");
    dir.write("deeper/other.toml", mine.as_bytes());
    assert_snapshot!("library-80x24", shot_of(&dir, "li2019-fig3", ",pj"));
    let ends = |keys: &str| shot_of(&dir, "li2019-fig3", &format!(",p<End>{keys}"));
    // From the end: the directory above, the one here, the two files.
    let text = ends("");
    for (name, is_there) in [
        (" ../ ", true),
        (" deeper/ ", true),
        (" mine.toml ", true),
        (" notes.txt", false),
    ] {
        assert_eq!(text.contains(name), is_there, "{name}\n{text}");
    }
    has(&ends("kk"), "Mine: ");
    let broken = ends("kkk");
    has(&broken, "indenter.shape = \"ball\": must be one of");
    // A file that is refused changes nothing; a good one starts.
    let text = ends("kkk<Enter>");
    has(&text, "cycle 1.00/199.24");
    has(foot(&text), "must be one of");
    has(&ends("kk<Enter>"), "cycle 0.00/");
    let text = ends("k<Enter>");
    has(&text, " other.toml ");
    has(&text, " down/ ");
    let text = ends("k<Enter><Enter>,s");
    has(foot(&text), "snapshot in other-cycle-1/state.csv");
}

#[test]
fn the_footer_names_the_first_keys() {
    let start = shot("");
    assert!(foot(&start).starts_with("Space run/pause"), "{start}");
    assert!(foot(&start).contains("? help") && foot(&start).ends_with("q quit"));
}

#[test]
fn themes_change_colours_and_nothing_else() {
    let text = shot(",T");
    assert_eq!(foot(&text), "theme light");
    assert_eq!(body(&text), body(&shot(",")));
    let dir = TestDir::new();
    for theme in ["dark", "light"] {
        let said = dir.say(&["--theme", theme, "--keys", ",", "--print", "80x24"]);
        assert_eq!(said.out, shot(","), "{theme}");
    }
    // Without colour, dashes and letters tell things apart.
    let mono = dir.say(&["--theme", "mono", "--keys", ",", "--print", "80x24"]);
    assert_eq!(
        mono.out,
        dir.say(&["--color", "never", "--keys", ",", "--print", "80x24"])
            .out
    );
    assert!(
        mono.out.contains("ssss~~~~") || mono.out.contains("s~"),
        "{}",
        mono.out
    );
    let refused = dir.say(&["--theme", "pink", "--keys", ",", "--print", "80x24"]);
    assert_eq!(refused.code, 2);
}

#[test]
fn the_console_of_linux_gets_half_blocks() {
    let dir = TestDir::new();
    let arguments = ["li2019-fig3", "--keys", ",", "--print", "80x24"];
    let output = dir.command(&arguments).env("TERM", "linux").output();
    let text = crate::test_dir::Said::from(output.expect("the program starts")).out;
    let braille = |text: &str| text.contains(|sign| ('\u{2801}'..='\u{28ff}').contains(&sign));
    assert!(!braille(&text) && text.contains('▄'), "{text}");
    let chosen = [&arguments[..], &["--marker", "braille"]].concat();
    let output = dir.command(&chosen).env("TERM", "linux").output();
    assert!(braille(
        &crate::test_dir::Said::from(output.expect("the program starts")).out
    ));
}

/// Finer and coarser, recorded so that the snapshot replays it.
#[test]
fn finer_and_coarser_change_cells_and_steps_together() {
    let dir = TestDir::new();
    let text = shot_of(&dir, "li2019-fig3", ",>");
    assert_eq!(
        foot(&text),
        "N = 150, 150 steps per cycle; a estimates the error"
    );
    let text = shot_of(&dir, "li2019-fig3", ",<lt><lt>,s");
    has(&text, "li2019-fig3-cycle-2");
    let scenario = dir.read("li2019-fig3-cycle-2/scenario.toml");
    for set in [
        "numerics.points = 67",
        "numerics.steps_per_cycle = 67",
        "numerics.points = 45",
    ] {
        has(&scenario, set);
    }
    let state = dir.read("li2019-fig3-cycle-2/state.csv");
    let rows = state.lines().filter(|line| !line.starts_with('#')).count();
    assert_eq!(rows, 1 + 45 + 1);
    let said = dir.say(&[
        "run",
        "li2019-fig3-cycle-2/scenario.toml",
        "--quiet",
        "--out",
        "again",
    ]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    assert_eq!(dir.read("again/state.csv"), state);
    let text = shot_of(&dir, "li2019-fig3", &"<lt>".repeat(9));
    assert_eq!(foot(&text), "N = 9: this is the coarsest level");
}

/// A tour turns pages; its end turns them back.
#[test]
fn a_tour_ends_where_it_began() {
    let dir = TestDir::new();
    let shot = |keys: &str| shot_of(&dir, "limit-shape", keys);
    let before = shot(",<Tab>");
    assert_ne!(body(&shot(",<Tab>nnnn"))[..4], body(&before)[..4]);
    for end in ["nnnnn", "nnn<Esc>"] {
        assert_eq!(body(&shot(&format!(",<Tab>{end}"))), body(&before), "{end}");
    }
}
