//! Stress inside the half-space under the loads of the springs, in the plane of motion y = 0.
//!
//! F. Forsbach (2020), *Stress tensor and gradient of hydrostatic pressure in the half-space beneath
//! axisymmetric bodies in normal and tangential contact*, Frontiers in Mechanical Engineering 6:39,
//! doi 10.3389/fmech.2020.00039: a step of the line load at x is a rigid punch of radius x, so every
//! stress is one sum over the springs.
//!
//! # Formula
//! The punch of radius x has the surface stress 1/(π√(x² − r²)). With ζ = z + ix, R = √(r² + ζ²)
//! (Re R ≥ 0), L = ln(ζ + R), A = 1/R and B = 1/(ζ + R), its potentials are imaginary parts of
//! products of A, B and ζ:
//!
//! - normal, H = ∬p/ρ dS: H_z = 2 Im A, H_zz = −2 Im ζA³, H_rz = −2r Im A³, H_r/r = 2 Im AB,
//!   χ_r/r = −2 Im B, and H_rr, χ_rr from Laplace's equation; 2πσ_zz = H_z − zH_zz,
//!   2πσ_xz = −zH_rz, 2πσ_xx = 2νH_z − zH_rr − (1 − 2ν)χ_rr,
//!   2πσ_yy = 2νH_z − zH_r/r − (1 − 2ν)χ_r/r;
//! - tangential, traction along x, F harmonic with F_zz = 2 Im L: F_xzz = 2r Im AB,
//!   F_xxx = r Im B² − 2r Im AB, F_xxxz = 2r Im(A³ − AB²), F_xyyz = 2r Im AB², F_xzzz = −2r Im A³,
//!   F_zzz = 2 Im A, F_xxzz = 2 Im(ζA³ − AB); 2πσ_xx = 2(1 + ν)F_xzz + 2νF_xxx − zF_xxxz,
//!   2πσ_yy = −2νF_xxx − zF_xyyz, 2πσ_zz = −zF_xzzz, 2πσ_xz = F_zzz − zF_xxzz.
//!
//! Deviation from the sum over springs of the paper: q is linear in x² between two springs, which is exact for a
//! paraboloid, and the punches of a cell are integrated in closed form. With x dx = −(ζ − z) dζ each product f gives
//! −2 Im(∫ζf dζ − z∫f dζ), and all primitives are in the same symbols: ∫A = L, ∫AB = −B, ∫B = ½(ζB + L), ∫ζA³ = −A,
//! ∫A³ = −AB, ∫B² = ⅓(ζB² − 2B), ∫AB² = −½B²; ∫ζA = R, ∫ζAB = ½(L − ζB), ∫ζB = ⅓(R + ζ²B), ∫ζ²A³ = L + r²AB,
//! ∫ζB² = ¼(ζ²B² + L − ζB), ∫ζAB² = −⅓(ζB² + B). So the stresses hold up to the surface, even on coarse grids.
//!
//! # A line contact
//!
//! In plane strain the strip punch of half-width s and unit load has G = 1/√(w² − s²), w = x + iz, and
//!
//! ```text
//! normal      πσ_xx = Im G + z Re G′     πσ_zz = Im G − z Re G′     πσ_xz = −z Im G′
//! tangential  πσ_xx = −2 Re G + z Im G′  πσ_zz = −z Im G′           πσ_xz = Im G + z Re G′
//! ```
//!
//! by superposition of Flamant's point loads, and σ_yy = ν(σ_xx + σ_zz). The strips of a cell add up to
//! ∫ 2s G ds = −2√(w² − s²) and its derivative by w.
//!
//! Cost: one complex root and one arc tangent per point and kink of the load. Springs at which q is linear in x² within
//! [`FLAT`] do not count as kinks: a Hertz contact has one kink, a worn contact a few dozen.

use std::f64::consts::PI;

use nalgebra::{Complex, ComplexField};

use crate::math::geometry::Geometry;

/// Points less deep than this, in contact radii, count as on the surface, where the formulas are limits.
const SURFACE: f64 = 1e-9;

/// Tolerance for dropping a spring between two kept kinks, relative to the largest load.
pub const FLAT: f64 = 1e-6;

