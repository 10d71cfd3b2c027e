//! Surfaces of links, which URDF files name by their files. Such a file may come from anywhere: it has
//! to be a regular file of a sane size in the folder or package of the robot's, and nothing in it is
//! taken on trust.

mod copy;
mod dae;
mod locate;
mod obj;
mod stl;

use super::files::Files;
use super::regular;
use super::robot_file::RobotFile;
use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub(super) use copy::copies;
pub use copy::{SurfaceCopies, SurfaceCopy};

/// Largest file, bytes.
const LARGEST: u64 = 64 << 20;
/// Bytes that all files of a robot have together.
const LARGEST_SUM: u64 = 256 << 20;
/// Most triangles of a surface.
const MOST_TRIANGLES: usize = 2_000_000;

/// Triangles.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Surface {
    /// Coordinates.
    pub vertices: Vec<[f64; 3]>,
    /// Numbers of vertices, all of them below their count.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Adds a vertex; its number is returned.
    fn vertex(&mut self, at: [f64; 3]) -> Result<u32, String> {
        if at
            .iter()
            .any(|value| !value.is_finite() || value.abs() > 1e9)
        {
            return Err("a vertex is not finite, or far away; expected lengths".into());
        }
        let number = u32::try_from(self.vertices.len()).map_err(|_| too_many())?;
        self.vertices.push(at);
        Ok(number)
    }

    /// Adds a triangle of vertices that are there.
    fn triangle(&mut self, corners: [u32; 3]) -> Result<(), String> {
        if self.triangles.len() == MOST_TRIANGLES {
            return Err(too_many());
        }
        self.triangles.push(corners);
        Ok(())
    }

    /// The surface if there is one.
    fn if_any(self) -> Result<Self, String> {
        match self.triangles.is_empty() {
            true => Err("no triangle is in it".into()),
            false => Ok(self),
        }
    }
}

fn too_many() -> String {
    format!("too many triangles; expected at most {MOST_TRIANGLES}")
}

type Found = Result<Arc<Surface>, String>;
type Parser = fn(&[u8]) -> Result<Surface, String>;

/// Surfaces that a robot's file may name.
pub(super) struct Shelf {
    /// The robot's file, if it is still there.
    robot: Result<PathBuf, String>,
    left: Cell<u64>,
    /// Those that were read, for links often share one.
    read: RefCell<HashMap<PathBuf, Found>>,
}

impl Shelf {
    /// Of the file of this robot.
    pub(super) fn of(robot: &RobotFile) -> Self {
        let path = Path::new(&robot.path);
        let there = match Files::Disk.read_xml(path) {
            Ok(text) if text == robot.text => Ok(path.to_path_buf()),
            Ok(_) => Err(format!("not looked for: {} has changed", robot.path)),
            Err(_) => Err(format!("not looked for: {} is not there", robot.path)),
        };
        Self {
            robot: there,
            left: Cell::new(LARGEST_SUM),
            read: RefCell::default(),
        }
    }

    /// The surface in the file of this name, or why there is none.
    pub(super) fn surface(&self, name: &str) -> Found {
        let path = locate::file(self.robot.as_ref()?, name)?;
        let mut known = self.read.borrow_mut();
        known
            .entry(path)
            .or_insert_with_key(|path| self.load(path))
            .clone()
    }

    fn load(&self, path: &Path) -> Found {
        let parse = parser(path)?;
        let bytes = regular::read(path, LARGEST.min(self.left.get()))?;
        self.left.set(self.left.get() - bytes.len() as u64);
        parse(&bytes)?.if_any().map(Arc::new)
    }
}

/// What reads a file of that name, by its ending.
fn parser(path: &Path) -> Result<Parser, String> {
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    match ending.to_str() {
        Some("stl") => Ok(stl::parse),
        Some("obj") => Ok(obj::parse),
        Some("dae") => Ok(dae::parse),
        _ => Err("expected a file that ends in .stl, .obj or .dae".into()),
    }
}

#[cfg(test)]
mod tests;
