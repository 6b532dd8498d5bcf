//! Figures for a paper: what is drawn, where it stands, and what is refused.

use std::fs;

use crate::common::{apart, fig3_motion, holds, largest, near};
use crate::test_dir::{Table, TestDir, cases, has, lacks};
use mdr_tui::figure::Sheet;
use mdr_tui::figure::canvas::Primitive;
use mdr_tui::figure::look::{FigureStyle, Style};
use mdr_tui::figure::svg;
use mdr_tui::plot::colormap::ColorMap;
use mdr_tui::plot::theme::Role;
use mdr_tui::plot::{Axis, Chart, Curve, Map, Mark, Scale};

/// The rows of one curve of a figure's data.
fn curve(data: &Table, panel: &str, name: &str) -> (Vec<f64>, Vec<f64>) {
    let rows = data.rows.iter();
    let rows = rows.filter(|row| row[0] == panel && row[1] == name);
    // Gaps are empty.
    let number = |field: &str| match field {
        "" => f64::NAN,
        field => field.parse().expect("a number"),
    };
    rows.map(|row| (number(&row[2]), number(&row[3]))).unzip()
}

#[test]
fn an_svg_is_lines_and_words_in_millimetres() {
    let y = Axis::new("p", "Pa").bounds([0.0, 2e9]);
    let xs = [0.0, 5e-5, 1e-4];
    let pressure = Curve::new("p & τ", xs, [2e9, 1.5e9, 0.0], Role::Pressure);
    // What leaves the frame is cut at its edge.
    let cut = Curve::new("", xs, [1e9, 3e9, f64::NAN], Role::Limit).dashed();
    let mut chart = Chart::new("pressure", Axis::new("r", "m"), y).curves([pressure, cut]);
    chart.marks.push(Mark {
        x: 5e-5,
        label: "c",
        role: Role::Stick,
    });
    let logged = Axis::new("error", "").scale(Scale::Log);
    let series = Curve::new("A", [0.0, 0.5, 1.0], [1e-4, 0.0, 1e-2], Role::Series(0));
    let errors = Chart::new("errors", Axis::new("r/a", ""), logged).curve(series);
    let sheet = Sheet {
        title: "a <figure>".into(),
        facts: vec![("method".into(), "product".into())],
        charts: vec![chart, errors],
    };
    let [drawn, text] = [Style::Color, Style::Grey].map(|style| {
        let look = FigureStyle { font: 2.8, style };
        svg::write(&sheet.draw([120.0, 50.0], &look))
    });
    insta::assert_snapshot!("figure", drawn);
    let colors = text.split('#').skip(1).map(|rest| &rest[..6]);
    for color in colors {
        assert_eq!(color, color[..2].repeat(3));
    }
}

#[test]
fn figure_three_is_one_command_and_its_data_are_those_of_the_run() {
    let dir = TestDir::new();
    dir.done("run li2019-fig3 --cycles 3.24 --snapshot-at 1.72,2 --out x --quiet");
    dir.done("figure x --figure fig3 -o fig3.svg --quiet");
    dir.done("figure li2019-fig3 --figure fig3 --at 1.72,2,3.24 -o again.svg --quiet");
    assert_eq!(dir.read("fig3.svg"), dir.read("again.svg"));
    let (figure, state) = (dir.table("fig3.csv"), dir.table("x/state.csv"));
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
    let first = dir.table("x/state-1.72.csv");
    assert_eq!(curve(&figure, "c", "p").1, first.column("p_Pa"));
    assert!(!curve(&figure, "a", "limit").0.is_empty());
    assert_eq!(figure.header("method"), state.header("method"));
    assert_eq!(figure.header("cycles"), "1.72, 2, 3.24");
}