/// The stresses at one point of the plane of motion, Pa, tension positive; σ_xy = σ_yz = 0 there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stress {
    /// σ_xx.
    pub xx: f64,
    /// σ_yy.
    pub yy: f64,
    /// σ_zz.
    pub zz: f64,
    /// σ_xz.
    pub xz: f64,
}

impl Stress {
    /// Returns the von Mises equivalent stress, Pa.
    pub fn von_mises(&self) -> f64 {
        let [a, b, c] = [self.xx - self.yy, self.yy - self.zz, self.zz - self.xx];
        (0.5 * (a * a + b * b + c * c) + 3.0 * self.xz * self.xz).sqrt()
    }

    /// Returns the largest and the smallest principal stress, Pa.
    fn principal(&self) -> [f64; 2] {
        let mean = 0.5 * (self.xx + self.zz);
        let radius = (0.5 * (self.xx - self.zz)).hypot(self.xz);
        [(mean + radius).max(self.yy), (mean - radius).min(self.yy)]
    }

    /// Returns the largest principal stress, Pa; positive is tension, where fretting cracks begin.
    pub fn max_principal(&self) -> f64 {
        self.principal()[0]
    }

    /// Returns the largest shear stress on any plane, Pa.
    pub fn max_shear(&self) -> f64 {
        let [high, low] = self.principal();
        0.5 * (high - low)
    }

    /// Returns the hydrostatic pressure −(σ_xx + σ_yy + σ_zz)/3, Pa.
    pub fn pressure(&self) -> f64 {
        -(self.xx + self.yy + self.zz) / 3.0
    }

    fn plus(self, other: Self, sign: f64) -> Self {
        Self {
            xx: self.xx + sign * other.xx,
            yy: self.yy + sign * other.yy,
            zz: self.zz + sign * other.zz,
            xz: self.xz + sign * other.xz,
        }
    }
}

/// The largest value of a stress and its place.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// The stress, Pa.
    pub value: f64,
    /// Its place along the motion, m.
    pub x: f64,
    /// Its depth, m.
    pub z: f64,
}

/// Columns and rows of the first search for a largest stress.
const GRID: [usize; 2] = [13, 13];

/// Number of refinements around the best place.
const REFINEMENTS: usize = 16;

/// Finds where `of`, which gives the values at (r, z) and at (−r, z), m, is largest: first on a grid of columns and
/// rows over 1.2 times `radius` (m), then ever closer to the best place.
pub fn peak(radius: f64, [columns, rows]: [usize; 2], of: impl Fn(f64, f64) -> [f64; 2]) -> Peak {
    let at = |x: f64, z: f64| {
        let [right, left] = of(x.abs(), z);
        let value = if x < 0.0 { left } else { right };
        Peak { value, x, z }
    };
    let higher = |a: Peak, b: Peak| if b.value > a.value { b } else { a };
    let spacing = |count: usize| 1.2 * radius / (count - 1) as f64;
    let mut best = at(0.0, 0.0);
    for k in 0..rows {
        for i in 0..columns {
            let (x, z) = (spacing(columns) * i as f64, spacing(rows) * k as f64);
            let [right, left] = of(x, z);
            best = higher(best, Peak { value: right, x, z });
            best = higher(
                best,
                Peak {
                    value: left,
                    x: -x,
                    z,
                },
            );
        }
    }
    let [mut across, mut down] = [columns, rows].map(|count| 0.5 * spacing(count));
    for _ in 0..REFINEMENTS {
        let (x, z) = (best.x, best.z);
        for (dx, dz) in [(across, 0.0), (-across, 0.0), (0.0, down), (0.0, -down)] {
            best = higher(best, at(x + dx, (z + dz).max(0.0)));
        }
        if (best.x, best.z) == (x, z) {
            (across, down) = (0.5 * across, 0.5 * down);
        }
    }
    best
}

/// What begins at x: the rise of the slopes of q_z and q_x over x² there (Pa/m).
#[derive(Debug, Clone, Copy, PartialEq)]
struct SlopeJump {
    x: f64,
    normal: f64,
    tangential: f64,
}

/// The line loads of one moment, as a source of stress in the half-space.
#[derive(Debug, Clone, PartialEq)]
pub struct SpringLoad {
    kinks: Vec<SlopeJump>,
    /// q_z and q_x at the contact's edge a, N/m: not zero under a flat punch.
    end: [f64; 2],
    radius: f64,
    poisson: f64,
    geometry: Geometry,
}

