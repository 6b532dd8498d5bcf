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
    /// V that the friction work explains, m³: its integral with k.
    pub expected_volume: f64,
    /// What a cycle does after it.
    pub steady: SteadyCycle,
    /// The error of the wear, m.
    pub error: Vec<f64>,
    /// Error of the friction work, J.
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

/// What a jump has summed up besides the wear: cycles, the work of friction, J, and the volume that it explains, m³.
type Sums = [f64; 3];

impl Means<'_> {
    /// A steady cycle on a worn depth (m), whose 1D image is written, with the friction and k that have run in by then;
    /// and what it adds to the sums.
    fn look(
        &mut self,
        wear: &[f64],
        [cycle, work, _]: Sums,
        image: &mut [f64],
    ) -> Result<(SteadyCycle, Sums), Cause> {
        let mut run_in = None;
        let model = match &self.model.setup.running_in {
            None => self.model,
            Some(_) => {
                let model = run_in.insert(self.model.clone());
                let before = &self.memory;
                let energy = before.ledger.dissipated_energy + work;
                model.setup.run_in(before.cycle + cycle, energy);
                &*model
            }
        };
        model.plan.image(wear, image);
        let (spare, scratch) = (&mut *self.spare, &mut *self.scratch);
        let steady = steady_cycle::cycle(model, self.memory, spare, scratch, [wear, image])?;
        let sums = rates(model, &steady);
        Ok((steady, sums))
    }

    /// The same at the end of a jump; refuses a depth that cannot come of contact.
    fn look_at_end(
        &mut self,
        wear: &[f64],
        sums: Sums,
        image: &mut [f64],
    ) -> Result<(SteadyCycle, Sums), Cause> {
        let found = self.look(wear, sums, image)?;
        let depth = self.memory.contact.depth;
        refuse(self.model, depth, wear, self.model.grid.nodes())?;
        Ok(found)
    }

    /// A Runge–Kutta–Chebyshev step over `covered` cycles of the worn depth and the sums.
    pub fn explicit(mut self, covered: f64, stages: usize) -> Result<Jump, Cause> {
        let nodes = self.model.nodes();
        let with_sums = |wear: &[f64], sums: Sums| [wear, &sums].concat();
        let apart = |y: &[f64]| [y[nodes], y[nodes + 1], y[nodes + 2]];
        let start = with_sums(&self.memory.wear, Sums::default());
        let slope = with_sums(&self.first.wear, rates(self.model, self.first));
        let mut image = vec![0.0; nodes];
        let end = chebyshev::step(stages, covered, &start, &slope, |y, out| {
            let (steady, sums) = self.look(&y[..nodes], apart(y), &mut image)?;
            out[..nodes].copy_from_slice(&steady.wear);
            out[nodes..].copy_from_slice(&sums);
            Ok::<(), Cause>(())
        })?;
        let (wear, sums) = (end[..nodes].to_vec(), apart(&end));
        let (steady, last) = self.look_at_end(&wear, sums, &mut image)?;
        let slopes = slope.iter().zip(steady.wear.iter().chain(&last));
        let errors = start.iter().zip(&end).zip(slopes);
        let mut error: Vec<f64> = errors
            .map(|((y, next), (first, last))| chebyshev::error(covered, *y, *next, *first, *last))
            .collect();
        let error_of_work = error[nodes + 1];
        error.truncate(nodes);
        Ok(Jump {
            covered,
            error,
            error_of_work,
            wear,
            image,
            friction_work: sums[1],
            expected_volume: sums[2],
            steady,
        })
    }

    /// A linearly implicit step over `covered` cycles.
    ///
    /// The work of friction goes with the volume, which the step knows better than a trapezoid does; what is not
    /// in proportion to it changes slowly. Friction and k must have run in.
    pub fn implicit(mut self, covered: f64) -> Result<Jump, Cause> {
        let (model, first) = (self.model, self.first);
        let response = Response::new(model, first, rosenbrock::GAMMA * covered);
        let start = self.memory.wear.clone();
        let mut image = vec![0.0; model.nodes()];
        let solve = |b: &[f64]| response.solve(b);
        let wear = rosenbrock::step(covered, &start, &first.wear, solve, |y, out| {
            let (steady, _) = self.look(y, Sums::default(), &mut image)?;
            out.copy_from_slice(&steady.wear);
            Ok::<(), Cause>(())
        })?;
        let (steady, _) = self.look_at_end(&wear, Sums::default(), &mut image)?;
        let defect = rosenbrock::defect(covered, [&start, &wear], [&first.wear, &steady.wear]);
        let error = response.solve(&defect);
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
        let friction_work = trapezoid(works) - per_volume * model.volume(&defect);
        Ok(Jump {
            covered,
            friction_work,
            expected_volume: friction_work * explained(model),
            error_of_work: per_volume * model.volume(&sizes),
            error,
            wear,
            image,
            steady,
        })
    }
}

/// What a steady cycle adds to the sums.
fn rates(model: &Model, steady: &SteadyCycle) -> Sums {
    let work = steady.friction_work;
    [1.0, work, explained(model) * work]
}

/// k, m³/J, if the law wears by the work of friction; otherwise 0.
fn explained(model: &Model) -> f64 {
    let law = model
        .setup
        .wear
        .filter(|law| law.traits().explained_by_work);
    law.map_or(0.0, |law| law.coefficient())
}
