//! `_batch.json`: what the rows of a data set follow from.

use super::error::{self, DataSetError};
use crate::config::{BatchFile, CellKind};
use crate::nlp::ipopt;
use crate::solution::provenance::fingerprint;
use crate::solution::{Build, TextFile};
use serde::{Deserialize, Serialize};
use std::fs::{File, Permissions};
use std::io::{ErrorKind, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

/// What the rows of a data set follow from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Manifest {
    /// Version of the format, 1.
    pub schema: u32,
    /// Rows of the whole batch.
    pub rows: u64,
    /// SHA-256 of all that the rows follow from, hexadecimal.
    pub fingerprint: String,
    /// The keys that vary, with what their values are.
    pub keys: Vec<(String, CellKind)>,
    /// SHA-256 of the saved solution that every plan starts from, hexadecimal.
    #[serde(default)]
    pub start: Option<String>,
    /// Whether rows have the planned motions.
    pub trajectories: bool,
    /// Version of the program with its git revision.
    pub version: String,
    /// Version of Ipopt.
    pub ipopt: String,
    /// The batch file; without text for JSON lines.
    pub batch: TextFile,
    /// The problem that is varied.
    pub problem: Option<TextFile>,
    /// Its robot.
    pub robot: Option<TextFile>,
}

const NAME: &str = "_batch.json";

impl Manifest {
    /// That of `batch`, every plan of which starts from the saved solution at `start`, where there is
    /// one.
    ///
    /// # Errors
    /// [`DataSetError::Read`] where that cannot be read.
    pub fn of(
        batch: &BatchFile,
        start: Option<&Path>,
        trajectories: bool,
    ) -> Result<Self, DataSetError> {
        let file = |path: &str, text: &str| TextFile {
            path: path.into(),
            text: text.into(),
        };
        let base = batch.base();
        let hash = |path: &Path| {
            let text = std::fs::read_to_string(path).map_err(error::read(path))?;
            Ok(fingerprint(&text))
        };
        Ok(Self {
            start: start.map(hash).transpose()?,
            schema: 1,
            rows: batch.count(),
            fingerprint: batch.fingerprint().into(),
            keys: batch.keys(),
            trajectories,
            version: Build::VERSION.into(),
            ipopt: ipopt::version().into(),
            batch: file(&batch.path, &batch.text),
            problem: base.map(|base| file(&base.path, &base.text)),
            robot: base.map(|base| file(&base.robot.path, &base.robot.text)),
        })
    }

    /// That of `folder`, where there is one.
    pub(super) fn read(folder: &Path) -> Result<Option<Self>, DataSetError> {
        let path = folder.join(NAME);
        let text = match std::fs::read_to_string(&path) {
            Err(cause) if cause.kind() == ErrorKind::NotFound => return Ok(None),
            text => text.map_err(error::read(&path))?,
        };
        let read: Result<Self, _> = serde_json::from_str(&text);
        match read {
            Ok(manifest) if manifest.schema == 1 => Ok(Some(manifest)),
            Ok(manifest) => Err(DataSetError::Damaged {
                path,
                reason: format!("schema {}, this version reads 1", manifest.schema),
            }),
            Err(cause) => Err(DataSetError::Damaged {
                path,
                reason: cause.to_string(),
            }),
        }
    }

    /// Writes it to `folder`, whole or not at all.
    pub(super) fn write(&self, folder: &Path) -> Result<(), DataSetError> {
        let path = folder.join(NAME);
        let put = || {
            let mut file = tempfile::Builder::new()
                .prefix(".batch-")
                .permissions(Permissions::from_mode(0o666))
                .tempfile_in(folder)?;
            file.write_all(self.json().as_bytes())?;
            file.as_file().sync_all()?;
            file.persist(&path).map_err(|error| error.error)?;
            File::open(folder)?.sync_all()
        };
        put().map_err(error::write(&path))
    }

    /// As JSON.
    pub(super) fn json(&self) -> String {
        serde_json::to_string(self).expect("texts and whole numbers")
    }

    /// What makes rows of `other` no rows of this one; their number may differ.
    pub(super) fn difference(&self, other: &Self) -> Option<&'static str> {
        if self.fingerprint != other.fingerprint || self.keys != other.keys {
            return Some("problem, robot, seed or values");
        }
        if self.start != other.start {
            return Some("--warm-start");
        }
        (self.trajectories != other.trajectories).then_some("--trajectories")
    }
}
