//! How wear answers to wear, to first order: what stiff [jumps](super::cycle_jump) are implicit in.
//!
//! # Formula
//!
//! ```text
//! −∂W/∂δ ≈ A = diag(∂W/∂p) E* M,   M δ = p by Eq. (3) of q by Eq. (1) of δ
//! ```
//!
//! ∂W/∂p is k μ Σ|s| under Archard's law, s the slip of a [steady-state cycle](super::steady_cycle), which is taken as it
//! is. M covers the springs that touch or nearly do: a node that comes into contact during a jump would otherwise wear
//! without an answer. Such a node takes ∂W/∂p from its neighbour further in. Under a held force the indenter sinks in so
//! that the springs carry as much as before.
//!
//! Systems with 1 + hA are solved by [GMRES](crate::math::krylov), M's three diagonals as preconditioner, with half of the
//! rest of a row on its own node: some ten products of two transforms for stiffnesses of 10 to 10⁶.

use super::super::drive::Control;
use super::super::model::Model;
use super::super::state::SteadyCycle;
use crate::math::krylov;
use crate::math::tridiagonal::Tridiagonal;

/// The residual of the systems, relative to the right side; smaller ones make jumps no longer.
const RESIDUAL: f64 = 1e-3;

/// The most products for a system.
const MOST_PRODUCTS: usize = 60;

/// 1 + hA for jumps from one steady cycle.
pub(super) struct Response<'a> {
    model: &'a Model,
    /// How many springs touch, or nearly do.
    touching: usize,
    /// h ∂W/∂p E* of each node, m.
    answers: Vec<f64>,
    near: Tridiagonal,
}

impl<'a> Response<'a> {
    /// That of a time `h` of `steady` cycles.
    pub fn new(model: &'a Model, steady: &SteadyCycle, h: f64) -> Self {
        let touching = steady.touching;
        let scale = h / model.setup.method.traits().response;
        // Slip grows outwards.
        let mut most = 0.0_f64;
        let cells = steady.stiffness.iter().zip(&model.per_width);
        let mut answers: Vec<f64> = cells
            .map(|(z, per_width)| {
                most = most.max(scale * z / per_width);
                most
            })
            .collect();
        answers[touching..].fill(0.0);
        let rows = answers.iter().zip(model.near_response());
        let near = rows.map(|(answer, row)| {
            let [below, own, above] = row.map(|response| answer * response);
            [below, 1.0 + own, above]
        });
        Self {
            model,
            touching,
            near: Tridiagonal::new(near),
            answers,
        }
    }

    /// (1 + hA)⁻¹ b.
    pub fn solve(&self, b: &[f64]) -> Vec<f64> {
        let Self {
            model,
            touching,
            answers,
            near,
        } = self;
        let is_held = matches!(model.setup.drive.normal(), Control::Force(_));
        let mut load = vec![0.0; b.len()];
        let mut start = b.to_vec();
        near.solve(&mut start);
        krylov::solve(&start, RESIDUAL, MOST_PRODUCTS, |worn, out| {
            model.plan.image(worn, &mut load);
            load[*touching..].fill(0.0);
            if is_held {
                let deeper = model.foundation.mean(&load, *touching);
                load[..*touching].iter_mut().for_each(|q| *q -= deeper);
            }
            model.plan.stress(&load, out);
            for (out, (worn, answer)) in out.iter_mut().zip(worn.iter().zip(answers)) {
                *out = worn + answer * *out;
            }
            near.solve(out);
        })
    }
}
