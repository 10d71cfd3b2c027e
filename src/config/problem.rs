//! The problem file.

use super::appearance::Appearance;
use super::document::{Node, quoted};
use super::faults::Faults;
use super::files::Files;
use super::item::{Item, Section};
use super::robot::{self, Robot};
use super::robot_file::RobotFile;
use super::trust::Origin;
use super::values::Components;
use super::{ConfigError, Overrides, Place, base, long_way, tables};
use crate::dynamics::Inertia;
use crate::problem::{EXPECTED_NAME, Problem, ProblemBuilder, ProblemError, is_name};
use crate::system::impossible;
use std::path::{Path, PathBuf};

/// A problem and the files it was read from.
#[derive(Debug, Clone)]
#[non_exhaustive]
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
    /// Mass properties of the bodies that `robot.bodies` changes, each in its own frame, as they went
    /// into the model.
    pub bodies: Vec<(String, Inertia)>,
    /// What the robot looks like.
    pub appearance: Appearance,
    /// What a user should know of how the files were read, though nothing is wrong; a line each.
    pub notes: Vec<String>,
    /// What was changed of the robot, as `robot.repair` or `robot.minimum_mass` asks or because
    /// `[base]` stands for the root link; a line each.
    pub repairs: Vec<String>,
    /// Mass properties of `[base]`, as they went into the model.
    pub(super) spacecraft: Option<Inertia>,
    document: Node,
}

/// Ipopt's tolerance, unless the file has one, as a part of the mesh's where that is small.
const SOLVER_TO_MESH: f64 = 1e-4;
/// The least of it: what rounding lets a solver reach.
const LEAST_SOLVER_TOLERANCE: f64 = 1e-12;

impl ProblemFile {
    /// Reads and validates the problem file at `path`, and asks whether its task can be carried out
    /// at all.
    ///
    /// # Errors
    /// [`ConfigError`] for what is found wrong in it, in the robot's file or in `overrides`.
    pub fn load(path: &Path, overrides: &Overrides) -> Result<Self, ConfigError> {
        let file = Self::read(path, Files::Disk, overrides)?;
        file.possible()?;
        Ok(file)
    }

    /// The problem that `text` describes, as if it stood in a file at `path`: the path of its robot is
    /// relative to that.
    ///
    /// # Errors
    /// As of [`ProblemFile::load`].
    pub fn of_text(path: &Path, text: &str, overrides: &Overrides) -> Result<Self, ConfigError> {
        let shown = path.display().to_string();
        let texts = [(shown.as_str(), text)];
        let file = Self::read(path, Files::Held(&texts), overrides)?;
        file.possible()?;
        Ok(file)
    }

    /// The problem again with `overrides` on top of those that it was made with. No file is read.
    ///
    /// # Errors
    /// As of [`ProblemFile::load`].
    pub fn edited(&self, overrides: &Overrides) -> Result<Self, ConfigError> {
        let texts = [
            (self.path.as_str(), self.text.as_str()),
            (self.robot.path.as_str(), self.robot.text.as_str()),
        ];
        let all = Overrides::replay(&self.overrides)?.and(overrides);
        let file = Self::read(Path::new(&self.path), Files::Held(&texts), &all)?;
        file.possible()?;
        Ok(file)
    }

    /// Asks whether the task can be carried out at all.
    ///
    /// # Errors
    /// [`ConfigError::Impossible`], or several of them, where no motion can do it.
    pub fn possible(&self) -> Result<(), ConfigError> {
        let mut faults = Faults::default();
        for cause in impossible(&self.problem) {
            let place = self.place(&cause.key());
            let cause = Box::new(cause);
            faults.push(ConfigError::Impossible { place, cause });
        }
        match faults.is_empty() {
            true => Ok(()),
            false => Err(faults.into_error(whole(&self.path))),
        }
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
        let source = (path.to_path_buf(), source.text);
        Self::of(document, source, files, overrides.flags())
    }

