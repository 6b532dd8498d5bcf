//! Figures for a paper: what is drawn, where it stands, and what is refused.

use std::fs;

use crate::test_dir::{Table, TestDir};
use mdr_tui::figure::Sheet;
use mdr_tui::figure::chart::{Axis, Chart};
use mdr_tui::figure::ink::{Ink, Look, Style};
use mdr_tui::figure::svg;
use mdr_tui::plot::Scale;

/// The rows of one curve of a figure's data.
fn curve(data: &Table, panel: &str, name: &str) -> (Vec<f64>, Vec<f64>) {
    let rows = data.rows.iter();
    let rows = rows.filter(|row| row[0] == panel && row[1] == name);
    let number = |field: &str| field.parse::<f64>().expect("a number");
    rows.map(|row| (number(&row[2]), number(&row[3]))).unzip()
}

/// A file of data, its panel lines apart.
fn data(dir: &TestDir, name: &str) -> Table {
    Table::parse(&dir.read(name))
}

#[test]
fn an_svg_is_lines_and_words_in_millimetres() {
    let mut y = Axis::new("p", "Pa");
    y.bounds = Some([0.0, 2e9]);
    let mut chart = Chart::new("pressure", Axis::new("r", "m"), y);
    let xs = [0.0, 5e-5, 1e-4];
    chart.curve("p & τ", &xs, &[2e9, 1.5e9, 0.0], Ink::Pressure, false);
    // What leaves the frame is cut at its edge.
    chart.curve("", &xs, &[1e9, 3e9, f64::NAN], Ink::Limit, true);
    chart.marks.push((5e-5, "c"));
    let mut logged = Axis::new("error", "");
    logged.scale = Scale::Log;
    let mut errors = Chart::new("errors", Axis::new("r/a", ""), logged);
    errors.curve(
        "A",
        &[0.0, 0.5, 1.0],
        &[1e-4, 0.0, 1e-2],
        Ink::Series(0),
        false,
    );
    let sheet = Sheet {
        title: "a <figure>".into(),
        facts: vec![("method".into(), "product".into())],
        charts: vec![chart, errors],
    };
    let look = Look {
        font: 2.8,
        style: Style::Color,
    };
    insta::assert_snapshot!("figure", svg::write(&sheet.draw([120.0, 50.0], &look)));
    let grey = Look {
        style: Style::Grey,
        ..look
    };
    let text = svg::write(&sheet.draw([120.0, 50.0], &grey));
    let colors = text.split('#').skip(1).map(|rest| &rest[..6]);
    for color in colors {
        assert!(
            color[..2] == color[2..4] && color[..2] == color[4..],
            "{color}"
        );
    }
}

#[test]
fn figure_three_is_one_command_and_its_data_are_those_of_the_run() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 3.24 --snapshot-at 1.72,2 --out x --quiet");
    dir.done("figure x --figure fig3 -o fig3.svg --quiet");
    dir.done("figure li2019-fig3 --figure fig3 --at 1.72,2,3.24 -o again.svg --quiet");
    assert_eq!(dir.read("fig3.svg"), dir.read("again.svg"));
    let (figure, state) = (data(&dir, "fig3.csv"), data(&dir, "x/state.csv"));
    for (panel, name, column) in [
        ("a", "3.24 cycles", "f_m"),
        ("a", "unworn", "f0_m"),
        ("b", "3.24 cycles", "g_m"),
        ("d", "p", "p_Pa"),
        ("d", "τ", "tau_Pa"),
    ] {
        let (radii, values) = curve(&figure, panel, name);
        assert_eq!(radii, state.column("r_m"), "{panel} {name}");
        assert_eq!(values, state.column(column), "{panel} {name}");
    }
    let first = data(&dir, "x/state-1.72.csv");
    assert_eq!(curve(&figure, "c", "p").1, first.column("p_Pa"));
    assert!(!curve(&figure, "a", "limit").0.is_empty());
    assert_eq!(figure.header("method"), state.header("method"));
    assert_eq!(figure.header("cycles"), "1.72, 2, 3.24");
}

