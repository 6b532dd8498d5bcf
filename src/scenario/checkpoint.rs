//! A checkpoint: a session saved in one file, and restored to the same bits.
//!
//! ```text
//! mdr-tui checkpoint 2
//! 20517 bytes, CRC-32 9ae0daaf
//! written by mdr-tui 0.1.0 at cycle 42.5
//! <CBOR>
//! ```
//!
//! Three lines that a person can read, then the scenario as it was loaded, its changes and the
//! saved run in CBOR (RFC 8949), which keeps every f64 to its bits, infinities and −0 included.
//! Fields are stored by name, so that added fields can be recognised. Length and checksum of the
//! contents reveal a damaged file.

use std::borrow::Cow;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::session::{Parts, Session};
use super::{Change, Scenario, printable};
use crate::simulation::Saved;

/// The version of the format that is written, and the only one that is read.
pub const VERSION: u32 = 2;

/// What the first line begins with.
const MAGIC: &str = "mdr-tui checkpoint ";

/// The longest line before the contents, in bytes.
const LONGEST_LINE: u64 = 200;

/// The largest contents that are read, in bytes: the history of ten million cycles.
const LARGEST: u64 = 4 << 30;

/// A checkpoint that cannot be restored. Each error displays as one line.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum CheckpointError {
    /// A file that cannot be read.
    #[error("{path}: {reason}")]
    Unreadable {
        /// The path as given.
        path: String,
        /// Why.
        reason: String,
    },
    /// A file of another kind.
    #[error("{path}: is not a checkpoint of mdr-tui")]
    Foreign {
        /// The path as given.
        path: String,
    },
    /// A checkpoint in another format.
    #[error("{path}: is a checkpoint of version {found}; this mdr-tui reads version {VERSION}")]
    Version {
        /// The path as given.
        path: String,
        /// Its version.
        found: String,
    },
    /// A file that is not whole.
    #[error("{path}: is damaged: {reason}; try an older checkpoint")]
    Torn {
        /// The path as given.
        path: String,
        /// What does not add up.
        reason: String,
    },
    /// Contents that are not a valid run.
    #[error("{path}: this mdr-tui ({}) cannot read its run: {reason}", env!("CARGO_PKG_VERSION"))]
    Contents {
        /// The path as given.
        path: String,
        /// What is wrong.
        reason: String,
    },
}

/// A saved session, and the data of the program that drove it.
#[derive(Debug)]
pub struct Checkpoint<E> {
    /// The session, ready to go on.
    pub session: Session,
    /// The driver's own data, if it saved any.
    pub job: Option<E>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Body<'a, E> {
    origin: Cow<'a, str>,
    scenario: String,
    changes: Cow<'a, [Change]>,
    pending: Vec<Change>,
    #[serde(default)]
    goals: Vec<f64>,
    saved: Saved,
    /// The run before the changes of the present cycle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    unchanged: Option<Saved>,
    job: Option<E>,
}

/// Encodes a checkpoint of `session`, with the `job` of its driver.
pub fn encode<E: Serialize>(session: &Session, job: Option<&E>) -> Vec<u8> {
    let parts = session.parts();
    let cycle = parts.saved.cycle();
    let body = Body {
        origin: parts.loaded.origin().into(),
        scenario: parts.loaded.to_toml(),
        changes: parts.changes,
        pending: parts.pending,
        goals: parts.goals,
        saved: parts.saved,
        unchanged: parts.unchanged,
        job,
    };
    let version = env!("CARGO_PKG_VERSION");
    let mut contents = format!("written by mdr-tui {version} at cycle {cycle}\n").into_bytes();
    ciborium::into_writer(&body, &mut contents).expect("CBOR holds any value, and memory takes it");
    sealed(&contents)
}

/// `contents` behind the lines that tell whether they are whole.
pub fn sealed(contents: &[u8]) -> Vec<u8> {
    let seal = seal(contents.len() as u64, crc32fast::hash(contents));
    [
        MAGIC.as_bytes(),
        format!("{VERSION}\n{seal}").as_bytes(),
        contents,
    ]
    .concat()
}

/// The second line.
fn seal(length: u64, checksum: u32) -> String {
    format!("{length} bytes, CRC-32 {checksum:08x}\n")
}

