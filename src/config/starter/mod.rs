//! A first problem for a robot of one's own: what its URDF file has, and a task that can be
//! planned.

mod choice;
mod posture;
mod text;

use super::appearance::Appearance;
use super::robot::Outline;
use super::robot_file::RobotFile;
use super::surface::{SurfaceCopies, copies};
use super::{ConfigError, ProblemFile};
use crate::dynamics::{JointKind, JointLimits};
use choice::Choice;
use std::path::Path;
use text::Remedies;

/// A first problem for a robot, with what was chosen.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Starter {
    /// The problem file, which names the robot's file as it was asked to.
    pub problem: String,
    /// Name of the robot.
    pub robot: String,
    /// Joints that are not fixed, depth-first.
    pub joints: Vec<StarterJoint>,
    /// Every link.
    pub links: Vec<String>,
    /// The link that is the base, and the mass of the spacecraft under it, kg, where it gets one.
    pub base: (String, Option<f64>),
    /// The link at whose frame the end effector is.
    pub end_effector: String,
    /// Mass of the robot, without that spacecraft, kg.
    pub mass: f64,
    /// Whether all its motion stays in one plane.
    pub is_planar: bool,
    /// What is changed of the robot, a line each.
    pub repairs: Vec<String>,
    appearance: Appearance,
    /// The robot's file where it was read.
    source: RobotFile,
}

/// A joint of the robot.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StarterJoint {
    /// Name.
    pub name: String,
    /// Turn or slide.
    pub kind: JointKind,
    /// As the file gives them.
    pub limits: JointLimits,
    /// The link that it moves.
    pub link: String,
    /// Where it is held, rad or m, in the problem; `None` for one that moves.
    pub locked: Option<f64>,
}

impl Starter {
    /// The first problem for the robot in the URDF file at `path`, which the problem calls `file`.
    ///
    /// # Errors
    /// [`ConfigError`] where the file cannot be read as a robot, or not planned for: the message
    /// has all that is wrong with it.
    pub fn of_urdf(path: &Path, file: &str) -> Result<Self, ConfigError> {
        let outline = Outline::load(path)?;
        let choice = Choice::of(&outline);
        let mut last = None;
        for remedies in Remedies::tried(&outline) {
            // At some postures massless links make joints interchangeable.
            for attempt in 0..posture::ATTEMPTS {
                let ends = posture::ends(&outline, &choice, attempt);
                let problem = text::problem(&outline, &choice, &remedies, &ends, file);
                let robot = (file, outline.text.as_str());
                match ProblemFile::restore(("problem.toml", &problem), robot, &[]) {
                    Ok(read) => return Ok(Self::new(path, outline, choice, read)),
                    // What nothing but a change of the file mends.
                    Err(error) => last = Some(error),
                }
            }
        }
        Err(last.expect("one try at least"))
    }

    /// The surfaces that the page of a plan draws of this robot. A copy of its file needs them too.
    pub fn surfaces(&self) -> SurfaceCopies {
        let drawing = self.appearance.drawing(&self.source);
        copies(Path::new(&self.source.path), &drawing)
    }

    fn new(path: &Path, outline: Outline, choice: Choice, read: ProblemFile) -> Self {
        let joints = outline.joints.into_iter().zip(&choice.locked);
        let joints = joints.map(|(joint, &locked)| StarterJoint {
            name: joint.name,
            kind: joint.kind,
            limits: joint.limits,
            link: joint.link,
            locked,
        });
        Self {
            problem: read.text,
            robot: outline.name,
            joints: joints.collect(),
            source: RobotFile {
                path: path.display().to_string(),
                text: outline.text,
            },
            appearance: read.appearance,
            links: outline.links.into_iter().map(|(name, _)| name).collect(),
            base: (outline.root, choice.spacecraft),
            end_effector: choice.end_effector,
            mass: read.problem.robot.total_mass() - choice.spacecraft.unwrap_or(0.0),
            is_planar: read.problem.robot.plane().is_some(),
            repairs: read.repairs,
        }
    }
}
