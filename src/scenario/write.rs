//! Writes a scenario as TOML: exact numbers, keys in the order of the schema.

use std::fmt::Write;

use super::key::{Key, Kind};
use super::spec::Spec;
use super::value::Value;

/// Writes keys in the order of the schema under their section headings; `line` gives each key's line, if any.
pub(crate) fn sections(line: impl Fn(Key) -> Option<String>) -> String {
    let (mut text, mut open) = (String::new(), "");
    for known in Key::all() {
        let Some(line) = line(known) else { continue };
        if known.section() != open {
            open = known.section();
            text += &format!("\n[{open}]\n");
        }
        text += &(line + "\n");
    }
    text
}

/// Writes a whole scenario. What `follows` from it becomes a comment if it is not given; the comment ends with its
/// `source`.
pub(super) fn scenario(spec: &Spec, follows: &Spec, source: &str) -> String {
    let mut text = sections(|known| {
        let Some(value) = spec.get(known) else {
            let value = follows.get(known)?.literal();
            return Some(format!("# {} = {value}  # {source}", known.key()));
        };
        let comment = match (known.kind, known.unit) {
            (Kind::Number | Kind::Numbers, unit) if !unit.is_empty() => format!("  # {unit}"),
            _ => String::new(),
        };
        let is_empty = matches!(&value, Value::Numbers(list) if list.is_empty());
        (!is_empty).then(|| format!("{} = {}{comment}", known.key(), value.literal()))
    });
    for change in &spec.changes {
        let at_cycle = Value::Number(change.at_cycle).literal();
        let set = Value::Text(change.to_string()).literal();
        let _ = write!(text, "\n[[changes]]\nat_cycle = {at_cycle}\nset = {set}\n");
    }
    text.trim_start().to_owned()
}
