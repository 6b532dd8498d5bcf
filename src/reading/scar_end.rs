//! Refines loads that end as a [dome](crate::math::abel::dome): the stresses below the surface are sums over springs
//! between which the loads must be linear in x².

use crate::math::abel::dome::Dome;

/// Number of cells at the end of a dome that are divided.
const CELLS: usize = 4;

/// Average number of points per divided cell, at equal steps of the root.
const POINTS: usize = 12;

/// A load, N/m at the nodes, and its dome.
pub(super) type Load<'a> = (&'a [f64], Option<Dome>);

/// Returns nodes (m, from 0 up) and two loads on them, with extra nodes if the first load ends as a dome.
pub(super) fn divided(nodes: &[f64], loads: [Load<'_>; 2]) -> [Vec<f64>; 3] {
    let Some(end) = loads[0].1 else {
        return [nodes, loads[0].0, loads[1].0].map(<[f64]>::to_vec);
    };
    let square = |j: usize| nodes[j] * nodes[j];
    let (last, first) = (end.last, (end.last + 1).saturating_sub(CELLS));
    let count = CELLS * POINTS;
    let squares = (1..count).rev().map(|step| {
        let share = step as f64 / count as f64;
        end.edge - (end.edge - square(first)) * share * share
    });
    let value = |(load, dome): Load<'_>, t: f64| {
        let root = |t: f64| dome.map_or(0.0, |dome| dome.at(t));
        let j = (first..last).find(|&j| square(j + 1) >= t).unwrap_or(last);
        let is_rim = end.edge >= square(last + 1);
        let (to, there) = if j < last || is_rim {
            (square(j + 1), load[j + 1])
        } else {
            (end.edge, 0.0)
        };
        let [from, to_rest] = [load[j] - root(square(j)), there - root(to)];
        root(t) + from + (to_rest - from) * (t - square(j)) / (to - square(j))
    };
    let mut out = [nodes, loads[0].0, loads[1].0].map(|all| all[..=first].to_vec());
    for t in squares {
        let here = [t.sqrt(), value(loads[0], t), value(loads[1], t)];
        out.iter_mut()
            .zip(here)
            .for_each(|(all, one)| all.push(one));
    }
    let beyond = [nodes, loads[0].0, loads[1].0].map(|all| &all[last + 1..]);
    out.iter_mut()
        .zip(beyond)
        .for_each(|(all, rest)| all.extend(rest));
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::subsurface::SpringLoad;

    /// Below a uniform pressure p on a circle the stress on the axis is σ_z = −p [1 − z³/(a² + z²)^{3/2}]; at the
    /// surface it is p up to the edge.
    #[test]
    fn an_even_pressure_is_even_up_to_the_edge() {
        let nodes: Vec<f64> = (0..=20).map(|j| f64::from(j) / 16.2).collect();
        let dome = Dome {
            height: 2.0,
            edge: 1.0,
            last: 16,
            beyond: 0.0,
        };
        let load: Vec<f64> = nodes.iter().map(|x| dome.at(x * x)).collect();
        let none = vec![0.0; nodes.len()];
        let stress = |dome: Option<Dome>, x: f64, z: f64| {
            let [nodes, normal, tangential] = divided(&nodes, [(&load, dome), (&none, None)]);
            SpringLoad::new(&nodes, &normal, &tangential, 1.0, 0.3)
                .stress(x, z)
                .zz
        };
        let z: f64 = 0.5;
        let exact = z.powi(3) / (1.0 + z * z).powf(1.5) - 1.0;
        assert!((stress(Some(dome), 0.0, z) - exact).abs() < 2e-3);
        let worst = |dome: Option<Dome>| {
            let radii = (0..=98).map(|i| 0.01 * f64::from(i));
            radii.fold(0.0, |most: f64, r| {
                most.max((stress(dome, r, 0.0) + 1.0).abs())
            })
        };
        let (with, without) = (worst(Some(dome)), worst(None));
        assert!(with < 0.03 && without > 5.0 * with, "{with} {without}");
    }
}
