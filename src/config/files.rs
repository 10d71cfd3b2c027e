//! Where files are read from: the disk, those shipped inside the program, texts kept elsewhere.

use super::document::Node;
use super::{ConfigError, Place, regular, xml_text};
use std::path::{Component, Path, PathBuf};

/// Largest file of a problem, a robot or a platform, bytes.
const LARGEST: u64 = 32 << 20;

/// Where the files of a problem are read from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Files<'a> {
    /// The file system.
    Disk,
    /// The files shipped with the program, by their paths in the source tree.
    Shipped,
    /// Texts kept elsewhere, by their paths.
    Kept(&'a [(&'a str, &'a str)]),
    /// Texts read from the disk before, by their paths; other files from there.
    Held(&'a [(&'a str, &'a str)]),
}

/// The shipped files by their paths.
const SHIPPED: [(&str, &str); 13] = [
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
    (
        "config/table1-heavy-base.toml",
        include_str!("../../config/table1-heavy-base.toml"),
    ),
    (
        "config/robots/planar-2link-heavy-base.toml",
        include_str!("../../config/robots/planar-2link-heavy-base.toml"),
    ),
    (
        "config/platforms/air-bearing.toml",
        include_str!("../../config/platforms/air-bearing.toml"),
    ),
    (
        "config/platforms/ideal.toml",
        include_str!("../../config/platforms/ideal.toml"),
    ),
    (
        "config/platforms/published.toml",
        include_str!("../../config/platforms/published.toml"),
    ),
    (
        "config/platforms/published-heavy-base.toml",
        include_str!("../../config/platforms/published-heavy-base.toml"),
    ),
];

/// A TOML file that was read.
pub(super) struct Source {
    /// Its path, as given.
    pub path: String,
    pub text: String,
    pub document: Node,
}

impl Files<'_> {
    /// Reads and parses a file; `expected` says what it should be.
    pub(super) fn document(
        self,
        path: &Path,
        expected: &'static str,
    ) -> Result<Source, ConfigError> {
        let source = path.display().to_string();
        let text = self.read(path).map_err(|reason| ConfigError::Unreadable {
            place: Place {
                source: source.as_str().into(),
                line: None,
            },
            reason,
            expected,
        })?;
        let document = Node::parse(&source.as_str().into(), &text)?;
        Ok(Source {
            path: source,
            text,
            document,
        })
    }

    /// The text of a file, or why there is none.
    pub(super) fn read(self, path: &Path) -> Result<String, String> {
        self.read_as(path, |bytes| {
            String::from_utf8(bytes).map_err(|_| "it is not UTF-8 text".into())
        })
    }

    /// The text of an XML file, which may be in another encoding than UTF-8, or why there is none.
    pub(super) fn read_xml(self, path: &Path) -> Result<String, String> {
        self.read_as(path, xml_text::decode)
    }

    fn read_as(
        self,
        path: &Path,
        decode: fn(Vec<u8>) -> Result<String, String>,
    ) -> Result<String, String> {
        match self {
            Self::Disk => decode(regular::read(path, LARGEST)?),
            Self::Held(texts) => match texts.iter().find(|(name, _)| Path::new(name) == path) {
                Some((_, text)) => Ok(text.to_string()),
                None => Self::Disk.read_as(path, decode),
            },
            Self::Shipped => SHIPPED
                .iter()
                .find(|(name, _)| Path::new(name) == without_parents(path))
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

/// The path without `..` where a folder stands before it. On a disk that may lead elsewhere, for the
/// folder may be a link: for files that are shipped, and to show a path.
pub(super) fn without_parents(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        let below = matches!(plain.components().next_back(), Some(Component::Normal(_)));
        if part == Component::ParentDir && below {
            plain.pop();
        } else {
            plain.push(part);
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parents_are_taken_back_as_far_as_folders_are_known() {
        for (path, plain) in [
            ("config/platforms/../table1.toml", "config/table1.toml"),
            ("../a/b/../../c", "../c"),
            ("../../c", "../../c"),
            ("a/./b", "a/b"),
        ] {
            assert_eq!(without_parents(Path::new(path)), Path::new(plain), "{path}");
        }
    }
}
