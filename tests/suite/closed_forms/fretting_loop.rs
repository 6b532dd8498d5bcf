//! The tangential loop of the paraboloid, its energy, and the wear of one cycle.
//!
//! Sources: Masing (1926) for the rule, Mindlin & Deresiewicz (1953) for the loop and its energy
//! (Johnson 1985, Eq. 7.57), Dimaki et al. (2014) for the wear:
//! - unloading from U: F_x(u) = F(U) − 2F((U−u)/2), reloading from −U: −F(U) + 2F((U+u)/2), with F
//!   the first loading of [`super::cattaneo_mindlin`]; τ(r) follows the same rule;
//! - E_d = (16μ²E*²/(15G*R²))[a⁵ − c⁵ − 5a²c²(a−c)] = (16μ²E*²/(15G*R²))(a−c)³(a²+3ac+c²);
//!   in gross slip 4μF_z(U − 0.8U_s);
//! - wear per cycle on the frozen profile, (15): Δf = 4μk p(r) s(r), since the point slips from s
//!   to −s and back under |τ| = μp. Its volume is k·E_d.

use super::cattaneo_mindlin::CattaneoMindlin;

/// The branch of a closed tangential cycle −U … U on which a displacement lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// The first loading, from 0 towards ±U.
    Loading,
    /// From +U down to −U.
    Unloading,
    /// From −U up to +U.
    Reloading,
}

/// Applies Masing's rule: derives a branch of the loop from the odd first-loading curve.
///
/// Unloading: h(U) − 2h((U−u)/2); reloading: −h(U) + 2h((U+u)/2). `first` must be the curve for
/// non-negative displacements; the unit is the curve's. NaN for |u| > U.
pub fn masing(first: impl Fn(f64) -> f64, amplitude: f64, branch: Branch, u: f64) -> f64 {
    if !(-amplitude..=amplitude).contains(&u) {
        return f64::NAN;
    }
    match branch {
        Branch::Loading if u < 0.0 => -first(-u),
        Branch::Loading => first(u),
        Branch::Unloading => first(amplitude) - 2.0 * first(0.5 * (amplitude - u)),
        Branch::Reloading => 2.0 * first(0.5 * (amplitude + u)) - first(amplitude),
    }
}

impl CattaneoMindlin {
    /// F_x, N, at displacement u of the steady-state loop −U … U by Masing's rule; NaN for |u| > U.
    pub fn loop_force(&self, branch: Branch, u: f64) -> f64 {
        masing(|x| self.first_loading_force(x), self.amplitude, branch, u)
    }

    /// τ(r), Pa, at displacement u of the steady-state loop, by Masing's rule; NaN for |u| > U.
    pub fn loop_shear(&self, branch: Branch, u: f64, r: f64) -> f64 {
        masing(
            |x| self.first_loading_shear(x, r),
            self.amplitude,
            branch,
            u,
        )
    }

    /// E_d, J: frictional work of a steady-state cycle −U … U.
    pub fn energy_per_cycle(&self) -> f64 {
        if self.is_gross_slip() {
            let beyond = self.amplitude - 0.8 * self.gross_slip_displacement();
            return 4.0 * self.mu * self.normal_force() * beyond;
        }
        if self.amplitude == 0.0 {
            return 0.0;
        }
        let (a, c) = (self.contact_radius(), self.stick_radius());
        let ring = self.radius * self.kappa() * self.amplitude / (a + c);
        let factor = 16.0 * (self.mu * self.e_star / self.radius).powi(2) / (15.0 * self.g_star);
        factor * ring.powi(3) * (a * a + 3.0 * a * c + c * c)
    }

    /// Δf(r) = 4μk p(r) s(r), m: wear per steady-state cycle on the frozen profile, k in 1/Pa; 0 outside.
    pub fn wear_per_cycle(&self, wear_coefficient: f64, r: f64) -> f64 {
        if r >= self.contact_radius() {
            return 0.0;
        }
        4.0 * self.mu * wear_coefficient * self.pressure(r) * self.slip(r)
    }

    /// V = k·E_d, m³: worn volume per steady-state cycle on the frozen profile.
    pub fn worn_volume_per_cycle(&self, wear_coefficient: f64) -> f64 {
        wear_coefficient * self.energy_per_cycle()
    }
}

#[cfg(test)]
mod tests {
    use super::super::partial_slip::PartialSlip;
    use super::super::quadrature::integrate;
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn model(fraction: f64) -> CattaneoMindlin {
        let rest = CattaneoMindlin {
            e_star: 2.3e11,
            g_star: 1.9e11,
            mu: 0.3,
            radius: 0.01,
            depth: 1e-6,
            amplitude: 0.0,
        };
        let amplitude = fraction * rest.gross_slip_displacement();
        CattaneoMindlin { amplitude, ..rest }
    }

    fn close(value: f64, exact: f64, relative: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(
            error <= relative * exact.abs(),
            "{what}: {value:e} against {exact:e}"
        );
    }

    const FRACTIONS: [f64; 6] = [1e-3, 0.1, 0.5, 0.9, 1.0, 1.7];

    #[test]
    fn masing_follows_one_elastic_slider() {
        // Steps one spring of stiffness 1 and limit 1, and compares it with the rule.
        let first = |u: f64| u.min(1.0);
        let (amplitude, steps) = (1.7, 1700);
        let step = amplitude / f64::from(steps);
        let (mut force, mut at) = (0.0f64, 0.0f64);
        let mut walk = |direction: f64, count: i32, branch: Branch| {
            for _ in 0..count {
                at += direction * step;
                force = (force + direction * step).clamp(-1.0, 1.0);
                let rule = masing(first, amplitude, branch, at.clamp(-amplitude, amplitude));
                assert!((force - rule).abs() < 1e-12, "{branch:?} at {at}");
            }
        };
        walk(1.0, steps, Branch::Loading);
        walk(-1.0, 2 * steps, Branch::Unloading);
        walk(1.0, 2 * steps, Branch::Reloading);
        assert_eq!(masing(first, 1.0, Branch::Loading, -0.5), -0.5);
        assert!(masing(first, 1.0, Branch::Unloading, 1.1).is_nan());
    }

