//! Normal springs: independent and without memory. They touch where the depth exceeds the 1D profile.
//!
//! V. L. Popov, M. Heß (2015), Method of dimensionality reduction in contact mechanics
//! and friction, ch. 3: q_z(x) = E*(d − g(x)) where that is positive; F_z = 2∫₀ᵃ q_z dx.
//!
//! The edge of the contact lies between two springs. The compression d − g is known on both sides of it, negative
//! outside, so it is interpolated, never extrapolated: exact for a paraboloid and a cone.
//!
//! This fails at the end of a scar: beyond it g rises like a root, 5 to 50 times as steeply as the load falls towards
//! it, and a line from one to the other ends too early. There the contact ends with the scar, or as far out as the
//! loads inside suggest, and the load ends as a [dome](crate::math::abel::dome).

use std::hint::select_unpredictable as select;

use super::foundation::{NormalContact, WinklerFoundation};
use crate::math::abel::dome::Dome;
use crate::math::abel::field::Field;
use crate::math::abel::kink;
use crate::math::abel::product;
use crate::math::root;
use crate::math::scan::{changes, largest};
use crate::math::vector::vectorized;

/// An edge closer to a spring than this fraction of the cell counts as being on it.
const ON_A_SPRING: f64 = 1e-9;

/// Springs under a 1D profile.
#[derive(Debug, Clone, Copy)]
pub struct Springs<'a> {
    /// Their positions.
    pub row: &'a WinklerFoundation,
    /// The profile g, m, nodal.
    pub g: &'a [f64],
    /// Their stiffness per length, E*, Pa.
    pub modulus: f64,
    /// End of the scar, t = r², m².
    pub scar: Option<f64>,
}

/// Presses the profile to `depth` (m): writes the line `load` (N/m).
pub fn press(springs: Springs<'_>, depth: f64, load: &mut Field) -> NormalContact {
    let Springs {
        row,
        g,
        modulus,
        scar,
    } = springs;
    let Field {
        nodal: q,
        kinks,
        dome,
    } = load;
    kinks.clear();
    *dome = None;
    let (xs, squares) = (row.nodes(), row.squares());
    let mut contact = NormalContact::default();
    let compression = |k: usize| modulus * (depth - g[k]);
    // Written so that NaN counts as contact and shows, rather than passing as an open gap.
    let is_open = |compression: f64| compression <= 0.0;
    contact.strongest = vectorized(
        #[inline(always)]
        || {
            let mut finite = true;
            for (load, gap) in q.iter_mut().zip(g) {
                let compression = modulus * (depth - gap);
                *load = select(is_open(compression), 0.0, compression);
                finite &= load.is_finite();
            }
            if finite { largest(q) } else { f64::NAN }
        },
    );
    let cusp = row.cusp(&[0, 1, 2].map(compression), f64::INFINITY);
    // One side of an edge is open, the other in contact.
    for k in changes(q, |&load| is_open(load)) {
        let ends = [compression(k - 1), compression(k)];
        let mut edge = product::edge_square(&xs[k - 1..=k], &ends, 0, cusp);
        let (left, right) = (squares[k - 1], squares[k]);
        if let Some(scar) = scar.filter(|&scar| ends_at(scar, squares, k) && is_open(ends[1])) {
            edge = edge_of_scar(&q[..k], squares, [edge, scar]);
            *dome = Dome::fit(&q[..k], squares, edge).map(|dome| row.measured(dome));
        }
        let share = (edge - left) / (right - left);
        if share > ON_A_SPRING && share < 1.0 - ON_A_SPRING {
            kink::polyline([left, right], [q[k - 1], q[k]], &[(edge, 0.0)], kinks);
        }
        if is_open(ends[1]) {
            contact.radius = edge.sqrt().max(xs[k - 1]);
            contact.nodes = k;
        }
    }
    if q.last().is_some_and(|&load| load != 0.0) {
        (contact.nodes, contact.radius) = (q.len(), xs[q.len() - 1]);
        // At a rim the load ends with a jump; as the contact wears, the load falls to that jump like a root.
        if scar.is_some() {
            *dome = Dome::at_rim(q, squares).map(|dome| row.measured(dome));
        }
    }
    contact
}

/// Whether a `scar` ends with the contact of the first k springs or beyond it, but for the outermost spring that has not
/// worn yet. A step that wears the last node a little too much opens it; the load then still ends like a root, and a line
/// in t would make p there several times too large.
fn ends_at(scar: f64, squares: &[f64], k: usize) -> bool {
    k >= 2 && scar > squares[k - 2]
}

/// Where the contact of springs under the loads `q` ends, t = x² in m²: with the scar, or where the dome of the loads
/// further in falls through the last one, if that has just touched and not worn yet; in any case beyond the `line` of
/// d − g, and where the last two loads fall to zero on a line in t, at the latest.
fn edge_of_scar(q: &[f64], squares: &[f64], [line, scar]: [f64; 2]) -> f64 {
    let last = q.len() - 1;
    let (from, load) = (squares[last], q[last]);
    let of_dome = |dome: Dome| from + (load / dome.height).powi(2);
    let touched = || Dome::fit(&q[..last], squares, from).map_or(line, of_dome);
    let falls = (q[last - 1] - load) / (from - squares[last - 1]);
    let led_to = if falls > 0.0 {
        from + load / falls
    } else {
        f64::INFINITY
    };
    let end = if scar > from { scar } else { touched() };
    end.max(line).min(led_to).min(squares[last + 1])
}

