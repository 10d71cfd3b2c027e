//! One run at a time for every row of a folder.

use super::error::{self, DataSetError};
use rustix::fs::{FlockOperation, flock};
use rustix::io::Errno;
use std::fmt;
use std::fs::{File, OpenOptions};
use std::path::Path;

/// A part of the rows of a batch: every `of`th, beginning with that at position `index`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Shard {
    /// Which, counted from 0.
    pub index: u64,
    /// How many there are.
    pub of: u64,
}

impl Shard {
    /// All rows.
    pub const WHOLE: Self = Self { index: 0, of: 1 };
    /// Most shards.
    pub const MOST: u64 = 1_000_000;

    /// The one that is number `number`, counted from 1, of so many; `None` where there is none.
    pub fn new(number: u64, of: u64) -> Option<Self> {
        let known = number >= 1 && number <= of && of <= Self::MOST;
        known.then(|| Self {
            index: number - 1,
            of,
        })
    }

    /// Its positions among the first `count`.
    pub fn positions(self, count: u64) -> impl Iterator<Item = u64> + Send {
        (self.index..count).step_by(self.of as usize)
    }

    /// What its files have in their names; nothing for all rows.
    pub(super) fn tag(self) -> String {
        match self.of {
            1 => String::new(),
            of => format!("{}of{of}-", self.index + 1),
        }
    }
}

impl Default for Shard {
    /// All rows.
    fn default() -> Self {
        Self::WHOLE
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index + 1, self.of)
    }
}

/// Held while a run writes to a folder; the system gives it back however the run ends.
#[derive(Debug)]
pub(super) struct Lock {
    _files: Vec<File>,
}

const WHOLE: &str = ".lock";
const SHARD: &str = ".lock-";

impl Lock {
    /// Takes the rows of `shard` in `folder`. All rows go with no shard at the same time, and shards of
    /// one number with none of another.
    pub(super) fn take(folder: &Path, shard: Shard) -> Result<Self, DataSetError> {
        let refused = || DataSetError::Locked {
            path: folder.into(),
        };
        let get = |name: &str, shared: bool| {
            let path = folder.join(name);
            // Both, for NFS: there a shared lock is of what is read, an exclusive one of what is written.
            let file = OpenOptions::new()
                .read(true)
                .write(true)
                .create(true)
                .truncate(false)
                .open(&path)
                .map_err(error::write(&path))?;
            let operation = match shared {
                true => FlockOperation::NonBlockingLockShared,
                false => FlockOperation::NonBlockingLockExclusive,
            };
            match flock(&file, operation) {
                Ok(()) => Ok(file),
                Err(Errno::WOULDBLOCK) => Err(refused()),
                Err(errno) => Err(error::write(&path)(errno.into())),
            }
        };
        if shard == Shard::WHOLE {
            let _files = vec![get(WHOLE, false)?];
            return Ok(Self { _files });
        }
        let all = get(WHOLE, true)?;
        let own = get(&format!("{SHARD}{}of{}", shard.index + 1, shard.of), false)?;
        // Taken first and looked around then: of two that begin at once, one sees the other.
        let same = format!("of{}", shard.of);
        for entry in std::fs::read_dir(folder).map_err(error::read(folder))? {
            let name = entry.map_err(error::read(folder))?.file_name();
            let name = name.to_string_lossy();
            if name.starts_with(SHARD) && !name.ends_with(&same) {
                get(&name, true)?;
            }
        }
        let _files = vec![all, own];
        Ok(Self { _files })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_have_every_row_once() {
        let mut rows: Vec<u64> = (1..=3)
            .flat_map(|number| Shard::new(number, 3).unwrap().positions(11))
            .collect();
        rows.sort_unstable();
        assert_eq!(rows, (0..11).collect::<Vec<_>>());
        assert_eq!(Shard::new(0, 3), None);
        assert_eq!(Shard::new(4, 3), None);
    }

    #[test]
    fn nobody_writes_the_rows_of_another() {
        let place = tempfile::tempdir().unwrap();
        let take = |shard| Lock::take(place.path(), shard);
        let shard = |number, of| Shard::new(number, of).unwrap();
        let whole = take(Shard::WHOLE).unwrap();
        for other in [Shard::WHOLE, shard(1, 2)] {
            assert!(matches!(take(other), Err(DataSetError::Locked { .. })));
        }
        drop(whole);
        let _first = take(shard(1, 2)).unwrap();
        let _second = take(shard(2, 2)).unwrap();
        for other in [Shard::WHOLE, shard(1, 2), shard(3, 4), shard(1, 12)] {
            assert!(
                matches!(take(other), Err(DataSetError::Locked { .. })),
                "{other}"
            );
        }
    }
}