/// The rows of the guide's tables on the paper's figures, each number from the data of the figure.
#[test]
fn the_guide_lays_the_figures_beside_the_papers() {
    let dir = TestDir::new();
    dir.done("figure --figure fig2 -o fig2.svg --quiet");
    dir.done("figure --figure fig3 -o fig3.svg --quiet");
    let guide = dir.done("guide figures");
    let page: String = include_str!("../../src/guide/figures.md").into();
    has(&guide, "point by point");
    let says = |start: &str, texts: &[String]| {
        let start = format!("| {start}");
        let row = page.lines().find(|line| line.starts_with(&start));
        for text in texts {
            has(row.expect(&start), text);
        }
    };

    let errors = dir.table("fig2.csv");
    assert_eq!(errors.header("points"), "100");
    let of = |panel, method: &str| curve(&errors, panel, &format!("method {method}")).1;
    let (a, b) = (of("a", "A"), of("a", "B"));
    let inner = a.len() - 1;
    holds("a against b", apart(&a[..inner], &b[..inner]), 1e-14);
    let last = |errors: &[f64]| format!("{:.1e}", errors[errors.len() - 1]);
    says(
        "(a) 1D profile",
        &[format!("{} (A) and {} (B)", last(&a), last(&b))],
    );
    let worst = |errors: &[f64]| largest(errors.iter().copied());
    assert_eq!((worst(&a), worst(&b)), (a[0], b[0]));
    says("(a) largest error", &[format!("{:.1e} with both", a[0])]);
    for (panel, start) in [("b", "(b) normal stress"), ("c", "(c) normal deformation")] {
        let (a, b) = (worst(&of(panel, "A")), worst(&of(panel, "B")));
        says(start, &[format!("{a:.1e} (A), {b:.1e} (B)")]);
    }
    assert_eq!(of("b", "A")[1], worst(&of("b", "A")));
    assert!(10.0 * worst(&of("c", "A")) < worst(&of("c", "B")));

    for method in ["a", "b"] {
        dir.done(&format!(
            "figure li2019-fig3 --figure fig3 --set numerics.method={method} -o fig3-{method}.svg --quiet"
        ));
    }
    let [product, a, b] =
        ["fig3", "fig3-a", "fig3-b"].map(|name| dir.table(&format!("{name}.csv")));
    for figure in [&product, &a, &b] {
        assert_eq!(figure.header("points"), "100");
        assert_eq!(figure.header("cycles"), "50.72, 100, 199.24");
    }
    // c = 41.64 µm, and the first node that wears without end.
    let stick = 1e-4 * fig3_motion().stick_radius(1.0);
    let (radii, limit) = curve(&product, "a", "limit");
    let unworn = curve(&product, "a", "unworn").1;
    let worn = (0..radii.len())
        .find(|&i| limit[i] > unworn[i] + 1e-12)
        .expect("wear");
    let [inside, outside] = [worn - 1, worn].map(|i| 1e6 * radii[i]);
    let is_between = inside - 1e-6 <= 1e6 * stick && 1e6 * stick < outside;
    assert!(is_between, "{inside} {stick} {outside}");
    says(
        "stick in the centre",
        &[
            format!("c = {:.2} µm", 1e6 * stick),
            format!("between {inside:.2} and {outside:.2} µm"),
        ],
    );
    assert!(outside - 1e6 * stick < 0.13 + 5e-3);
    let unworn_a = curve(&a, "a", "unworn").1;
    let profiles = ["50.72 cycles", "100 cycles", "199.24 cycles"].map(|name| {
        let (a, b) = (curve(&a, "a", name).1, curve(&b, "a", name).1);
        let deepest = apart(&a, &unworn_a);
        format!("{:.1} %", 100.0 * apart(&a, &b) / deepest)
    });
    let [first, second, third] = &profiles;
    says(
        "3D profile, A against B",
        &[format!("{first}, {second} and {third}")],
    );
    for (panel, state) in [("c", "first"), ("d", "last")] {
        let peak = |figure: &Table| {
            let (radii, pressure) = curve(figure, panel, "p");
            let at = (0..radii.len()).max_by(|&i, &j| pressure[i].total_cmp(&pressure[j]));
            let at = at.expect("nodes");
            (pressure[at] / pressure[0], pressure[at], radii[at])
        };
        let (ratio, pressure, r) = peak(&product);
        let mut texts = vec![
            format!("{ratio:.2} of p(0)"),
            format!("{:.2} (A), {:.2} (B)", peak(&a).0, peak(&b).0),
        ];
        if state == "last" {
            texts.push(format!("{:.2} GPa at {:.2} µm", 1e-9 * pressure, 1e6 * r));
        }
        says(&format!("stress at the stick border, {state}"), &texts);
    }
}

/// A study over depth and amplitude, the depth held: gross slip begins at U = d μE*/G*.
const MAP: &str = r#"
base = "li2019-fig3"
columns = ["wear_volume_m3", "regime", "estimated_error_volume"]
[set]
"run.cycles" = 2.0
"motion.normal.amplitude" = 0.0
"numerics.accuracy" = 1e-1
[[axis]]
key = "motion.normal.mean"
linspace = ["0.5 um", "2 um", 4]
[[axis]]
key = "motion.tangential.amplitude"
logspace = ["10 nm", "1 um", 9]
"#;

