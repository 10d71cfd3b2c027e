//! Files that belong together: all of them are new, or all of them are as they were.
//!
//! Each is written beside its place, where it has no name yet and vanishes with the process. Only when
//! all are there do they get their names, at one go that signals wait for ([`settled`]). Even a process
//! that is killed in the middle leaves no mixture: those of the set that were there before are taken
//! away first, the first of the set excepted, which is replaced, and then the others appear.

use super::output::{OutputError, OutputFolder};
use crate::plot::Figure;
use crate::text::printable::printable;
use rustix::fs::{AtFlags, CWD, Mode, OFlags, linkat};
use std::fs::{File, Permissions};
use std::io::{self, ErrorKind, Write};
use std::os::fd::AsRawFd;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::{NamedTempFile, TempPath};

/// Held while files get their names.
static NAMING: Mutex<()> = Mutex::new(());

/// Does `then` while no files are getting their names, and none begin to.
pub fn settled<R>(then: impl FnOnce() -> R) -> R {
    let _alone = NAMING.lock().unwrap_or_else(PoisonError::into_inner);
    then()
}

/// Files to be written together.
#[derive(Debug, Default)]
pub struct FileSet {
    /// Paths with contents; none for a file that is not to be there.
    files: Vec<(PathBuf, Option<Vec<u8>>)>,
}

impl FileSet {
    /// No files yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a text, control characters in it escaped.
    pub fn add(&mut self, folder: &OutputFolder, name: &str, text: &str) {
        let text = printable(text).into_owned();
        let path = folder.path().join(name);
        self.files.push((path, Some(text.into_bytes())));
    }

    /// Adds bytes as they are.
    pub fn add_bytes(&mut self, folder: &OutputFolder, name: impl AsRef<Path>, bytes: Vec<u8>) {
        self.files.push((folder.path().join(name), Some(bytes)));
    }

    /// Adds a figure as `name.svg` and `name.png`.
    ///
    /// # Errors
    /// [`OutputError::Figure`].
    pub fn add_figure(
        &mut self,
        folder: &OutputFolder,
        name: &str,
        figure: &Figure,
    ) -> Result<(), OutputError> {
        let picture = folder.path().join(format!("{name}.png"));
        let pixels = figure.png().map_err(|cause| OutputError::Figure {
            path: picture.clone(),
            cause,
        })?;
        self.add(folder, &format!("{name}.svg"), &figure.svg());
        self.files.push((picture, Some(pixels)));
        Ok(())
    }

    /// The file `name` of an earlier set is not to be there, for it belongs to that.
    pub fn without(&mut self, folder: &OutputFolder, name: &str) {
        self.files.push((folder.path().join(name), None));
    }

    /// Writes all of them; their paths are returned.
    ///
    /// # Errors
    /// [`OutputError::File`]. Where a file cannot be written, or something stands in its place that is
    /// no file, all are as they were.
    pub fn write(self) -> Result<Vec<PathBuf>, OutputError> {
        let failed = |path: &Path| {
            let path = path.to_path_buf();
            |cause: io::Error| OutputError::File { path, cause }
        };
        let mut written = Vec::new();
        for (path, contents) in &self.files {
            replaceable(path).map_err(failed(path))?;
            if let Some(contents) = contents {
                let file = Unnamed::write(path, contents).map_err(failed(path))?;
                written.push((path, contents, file));
            }
        }
        settled(|| {
            let mut named = Vec::new();
            for (path, contents, file) in written {
                named.push((path, file.name(path, contents).map_err(failed(path))?));
            }
            let first = named.first().map(|(path, _)| *path);
            for (path, _) in self.files.iter().filter(|(path, _)| Some(path) != first) {
                match std::fs::remove_file(path) {
                    Err(error) if error.kind() != ErrorKind::NotFound => {
                        return Err(failed(path)(error));
                    }
                    _ => {}
                }
            }
            for (path, file) in named {
                let renamed = file.persist(path);
                renamed.map_err(|error| failed(path)(error.error))?;
            }
            Ok(())
        })?;
        let there = self.files.into_iter();
        Ok(there
            .filter_map(|(path, contents)| contents.map(|_| path))
            .collect())
    }
}

