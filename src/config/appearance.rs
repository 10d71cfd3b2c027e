//! What a robot looks like, as its file says: nothing that a plan depends on.

use super::robot_file::RobotFile;
use super::surface::{Shelf, Surface};
use crate::dynamics::Placement;
use std::sync::Arc;

/// What the bodies of a robot look like; empty where its file says nothing of it.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Appearance {
    /// Parts of bodies, those of one link one after another.
    pub parts: Vec<Part>,
    /// Whether the problem has put a spacecraft under the base, of which nothing is known but its mass
    /// properties.
    pub has_spacecraft: bool,
}

/// A part of a link.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Part {
    /// Name of the link.
    pub link: String,
    /// The joint whose body carries the link; `None` for the base.
    pub joint: Option<usize>,
    /// From the part's own frame to that body's, m.
    pub placement: Placement,
    /// What it is.
    pub form: Form,
    /// Red, green and blue, from 0 to 1, where the file gives it a colour.
    pub colour: Option<[f64; 3]>,
    /// Whether it says what the link fills, not what it looks like.
    pub is_collision: bool,
}

/// The form of a part, in a frame of its own.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Form {
    /// A box about the origin, by its half edges, m.
    Box([f64; 3]),
    /// A cylinder about the z axis, the origin in its middle.
    Cylinder {
        /// m
        radius: f64,
        /// m
        half_length: f64,
    },
    /// A sphere about the origin, by its radius, m.
    Sphere(f64),
    /// A surface in a file of its own.
    File {
        /// As the robot's file names it.
        name: String,
        /// Factors on its coordinates.
        scale: [f64; 3],
    },
}

/// A part with its surface, where it has one in a file.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Drawn {
    /// The part.
    pub part: Part,
    /// Its surface as in its file, before the factors of [`Form::File`], which take it to metres;
    /// `None` for boxes, cylinders and spheres. Parts that name the same file share it.
    pub surface: Option<Arc<Surface>>,
}

/// What can be drawn of a robot.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct Drawing {
    /// The parts.
    pub parts: Vec<Drawn>,
    /// A line for each part that cannot be drawn.
    pub complaints: Vec<String>,
    /// As of [`Appearance::has_spacecraft`].
    pub has_spacecraft: bool,
}

impl Appearance {
    /// What can be drawn: of a link what it looks like, or where none of that can be read, what it
    /// fills. `robot` is the file that this was read from; surfaces are read only if it is still at its
    /// path, and only from its folder or package.
    pub fn drawing(&self, robot: &RobotFile) -> Drawing {
        let shelf = Shelf::of(robot);
        let (mut drawn, mut complaints) = (Vec::new(), Vec::new());
        let mut rest = &self.parts[..];
        while let Some(first) = rest.first() {
            let of_link = rest.iter().take_while(|part| part.link == first.link);
            let (link, others) = rest.split_at(of_link.count());
            rest = others;
            let mut of = |is_collision: bool| -> Vec<Drawn> {
                let parts = link.iter().filter(|part| part.is_collision == is_collision);
                let read = parts.map(|part| part.drawn(&shelf));
                let (good, bad): (Vec<_>, Vec<_>) = read.partition(Result::is_ok);
                complaints.extend(bad.into_iter().filter_map(Result::err));
                good.into_iter().flatten().collect()
            };
            let mut found = of(false);
            if found.is_empty() {
                found = of(true);
            }
            drawn.append(&mut found);
        }
        complaints.dedup();
        Drawing {
            parts: drawn,
            complaints,
            has_spacecraft: self.has_spacecraft,
        }
    }
}

impl Part {
    fn drawn(&self, shelf: &Shelf) -> Result<Drawn, String> {
        let surface = match &self.form {
            Form::File { name, .. } => {
                let surface = shelf.surface(name);
                Some(surface.map_err(|why| format!("link '{}': {name}: {why}", self.link))?)
            }
            _ => None,
        };
        Ok(Drawn {
            part: self.clone(),
            surface,
        })
    }
}