impl SpringLoad {
    /// Makes the load from q_z and q_x (N/m) at `nodes` (m, from 0 up, of one length), the contact radius a (m) and ν
    /// of the half-space. Springs outside the contact count as unloaded.
    pub fn new(
        nodes: &[f64],
        normal: &[f64],
        tangential: &[f64],
        contact_radius: f64,
        poisson: f64,
    ) -> Self {
        let loads = nodes.iter().zip(normal.iter().zip(tangential));
        let mut points: Vec<[f64; 3]> = loads
            .map(|(&x, (&qz, &qx))| [x, qz, qx])
            .take_while(|&[x, qz, _]| x <= contact_radius && qz > 0.0)
            .collect();
        let last = points.last().copied().unwrap_or_default();
        // Between two springs the load ends at zero; on a spring it ends with that spring's load.
        let end = if contact_radius > last[0] * (1.0 + 1e-9) {
            points.push([contact_radius, 0.0, 0.0]);
            [0.0, 0.0]
        } else {
            [last[1], last[2]]
        };
        Self {
            kinks: kinks(&thinned(&points)),
            end,
            radius: contact_radius,
            poisson,
            geometry: Geometry::Round,
        }
    }

    /// Returns the same load in a contact of this `geometry`.
    #[must_use]
    pub fn with_geometry(self, geometry: Geometry) -> Self {
        Self { geometry, ..self }
    }

    /// ν of the half-space.
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// The contact radius, m.
    pub fn contact_radius(&self) -> f64 {
        self.radius
    }

    /// Finds where in the plane of motion a stress is largest.
    pub fn largest(&self, of: impl Fn(&Stress) -> f64) -> Peak {
        peak(self.radius, GRID, |r, z| {
            self.mirrored(r, z).map(|stress| of(&stress))
        })
    }

    /// Returns the stresses at (x, z), m, in the plane of motion; z is the depth below the surface.
    pub fn stress(&self, x: f64, z: f64) -> Stress {
        let [right, left] = self.mirrored(x.abs(), z);
        if x < 0.0 { left } else { right }
    }

    /// Returns the stresses at (r, z) and at (−r, z): both share the sum over the springs.
    pub fn mirrored(&self, r: f64, z: f64) -> [Stress; 2] {
        if self.kinks.len() < 2 {
            return [Stress::default(); 2];
        }
        let z = z.max(SURFACE * self.radius);
        let [even, odd] = match self.geometry {
            Geometry::Round => self.of_punches(r, z),
            Geometry::Line { .. } => self.of_strips(r, z),
        };
        // Under p the shear stress is odd in x, under τ all others are.
        let right = even.plus(odd, 1.0);
        let left = Stress {
            xz: odd.xz - even.xz,
            ..even.plus(odd, -1.0)
        };
        [right, left]
    }

    /// Returns the stresses at (r, z) due to q_z and q_x on a half-plane.
    fn of_strips(&self, r: f64, z: f64) -> [Stress; 2] {
        let w = Complex::new(r, z);
        // The branch of √(w² − s²) that equals w far away: both factors lie in the upper half-plane.
        let root = |s: f64| (w - s).sqrt() * (w + s).sqrt();
        let mut strips = [[Complex::default(); 2]; 2];
        let mut add = |[value, slope]: [Complex<f64>; 2], weights: [f64; 2]| {
            for (sums, weight) in strips.iter_mut().zip(weights) {
                sums[0] += value * weight;
                sums[1] += slope * weight;
            }
        };
        for kink in &self.kinks {
            let root = root(kink.x);
            add(
                [root * -2.0, w / root * -2.0],
                [kink.normal, kink.tangential],
            );
        }
        if self.end[0] > 0.0 {
            let root = root(self.radius);
            add([root.inv(), -w / (root * root * root)], self.end);
        }
        let [[normal, normal_slope], [shear, shear_slope]] = strips;
        let stress = |xx: f64, zz: f64, xz: f64| Stress {
            xx: xx / PI,
            yy: self.poisson * (xx + zz) / PI,
            zz: zz / PI,
            xz: xz / PI,
        };
        let (even, odd) = (z * normal_slope, z * shear_slope);
        [
            stress(normal.im + even.re, normal.im - even.re, -even.im),
            stress(odd.im - 2.0 * shear.re, -odd.im, shear.im + odd.re),
        ]
    }