/// The lines of a picture: their points, and the rest of their element.
fn lines(svg: &str) -> Vec<(Vec<[f64; 2]>, &str)> {
    let lines = svg
        .lines()
        .filter_map(|line| line.strip_prefix("<polyline points=\""));
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let point = |pair: &str| pair.split_once(',').map(|(x, y)| [number(x), number(y)]);
    let parts = lines.filter_map(|line| line.split_once('"'));
    parts
        .map(|(points, rest)| (points.split(' ').filter_map(point).collect(), rest))
        .collect()
}

/// Frames of a sheet are aligned in rows and columns, whatever the words next to and below them.
#[test]
fn frames_of_a_sheet_are_aligned_and_dashes_lie_on_top() {
    let dir = TestDir::new();
    dir.write("map.toml", MAP.as_bytes());
    dir.done("sweep map.toml --out map.csv --quiet");
    dir.done("figure map.csv -o map.svg --quiet");
    dir.done("figure li2019-fig3 --at 2 --panel profile --panel loop --panel stresses --panel radii -o sheet.svg --quiet");
    let frames = |name: &str| {
        let text = dir.read(name);
        let all = lines(&text);
        let boxes = all.into_iter().filter(|(points, rest)| {
            points.len() == 5 && points[0] == points[4] && rest.contains("\"0.15\"")
        });
        let corners = boxes.map(|(points, _)| [points[0], points[2]]);
        corners.collect::<Vec<_>>()
    };
    let map = frames("map.svg");
    assert_eq!(map.len(), 2);
    assert_eq!([map[0][0][1], map[0][1][1]], [map[1][0][1], map[1][1][1]]);
    // The inset of the profile comes behind its frame.
    let sheet = frames("sheet.svg");
    assert_eq!(sheet.len(), 5);
    assert_eq!(sheet[0][0][0], sheet[3][0][0]);
    assert_eq!(sheet[2][0][0], sheet[4][0][0]);
    // Wear that the profile shows would lie under an inset.
    dir.done("figure gross-slip --set wear.coefficient=1e-9 --cycles 40 --panel profile -o worn.svg --quiet");
    assert_eq!(frames("worn.svg").len(), 1);
    // A curve has more points than a line of the legend.
    let text = dir.read("sheet.svg");
    let all = lines(&text);
    let curves = all
        .iter()
        .filter(|(points, rest)| points.len() > 2 && rest.contains("\"0.35\""));
    let dashed: Vec<bool> = curves.map(|(_, rest)| rest.contains("dasharray")).collect();
    let first = dashed.iter().position(|is| *is);
    assert!(first.is_some_and(|first| first > 0), "{dashed:?}");
}

#[test]
fn a_sweep_is_a_map_with_its_borders() {
    let dir = TestDir::new();
    dir.write("map.toml", MAP.as_bytes());
    dir.done("sweep map.toml --out map.csv --quiet");
    dir.done("figure map.csv -o map.svg -o map.pdf --quiet");
    let (table, drawn) = (dir.table("map.csv"), dir.table("map-drawn.csv"));
    let drawn_rows = drawn.rows.iter();
    let colors = drawn_rows.filter(|row| row[0] == "a" && row[1] == "map");
    let numbers = |row: &Vec<String>, columns: [usize; 3]| {
        columns.map(|k| row[k].parse::<f64>().expect("a number"))
    };
    let colors: Vec<[f64; 3]> = colors.map(|row| numbers(row, [3, 2, 4])).collect();
    let rows = table.rows.iter().map(|row| numbers(row, [0, 1, 2]));
    assert_eq!(colors, rows.collect::<Vec<_>>());
    // The depth is held: the border is a line through the origin.
    let (amplitudes, depths) = curve(&drawn, "a", "gross slip, closed form, unworn");
    assert!(depths.len() > 4);
    for (amplitude, depth) in amplitudes.iter().zip(&depths) {
        let gross = depth * 0.1 * (2.0 - 0.3) / (2.0 * (1.0 - 0.3));
        near("amplitude", *amplitude, gross, 1e-6);
    }
    // Each edge of the computed border lies within a point of it.
    let (across, up) = curve(&drawn, "a", "running condition changes");
    // To its left lies the one of full stick.
    let edges = across.iter().zip(&up).filter(|(x, _)| **x > 3e-8);
    let mut far = 0.0_f64;
    for (amplitude, depth) in edges.clone() {
        let gross = depth * 0.1 * 1.7 / 1.4;
        far = far.max((amplitude / gross).ln().abs());
    }
    assert!(edges.count() > 6 && far < 1.0, "{far}");
    let svg = dir.read("map.svg");
    for words in [
        ">mean depth d (µm)<",
        ">tangential amplitude (µm)<",
        ">worn volume V (m³)<",
        ">gross slip<",
        ">partial slip<",
        ">running condition changes<",
    ] {
        has(&svg, words);
    }
    lacks(&svg, "lift-off");
    // Over one axis: a curve whose bars are the estimated errors.
    dir.done("figure map.csv --set motion.normal.mean=1e-6 -o line.svg --quiet");
    let line = dir.table("line.csv");
    let rows: Vec<&Vec<String>> = line.rows.iter().collect();
    let of_table: Vec<&Vec<String>> = table.rows.iter().filter(|row| row[0] == "1e-6").collect();
    assert_eq!((rows.len(), of_table.len()), (9, 9));
    for (row, of_table) in rows.iter().zip(of_table) {
        let [volume, error] = [2, 4].map(|k| of_table[k].parse::<f64>().expect("a number"));
        let bar: f64 = row[5].parse().expect("an error");
        near("bar", bar, volume * error, 1e-12);
        assert_eq!((&row[2], &row[3]), (&of_table[1], &of_table[2]));
    }
    assert_eq!(line.header("motion.normal.mean"), "1e-6");
    for (arguments, why) in cases([
        "--column depth => --column depth: map.csv has wear_volume_m3, regime",
        "--panel loop => --panel: is for a run; map.csv is the table of a sweep",
        "--set motion.normal.mean=3 => must be one of 5e-7, 1e-6, 1.5e-6, 2e-6",
        "--set friction.coefficient=3 => the axes are motion.normal.mean",
    ]) {
        dir.refuse_line(&format!("figure map.csv {arguments} -o no.svg"), why);
    }
}

