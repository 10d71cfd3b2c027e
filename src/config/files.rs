//! Where files are read from: the disk, those shipped inside the program, texts kept elsewhere.

use std::path::Path;

/// Where the files of a problem are read from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Files<'a> {
    /// The file system.
    Disk,
    /// The files shipped with the program, by their paths in the source tree.
    Shipped,
    /// Texts kept elsewhere, by their paths.
    Kept(&'a [(&'a str, &'a str)]),
}

/// The shipped files by their paths.
const SHIPPED: [(&str, &str); 7] = [
    (
        "config/table1.toml",
        include_str!("../../config/table1.toml"),
    ),
    (
        "config/table1-relaxed.toml",
        include_str!("../../config/table1-relaxed.toml"),
    ),
    (
        "config/table1-smooth.toml",
        include_str!("../../config/table1-smooth.toml"),
    ),
    (
        "config/chaser-7dof.toml",
        include_str!("../../config/chaser-7dof.toml"),
    ),
    (
        "config/chaser-7dof-heavy.toml",
        include_str!("../../config/chaser-7dof-heavy.toml"),
    ),
    (
        "config/robots/chaser-7dof.urdf",
        include_str!("../../config/robots/chaser-7dof.urdf"),
    ),
    (
        "config/robots/planar-2link.toml",
        include_str!("../../config/robots/planar-2link.toml"),
    ),
];

impl Files<'_> {
    /// The text of a file, or why there is none.
    pub(super) fn read(self, path: &Path) -> Result<String, String> {
        match self {
            Self::Disk => {
                let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
                String::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".into())
            }
            Self::Shipped => SHIPPED
                .iter()
                .find(|(name, _)| Path::new(name) == path)
                .map(|(_, text)| text.to_string())
                .ok_or_else(|| "it is not shipped with the program".into()),
            Self::Kept(texts) => texts
                .iter()
                .find(|(name, _)| Path::new(name) == path)
                .map(|(_, text)| text.to_string())
                .ok_or_else(|| "its text was not kept".into()),
        }
    }
}
