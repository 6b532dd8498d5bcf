//! Other curves over those of a run: measured data, runs, scenarios and frozen states, on screens and in
//! figures; and snapshots, which hold what is needed to go on.

use insta::assert_snapshot;

use crate::test_dir::{Table, TestDir, cases, has, lacks, names};

/// A scar in µm and nm with errors, a loop, and two histories.
fn measured() -> TestDir {
    let dir = TestDir::new();
    let scar = (-13..=13).map(|i| {
        let r = 10.0 * f64::from(i);
        let depth = 6.0 * (-((r.abs() - 80.0) / 20.0).powi(2)).exp();
        format!("{r},{depth:.3},1.5\n")
    });
    let scar: String = scar.collect();
    dir.write(
        "scar.csv",
        format!("r_um,wear_nm,error_nm\n{scar}").as_bytes(),
    );
    let turn = (0..60).map(|i| std::f64::consts::TAU * f64::from(i) / 60.0);
    let turn = turn.map(|t| format!("{:.5},{:.4}\n", 0.1 * t.sin(), 2.8 * (t + 0.2).sin()));
    let turn: String = turn.collect();
    dir.write("loop.csv", format!("# rig 2\nu_um,F_N\n{turn}").as_bytes());
    let volumes = "cycle,wear_volume_um3,error_um3\n0,0,5\n2,30,5\n4,80,8\n6,100,10\n";
    dir.write("volume.csv", volumes.as_bytes());
    dir.write("depth.csv", b"cycle,depth_nm\n0,0\n2,2\n4,5\n6,6\n");
    dir
}

fn shot(dir: &TestDir, size: &str, keys: &str, arguments: &[&str]) -> String {
    let (columns, rows) = size.split_once('x').expect("a size");
    let number = |side: &str| side.parse().expect("a number");
    dir.screen(arguments, keys, (number(columns), number(rows)))
}

fn foot(screen: &str) -> &str {
    screen.lines().last().unwrap_or_default().trim()
}

const SCENE: &str = "li2019-fig3";

#[test]
fn data_are_in_the_panels_that_they_belong_to() {
    let dir = measured();
    let all = [
        SCENE,
        "--overlay",
        "scar.csv",
        "--overlay",
        "loop.csv",
        "--overlay",
        "volume.csv",
        "--overlay",
        "depth.csv",
    ];
    assert_snapshot!("ghosts-120x40", shot(&dir, "120x40", ",,,,", &all));
    assert_snapshot!(
        "ghosts-scar-80x24",
        shot(&dir, "80x24", ",,,,v<Tab><Tab><Tab>z", &all[..3])
    );
    assert_snapshot!(
        "ghosts-ascii-80x24",
        shot(
            &dir,
            "80x24",
            ",,,,",
            &[&all[..5], &["--marker", "ascii"]].concat()
        )
    );
    let depth = shot(&dir, "80x24", ",,,,vvvz<Tab><Tab><Tab>", &all);
    has(&depth, "depth over cycles");
    has(&depth, "depth.csv");
    // The same by a command; a scar has nothing to show in the loop.
    let text = shot(&dir, "80x24", ",:overlay scar.csv<Enter>", &[SCENE]);
    assert!(
        foot(&text).starts_with("scar.csv is over the plots now"),
        "{text}"
    );
    assert_eq!(text.matches("scar.csv").count(), 2, "{text}");
}

#[test]
fn a_run_over_itself_differs_by_nothing_in_any_panel() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 3 --out x --quiet --history every-step");
    for (tabs, quantity, unit) in [
        (0, "worn", "m"),
        (1, "p", "Pa"),
        (2, "F_x", "N"),
        (3, "a", "m"),
        (6, "g", "m"),
        (8, "V", "m³"),
    ] {
        let keys = format!(",,,x{}", "<Tab>".repeat(tabs));
        let text = shot(&dir, "200x50", &keys, &[SCENE, "--overlay", "x"]);
        let line = foot(&text);
        has(line, &format!("{quantity} "));
        assert!(line.contains(&format!("(+0 {unit})")), "{quantity}: {line}");
    }
}