    /// Returns the stresses at (r, z) due to q_z and q_x on a half-space, in the plane of motion.
    fn of_punches(&self, r: f64, z: f64) -> [Stress; 2] {
        let (mut normal, mut tangential) = (Products::default(), Products::default());
        for kink in &self.kinks {
            let at = Products::of_paraboloid(r, z, kink.x);
            normal.add(&at, kink.normal);
            tangential.add(&at, kink.tangential);
        }
        if self.end[0] > 0.0 {
            let at = Products::of_punch(r, z, self.radius);
            normal.add(&at, self.end[0]);
            tangential.add(&at, self.end[1]);
        }
        let even = normal.pressed(r, z, self.poisson);
        let odd = tangential.pushed(r, z, self.poisson);
        [even, odd]
    }
}

/// Keeps the points between which all others lie on lines over x², within [`FLAT`]. The slopes from a kept point that
/// pass all later ones narrow until a point falls outside them; the one before it is kept next.
fn thinned(points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let largest = |i: usize| points.iter().fold(0.0, |most: f64, q| most.max(q[i].abs()));
    let slack = [1, 2].map(|i| FLAT * largest(i));
    let mut kept: Vec<[f64; 3]> = points.first().copied().into_iter().collect();
    let (mut anchor, mut reach) = (0, 0);
    let mut slopes = [[f64::NEG_INFINITY, f64::INFINITY]; 2];
    while reach + 1 < points.len() {
        let (from, to) = (points[anchor], points[reach + 1]);
        let width = (to[0] - from[0]) * (to[0] + from[0]);
        let slope = [1, 2].map(|i| (to[i] - from[i]) / width);
        let inside = (0..2).all(|i| (slopes[i][0]..=slopes[i][1]).contains(&slope[i]));
        if inside {
            for (bounds, (slope, slack)) in slopes.iter_mut().zip(slope.iter().zip(slack)) {
                bounds[0] = bounds[0].max(slope - slack / width);
                bounds[1] = bounds[1].min(slope + slack / width);
            }
            reach += 1;
        } else {
            kept.push(points[reach]);
            anchor = reach;
            slopes = [[f64::NEG_INFINITY, f64::INFINITY]; 2];
        }
    }
    if reach > 0 {
        kept.push(points[reach]);
    }
    kept
}

/// Finds where the slopes over x² of the line loads `[x, q_z, q_x]` change: the kinks that add up to the loads.
fn kinks(points: &[[f64; 3]]) -> Vec<SlopeJump> {
    let slope = |k: usize| {
        let (from, to) = (points[k], points[k + 1]);
        [1, 2].map(|i| (to[i] - from[i]) / ((to[0] - from[0]) * (to[0] + from[0])))
    };
    let last = points.len().saturating_sub(1);
    let mut before = [0.0, 0.0];
    let mut kinks = Vec::with_capacity(points.len());
    for (k, point) in points.iter().enumerate() {
        let after = if k < last { slope(k) } else { [0.0, 0.0] };
        kinks.push(SlopeJump {
            x: point[0],
            normal: after[0] - before[0],
            tangential: after[1] - before[1],
        });
        before = after;
    }
    kinks
}

/// Imaginary parts of the products in the stresses, or of their primitives in x.
#[derive(Debug, Clone, Copy, Default)]
struct Products {
    a: f64,
    b: f64,
    ab: f64,
    b2: f64,
    ab2: f64,
    a3: f64,
    za3: f64,
}

impl Products {
    /// Computes the products for a punch of radius `x`.
    fn of_punch(r: f64, z: f64, x: f64) -> Self {
        let (zeta, a, b) = letters(r, z, x);
        let (ab, a3) = (a * b, a * a * a);
        Self {
            a: a.im,
            b: b.im,
            ab: ab.im,
            b2: (b * b).im,
            ab2: (ab * b).im,
            a3: a3.im,
            za3: (zeta * a3).im,
        }
    }

