//! The row under the plot: tick labels and the axis' title, which share it.

use super::axis::titled;
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
    /// Shares the row among the ticks of `window` and the title, which stands at the right end: after
    /// the last label, or in place of the last labels where they leave no room. Whole first, then its
    /// unit alone, then none. The row begins `before` cells left of the axis.
    pub(super) fn new(window: &Window, unit: &AxisUnit, label: &str, before: u16) -> Self {
        let full = ticks(window, unit.factor, Labels::Row { before, apart: 0 });
        let mut row = LabelRow {
            ticks: Vec::new(),
            title: None,
            before,
            cells: window.cells(),
        };
        for (title, least) in [(label, 2), ("", 1)]
            .map(|(label, least)| (titled(label, &unit.text, ['[', ']']), least))
        {
            for kept in (least.min(full.len())..=full.len()).rev() {
                let ticks = &full[..kept];
                if let Some(start) = row.right_end(ticks, cells(&title)) {
                    row.title = Some((start, title)).filter(|(_, title)| !title.is_empty());
                    row.ticks = ticks.to_vec();
                    return row;
                }
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

    /// The place for `width` cells at the right end, where the last label leaves two blanks before it.
    fn right_end(&self, ticks: &[Tick], width: u16) -> Option<u16> {
        let right = self.before + self.cells;
        let start = right.checked_sub(width)?;
        let taken = ticks
            .last()
            .map_or(0, |tick| self.start(tick) + tick.label.len() as u16 + 2);
        (width == 0 || taken <= start).then_some(start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::axis::Scale;
    use crate::plot::units::axis_unit;

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
                        // Behind every label, never between two.
                        if let (Some((start, _)), Some(last)) = (&row.title, row.ticks.last()) {
                            assert!(row.start(last) < *start, "{width} {lo} {hi}");
                        }
                    }
                }
            }
        }
    }
}