#[test]
fn the_cursor_reads_the_signed_difference_of_measured_data() {
    let dir = TestDir::new();
    let flat = |nm: f64| format!("r_um,wear_nm\n0,{nm}\n50,{nm}\n100,{nm}\n");
    dir.write("flat.csv", flat(5.0).as_bytes());
    let text = shot(&dir, "200x50", ",x", &[SCENE, "--overlay", "flat.csv"]);
    let state = {
        shot(&dir, "80x24", ",s", &[SCENE]);
        Table::parse(&dir.read("li2019-fig3-cycle-1/state.csv"))
    };
    // Where the cursor begins, nothing to speak of has worn in the first cycle.
    let worn = state.column("wear_m")[0];
    assert!(worn.abs() < 1e-12, "{worn}");
    let line = foot(&text);
    has(line, "flat.csv 5.000 nm (+4.");
    dir.write("flat.csv", flat(-5.0).as_bytes());
    let text = shot(&dir, "200x50", ",x", &[SCENE, "--overlay", "flat.csv"]);
    has(foot(&text), "flat.csv -5.000 nm (-5.");
}

#[test]
fn a_scenario_runs_beside_to_the_cycle_on_the_screen() {
    let dir = TestDir::new();
    dir.done("run cone --cycles 2 --out cone-run --quiet");
    let read = |keys: &str, overlay: &str| {
        let text = shot(&dir, "120x40", keys, &[SCENE, "--overlay", overlay]);
        let line = foot(&text).replace("cone-run", "cone");
        assert!(line.contains(" cone "), "{text}");
        line
    };
    let expected = read(",,x", "cone-run");
    assert_eq!(read(",,x", "cone"), expected);
    // It goes back in time with the screen.
    assert_eq!(read(",,,,[[x", "cone"), expected);
}

#[test]
fn states_are_frozen_and_removed() {
    let dir = TestDir::new();
    let text = shot(&dir, "120x40", ",,g,,,", &[SCENE]);
    assert!(text.matches("cycle 2.00").count() >= 5, "{text}");
    // The frozen state stays what it was.
    let text = shot(&dir, "120x40", ",,g,,,x", &[SCENE]);
    let fresh = shot(&dir, "120x40", ",,x", &[SCENE]);
    let worn = |line: &str| {
        line.split("worn ")
            .nth(1)
            .expect("worn")
            .split("  ")
            .next()
            .expect("a value")
            .trim()
            .to_owned()
    };
    let frozen = foot(&text).split("cycle 2.00 ").nth(1).expect("a ghost");
    assert!(frozen.starts_with(&worn(foot(&fresh))), "{text}\n{fresh}");
    let text = shot(&dir, "120x40", ",,g,,,G", &[SCENE]);
    lacks(&text, "cycle 2.00");
    let text = shot(&dir, "80x24", ",ggggg", &[SCENE]);
    assert_eq!(foot(&text), "4 ghosts are there already; G removes them");
    let text = shot(&dir, "80x24", ",G", &[SCENE]);
    assert!(
        foot(&text).starts_with("there is no ghost; g freezes"),
        "{text}"
    );
}

/// A legend names the ghost in both profiles and pressures, and its difference from this run is drawn where the two
/// runs are still equal.
#[test]
fn a_comparison_keeps_the_ghosts() {
    let dir = TestDir::new();
    let with = shot(&dir, "120x40", ",,g,,c,", &[SCENE]);
    assert_eq!(with.matches("cycle 2.00").count(), 3, "{with}");
    let lone = shot(&dir, "120x40", ",,g,,c", &[SCENE]);
    lacks(&lone, "equal so far");
    assert_eq!(lone.matches("cycle 2.00").count(), 3, "{lone}");
    let without = shot(&dir, "120x40", ",,,,c", &[SCENE]);
    has(&without, "equal so far");
}

