//! The output folder: known to be writable before anything is solved, files written whole.

use super::file_set::FileSet;
use crate::plot::PlotError;
use std::io;
use std::path::{Path, PathBuf};

/// A folder or file that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The folder.
    #[error(
        "{}: the output folder cannot be written: {cause}; expected a folder that can, see --out",
        path.display()
    )]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A file in it.
    #[error("{}: cannot be written: {cause}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
    /// A figure for it.
    #[error("{}: {cause}", path.display())]
    Figure {
        /// The file.
        path: PathBuf,
        /// Why it cannot be drawn.
        cause: PlotError,
    },
}

/// A folder that a file could be created in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// Creates the folder where it is missing, and tries it.
    ///
    /// # Errors
    /// [`OutputError::Folder`] where no file can be created in it.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let try_out = || {
            std::fs::create_dir_all(path)?;
            tempfile::tempfile_in(path)
        };
        match try_out() {
            Ok(_) => Ok(Self { path: path.into() }),
            Err(cause) => Err(OutputError::Folder {
                path: path.into(),
                cause,
            }),
        }
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a file beside its place, then renames it; its path is returned.
    ///
    /// # Errors
    /// [`OutputError::File`]; the file is then as it was before.
    pub fn write(&self, name: &str, text: &str) -> Result<PathBuf, OutputError> {
        let mut set = FileSet::new();
        set.add(self, name, text);
        set.write()?;
        Ok(self.path.join(name))
    }
}
