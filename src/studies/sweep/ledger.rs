//! Stores the rows of a study in a file, and an index to them. Its memory does not grow with the rows, except for one
//! bit per point.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::os::unix::fs::FileExt;
use std::path::Path;

use super::finder::Finder;
use super::record::{self, Refused};
use super::{Shard, Study, Success};
use crate::math::number::exact;
use crate::scenario::escape::csv_line;

/// Size of an entry of the index, in bytes.
const ENTRY: usize = 16;

/// Rows in order of arrival.
#[derive(Debug)]
pub struct Ledger {
    /// Created when the first row is added.
    finder: Option<Finder>,
    rows: File,
    /// Length of `rows` up to the last complete row.
    length: u64,
    /// For each point, where its row begins in `rows` and its length. The file has no name, so it disappears with the
    /// process.
    index: File,
    /// One bit per point: whether it has its row.
    done: Vec<u64>,
    /// Number of rows by the success of their points.
    counts: BTreeMap<Success, usize>,
}

impl Ledger {
    /// Makes an empty ledger, which appends rows to `rows`. The index is a file in `directory`.
    ///
    /// # Errors
    ///
    /// If the file cannot be created.
    pub fn new(study: &Study, mut rows: File, directory: &Path) -> io::Result<Self> {
        Ok(Self {
            finder: None,
            length: rows.seek(SeekFrom::End(0))?,
            rows,
            index: tempfile::tempfile_in(directory)?,
            done: vec![0; study.points().div_ceil(64)],
            counts: BTreeMap::new(),
        })
    }

    /// Adds the row of a point. On an error the file ends with the last complete row, or with part of a row that
    /// readers drop.
    ///
    /// # Errors
    ///
    /// If the system reports one.
    pub fn add(&mut self, point: usize, fields: &[String]) -> io::Result<()> {
        let line = csv_line(fields);
        let entry = [self.length, line.len() as u64].map(u64::to_le_bytes);
        let (entry, place) = (entry.as_flattened(), (ENTRY * point) as u64);
        let written = self.rows.write_all(line.as_bytes());
        let written = written.and_then(|()| self.index.write_all_at(entry, place));
        if let Err(error) = written {
            let _ = self.rows.set_len(self.length);
            return Err(error);
        }
        self.length += line.len() as u64;
        self.done[point / 64] |= 1 << (point % 64);
        *self.counts.entry(Success::from_row(fields)).or_default() += 1;
        Ok(())
    }

    /// Adds a row read from elsewhere to its point, with numbers in the form that this program writes.
    ///
    /// # Errors
    ///
    /// If the system reports one; the inner error says why no point takes the row.
    pub fn add_foreign(
        &mut self,
        study: &Study,
        mut fields: Vec<String>,
    ) -> io::Result<Result<(), Refused>> {
        let finder = self.finder.get_or_insert_with(|| Finder::new(study));
        let points = finder.points_of(study, &fields);
        let Some(&first) = points.first() else {
            return Ok(Err(Refused::Foreign));
        };
        for (field, value) in fields.iter_mut().zip(study.values(first)) {
            *field = value;
        }
        for field in &mut fields[study.axes.len()..] {
            if let Ok(value) = field.parse::<f64>()
                && value.is_finite()
            {
                *field = exact(value);
            }
        }
        // Points with equal values have equal rows, so any of them may take it.
        if let Some(&free) = points.iter().find(|&&point| !self.has(point)) {
            return self.add(free, &fields).map(Ok);
        }
        for point in points {
            if self.row(point)? == fields {
                return Ok(Err(Refused::Double));
            }
        }
        Ok(Err(Refused::Contradiction))
    }

    /// Whether a point has its row.
    pub fn has(&self, point: usize) -> bool {
        is_set(&self.done, point)
    }

    /// Returns the points of a shard without a row, in order.
    pub fn missing(
        &self,
        study: &Study,
        shard: Shard,
    ) -> impl Iterator<Item = usize> + Send + use<> {
        let done = self.done.clone();
        let points = shard.points(study.points());
        points.filter(move |&point| !is_set(&done, point))
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.counts.values().sum()
    }

    /// Returns the number of rows with this success.
    pub fn count(&self, success: Success) -> usize {
        self.counts.get(&success).copied().unwrap_or(0)
    }

    /// Returns the number of rows without a result.
    pub fn failed(&self) -> usize {
        self.count(Success::Failed) + self.count(Success::Invalid)
    }

    /// Ensures that a crash of the machine does not lose the rows.
    ///
    /// # Errors
    ///
    /// If the system reports one.
    pub fn sync(&self) -> io::Result<()> {
        self.rows.sync_data()
    }

    /// Returns the row of a point that has one.
    ///
    /// # Errors
    ///
    /// If the file cannot be read.
    pub fn row(&self, point: usize) -> io::Result<Vec<String>> {
        let line = self.line(point)?;
        Ok(record::split(&String::from_utf8_lossy(&line)))
    }

    fn line(&self, point: usize) -> io::Result<Vec<u8>> {
        let (mut entry, place) = ([0; ENTRY], (ENTRY * point) as u64);
        self.index.read_exact_at(&mut entry, place)?;
        let entry = u128::from_le_bytes(entry);
        let mut line = vec![0; (entry >> 64) as usize];
        self.rows.read_exact_at(&mut line, entry as u64)?;
        Ok(line)
    }

    /// Passes the rows, as lines, to `take` in the order of the points.
    ///
    /// # Errors
    ///
    /// From `take`, or if a file cannot be read.
    pub fn each(&self, mut take: impl FnMut(&[u8]) -> io::Result<()>) -> io::Result<()> {
        let mut points = (0..64 * self.done.len()).filter(|&point| self.has(point));
        points.try_for_each(|point| take(&self.line(point)?))
    }
}

fn is_set(bits: &[u64], at: usize) -> bool {
    bits[at / 64] >> (at % 64) & 1 == 1
}