    /// The problem that `document` describes, which was made of the file with that path and text and
    /// of those options.
    pub(super) fn of(
        document: Node,
        (path, text): (PathBuf, String),
        files: Files<'_>,
        overrides: Vec<String>,
    ) -> Result<Self, ConfigError> {
        let shown = path.display().to_string();
        let (builder, robot, note) = read(&document, &path, files)?;
        let mut faults = Faults::default();
        for fault in builder.faults() {
            faults.push(blame(&document, fault));
        }
        if !faults.is_empty() {
            return Err(faults.into_error(whole(&shown)));
        }
        let problem = builder.build().map_err(|error| blame(&document, error))?;
        let long_way = long_way::notes(&problem, |key| document.locate(key).to_string());
        let notes = robot.notes(&problem).into_iter().chain(note);
        Ok(Self {
            notes: notes.chain(long_way).collect(),
            end_effector: robot.end_effector(),
            bodies: robot.changed().to_vec(),
            appearance: robot.appearance(),
            spacecraft: robot.spacecraft().cloned(),
            repairs: robot.changes,
            problem,
            path: shown,
            text,
            overrides,
            robot: robot.file,
            document,
        })
    }

    /// All values, each with its place.
    pub(super) fn document(&self) -> &Node {
        &self.document
    }

    /// Where a key (`limits.joint_velocity[1]`) is given, or the nearest table around it.
    pub fn place(&self, key: &str) -> Place {
        self.document.locate(key)
    }

    /// An error of the problem, with the place of its key.
    pub fn blame(&self, error: ProblemError) -> ConfigError {
        blame(&self.document, error)
    }
}

/// The whole of the file at `path`.
fn whole(path: &str) -> Place {
    Place {
        source: path.into(),
        line: None,
    }
}

/// An error of the problem that `document` describes, with the place of its key.
fn blame(document: &Node, error: ProblemError) -> ConfigError {
    let ProblemError {
        key,
        found,
        expected,
    } = error;
    ConfigError::Value {
        place: document.locate(&key),
        key,
        found,
        expected,
    }
}

/// The problem, its robot, and what a user should know of the rest.
fn read(
    document: &Node,
    path: &Path,
    files: Files<'_>,
) -> Result<(ProblemBuilder, Robot, Option<String>), ConfigError> {
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
    let mut problem = ProblemBuilder::of_task(&name, model, task);
    problem.set_attitude(attitude.unwrap_or_default());
    let rotation = problem.has_rotation_angle();
    let components = tables::EveryComponent {
        joint: joints,
        base_attitude: if rotation {
            Components::rotation_angle()
        } else {
            angles.clone()
        },
        base_rate: if rotation { Components::axes() } else { angles },
        base_position: lengths,
        base: Components::base(),
    };
    if let Some(item) = root.get("limits") {
        tables::limits(item, &mut problem.limits, &robot, &components)?;
    }
    if let Some(item) = root.get("cost") {
        tables::cost(item, &mut problem, &components)?;
    }
    if let Some(item) = root.get("mesh") {
        tables::mesh(item, &mut problem.mesh)?;
    }
    // What Ipopt leaves of its conditions is an error of the motion that no mesh takes away.
    let tolerance = SOLVER_TO_MESH * problem.mesh.tolerance;
    let own = problem.solver.tolerance;
    problem.solver.tolerance = own.min(tolerance.max(LEAST_SOLVER_TOLERANCE));
    if let Some(item) = root.get("solver") {
        let origin = match files {
            Files::Kept(_) => Origin::Kept,
            Files::Disk | Files::Shipped | Files::Held(_) => Origin::CommandLine,
        };
        tables::solver(item, &mut problem.solver, origin)?;
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
        return name_of(path);
    };
    match item.text("a string")? {
        name if is_name(name) => Ok(name.into()),
        name => Err(item.error(quoted(name), EXPECTED_NAME)),
    }
}

