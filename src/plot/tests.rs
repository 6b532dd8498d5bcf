//! Tests of the whole widget: what it draws, and that nothing makes it panic.

use super::theme::{Look, Role};
use super::*;
use crate::reading::Zone;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::widgets::Widget;

const MARKERS: [Marker; 4] = [
    Marker::Braille,
    Marker::HalfBlock,
    Marker::Dot,
    Marker::Ascii,
];

/// A chart, its theme and the cursor.
pub(super) struct Shown(Chart, Theme, Option<f64>);

impl Shown {
    fn marker(mut self, marker: Marker) -> Self {
        self.1.marker = marker;
        self
    }

    fn cursor(self, x: f64) -> Self {
        Shown(self.0, self.1, Some(x))
    }
}

pub(super) fn shown(chart: Chart) -> Shown {
    Shown(chart, Theme::new(Look::Mono, Marker::Braille), None)
}

pub(super) fn draw(Shown(chart, theme, cursor): &Shown, width: u16, height: u16) -> Vec<String> {
    let mut buf = Buffer::empty(Rect::new(0, 0, width, height));
    let plot = Plot::new(chart, theme).cursor(*cursor);
    plot.render(buf.area, &mut buf);
    let row = |y| (0..width).map(|x| buf[(x, y)].symbol()).collect::<String>();
    (0..height).map(row).collect()
}

pub(super) fn axes(x: [f64; 2], y: [f64; 2]) -> Chart {
    Chart::new(
        "",
        Axis::new("x", "m").bounds(x),
        Axis::new("y", "N").bounds(y),
    )
}

fn hertz(xs: &[f64], radius: f64, peak: f64) -> Vec<f64> {
    let share = |x: &f64| (1.0 - (x / radius).powi(2)).max(0.0);
    xs.iter().map(|x| peak * share(x).sqrt()).collect()
}

#[test]
fn snapshot_40x12() {
    let xs: Vec<f64> = (0..=150).map(|i| f64::from(i) * 1e-6).collect();
    let ys = hertz(&xs, 1e-4, 2.1e9);
    let zones = vec![
        ([0.0, 6e-5], Zone::Stick),
        ([6e-5, 1e-4], Zone::Slip),
        ([1e-4, 1.5e-4], Zone::Open),
    ];
    let plot = Chart {
        curves: vec![Curve::new("now", xs, ys, Role::Profile)],
        band: zones,
        marks: vec![Mark {
            x: 1e-4,
            label: "a",
            role: Role::Profile,
        }],
        note: "50.72".into(),
        ..Chart::new("", Axis::new("r", "m"), Axis::new("p", "Pa"))
    };
    let plot = shown(plot);
    let expected = [
        "p [GPa]                   50.72 r [µm] →",
        " │                         ⡂a      ─ now",
        "2┤⠤⠤⠤⠤⠤⠤⣄⣀⣀⡀                            ",
        " │         ⠈⠉⠙⠒⠢⠤⣀⡀                     ",
        " │                ⠉⠓⠦⣄     ⡂            ",
        "1┤                    ⠙⠢⡀               ",
        " │                      ⠈⢢⡀             ",
        " │                        ⢱⡀            ",
        "0┤                         ⣇⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀",
        " │ss stick ssssss~ slip ~~~..... open ..",
        " └┬────┬────┬────┬────┬────┬────┬────┬──",
        "  0   20   40   60   80   100  120  140 ",
    ];
    assert_eq!(draw(&plot, 40, 12), expected);
    let ascii = plot.marker(Marker::Ascii).cursor(5e-5);
    let expected = [
        "p [GPa]         50.72 r [um] >",
        " |         |      r   50.00 um",
        "2+*************   - now  1.819",
        " |         |  ***** :         ",
        " |         |      ***         ",
        "0+         |        **********",
        " |ss stick ss~ slip ~. open ..",
        " ++--------+--------+--------+",
        "  0       50       100     150",
    ];
    assert_eq!(draw(&ascii, 30, 9), expected);
    // If the rule has room for the abscissa's title, the title takes no space from the labels of marks.
    let Shown(chart, theme, _) = ascii;
    let mut buf = Buffer::empty(Rect::new(0, 0, 30, 10));
    let plot = Plot::new(&chart, &theme).rule(Rect::new(20, 0, 10, 1));
    plot.render(Rect::new(0, 1, 30, 9), &mut buf);
    let row = |y| (0..30).map(|x| buf[(x, y)].symbol()).collect::<String>();
    let rows = [0, 1, 9].map(row);
    assert!(rows[0].ends_with("  r [um] >"), "{rows:?}");
    assert_eq!(rows[1], "p [GPa]             a    50.72");
    assert!(rows[2].ends_with(" 150"), "{rows:?}");
}

