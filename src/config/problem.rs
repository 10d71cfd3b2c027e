//! The problem file.

use super::document::{Node, quoted};
use super::files::Files;
use super::item::{Item, Section};
use super::robot::{self, Robot, RobotFile};
use super::values::Components;
use super::{ConfigError, Overrides, Place, base, tables};
use crate::problem::{Problem, ProblemError};
use std::path::Path;

/// A problem and the files it was read from.
#[derive(Debug, Clone)]
pub struct ProblemFile {
    /// The problem, validated.
    pub problem: Problem,
    /// Path of the problem file, as given.
    pub path: String,
    /// Its text.
    pub text: String,
    /// The options of the command line that were laid over it, as written.
    pub overrides: Vec<String>,
    /// The robot's file.
    pub robot: RobotFile,
    /// The body at whose frame the end effector is; `None` where the robot has none.
    pub end_effector: Option<String>,
    /// What a user should know of how the files were read, though nothing is wrong; a line each.
    pub notes: Vec<String>,
    document: Node,
}

impl ProblemFile {
    /// Reads and validates the problem file at `path`.
    ///
    /// # Errors
    /// [`ConfigError`] for the first thing found wrong in it, in the robot's file or in
    /// `overrides`.
    pub fn load(path: &Path, overrides: &Overrides) -> Result<Self, ConfigError> {
        Self::read(path, Files::Disk, overrides)
    }

    /// One of the problems shipped in `config/`, by name ("table1-relaxed").
    ///
    /// # Errors
    /// [`ConfigError`] where there is none of that name.
    pub fn shipped(name: &str) -> Result<Self, ConfigError> {
        let path = format!("config/{name}.toml");
        Self::read(Path::new(&path), Files::Shipped, &Overrides::default())
    }

    /// The problem again of which a solution keeps the texts: problem file and robot file, each
    /// by its path, and the options of the command line as written.
    ///
    /// # Errors
    /// [`ConfigError`] where the texts no longer make a problem.
    pub fn restore(
        problem: (&str, &str),
        robot: (&str, &str),
        options: &[String],
    ) -> Result<Self, ConfigError> {
        let texts = [problem, robot];
        Self::read(
            Path::new(problem.0),
            Files::Kept(&texts),
            &Overrides::replay(options)?,
        )
    }

    pub(super) fn read(
        path: &Path,
        files: Files<'_>,
        overrides: &Overrides,
    ) -> Result<Self, ConfigError> {
        let source = files.document(path, "a problem file")?;
        let mut document = source.document;
        overrides.apply(&mut document)?;
        let (problem, robot, note) = read(&document, path, files)?;
        let file = Self {
            notes: robot.notes(&problem).into_iter().chain(note).collect(),
            end_effector: robot.end_effector(),
            problem,
            path: source.path,
            text: source.text,
            overrides: overrides.flags(),
            robot: robot.file,
            document,
        };
        file.problem.validate().map_err(|error| file.blame(error))?;
        file.refuse_singular()?;
        Ok(file)
    }

    /// Refuses a start or goal at which joints can move without moving any mass, as with bodies
    /// that have none: no torque belongs to a motion there.
    fn refuse_singular(&self) -> Result<(), ConfigError> {
        let Problem { robot, task, .. } = &self.problem;
        let mut ends = vec![(
            "task.initial.joints".to_owned(),
            task.initial_joints.clone(),
        )];
        for (i, point) in task.way_points.iter().enumerate() {
            if let Some(joints) = point.joints.iter().copied().collect() {
                ends.push((format!("task.way_points[{i}].joints"), joints));
            }
        }
        if !task.free_joints.contains(&true) {
            ends.push(("task.final.joints".to_owned(), task.final_joints.clone()));
        }
        for (key, joints) in ends {
            if let Some(joint) = robot.inert_joint(&joints) {
                return Err(self.blame(ProblemError {
                    key,
                    found: format!(
                        "joint '{}' can move there without moving any mass",
                        robot.joints()[joint].name
                    ),
                    expected: "positions at which bodies without mass do not make joints \
                               interchangeable"
                        .into(),
                }));
            }
        }
        Ok(())
    }

