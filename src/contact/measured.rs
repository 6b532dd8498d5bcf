//! A measured profile: turns the rows of a table into a shape of revolution and reports every
//! correction.
//!
//! A trace may begin at the axis or run through it (negative radii). In the second case its two sides are averaged,
//! which removes the tilt of the stage; the tilt and half of their difference are reported. Noise is removed only on
//! request: a local parabola is fitted around each point with Gaussian weights of standard deviation `smoothing` (W. S.
//! Cleveland, 1979, J. Am. Stat. Assoc. 74, 829–836), continuing the profile beyond the axis as an even function. A
//! paraboloid passes unchanged.

use std::sync::Arc;

use crate::math::invalid::{Invalid, check_table, non_negative};
use crate::math::monotone::Monotone;

/// Minimum number of points.
const FEWEST: usize = 4;

/// Maximum number of points: the image at each x sums over all points inside it.
pub const MOST_POINTS: usize = 20_000;

/// The 1D image counts as level if it falls by no more than this fraction of its largest value.
const LEVEL: f64 = 1e-6;

/// A profile f(r) from a table; cheap to clone.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredProfile {
    curve: Arc<Monotone>,
    treatment: Treatment,
}

/// Corrections made to the rows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Treatment {
    /// Height at the axis, which was subtracted, m.
    pub offset: f64,
    /// Tilt that averaging both sides removed, rad; `None` for a profile that begins at the axis.
    pub tilt: Option<f64>,
    /// Rms of half the difference of both sides, without the tilt, m.
    pub asymmetry: f64,
    /// Rms and largest change due to smoothing, m.
    pub smoothed: Option<(f64, f64)>,
}

impl MeasuredProfile {
    /// Makes a profile from radii (m, strictly increasing, from the axis or through it) and heights (m), smoothed over
    /// a length `smoothing` (m); 0 for no smoothing.
    ///
    /// # Errors
    /// If the rows do not form a profile, or if the contact would not be a disc: the 1D image must not fall.
    pub fn new(radii: &[f64], heights: &[f64], smoothing: f64) -> Result<Self, Invalid> {
        let smoothing = non_negative("smoothing", smoothing)?;
        let number = FEWEST..=MOST_POINTS;
        check_table(("radii", radii), ("heights", heights), number)?;
        let mut treatment = Treatment::default();
        let (radii, mut heights) = if radii[0] < 0.0 {
            fold(radii, heights, &mut treatment)?
        } else {
            from_axis(radii, heights)?
        };
        if smoothing > 0.0 {
            let smooth = smoothed(&radii, &heights, smoothing);
            let changes = smooth.iter().zip(&heights).map(|(a, b)| (a - b).abs());
            let (mut squares, mut largest) = (0.0, 0.0_f64);
            for change in changes {
                squares += change * change;
                largest = largest.max(change);
            }
            let rms = (squares / radii.len() as f64).sqrt();
            treatment.smoothed = Some((rms, largest));
            heights = smooth;
        }
        treatment.offset = heights[0];
        for height in &mut heights {
            *height -= treatment.offset;
        }
        let number = radii.len();
        let curve = Monotone::new(radii, heights)
            .ok_or_else(|| Invalid::new("radii", number, "must increase"))?;
        check_disc(&curve, |x| curve.image(x))?;
        Ok(Self {
            curve: Arc::new(curve),
            treatment,
        })
    }

    /// Returns f(r), m; beyond the table by its last slope.
    pub fn profile(&self, r: f64) -> f64 {
        self.curve.at(r)
    }

    /// Returns g(x), m: Eq. (1) of the interpolant in closed form.
    pub fn profile_1d(&self, x: f64) -> f64 {
        self.curve.image(x)
    }

    /// Returns g(x), m, in a line contact: Eq. (1L) of the interpolant in closed form.
    pub fn line_profile_1d(&self, x: f64) -> f64 {
        self.curve.line_image(x)
    }

