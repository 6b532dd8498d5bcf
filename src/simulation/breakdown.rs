//! Why a run cannot continue: the cycle, the cause and a remedy, in plain words.

use thiserror::Error;

use super::Setup;
use super::choices::Stability;
use crate::math::number::shown;

/// A step that failed. The state after the last good step remains.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("stopped after {cycle} cycles: {cause}")]
pub struct Breakdown {
    /// The cycle of the last good step.
    pub cycle: f64,
    /// What happened.
    pub cause: Cause,
}

/// Causes of a breakdown.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Cause {
    /// NaN or infinity in the contact or in the worn profile.
    #[error("the {quantity} is not finite; {advice}")]
    NotFinite {
        /// The quantity that showed it first.
        quantity: &'static str,
        /// What may help.
        advice: &'static str,
    },
    /// A contact force that overflows an f64.
    #[error(
        "the normal force at the depth {depth:.4e} m overflows; are the units right? Plain \
         numbers are SI: indenter in m, material in Pa, motion in m or N"
    )]
    Overflow {
        /// u_z, m.
        depth: f64,
    },
    /// A worn profile far above anything that can touch.
    #[error(
        "wear diverges: {} times the largest depth at r = {radius:.4e} m; {advice}",
        shown(*worn, 2)
    )]
    Runaway {
        /// Largest worn depth in units of the largest depth of indentation.
        worn: f64,
        /// Its radius, m.
        radius: f64,
        /// What may help.
        advice: &'static str,
    },
    /// A contact that has grown to the last node.
    #[error(
        "the contact has reached the domain's edge at {domain_radius:.4e} m; \
         increase numerics.domain_radius"
    )]
    EdgeReached {
        /// L, m.
        domain_radius: f64,
    },
    /// A contact that has grown to where the unworn indenter is too high to touch.
    #[error(
        "the contact reaches {radius:.4e} m, where nothing can touch at this depth: the profile \
         has diverged; {advice}"
    )]
    BlownUp {
        /// L, m.
        radius: f64,
        /// What may help.
        advice: &'static str,
    },
    /// A prescribed normal force that no depth can carry.
    #[error(
        "the normal force {force:.4e} N needs a contact larger than the domain, \
         {domain_radius:.4e} m; increase numerics.domain_radius or reduce motion.normal"
    )]
    LoadTooLarge {
        /// F_z, N.
        force: f64,
        /// L, m.
        domain_radius: f64,
    },
    /// A change to a domain too small for the existing wear.
    #[error(
        "the domain would end at {radius:.4e} m and cut off wear, which reaches {reach:.4e} m; \
         numerics.domain_radius or the indenter must be at least that large"
    )]
    WearCutOff {
        /// Outermost worn radius, m.
        reach: f64,
        /// End of the new domain, m.
        radius: f64,
    },
    /// A change to a grid too coarse for the existing wear.
    #[error(
        "{cells} cells are too few for the worn profile: its volume would change by {:.1} %; \
         increase numerics.points",
        100.0 * share
    )]
    WearBlurred {
        /// Cells of the new grid.
        cells: usize,
        /// Relative change of the volume.
        share: f64,
    },
    /// A prescribed tangential force beyond friction.
    #[error(
        "the tangential force {force:.4e} N exceeds the friction limit, {limit:.4e} N; prescribe \
         the displacement or reduce motion.tangential"
    )]
    FrictionExceeded {
        /// F_x, N.
        force: f64,
        /// μ F_z, N.
        limit: f64,
    },
}

impl Cause {
    /// Whether a wider domain may hold the contact.
    pub(super) fn lacks_room(&self) -> bool {
        matches!(self, Self::EdgeReached { .. } | Self::LoadTooLarge { .. })
    }
}

/// Returns the likely remedy for a state that diverges, by method.
pub(super) fn advice(setup: &Setup) -> &'static str {
    match setup.method.traits().sawtooth {
        Some(sawtooth) => sawtooth.advice,
        None if setup.stability == Stability::Off => {
            "the wear per step is too large for the grid; try numerics.stability = \"sub-step\", \
             more numerics.steps_per_cycle, fewer numerics.points or a smaller wear.coefficient"
        }
        None => {
            "the wear per step is too large for the grid; try more numerics.steps_per_cycle, \
             fewer numerics.points or a smaller wear.coefficient"
        }
    }
}