    #[test]
    fn energy_is_the_area_of_the_loop_and_wear_its_volume() {
        for m in FRACTIONS.map(model) {
            let u = m.amplitude;
            let width =
                |x: f64| m.loop_force(Branch::Reloading, x) - m.loop_force(Branch::Unloading, x);
            // Symmetric in u; the corner of gross slip is a break point.
            let corner = (u - 2.0 * m.gross_slip_displacement()).abs().min(u);
            let half = integrate(width, 0.0, corner) + integrate(width, corner, u);
            close(m.energy_per_cycle(), 2.0 * half, 1e-10, "area");
            let (k, a, c) = (1e-12, m.contact_radius(), m.stick_radius());
            let ring = |r: f64| 2.0 * PI * r * m.wear_per_cycle(k, r);
            // r = c + (a−c)(1−t²) removes the root at a.
            let l = a - c;
            let volume = integrate(|t| ring(c + l * (1.0 - t * t)) * 2.0 * l * t, 0.0, 1.0);
            close(m.worn_volume_per_cycle(k), volume, 1e-9, "V = k E_d");
        }
    }

    #[test]
    fn published_form_of_the_energy_and_of_mindlin_and_deresiewicz() {
        for m in [0.3, 0.7, 1.0].map(model) {
            let (a, c) = (m.contact_radius(), m.stick_radius());
            let sum = a.powi(5) - c.powi(5) - 5.0 * a * a * c * c * (a - c);
            let factor = 16.0 * (m.mu * m.e_star / m.radius).powi(2) / (15.0 * m.g_star);
            close(m.energy_per_cycle(), factor * sum, 1e-12, "E_d");
            // ΔW = (18 (μP)²/(5aG*)) {1 − (1−q)^{5/3} − (5q/6)[1 + (1−q)^{2/3}]}, q = Q/μP.
            let full = m.mu * m.normal_force();
            let q = (m.first_loading_force(m.amplitude) / full).min(1.0);
            let braces =
                1.0 - (1.0 - q).powf(5.0 / 3.0) - 5.0 * q / 6.0 * (1.0 + (1.0 - q).powf(2.0 / 3.0));
            let johnson = 18.0 * full * full / (5.0 * a * m.g_star) * braces;
            close(m.energy_per_cycle(), johnson, 1e-11, "Johnson (7.57)");
        }
    }

    #[test]
    fn stepped_springs_draw_the_same_loop() {
        let m = model(0.6);
        let (a, count, steps) = (m.contact_radius(), 400, 400);
        let h = a / f64::from(count);
        let springs = PartialSlip {
            e_star: m.e_star,
            g_star: m.g_star,
            mu: m.mu,
            depth: m.depth,
            contact_radius: a,
            amplitude: m.amplitude,
            mdr_profile: |x: f64| x * x / m.radius,
        };
        let limits: Vec<f64> = (0..count)
            .map(|i| springs.yield_displacement((f64::from(i) + 0.5) * h))
            .collect();
        let mut u = vec![0.0f64; limits.len()];
        let (mut before, mut work) = ((0.0, 0.0), 0.0);
        let full = m.mu * m.normal_force();
        for i in 1..=5 * steps {
            let t = f64::from(i) / f64::from(steps);
            let (at, branch) = match t {
                t if t <= 1.0 => (t, Branch::Loading),
                t if t <= 3.0 => (2.0 - t, Branch::Unloading),
                t => (t - 4.0, Branch::Reloading),
            };
            let at = at.clamp(-1.0, 1.0) * m.amplitude;
            for (u, y) in u.iter_mut().zip(&limits) {
                *u = (*u + at - before.0).clamp(-y, *y);
            }
            let force = 2.0 * m.g_star * h * u.iter().sum::<f64>();
            let rule = m.loop_force(branch, at);
            assert!(
                (force - rule).abs() < 1e-5 * full,
                "{t}: {force:e} {rule:e}"
            );
            if t > 1.0 {
                work += 0.5 * (force + before.1) * (at - before.0);
            }
            before = (at, force);
        }
        close(work, m.energy_per_cycle(), 1e-4, "area of the stepped loop");
    }

    #[test]
    fn shear_balances_its_force_on_every_branch() {
        for m in FRACTIONS.map(model) {
            let (a, u) = (m.contact_radius(), m.amplitude);
            for branch in [Branch::Loading, Branch::Unloading, Branch::Reloading] {
                for at in [-u, -0.3 * u, 0.2 * u, u] {
                    // r = a sin t, broken at every stick edge.
                    let mut edges = vec![0.0, FRAC_PI_2];
                    for x in [u, at.abs(), 0.5 * (u - at), 0.5 * (u + at)] {
                        edges.push((m.stick_radius_at(x) / a).min(1.0).asin());
                    }
                    edges.sort_by(f64::total_cmp);
                    let ring = |t: f64| {
                        let r = a * t.sin();
                        2.0 * PI * r * m.loop_shear(branch, at, r) * a * t.cos()
                    };
                    let sum: f64 = edges.windows(2).map(|e| integrate(ring, e[0], e[1])).sum();
                    let error = (m.loop_force(branch, at) - sum).abs();
                    let scale = m.first_loading_force(u);
                    assert!(error < 1e-9 * scale, "{branch:?} {at:e}: {error:e}");
                }
            }
        }
    }
}
