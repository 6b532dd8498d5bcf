//! Ticks on a 1-2-5 grid, with labels that never collide.

use super::axis::Scale;
use super::step::Step;
use super::units::AxisUnit;
use super::window::Window;

/// A tick: its value, its place, and its label.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// The value, in the data's unit.
    pub value: f64,
    /// The cell that holds the value, counted from the left or from the bottom.
    pub cell: u16,
    /// The label, in the axis' unit.
    pub label: String,
}

impl Tick {
    /// Returns the first cell of the label when it is centred on the tick, in a row that begins `before` cells left of
    /// the axis and is `cells` cells long from there.
    pub fn label_start(&self, cells: u16, before: u16) -> i32 {
        let width = self.label.len() as i32;
        let centred = i32::from(self.cell) - width / 2;
        centred
            .min(i32::from(cells) - width)
            .max(-i32::from(before))
    }
}

/// How the labels of an axis are arranged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Labels {
    /// Side by side in one row, which begins this many cells left of the axis.
    Row(u16),
    /// One below the other, one per row.
    Column,
}

/// An axis laid over cells: the map from values to cells, the unit of its labels, and its ticks.
#[derive(Debug, Clone, PartialEq)]
pub struct Ruler {
    /// The map from values to cells.
    pub window: Window,
    /// The unit of the labels.
    pub unit: AxisUnit,
    /// The ticks, in increasing order.
    pub ticks: Vec<Tick>,
}

impl Ruler {
    /// Lays out a window with as many ticks in this unit as fit.
    pub fn new(window: Window, unit: AxisUnit, labels: Labels) -> Self {
        let ticks = ticks(&window, unit.factor, labels);
        Self {
            window,
            unit,
            ticks,
        }
    }

    /// Raises the upper end of a column a little, so that the ticks of a linear axis are evenly spaced in rows; leaves
    /// it unchanged if too much of the column would be empty.
    #[must_use]
    pub fn even(self) -> Self {
        let [lo, hi] = self.window.bounds;
        let [first, second, ..] = &self.ticks[..] else {
            return self;
        };
        let height = self.window.height();
        let ends = [1.0, 2.0, 5.0].into_iter().filter_map(|times| {
            let step = times * (second.value - first.value);
            let rows = (height / ((hi - lo) / step) + 1e-9).floor();
            // The lower end must lie on a tick, because rows are counted from it.
            let is_aligned = ((lo / step).round() * step - lo).abs() < 1e-6 * step;
            let end = lo + step * height / rows;
            (rows >= 1.0 && is_aligned && end <= lo + 1.3 * (hi - lo)).then_some(end)
        });
        match ends.reduce(f64::min) {
            Some(end) if self.window.scale == Scale::Linear => {
                let window = Window {
                    bounds: [lo, end],
                    ..self.window
                };
                Self::new(window, self.unit, Labels::Column)
            }
            _ => self,
        }
    }

    /// Returns the values of minor ticks. On a linear axis their grid is two steps finer, four or five intervals per
    /// labelled one; on a logarithmic axis they are 2 to 9 in each decade.
    pub fn minor(&self) -> Vec<f64> {
        let [low, high] = self.window.bounds;
        if self.window.scale == Scale::Log {
            let [first, last] = [low, high].map(|end| end.log10().floor() as i32);
            let most = if last - first < 8 { 9 } else { 1 };
            let decade =
                |decade| (1..=most).map(move |count| Step(3 * decade).multiple(f64::from(count)));
            let all = (first..=last).flat_map(decade);
            return all.filter(|value| (low..=high).contains(value)).collect();
        }
        let [first, second, ..] = &self.ticks[..] else {
            return Vec::new();
        };
        let Step(labelled) = Step::at_most(second.value - first.value);
        let step = Step(labelled - 2);
        let [first, last] = [low, high].map(|end| end / step.value());
        let counts = (first - 1e-9).ceil() as i32..=(last + 1e-9).floor() as i32;
        counts
            .map(|count| step.multiple(f64::from(count)))
            .collect()
    }
}

