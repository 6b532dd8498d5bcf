//! The row of a point: its values and its status.

use std::fmt;

use crate::scenario::scalars::Value;

/// What a study records at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// The number of the point.
    pub point: usize,
    /// A number, a word or null for each column of the study.
    pub values: Vec<Value>,
    /// How the point ended.
    pub status: Status,
}

/// How a point ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Status {
    /// It has a result, to the requested accuracy if there is one.
    Ok,
    /// It has a result, less accurate than requested: `2e-2 instead of 1e-2`.
    Inaccurate(String),
    /// It has a result, which fails a check: the check and the size of its error.
    Unchecked(String),
    /// It failed, and why.
    Failed(String),
    /// It is not a valid scenario, and why.
    Invalid(String),
}

impl Status {
    /// Whether the point has a result.
    pub fn has_result(&self) -> bool {
        !matches!(self, Self::Failed(_) | Self::Invalid(_))
    }
}

/// Makes a status of the text that follows its beginning.
type Make = fn(String) -> Status;

/// How the texts of some statuses begin.
const BEGINNINGS: [(&str, Make); 3] = [
    ("accuracy ", Status::Inaccurate),
    ("check failed: ", Status::Unchecked),
    ("invalid: ", Status::Invalid),
];

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Ok => f.write_str("ok"),
            Self::Inaccurate(why) => write!(f, "accuracy {why}"),
            Self::Unchecked(why) => write!(f, "check failed: {why}"),
            Self::Failed(why) => f.write_str(why),
            Self::Invalid(why) => write!(f, "invalid: {why}"),
        }
    }
}

impl From<&str> for Status {
    fn from(text: &str) -> Self {
        let begun = |(start, status): &(&str, fn(String) -> Self)| {
            Some(status(text.strip_prefix(start)?.to_owned()))
        };
        match BEGINNINGS.iter().find_map(begun) {
            Some(status) => status,
            None if text == "ok" => Self::Ok,
            None => Self::Failed(text.to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_reads_back_from_its_text() {
        for (text, has_result) in [
            ("ok", true),
            ("accuracy 2.1e-2 instead of 1e-2", true),
            ("check failed: energy 2.1e-2", true),
            ("invalid: friction.coefficient = -1", false),
            ("bug in mdr-tui", false),
        ] {
            let status = Status::from(text);
            assert_eq!(status.to_string(), text);
            assert_eq!(status.has_result(), has_result, "{text}");
        }
    }
}