#[test]
fn what_cannot_be_laid_over_is_one_line() {
    let dir = TestDir::new();
    let open: String = (0..20).map(|i| format!("{i},{}\n", 2 * i)).collect();
    std::fs::create_dir(dir.path("empty")).expect("a directory");
    for (text, told) in [
        (
            "a,b\n1,2\n",
            "bad.csv: has nothing to draw: needs r_m with wear_m or f_m",
        ),
        (
            "r_um,wear_nm\n0,1\n10,\n20,3\n",
            "bad.csv: line 3: wear_nm is empty",
        ),
        (
            "r_um,wear_nm\n0,1\n10,NaN\n20,3\n",
            "line 3: wear_nm = NaN: must be a finite number",
        ),
        (
            "r_um,wear_nm\n0,1\n10,2\n",
            "bad.csv: has fewer than 3 rows",
        ),
        (
            "r_m,wear_nm\n0,1\n0.05,2\n0.1,3\n",
            "radii up to 1.0e-1 m, but the contact reaches only 1.5e-4 m: are they in m?",
        ),
        (
            &format!("u_um,F_N\n{open}"),
            "bad.csv: the loop does not close",
        ),
        ("", "bad.csv: has nothing to draw"),
    ] {
        dir.write("bad.csv", text.as_bytes());
        for arguments in [
            vec![SCENE, "--overlay", "bad.csv", "--print", "80x24"],
            vec![
                "figure",
                SCENE,
                "--cycles",
                "1",
                "--overlay",
                "bad.csv",
                "-o",
                "figure.svg",
            ],
        ] {
            let said = dir.say(&arguments);
            assert_eq!((said.code, said.out.as_str()), (2, ""), "{}", said.err);
            assert!(
                said.err.contains(told) && said.err.lines().count() == 1,
                "{}",
                said.err
            );
        }
        let text = shot(&dir, "200x24", ",:overlay bad.csv<Enter>", &[SCENE]);
        has(foot(&text), &told[..20]);
    }
    assert_eq!(names(&dir.path(".")), ["bad.csv", "empty"]);
    for (given, told) in cases([
        "nowhere.csv => nowhere.csv: no such file",
        "empty => empty: holds no state.csv and no history.csv of a run",
        "conee => did you mean cone?",
        "missing.toml => missing.toml",
    ]) {
        let said = dir.say(&[SCENE, "--overlay", given, "--print", "80x24"]);
        assert!(said.code == 2 && said.err.contains(told), "{}", said.err);
        assert_eq!(said.err.lines().count(), 1, "{}", said.err);
    }
    let five = ["cone"; 5].map(|name| ["--overlay", name]).concat();
    let said = dir.say(&[&[SCENE, "--print", "80x24"], &five[..]].concat());
    has(&said.err, "--overlay: takes 4 or fewer; there are 5");
}

#[test]
fn a_snapshot_goes_on_as_if_it_had_never_stopped() {
    for (before, after) in [(",,,", ",,"), ("..........", ",.."), (",,m,", "w,")] {
        let dir = TestDir::new();
        let first = format!("{before}S first look<Enter>");
        let text = shot(&dir, "80x24", &first, &[SCENE]);
        let at = foot(&text).trim_start_matches("snapshot in ");
        let snapshot = at.trim_end_matches("/state.csv").to_owned();
        assert_eq!(
            names(&dir.path(&snapshot)),
            [
                "history.csv",
                "loop.csv",
                "scenario.toml",
                "state.checkpoint",
                "state.csv"
            ]
        );
        has(&dir.read(at), "\n# note: first look\n");
        let goes_on = |dir: &TestDir, keys: &str, scenario: &str| {
            let text = shot(dir, "80x24", &format!("{keys}{after}s"), &[scenario]);
            foot(&text)
                .trim_start_matches("snapshot in ")
                .trim_end_matches("/state.csv")
                .to_owned()
        };
        let whole = goes_on(&dir, before, SCENE);
        let by_name = goes_on(&dir, "", &snapshot);
        for name in [
            "state.csv",
            "history.csv",
            "loop.csv",
            "scenario.toml",
            "state.checkpoint",
        ] {
            let read = |directory: &str| std::fs::read(dir.path(directory).join(name)).expect(name);
            assert!(read(&whole) == read(&by_name), "{before} {name}");
        }
        // Without a screen it goes on as well.
        let file = format!("{snapshot}/state.checkpoint");
        dir.done(&format!("run --resume {file} --cycles 6 --out on --quiet"));
        has(&dir.read("on/state.csv"), "\n# cycle: 6\n");
    }
}

