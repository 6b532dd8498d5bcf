//! Wear or crack? Computes fatigue parameters of the half-space over one steady-state cycle.
//!
//! A contact in gross slip wears; one in partial slip may crack first. The stresses below the surface give numbers to
//! compare with fatigue tests; this neither grows cracks nor predicts a life.
//!
//! # Formulas
//! Over the moments t of one steady-state cycle on the present profile, tension positive, with E and ν of the
//! half-space:
//!
//! - **Smith–Watson–Topper** on the critical plane: the largest σ_n,max ε_n,a over all planes, where
//!   σ_n,max is the largest normal stress on a plane (0 if it is never in tension) and ε_n,a half the range
//!   of the normal strain, E ε_n = (1 + ν)σ_n − ν tr σ. It is given as a stress amplitude
//!   √(E σ_n,max ε_n,a), Pa, which no longer depends on E and is the amplitude itself for fully reversed
//!   uniaxial stress: the limit to compare it with is the fully reversed fatigue limit σ₋₁. K. N. Smith,
//!   P. Watson, T. H. Topper (1970), J. Mater. 5, 767–778; on planes D. F. Socie (1987), J. Eng. Mater.
//!   Technol. 109, 293–298; in fretting M. P. Szolwinski, T. N. Farris (1996), Wear 198, 93–107.
//! - **Crossland**: √J₂,a + α σ_H,max, Pa, with √J₂,a the radius of the smallest ball that contains the path of
//!   the deviatoric stress S, measured by |S|² = ½ S:S, σ_H = tr σ/3 and α = 3τ₋₁/σ₋₁ − √3; the limit is
//!   τ₋₁, the fully reversed fatigue limit in torsion. Half the longest chord of the path is up to 18 % smaller
//!   (15 % in a plane). B. Crossland (1956), Proc. Int. Conf. Fatigue of Metals, IMechE, 138–149; the ball
//!   K. Dang Van, B. Griveau, O. Message (1989), in Biaxial and Multiaxial Fatigue, EGF 3, 479–496; in
//!   fretting S. Fouvry, P. Kapsa, L. Vincent (1996), Wear 200, 186–205.
//!
//! The y axis is a principal direction in the plane of motion y = 0, so a plane is given by the angle of its normal in
//! the plane of motion and by the share of y in the normal.

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::Vector3;

use crate::reading::Curves;
use crate::reading::subsurface::{Peak, SpringLoad, Stress, peak};
use crate::simulation::Simulation;

/// Moments per period at which stresses are computed, besides those where the motion reverses. Between them a sine is
/// missed by at most 5e-4 of its amplitude.
const MOMENTS: usize = 100;

/// Planes of the first search for the critical one: angles, and shares of the y axis.
const ANGLES: usize = 24;
const SHARES: usize = 4;

/// Number of refinements around the best plane; they determine its angle to about 1e-4.
const REFINEMENTS: usize = 12;

/// Columns and rows of the first search for the largest value below the contact.
const GRID: [usize; 2] = [31, 9];

/// Fatigue parameters of one place over a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Fatigue {
    /// √(E σ_n,max ε_n,a) on the critical plane, Pa.
    pub swt: f64,
    /// √J₂,a, Pa.
    pub shear_amplitude: f64,
    /// σ_H,max, Pa.
    pub hydrostatic: f64,
}

impl Fatigue {
    /// Computes the parameters from the stresses of one place at
    /// the moments of a cycle, with ν; all zero without stresses.
    pub fn from_stresses(stresses: &[Stress], poisson: f64) -> Self {
        let hydrostatic = stresses.iter().map(|stress| -stress.pressure());
        Self {
            swt: swt(stresses, poisson),
            shear_amplitude: shear_amplitude(stresses),
            hydrostatic: hydrostatic.reduce(f64::max).unwrap_or(0.0),
        }
    }

    /// Returns Crossland's √J₂,a + α σ_H,max, Pa.
    pub fn crossland(&self, limits: Limits) -> f64 {
        self.shear_amplitude + limits.hydrostatic_share() * self.hydrostatic
    }
}

/// Fully reversed fatigue limits of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// σ₋₁, in tension or bending, Pa.
    pub tension: f64,
    /// τ₋₁, in torsion, Pa.
    pub shear: f64,
}