    /// Checks that the contact of a cylinder with this section is one strip at every depth.
    ///
    /// # Errors
    /// If its 1D image falls somewhere.
    pub fn check_strip(&self) -> Result<(), Invalid> {
        check_disc(&self.curve, |x| self.curve.line_image(x))
    }

    /// Returns the outermost radius at which f reaches `height`, m.
    pub fn radius_at(&self, height: f64) -> f64 {
        self.curve.last_at(height)
    }

    /// Returns the radius at which the table ends, m.
    pub fn last_radius(&self) -> f64 {
        self.curve.nodes().last().copied().unwrap_or_default()
    }

    /// Returns the number of points within `radius`, m.
    pub fn points_within(&self, radius: f64) -> usize {
        self.curve.nodes().partition_point(|&r| r <= radius)
    }

    /// Describes the table in one line: the number of points, and what was done to them.
    pub fn summary(&self) -> String {
        let Treatment {
            offset,
            tilt,
            asymmetry,
            smoothed,
        } = self.treatment;
        let mut words = vec![format!("{} points", self.curve.nodes().len())];
        if offset != 0.0 {
            words.push(format!("height {offset:.3e} m at the axis subtracted"));
        }
        if let Some(tilt) = tilt {
            words.push(format!(
                "tilt {tilt:.3e} rad removed by averaging both sides"
            ));
            words.push(format!("they differ by {:.2e} m rms", 2.0 * asymmetry));
        }
        if let Some((rms, largest)) = smoothed {
            words.push(format!(
                "smoothing changed it by {rms:.2e} m rms, {largest:.2e} m at most"
            ));
        }
        words.join(", ")
    }
}

/// Completes a profile that begins near the axis: if its first radius is not 0, the parabola through the first points
/// gives the value at r = 0.
fn from_axis(radii: &[f64], heights: &[f64]) -> Result<(Vec<f64>, Vec<f64>), Invalid> {
    let (mut radii, mut heights) = (radii.to_vec(), heights.to_vec());
    let (first, second) = (radii[0], radii[1]);
    if first > 2.0 * (second - first) {
        let rule = "must begin at the axis, r = 0, or run through it from negative radii";
        return Err(Invalid::new("radii", format!("{first:e}"), rule));
    }
    if first > 0.0 {
        // Even in r: f = f(0) + b r².
        let slope = (heights[1] - heights[0]) / (second * second - first * first);
        heights.insert(0, heights[0] - slope * first * first);
        radii.insert(0, 0.0);
    }
    Ok((radii, heights))
}

/// Averages both sides of a trace through the axis at the union of their radii.
fn fold(
    radii: &[f64],
    heights: &[f64],
    treatment: &mut Treatment,
) -> Result<(Vec<f64>, Vec<f64>), Invalid> {
    let last = radii[radii.len() - 1];
    let reach = last.min(-radii[0]);
    let within = radii.iter().filter(|r| r.abs() <= reach).count();
    if last <= 0.0 || within < FEWEST {
        let rule = "a trace with negative radii must run through the axis to the other side";
        return Err(Invalid::new("radii", format!("{last:e}"), rule));
    }
    let at = |x: f64| {
        let k = radii.partition_point(|&r| r <= x).clamp(1, radii.len() - 1);
        let share = (x - radii[k - 1]) / (radii[k] - radii[k - 1]);
        heights[k - 1] + share * (heights[k] - heights[k - 1])
    };
    let mut folded: Vec<f64> = radii
        .iter()
        .map(|r| r.abs())
        .filter(|r| *r <= reach)
        .collect();
    folded.push(0.0);
    folded.sort_by(f64::total_cmp);
    // Merge radii of both sides that nearly coincide.
    let closest = 1e-6 * reach;
    folded.dedup_by(|next, before| *next - *before <= closest);
    let odd: Vec<f64> = folded.iter().map(|&r| 0.5 * (at(r) - at(-r))).collect();
    let (moment, square) = folded
        .iter()
        .zip(&odd)
        .fold((0.0, 0.0), |(m, s), (r, f)| (m + r * f, s + r * r));
    let tilt = moment / square;
    let rest: f64 = folded
        .iter()
        .zip(&odd)
        .map(|(r, f)| (f - tilt * r).powi(2))
        .sum();
    treatment.tilt = Some(tilt.atan());
    treatment.asymmetry = (rest / folded.len() as f64).sqrt();
    let even = folded.iter().map(|&r| 0.5 * (at(r) + at(-r))).collect();
    Ok((folded, even))
}

