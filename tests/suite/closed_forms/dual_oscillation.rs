//! The permanent stick radius under normal and tangential oscillation, by Melan's theorem.
//!
//! Sources: Melan (1936); Barber, Davies & Hills (2011) for frictional shakedown; Popov (2014) and
//! Dimaki et al. (2014) for fretting; the motion is (14). The spring at x shakes down without slip if some constant
//! offset keeps it within ±μq_z at all times: max_t[κu_x − (d − g)] ≤ κu* ≤ min_t[κu_x + (d − g)]. Both bounds are
//! compatible up to the depth g₀(c) = ½{min_t[d + κu_x] + min_t[d − κu_x]}, d = d₀ + Δd sin(ω₁t + φ_z), u_x = Δu
//! sin(ω₂t + φ_x):
//! - equal frequencies, φ = φ_x − φ_z: d₀ − ½[√(Δd²+κ²Δu²+2κΔdΔu cos φ) + √(Δd²+κ²Δu²−2κΔdΔu cos φ)];
//! - incommensurate: d₀ − Δd − κΔu;
//! - any rational ratio: dense sampling of one common period, each dip refined by golden section.
//!
//! A constant offset of u_x shifts both minima in opposite directions and cancels. A value ≤ 0 means that no point
//! sticks permanently (this includes loss of contact).

use super::elementary::positive_part;
use std::f64::consts::TAU;

/// The ratio of the two frequencies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frequencies {
    /// ω₂ = ω₁, in closed form.
    Equal,
    /// ω₂/ω₁ = tangential/normal, both at least 1; costs about 100·(tangential + normal) sines.
    Rational {
        /// Multiple of the common base frequency in the tangential motion.
        tangential: u32,
        /// Multiple of the common base frequency in the normal motion.
        normal: u32,
    },
    /// ω₂/ω₁ irrational: every pair of phases occurs.
    Incommensurate,
}

/// The motion (14) on a half-space with friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualOscillation {
    /// E*, Pa.
    pub e_star: f64,
    /// G*, Pa.
    pub g_star: f64,
    /// μ ≥ 0, dimensionless.
    pub mu: f64,
    /// Mean depth d₀, m.
    pub depth: f64,
    /// Normal amplitude Δd, m.
    pub normal_amplitude: f64,
    /// φ_z, rad: phase of the normal motion.
    pub normal_phase: f64,
    /// Tangential amplitude Δu, m.
    pub tangential_amplitude: f64,
    /// φ_x, rad: phase of the tangential motion.
    pub tangential_phase: f64,
    /// Ratio of the frequencies.
    pub frequencies: Frequencies,
}

impl DualOscillation {
    /// κ = G*/(μE*), dimensionless; +∞ for μ = 0.
    pub fn kappa(&self) -> f64 {
        self.g_star / (self.mu * self.e_star)
    }

    /// κΔu, m: the tangential amplitude as a depth.
    fn reach(&self) -> f64 {
        if self.tangential_amplitude == 0.0 {
            0.0
        } else {
            self.kappa() * self.tangential_amplitude
        }
    }

    /// d₀ + |Δd|, m: the depth in the limiting profile.
    pub fn largest_depth(&self) -> f64 {
        self.depth + self.normal_amplitude.abs()
    }

    /// g₀(c), m: the depth of the permanent stick edge; ≤ 0 (down to −∞) if nothing sticks permanently. NaN for a
    /// rational ratio that contains a zero.
    pub fn stick_depth(&self) -> f64 {
        let (swing, reach) = (self.normal_amplitude, self.reach());
        if reach.is_infinite() {
            return f64::NEG_INFINITY;
        }
        match self.frequencies {
            Frequencies::Equal => {
                let (sine, cosine) = (self.tangential_phase - self.normal_phase).sin_cos();
                let dip = |sign: f64| (swing + sign * reach * cosine).hypot(reach * sine);
                self.depth - 0.5 * (dip(1.0) + dip(-1.0))
            }
            Frequencies::Incommensurate => self.depth - swing.abs() - reach.abs(),
            Frequencies::Rational { tangential, normal } => {
                if tangential == 0 || normal == 0 {
                    return f64::NAN;
                }
                let common = divisor(tangential, normal);
                let (p, q) = (tangential / common, normal / common);
                let (fast, slow) = (f64::from(p), f64::from(q));
                let dip = |sign: f64| {
                    let sum = |s: f64| {
                        swing * (slow * s + self.normal_phase).sin()
                            + sign * reach * (fast * s + self.tangential_phase).sin()
                    };
                    lowest(sum, 48 * (u64::from(p) + u64::from(q)))
                };
                self.depth + 0.5 * (dip(1.0) + dip(-1.0))
            }
        }
    }