/// Returns the ticks of an axis, in increasing order: as many as fit without crowded labels, at least two if there is
/// room for two. `factor` is the size of the axis' unit in the data's unit (1e-6 for µm), a power of ten on a log axis.
fn ticks(window: &Window, factor: f64, labels: Labels) -> Vec<Tick> {
    let linear = || linear_ticks(window, factor, labels);
    match window.scale {
        _ if window.cells == 0 => Vec::new(),
        Scale::Linear => linear(),
        Scale::Log => log_ticks(window, factor, labels).unwrap_or_else(linear),
    }
}

fn linear_ticks(window: &Window, factor: f64, labels: Labels) -> Vec<Tick> {
    let [lo, hi] = window.bounds.map(|v| v / factor);
    let span = hi - lo;
    if !(span > 0.0 && span.is_finite() && span > 1e-12 * lo.abs().max(hi.abs())) {
        return Vec::new();
    }
    // A value up to half a dot outside still falls on the first or last dot.
    let slack = 0.5 * span / window.dots().max(2) as f64;
    let ends = |step: Step| {
        let first = ((lo - slack) / step.value()).ceil();
        [first, ((hi + slack) / step.value()).floor()]
    };
    let tick = |step: Step, count: f64| {
        let value = step.multiple(count) * factor;
        let cell = window.cell(value)?;
        let label = step.label(count);
        Some(Tick { value, cell, label })
    };

    let airy = match labels {
        Labels::Row(_) => window.cells / 10,
        Labels::Column => window.cells / 7,
    };
    let airy = airy.max(2);
    let Step(finest) = Step::at_most(span / f64::from(window.cells / airy + 2));
    for step in (finest..).map(Step) {
        let [first, last] = ends(step);
        let count = (last - first).max(-1.0) as usize + 1;
        if count < 2 {
            break;
        }
        let found = (0..count).filter_map(|i| tick(step, first + i as f64));
        let found: Vec<Tick> = found.collect();
        if found.len() > 1 && fit(&found, window, labels, airy, 2) {
            return found;
        }
    }

    // If no step has two multiples far enough apart, two multiples of a finer one may be.
    let mut single = Vec::new();
    let Step(coarsest) = Step::at_most(span);
    for step in (coarsest - 10..=coarsest + 1).rev().map(Step) {
        let [first, last] = ends(step);
        let pair = [first, last].map(|count| tick(step, count).filter(|_| first <= last));
        if let [Some(a), Some(b)] = pair {
            let pair = [a, b];
            if first < last && fit(&pair, window, labels, 1, 1) {
                return pair.into();
            }
            if single.is_empty() && fit(&pair[..1], window, labels, 1, 1) {
                single = pair[..1].to_vec();
            }
        }
    }
    single
}

/// Returns ticks at decades, with 2 and 5 between them if there is room; `None` if no two fit.
fn log_ticks(window: &Window, factor: f64, labels: Labels) -> Option<Vec<Tick>> {
    let [lo, hi] = window.bounds;
    let first = (lo.log10() - 1e-9).floor() as i32;
    let last = (hi.log10() + 1e-9).floor() as i32;
    let shift = factor.log10().round() as i32;
    let plain = lo > 0.9e-3 * factor && hi < 1.1e4 * factor;
    let tick = |step: Step| {
        let value = step.value();
        let cell = window.cell(value)?;
        let label = if plain {
            Step(step.0 - 3 * shift).label(1.0)
        } else {
            format!("{}e{}", step.mantissa(), step.exponent() - shift)
        };
        Some(Tick { value, cell, label })
    };
    // Ticks at every step of the grid, at every decade, at every second decade and so on.
    let grid = |every: i32| -> Vec<Tick> {
        let steps = (3 * first..=3 * last + 2).filter(|step| step.rem_euclid(every) == 0);
        steps.map(Step).filter_map(tick).collect()
    };
    let decades = [1, 2, 3, 5, 10, 20, 50, 100, 200].map(|decades| 3 * decades);
    for every in [1].into_iter().chain(decades) {
        let found = grid(every);
        if found.len() > 1 && fit(&found, window, labels, 2, 2) {
            return Some(found);
        }
    }
    // The outermost decades, or the outermost steps if there are no two decades.
    [3, 1].into_iter().find_map(|every| {
        let found = grid(every);
        let [first, .., last] = &found[..] else {
            return None;
        };
        let ends = vec![first.clone(), last.clone()];
        fit(&ends, window, labels, 1, 1).then_some(ends)
    })
}

