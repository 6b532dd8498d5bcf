//! A checkpoint: a session saved in one file and restored bit for bit.
//!
//! ```text
//! mdr-tui checkpoint 9
//! 20517 bytes, CRC-32 9ae0daaf
//! written by mdr-tui 0.1.0 at cycle 42.5
//! <CBOR>
//! ```
//!
//! Three readable lines, then the scenario as loaded, its changes and the saved run in CBOR (RFC 8949), which keeps
//! every bit of an f64, including infinities and −0. Fields are stored by name, so that added fields can be recognised.
//! Length and checksum of the contents reveal a damaged file.

use std::borrow::Cow;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::bounded_read::{self, Unread};
use super::change::Change;
use super::changes::at_one_cycle;
use super::session::{Session, SessionState, Unchanged};
use super::{Refusal, Scenario, echo, printable};
use crate::math::grid::RadialGrid;
use crate::reading::{Errors, Log};
use crate::simulation::{Saved, Simulation};

/// Each format version with the checksum of its shape: the fields of what is saved, and the columns of a history. A test
/// compares the last one with what is saved now, so a change of the format needs a new version here.
pub const SHAPES: [(u32, u32); 1] = [(9, 0xb00c_4c6e)];

/// The format version written, and the only one read.
pub const VERSION: u32 = SHAPES[SHAPES.len() - 1].0;

/// Start of the first line.
const MAGIC: &str = "mdr-tui checkpoint ";

/// Maximum length of a line before the contents, in bytes.
const LONGEST_LINE: u64 = 200;

/// Maximum size of the contents, in bytes: the history of ten million cycles.
const LARGEST: u64 = 4 << 30;

/// A saved session, and the data of the program that drove it.
#[derive(Debug)]
pub struct Checkpoint<E> {
    /// The session, ready to continue.
    pub session: Session,
    /// The driver's own data, if it saved any.
    pub job: Option<E>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Contents<'a, E> {
    origin: Cow<'a, str>,
    scenario: String,
    /// Cycle and text of each change made, and of those to come.
    changes: Vec<(f64, String)>,
    pending: Vec<(f64, String)>,
    goals: Cow<'a, [f64]>,
    saved: Saved,
    log: Cow<'a, Log>,
    /// The run before the changes of the current cycle.
    unchanged: Option<(Saved, Cow<'a, Log>)>,
    job: Option<E>,
}

/// Encodes a checkpoint of `session`, with the `job` of the run that it belongs to.
pub fn encode<E: Serialize>(session: &Session, job: Option<&E>) -> Vec<u8> {
    let saved = session.simulation().save();
    let cycle = saved.cycle();
    let body = Contents {
        origin: session.loaded.origin().into(),
        scenario: session.loaded.to_toml(),
        changes: texts(&session.changes),
        pending: texts(&session.pending),
        goals: (&session.goals).into(),
        saved,
        log: Cow::Borrowed(session.log()),
        unchanged: (session.unchanged())
            .map(|Unchanged { state, .. }| (state.simulation.save(), Cow::Borrowed(&state.log))),
        job,
    };
    let version = env!("CARGO_PKG_VERSION");
    let mut contents = format!("written by mdr-tui {version} at cycle {cycle}\n").into_bytes();
    ciborium::into_writer(&body, &mut contents).expect("CBOR holds any value, and memory takes it");
    sealed(&contents)
}

fn texts(changes: &[Change]) -> Vec<(f64, String)> {
    let texts = changes.iter().map(|of| (of.at_cycle, of.to_string()));
    texts.collect()
}

fn parsed(texts: &[(f64, String)]) -> Result<Vec<Change>, String> {
    let read = texts
        .iter()
        .map(|(at_cycle, set)| Change::parse(*at_cycle, set));
    read.collect::<Result<_, _>>()
        .map_err(|why| why.to_string())
}

/// Prepends the lines with which `contents` can be verified.
pub fn sealed(contents: &[u8]) -> Vec<u8> {
    let seal = seal(contents.len() as u64, crc32fast::hash(contents));
    let head = format!("{MAGIC}{VERSION}\n{seal}");
    [head.as_bytes(), contents].concat()
}

/// Formats the second line.
fn seal(length: u64, checksum: u32) -> String {
    format!("{length} bytes, CRC-32 {checksum:08x}\n")
}

/// Reads the checkpoint in the file at `path`.
///
/// # Errors
///
/// In one line: the file cannot be read, is not a checkpoint of this version, is damaged, or holds no valid run.
pub fn read<E: DeserializeOwned>(path: &Path) -> Result<Checkpoint<E>, Refusal> {
    let name = printable(&path.display().to_string());
    let file = bounded_read::open(path).map_err(|why| unreadable(&name, why))?;
    decode(BufReader::new(file), &name)
}

/// Reads a checkpoint, called `name` in messages.
///
/// # Errors
///
/// As [`read`].
pub fn decode<E: DeserializeOwned>(
    mut from: impl BufRead,
    name: &str,
) -> Result<Checkpoint<E>, Refusal> {
    let unread = |cause: io::Error| unreadable(name, cause.into());
    let mut line = || -> Result<String, Refusal> {
        let mut line = Vec::new();
        let mut start = from.by_ref().take(LONGEST_LINE);
        start.read_until(b'\n', &mut line).map_err(unread)?;
        Ok(String::from_utf8_lossy(&line).into_owned())
    };
    let refuse = |rule: String| Err(Refusal::new(name, rule));
    let torn = |why: &str| refuse(format!("is damaged: {why}; try an older checkpoint"));
    let unfit = |why: &str| {
        let (program, why) = (env!("CARGO_PKG_VERSION"), printable(why.trim()));
        refuse(format!(
            "this mdr-tui ({program}) cannot read its run: {why}"
        ))
    };
    let first = line()?;
    let Some(version) = first.strip_prefix(MAGIC) else {
        return refuse("is not a checkpoint of mdr-tui".into());
    };
    let Some(version) = version.strip_suffix('\n') else {
        return torn("it ends within its first line");
    };
    if version != VERSION.to_string() {
        // The second line seals the contents, which begin with who wrote them.
        let (_, writer) = (line()?, line()?);
        let writer = writer
            .split_once("written by ")
            .and_then(|(_, writer)| writer.split_once(" at "));
        let writer = writer.map_or_else(String::new, |(writer, _)| {
            format!(", written by {}", echo(writer))
        });
        let (version, program) = (echo(version), env!("CARGO_PKG_VERSION"));
        return refuse(format!(
            "is a checkpoint of version {version}{writer}; this mdr-tui ({program}) reads version {VERSION}"
        ));
    }
    let Some((length, checksum)) = promise(&line()?) else {
        return torn("its second line is incomplete");
    };
    if length > LARGEST {
        return unfit(&format!("it is larger than {} GiB", LARGEST >> 30));
    }
    // Allow one extra byte to detect extra contents.
    let mut contents = BufReader::new(Summed::new(from.take(length + 1)));
    let body = body(&mut contents);
    io::copy(&mut contents, &mut io::sink()).map_err(unread)?;
    // Only now is it known whether the body is complete.
    let read = contents.into_inner();
    match read.length {
        found if found > length => return torn(&format!("it continues after its {length} bytes")),
        found if found < length => return torn(&format!("it has {found} of {length} bytes")),
        _ if read.sum.finalize() != checksum => return torn("its checksum does not match"),
        _ => {}
    }
    body.and_then(restore).or_else(|why| unfit(&why))
}

/// Counts and sums the bytes read, which need not fit in memory at once.
struct Summed<R> {
    from: R,
    length: u64,
    sum: crc32fast::Hasher,
}

impl<R> Summed<R> {
    fn new(from: R) -> Self {
        Self {
            from,
            length: 0,
            sum: crc32fast::Hasher::new(),
        }
    }
}

impl<R: Read> Read for Summed<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.from.read(buffer)?;
        self.sum.update(&buffer[..length]);
        self.length += length as u64;
        Ok(length)
    }
}