/// Fits local parabolas with Gaussian weights to the profile, continued evenly beyond the axis.
fn smoothed(radii: &[f64], heights: &[f64], length: f64) -> Vec<f64> {
    let reach = 4.0 * length;
    let fitted = |k: usize| {
        let centre = radii[k];
        let mut moments = [0.0; 5];
        let mut products = [0.0; 3];
        let mut add = |r: f64, f: f64| {
            let t = (r - centre) / length;
            let weight = (-0.5 * t * t).exp();
            let mut power = weight;
            for (i, moment) in moments.iter_mut().enumerate() {
                *moment += power;
                if i < 3 {
                    products[i] += power * f;
                }
                power *= t;
            }
        };
        let from = radii.partition_point(|&r| r < centre - reach);
        let to = radii.partition_point(|&r| r <= centre + reach);
        for j in from..to {
            add(radii[j], heights[j]);
        }
        let mirrored = radii.partition_point(|&r| r <= reach - centre);
        for j in 1..mirrored {
            add(-radii[j], heights[j]);
        }
        let [m0, m1, m2, m3, m4] = moments;
        let [p0, p1, p2] = products;
        let determinant =
            m0 * (m2 * m4 - m3 * m3) - m1 * (m1 * m4 - m2 * m3) + m2 * (m1 * m3 - m2 * m2);
        let numerator =
            p0 * (m2 * m4 - m3 * m3) - m1 * (p1 * m4 - p2 * m3) + m2 * (p1 * m3 - p2 * m2);
        // With too few neighbours for a parabola, keep the point unchanged.
        if determinant > 1e-9 * m0 * m0 * m0 {
            numerator / determinant
        } else {
            heights[k]
        }
    };
    (0..radii.len()).map(fitted).collect()
}

