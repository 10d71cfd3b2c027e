//! The folder of a data set: which rows are done, and the next part.

use super::columns::{self, ROW, STATUS};
use super::error::{self, DataSetError};
use super::lock::{Lock, Shard};
use super::manifest::Manifest;
use super::table::{Column, Data};
use super::{part_read, part_write};
use crate::study::batch::{Record, RowStatus};
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

const PREFIX: &str = "part-";
const ENDING: &str = ".parquet";
/// Most rows of a batch: there is a bit for each up to the last that is done.
const MOST_ROWS: i64 = 100_000_000;
/// Where a part has its manifest.
const BATCH: &str = "ffsm.batch";
/// Columns that have a value in every row.
const REQUIRED: [&str; 3] = [ROW, "key", STATUS];

/// A data set to read from, which another run may still be writing to.
#[derive(Debug)]
pub struct DataSet {
    folder: PathBuf,
    manifest: Manifest,
}

/// Which rows of a batch are done.
#[derive(Debug, Clone, Default)]
pub struct Done {
    bits: Vec<u64>,
    rows: u64,
}

/// A data set to write to. No other run writes to the same rows meanwhile.
#[derive(Debug)]
pub struct Writer {
    set: DataSet,
    shard: Shard,
    next: u64,
    _lock: Lock,
}

impl DataSet {
    /// The one in `folder`.
    ///
    /// # Errors
    /// [`DataSetError`] where there is none.
    pub fn open(folder: &Path) -> Result<Self, DataSetError> {
        let missing = || DataSetError::Missing {
            path: folder.into(),
        };
        let manifest = Manifest::read(folder)?.ok_or_else(missing)?;
        let folder = folder.into();
        Ok(Self { folder, manifest })
    }

    /// What its rows follow from.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Columns by their names, one part after another; `told` gets those of one part at a time, in the
    /// order of the files' names. Columns that no part has are left out.
    ///
    /// # Errors
    /// [`DataSetError`] where a part cannot be read.
    pub fn read(
        &self,
        names: &[&str],
        told: &mut dyn FnMut(Vec<Column>),
    ) -> Result<(), DataSetError> {
        for path in self.parts()? {
            told(read(&path, Some(names))?);
        }
        Ok(())
    }

    /// Which rows are done. Every part is looked at: a file that was copied here need not be of this batch,
    /// and may have rows that are here already.
    ///
    /// # Errors
    /// [`DataSetError`] where a part cannot be read, is of another batch, or has a row of another part.
    pub fn done(&self) -> Result<Done, DataSetError> {
        let mut done = Done::default();
        for path in self.parts()? {
            self.check(&path)?;
            let columns = read(&path, Some(&[ROW]))?;
            let rows = columns.into_iter().next().map(|column| column.data);
            let Some(Data::Integer(rows)) = rows else {
                continue;
            };
            for row in rows.into_iter().flatten() {
                if !(0..MOST_ROWS).contains(&row) {
                    let reason = format!("it has a row {row}; a batch has at most {MOST_ROWS}");
                    return Err(DataSetError::Damaged { path, reason });
                }
                if !done.insert(row as u64) {
                    return Err(DataSetError::Twice { path, row });
                }
            }
        }
        Ok(done)
    }

    /// Whether the part at `path` is of this batch.
    fn check(&self, path: &Path) -> Result<(), DataSetError> {
        let damaged = |reason: String| DataSetError::Damaged {
            path: path.into(),
            reason,
        };
        let file = File::open(path).map_err(error::read(path))?;
        let found = part_read::metadata(file, BATCH).map_err(|error| damaged(error.to_string()))?;
        let found = found.ok_or_else(|| damaged("it does not say of which batch it is".into()))?;
        let found: Manifest =
            serde_json::from_str(&found).map_err(|error| damaged(error.to_string()))?;
        match found.difference(&self.manifest) {
            Some(what) => Err(DataSetError::Other {
                path: path.into(),
                what,
            }),
            None => Ok(()),
        }
    }

    /// The part files, sorted.
    fn parts(&self) -> Result<Vec<PathBuf>, DataSetError> {
        let mut parts = Vec::new();
        for entry in std::fs::read_dir(&self.folder).map_err(error::read(&self.folder))? {
            let path = entry.map_err(error::read(&self.folder))?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if name.starts_with(PREFIX) && name.ends_with(ENDING) {
                parts.push(path.clone());
            }
        }
        parts.sort();
        Ok(parts)
    }
}

fn read(path: &Path, names: Option<&[&str]>) -> Result<Vec<Column>, DataSetError> {
    let file = File::open(path).map_err(error::read(path))?;
    part_read::read(file, names).map_err(|error| DataSetError::Damaged {
        path: path.into(),
        reason: error.to_string(),
    })
}

impl Done {
    /// Takes up a row; whether it is new.
    fn insert(&mut self, row: u64) -> bool {
        let word = (row / 64) as usize;
        if word >= self.bits.len() {
            self.bits.resize(word + 1, 0);
        }
        let bit = 1 << (row % 64);
        let is_new = self.bits[word] & bit == 0;
        self.rows += u64::from(is_new);
        self.bits[word] |= bit;
        is_new
    }

    /// Whether the row at that position is.
    pub fn has(&self, row: u64) -> bool {
        let word = self.bits.get((row / 64) as usize);
        word.is_some_and(|word| word >> (row % 64) & 1 == 1)
    }

    /// How many are.
    pub fn rows(&self) -> u64 {
        self.rows
    }
}