#[test]
fn snapshot_log_log() {
    let xs: Vec<f64> = (1..=6).map(|i| 10.0 * 2f64.powi(i)).collect();
    let ys: Vec<f64> = xs.iter().map(|n| 0.5 / n / n).collect();
    let log = |label| Axis::new(label, "").scale(Scale::Log);
    let curve = Curve::new("order 2", xs, ys, Role::Profile);
    let plot = shown(Chart::new("", log("N"), log("error")).curve(curve));
    let expected = [
        "error                            N →",
        "1e-2┤                      ─ order 2",
        "    │⠤⣀⡀                            ",
        "    │  ⠈⠉⠒⠢⠤⣀⡀                      ",
        "1e-4┤        ⠈⠉⠒⠢⠤⣀⡀                ",
        "    │              ⠈⠉⠒⠢⠤⣀⡀          ",
        "    │                    ⠈⠉⠒⠢⠤⣀⡀    ",
        "1e-6┤                          ⠈⠉⠒⠢⠤",
        "    └┬───────┬─────┬─────┬───────┬──",
        "    20      50    100   200     500 ",
    ];
    assert_eq!(draw(&plot, 36, 10), expected);
}

#[test]
fn coloured_bands_are_strips_and_mono_bands_are_letters() {
    let mut chart = axes([0.0, 1.0], [0.0, 1.0]);
    chart.band = vec![([0.0, 0.5], Zone::Stick), ([0.7, 0.7001], Zone::Open)];
    let plot = Shown(chart, Theme::new(Look::Dark, Marker::Braille), None);
    let lines = draw(&plot, 40, 12);
    // Eighteen cells, with the zone's name in them; the other zone is too narrow for its name.
    assert!(lines[9].contains("▀ stick ▀"), "{}", lines[9]);
    assert_eq!(lines[9].matches('▀').count(), 18 - " stick ".len());
    assert_eq!(lines[9].matches('.').count(), 1);
    let lines = draw(&plot.marker(Marker::Ascii), 40, 12);
    assert!(lines[9].contains("s stick s"), "{}", lines[9]);
    assert_eq!(
        lines[9].matches(['s', '.']).count(),
        18 - " tick ".len() + 1
    );
}

#[test]
fn the_legend_avoids_the_curve_and_reads_at_the_cursor() {
    let (xs, ys) = ([0.0, 1.0], [0.0, 1.0]);
    let falling = [1.0, 0.0];
    let plot = axes([0.0, 1.0], [0.0, 1.0]);
    let rising = plot.clone().curve(Curve::new("u", xs, ys, Role::Profile));
    let (rising, plot) = (shown(rising), plot);
    assert!(draw(&rising, 60, 16)[1].contains("┤─ u"));
    let falling = plot.curve(Curve::new("u", xs, falling, Role::Profile));
    assert!(draw(&shown(falling), 60, 16)[1].ends_with("─ u"));
    let lines = draw(&rising.cursor(0.25), 60, 16);
    assert!(lines.iter().any(|line| line.contains("x    0.2500 m")));
    assert!(lines.iter().any(|line| line.contains("─ u  0.2500 N")));
}

