//! Stresses inside a half-space: Hertz pressure at rest and sliding, and any traction on a disc.
//!
//! Sources: K. L. Johnson (1985), *Contact Mechanics*, ch. 3: (3.45) on the axis, (3.20) and (3.74) for
//! point forces (Boussinesq, Cerruti); G. M. Hamilton (1983) for the sliding sphere. Plane of motion
//! y = 0, z downwards, tension positive. Lengths in contact radii a, stresses in p₀.

use std::f64::consts::PI;

/// The largest von Mises stress under Hertz pressure for ν = 0.3, in p₀.
pub const LARGEST_VON_MISES: f64 = 0.6200;

/// The depth of the largest von Mises stress under Hertz pressure for ν = 0.3, in a.
pub const DEPTH_OF_LARGEST: f64 = 0.481;

/// σ_r = σ_θ and σ_z on the axis at depth z ≥ 0 under Hertz pressure.
pub fn hertz_on_axis(z: f64, poisson: f64) -> [f64; 2] {
    let near = 1.0 / (1.0 + z * z);
    let arc = if z > 0.0 { z * (1.0 / z).atan() } else { 0.0 };
    [-(1.0 + poisson) * (1.0 - arc) + 0.5 * near, -near]
}

/// σ_r = −σ_θ on the surface at r ≥ 1, outside a Hertz contact.
pub fn hertz_outside(r: f64, poisson: f64) -> f64 {
    (1.0 - 2.0 * poisson) / (3.0 * r * r)
}

/// σ_xx at the trailing edge x = −1 from the traction of a sliding Hertz contact alone, in μp₀.
pub fn sliding_at_trailing_edge(poisson: f64) -> f64 {
    PI * (4.0 + poisson) / 8.0
}

/// σ_xx on the surface at |x| ≤ 1 from the traction of a sliding Hertz contact alone, in μp₀.
pub fn sliding_inside(x: f64, poisson: f64) -> f64 {
    -PI * (4.0 + poisson) / 8.0 * x
}

/// Returns `[σ_xx, σ_yy, σ_zz, σ_xz]` at (x, z), z > 0, under the tractions p(r) and τ(r) on the disc r ≤ 1 by adding
/// up point forces; accurate unless z is small compared with 1/`rings`.
pub fn by_point_forces(
    [x, z]: [f64; 2],
    poisson: f64,
    pressure: impl Fn(f64) -> f64,
    shear: impl Fn(f64) -> f64,
    rings: usize,
) -> [f64; 4] {
    let mut sum = [0.0; 4];
    let arcs = 4 * rings;
    for i in 0..rings {
        // r = sin t makes the roots at the edge smooth.
        let t = (i as f64 + 0.5) / rings as f64 * PI / 2.0;
        let (r, width) = (t.sin(), t.cos() * PI / 2.0 / rings as f64);
        let (p, q) = (pressure(r), shear(r));
        for k in 0..arcs {
            let angle = (k as f64 + 0.5) / arcs as f64 * 2.0 * PI;
            let area = r * width * 2.0 * PI / arcs as f64;
            let from = [x - r * angle.cos(), -r * angle.sin(), z];
            let (down, along) = (boussinesq(from, poisson), cerruti(from, poisson));
            for (sum, (down, along)) in sum.iter_mut().zip(down.into_iter().zip(along)) {
                *sum += area * (p * down + q * along);
            }
        }
    }
    sum
}

/// Returns `[σ_xx, σ_yy, σ_zz, σ_xz]` of a unit force into the half-space, at the given offset from it.
fn boussinesq([x, y, z]: [f64; 3], poisson: f64) -> [f64; 4] {
    let flat = x * x + y * y;
    let rho = (flat + z * z).sqrt();
    let soft = 1.0 - 2.0 * poisson;
    let side = |u: f64, v: f64| {
        let bracket = (1.0 - z / rho) * (u * u - v * v) / flat + z * v * v / rho.powi(3);
        soft / flat * bracket - 3.0 * z * u * u / rho.powi(5)
    };
    let (zz, xz) = (z.powi(3), x * z * z);
    [
        side(x, y) / (2.0 * PI),
        side(y, x) / (2.0 * PI),
        -3.0 * zz / (2.0 * PI * rho.powi(5)),
        -3.0 * xz / (2.0 * PI * rho.powi(5)),
    ]
}

/// Returns `[σ_xx, σ_yy, σ_zz, σ_xz]` of a unit force along x on the surface, at the given offset from it.
fn cerruti([x, y, z]: [f64; 3], poisson: f64) -> [f64; 4] {
    let rho = (x * x + y * y + z * z).sqrt();
    let (cube, sum) = (rho.powi(3), rho + z);
    let soft = 1.0 - 2.0 * poisson;
    let far = 3.0 / rho.powi(5);
    let side = |u: f64, first: f64| {
        let bracket = x / cube - first * x / (rho * sum * sum)
            + x * u * u / (cube * sum * sum)
            + 2.0 * x * u * u / (rho * rho * sum.powi(3));
        -far * x * u * u + soft * bracket
    };
    [
        side(x, 3.0) / (2.0 * PI),
        side(y, 1.0) / (2.0 * PI),
        -far * x * z * z / (2.0 * PI),
        -far * x * x * z / (2.0 * PI),
    ]
}
