//! Closed forms of a paraboloid with a = d = R = E* = 1, by `std` alone: they share no code with what they judge.
//!
//! H. Hertz (1882); C. Cattaneo (1938), R. D. Mindlin (1949); V. L. Popov (2014), Appl. Phys. Lett. 104, 191602. c is the
//! radius of the zone that sticks.

use std::f64::consts::FRAC_1_PI;

/// μ.
pub const FRICTION: f64 = 0.1;

/// ν.
pub const POISSON: f64 = 0.3;

/// μE*/G*: the displacement from which everything slips.
pub const GROSS_SLIP: f64 = FRICTION * (2.0 - POISSON) / (2.0 * (1.0 - POISSON));

/// √(a² − b²); 0 for b > a.
fn leg(a: f64, b: f64) -> f64 {
    ((a - b) * (a + b)).max(0.0).sqrt()
}

/// p(r) up to a contact radius `a`.
pub fn pressure(a: f64, r: f64) -> f64 {
    2.0 * FRAC_1_PI * leg(a, r)
}

/// τ(r) on first loading.
pub fn shear(c: f64, r: f64) -> f64 {
    FRICTION * (pressure(1.0, r) - pressure(c, r))
}

/// The slip of the surface on first loading, up to the contact's edge.
pub fn slip(c: f64, r: f64) -> f64 {
    let angle = leg(r, c).atan2(c);
    let slip = (r * r - 2.0 * c * c) * angle + c * leg(r, c);
    if r > c {
        GROSS_SLIP * FRAC_1_PI * slip
    } else {
        0.0
    }
}

/// f(r) when wear has ended: it leaves nothing under load outside c.
pub fn limit(c: f64, r: f64) -> f64 {
    let angle = leg(r, c).atan2(c);
    let worn = (2.0 - r * r) * angle - c * leg(r, c);
    0.5 * r * r
        + if r > c {
            FRAC_1_PI * worn.max(0.0)
        } else {
            0.0
        }
}