/// Finds the depth (m) at which the profile carries `load` (N), to about 1e-14 of the depth, starting nearby and
/// searching up to the `deepest`. `None` if the row cannot carry the load there.
pub fn depth_for_load(
    springs: Springs<'_>,
    load: f64,
    [near, deepest]: [f64; 2],
    carried: &mut Field,
) -> Option<f64> {
    let shallowest = springs.g.iter().copied().fold(f64::INFINITY, f64::min);
    if load <= 0.0 {
        return Some(shallowest);
    }
    // Every spring in contact adds its stiffness.
    let slope = |radius: f64| 2.0 * springs.modulus * radius / load;
    root::newton(
        |depth| {
            let contact = press(springs, depth, carried);
            let excess = springs.row.force(carried, contact) / load - 1.0;
            [excess, slope(contact.radius)]
        },
        near,
        [shallowest, deepest],
        1e-15 * deepest,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::RadialGrid;

    /// Hertz in units of R = E* = d = 1: g = x², a = 1, F = 4/3.
    fn hertz(cells: usize) -> (WinklerFoundation, Vec<f64>) {
        let grid = RadialGrid::uniform(cells, 1.23).expect("a grid");
        let g = grid.squares().to_vec();
        (WinklerFoundation::new(&grid), g)
    }

    fn springs<'a>(row: &'a WinklerFoundation, g: &'a [f64]) -> Springs<'a> {
        let (modulus, scar) = (1.0, None);
        Springs {
            row,
            g,
            modulus,
            scar,
        }
    }

    #[test]
    fn hertz_is_exact_wherever_the_edge_falls() {
        for cells in [7, 50, 123] {
            let (row, g) = hertz(cells);
            let mut q = Field::zeros(g.len());
            q.nodal.fill(f64::NAN);
            let contact = press(springs(&row, &g), 1.0, &mut q);
            let force = row.force(&q, contact);
            assert!((force - 4.0 / 3.0).abs() < 1e-14, "{force}");
            assert!((contact.strongest - 1.0).abs() < 1e-15);
            assert!((contact.radius - 1.0).abs() < 1e-14);
            assert!(q.nodal[contact.nodes..].iter().all(|&load| load == 0.0));
        }
    }

    /// A uniform pressure up to the edge a = 1 of a scar; beyond it the gap rises five times as steeply.
    #[test]
    fn the_load_on_a_scar_is_exact_wherever_it_ends() {
        for cells in [7, 50, 123] {
            let grid = RadialGrid::uniform(cells, 1.23).expect("a grid");
            let row = WinklerFoundation::new(&grid);
            let root = |t: f64| 5.0 * (t - 1.0).max(0.0).sqrt() - (1.0 - t).max(0.0).sqrt();
            let g: Vec<f64> = grid.squares().iter().map(|&t| root(t)).collect();
            let mut q = Field::zeros(g.len());
            let scar = |end| Springs {
                scar: end,
                ..springs(&row, &g)
            };
            let force = |contact, q: &Field| row.force(q, contact) / std::f64::consts::FRAC_PI_2;
            let contact = press(scar(Some(1.0)), 0.0, &mut q);
            let exact = force(contact, &q);
            assert!((contact.radius - 1.0).abs() < 1e-14, "{}", contact.radius);
            // The last nodes inside determine the dome.
            assert!((exact - 1.0).abs() < 1e-3, "{exact}");
            let dome = q.dome.expect("a dome");
            assert!((dome.height - 1.0).abs() < 1e-2, "{}", dome.height);
            // Without the scar the contact ends too early and carries too little.
            let contact = press(scar(None), 0.0, &mut q);
            assert!(contact.radius <= 1.0 && q.dome.is_none());
            assert!(force(contact, &q) < 1.0 - 1e-4);
        }
    }

    #[test]
    fn a_load_finds_its_depth() {
        let (row, g) = hertz(200);
        let mut q = Field::zeros(g.len());
        let contact = press(springs(&row, &g), 0.8, &mut q);
        let load = row.force(&q, contact);
        let mut depth = |load| depth_for_load(springs(&row, &g), load, [0.0, 1.5], &mut q);
        assert!((depth(load).expect("a depth") - 0.8).abs() < 1e-12);
        assert_eq!(depth(0.0), Some(0.0));
        assert_eq!(depth(1e9), None);
    }

    #[test]
    fn no_contact_carries_nothing() {
        let (row, g) = hertz(20);
        let mut q = Field::zeros(g.len());
        q.nodal.fill(1.0);
        assert_eq!(
            press(springs(&row, &g), -0.1, &mut q),
            NormalContact::default()
        );
        assert!(q.nodal.iter().all(|&load| load == 0.0) && q.kinks.is_empty());
    }

    #[test]
    fn a_gap_in_the_middle_is_seen() {
        let (row, g) = hertz(100);
        // A worn tip: contact in a ring.
        let g: Vec<f64> = g.iter().map(|t| t + 2.0 * (0.3 - t).max(0.0)).collect();
        let mut q = Field::zeros(g.len());
        let contact = press(springs(&row, &g), 0.5, &mut q);
        assert!((contact.radius - 0.5f64.sqrt()).abs() < 1e-12);
        assert_eq!(q.nodal[0], 0.0);
        assert_eq!(q.kinks.len(), 6);
    }
}
