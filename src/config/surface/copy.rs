//! Surfaces that go with a copy of the URDF that names them.

use super::{LARGEST, LARGEST_SUM, locate, parser};
use crate::config::appearance::{Drawing, Form};
use crate::config::regular;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

/// Most files of a robot: the page draws no more parts than that.
const MOST_FILES: usize = 300;

/// Surfaces that go with a copy of a URDF.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct SurfaceCopies {
    /// Those that there are.
    pub files: Vec<SurfaceCopy>,
    /// A line for each that cannot go with it.
    pub complaints: Vec<String>,
}

/// A surface that goes with a copy of a URDF.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct SurfaceCopy {
    /// Where it is, links followed.
    pub source: PathBuf,
    /// Where it has to lie for the copy to find it: below the copy's folder, without any `..`.
    pub place: PathBuf,
    /// The file's bytes.
    pub bytes: Vec<u8>,
}

/// The surfaces that `drawing` has of the URDF at `urdf`.
pub(in crate::config) fn copies(urdf: &Path, drawing: &Drawing) -> SurfaceCopies {
    let mut found = SurfaceCopies {
        complaints: drawing.complaints.clone(),
        ..SurfaceCopies::default()
    };
    let (mut seen, mut taken) = (HashSet::new(), HashMap::new());
    let mut left = LARGEST_SUM;
    for drawn in &drawing.parts {
        let Form::File { name, .. } = &drawn.part.form else {
            continue;
        };
        if !seen.insert(name) {
            continue;
        }
        match copy(urdf, name, &mut taken, &mut left) {
            Ok(copy) => found.files.extend(copy),
            Err(why) => {
                let link = &drawn.part.link;
                found
                    .complaints
                    .push(format!("link '{link}': {name}: {why}"));
            }
        }
    }
    found.complaints.dedup();
    found
}

/// The file of that name, or none if it is among the `taken` already: places, and what lies there.
/// `left` is what the files may have together, bytes.
fn copy(
    urdf: &Path,
    name: &str,
    taken: &mut HashMap<PathBuf, PathBuf>,
    left: &mut u64,
) -> Result<Option<SurfaceCopy>, String> {
    let source = locate::file(urdf, name)?;
    parser(&source)?;
    let place = locate::beside(name).ok_or("expected a path relative to the URDF")?;
    match taken.get(&place) {
        Some(there) if *there == source => return Ok(None),
        Some(_) => {
            return Err(format!(
                "another file goes to its place, {}",
                place.display()
            ));
        }
        None if taken.len() == MOST_FILES => {
            return Err(format!("expected at most {MOST_FILES} files"));
        }
        None => {}
    }
    let bytes = regular::read(&source, LARGEST.min(*left))?;
    *left -= bytes.len() as u64;
    taken.insert(place.clone(), source.clone());
    Ok(Some(SurfaceCopy {
        source,
        place,
        bytes,
    }))
}