/// `run` writes the last cycle, finely stepped, after direct steps and after jumps; the loop is drawn from it.
#[test]
fn a_run_leaves_the_loop_of_its_last_cycle() {
    let dir = TestDir::new();
    dir.done("run gross-slip --cycles 3.24 --history every-step --out x --quiet");
    let (last, history) = (dir.table("x/loop.csv"), dir.table("x/history.csv"));
    let cycles = history.column("cycle");
    let first = cycles.iter().position(|&cycle| cycle >= 2.24 - 1e-9);
    let first = first.expect("a row");
    // Every step of the run lies on it: it turns where the run turns, and ends where the run stands.
    let of = |table: &Table, name| table.column(name);
    let (fine, steps) = (of(&last, "cycle"), &cycles[first..]);
    for (cycle, force) in steps.iter().zip(&of(&history, "F_x_N")[first..]) {
        let on_it =
            mdr_tui::math::scan::value_at(&fine, &of(&last, "F_x_N"), *cycle).expect("a force");
        let most = 0.02 * of(&last, "F_x_N").iter().copied().fold(0.0, f64::max);
        assert!((on_it - force).abs() < most, "{cycle}: {on_it} {force}");
    }
    let end = |table: &Table| table.column("u_x_m").last().copied();
    assert_eq!(end(&last), end(&history));
    let wear = "li2019-fig3 --set numerics.integrator=cycle-jump --set wear.coefficient=1e-14";
    dir.done(&format!("run {wear} --cycles 3000 --out jumped --quiet"));
    dir.done("figure jumped --panel loop -o loop.svg --quiet");
    dir.done(&format!(
        "figure {wear} --at 1,3000 --panel loop -o both.svg --quiet"
    ));
    let drawn = curve(&dir.table("loop.csv"), "a", "3000 cycles");
    assert!(drawn.0.len() >= 100);
    let both = dir.table("both.csv");
    // Jumps that other states have cut short differ in late digits.
    let same = curve(&both, "a", "3000 cycles");
    let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-3;
    assert!(same.1.len() == drawn.1.len() && same.1.iter().zip(&drawn.1).all(near));
    assert!(!curve(&both, "a", "1 cycles").0.is_empty());
    // It closes, and its area is the friction work of the cycle.
    let area: f64 = drawn
        .0
        .windows(2)
        .zip(drawn.1.windows(2))
        .map(|(u, f)| 0.5 * (f[0] + f[1]) * (u[1] - u[0]))
        .sum();
    let energies = dir.table("jumped/history.csv").column("energy_per_cycle_J");
    let energy = energies.last().expect("a row");
    crate::common::near("area", area, *energy, 1e-4);
    // Without tangential motion there is no loop.
    dir.done("run hertz --cycles 1 --out still --quiet");
    assert!(!dir.path("still/loop.csv").exists());
}

