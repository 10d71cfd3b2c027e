//! What a problem that was made says of a key of its file.
//!
//! A batch writes down this and not what it gave: a value that never got into the problem cannot be
//! logged as if it had.

use super::ProblemFile;
use super::batch::Cell;
use super::key_path::{KeyPath, Step};
use crate::dynamics::Inertia;
use crate::ocp::Interval;
use crate::problem::{EndEffectorGoal, Moment, Problem, WayPoint};
use nalgebra::Matrix3;

/// What stands at some place of a problem.
#[derive(Debug, Clone, PartialEq)]
enum Reading {
    Number(f64),
    Text(String),
    /// A bound or a duration: one number where both ends are the same or opposite.
    Interval(Interval),
    /// A rotational inertia: one number where it is the same about all axes.
    Matrix(Matrix3<f64>),
    /// A row of one: one number where the others are zero.
    Row(usize, [f64; 3]),
    /// One value each, with the names they have: one number where all are the same.
    List(Vec<(String, Reading)>),
}

use Reading::{List, Number, Text};

impl ProblemFile {
    /// What the problem has at `key`, in the form of `given`; `None` where the key is none that can be
    /// read back, or has another form there.
    pub(super) fn read_back(&self, key: &KeyPath, given: &Cell) -> Option<Cell> {
        let mut names = Vec::new();
        let mut rest = &key.steps[..];
        // The longest path of names that is known; what follows are steps into its value.
        let mut found = None;
        while let Some((Step::Name(name), after)) = rest.split_first() {
            names.push(name.as_str());
            rest = after;
            if let Some(reading) = self.reading(&names) {
                found = Some((reading, rest));
            }
        }
        if let ["task", "way_points"] = names[..] {
            found = way_point(&self.problem, rest);
        }
        let (reading, rest) = found?;
        let at = rest.iter().try_fold(reading, |at, step| at.step(step))?;
        at.like(given)
    }

    /// What the key that `names` make stands for.
    fn reading(&self, names: &[&str]) -> Option<Reading> {
        let problem = &self.problem;
        match names {
            ["robot", "bodies", body, what] => {
                let (_, inertia) = self.bodies.iter().find(|(name, _)| name == body)?;
                mass_property(inertia, what)
            }
            ["base", what] => mass_property(self.spacecraft.as_ref()?, what),
            ["task", of @ ..] => task(problem, of),
            ["limits", name] => {
                let mut limits = problem.limits.entries();
                let limit = limits.find(|limit| limit.id.name() == *name)?;
                let names = component_names(problem, limit.bounds.len());
                let bounds = limit.bounds.iter().copied().map(Reading::Interval);
                Some(List(names.into_iter().zip(bounds).collect()))
            }
            ["cost", "duration"] => Some(Number(problem.cost.duration)),
            ["cost", "rate_matrix"] => {
                let rows = problem.cost.rate_matrix.as_ref()?;
                Some(List(
                    rows.iter()
                        .map(|row| (String::new(), numbers(row)))
                        .collect(),
                ))
            }
            ["cost", name] => {
                let mut terms = problem.cost.entries();
                let term = terms.find(|term| term.id.name() == *name)?;
                Some(components(problem, term.weights))
            }
            ["mesh", name] => mesh(problem, name),
            ["solver", name] => solver(problem, name),
            _ => None,
        }
    }
}

fn mass_property(inertia: &Inertia, what: &str) -> Option<Reading> {
    match what {
        "mass" => Some(Number(inertia.mass())),
        "com" => Some(numbers(inertia.center().as_slice())),
        "inertia" => Some(Reading::Matrix(*inertia.rotational())),
        _ => None,
    }
}

fn task(problem: &Problem, of: &[&str]) -> Option<Reading> {
    let task = &problem.task;
    match of {
        ["duration"] => Some(Reading::Interval(task.duration)),
        ["initial", "joints"] => Some(components(problem, &task.initial_joints)),
        ["initial", "rates"] => Some(components(problem, &task.initial_rates)),
        ["initial", "base_attitude"] => Some(numbers(&task.initial_base_attitude)),
        ["initial", "linear_momentum"] => Some(numbers(&task.initial_momentum.linear)),
        ["initial", "angular_momentum"] => Some(numbers(&task.initial_momentum.angular)),
        ["final", "joints" | "guess"] => Some(components(problem, &task.final_joints)),
        ["final", "end_effector", what] => goal(task.end_effector.as_ref()?, what),
        _ => None,
    }
}

fn goal(goal: &EndEffectorGoal, what: &str) -> Option<Reading> {
    match what {
        "frame" => Some(Text(goal.frame.name().into())),
        "position" => goal.position.as_deref().map(numbers),
        "position_tolerance" => Some(Number(goal.position_tolerance)),
        "orientation" => goal.orientation.as_deref().map(numbers),
        "orientation_tolerance" => Some(Number(goal.orientation_tolerance)),
        _ => None,
    }
}

/// What stands in a way-point, with the steps that are left.
fn way_point<'a>(problem: &Problem, rest: &'a [Step]) -> Option<(Reading, &'a [Step])> {
    let [Step::Index(index), Step::Name(what), rest @ ..] = rest else {
        return None;
    };
    let WayPoint {
        at,
        joints,
        joint_rates,
        end_effector,
        ..
    } = problem.task.way_points.get(*index)?;
    let some = |values: &[Option<f64>]| {
        let names = component_names(problem, values.len());
        let named = names.into_iter().zip(values);
        List(
            named
                .filter_map(|(name, value)| Some((name, Number((*value)?))))
                .collect(),
        )
    };
    match (what.as_str(), at, rest) {
        ("time", Moment::Time(time), _) => Some((Number(*time), rest)),
        ("fraction", Moment::Fraction(fraction), _) => Some((Number(*fraction), rest)),
        ("joints", ..) => Some((some(joints), rest)),
        ("joint_rates", ..) => Some((some(joint_rates), rest)),
        ("end_effector", _, [Step::Name(what), rest @ ..]) => {
            Some((goal(end_effector.as_ref()?, what)?, rest))
        }
        _ => None,
    }
}

