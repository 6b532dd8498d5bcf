//! Candidate zeros, centres and tilts of each file, simplest first.

use super::nuisance::Nuisances;
use super::{Fit, Switch};
use crate::studies::measured::Measured;
use crate::traces::Axes;

/// Repeats are traces of one kind: with more combinations than this, later files get only their first candidate.
const MOST: usize = 2;

impl Fit {
    /// Returns all combinations of the candidates of all files, if these are few.
    pub(super) fn hypotheses(&self) -> Vec<Vec<Nuisances>> {
        self.data.iter().fold(vec![Vec::new()], |all, set| {
            let mut readings = self.readings(set);
            if all.len() > MOST {
                readings.truncate(1);
            }
            let with = |before: &Vec<Nuisances>| {
                let readings = readings.iter();
                readings
                    .map(|one| [&before[..], &[*one]].concat())
                    .collect::<Vec<_>>()
            };
            all.iter().flat_map(with).collect()
        })
    }

    /// A trace across the axis may be symmetric about its apparent centre or, if noise hides the centre, about zero. A
    /// trace on one side of zero may begin at the axis, or cross it.
    fn readings(&self, set: &Measured) -> Vec<Nuisances> {
        let [level, shift, tilt] = self.options.nuisances;
        let (is_scar, is_loop) = (set.axes.over_r(), set.axes == Axes::LOOP);
        let wanted = |switch, by_default| match switch {
            Switch::Auto => by_default,
            switch => switch == Switch::On,
        };
        let about = |is_whole: bool, centre: f64| Nuisances {
            active: [
                wanted(level, is_scar || is_loop),
                wanted(shift, is_whole || is_loop) && !(is_scar && set.is_averaged),
                wanted(tilt, is_whole) && is_scar,
            ],
            start: [0.0, centre, 0.0],
        };
        match (is_scar, set.is_two_sided()) {
            (true, true) => vec![about(true, set.centre()), about(true, 0.0)],
            (true, false) if !set.is_averaged && shift == Switch::Auto => {
                vec![about(false, 0.0), about(true, set.centre())]
            }
            _ => vec![about(false, 0.0)],
        }
    }
}