#[test]
fn figure_two_has_the_errors_of_both_methods() {
    let dir = TestDir::new();
    dir.done("figure --figure fig2 -o fig2.svg --quiet");
    let figure = data(&dir, "fig2.csv");
    // Both methods have the same 1D profile; for the deformation A is better, as the paper says.
    let worst = |panel, name| {
        let (radii, errors) = curve(&figure, panel, name);
        assert!(radii.len() > 90, "{panel} {name}");
        let errors = errors.iter().zip(&radii).filter(|(_, r)| **r < 0.9);
        errors.map(|(e, _)| *e).fold(0.0, f64::max)
    };
    assert!(worst("c", "method A") < worst("c", "method B"));
    assert!(worst("b", "method A") < 0.1);
    assert_eq!(figure.header("points"), "100");
}

/// Both loops have the same forces; the sensor sees u + F_x/stiffness. A stiff rig has one loop, without a name.
#[test]
fn a_rig_that_yields_has_two_loops() {
    let dir = TestDir::new();
    let rig = "gross-slip --set motion.tangential.rig_stiffness=3e7";
    for source in [
        format!("run {rig} --cycles 3 --history every-step --out x --quiet"),
        "figure x --panel loop -o run.svg --quiet".into(),
        format!("figure {rig} --at 3 --panel loop -o scenario.svg --quiet"),
        format!("figure {rig} --at 2,3 --panel loop -o two.svg --quiet"),
        "figure gross-slip --at 3 --panel loop -o stiff.svg --quiet".into(),
    ] {
        dir.done(&source);
    }
    for name in ["run", "scenario"] {
        let figure = data(&dir, &format!("{name}.csv"));
        let (contact, sensor) = (
            curve(&figure, "a", "contact"),
            curve(&figure, "a", "rig's sensor"),
        );
        assert!(contact.0.len() > 90, "{name}");
        assert_eq!(contact.1, sensor.1, "{name}");
        for ((u, sensed), force) in contact.0.iter().zip(&sensor.0).zip(&contact.1) {
            assert!(
                (sensed - (u + force / 3e7)).abs() < 1e-6 * sensed.abs().max(1e-9),
                "{name}"
            );
        }
        assert!(
            dir.read(&format!("{name}.svg")).contains("rig's sensor"),
            "{name}"
        );
    }
    let two = data(&dir, "two.csv");
    for end in [2, 3] {
        let named = |suffix: &str| curve(&two, "a", &format!("{end} cycles{suffix}"));
        assert_eq!(named("").1, named(" (rig's sensor)").1, "{end}");
    }
    assert!(!dir.read("stiff.svg").contains("sensor"));
    // The screen's figure has what its panel has.
    let said = dir.say(&[
        "gross-slip",
        "--set",
        "motion.tangential.rig_stiffness=3e7",
        "--keys",
        ",,,:figure screen.svg<Enter>",
        "--print",
        "80x24",
    ]);
    assert_eq!((said.code, said.err.as_str()), (0, ""));
    let screen = data(&dir, "screen.csv");
    assert_eq!(
        curve(&screen, "d", "contact").1,
        curve(&screen, "d", "rig's sensor").1
    );
}