fn mesh(problem: &Problem, name: &str) -> Option<Reading> {
    let mesh = &problem.mesh;
    Some(match name {
        "method" => Text(mesh.method.name().into()),
        "law" => Text(mesh.law.name().into()),
        "error" => Text(mesh.error.name().into()),
        "segments" => Number(mesh.segments as f64),
        "points" => Number(mesh.points as f64),
        "max_points" => Number(mesh.max_points as f64),
        "max_global_points" => Number(mesh.max_global_points as f64),
        "global_points" => Number(mesh.global_points as f64),
        "max_iterations" => Number(mesh.max_iterations? as f64),
        "tolerance" => Number(mesh.tolerance),
        "objective_tolerance" => Number(mesh.objective_tolerance?),
        "bound_tolerance" => Number(mesh.bound_tolerance),
        "lambda1" => Number(mesh.lambda1),
        "lambda2" => Number(mesh.lambda2),
        "r_max" => Number(mesh.r_max),
        _ => return None,
    })
}

fn solver(problem: &Problem, name: &str) -> Option<Reading> {
    let solver = &problem.solver;
    Some(match name {
        "tolerance" => Number(solver.tolerance),
        "max_iterations" => Number(f64::from(solver.max_iterations)),
        "linear_solver" => Text(solver.linear_solver.name().into()),
        _ => return None,
    })
}

/// Numbers with the names of their components.
fn components(problem: &Problem, values: &[f64]) -> Reading {
    let names = component_names(problem, values.len());
    List(
        names
            .into_iter()
            .zip(values.iter().copied().map(Number))
            .collect(),
    )
}

/// Numbers without names.
fn numbers(values: &[f64]) -> Reading {
    let number = |value: &f64| (String::new(), Number(*value));
    List(values.iter().map(number).collect())
}

/// Names of joints, where there are as many; else none.
fn component_names(problem: &Problem, count: usize) -> Vec<String> {
    let joints = problem.robot.joints();
    match joints.len() == count {
        true => joints.iter().map(|joint| joint.name.clone()).collect(),
        false => vec![String::new(); count],
    }
}

impl Reading {
    /// One step into it.
    fn step(self, step: &Step) -> Option<Self> {
        match (self, step) {
            (List(mut all), Step::Index(i)) => (*i < all.len()).then(|| all.swap_remove(*i).1),
            (List(all), Step::Name(wanted)) => {
                let mut all = all.into_iter();
                all.find(|(name, _)| name == wanted).map(|(_, value)| value)
            }
            (Self::Interval(interval), Step::Index(0)) => Some(Number(interval.lower)),
            (Self::Interval(interval), Step::Index(1)) => Some(Number(interval.upper)),
            (Self::Interval(interval), Step::Name(end)) => match end.as_str() {
                "min" => Some(Number(interval.lower)),
                "max" => Some(Number(interval.upper)),
                _ => None,
            },
            (Self::Matrix(matrix), Step::Index(i)) if *i < 3 => {
                Some(Self::Row(*i, [0, 1, 2].map(|j| matrix[(*i, j)])))
            }
            (Self::Row(_, row), Step::Index(j)) => row.get(*j).copied().map(Number),
            _ => None,
        }
    }

    /// In the form of `given`.
    fn like(&self, given: &Cell) -> Option<Cell> {
        match given {
            Cell::Number(_) => self.number().map(Cell::Number),
            Cell::Text(_) => match self {
                Text(text) => Some(Cell::Text(text.clone())),
                _ => None,
            },
            Cell::Numbers(_) => self.numbers().map(Cell::Numbers),
        }
    }

    fn number(&self) -> Option<f64> {
        match self {
            Number(number) => Some(*number),
            Text(_) => None,
            Self::Interval(both) => {
                let one = both.lower == both.upper || both.lower == -both.upper;
                one.then_some(both.upper)
            }
            Self::Matrix(matrix) => {
                let number = matrix[(0, 0)];
                (*matrix == Matrix3::identity() * number).then_some(number)
            }
            Self::Row(i, row) => {
                let others = (0..3).filter(|j| j != i);
                others
                    .map(|j| row[j])
                    .all(|other| other == 0.0)
                    .then_some(row[*i])
            }
            List(all) => {
                let number = all.first()?.1.number()?;
                let same = |(_, other): &(String, Self)| other.number() == Some(number);
                all.iter().all(same).then_some(number)
            }
        }
    }

    fn numbers(&self) -> Option<Vec<f64>> {
        match self {
            List(all) => match &all[..] {
                // One range for all.
                [(_, Self::Interval(first)), rest @ ..]
                    if first.lower != -first.upper
                        && rest
                            .iter()
                            .all(|(_, other)| *other == Self::Interval(*first)) =>
                {
                    Some(vec![first.lower, first.upper])
                }
                _ => all.iter().map(|(_, value)| value.number()).collect(),
            },
            Self::Interval(interval) => Some(vec![interval.lower, interval.upper]),
            Self::Row(_, row) => Some(row.to_vec()),
            Self::Matrix(matrix) => {
                let diagonal = Matrix3::from_diagonal(&matrix.diagonal());
                (*matrix == diagonal).then(|| matrix.diagonal().as_slice().to_vec())
            }
            Number(_) | Text(_) => None,
        }
    }
}
