//! The output folder: known to be writable before anything is solved, files written whole.

use crate::plot::{self, Figure, PlotError};
use std::fs::Permissions;
use std::io::{self, Write};
use std::os::unix::fs::PermissionsExt;
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

    /// Writes a file beside its place, then renames it; its path is returned.
    ///
    /// # Errors
    /// [`OutputError::File`]; the file is then as it was before.
    pub fn write(&self, name: &str, contents: &str) -> Result<PathBuf, OutputError> {
        self.write_bytes(name, contents.as_bytes())
    }

    /// [`Self::write`] for what is no text.
    ///
    /// # Errors
    /// [`OutputError::File`]; the file is then as it was before.
    pub fn write_bytes(&self, name: &str, contents: &[u8]) -> Result<PathBuf, OutputError> {
        let path = self.path.join(name);
        let write = || {
            // A temporary file is the owner's alone; a result is as open as any new file.
            let mut file = tempfile::Builder::new()
                .permissions(Permissions::from_mode(0o666))
                .tempfile_in(&self.path)?;
            file.write_all(contents)?;
            file.persist(&path)?;
            Ok(())
        };
        write().map_err(|cause| OutputError::File {
            path: path.clone(),
            cause,
        })?;
        Ok(path)
    }

    /// Writes a figure as `name.svg` and `name.png`; their paths are returned.
    ///
    /// # Errors
    /// [`OutputError::File`] and [`OutputError::Figure`].
    pub fn write_figure(&self, name: &str, figure: &Figure) -> Result<[PathBuf; 2], OutputError> {
        let svg = figure.svg();
        let picture = format!("{name}.png");
        let pixels = plot::png(&svg).map_err(|cause| OutputError::Figure {
            path: self.path.join(&picture),
            cause,
        })?;
        Ok([
            self.write(&format!("{name}.svg"), &svg)?,
            self.write_bytes(&picture, &pixels)?,
        ])
    }
}