impl Writer {
    /// Begins a data set in `folder`, or goes on with one where it may `resume`, for the rows of
    /// `shard`; with the rows that are done.
    ///
    /// # Errors
    /// [`DataSetError`] where another run writes these rows, where the folder has rows of another
    /// batch, or of this one and it may not resume, and where nothing can be written.
    pub fn open(
        folder: &Path,
        manifest: Manifest,
        shard: Shard,
        resume: bool,
    ) -> Result<(Self, Done), DataSetError> {
        std::fs::create_dir_all(folder).map_err(error::folder(folder))?;
        let lock = Lock::take(folder, shard)?;
        let path = || folder.to_path_buf();
        let there = Manifest::read(folder)?;
        let difference = there.as_ref().and_then(|there| there.difference(&manifest));
        if let Some(what) = difference {
            return Err(DataSetError::Other { path: path(), what });
        }
        let set = DataSet {
            folder: path(),
            manifest,
        };
        let done = set.done()?;
        let own = shard.positions(set.manifest.rows);
        let rows = own.filter(|row| done.has(*row)).count() as u64;
        if rows > 0 && !resume {
            return Err(DataSetError::Begun { path: path(), rows });
        }
        // Not before: a run that is refused leaves the folder to that which it is of.
        if there.is_none_or(|there| there.rows < set.manifest.rows) {
            set.manifest.write(folder)?;
        }
        let mut writer = Self {
            set,
            shard,
            next: 0,
            _lock: lock,
        };
        writer.tidy()?;
        Ok((writer, done))
    }

    /// Takes away what a run that was killed left half written, and finds the next number.
    fn tidy(&mut self) -> Result<(), DataSetError> {
        let folder = &self.set.folder;
        let (own, half) = (self.name(""), format!(".{}", self.name("")));
        for entry in std::fs::read_dir(folder).map_err(error::read(folder))? {
            let path = entry.map_err(error::read(folder))?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let number = |rest: &str| rest.trim_end_matches(ENDING).parse::<u64>().ok();
            if let Some(rest) = name.strip_prefix(&half) {
                // Nobody else is at work beside a run of all rows.
                if self.shard == Shard::WHOLE || number(rest).is_some() {
                    std::fs::remove_file(&path).map_err(error::write(&path))?;
                }
            } else if let Some(number) = name.strip_prefix(&own).and_then(number) {
                self.next = self.next.max(number + 1);
            }
        }
        Ok(())
    }

    /// The beginning of the names of its parts, and `rest`.
    fn name(&self, rest: &str) -> String {
        format!("{PREFIX}{}{rest}", self.shard.tag())
    }

    /// The data set, to read from.
    pub fn set(&self) -> &DataSet {
        &self.set
    }

    /// Writes `records` as one more part, which is there as a whole or not at all.
    ///
    /// # Errors
    /// [`DataSetError`]; the parts before are kept.
    pub fn append(&mut self, records: &[Record]) -> Result<(), DataSetError> {
        if records.is_empty() {
            return Ok(());
        }
        let Manifest {
            keys, trajectories, ..
        } = &self.set.manifest;
        let columns = columns::of(records, keys, *trajectories);
        let name = self.name(&format!("{:06}{ENDING}", self.next));
        self.put(&name, &columns)?;
        self.next += 1;
        Ok(())
    }

    fn put(&self, name: &str, columns: &[Column]) -> Result<(), DataSetError> {
        let manifest = &self.set.manifest;
        let metadata = [
            ("ffsm.schema", manifest.schema.to_string()),
            (BATCH, manifest.json()),
        ];
        let bytes = part_write::write(Vec::new(), columns, &REQUIRED, &metadata);
        let path = self.set.folder.join(name);
        let bytes = bytes.map_err(|cause| DataSetError::Encode {
            path: path.clone(),
            cause,
        })?;
        let half = self.set.folder.join(format!(".{name}"));
        let write = || {
            let mut file = File::create(&half)?;
            file.write_all(&bytes)?;
            file.sync_all()?;
            std::fs::rename(&half, &path)?;
            File::open(&self.set.folder)?.sync_all()
        };
        write().map_err(|cause| {
            // What there was room for is of no use.
            let _ = std::fs::remove_file(&half);
            error::write(&path)(cause)
        })
    }

    /// Takes the rows that ended as one of `statuses` out of the data set, to be planned again; how
    /// many there were. Rows beyond those of this batch, of a time when it had more, stay.
    ///
    /// # Errors
    /// [`DataSetError`]; rows that are not yet taken out are kept.
    pub fn retract(&mut self, statuses: &[RowStatus]) -> Result<u64, DataSetError> {
        let mut taken = 0;
        for path in self.set.parts()? {
            let [ended, rows] = [STATUS, ROW].map(|name| read(&path, Some(&[name])));
            let first = |columns: Vec<Column>| columns.into_iter().next().map(|c| c.data);
            let (Some(Data::Text(ended)), Some(Data::Integer(rows))) =
                (first(ended?), first(rows?))
            else {
                continue;
            };
            let goes = |name: &Option<String>, row: Option<i64>| {
                let status = name.as_deref().and_then(RowStatus::of);
                status.is_some_and(|status| statuses.contains(&status))
                    && row.is_some_and(|row| (row as u64) < self.set.manifest.rows)
            };
            let ended = ended.iter().zip(rows);
            let keep: Vec<bool> = ended.map(|(name, row)| !goes(name, row)).collect();
            let gone = keep.iter().filter(|keep| !**keep).count() as u64;
            if gone == 0 {
                continue;
            }
            let mut columns = read(&path, None)?;
            columns
                .iter_mut()
                .for_each(|column| column.data.retain(&keep));
            if columns.first().is_some_and(|column| column.data.is_empty()) {
                std::fs::remove_file(&path).map_err(error::write(&path))?;
            } else {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                self.put(&name, &columns)?;
            }
            taken += gone;
        }
        Ok(taken)
    }
}