fn unreadable(name: &str, why: Unread) -> Refusal {
    match why {
        Unread::Directory | Unread::Irregular => {
            Refusal::new(name, format_args!("{why}; a checkpoint is a file"))
        }
        why => Refusal::unread(name, &why),
    }
}

/// Parses length and checksum from the second line.
fn promise(line: &str) -> Option<(u64, u32)> {
    let (length, checksum) = line.strip_suffix('\n')?.split_once(" bytes, CRC-32 ")?;
    let length = length.parse().ok()?;
    let checksum = u32::from_str_radix(checksum, 16).ok()?;
    (line == seal(length, checksum)).then_some((length, checksum))
}

/// Reads the body, which follows the line on who wrote it.
fn body<E: DeserializeOwned>(from: &mut impl BufRead) -> Result<Contents<'static, E>, String> {
    let mut line = from.by_ref().take(LONGEST_LINE);
    line.skip_until(b'\n').map_err(|error| error.to_string())?;
    ciborium::from_reader(from).map_err(|error| match error {
        ciborium::de::Error::Semantic(_, message) => message,
        other => other.to_string(),
    })
}

/// Restores a session; the error says what is wrong with its body.
fn restore<E>(body: Contents<E>) -> Result<Checkpoint<E>, String> {
    let loaded = Scenario::from_toml(&body.scenario, &body.origin, &[])
        .map_err(|error| format!("its scenario {error}"))?;
    let (mut scenario, mut unchanged) = (loaded.clone(), None);
    let mut made = 0;
    let made_so_far = parsed(&body.changes)?;
    for together in at_one_cycle(&made_so_far) {
        let after = scenario.after(together).map_err(|why| why.to_string())?;
        let before = std::mem::replace(&mut scenario, after);
        let is_last = made + together.len() == made_so_far.len();
        if let Some((saved, log)) = body.unchanged.as_ref().filter(|_| is_last) {
            let state = state(before, saved.clone(), Log::clone(log))?;
            let changes = made;
            unchanged = Some(Box::new(Unchanged { state, changes }));
        }
        made += together.len();
    }
    let session = Session {
        loaded,
        now: state(scenario, body.saved, body.log.into_owned())?,
        changes: made_so_far,
        pending: parsed(&body.pending)?,
        unchanged,
        errors: Errors::default(),
        goals: body.goals.into_owned(),
    };
    Ok(Checkpoint {
        session,
        job: body.job,
    })
}

/// Restores a saved simulation of `scenario`. A domain that has grown may be wider than the scenario's.
fn state(scenario: Scenario, saved: Saved, log: Log) -> Result<SessionState, String> {
    let mut setup = scenario.setup().clone();
    if setup.indenter.rim().is_none() && saved.radius() > setup.grid.radius() {
        let wider = RadialGrid::uniform(setup.grid.cells(), saved.radius());
        setup.grid = wider.unwrap_or(setup.grid);
    }
    let simulation = Simulation::restore(setup, saved).map_err(|why| why.to_string())?;
    Ok(SessionState {
        scenario,
        simulation,
        log,
    })
}
