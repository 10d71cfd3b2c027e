//! Where a file is that a URDF names: in the URDF's own folder, or in the package the URDF belongs to.

use crate::config::files::without_parents;
use std::path::{Component, Path, PathBuf};

/// Folders above a URDF that are searched for its package.
const MOST_ABOVE: usize = 8;
/// What says that a folder is a package.
const PACKAGE: &str = "package.xml";
/// What the names of files in packages begin with.
const SCHEMES: [&str; 2] = ["package://", "model://"];

/// Where the file `name` of a URDF lies beside a copy of the URDF, below its folder; `None` for a name
/// that holds in one place alone.
pub(super) fn beside(name: &str) -> Option<PathBuf> {
    let mut schemes = SCHEMES.iter().chain(&["file://"]);
    let rest = schemes.find_map(|scheme| name.strip_prefix(scheme));
    let path = Path::new(rest.unwrap_or(name));
    if path.is_absolute() {
        return None;
    }
    let plain = without_parents(path);
    let parts = plain.components();
    let below: PathBuf = parts
        .filter(|part| matches!(part, Component::Normal(_)))
        .collect();
    below.file_name().is_some().then_some(below)
}

/// The file `name` of the URDF at `urdf`, links followed.
pub(super) fn file(urdf: &Path, name: &str) -> Result<PathBuf, String> {
    let whole = |path: &Path| path.canonicalize().map_err(|error| error.to_string());
    let folder = match urdf.parent() {
        Some(parent) if parent != Path::new("") => whole(parent)?,
        _ => whole(Path::new("."))?,
    };
    let is_package = |path: &&Path| path.join(PACKAGE).is_file();
    let above = || folder.ancestors().take(MOST_ABOVE);
    let in_package = SCHEMES.iter().find_map(|scheme| name.strip_prefix(scheme));
    // Folders to stay in, and the file in each.
    let mut places: Vec<(PathBuf, PathBuf)> = match in_package {
        Some(rest) => {
            let (package, rest) = rest.split_once('/').ok_or("expected package://NAME/PATH")?;
            let named = |path: &&Path| path.file_name().is_some_and(|name| name == package);
            let own = above().filter(is_package).find(named);
            let own = own.map(|root| (root.to_path_buf(), root.join(rest)));
            let beside = [folder.join(package).join(rest), folder.join(rest)];
            let beside = beside.map(|path| (folder.clone(), path));
            own.into_iter().chain(beside).collect()
        }
        None => {
            let path = Path::new(name.strip_prefix("file://").unwrap_or(name));
            let root = above().find(is_package).unwrap_or(&folder);
            vec![(root.to_path_buf(), folder.join(path))]
        }
    };
    places.extend(beside(name).map(|path| (folder.clone(), folder.join(path))));
    let mut why = None;
    for (root, path) in places {
        match path.canonicalize() {
            Ok(path) if path.starts_with(&root) => return Ok(path),
            Ok(_) => {
                why = Some(format!("expected a file below {}", root.display()));
            }
            Err(_) => {}
        }
    }
    Err(why.unwrap_or_else(|| match in_package {
        Some(_) => "not found in the folder of the URDF, nor in the package above it".into(),
        None => "not found beside the URDF".into(),
    }))
}
