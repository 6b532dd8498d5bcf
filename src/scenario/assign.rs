//! KEY = VALUE assignments, shared by `--set`, recorded changes and the edit form.

use toml::{Table, Value};

use super::check::unknown;
use super::error::{Origin, Refusal};
use super::escape::echo;
use super::hints;
use super::schema::{self, Kind, Parameter};
use super::values;

/// Splits `KEY=VALUE`, found at `place`.
pub(crate) fn split<'a>(text: &'a str, place: &str) -> Result<(&'a str, &'a str), Refusal> {
    let (key, value) = text.split_once('=').unwrap_or_default();
    let (key, value) = (key.trim(), value.trim());
    let rule = "must be KEY=VALUE, as in numerics.points=400";
    let whole = (!key.is_empty() && !value.is_empty()).then_some((key, value));
    whole.ok_or_else(|| Refusal::new(place, rule))
}

/// Puts `value` at the dotted path `key`; `written` is the assignment as the user wrote it.
pub(super) fn assign(
    table: &mut Table,
    origin: &mut Origin,
    key: &str,
    value: &str,
    written: &str,
) -> Result<(), Refusal> {
    let refuse = |rule: String| Refusal::new(written, rule);
    if key == "changes" || key.starts_with("changes.") {
        return Err(refuse("changes are recorded during a run, not set".into()));
    }
    let Some(parameter) = schema::find(key) else {
        return Err(if schema::is_section(key) {
            refuse(format!("{key} is a table; {}", hints::known_in(key)))
        } else {
            unknown(written, key, key)
        });
    };
    let value = parse(parameter, value);
    if parameter.path == "indenter.shape" {
        drop_keys_of_other_shapes(table, &value, origin);
    }
    put(table, origin, parameter.path, value, written);
    Ok(())
}

/// Puts `value` at a known `path`, and removes what it excludes.
pub(super) fn put(table: &mut Table, origin: &mut Origin, path: &str, value: Value, written: &str) {
    drop_replaced(table, path);
    origin.assign(path, written);
    values::insert(table, path, value);
}

/// Drops the keys that an assignment to `path` replaces or excludes.
fn drop_replaced(table: &mut Table, path: &str) {
    let twins = schema::SCHEMA.exclusive.iter().filter(|of| of.are_twins);
    for of in twins {
        for (keys, others) in [(&of.keys, &of.others), (&of.others, &of.keys)] {
            let replaced = others.iter().filter(|_| keys.contains(&path));
            replaced.for_each(|other| _ = values::remove(table, other));
        }
    }
    let stale = schema::SCHEMA.stale.iter();
    for of in stale.filter(|of| of.keys.contains(&path)) {
        values::remove(table, of.dropped);
    }
}

/// Parses the value as TOML, or takes the bare text.
fn parse(parameter: &Parameter, text: &str) -> Value {
    if parameter.kind == Kind::Number && values::is_large_whole(text) {
        return text
            .parse()
            .map_or_else(|_| Value::String(text.to_owned()), Value::Float);
    }
    let parsed = text.parse::<Value>();
    match (parameter.kind, parsed) {
        (Kind::Text | Kind::Choice(_), Ok(Value::String(text))) => Value::String(text),
        (Kind::Text | Kind::Choice(_), _) | (_, Err(_)) => Value::String(text.to_owned()),
        (_, Ok(value)) => value,
    }
}

/// Drops the keys of the previous shape, which would be refused or misread: the radius of a punch is not a radius of
/// curvature, and a punch brings its own edge of the domain. Keys of both shapes stay if they are assigned together
/// with the shape.
fn drop_keys_of_other_shapes(table: &mut Table, shape: &Value, origin: &Origin) {
    let known = schema::known("indenter.shape").kind;
    let Some(shape) = shape.as_str().filter(|_| known.fits(shape)) else {
        return;
    };
    let is_punch = |shape: &str| shape == "flat-punch";
    let before: Option<String> = schema::read(table, "indenter.shape");
    let was_punch = before.is_some_and(|before| is_punch(&before));
    let others = schema::parameters().filter(|key| !key.belongs_to(shape));
    for key in others {
        values::remove(table, key.path);
    }
    for (key, is_stale) in [
        ("indenter.radius", was_punch != is_punch(shape)),
        ("numerics.domain_radius", is_punch(shape)),
    ] {
        if is_stale && !origin.assigns(key) {
            values::remove(table, key);
        }
    }
}

/// Formats an assignment for an error message.
pub(super) fn written(key: &str, value: &str) -> String {
    format!("{} = {}", echo(key), echo(value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::check;
    use crate::scenario::error::Faults;

    fn assigned(key: &str, value: &str) -> Table {
        let (mut table, mut origin) = (Table::new(), Origin::new("t"));
        assign(&mut table, &mut origin, key, value, &written(key, value)).expect("a known key");
        let mut faults = Faults::default();
        check::keys(&mut table, &origin, &mut faults);
        assert_eq!(faults.into_error(), None);
        table
    }

    #[test]
    fn values_are_toml_and_bare_words_are_text() {
        for (key, value, expected) in [
            ("numerics.method", "b", "b"),
            ("numerics.method", "a+b", "a+b"),
            ("numerics.method", "\"a+b\"", "a+b"),
            ("title", "2024-01-01", "2024-01-01"),
            ("title", "12", "12"),
        ] {
            let table = assigned(key, value);
            let expected = Value::String(expected.into());
            let found = match key.split_once('.') {
                Some((first, rest)) => table[first].get(rest),
                None => table.get(key),
            };
            assert_eq!(found, Some(&expected), "{key}={value}");
        }
        assert_eq!(
            assigned("wear.coefficient", "1e-12")["wear"]["coefficient"],
            Value::Float(1e-12)
        );
        assert_eq!(
            assigned("run.snapshot_at", "[1, 2.5]")["run"]["snapshot_at"],
            Value::Array(vec![Value::Integer(1), Value::Float(2.5)])
        );
    }

    #[test]
    fn an_assignment_has_two_sides() {
        assert_eq!(split(" a.b = c=d ", ""), Ok(("a.b", "c=d")));
        for text in ["", "a", "=", "a=", "=b"] {
            assert!(split(text, "--set ").is_err(), "{text:?}");
        }
    }
}