#[test]
fn the_list_shows_a_snapshot_with_its_note_and_opens_it() {
    let dir = TestDir::new();
    shot(&dir, "80x24", ",,,S worn in<Enter>", &[SCENE]);
    let text = shot(&dir, "80x24", "p<End>k", &["hertz"]);
    assert_snapshot!("snapshot-listed-80x24", text);
    let text = shot(&dir, "120x40", "p<End>k<Enter>,", &["hertz"]);
    has(&text, "cycle 4.00/199.24");
    // It is the same state as that of the directory's name, its past included.
    assert_eq!(text, shot(&dir, "120x40", ",", &["li2019-fig3-cycle-3"]));
    let text = shot(
        &dir,
        "80x24",
        ":load li2019-fig3-cycle-3<Enter>",
        &["hertz"],
    );
    has(&text, "cycle 3.00/199.24");
}

#[test]
fn a_directory_without_a_state_is_refused_and_torn_ones_too() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 1 --out x --quiet");
    let refused = |arguments: &[&str], told: &str| {
        let said = dir.say(&[arguments, &["--print", "80x24"]].concat());
        assert!(
            said.code == 2 && said.err.contains(told),
            "{} {}",
            said.code,
            said.err
        );
        assert_eq!(said.err.lines().count(), 1, "{}", said.err);
    };
    refused(
        &["x"],
        "x: is a directory without a state.checkpoint to go on from; its scenario.toml",
    );
    shot(&dir, "80x24", ",s", &[SCENE]);
    let file = dir.path("li2019-fig3-cycle-1/state.checkpoint");
    refused(
        &["li2019-fig3-cycle-1", "--set", "wear.coefficient=1e-12"],
        "--set changes nothing",
    );
    let whole = std::fs::read(&file).expect("a checkpoint");
    std::fs::write(&file, &whole[..whole.len() / 2]).expect("half of it");
    refused(&["li2019-fig3-cycle-1"], "is damaged");
}