/// Reads the checkpoint in the file at `path`.
pub fn read<E: DeserializeOwned>(path: &Path) -> Result<Checkpoint<E>, CheckpointError> {
    let name = printable(&path.display().to_string());
    let failed = |error: std::io::Error| CheckpointError::Unreadable {
        path: name.clone(),
        reason: match error.kind() {
            std::io::ErrorKind::NotFound => "no such file".into(),
            std::io::ErrorKind::IsADirectory => "is a directory; a checkpoint is a file".into(),
            _ => format!("cannot be read: {error}"),
        },
    };
    let file = File::open(path).map_err(failed)?;
    let contents = contents(BufReader::new(file), &name, failed)?;
    decode(&contents, &name)
}

/// Reads a checkpoint from bytes that messages call `name`.
pub fn from_bytes<E: DeserializeOwned>(
    bytes: &[u8],
    name: &str,
) -> Result<Checkpoint<E>, CheckpointError> {
    let failed = |error: std::io::Error| CheckpointError::Unreadable {
        path: name.to_owned(),
        reason: error.to_string(),
    };
    decode(&contents(bytes, name, failed)?, name)
}

/// The contents behind the two lines, checked for being whole.
fn contents(
    mut from: impl BufRead,
    name: &str,
    failed: impl Fn(std::io::Error) -> CheckpointError,
) -> Result<Vec<u8>, CheckpointError> {
    let path = || name.to_owned();
    let mut line = || -> Result<String, CheckpointError> {
        let mut line = Vec::new();
        let mut start = from.by_ref().take(LONGEST_LINE);
        start.read_until(b'\n', &mut line).map_err(&failed)?;
        Ok(String::from_utf8_lossy(&line).into_owned())
    };
    let torn = |reason: String| CheckpointError::Torn {
        path: path(),
        reason,
    };
    let first = line()?;
    let Some(version) = first.strip_prefix(MAGIC) else {
        return Err(CheckpointError::Foreign { path: path() });
    };
    if version != format!("{VERSION}\n") {
        return Err(match version.strip_suffix('\n') {
            Some(version) => CheckpointError::Version {
                path: path(),
                found: super::echo(version),
            },
            None => torn("it ends within its first line".into()),
        });
    }
    let second = line()?;
    let promised = promise(&second).ok_or_else(|| torn("its second line is incomplete".into()))?;
    let (length, checksum) = promised;
    if length > LARGEST {
        return Err(CheckpointError::Contents {
            path: path(),
            reason: format!("it is larger than {} GiB", LARGEST >> 30),
        });
    }
    let mut contents = Vec::new();
    // One byte more shows that there is more.
    from.take(length + 1)
        .read_to_end(&mut contents)
        .map_err(&failed)?;
    if contents.len() as u64 != length {
        let found = contents.len() as u64;
        return Err(torn(match found > length {
            true => format!("it continues after its {length} bytes"),
            false => format!("it has {found} of {length} bytes"),
        }));
    }
    if crc32fast::hash(&contents) != checksum {
        return Err(torn("its checksum does not match".into()));
    }
    Ok(contents)
}

/// Length and checksum of the second line.
fn promise(line: &str) -> Option<(u64, u32)> {
    let (length, checksum) = line.strip_suffix('\n')?.split_once(" bytes, CRC-32 ")?;
    let (length, checksum) = (
        length.parse().ok()?,
        u32::from_str_radix(checksum, 16).ok()?,
    );
    (line == seal(length, checksum)).then_some((length, checksum))
}

/// From contents that are whole to a session.
fn decode<E: DeserializeOwned>(
    contents: &[u8],
    name: &str,
) -> Result<Checkpoint<E>, CheckpointError> {
    let refuse = |reason: String| CheckpointError::Contents {
        path: name.to_owned(),
        reason: printable(reason.trim()),
    };
    // The line on who wrote it is for people.
    let start = contents.iter().position(|&byte| byte == b'\n');
    let start = start.map_or(contents.len(), |end| end + 1);
    let body: Body<E> = ciborium::from_reader(&contents[start..]).map_err(|error| {
        refuse(match error {
            ciborium::de::Error::Semantic(_, message) => message,
            other => other.to_string(),
        })
    })?;
    let loaded = Scenario::from_toml(&body.scenario, &body.origin, &[])
        .map_err(|error| refuse(format!("its scenario {error}")))?;
    let parts = Parts {
        loaded: Cow::Owned(loaded),
        changes: body.changes,
        pending: body.pending,
        goals: body.goals,
        saved: body.saved,
        unchanged: body.unchanged,
    };
    let session = Session::restore(parts).map_err(|error| refuse(error.to_string()))?;
    Ok(Checkpoint {
        session,
        job: body.job,
    })
}