/// Checks that g rises, so that contact is a disc at every depth: a spring that touches before one further in would
/// make a ring.
fn check_disc(curve: &Monotone, image: impl Fn(f64) -> f64) -> Result<(), Invalid> {
    let (nodes, values) = (curve.nodes(), curve.values());
    let last = nodes.len() - 1;
    let highest = values.iter().copied().fold(0.0, f64::max);
    if highest <= 0.0 {
        let rule = "must rise from the tip outwards: f is the gap, 0 at the tip";
        return Err(Invalid::new("heights", format!("{:e}", values[last]), rule));
    }
    let mut reached = 0.0;
    for pair in nodes.windows(2) {
        for x in [0.5 * (pair[0] + pair[1]), pair[1]] {
            let g = image(x);
            if g < reached - LEVEL * highest {
                let rule = format!(
                    "the 1D profile g falls by {:.1e} m at x = {x:.3e} m, so the contact would be \
                     a ring, not a disc; smooth the table (indenter.smoothing) or correct it",
                    reached - g
                );
                return Err(Invalid::new("heights", format!("{:e}", curve.at(x)), rule));
            }
            reached = g.max(reached);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn radii(from: f64) -> Vec<f64> {
        (0..=200)
            .map(|i| from + (1e-3 - from) * f64::from(i) / 200.0)
            .collect()
    }

    fn sphere(r: f64) -> f64 {
        r * r / 0.02
    }

    #[test]
    fn a_tilted_trace_through_the_axis_is_levelled_and_says_so() {
        let radii = radii(-1.2e-3);
        let heights: Vec<f64> = radii.iter().map(|&r| sphere(r) + 3e-3 * r + 7e-6).collect();
        let measured = MeasuredProfile::new(&radii, &heights, 0.0).expect("a profile");
        let treatment = measured.treatment;
        assert!((treatment.tilt.expect("a tilt") - 3e-3).abs() < 1e-6);
        assert!((treatment.offset - 7e-6).abs() < 1e-9 && treatment.asymmetry < 1e-9);
        assert_eq!(treatment.smoothed, None);
        for r in [1e-4, 5e-4, 9e-4] {
            // Linear interpolation of each side: an error of h²/16R.
            assert!((measured.profile(r) / sphere(r) - 1.0).abs() < 4e-3);
        }
        assert!((measured.last_radius() - 1e-3).abs() < 1e-12);
    }

    #[test]
    fn smoothing_removes_noise_keeps_a_paraboloid_and_tells_the_change() {
        let radii = radii(0.0);
        let exact: Vec<f64> = radii.iter().map(|&r| sphere(r)).collect();
        let kept = MeasuredProfile::new(&radii, &exact, 3e-5).expect("a profile");
        let (rms, largest) = kept.treatment.smoothed.expect("smoothed");
        assert!(rms <= largest && largest < 1e-12 * exact[200], "{largest}");
        // Noise of 1e-7 m with alternating signs creates rings of contact.
        let noisy: Vec<f64> = exact
            .iter()
            .enumerate()
            .map(|(i, f)| f + if i % 2 == 0 { 1e-7 } else { -1e-7 })
            .collect();
        let refused = MeasuredProfile::new(&radii, &noisy, 0.0).expect_err("rings");
        assert!(refused.rule.contains("would be a ring"), "{}", refused.rule);
        let smooth = MeasuredProfile::new(&radii, &noisy, 3e-5).expect("a profile");
        let (rms, _) = smooth.treatment.smoothed.expect("smoothed");
        assert!((rms / 1e-7 - 1.0).abs() < 0.1, "{rms}");
        assert!((smooth.profile(5e-4) - sphere(5e-4)).abs() < 3e-8);
    }

    #[test]
    fn rows_that_are_no_profile_are_refused_with_the_reason() {
        let field = |radii: &[f64], heights: &[f64]| {
            MeasuredProfile::new(radii, heights, 0.0).map_err(|refused| refused.field)
        };
        let good = [0.0, 1.0, 4.0, 9.0];
        assert!(field(&[0.0, 1.0, 2.0, 3.0], &good).is_ok());
        assert_eq!(field(&[0.0, 1.0, 1.0, 3.0], &good), Err("radii"));
        assert_eq!(field(&[0.0, 1.0, f64::NAN, 3.0], &good), Err("radii"));
        assert_eq!(field(&[0.0, 1.0, 2.0, 3.0], &good[..3]), Err("heights"));
        assert_eq!(field(&[5.0, 6.0, 7.0, 8.0], &good), Err("radii"));
        assert_eq!(field(&[-9.0, -8.0, -7.0, -6.0], &good), Err("radii"));
        assert_eq!(field(&[0.0, 1.0, 2.0, 3.0], &[0.0; 4]), Err("heights"));
        // A scar upside down, and a crater.
        assert_eq!(
            field(&[0.0, 1.0, 2.0, 3.0], &[9.0, 4.0, 1.0, 0.0]),
            Err("heights")
        );
        assert_eq!(
            field(&[0.0, 1.0, 2.0, 3.0], &[0.0, 3.0, 0.5, 9.0]),
            Err("heights")
        );
        assert!(MeasuredProfile::new(&[0.0, 1.0, 2.0, 3.0], &good, -1.0).is_err());
    }

    #[test]
    fn a_first_radius_a_little_off_the_axis_is_led_to_it() {
        let radii: Vec<f64> = (0..100).map(|i| 5e-6 + 1e-5 * f64::from(i)).collect();
        let heights: Vec<f64> = radii.iter().map(|&r| sphere(r)).collect();
        let measured = MeasuredProfile::new(&radii, &heights, 0.0).expect("a profile");
        assert!((measured.profile_1d(5e-4) / (2.0 * sphere(5e-4)) - 1.0).abs() < 1e-9);
    }
}