#[test]
fn ascii_is_ascii() {
    let (xs, ys) = ([0.0, 1e-4, 2e-4], [-1e-12, f64::NAN, 3e-12]);
    let mut chart = Chart::new("", Axis::new("δ", "m"), Axis::new("τ∂", "m³"))
        .curve(Curve::new("µ now", xs, ys, Role::Profile).filled([0.0; 3]));
    chart.note = "é".into();
    let plot = shown(chart).marker(Marker::Ascii).cursor(5e-5);
    for (width, height) in [(12, 4), (40, 12), (90, 25)] {
        assert!(
            draw(&plot, width, height)
                .iter()
                .all(|line| line.is_ascii())
        );
    }
}

/// Ordinates and abscissae that once made plots fail.
fn nasty() -> Vec<(Vec<f64>, Vec<f64>)> {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    vec![
        (vec![], vec![]),
        (vec![1.0], vec![2.0]),
        (vec![nan], vec![nan]),
        (vec![0.0, 0.0, 0.0], vec![7.0, 7.0, 7.0]),
        (vec![0.0, 1.0, 2.0, 3.0], vec![nan, inf, -inf, 1.0]),
        (vec![1e-300, 2e-300], vec![-1e-300, 1e-300]),
        (vec![-1e300, 1e300], vec![1e300, -1e300]),
        (vec![-f64::MAX, f64::MAX], vec![f64::MIN_POSITIVE, 5e-324]),
        (vec![inf, nan, 0.0], vec![1.0, 2.0]),
        (vec![1.0, 1.0 + 1e-15], vec![1e17, 1e17 + 16.0]),
        (vec![3.0, -1.0, 2.0, 2.0], vec![1e-9, 1e9, -1.0, 0.0]),
    ]
}

#[test]
fn nothing_makes_it_panic() {
    let bounds = [
        None,
        Some([0.0, 1.0]),
        Some([f64::NAN, 1.0]),
        Some([1.0, 1.0]),
        Some([0.0, 1e-300]),
    ];
    for (index, (xs, ys)) in nasty().into_iter().enumerate() {
        let zone = ([xs.first().copied().unwrap_or(f64::NAN), 1e300], Zone::Slip);
        let mark = |x, label| Mark {
            x,
            label,
            role: Role::Profile,
        };
        for (turn, scale) in [Scale::Linear, Scale::Log].into_iter().enumerate() {
            let markers = if scale == Scale::Log {
                &MARKERS[..1]
            } else {
                &MARKERS
            };
            for &marker in markers {
                let axis = |i: usize| Axis {
                    bounds: bounds[(index + turn + i) % bounds.len()],
                    ..Axis::new("τ 漢字", "m³").scale(scale)
                };
                let name = "a name of some length, too long";
                let curves = vec![
                    Curve::new("now", xs.clone(), ys.clone(), Role::Profile)
                        .filled(vec![0.5; xs.len()])
                        .scattered([f64::NAN, 1e300, 1.0]),
                    Curve::new(name, ys.clone(), xs.clone(), Role::Profile).dashed(),
                ];
                let chart = Chart {
                    curves,
                    band: vec![zone],
                    marks: vec![mark(0.5, "c"), mark(f64::NAN, "a")],
                    note: "a note".into(),
                    ..Chart::new("", axis(0), axis(1))
                };
                let theme = Theme::new(Look::Mono, marker);
                let cursor = [None, Some(0.3), Some(f64::INFINITY)][index % 3];
                let plot = Plot::new(&chart, &theme).cursor(cursor);
                for width in 0..=30 {
                    for height in 0..=12 {
                        let mut buf = Buffer::empty(Rect::new(3, 2, width, height));
                        plot.render(buf.area, &mut buf);
                    }
                }
            }
        }
    }
}

#[test]
fn it_stays_in_its_area() {
    let (xs, ys) = ([0.0, 1.0], [-1e9, 1e9]);
    let long = [("a long title", "m"), ("another long title", "Pa")];
    let [x, y] = long.map(|(label, unit)| Axis::new(label, unit));
    let curve = Curve::new("curve", xs, ys, Role::Profile).filled([0.0; 2]);
    let mut chart = Chart::new("", x, y).curve(curve);
    chart.marks.push(Mark {
        x: 1.0,
        label: "label",
        role: Role::Profile,
    });
    chart.note = "a note".into();
    let Shown(chart, theme, _) = shown(chart);
    let plot = Plot::new(&chart, &theme);
    for width in 0..=30 {
        for height in 0..=12 {
            let mut buf = Buffer::empty(Rect::new(0, 0, 40, 20));
            let area = Rect::new(5, 4, width, height);
            plot.render(area, &mut buf);
            for place in buf.area.positions().filter(|&place| !area.contains(place)) {
                assert_eq!(buf[place].symbol(), " ", "{width} {height} {place:?}");
            }
        }
    }
}

