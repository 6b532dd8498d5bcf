//! Tangential springs: Coulomb's rule for each, and memory of where each one stands.
//!
//! The second Eq. (15) of the paper (the number is given twice): predict that a spring moves with
//! the indenter; where G*|u| ≤ μ q_z it does (stick), elsewhere u = ±μ q_z/G* with the
//! predictor's sign (slip). A spring out of contact carries nothing and remembers nothing: u = 0.

/// How far beyond its limit, in parts of the predicted displacement, a spring still sticks.
///
/// A spring that has shaken down touches its limit once a cycle and no more: rounding must not
/// make it slip there.
const TOUCH: f64 = 1e-10;

/// What one increment of tangential motion gives, beside the displacements themselves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slide {
    /// The radius within which every spring sticks, m, between nodes; the contact radius when all stick.
    pub stick_radius: f64,
    /// How many nodes, counted from r = 0, stick.
    pub stick_nodes: usize,
}

/// The part of the contact that the tangential springs need to know.
#[derive(Debug, Clone, Copy)]
pub struct Grip<'a> {
    /// Nodes, m.
    pub xs: &'a [f64],
    /// The normal line load q_z, N/m, nodal.
    pub normal_load: &'a [f64],
    /// The contact radius a, m.
    pub contact_radius: f64,
    /// μ/G*, 1/Pa: how far a spring of unit load can be strained.
    pub reach: f64,
}

/// Moves the indenter by `increment` (m): `spring` (m), the displacement of every spring, is carried
/// from before to after, and `slip` (m) receives what the indenter moved and the spring did not.
///
/// The slip is exactly zero where a spring sticks, so that a transform that looks inwards gives a
/// surface slip of exactly zero inside the stick zone.
pub fn slide(grip: Grip<'_>, increment: f64, spring: &mut [f64], slip: &mut [f64]) -> Slide {
    // Innermost spring that slips, and how far each neighbour is from its limit, for the border.
    let mut border = None;
    let mut excess_before = -1.0;
    for (j, ((u, slipped), &load)) in spring
        .iter_mut()
        .zip(slip)
        .zip(grip.normal_load)
        .enumerate()
    {
        let limit = grip.reach * load;
        let before = if load > 0.0 { *u } else { 0.0 };
        let predicted = *u + increment;
        let excess = predicted.abs() - limit;
        if excess <= TOUCH * predicted.abs() && load > 0.0 {
            *u = predicted.clamp(-limit, limit);
            *slipped = 0.0;
        } else {
            *u = if load > 0.0 {
                limit.copysign(predicted)
            } else {
                0.0
            };
            *slipped = increment - (*u - before);
            if border.is_none() {
                border = Some((j, crossing(grip.xs, j, excess_before, excess)));
            }
        }
        excess_before = excess;
    }
    let (stick_nodes, stick_radius) = border.unwrap_or((grip.xs.len(), grip.contact_radius));
    Slide {
        stick_radius: stick_radius.min(grip.contact_radius),
        stick_nodes,
    }
}

/// Where the excess of the prediction over the limit crosses zero between nodes j − 1 and j.
fn crossing(xs: &[f64], j: usize, before: f64, at: f64) -> f64 {
    if j == 0 {
        return 0.0;
    }
    let share = if at > before {
        -before / (at - before)
    } else {
        1.0
    };
    xs[j - 1] + (xs[j] - xs[j - 1]) * share.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Springs under a Hertzian load in units of d = a = E* = G* = 1, μ = 0.1.
    fn hertz() -> (Vec<f64>, Vec<f64>) {
        let xs: Vec<f64> = (0..=300).map(|i| 1.5 * f64::from(i) / 300.0).collect();
        let load = xs.iter().map(|x| (1.0 - x * x).max(0.0)).collect();
        (xs, load)
    }

    fn grip<'a>(xs: &'a [f64], load: &'a [f64]) -> Grip<'a> {
        Grip {
            xs,
            normal_load: load,
            contact_radius: 1.0,
            reach: 0.1,
        }
    }

    #[test]
    fn the_stick_border_is_cattaneos() {
        // 1 − c² = U/μ: with U = 0.05, c = √½.
        let (xs, load) = hertz();
        let (mut u, mut slip) = (vec![0.0; xs.len()], vec![f64::NAN; xs.len()]);
        let slide = slide(grip(&xs, &load), 0.05, &mut u, &mut slip);
        assert!(
            (slide.stick_radius - 0.5f64.sqrt()).abs() < 1e-5,
            "{slide:?}"
        );
        assert!(slip[..slide.stick_nodes].iter().all(|&s| s == 0.0));
        assert!(slip[slide.stick_nodes..].iter().all(|&s| s > 0.0));
    }

    #[test]
    fn history_is_kept_and_a_reversal_sticks_everywhere() {
        let (xs, load) = hertz();
        let (mut u, mut slip) = (vec![0.0; xs.len()], vec![0.0; xs.len()]);
        slide(grip(&xs, &load), 0.05, &mut u, &mut slip);
        let there = u.clone();
        let back = slide(grip(&xs, &load), -1e-9, &mut u, &mut slip);
        // All but the springs at the very edge, which carry less than the increment, stick.
        assert!(back.stick_radius > 0.99);
        assert!(
            u.iter()
                .zip(&there)
                .take(190)
                .all(|(now, then)| (now - then + 1e-9).abs() < 1e-15)
        );
    }

    #[test]
    fn a_spring_that_only_touches_its_limit_sticks() {
        let (xs, load) = hertz();
        let (mut u, mut slip) = (vec![0.0; xs.len()], vec![0.0; xs.len()]);
        slide(grip(&xs, &load), 0.05, &mut u, &mut slip);
        slide(grip(&xs, &load), -0.03, &mut u, &mut slip);
        let again = slide(grip(&xs, &load), 0.03 * (1.0 + 1e-12), &mut u, &mut slip);
        // Slipped there and back: only where 2μ(1 − x²) < 0.03. Further in, up to √½, limits are touched.
        assert!(
            (again.stick_radius - 0.85f64.sqrt()).abs() < 0.005,
            "{again:?}"
        );
        assert!(slip[..again.stick_nodes].iter().all(|&s| s == 0.0));
    }

    #[test]
    fn an_open_spring_forgets() {
        let (xs, load) = hertz();
        let (mut u, mut slip) = (vec![0.02; xs.len()], vec![0.0; xs.len()]);
        slide(grip(&xs, &load), 0.0, &mut u, &mut slip);
        assert!(u.iter().zip(&load).all(|(&u, &q)| q > 0.0 || u == 0.0));
        assert!(u.iter().zip(&load).all(|(&u, &q)| u.abs() <= 0.1 * q));
    }

    #[test]
    fn without_friction_everything_slips() {
        let (xs, load) = hertz();
        let (mut u, mut slip) = (vec![0.0; xs.len()], vec![0.0; xs.len()]);
        let slide = slide(
            Grip {
                reach: 0.0,
                ..grip(&xs, &load)
            },
            0.05,
            &mut u,
            &mut slip,
        );
        assert_eq!(slide.stick_radius, 0.0);
        assert!(u.iter().all(|&u| u == 0.0));
        assert!(slip.iter().all(|&s| s == 0.05));
    }
}
