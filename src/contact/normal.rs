//! Normal springs: independent, without memory. Contact is where the depth exceeds the 1D profile.
//!
//! V. L. Popov, M. Heß (2015), Method of dimensionality reduction in contact mechanics and
//! friction, ch. 3: q_z(x) = E*(d − g(x)) where that is positive; F_z = 2∫₀ᵃ q_z dx.

use crate::math::root;

/// What pressing the profile g to a depth gives, beside the line load itself.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct NormalContact {
    /// F_z, N.
    pub force: f64,
    /// The contact radius a, m: where d − g crosses zero, between nodes; 0 without contact.
    pub radius: f64,
    /// How many nodes, counted from r = 0, lie within the contact radius.
    pub nodes: usize,
}

/// Presses the 1D profile `g` (m) to `depth` (m) on springs of stiffness E* = `modulus` (Pa) a length
/// and writes the line load `q` (N/m).
pub fn press(xs: &[f64], g: &[f64], depth: f64, modulus: f64, q: &mut [f64]) -> NormalContact {
    let mut nodes = 0;
    for (j, (load, &gap)) in q.iter_mut().zip(g).enumerate() {
        let compression = depth - gap;
        // Written so that NaN counts as contact and is seen, instead of passing as an open gap.
        if compression <= 0.0 {
            *load = 0.0;
        } else {
            *load = modulus * compression;
            nodes = j + 1;
        }
    }
    let radius = edge(xs, g, depth, nodes);
    NormalContact {
        force: force(xs, q, nodes, radius),
        radius,
        nodes,
    }
}

/// The contact radius, by linear interpolation in the cell in which the gap opens.
fn edge(xs: &[f64], g: &[f64], depth: f64, nodes: usize) -> f64 {
    match nodes {
        0 => 0.0,
        n if n == xs.len() => xs[n - 1],
        n => {
            let (inside, outside) = (depth - g[n - 1], g[n] - depth);
            xs[n - 1] + (xs[n] - xs[n - 1]) * inside / (inside + outside)
        }
    }
}

/// F = 2∫₀ᵃ q dx with q linear between nodes and down to zero at the edge a.
///
/// Serves for F_z with q_z, for F_x with q_x, and for the power of friction with q_x times the slip.
pub fn force(xs: &[f64], q: &[f64], nodes: usize, radius: f64) -> f64 {
    if nodes == 0 {
        return 0.0;
    }
    let whole_cells = crate::math::quadrature::trapezoid(&xs[..nodes], &q[..nodes]);
    2.0 * whole_cells + (radius - xs[nodes - 1]) * q[nodes - 1]
}

/// The depth (m) at which the profile carries `load` (N), to about 1e-14 of the depth.
/// `None` where the load is beyond what the domain can carry at a depth below `deepest`.
pub fn depth_for_load(
    xs: &[f64],
    g: &[f64],
    load: f64,
    modulus: f64,
    deepest: f64,
    q: &mut [f64],
) -> Option<f64> {
    let shallowest = g.iter().copied().fold(f64::INFINITY, f64::min);
    if load <= 0.0 {
        return Some(shallowest);
    }
    root::bracketed(
        |depth| press(xs, g, depth, modulus, q).force / load - 1.0,
        shallowest,
        deepest,
        1e-15 * deepest,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hertz in units of R = E* = d = 1: g = x², a = 1, F = 4/3.
    fn hertz(cells: usize) -> (Vec<f64>, Vec<f64>) {
        let xs: Vec<f64> = (0..=cells)
            .map(|i| 1.23 * i as f64 / cells as f64)
            .collect();
        let g = xs.iter().map(|x| x * x).collect();
        (xs, g)
    }

    #[test]
    fn the_force_and_the_radius_of_hertz_with_an_error_of_second_order() {
        let mut previous = f64::INFINITY;
        for cells in [50, 100, 200, 400] {
            let (xs, g) = hertz(cells);
            let mut q = vec![f64::NAN; xs.len()];
            let contact = press(&xs, &g, 1.0, 1.0, &mut q);
            let h = xs[1];
            assert!((contact.force - 4.0 / 3.0).abs() < 0.5 * h * h);
            assert!((contact.radius - 1.0).abs() < 0.5 * h * h);
            assert!(q[contact.nodes..].iter().all(|&load| load == 0.0));
            assert!(h < previous);
            previous = h;
        }
    }

    #[test]
    fn a_load_finds_its_depth() {
        let (xs, g) = hertz(200);
        let mut q = vec![0.0; xs.len()];
        let load = press(&xs, &g, 0.8, 1.0, &mut q).force;
        let depth = depth_for_load(&xs, &g, load, 1.0, 1.5, &mut q).expect("a depth");
        assert!((depth - 0.8).abs() < 1e-12);
        assert_eq!(depth_for_load(&xs, &g, 0.0, 1.0, 1.5, &mut q), Some(0.0));
        assert_eq!(depth_for_load(&xs, &g, 1e9, 1.0, 1.5, &mut q), None);
    }

    #[test]
    fn no_contact_carries_nothing() {
        let (xs, g) = hertz(20);
        let mut q = vec![1.0; xs.len()];
        assert_eq!(press(&xs, &g, -0.1, 1.0, &mut q), NormalContact::default());
        assert!(q.iter().all(|&load| load == 0.0));
    }
}