#[test]
fn later_curves_win_the_colour_and_backgrounds_stay() {
    let (xs, ys) = ([0.0, 1.0], [0.5, 0.5]);
    let mut buf = Buffer::empty(Rect::new(0, 0, 40, 12));
    buf.set_style(buf.area, Style::new().bg(Color::Black));
    let chart = axes([0.0, 1.0], [0.0, 1.0])
        .curve(Curve::new("a", xs, ys, Role::Shear))
        .curve(Curve::new("b", xs, ys, Role::Profile));
    let theme = Theme::new(Look::Light, Marker::Braille);
    Plot::new(&chart, &theme).render(buf.area, &mut buf);
    let is_dot = |c: char| ('\u{2801}'..='\u{28ff}').contains(&c);
    let curve = buf
        .content
        .iter()
        .filter(|cell| cell.symbol().starts_with(is_dot));
    assert!(curve.clone().count() > 30);
    assert!(curve.clone().all(|cell| cell.fg == Color::Blue));
    assert!(buf.content.iter().all(|cell| cell.bg == Color::Black));
}

#[test]
fn values_between_points() {
    let (xs, ys) = ([0.0, 1.0, 2.0, 3.0, 5.0], [0.0, 10.0, f64::NAN, 4.0, 0.0]);
    let curve = Curve::new("", xs, ys, Role::Profile);
    assert_eq!(curve.value_at(0.25), Some(2.5));
    assert_eq!(curve.value_at(1.0), Some(10.0));
    assert_eq!(curve.value_at(1.5), None);
    assert_eq!(curve.value_at(3.0), Some(4.0));
    assert_eq!(curve.value_at(4.0), Some(2.0));
    assert_eq!(curve.value_at(5.1), None);
    assert_eq!(curve.value_at(f64::NAN), None);
    let back = Curve::new("", [2.0, 0.0], [1e308, -1e308], Role::Profile);
    assert_eq!(back.value_at(1.0), Some(0.0));
}

/// Each place of a map fills its cells, in whichever direction the axes run, in any area.
#[test]
fn a_map_shows_each_place() {
    let map = |xs: [f64; 2], ys: [f64; 2]| {
        let mut chart = axes([0.5, 2.5], [0.5, 2.5]);
        chart.map = Some(Map {
            quantity: Axis::new("V", ""),
            places: [xs.to_vec(), ys.to_vec()],
            values: vec![0.0, 1.0, f64::NAN, 3.0],
            colors: colormap::ColorMap::Sequential,
            words: Vec::new(),
        });
        shown(chart)
    };
    // The key is above the map.
    let corners = |shown: &Shown| {
        let lines = draw(shown, 40, 12);
        let inner = |line: &String| line.chars().skip(5).collect::<Vec<char>>();
        let (top, bottom) = (inner(&lines[2]), inner(&lines[8]));
        [top[0], top[34], bottom[0], bottom[34]]
    };
    assert_eq!(corners(&map([1.0, 2.0], [1.0, 2.0])), [' ', '@', '.', '+']);
    assert_eq!(corners(&map([2.0, 1.0], [2.0, 1.0])), ['+', '.', '@', ' ']);
    for marker in MARKERS {
        for look in [Look::Dark, Look::Mono] {
            for (width, height) in [(0, 0), (1, 1), (11, 3), (12, 4), (80, 24)] {
                let mut shown = map([1.0, 2.0], [1.0, 2.0]).marker(marker);
                shown.1.look = look;
                draw(&shown, width, height);
            }
        }
    }
}
