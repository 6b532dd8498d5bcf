//! Takes a step of either scheme, in sub-steps if it is too stiff.
//!
//! A step is tried, and its stiffness is known before its wear is accepted. If that is too large, the step is split
//! into sub-steps just short enough, which grow again as the wear allows. Other steps are taken exactly as without the
//! guard.
//!
//! The parts grow in number with the cells. Chebyshev stages inside a part, its contact and its motion held, make them
//! independent of the cells (Fig. 3 at K = 30, parts of 5 cycles: 3700 on 400 cells and 15 400 on 1600 become 500 and
//! 540). Up to some hundred cells they pay nothing: with so few parts springs slip inside the border, V errs by 1e-3, and
//! with enough parts for 2e-5 the stages take as many transforms as plain parts do; on 1600 cells they take 0.4 of them.
//!
//! # Slip instabilities
//!
//! A spring that slips holds u = μq/G*, so wear by Δg lets it slip back by μE*Δg/G*, and that slip wears again: by kμp
//! μE*/G* times as much. If this exceeds 1, from about K = 140 for μ = 0.1, the spring slips all at once at any step
//! size. The wear of such a sub-step is limited implicitly, so that the pressure just vanishes, and friction only does
//! work while there is pressure: the rest of the spring's energy is released without friction, and V = k E_d still
//! holds.

use super::super::breakdown::Cause;
use super::super::choices::{Scheme, Stability};
use super::super::model::Model;
use super::super::profile::even_end;
use super::super::state::State;
use super::attempt::attempt;
use super::{Bounds, Scratch, accept, euler, trapezoid};

/// Factor by which a sub-step may exceed the previous one.
const GROWTH: f64 = 1.5;

/// Smallest sub-step, in steps. The wear of a slip instability is limited in these; steps that are merely stiff, on
/// narrow cells, must not reach them, as they would lose wear (6 % of V at K = 300 and 12 steps with 3e-3, 2e-5 with
/// this value).
const SMALLEST: f64 = 1e-4;

/// How a step or a sub-step is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
enum SubStepKind {
    /// As it is, whatever the stiffness.
    Raw,
    /// Only if it is not too stiff.
    Guarded,
    /// As a slip instability, which stays as stiff in the smallest sub-steps.
    Unstable,
}

/// One step from `state` to `cycle`, into the first of two spare states; the other holds the ends of sub-steps.
pub(in super::super) fn step(
    model: &mut Model,
    state: &State,
    [next, between]: &mut [State; 2],
    scratch: &mut Scratch,
    cycle: f64,
) -> Result<(), Cause> {
    let scheme = model.setup.scheme;
    let Bounds { stiff, aim } = match scheme {
        Scheme::Euler => euler::BOUNDS,
        Scheme::Trapezoid => trapezoid::BOUNDS,
    };
    let whole = cycle - state.cycle;
    let mut part = 1.0;
    let mut hopeless = false;
    let (mut parts, mut stiffest) = (0, 0.0_f64);
    loop {
        let from = if parts == 0 { state } else { &*between };
        let left = cycle - from.cycle;
        let in_parts = part * whole < left * (1.0 - 1e-9);
        let reach = if in_parts {
            // Equal sub-steps avoid a tiny last one, too short to extrapolate from.
            let left_over = (left / (part * whole) - 1e-9).ceil();
            from.cycle + left / left_over
        } else {
            cycle
        };
        let kind = match model.setup.stability {
            _ if hopeless => SubStepKind::Raw,
            Stability::Off => SubStepKind::Raw,
            Stability::SubStep if part <= SMALLEST => SubStepKind::Unstable,
            Stability::SubStep => SubStepKind::Guarded,
        };
        let ahead = match scheme {
            Scheme::Trapezoid if kind != SubStepKind::Unstable => {
                trapezoid::ahead(from, reach - from.cycle)
            }
            Scheme::Trapezoid | Scheme::Euler => 0.0,
        };
        let (worn, grown) = (
            [&from.wear[..], &from.image],
            [&from.last.wear[..], &from.last.growth],
        );
        let even = even_end(model, &from.contact.load);
        (scratch.profile).extrapolate(model, worn, (ahead, grown), even);
        let stiffness = attempt(model, from, next, scratch, reach)?;
        match kind {
            // No sub-step is short enough: taking this one shows what is wrong.
            SubStepKind::Guarded if stiffness == f64::INFINITY => {
                hopeless = true;
                continue;
            }
            SubStepKind::Guarded if stiffness > stiff => {
                part = (part * aim / stiffness).max(SMALLEST);
                continue;
            }
            SubStepKind::Guarded | SubStepKind::Raw => {}
            SubStepKind::Unstable => scratch.increment.damp(model),
        }
        accept(model, from, next, scratch, reach)?;
        stiffest = stiffest.max(stiffness);
        parts += 1;
        part = (part * (aim / stiffness).clamp(1.0, GROWTH)).min(1.0);
        if next.cycle >= cycle {
            break;
        }
        std::mem::swap(between, next);
    }
    if parts > 1 {
        next.stats.parts += parts;
    }
    next.last.stiffness = stiffest;
    Ok(())
}