/// Whether a file can take the place of what is at `path`: of a file or of a link to one, which is taken
/// away and not followed, but never of a device or a pipe.
fn replaceable(path: &Path) -> io::Result<()> {
    match path.metadata() {
        Ok(found) if found.is_dir() => Err(ErrorKind::IsADirectory.into()),
        Ok(found) if !found.is_file() => Err(io::Error::other(
            "a device or a pipe stands there; expected a regular file, or none",
        )),
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// A file that has no name in its folder, or one that goes with it.
enum Unnamed {
    /// Without any name.
    File(File),
    /// Where the file system cannot do that.
    Temporary(NamedTempFile),
}

impl Unnamed {
    /// Writes `contents` in the folder of `path`.
    fn write(path: &Path, contents: &[u8]) -> io::Result<Self> {
        let folder = folder_of(path);
        let flags = OFlags::TMPFILE | OFlags::WRONLY | OFlags::CLOEXEC;
        // A result is as open as any new file.
        match rustix::fs::open(folder, flags, Mode::from_raw_mode(0o666)) {
            Ok(descriptor) => {
                let mut file = File::from(descriptor);
                file.write_all(contents)?;
                Ok(Self::File(file))
            }
            Err(_) => temporary(folder, contents).map(Self::Temporary),
        }
    }

    /// Gives it a name of its own beside `path`; `contents` are what it holds.
    fn name(self, path: &Path, contents: &[u8]) -> io::Result<TempPath> {
        let file = match self {
            Self::Temporary(file) => return Ok(file.into_temp_path()),
            Self::File(file) => file,
        };
        let own = format!("/proc/self/fd/{}", file.as_raw_fd());
        let link = |name: &Path| {
            linkat(CWD, &own, CWD, name, AtFlags::SYMLINK_FOLLOW).map_err(io::Error::from)
        };
        match prefixed().make_in(folder_of(path), link) {
            Ok(named) => Ok(named.into_temp_path()),
            // Not every file system gives a name to what has none.
            Err(_) => Ok(temporary(folder_of(path), contents)?.into_temp_path()),
        }
    }
}

/// A file with a name of its own in `folder`.
fn temporary(folder: &Path, contents: &[u8]) -> io::Result<NamedTempFile> {
    let permissions = Permissions::from_mode(0o666);
    let mut file = prefixed().permissions(permissions).tempfile_in(folder)?;
    file.write_all(contents)?;
    Ok(file)
}

fn prefixed() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".ffsm-");
    builder
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_set_is_written_as_a_whole_or_not_at_all() {
        let place = tempfile::tempdir().unwrap();
        let folder = OutputFolder::create(place.path()).unwrap();
        let write = |a: &str, b: Option<&str>| {
            let mut set = FileSet::new();
            set.add(&folder, "a", a);
            match b {
                Some(b) => set.add(&folder, "b", b),
                None => set.without(&folder, "b"),
            }
            set.write()
        };
        let read = |name: &str| std::fs::read_to_string(place.path().join(name)).unwrap();
        assert_eq!(write("1", Some("1")).unwrap().len(), 2);
        assert_eq!(write("2", None).unwrap().len(), 1);
        assert_eq!(names(place.path()), ["a"]);
        std::fs::create_dir(place.path().join("b")).unwrap();
        let error = write("3", Some("3")).unwrap_err().to_string();
        assert!(error.contains("/b: cannot be written: "), "{error}");
        std::fs::remove_dir(place.path().join("b")).unwrap();
        std::os::unix::fs::symlink("/dev/null", place.path().join("b")).unwrap();
        let error = write("3", Some("3")).unwrap_err().to_string();
        assert!(error.contains("a device or a pipe"), "{error}");
        assert_eq!(
            (read("a").as_str(), names(place.path())),
            ("2", vec!["a".into(), "b".into()])
        );
    }

    #[test]
    fn a_new_file_is_as_open_as_any() {
        let place = tempfile::tempdir().unwrap();
        let folder = OutputFolder::create(place.path()).unwrap();
        let mut set = FileSet::new();
        set.add(&folder, "a", "\u{1b}");
        set.write().unwrap();
        std::fs::write(place.path().join("b"), "").unwrap();
        let mode = |name| {
            std::fs::metadata(place.path().join(name))
                .unwrap()
                .permissions()
                .mode()
        };
        assert_eq!(mode("a"), mode("b"));
        assert_eq!(
            std::fs::read_to_string(place.path().join("a")).unwrap(),
            "\\u001b"
        );
    }
}