    /// c = √(R g₀(c)), m, for a paraboloid with radius of curvature R in m; 0 without permanent
    /// stick. For another shape, invert its g at [`Self::stick_depth`].
    pub fn stick_radius(&self, radius: f64) -> f64 {
        (radius * positive_part(self.stick_depth())).sqrt()
    }
}

/// Greatest common divisor (Euclid).
fn divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { divisor(b, a % b) }
}

/// Returns the minimum of a function of period 2π.
fn lowest(f: impl Fn(f64) -> f64, samples: u64) -> f64 {
    let step = TAU / samples as f64;
    let mut least = f64::INFINITY;
    let (mut left, mut here) = (f(-step), f(0.0));
    for i in 0..samples {
        let at = i as f64 * step;
        let right = f(at + step);
        if here <= left && here <= right {
            least = least.min(here).min(golden(&f, at - step, at + step));
        }
        (left, here) = (here, right);
    }
    // No dip found: the function is not finite.
    if least.is_finite() { least } else { f64::NAN }
}

/// Returns the minimum on [low, high] of a function with one dip there, by golden section.
fn golden(f: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let section = 0.5 * (5f64.sqrt() - 1.0);
    let mut inner = [high - section * (high - low), low + section * (high - low)];
    let mut value = inner.map(f);
    for _ in 0..45 {
        if value[0] < value[1] {
            high = inner[1];
            inner = [high - section * (high - low), inner[0]];
            value = [f(inner[0]), value[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + section * (high - low)];
            value = [value[1], f(inner[1])];
        }
    }
    value[0].min(value[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

    /// The motion of Fig. 3 of the paper, with ν = 0.3: G*/E* = 1.4/1.7.
    fn fig3(frequencies: Frequencies) -> DualOscillation {
        DualOscillation {
            e_star: 1.0,
            g_star: 1.4 / 1.7,
            mu: 0.1,
            depth: 1.0,
            normal_amplitude: 0.1,
            normal_phase: 0.0,
            tangential_amplitude: 0.1,
            tangential_phase: FRAC_PI_4,
            frequencies,
        }
    }

    fn rational(tangential: u32, normal: u32) -> Frequencies {
        Frequencies::Rational { tangential, normal }
    }

    /// Returns the largest g whose spring does not slip in the last of `periods` common periods.
    fn stick_depth_by_stepping(m: &DualOscillation, ratio: (f64, f64), periods: u32) -> f64 {
        let steps = 6000 * periods;
        let slips = |g: f64| {
            let (mut u, mut before, mut slipped) = (0.0f64, 0.0, 0.0f64);
            for i in 0..=steps {
                let s = TAU * f64::from(i) / 6000.0;
                let depth = m.depth + m.normal_amplitude * (ratio.1 * s + m.normal_phase).sin();
                let at = m.tangential_amplitude * (ratio.0 * s + m.tangential_phase).sin();
                let limit = (depth - g).max(0.0) / m.kappa();
                let predicted = u + at - before;
                u = predicted.clamp(-limit, limit);
                before = at;
                if i + 6000 > steps {
                    slipped += (predicted - u).abs();
                }
            }
            slipped > 1e-10
        };
        let (mut low, mut high) = (-1.0, m.largest_depth());
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if slips(middle) {
                high = middle
            } else {
                low = middle
            }
        }
        low
    }

    fn near(value: f64, exact: f64, tolerance: f64, what: &str) {
        assert!(
            (value - exact).abs() <= tolerance,
            "{what}: {value} against {exact}"
        );
    }

    #[test]
    fn figure_3_sticks_inside_0_4164() {
        near(
            fig3(Frequencies::Equal).stick_radius(1.0),
            0.4164,
            5e-5,
            "c/a₀",
        );
    }

    #[test]
    fn stepped_springs_find_the_same_edge() {
        for phase in [0.0, 0.3, FRAC_PI_4, FRAC_PI_2, 2.5] {
            let mut m = fig3(Frequencies::Equal);
            (m.normal_phase, m.tangential_phase) = (0.4, 0.4 + phase);
            let stepped = stick_depth_by_stepping(&m, (1.0, 1.0), 12);
            near(m.stick_depth(), stepped, 2e-6, "equal");
        }
        for (p, q) in [(2u32, 1u32), (1, 2), (3, 2), (5, 3)] {
            let mut m = fig3(rational(p, q));
            (m.normal_phase, m.mu) = (0.7, 0.2);
            let stepped = stick_depth_by_stepping(&m, (f64::from(p), f64::from(q)), 12);
            near(m.stick_depth(), stepped, 2e-5, "rational");
        }
    }

    #[test]
    fn equal_frequencies_are_the_ratio_one_to_one() {
        for phase in [0.0, 0.3, 1.0, FRAC_PI_2, 3.0, PI, 5.0] {
            for (p, q) in [(1, 1), (7, 7)] {
                let mut m = fig3(rational(p, q));
                (m.normal_phase, m.tangential_phase, m.mu) = (0.9, 0.9 + phase, 0.25);
                let closed = DualOscillation {
                    frequencies: Frequencies::Equal,
                    ..m
                };
                near(m.stick_depth(), closed.stick_depth(), 3e-16, "1:1");
            }
        }
    }

    #[test]
    fn high_ratios_approach_the_incommensurate_floor_from_above() {
        let floor = fig3(Frequencies::Incommensurate).stick_depth();
        near(floor, 1.0 - 0.1 - 0.1 * 14.0 / 1.7, 1e-15, "floor");
        for (p, q) in [(3u32, 2u32), (17, 12), (99, 70), (577, 408)] {
            let gap = fig3(rational(p, q)).stick_depth() - floor;
            // The phases miss their worst pair by at most π/q, which costs a cosine half the square of that.
            let most = 0.5 * (0.1 + 0.1 * 14.0 / 1.7) * (PI / f64::from(q)).powi(2);
            assert!(gap > -1e-15 && gap < most, "{p}:{q} {gap:e} {most:e}");
        }
    }

    #[test]
    fn sampling_finds_the_lowest_of_many_dips() {
        let f = |s: f64| (7.0 * s + 0.3).sin() + 0.9 * (11.0 * s + 1.0).sin();
        let brute = (0..2_000_000)
            .map(|i| f(TAU * f64::from(i) / 2e6))
            .fold(9.0, f64::min);
        let found = lowest(f, 48 * 18);
        assert!(found <= brute && brute - found < 1e-9, "{found} {brute}");
    }

    #[test]
    fn one_motion_alone_no_friction_and_lost_contact() {
        let all = [
            Frequencies::Equal,
            rational(2, 1),
            Frequencies::Incommensurate,
        ];
        for m in all.map(fig3) {
            let normal = DualOscillation {
                tangential_amplitude: 0.0,
                ..m
            };
            near(normal.stick_depth(), 0.9, 1e-15, "normal alone");
            let tangential = DualOscillation {
                normal_amplitude: 0.0,
                ..m
            };
            near(
                tangential.stick_depth(),
                1.0 - 1.4 / 1.7,
                1e-15,
                "tangential alone",
            );
            let smooth = DualOscillation { mu: 0.0, ..m };
            assert_eq!(smooth.stick_radius(1.0), 0.0);
            let still = DualOscillation {
                tangential_amplitude: 0.0,
                ..smooth
            };
            near(still.stick_depth(), 0.9, 1e-15, "no friction, no motion");
            let lost = DualOscillation {
                normal_amplitude: 1.2,
                ..m
            };
            assert_eq!((lost.stick_radius(1.0), lost.largest_depth()), (0.0, 2.2));
        }
        assert!(fig3(rational(0, 1)).stick_radius(1.0).is_nan());
        for m in all.map(fig3) {
            let unknown = DualOscillation {
                normal_amplitude: f64::NAN,
                ..m
            };
            assert!(unknown.stick_depth().is_nan());
        }
    }
}
