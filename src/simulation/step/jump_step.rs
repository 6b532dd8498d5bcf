//! One step of the integration over cycles: explicit in many stages, or implicit in the [response](super::response) of wear
//! to wear.

use super::super::breakdown::Cause;
use super::super::model::Model;
use super::super::state::{State, SteadyCycle};
use super::response::Response;
use super::{Scratch, refuse, steady_cycle};
use crate::math::{chebyshev, rosenbrock};

/// A jump over cycles, and the profile after it.
pub(super) struct Jump {
    /// How many cycles it covers.
    pub covered: f64,
    pub wear: Vec<f64>,
    pub image: Vec<f64>,
    pub friction_work: f64,
    /// What a cycle does after it.
    pub steady: SteadyCycle,
    /// The error of the wear, m.
    pub error: Vec<f64>,
    /// That of the friction work, J.
    pub error_of_work: f64,
}

/// What a jump is made with: `memory` holds the springs, before it and then at its end.
pub(super) struct Means<'a> {
    pub model: &'a Model,
    /// What a cycle does before the jump.
    pub first: &'a SteadyCycle,
    pub memory: &'a mut State,
    pub spare: &'a mut State,
    pub scratch: &'a mut Scratch,
}

impl Means<'_> {
    /// A steady cycle on a worn depth (m), whose 1D image is written.
    fn look(&mut self, wear: &[f64], image: &mut [f64]) -> Result<SteadyCycle, Cause> {
        self.model.plan.image(wear, image);
        self.memory.stats.transforms += 1;
        let (spare, scratch) = (&mut *self.spare, &mut *self.scratch);
        steady_cycle::cycle(self.model, self.memory, spare, scratch, [wear, image])
    }

    /// The same at the end of a jump; refuses a depth that cannot come of contact.
    fn look_at_end(&mut self, wear: &[f64], image: &mut [f64]) -> Result<SteadyCycle, Cause> {
        let steady = self.look(wear, image)?;
        let depth = self.memory.contact.depth;
        refuse(self.model, depth, wear, self.model.grid.nodes())?;
        Ok(steady)
    }

    /// A Runge–Kutta–Chebyshev step over `covered` cycles. The last entry of y is the work of friction.
    pub fn explicit(mut self, covered: f64, stages: usize) -> Result<Jump, Cause> {
        let nodes = self.model.nodes();
        let with_work = |wear: &[f64], friction_work: f64| [wear, &[friction_work]].concat();
        let start = with_work(&self.memory.wear, 0.0);
        let slope = with_work(&self.first.wear, self.first.friction_work);
        let mut image = vec![0.0; nodes];
        let mut wear = chebyshev::step(stages, covered, &start, &slope, |y, out| {
            let steady = self.look(&y[..nodes], &mut image)?;
            out[..nodes].copy_from_slice(&steady.wear);
            out[nodes] = steady.friction_work;
            Ok::<(), Cause>(())
        })?;
        let friction_work = wear.pop().unwrap_or_default();
        let steady = self.look_at_end(&wear, &mut image)?;
        let error = |y, next, first, last| chebyshev::error(covered, y, next, first, last);
        let ends = start.iter().zip(&wear);
        let slopes = slope.iter().zip(&steady.wear);
        let errors = ends.zip(slopes);
        Ok(Jump {
            covered,
            error: errors
                .map(|((y, next), (first, last))| error(*y, *next, *first, *last))
                .collect(),
            error_of_work: error(0.0, friction_work, slope[nodes], steady.friction_work),
            wear,
            image,
            friction_work,
            steady,
        })
    }

    /// A linearly implicit step over `covered` cycles.
    ///
    /// The work of friction goes with the volume, which the step knows better than a trapezoid does; what is not
    /// in proportion to it changes slowly.
    pub fn implicit(mut self, covered: f64) -> Result<Jump, Cause> {
        let (model, first) = (self.model, self.first);
        let mut response = Response::new(model, first, rosenbrock::GAMMA * covered);
        let start = self.memory.wear.clone();
        let mut image = vec![0.0; model.nodes()];
        let solve = |b: &[f64]| response.solve(b);
        let wear = rosenbrock::step(covered, &start, &first.wear, solve, |y, out| {
            out.copy_from_slice(&self.look(y, &mut image)?.wear);
            Ok::<(), Cause>(())
        })?;
        let steady = self.look_at_end(&wear, &mut image)?;
        let defect = rosenbrock::defect(covered, [&start, &wear], [&first.wear, &steady.wear]);
        let error = response.solve(&defect);
        self.memory.stats.transforms += response.transforms;
        let sizes: Vec<f64> = error.iter().map(|error| error.abs()).collect();
        let rates = [first, &steady].map(|cycle| model.volume(&cycle.wear));
        let works = [first, &steady].map(|cycle| cycle.friction_work);
        let [falls, less] = [rates, works].map(|[before, after]| before - after);
        let of_all = if rates[0] > 0.0 {
            works[0] / rates[0]
        } else {
            0.0
        };
        let per_volume = if falls > 0.0 {
            (less / falls).min(of_all).max(0.0)
        } else {
            of_all
        };
        let trapezoid = |[before, after]: [f64; 2]| 0.5 * covered * (before + after);
        Ok(Jump {
            covered,
            friction_work: trapezoid(works) - per_volume * model.volume(&defect),
            error_of_work: per_volume * model.volume(&sizes),
            error,
            wear,
            image,
            steady,
        })
    }
}
