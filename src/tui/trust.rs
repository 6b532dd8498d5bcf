//! One figure for how far to trust what is on the screen: the worst of the run's own certificates.

use super::frame::Frame;

/// Above this error the figure says where it comes from.
const WORRYING: f64 = 0.02;

/// One certificate: two ways to the same number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// In a word.
    pub name: &'static str,
    /// What is compared.
    pub meaning: &'static str,
    /// The relative difference, signed.
    pub error: f64,
}

/// The certificates that the present moment has.
pub fn certificates(frame: &Frame) -> Vec<Certificate> {
    let moment = &frame.observation.moment;
    let mut list = Vec::new();
    let mut add = |name, meaning, error: Option<f64>| {
        list.extend(error.map(|error| Certificate {
            name,
            meaning,
            error,
        }));
    };
    add(
        "energy",
        "V against k E_d over the last period",
        moment.period_residual,
    );
    add(
        "volume",
        "V of the profile against k E_d since the start",
        moment.energy_residual,
    );
    add(
        "force",
        "F_z of the springs against the integral of p",
        frame.force_residual,
    );
    let stick = frame
        .theory
        .stick_radius
        .zip(moment.permanent_stick_radius)
        .filter(|_| moment.cycle >= 2.0);
    add(
        "stick",
        "permanent stick radius against theory (Melan)",
        stick.map(|(theory, seen)| seen / theory - 1.0),
    );
    list
}

/// `99.8 %`, and the weakest certificate's name where that is low; none before there is any.
pub fn figure(frame: &Frame) -> Option<String> {
    let worst = certificates(frame)
        .into_iter()
        .max_by(|a, b| a.error.abs().total_cmp(&b.error.abs()))?;
    let error = worst.error.abs();
    if !error.is_finite() {
        return Some(format!("0% ({})", worst.name));
    }
    let percent = (100.0 * (1.0 - error)).clamp(0.0, 99.99);
    // As many nines as there are, and never one too many.
    let digits = if error < 1e-3 { 2 } else { 1 };
    let scale = 10f64.powi(digits);
    let text = format!("{:.*}%", digits as usize, (percent * scale).floor() / scale);
    Some(if error > WORRYING {
        format!("{text} ({})", worst.name)
    } else {
        text
    })
}