impl Limits {
    /// Returns Crossland's α = 3τ₋₁/σ₋₁ − √3.
    pub fn hydrostatic_share(self) -> f64 {
        3.0 * self.shear / self.tension - 3.0_f64.sqrt()
    }
}

/// Returns √(E σ_n,max ε_n,a) on the critical plane, Pa.
fn swt(stresses: &[Stress], poisson: f64) -> f64 {
    if stresses.iter().all(|stress| stress.max_principal() <= 0.0) {
        return 0.0;
    }
    let on_plane = |angle: f64, share: f64| {
        let (sin, cos) = (2.0 * angle).sin_cos();
        let (mut tension, mut low, mut high) = (0.0_f64, f64::INFINITY, f64::NEG_INFINITY);
        for s in stresses {
            let inside = 0.5 * (s.xx + s.zz + (s.xx - s.zz) * cos) + s.xz * sin;
            let normal = (1.0 - share) * inside + share * s.yy;
            let strain = (1.0 + poisson) * normal - poisson * (s.xx + s.yy + s.zz);
            tension = tension.max(normal);
            (low, high) = (low.min(strain), high.max(strain));
        }
        tension * 0.5 * (high - low)
    };
    let places = (0..ANGLES).flat_map(|i| (0..=SHARES).map(move |k| (i, k)));
    let mut best = (0.0, 0.0, 0.0);
    let look = |best: &mut (f64, f64, f64), angle: f64, share: f64| {
        let value = on_plane(angle, share.clamp(0.0, 1.0));
        if value > best.0 {
            *best = (value, angle, share.clamp(0.0, 1.0));
        }
    };
    for (i, k) in places {
        let angle = PI * i as f64 / ANGLES as f64;
        look(&mut best, angle, k as f64 / SHARES as f64);
    }
    let [mut turn, mut tilt] = [0.5 * PI / ANGLES as f64, 0.5 / SHARES as f64];
    for _ in 0..REFINEMENTS {
        let (_, angle, share) = best;
        for (d_angle, d_share) in [(turn, 0.0), (-turn, 0.0), (0.0, tilt), (0.0, -tilt)] {
            look(&mut best, angle + d_angle, share + d_share);
        }
        if (best.1, best.2) == (angle, share) {
            (turn, tilt) = (0.5 * turn, 0.5 * tilt);
        }
    }
    best.0.sqrt()
}

/// Returns √J₂,a, Pa: the radius of the smallest ball that contains the path of the deviatoric stress.
fn shear_amplitude(stresses: &[Stress]) -> f64 {
    // With σ_xy = σ_yz = 0 the deviators form a three-dimensional space. In these coordinates |S|² = ½ S:S.
    let deviator = |s: &Stress| {
        let across = (2.0 * s.yy - s.xx - s.zz) / 12.0_f64.sqrt();
        Vector3::new(0.5 * (s.xx - s.zz), across, s.xz)
    };
    let path: Vec<Vector3<f64>> = stresses.iter().map(deviator).collect();
    smallest_ball(&path).squared_radius.sqrt()
}

/// A ball in the space of the deviators.
#[derive(Debug, Clone, Copy, Default)]
struct Ball {
    centre: Vector3<f64>,
    squared_radius: f64,
}

impl Ball {
    /// Returns the smallest ball with all of `points` on its surface; `None` if the points are degenerate.
    fn through(points: &[Vector3<f64>]) -> Option<Self> {
        let (first, others) = points.split_first()?;
        let mut ball = Self {
            centre: *first,
            squared_radius: 0.0,
        };
        let mut axes: Vec<Vector3<f64>> = Vec::new();
        for point in others {
            // Moving along this axis keeps the centre at equal distances from the previous points.
            let way = point - first;
            let way = axes
                .iter()
                .fold(way, |way, axis| way - *axis * axis.dot(&way));
            let length = way.norm();
            if length <= 1e-9 * (point - first).norm() {
                return None;
            }
            let axis = way / length;
            let gap = (point - ball.centre).norm_squared() - ball.squared_radius;
            let move_by = 0.5 * gap / length;
            ball.centre += axis * move_by;
            ball.squared_radius += move_by * move_by;
            axes.push(axis);
        }
        Some(ball)
    }

    fn holds(&self, point: &Vector3<f64>) -> bool {
        (point - self.centre).norm_squared() <= (1.0 + 1e-10) * self.squared_radius
    }
}