/// Whether neighbours are `apart` cells apart, with `blanks` cells between labels in a row, and no label is longer than
/// the row.
fn fit(ticks: &[Tick], window: &Window, labels: Labels, apart: u16, blanks: i32) -> bool {
    let far = ticks
        .windows(2)
        .all(|pair| pair[1].cell >= pair[0].cell + apart);
    let Labels::Row(before) = labels else {
        return far;
    };
    let cells = window.cells;
    let room = i32::from(cells) + i32::from(before);
    far && ticks.iter().all(|tick| tick.label.len() as i32 <= room)
        && ticks.windows(2).all(|pair| {
            let end = pair[0].label_start(cells, before) + pair[0].label.len() as i32;
            end + blanks <= pair[1].label_start(cells, before)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minor_ticks_lie_between_the_labelled_ones() {
        let minor = |bounds, scale| {
            let window = Window::new(bounds, scale, 40, 16);
            let (factor, text) = (1.0, String::new());
            Ruler::new(window, AxisUnit { factor, text }, Labels::Row(0)).minor()
        };
        let linear = minor([0.0, 1.0], Scale::Linear);
        assert!(linear.len() > 12 && linear.iter().all(|v| (0.0..=1.0).contains(v)));
        let log = minor([1e-3, 1.0], Scale::Log);
        assert_eq!(log.len(), 28);
        assert!((log[1] - 2e-3).abs() < 1e-12);
    }

    fn labels_of(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|tick| tick.label.as_str()).collect()
    }

    fn row(before: u16) -> Labels {
        Labels::Row(before)
    }

    fn window(lo: f64, hi: f64, cells: u16) -> Window {
        Window::new([lo, hi], Scale::Linear, cells, 2)
    }

    #[test]
    fn labels_have_the_decimals_the_step_needs() {
        let row = row(3);
        let text = |lo, hi, cells| {
            let ticks = ticks(&window(lo, hi, cells), 1.0, row);
            labels_of(&ticks).join(" ")
        };
        assert_eq!(text(0.0, 1.0, 40), "0 0.2 0.4 0.6 0.8 1.0");
        assert_eq!(text(-150.0, 150.0, 40), "-150 -100 -50 0 50 100 150");
        assert_eq!(text(0.0, 1.0, 14), "0 0.5 1.0");
        assert_eq!(text(1.1, 2.9, 8), "1.5 2.5");
        let micro = ticks(&window(0.0, 1.5e-4, 30), 1e-6, row);
        assert_eq!(labels_of(&micro), ["0", "50", "100", "150"]);
    }

    #[test]
    fn log_labels() {
        let text = |lo, hi, cells| {
            let window = Window::new([lo, hi], Scale::Log, cells, 2);
            let ticks = ticks(&window, 1.0, row(3));
            labels_of(&ticks).join(" ")
        };
        assert_eq!(text(1.0, 100.0, 40), "1 2 5 10 20 50 100");
        assert_eq!(text(1.0, 100.0, 14), "1 10 100");
        assert_eq!(text(1e-9, 1e-3, 60), "1e-9 1e-8 1e-7 1e-6 1e-5 1e-4 1e-3");
        assert_eq!(text(1e-9, 1e-3, 20), "1e-8 1e-6 1e-4");
        assert_eq!(text(2.2, 4.4, 20), "3 4");
        assert_eq!(text(1e-300, 1e300, 30), "1e-200 1e0 1e200");
        // In micrometres.
        let window = Window::new([1e-9, 1e-6], Scale::Log, 30, 2);
        assert_eq!(
            labels_of(&ticks(&window, 1e-6, row(3))),
            ["0.001", "0.01", "0.1", "1"]
        );
        let window = Window::new([1e-12, 1e-6], Scale::Log, 30, 2);
        assert_eq!(labels_of(&ticks(&window, 1e-6, row(3)))[0], "1e-6");
    }

    /// Checks that ticks are in order, inside, and far enough apart.
    fn check(ticks: &[Tick], window: &Window, labels: Labels) {
        let [lo, hi] = window.bounds;
        for tick in ticks {
            let slack = 1e-6 * (hi - lo);
            assert_eq!(Some(tick.cell), window.cell(tick.value));
            assert!(tick.cell < window.cells);
            assert!(tick.value.abs() > slack || tick.label == "0" || window.scale == Scale::Log);
        }
        for pair in ticks.windows(2) {
            assert!(pair[0].value < pair[1].value);
            assert!(pair[0].cell < pair[1].cell);
            assert_ne!(pair[0].label, pair[1].label);
            if let Labels::Row(before) = labels {
                let start = |tick: &Tick| tick.label_start(window.cells, before);
                let end = start(&pair[0]) + pair[0].label.len() as i32;
                assert!(end < start(&pair[1]), "{ticks:?}");
                assert!(start(&pair[0]) >= -i32::from(before));
                let last = start(&pair[1]) + pair[1].label.len() as i32;
                assert!(last <= i32::from(window.cells));
            }
        }
    }

    #[test]
    fn sweep_of_linear_axes() {
        for lo in [-1e3, -150.0, -7.3, -1.0, -0.02, 0.0, 0.3, 0.97, 12.0, 990.0] {
            for span in [0.01, 0.033, 0.2, 1.0, 1.7, 2.2, 4.9, 9.0, 33.0, 420.0, 2e3] {
                for cells in 1..=120 {
                    let window = window(lo, lo + span, cells);
                    for before in [0, 4] {
                        let labels = row(before);
                        let found = ticks(&window, 1.0, labels);
                        check(&found, &window, labels);
                        assert!(found.len() >= 2 || cells < 18, "{lo} {span} {cells}");
                        assert!(found.len() <= 12);
                    }
                    let found = ticks(&window, 1.0, Labels::Column);
                    check(&found, &window, Labels::Column);
                    assert!(found.len() >= 2 || cells < 3, "{lo} {span} {cells}");
                }
            }
        }
    }

    #[test]
    fn sweep_of_log_axes() {
        for lo in [1e-300, 1e-12, 3e-9, 0.004, 0.3, 1.0, 70.0] {
            for ratio in [1.5, 2.1, 9.0, 10.0, 300.0, 1e6, 1e18, 1e290] {
                for cells in 1..=120 {
                    let window = Window::new([lo, lo * ratio], Scale::Log, cells, 4);
                    for labels in [row(4), Labels::Column] {
                        let found = ticks(&window, 1.0, labels);
                        check(&found, &window, labels);
                        let small = lo < 1e-3 && ratio < 10.0;
                        assert!(
                            found.len() >= 2 || cells < 20 || small,
                            "{lo} {ratio} {cells}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn no_ticks_rather_than_nonsense() {
        for (lo, hi) in [
            (1.0, 1.0),
            (1e17, 1e17 + 32.0),
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
        ] {
            assert_eq!(ticks(&window(lo, hi, 40), 1.0, Labels::Column), []);
        }
        assert_eq!(ticks(&window(0.0, 1.0, 0), 1.0, Labels::Column), []);
    }
}
