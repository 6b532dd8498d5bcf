//! What may be fitted beside the keys: readings of each file, of which the plainest is tried first.

use super::nuisance::Nuisances;
use super::{Fit, Switch};
use crate::studies::measured::Measured;
use crate::traces::Axes;

/// Repeats are traces of one kind: with more combinations than this, further files are read as they seem.
const MOST: usize = 2;

impl Fit {
    /// The readings of all files in all combinations, as long as these are few.
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

    /// A trace through its axis may be symmetric about the place where it seems so, or, behind noise, about its zero. One
    /// on a side of its zero may begin at the axis, or run through it all the same.
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
