//! The row under the plot: tick labels and the axis' title, which share it.

use super::legend::cells;
use super::ticks::{Labels, Tick, ticks};
use super::units::AxisUnit;
use super::window::Window;

/// A row of tick labels and a title.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LabelRow {
    /// The ticks that got a label.
    pub(super) ticks: Vec<Tick>,
    /// The title as it is shown, and its distance in cells from the row's left end.
    pub(super) title: Option<(u16, String)>,
    /// Cells of the row left of the axis' first cell.
    before: u16,
    /// Cells of the axis.
    cells: u16,
}

impl LabelRow {
    /// Shares the row among the ticks of `window` and the title, in this order of choice:
    /// the title whole, in a gap between labels or at the right end, as far right as it
    /// fits; with fewer ticks; without the last label; its unit alone; no title. The row
    /// begins `before` cells left of the axis.
    pub(super) fn new(window: &Window, unit: &AxisUnit, label: &str, before: u16) -> Self {
        let ticks = |apart| ticks(window, unit.factor, Labels::Row { before, apart });
        let title = titled(label, unit);
        let unit_alone = titled("", unit);
        let full = ticks(0);
        let longest = full.iter().map(|tick| tick.label.len() as u16).max();
        let few = ticks(cells(&title) + longest.unwrap_or(0) + 2);
        let cut = full[..full.len().saturating_sub(1)].to_vec();

        let choices = [
            (&full, &title, 0),
            (&few, &title, 3),
            (&cut, &title, 2),
            (&few, &title, 2),
            (&full, &unit_alone, 0),
            (&cut, &unit_alone, 2),
        ];
        let mut row = LabelRow {
            ticks: Vec::new(),
            title: None,
            before,
            cells: window.cells(),
        };
        for (ticks, title, least) in choices {
            if ticks.len() >= least
                && let Some(start) = row.gap(ticks, cells(title))
            {
                row.title = Some((start, title.clone())).filter(|_| !title.is_empty());
                row.ticks = ticks.clone();
                return row;
            }
        }
        row.ticks = full;
        row
    }

    /// Where a tick's label begins, in cells from the row's left end.
    pub(super) fn start(&self, tick: &Tick) -> u16 {
        let offset = tick.label_start(self.cells, self.before) + i32::from(self.before);
        offset.max(0) as u16
    }

    /// The rightmost place for `width` cells with a blank to either side.
    fn gap(&self, ticks: &[Tick], width: u16) -> Option<u16> {
        let mut right = self.before + self.cells + 1;
        for tick in ticks.iter().rev() {
            let left = self.start(tick) + tick.label.len() as u16 + 1;
            if left + width < right {
                return Some(right - width - 1);
            }
            right = self.start(tick);
        }
        (width < right).then(|| right - width - 1)
    }
}

/// A quantity with its unit, `p [MPa]`; either may be empty.
pub(super) fn titled(label: &str, unit: &AxisUnit) -> String {
    match (label, unit.text.as_str()) {
        (label, "") => label.to_owned(),
        ("", unit) => format!("[{unit}]"),
        (label, unit) => format!("{label} [{unit}]"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::plot::axis::Scale;
    use crate::tui::plot::units::axis_unit;

    #[test]
    fn the_title_never_touches_a_label() {
        for width in 1..=120 {
            for before in [1, 5] {
                for hi in [1e-7, 1.5e-4, 0.7, 39.0, 2e6] {
                    for lo in [0.0, -hi] {
                        let unit = axis_unit(hi, "m", false);
                        let window = Window::new([lo, hi], Scale::Linear, width, 2);
                        let row = LabelRow::new(&window, &unit, "u_x", before);
                        let mut taken = vec![false; usize::from(width + before)];
                        let labels = row.ticks.iter().map(|t| (row.start(t), t.label.clone()));
                        for (start, text) in labels.chain(row.title.clone()) {
                            let start = usize::from(start);
                            let end = start + usize::from(cells(&text));
                            assert!(
                                !taken[start.saturating_sub(1)..end].contains(&true) || start == 0
                            );
                            taken[start..end].fill(true);
                        }
                        assert!(row.title.is_some() || width < 17, "{width} {lo} {hi}");
                    }
                }
            }
        }
    }
}