/// A name made of that of the file at `path`: what may not be in one is left out.
pub(super) fn name_of(path: &Path) -> Result<String, ConfigError> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let may_be = |c: char| if is_name(&format!("a{c}a")) { c } else { '-' };
    let name: String = stem.trim().chars().map(may_be).collect();
    if is_name(&name) {
        return Ok(name);
    }
    Err(ConfigError::Value {
        place: Place {
            source: path.display().to_string().into(),
            line: None,
        },
        key: "name".into(),
        found: format!("not given, and that of the file is {}", quoted(&stem)),
        expected: EXPECTED_NAME.into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PATH: &str = "config/table1-smooth.toml";

    fn text() -> String {
        std::fs::read_to_string(PATH).unwrap()
    }

    fn with(values: &[&str]) -> Overrides {
        let values: Vec<String> = values.iter().map(|value| value.to_string()).collect();
        Overrides::of(&values).unwrap()
    }

    #[test]
    fn a_text_is_the_file_that_it_stands_for() {
        let (path, overrides) = (Path::new(PATH), with(&["task.duration=25"]));
        let of_text = ProblemFile::of_text(path, &text(), &overrides).unwrap();
        let of_file = ProblemFile::load(path, &overrides).unwrap();
        assert_eq!(of_text.problem, of_file.problem);
        assert_eq!(of_text.text, of_file.text);
        assert_eq!(of_text.robot.text, of_file.robot.text);
    }

    #[test]
    fn the_solver_is_as_exact_as_the_mesh_asks() {
        for (values, tolerance) in [
            (&[][..], 1e-9),
            (&["mesh.tolerance=1e-3"], 1e-9),
            (&["mesh.tolerance=1e-7"], 1e-11),
            (&["mesh.tolerance=1e-10"], 1e-12),
            (&["mesh.tolerance=1e-7", "solver.tolerance=1e-8"], 1e-8),
        ] {
            let file = ProblemFile::load(Path::new(PATH), &with(values)).unwrap();
            let found = file.problem.solver.tolerance;
            assert!(
                (found / tolerance - 1.0).abs() < 1e-12,
                "{values:?}: {found}"
            );
        }
    }

    #[test]
    fn what_is_edited_reads_no_file_and_keeps_earlier_values() {
        // Where there is no robot's file any more.
        let first = ProblemFile::shipped("table1-smooth").unwrap();
        let first = ProblemFile {
            path: "nowhere/problem.toml".into(),
            text: first.text.replace("robots/", ""),
            robot: RobotFile {
                path: "nowhere/planar-2link.toml".into(),
                ..first.robot
            },
            ..first
        };
        let second = first.edited(&with(&["task.duration=25"])).unwrap();
        let third = second.edited(&with(&["mesh.points=7"])).unwrap();
        assert_eq!(third.problem.task.duration.lower, 25.0);
        assert_eq!(
            third.overrides,
            ["--set task.duration=25", "--set mesh.points=7"]
        );
        let error = third.edited(&with(&["task.duration=1.0"])).unwrap_err();
        assert!(matches!(error, ConfigError::Impossible { .. }), "{error}");
        assert_eq!(error.key().as_deref(), Some("task.duration"));
    }

    #[test]
    fn errors_name_their_keys_and_lines_unless_nobody_wrote_these() {
        let text = text().replace("duration =", "duratoin =");
        let error = ProblemFile::of_text(Path::new(PATH), &text, &Overrides::default());
        let error = error.unwrap_err();
        assert_eq!(error.key().as_deref(), Some("task.duratoin"));
        assert!(error.place().line.is_some());
        let other = error.clone().without_lines_of("other.toml");
        assert_eq!(other, error);
        let without = error.without_lines_of(PATH);
        assert_eq!(without.place().line, None);
        assert!(without.to_string().starts_with(&format!("{PATH}: task.")));
    }
}