#[test]
fn pixels_have_the_size_that_was_asked_for_and_pages_their_font() {
    let dir = TestDir::new();
    dir.done("run mindlin --cycles 1 --history every-step --field --out x --quiet");
    dir.done("figure x --panel von-mises --panel loop --size 100x40 --dpi 254 -o f.png --quiet");
    let file = fs::File::open(dir.path("f.png")).expect("a file");
    let mut reader = png::Decoder::new(std::io::BufReader::new(file))
        .read_info()
        .expect("an image");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let about = reader.next_frame(&mut pixels).expect("pixels");
    assert_eq!((about.width, about.height), (1000, 400));
    let dims = reader.info().pixel_dims.expect("a resolution");
    assert_eq!(dims.xppu, 10_000);
    let texts: Vec<String> = reader
        .info()
        .utf8_text
        .iter()
        .map(|text| text.get_text().expect("a text"))
        .collect();
    assert!(
        texts.iter().any(|text| text.contains("method: ")),
        "{texts:?}"
    );
    // The map has the colours of its scale, words are black, paper is white.
    let count = |wanted: [u8; 3]| {
        pixels
            .chunks(4)
            .filter(|pixel| pixel[..3] == wanted)
            .count()
    };
    assert!(count([255; 3]) > 100_000 && count([0; 3]) > 500);
    let colored = pixels
        .chunks(4)
        .filter(|p| p[1].abs_diff(p[0]) > 60)
        .count();
    assert!(colored > 20_000, "{colored}");
    // The loop closes, and every step is in it.
    let (shifts, _) = curve(&data(&dir, "f.csv"), "b", "");
    assert!(shifts.len() > 100);
    assert!((shifts[0] - shifts[shifts.len() - 1]).abs() < 1e-12);

    dir.done("figure x --panel loop -o f2.pdf --quiet");
    let pdf = fs::read(dir.path("f2.pdf")).expect("a file");
    let holds = |word: &[u8]| pdf.windows(word.len()).any(|place| place == word);
    assert!(pdf.starts_with(b"%PDF-") && pdf.trim_ascii_end().ends_with(b"%%EOF"));
    for word in [
        &b"/NotoSans-Regular"[..],
        b"/FontFile2",
        b"/ToUnicode",
        b"/Title",
    ] {
        assert!(holds(word), "{}", String::from_utf8_lossy(word));
    }
}

#[test]
fn what_cannot_be_drawn_is_one_line_and_nothing_written() {
    let dir = TestDir::new();
    dir.done("run hertz --cycles 1 --out x --quiet");
    dir.write("other.csv", b"a,b\n1,2\n");
    dir.write("torn.csv", b"r_m,f_m\n1\n");
    fs::create_dir(dir.path("empty")).expect("a directory");
    dir.write("there.svg", b"");
    let before = dir.inventory();
    for (line, expected) in [
        ("figure x -o f.jpg", "must end in .svg, .png or .pdf"),
        ("figure x -o there.svg", "already exists"),
        ("figure x -o no/such/f.svg", "its directory does not exist"),
        ("figure x --panel loop -o f.svg", "one row per cycle"),
        (
            "figure x --panel von-mises -o f.svg",
            "run --field writes it",
        ),
        ("figure x --at 7 -o f.svg", "has no such state"),
        (
            "figure x --set friction.coefficient=1 -o f.svg",
            "is not run again",
        ),
        ("figure x --size 0x0 -o f.svg", "each from 20 to 2000"),
        ("figure x --panel circle -o f.svg", "invalid value 'circle'"),
        ("figure empty -o f.svg", "has no state.csv"),
        (
            "figure other.csv -o f.svg",
            "does not have the columns of a state",
        ),
        (
            "figure torn.csv -o f.svg",
            "line 2: 1 fields under 2 columns",
        ),
        (
            "figure x --size 2000x2000 --dpi 2400 -o f.png",
            "an image has 1 to 1e8",
        ),
        ("figure -o f.svg", "needs a run's directory"),
        ("figure x --figure fig2 -o f.svg", "takes no source"),
        ("figure nowhere -o f.svg", "nowhere"),
    ] {
        let arguments: Vec<&str> = line.split_whitespace().collect();
        let said = dir.say(&arguments);
        assert_eq!(
            (said.code, said.out.as_str()),
            (2, ""),
            "{line}: {}",
            said.err
        );
        assert_eq!(said.err.lines().count(), 1, "{line}: {}", said.err);
        assert!(said.err.contains(expected), "{line}: {}", said.err);
    }
    assert!(dir.inventory() == before);
}
