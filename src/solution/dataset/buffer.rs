//! Records on their way to the next part file.

use super::error::DataSetError;
use super::folder::Writer;
use crate::study::batch::Record;
use std::time::{Duration, Instant};

/// Most records of a part.
const MOST: usize = 10_000;
/// Most numbers of motions in a part.
const MOST_NUMBERS: usize = 4 << 20;
/// Least and most time between two parts; in between a twentieth of what was spent so far, so that a
/// long run loses minutes at most and leaves files enough to be counted.
const SOON: Duration = Duration::from_millis(500);
const LATE: Duration = Duration::from_secs(60);

/// Records on their way to the next part file.
pub(super) struct Buffer {
    records: Vec<Record>,
    numbers: usize,
    began: Instant,
    written: Instant,
}

impl Buffer {
    /// Nothing yet.
    pub(super) fn new() -> Self {
        let now = Instant::now();
        Self {
            records: Vec::new(),
            numbers: 0,
            began: now,
            written: now,
        }
    }

    /// Adds a record.
    pub(super) fn push(&mut self, record: Record) {
        let motion = record.motion.as_ref();
        self.numbers += motion.map_or(0, |motion| motion.numbers());
        self.records.push(record);
    }

    /// Whether a part is to be written.
    pub(super) fn is_due(&self) -> bool {
        let full = self.records.len() >= MOST || self.numbers >= MOST_NUMBERS;
        let pause = (self.began.elapsed() / 20).clamp(SOON, LATE);
        full || !self.records.is_empty() && self.written.elapsed() >= pause
    }

    /// Writes what there is, in the order of the rows.
    pub(super) fn write(&mut self, to: &mut Writer) -> Result<(), DataSetError> {
        self.records.sort_by_key(|record| record.position);
        to.append(&self.records)?;
        self.records.clear();
        self.numbers = 0;
        self.written = Instant::now();
        Ok(())
    }
}