/// Plateaus do not lie on the frame; curves that begin at zero do.
#[test]
fn data_keep_clear_of_the_frame() {
    let (us, forces) = ([-1.0, 1.0, 1.0, -1.0], [2.0, 2.0, -2.0, -2.0]);
    let mut chart = Chart::new("loop", Axis::new("u_x", "m"), Axis::new("F_x", "N"))
        .curve(Curve::new("", us, forces, Role::Shear));
    chart.margin = 0.05;
    let [[left, right], [low, high]] = chart.bounds_on_paper();
    assert!(left < -1.05 && right > 1.05 && low < -2.05 && high > 2.05);
    let depth = Chart::new("depth", Axis::new("r", "m"), Axis::new("depth", "m"))
        .curve(Curve::new("", [0.0, 1.0], [1.0, 0.0], Role::Profile));
    let [_, [low, high]] = depth.bounds_on_paper();
    assert!(low == 0.0 && high > 1.0);
}

/// Where areas only touch, a viewer that smooths edges shows the paper between them: every area of a map reaches
/// below the next of its row and below the next row, and none beyond the frame.
#[test]
fn a_map_has_no_seams() {
    let mut chart = Chart::new("map", Axis::new("x", "m"), Axis::new("z", "m"));
    chart.map = Some(Map {
        quantity: Axis::new("σ", "Pa"),
        places: [vec![0.0, 1.0, 2.0], vec![0.0, 1.0]],
        values: vec![0.0, 1.0, 2.0, 2.0, 1.0, 0.0],
        colors: ColorMap::Sequential,
        words: Vec::new(),
    });
    let sheet = Sheet {
        title: "map".into(),
        facts: Vec::new(),
        charts: vec![chart],
    };
    let look = FigureStyle {
        font: 2.8,
        style: Style::Color,
    };
    let canvas = sheet.draw([60.0, 40.0], &look);
    let areas = canvas.shapes.iter().filter_map(|shape| match shape {
        Primitive::Area { at, size, .. } => {
            Some([[at[0], at[0] + size[0]], [at[1], at[1] + size[1]]])
        }
        _ => None,
    });
    let areas: Vec<[[f64; 2]; 2]> = areas.collect();
    let (map, scale) = areas.split_at(6);
    for row in 0..2 {
        for column in 0..3 {
            let [[_, right], [top, bottom]] = map[3 * row + column];
            if column < 2 {
                assert!(right > map[3 * row + column + 1][0][0] + 0.1);
            }
            if row == 0 {
                let [below_top, below_bottom] = map[3 + column][1];
                assert!(bottom > below_top + 0.1 || top < below_bottom - 0.1);
            }
        }
    }
    let ends = |k: usize| map[3 * k + 2][0][1];
    assert!((ends(0) - ends(1)).abs() < 1e-9, "beyond the frame");
    for pair in scale.windows(2) {
        assert!(pair[0][1][0] < pair[1][1][1] - 0.1, "the scale has seams");
    }
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
    let texts = reader.info().utf8_text.iter();
    let texts: Vec<String> = texts.map(|text| text.get_text().expect("a text")).collect();
    has(&texts.join("\n"), "method: ");
    // The map has the colours of its scale, words are black, paper is white.
    let count = |is: &dyn Fn(&[u8]) -> bool| pixels.chunks(4).filter(|pixel| is(pixel)).count();
    assert!(count(&|pixel| pixel[..3] == [255; 3]) > 100_000);
    assert!(count(&|pixel| pixel[..3] == [0; 3]) > 500);
    let colored = count(&|pixel| pixel[1].abs_diff(pixel[0]) > 60);
    assert!(colored > 20_000, "{colored}");
    // The loop closes, and every step is in it.
    let (shifts, _) = curve(&dir.table("f.csv"), "b", "");
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

/// The data of a figure go to a file of their own, whatever `--force` says.
#[test]
fn data_of_a_figure_replace_data_of_figures_alone() {
    let dir = TestDir::new();
    dir.done("run mindlin --cycles 1 --out x --quiet");
    dir.write("loop.csv", b"u_um,F_N\n1,2\n");
    dir.write("state.csv", dir.read("x/state.csv").as_bytes());
    for force in ["", " --force", " --force"] {
        let word = dir.done(&format!("figure x --panel loop -o loop.pdf{force}"));
        assert_eq!(word, "loop.pdf and loop-drawn.csv\n");
        dir.done(&format!(
            "figure x --panel stresses -o state.svg --quiet{force}"
        ));
    }
    assert_eq!(dir.read("loop.csv"), "u_um,F_N\n1,2\n");
    assert_eq!(dir.read("state.csv"), dir.read("x/state.csv"));
    has(&dir.read("state-drawn.csv"), "panel,curve,x,y,value,error");
}