/// Returns the smallest ball that contains `points`, exact to rounding. A ball through up to four of them grows to
/// include the farthest point outside, which then lies on its surface, until all are inside. E. Welzl (1991), Smallest
/// enclosing disks (balls and ellipsoids), LNCS 555, 359–370.
fn smallest_ball(points: &[Vector3<f64>]) -> Ball {
    let mut support: Vec<Vector3<f64>> = points.iter().take(1).copied().collect();
    let mut ball = Ball::through(&support).unwrap_or_default();
    loop {
        let away = |point: &Vector3<f64>| (point - ball.centre).norm_squared();
        let farthest = points.iter().max_by(|a, b| away(a).total_cmp(&away(b)));
        let Some(farthest) = farthest.filter(|point| !ball.holds(point)) else {
            return ball;
        };
        let larger = (0..1 << support.len()).filter_map(|chosen: u32| {
            let kept = (0..support.len()).filter(|k| chosen >> k & 1 == 1);
            let kept = kept.map(|k| support[k]);
            let through: Vec<Vector3<f64>> = [*farthest].into_iter().chain(kept).collect();
            let ball = Ball::through(&through)?;
            support
                .iter()
                .all(|point| ball.holds(point))
                .then_some((ball, through))
        });
        let radius = |(ball, _): &(Ball, Vec<_>)| ball.squared_radius;
        match larger.min_by(|a, b| radius(a).total_cmp(&radius(b))) {
            Some((larger, through)) if larger.squared_radius > ball.squared_radius => {
                (ball, support) = (larger, through);
            }
            // Anything still outside is rounding.
            _ => return ball,
        }
    }
}

/// The loads on the half-space at the moments of one steady-state cycle.
#[derive(Debug, Clone)]
pub struct StressCycle(Vec<Arc<SpringLoad>>);

impl StressCycle {
    /// Collects the loads of a cycle, in any order.
    pub fn new(loads: Vec<Arc<SpringLoad>>) -> Self {
        Self(loads)
    }

    /// Steps a copy of `simulation` through two periods of the motion without wear; the first one lets it settle.
    /// `None` if the two motions have no common period, or if the contact cannot be solved.
    pub fn simulate(simulation: &Simulation) -> Option<Self> {
        let period = f64::from(simulation.setup().drive.repeats_after()?);
        let poisson = simulation.setup().material.poisson();
        let mut probe = simulation.without_wear()?;
        let start = probe.cycle() + period;
        probe.advance_to(start).ok()?;
        let mut motion = Vec::new();
        let mut loads = Vec::new();
        for k in 1..=MOMENTS {
            let goal = start + period * k as f64 / MOMENTS as f64;
            while probe.cycle() < goal {
                probe.step_until(goal).ok()?;
                let seen = probe.observe(Curves::SPRINGS);
                motion.push([seen.moment.depth, seen.moment.shift]);
                loads.push(seen.spring_load(poisson));
            }
        }
        let count = motion.len();
        let turns = |at: usize| {
            let (before, after) = (motion[(at + count - 1) % count], motion[(at + 1) % count]);
            (0..2).any(|i| (motion[at][i] - before[i]) * (after[i] - motion[at][i]) < 0.0)
        };
        let stride = count.div_ceil(MOMENTS);
        let loads = loads.into_iter().enumerate();
        let loads = loads.filter(|(at, _)| at % stride == 0 || turns(*at));
        Some(Self(loads.map(|(_, load)| Arc::new(load)).collect()))
    }

    /// Returns the parameters at (r, z) and at (−r, z), m; z is the depth below the surface.
    pub fn mirrored(&self, r: f64, z: f64) -> [Fatigue; 2] {
        let loads = self.0.iter();
        let poisson = loads.clone().next().map_or(0.0, |load| load.poisson());
        let (right, left): (Vec<Stress>, Vec<Stress>) =
            loads.map(|load| load.mirrored(r, z).into()).unzip();
        [right, left].map(|stresses| Fatigue::from_stresses(&stresses, poisson))
    }

    /// Finds where in the plane of motion a parameter is largest, below the widest contact of the cycle.
    pub fn largest(&self, of: impl Fn(&Fatigue) -> f64) -> Peak {
        let radii = self.0.iter().map(|load| load.contact_radius());
        let radius = radii.fold(0.0, f64::max);
        peak(radius, GRID, |r, z| self.mirrored(r, z).map(|at| of(&at)))
    }
}
