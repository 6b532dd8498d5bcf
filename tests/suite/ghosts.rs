//! Other curves over a run's: measured data, runs, scenarios and frozen states, on screens and in
//! figures; and snapshots, which hold what is needed to go on.

use crate::common::near;
use crate::screen_table::hold;
use crate::test_dir::{TestDir, has};

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
    for (name, nm) in [("flat.csv", 5.0), ("below.csv", -5.0)] {
        let text = format!("r_um,wear_nm\n0,{nm}\n50,{nm}\n100,{nm}\n");
        dir.write(name, text.as_bytes());
    }
    dir.write("depth.csv", b"cycle,depth_nm\n0,0\n2,2\n4,5\n6,6\n");
}

#[test]
fn curves_are_over_the_plots_as_the_table_says() {
    hold("ghosts", measure);
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
    // The curve under the points has a name next to theirs.
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
    // What is drawn stays unchanged: the data go into a file next to it.
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
