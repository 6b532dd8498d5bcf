//! Other curves over those of a run: measured data, runs, scenarios and frozen states, on screens and in
//! figures; and snapshots, which hold what is needed to go on.

use crate::common::near;
use crate::screen_table::{hold, part_of};
use crate::test_dir::{TestDir, has, names};

/// A scar in µm and nm with errors, a loop, and two histories.
fn measure(dir: &TestDir) {
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
}

fn shot(dir: &TestDir, size: &str, keys: &str, arguments: &[&str]) -> String {
    let (columns, rows) = size.split_once('x').expect("a size");
    let number = |side: &str| side.parse().expect("a number");
    dir.screen(arguments, keys, (number(columns), number(rows)))
}

fn foot(screen: &str) -> String {
    part_of(screen, "foot")
}

const SCENE: &str = "li2019-fig3";

#[test]
fn curves_are_over_the_plots_as_the_table_says() {
    hold("ghosts", include_str!("ghosts.txt"), measure);
}

#[test]
fn the_cursor_reads_the_signed_difference_of_measured_data() {
    let dir = TestDir::new();
    let flat = |nm: f64| format!("r_um,wear_nm\n0,{nm}\n50,{nm}\n100,{nm}\n");
    dir.write("flat.csv", flat(5.0).as_bytes());
    let text = shot(&dir, "200x50", ",x", &[SCENE, "--overlay", "flat.csv"]);
    let state = {
        shot(&dir, "80x24", ",s", &[SCENE]);
        dir.table("li2019-fig3-cycle-1/state.csv")
    };
    // Where the cursor begins, nothing to speak of has worn in the first cycle.
    let worn = state.column("wear_m")[0];
    assert!(worn.abs() < 1e-12, "{worn}");
    let line = foot(&text);
    has(&line, "flat.csv 5.000 nm (+4.");
    dir.write("flat.csv", flat(-5.0).as_bytes());
    let text = shot(&dir, "200x50", ",x", &[SCENE, "--overlay", "flat.csv"]);
    has(&foot(&text), "flat.csv -5.000 nm (-5.");
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
    let shot = |keys: &str| shot(&dir, "120x40", keys, &[SCENE]);
    assert!(shot(",,g,,,").matches("cycle 2.00").count() >= 5);
    // The frozen state stays what it was.
    let (kept, fresh) = (foot(&shot(",,g,,,x")), foot(&shot(",,x")));
    let (_, frozen) = kept.split_once("cycle 2.00 ").expect("a ghost");
    let (_, worn) = fresh.split_once("worn ").expect("worn");
    let worn = worn.split("  ").next().unwrap_or_default().trim();
    assert!(frozen.starts_with(worn), "{kept}\n{fresh}");
}

#[test]
fn what_cannot_be_laid_over_is_one_line() {
    let dir = TestDir::new();
    let open: String = (0..20).map(|i| format!("{i},{}\n", 2 * i)).collect();
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
        for line in ["--print 80x24", "-o figure.svg"] {
            let command = if line.starts_with("-o") { "figure" } else { "" };
            dir.refuse_line(&format!("{command} {SCENE} --overlay bad.csv {line}"), told);
        }
        let text = shot(&dir, "200x24", ",:overlay bad.csv<Enter>", &[SCENE]);
        has(&foot(&text), &told[..20]);
    }
    assert_eq!(names(&dir.path(".")), ["bad.csv"]);
}

