//! The study of `:sweep KEY A..B`, which varies one key of the present scenario.

use crate::math::scale::Scale;
use crate::reading::Column;
use crate::scenario::key::Key;
use crate::scenario::{Refusal, Scenario, units};
use crate::studies::sweep::{Study, StudyAxis};

/// Number of points.
pub const POINTS: usize = 25;

/// If its ends have at least this ratio, the axis is logarithmic.
const DECADES: f64 = 20.0;

/// The columns of the study.
const COLUMNS: [Column; 7] = [
    Column::WearVolume,
    Column::ScarDepth,
    Column::DissipatedEnergy,
    Column::ContactRadius,
    Column::PermanentStickRadius,
    Column::EnergyRatio,
    Column::Regime,
];

/// The argument of `sweep`: a key and the ends of its axis.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRange {
    /// The dotted path.
    pub key: String,
    /// The first value.
    pub from: f64,
    /// The last value.
    pub to: f64,
}

impl SweepRange {
    /// Reads `KEY A..B` or a variant: `KEY = A .. B`, `KEY A to B`, `KEY A B`, each end with an optional unit. A part
    /// of a key is enough if only one of `keys` contains it.
    pub fn parse(text: &str, keys: &[(&str, &'static str)]) -> Option<Self> {
        let (key, ends) = text
            .trim()
            .split_once(|c: char| c.is_whitespace() || c == '=')?;
        let ends = ends.trim_start_matches([' ', '=']).trim();
        let mut signs = ["..", " to ", ",", ";"].into_iter();
        let (from, to) = signs
            .find_map(|sign| ends.split_once(sign))
            .or_else(|| ends.split_once(' '))?;
        let mut of = keys.iter().filter(|(path, _)| path.contains(key));
        let exact = keys.iter().find(|(path, _)| *path == key);
        let (key, unit) = match (exact, of.next(), of.next()) {
            (Some((path, unit)), ..) | (None, Some((path, unit)), None) => (*path, *unit),
            _ => (key, ""),
        };
        let known = Key::find(key);
        let number = |text: &str| -> Option<f64> {
            let text = text.trim().trim_start_matches('.');
            let with_unit = || units::quantity(text, &*known?, unit == "N")?.ok();
            let end = text.parse().ok().or_else(with_unit);
            end.filter(|end: &f64| end.is_finite())
        };
        Some(Self {
            key: key.to_owned(),
            from: number(from)?,
            to: number(to)?,
        })
    }

    /// Makes the study of a scenario over this range, in which each point runs for this many cycles.
    pub(super) fn study(&self, scenario: &Scenario, cycles: f64) -> Result<Study, Refusal> {
        let base = scenario.with_changes(Vec::new());
        let base = base.edited(|spec| spec.run.cycles = Some(cycles))?;
        let (ends, ratio) = ([self.from, self.to], self.to / self.from);
        let is_wide = ends[0].min(ends[1]) > 0.0 && !(1.0 / DECADES..DECADES).contains(&ratio);
        let spread = if is_wide { Scale::Log } else { Scale::Linear };
        let key = Key::named(&self.key, "sweep")?;
        let mut study = Study::new(base, COLUMNS.to_vec());
        study.axes = vec![StudyAxis::between(key, ends, POINTS, spread)];
        Ok(study)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEYS: &[(&str, &str)] = &[
        ("friction.coefficient", ""),
        ("wear.coefficient", "1/Pa"),
        ("motion.tangential.amplitude", "m"),
    ];

    #[test]
    fn a_range_is_a_key_and_two_ends() {
        let range = SweepRange::parse(" friction.coefficient 0.1..0.5 ", KEYS).expect("a range");
        assert_eq!(
            (range.key.as_str(), range.from, range.to),
            ("friction.coefficient", 0.1, 0.5)
        );
        assert_eq!(
            SweepRange::parse("wear.coefficient 1e-12 .. 1e-9", KEYS).map(|r| r.to),
            Some(1e-9)
        );
        for text in [
            "friction 0.1..0.5",
            "friction.coefficient = 0.1 .. 0.5",
            "friction 0.1 to 0.5",
            "friction 0.1 0.5",
        ] {
            assert_eq!(SweepRange::parse(text, KEYS), Some(range.clone()), "{text}");
        }
        let range = SweepRange::parse("tangential.amplitude 50 nm..0.2 um", KEYS).expect("units");
        assert_eq!((range.from, range.to), (5e-8, 2e-7));
        for wrong in [
            "",
            "friction.coefficient",
            "friction.coefficient 1",
            "a 1..x",
            "a ..2",
        ] {
            assert_eq!(SweepRange::parse(wrong, KEYS), None, "{wrong}");
        }
    }
}
