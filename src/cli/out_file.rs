//! The one file that a command is to write.

use super::failure::Failure;
use std::path::{Path, PathBuf};

/// A place for a file, looked at before anything is computed.
#[derive(Debug)]
pub(super) struct OutFile {
    /// Its path.
    pub path: PathBuf,
    /// The folder that it is in.
    pub folder: PathBuf,
    /// Its name there.
    pub name: String,
    /// What the name ends in, one of those that were allowed.
    pub ending: String,
}

impl OutFile {
    /// The file at `path`, whose name has to end in one of `endings`, and which is not the one at `input`.
    ///
    /// # Errors
    /// [`Failure::Usage`] otherwise.
    pub fn new(path: PathBuf, endings: &[&str], input: &Path) -> Result<Self, Failure> {
        let usage = |expected: String| {
            Failure::Usage(format!("--out {}: expected {expected}", path.display()))
        };
        let text =
            |part: Option<&std::ffi::OsStr>| part.and_then(|part| part.to_str()).map(str::to_owned);
        let ending = text(path.extension()).filter(|ending| endings.contains(&ending.as_str()));
        let (Some(name), Some(ending), false) = (text(path.file_name()), ending, path.is_dir())
        else {
            let endings: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
            let endings = endings.join(" or ");
            return Err(usage(format!("the name of a file that ends in {endings}")));
        };
        let place = |path: &Path| path.canonicalize().ok();
        if place(&path).is_some_and(|there| Some(there) == place(input)) {
            return Err(usage("another file than the one that is read".into()));
        }
        let folder = match path.parent() {
            Some(parent) if parent != Path::new("") => parent.to_path_buf(),
            _ => PathBuf::from("."),
        };
        Ok(Self {
            folder,
            name,
            ending,
            path,
        })
    }
}