#[test]
fn figures_have_measured_points_with_their_errors_beside_the_run() {
    let dir = measured();
    dir.done("run li2019-fig3 --cycles 3 --out x --quiet --history every-step");
    dir.done("figure x --overlay scar.csv --overlay loop.csv --overlay volume.csv --overlay depth.csv -o f.svg --quiet");
    let figure = Table::parse(&dir.read("f.csv"));
    let rows = |title: &str, curve: &str| -> Vec<Vec<String>> {
        let panels = figure
            .header
            .iter()
            .filter(|(key, _)| key.starts_with("panel "));
        let (key, _) = panels
            .clone()
            .find(|(_, value)| value.starts_with(title))
            .expect(title);
        let panel = key.trim_start_matches("panel ");
        let rows = figure
            .rows
            .iter()
            .filter(|row| row[0] == panel && row[1] == curve);
        rows.cloned().collect()
    };
    let scar = rows("worn depth,", "scar.csv");
    assert_eq!(scar.len(), 27);
    let number = |field: &str| field.parse::<f64>().expect("a number");
    for row in &scar {
        assert!((number(&row[5]) / 1.5e-9 - 1.0).abs() < 1e-12, "{row:?}");
        let r = number(&row[2]);
        let depth = 6e-9 * (-((r - 80e-6) / 20e-6).powi(2)).exp();
        assert!((number(&row[3]) - depth).abs() < 1e-12, "{row:?}");
    }
    assert_eq!(rows("3D profile", "scar.csv").len(), 27);
    assert_eq!(rows("fretting loop", "loop.csv").len(), 60);
    assert!(
        rows("fretting loop", "loop.csv")
            .iter()
            .all(|row| row[5].is_empty())
    );
    assert_eq!(rows("wear volume", "volume.csv")[3][5], "1e-17");
    assert_eq!(rows("depth over cycles", "depth.csv").len(), 4);
    // The curve under the points has a name beside theirs.
    has(&dir.read("f.svg"), ">computed<");
    // A symbol of four corners and a bar for each point of the scar, in two charts.
    let svg = dir.read("f.svg");
    assert!(
        svg.matches("stroke-width=\"0.2\"").count() > 2 * 2 * 27,
        "{}",
        svg.len()
    );
    // Another run and a scenario are lines; both are the same run here.
    dir.done(
        "figure x --overlay x/state.csv --overlay li2019-fig3 --panel worn-depth -o g.svg --quiet",
    );
    let figure = Table::parse(&dir.read("g.csv"));
    let of = |name: &str| -> Vec<Vec<String>> {
        let rows = figure.rows.iter().filter(|row| row[1] == name);
        rows.map(|row| row[2..].to_vec()).collect()
    };
    assert!(!of("").is_empty() && of("state.csv") == of("") && of("li2019-fig3") == of(""));
    let measured = dir.read("scar.csv");
    let said = dir.say(&[
        "figure",
        "x",
        "--overlay",
        "scar.csv",
        "-o",
        "scar.svg",
        "--force",
    ]);
    // What is drawn stays as it is: the data go beside it.
    let names = "scar.svg and scar-drawn.csv\n";
    assert_eq!(
        (said.code, said.err, said.out),
        (0, String::new(), names.into())
    );
    has(&dir.read("scar-drawn.csv"), "panel,curve,x,y,value,error");
    assert_eq!(dir.read("scar.csv"), measured);
    let said = dir.say(&[
        "figure",
        "x",
        "--overlay",
        "loop.csv",
        "--panel",
        "profile",
        "-o",
        "h.svg",
    ]);
    assert_eq!(said.code, 2);
    assert_eq!(
        said.err,
        "mdr-tui: --overlay loop.csv: is on none of these charts; it belongs to --panel loop\n"
    );
    assert!(!dir.path("h.svg").exists() && !dir.path("h.csv").exists());
}

#[test]
fn a_snapshot_makes_figures_and_is_an_overlay() {
    let dir = TestDir::new();
    shot(&dir, "80x24", ",,,s", &[SCENE]);
    let snapshot = "li2019-fig3-cycle-3";
    dir.done(&format!("figure {snapshot} --panel loop --panel volume --panel radii --panel scar-depth -o f.svg --quiet"));
    let figure = Table::parse(&dir.read("f.csv"));
    let steps = Table::parse(&dir.read("li2019-fig3-cycle-3/loop.csv"))
        .rows
        .len();
    assert!(steps > 100, "{steps}");
    let count = |panel: &str| figure.rows.iter().filter(|row| row[0] == panel).count();
    assert_eq!(
        [count("a"), count("b"), count("c"), count("d")],
        [steps, 3, 6, 3]
    );
    let text = shot(
        &dir,
        "200x50",
        ",,,x<Tab><Tab>",
        &[SCENE, "--overlay", snapshot],
    );
    has(foot(&text), "(+0 N)");
    // Its loop is data for a fit.
    let fit = format!(
        "fit {SCENE} --cycles 3 --loop {snapshot}/loop.csv --free friction.coefficient --json --quiet"
    );
    let said = dir.say(&fit.split(' ').collect::<Vec<_>>());
    assert_eq!(said.code, 0, "{}", said.err);
    has(&said.out, "friction.coefficient");
}