    /// Integrates the products over punches of all radii up to `x`, each with load 2x: ∫ 2x Im f dx.
    #[inline]
    fn of_paraboloid(r: f64, z: f64, x: f64) -> Self {
        let (zeta, a, b) = letters(r, z, x);
        let root = b.conj() / b.norm_sqr() - zeta;
        // Im ln(ζ + R).
        let angle = -b.im.atan2(b.re);
        let (ab, zb, b2) = (a * b, zeta * b, b * b);
        let zb2 = zb * b;
        Self {
            a: -2.0 * root.im + 2.0 * z * angle,
            b: -2.0 / 3.0 * (root + zeta * zb).im + z * (zb.im + angle),
            ab: zb.im - angle - 2.0 * z * b.im,
            b2: -0.5 * ((zb * zb).im + angle - zb.im) + 2.0 / 3.0 * z * (zb2 - b * 2.0).im,
            ab2: 2.0 / 3.0 * (zb2 + b).im - z * b2.im,
            a3: 2.0 * (a.im - z * ab.im),
            za3: -2.0 * (angle + r * r * ab.im + z * a.im),
        }
    }

    #[inline]
    fn add(&mut self, other: &Self, weight: f64) {
        self.a += weight * other.a;
        self.b += weight * other.b;
        self.ab += weight * other.ab;
        self.b2 += weight * other.b2;
        self.ab2 += weight * other.ab2;
        self.a3 += weight * other.a3;
        self.za3 += weight * other.za3;
    }

    /// Returns the stresses at (r, z) under a normal load.
    fn pressed(&self, r: f64, z: f64, poisson: f64) -> Stress {
        let (h_z, h_zz, h_rz) = (2.0 * self.a, -2.0 * self.za3, -2.0 * r * self.a3);
        let (h_r, chi_r) = (2.0 * self.ab, -2.0 * self.b);
        let (h_rr, chi_rr) = (-h_zz - h_r, -h_z - chi_r);
        let soft = 1.0 - 2.0 * poisson;
        Stress {
            xx: (2.0 * poisson * h_z - z * h_rr - soft * chi_rr) / (2.0 * PI),
            yy: (2.0 * poisson * h_z - z * h_r - soft * chi_r) / (2.0 * PI),
            zz: (h_z - z * h_zz) / (2.0 * PI),
            xz: -z * h_rz / (2.0 * PI),
        }
    }

    /// Returns the stresses at (r, z) under a traction along x.
    fn pushed(&self, r: f64, z: f64, poisson: f64) -> Stress {
        let f_xzz = 2.0 * r * self.ab;
        let f_xxx = r * (self.b2 - 2.0 * self.ab);
        let f_xxxz = 2.0 * r * (self.a3 - self.ab2);
        let f_xyyz = 2.0 * r * self.ab2;
        let f_xzzz = -2.0 * r * self.a3;
        let (f_zzz, f_xxzz) = (2.0 * self.a, 2.0 * (self.za3 - self.ab));
        Stress {
            xx: (2.0 * (1.0 + poisson) * f_xzz + 2.0 * poisson * f_xxx - z * f_xxxz) / (2.0 * PI),
            yy: (-2.0 * poisson * f_xxx - z * f_xyyz) / (2.0 * PI),
            zz: -z * f_xzzz / (2.0 * PI),
            xz: (f_zzz - z * f_xxzz) / (2.0 * PI),
        }
    }
}

/// ζ, A = 1/R and B = 1/(ζ + R).
#[inline]
fn letters(r: f64, z: f64, x: f64) -> (Complex<f64>, Complex<f64>, Complex<f64>) {
    let zeta = Complex::new(z, x);
    let square = Complex::new(r * r + (z - x) * (z + x), 2.0 * z * x);
    let size = (square.re * square.re + square.im * square.im).sqrt();
    // The root in the first quadrant, without cancellation.
    let larger = (0.5 * (size + square.re.abs())).sqrt();
    let smaller = if larger > 0.0 {
        0.5 * square.im / larger
    } else {
        0.0
    };
    let root = if square.re >= 0.0 {
        Complex::new(larger, smaller)
    } else {
        Complex::new(smaller, larger)
    };
    let sum = zeta + root;
    (zeta, root.conj() / size, sum.conj() / sum.norm_sqr())
}
