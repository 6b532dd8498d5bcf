//! How long a search for a level may take.

/// Time budgeted for a rung that is run again, in units of its time: above 2, since no two runs take the same.
const TWICE: f64 = 2.2;

/// How long a search may take.
#[derive(Debug, Clone, Copy)]
pub struct Budget {
    seconds: f64,
    /// Whether the seconds must also suffice for a run on the level found.
    pub(super) runs_again: bool,
}

impl Budget {
    /// No limit.
    pub const UNLIMITED: Self = Self::of_search(f64::INFINITY);

    /// Limits the search alone to this many seconds.
    pub const fn of_search(seconds: f64) -> Self {
        Self {
            seconds,
            runs_again: false,
        }
    }

    /// Limits the search plus the run that follows on the level found to this many seconds. An interrupt ends such a
    /// search with the best level so far.
    pub const fn for_run(seconds: f64) -> Self {
        Self {
            seconds,
            runs_again: true,
        }
    }

    /// Returns the seconds, which may be infinite.
    pub fn seconds(self) -> f64 {
        self.seconds
    }

    pub(super) fn is_limited(self) -> bool {
        self.seconds.is_finite()
    }

    /// Returns the time that a level may take after `spent` seconds.
    pub(super) fn left(self, spent: f64) -> f64 {
        (self.seconds - spent) / if self.runs_again { TWICE } else { 1.0 }
    }
}
