//! The `# key: value` lines that open every CSV file, and numbers that read back exactly.

use std::fmt::Write;

use crate::scenario::printable;
use crate::scenario::session::Session;

/// The header lines for the present state of `session`.
pub fn lines(session: &Session) -> String {
    let scenario = session.scenario();
    let setup = session.simulation().setup();
    let law = setup.wear.map_or("none", |law| law.name());
    let mut text = String::new();
    let mut line = |key: &str, value: &str| {
        // A title cannot break out of its line, nor do anything to a terminal.
        let _ = writeln!(text, "# {key}: {}", printable(value));
    };
    line("mdr-tui", env!("CARGO_PKG_VERSION"));
    line("scenario", scenario.title());
    line("cycle", &number(session.simulation().cycle()));
    line("method", setup.method.name());
    line("law", law);
    line("points", &setup.grid.cells().to_string());
    line("steps_per_cycle", &setup.steps_per_cycle.to_string());
    line("grid", setup.spacing.name());
    line("scheme", setup.scheme.name());
    if let Some(note) = &session.loaded().run().note {
        line("note", note);
    }
    for change in session.changes() {
        line(
            &format!("at cycle {}", number(change.at_cycle)),
            &change.set,
        );
    }
    text
}

/// The shortest decimal form that reads back to the same bits.
pub fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if (1e-4..1e15).contains(&size) || !value.is_finite() {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// A number, or an empty field where there is none.
pub fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let values = [
            0.1 + 0.2,
            1e-300,
            -1.5e-7,
            199.24,
            5e-324,
            f64::MAX,
            1e22,
            2.0 / 3.0,
            0.0001,
        ];
        for value in values {
            let text = number(value);
            assert_eq!(
                text.parse::<f64>().map(f64::to_bits),
                Ok(value.to_bits()),
                "{text}"
            );
        }
        assert_eq!(number(-0.0), "0");
        assert_eq!(optional(None), "");
    }
}