    /// Where a key (`limits.joint_velocity[1]`) is given, or the nearest table around it.
    pub fn place(&self, key: &str) -> Place {
        self.document.locate(key)
    }

    /// An error of the problem, with the place of its key.
    pub fn blame(&self, error: ProblemError) -> ConfigError {
        let ProblemError {
            key,
            found,
            expected,
        } = error;
        ConfigError::Value {
            place: self.place(&key),
            key,
            found,
            expected,
        }
    }
}

/// The problem, its robot, and what a user should know of the rest.
fn read(
    document: &Node,
    path: &Path,
    files: Files<'_>,
) -> Result<(Problem, Robot, Option<String>), ConfigError> {
    let root = Item::root(document).section(&[
        "schema", "name", "robot", "base", "task", "limits", "cost", "mesh", "solver",
    ])?;
    super::schema(&root)?;
    let name = name(&root, path)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let expected = "the path of a robot file, relative to this one";
    let mut robot = robot::read(root.require("robot", expected)?, folder, &files)?;
    let attitude = match root.get("base") {
        Some(item) => base::read(item, &mut robot)?,
        None => None,
    };
    let model = robot.model()?;

    let (angles, lengths) = Problem::base_sizes(&model);
    let names = model
        .joints()
        .iter()
        .map(|joint| joint.name.clone())
        .collect();
    let joints = Components {
        what: "joint",
        names,
        single: None,
    };
    let angles = Components::angles(angles);
    let lengths = Components::lengths(lengths);

    let expected = "a table with duration, initial and final";
    let task = tables::task(root.require("task", expected)?, &joints, &angles, &lengths)?;
    let mut problem = Problem::new(&name, model, task.duration.lower, &[], &[]);
    problem.task = task;
    problem.set_attitude(attitude.unwrap_or_default());
    let whole = problem.attitude_sizes().1 < angles.names.len();
    let base = tables::BaseComponents {
        attitude: if whole {
            Components::rotation_angle()
        } else {
            angles.clone()
        },
        rate: if whole { Components::axes() } else { angles },
        position: lengths,
    };
    if let Some(item) = root.get("limits") {
        tables::limits(item, &mut problem.limits, &robot, &joints, &base)?;
    }
    if let Some(item) = root.get("cost") {
        tables::cost(item, &mut problem.cost, &joints, &base)?;
    }
    if let Some(item) = root.get("mesh") {
        tables::mesh(item, &mut problem.mesh)?;
    }
    if let Some(item) = root.get("solver") {
        tables::solver(item, &mut problem.solver)?;
    }
    let note = attitude
        .filter(|_| problem.robot.plane().is_some())
        .map(|_| {
            let place = document.locate("base.attitude");
            format!(
                "{place}: base.attitude: left aside, the robot is planar and its attitude one angle"
            )
        });
    Ok((problem, robot, note))
}

/// The name, which names the output folder as well; that of the file unless given.
pub(super) fn name(root: &Section<'_>, path: &Path) -> Result<String, ConfigError> {
    let Some(item) = root.get("name") else {
        let stem = path
            .file_stem()
            .map(|stem| stem.to_string_lossy().into_owned());
        return Ok(stem.unwrap_or_else(|| "problem".into()));
    };
    let name = item.text("a string")?;
    let harmless = |c: char| c.is_alphanumeric() || "-_. ".contains(c);
    if name.trim() != name || name.trim_matches('.').is_empty() || !name.chars().all(harmless) {
        let expected = "letters, digits, '-', '_' and '.', for it names the output folder";
        return Err(item.error(quoted(name), expected));
    }
    Ok(name.into())
}