#[test]
fn a_snapshot_goes_on_as_if_it_had_never_stopped() {
    let files = [
        "history.csv",
        "loop.csv",
        "scenario.toml",
        "state.checkpoint",
        "state.csv",
    ];
    for (before, after) in [(",,,", ",,"), ("..........", ",.."), (",,m,", "w,")] {
        let dir = TestDir::new();
        let snapshot = |keys: &str, scenario: &str| {
            let told = foot(&shot(&dir, "80x24", keys, &[scenario]));
            let at = told.trim_start_matches("snapshot in ");
            at.trim_end_matches("/state.csv").to_owned()
        };
        let first = snapshot(&format!("{before}S first look<Enter>"), SCENE);
        assert_eq!(names(&dir.path(&first)), files);
        has(
            &dir.read(&format!("{first}/state.csv")),
            "\n# note: first look\n",
        );
        let whole = snapshot(&format!("{before}{after}s"), SCENE);
        let by_name = snapshot(&format!("{after}s"), &first);
        for name in files {
            let read = |directory: &str| std::fs::read(dir.path(directory).join(name)).expect(name);
            assert!(read(&whole) == read(&by_name), "{before} {name}");
        }
        // Without a screen it goes on as well.
        dir.done(&format!(
            "run --resume {first}/state.checkpoint --cycles 6 --out on --quiet"
        ));
        has(&dir.read("on/state.csv"), "\n# cycle: 6\n");
    }
}

#[test]
fn a_directory_without_a_state_is_refused_and_torn_ones_too() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 1 --out x --quiet");
    let refused = |arguments: &str, told: &str| {
        dir.refuse_line(&format!("{arguments} --print 80x24"), told);
    };
    refused(
        "x",
        "x: is a directory without a state.checkpoint to go on from; its scenario.toml",
    );
    shot(&dir, "80x24", ",s", &[SCENE]);
    let snapshot = "li2019-fig3-cycle-1";
    refused(
        &format!("{snapshot} --set wear.coefficient=1e-12"),
        "--set changes nothing",
    );
    let file = format!("{snapshot}/state.checkpoint");
    let whole = std::fs::read(dir.path(&file)).expect("a checkpoint");
    dir.write(&file, &whole[..whole.len() / 2]);
    refused(snapshot, "is damaged");
}

#[test]
fn figures_have_measured_points_with_their_errors_beside_the_run() {
    let dir = TestDir::new();
    measure(&dir);
    dir.done("run li2019-fig3 --cycles 3 --out x --quiet --history every-step");
    dir.done("figure x --overlay scar.csv --overlay loop.csv --overlay volume.csv --overlay depth.csv -o f.svg --quiet");
    let figure = dir.table("f.csv");
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
        near("error", number(&row[5]), 1.5e-9, 1e-12);
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
    let figure = dir.table("g.csv");
    let of = |name: &str| -> Vec<Vec<String>> {
        let rows = figure.rows.iter().filter(|row| row[1] == name);
        rows.map(|row| row[2..].to_vec()).collect()
    };
    assert!(!of("").is_empty() && of("state.csv") == of("") && of("li2019-fig3") == of(""));
    // What is drawn stays as it is: the data go beside it.
    let measured = dir.read("scar.csv");
    let names = dir.done("figure x --overlay scar.csv -o scar.svg --force");
    assert_eq!(names, "scar.svg and scar-drawn.csv\n");
    has(&dir.read("scar-drawn.csv"), "panel,curve,x,y,value,error");
    assert_eq!(dir.read("scar.csv"), measured);
    dir.refuse_line(
        "figure x --overlay loop.csv --panel profile -o h.svg",
        "--overlay loop.csv: is on none of these charts; it belongs to --panel loop",
    );
}

#[test]
fn a_snapshot_makes_figures_and_is_an_overlay() {
    let dir = TestDir::new();
    shot(&dir, "80x24", ",,,s", &[SCENE]);
    let snapshot = "li2019-fig3-cycle-3";
    dir.done(&format!("figure {snapshot} --panel loop --panel volume --panel radii --panel scar-depth -o f.svg --quiet"));
    let figure = dir.table("f.csv");
    let steps = dir.table("li2019-fig3-cycle-3/loop.csv").rows.len();
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
    has(&foot(&text), "(+0 N)");
    // Its loop is data for a fit.
    let fit = format!(
        "fit {SCENE} --cycles 3 --loop {snapshot}/loop.csv --free friction.coefficient --json --quiet"
    );
    let said = dir.say(&fit.split(' ').collect::<Vec<_>>());
    assert_eq!(said.code, 0, "{}", said.err);
    has(&said.out, "friction.coefficient");
}
