//! Values given on the command line, laid over the problem file before it is read.

use super::document::{Node, Value};
use super::key_path::{KeyPath, Step};
use super::{ConfigError, Place};
use std::sync::Arc;

/// Values that go before those of the problem file, in the order they were given.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Overrides {
    entries: Vec<Entry>,
}

#[derive(Debug, Clone, PartialEq)]
struct Entry {
    /// As it was written, for messages.
    flag: String,
    key: KeyPath,
    value: Value,
}

impl Overrides {
    /// Those of `--set key.path=value`, given any number of times.
    ///
    /// # Errors
    /// As of [`Self::set`].
    pub fn of(assignments: &[String]) -> Result<Self, ConfigError> {
        let mut overrides = Self::default();
        for assignment in assignments {
            overrides.set(assignment)?;
        }
        Ok(overrides)
    }

    /// Adds `--set key.path=value`; the value is read as TOML, or as a string where it is none.
    ///
    /// # Errors
    /// [`ConfigError`] where there is no `=` or an empty key.
    pub fn set(&mut self, assignment: &str) -> Result<(), ConfigError> {
        let flag = format!("--set {assignment}");
        let place = place(&flag);
        let Some((key, value)) = assignment.split_once('=') else {
            let message = "no '='; expected --set key.path=value".into();
            return Err(ConfigError::Format { place, message });
        };
        let Some(key) = KeyPath::parse(key.trim()) else {
            let message = "a part of the key is empty; expected --set key.path=value".into();
            return Err(ConfigError::Format { place, message });
        };
        self.entries.push(Entry {
            value: value_of(&flag, value.trim()),
            key,
            flag,
        });
        Ok(())
    }

    /// Adds a text for `key`, given by the option `flag`.
    pub fn text(&mut self, flag: &str, key: &str, value: &str) {
        self.add(flag, key, Value::Text(value.into()));
    }

    const REPAIR: &str = "--repair";

    /// Adds `--repair`, short for `--set robot.repair=inertia`, where it is `given`.
    pub fn repair(&mut self, given: bool) {
        if given {
            self.text(Self::REPAIR, "robot.repair", "inertia");
        }
    }

    /// Adds a number for `key`, given by the option `flag`.
    pub fn number(&mut self, flag: &str, key: &str, value: f64) {
        self.add(flag, key, Value::Float(value));
    }

    fn add(&mut self, flag: &str, key: &str, value: Value) {
        self.entries.push(Entry {
            flag: flag.into(),
            key: KeyPath::parse(key).expect("a key of this program's own"),
            value,
        });
    }

    /// The options again that [`Overrides::flags`] gave.
    ///
    /// # Errors
    /// [`ConfigError`] for an option that is none of them.
    pub fn replay(flags: &[String]) -> Result<Self, ConfigError> {
        let mut overrides = Self::default();
        for flag in flags {
            let unknown = || ConfigError::Format {
                place: place(flag),
                message: "not an option that changes a problem; expected --repair, or \
                          --set, --method, --tolerance or --time-limit with its value"
                    .into(),
            };
            if flag == Self::REPAIR {
                overrides.repair(true);
                continue;
            }
            let (option, value) = flag.split_once(' ').ok_or_else(unknown)?;
            match option {
                "--set" => overrides.set(value)?,
                "--method" => overrides.text(flag, "mesh.method", value),
                "--tolerance" | "--time-limit" => {
                    let key = match option {
                        "--tolerance" => "mesh.tolerance",
                        _ => "solver.time_limit",
                    };
                    let value = value.parse().map_err(|_| unknown())?;
                    overrides.number(flag, key, value);
                }
                _ => return Err(unknown()),
            }
        }
        Ok(overrides)
    }

    /// These, and `later` laid over them.
    pub fn and(mut self, later: &Self) -> Self {
        self.entries.extend_from_slice(&later.entries);
        self
    }

    /// The options as they were written.
    pub fn flags(&self) -> Vec<String> {
        self.entries
            .iter()
            .map(|entry| entry.flag.clone())
            .collect()
    }

    /// Lays the values over `document`.
    pub(super) fn apply(&self, document: &mut Node) -> Result<(), ConfigError> {
        self.entries
            .iter()
            .try_for_each(|entry| entry.apply(document))
    }
}

impl Entry {
    fn apply(&self, document: &mut Node) -> Result<(), ConfigError> {
        lay(document, &self.key, &place(&self.flag), &self.value)
    }
}

/// Lays `value`, given at `place`, over what `key` leads to in `document`. Tables on the way are made
/// where they are missing, arrays are not.
pub(super) fn lay(
    document: &mut Node,
    key: &KeyPath,
    place: &Place,
    value: &Value,
) -> Result<(), ConfigError> {
    let mut node = document;
    for (done, step) in key.steps.iter().enumerate() {
        let path = || KeyPath {
            steps: key.steps[..done].to_vec(),
        };
        let unusable = |found: String, expected: String| ConfigError::Value {
            place: place.clone(),
            key: path().to_string(),
            found,
            expected,
        };
        let at_robot = key.steps[..done] == [Step::Name(ROBOT.into())];
        if let (true, Value::Text(_)) = (at_robot, &node.value) {
            tabulate(node);
        }
        let found = node.describe();
        node = match (step, &mut node.value) {
            (Step::Name(name), Value::Table(entries)) => {
                let at = entries
                    .iter()
                    .position(|(key, _)| key == name)
                    .unwrap_or_else(|| {
                        let table = Node {
                            place: place.clone(),
                            value: Value::Table(Vec::new()),
                        };
                        entries.push((name.clone(), table));
                        entries.len() - 1
                    });
                &mut entries[at].1
            }
            (Step::Name(_), _) => {
                return Err(unusable(
                    found,
                    "a table, so that a key in it can be set".into(),
                ));
            }
            (Step::Index(index), Value::Array(elements)) => {
                elements.get_mut(*index).ok_or_else(|| {
                    let least = index + 1;
                    unusable(
                        found,
                        format!("at least {least} values, so that [{index}] can be set"),
                    )
                })?
            }
            (Step::Index(index), _) => {
                let expected = format!("an array, so that its value [{index}] can be set");
                return Err(unusable(found, expected));
            }
        };
    }
    *node = Node {
        place: place.clone(),
        value: value.clone(),
    };
    Ok(())
}

/// The one key that is a path or a table in which the path is one of the keys.
const ROBOT: &str = "robot";

/// The path as that table.
fn tabulate(node: &mut Node) {
    let file = node.clone();
    node.value = Value::Table(vec![("file".into(), file)]);
}

fn place(flag: &str) -> Place {
    Place {
        source: flag.into(),
        line: None,
    }
}

fn value_of(flag: &str, text: &str) -> Value {
    let source: Arc<str> = flag.into();
    let parsed = Node::parse(&source, &format!("value = {text}"));
    match parsed.map(|node| node.value) {
        // A line break in the text could smuggle in a second key.
        Ok(Value::Table(mut entries)) if entries.len() == 1 => {
            let mut value = entries.remove(0).1.value;
            relabel(&mut value, &place(flag));
            value
        }
        _ => Value::Text(text.into()),
    }
}

/// Lines mean nothing in an option.
fn relabel(value: &mut Value, place: &Place) {
    let each = |node: &mut Node| {
        node.place = place.clone();
        relabel(&mut node.value, place);
    };
    match value {
        Value::Array(elements) => elements.iter_mut().for_each(each),
        Value::Table(entries) => entries.iter_mut().map(|(_, node)| node).for_each(each),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(sets: &[&str]) -> Result<Node, ConfigError> {
        let mut overrides = Overrides::default();
        for set in sets {
            overrides.set(set)?;
        }
        let mut node = Node::parse(
            &"a.toml".into(),
            "robot = \"r\"\ngoal = [1, 2]\n[mesh]\npoints = 5\n",
        )?;
        overrides.apply(&mut node)?;
        Ok(node)
    }

    fn value(set: &str, table: &str, key: &str) -> Value {
        document(&[set])
            .unwrap()
            .get(table)
            .unwrap()
            .get(key)
            .unwrap()
            .value
            .clone()
    }

    #[test]
    fn values_are_toml_or_else_strings() {
        assert_eq!(value("mesh.points=7", "mesh", "points"), Value::Integer(7));
        assert_eq!(
            value("mesh.method=rpm", "mesh", "method"),
            Value::Text("rpm".into())
        );
        assert_eq!(
            value("limits.control = inf", "limits", "control"),
            Value::Float(f64::INFINITY)
        );
        assert_eq!(value("a.b=1\nc=2", "a", "b"), Value::Text("1\nc=2".into()));
    }

    #[test]
    fn a_value_of_an_array_can_be_set() {
        let goal = document(&["goal[1]=3"]).unwrap();
        let Value::Array(goal) = &goal.get("goal").unwrap().value else {
            panic!("an array");
        };
        assert_eq!(goal[0].value, Value::Integer(1));
        assert_eq!(goal[1].value, Value::Integer(3));
    }

    #[test]
    fn options_survive_being_written_down() {
        let mut overrides = Overrides::default();
        overrides.set("limits.control = [1, 2]").unwrap();
        overrides.text("--method rpm", "mesh.method", "rpm");
        overrides.repair(true);
        overrides.number("--tolerance 1e-7", "mesh.tolerance", 1e-7);
        overrides.number("--time-limit 20.0", "solver.time_limit", 20.0);
        assert_eq!(Overrides::replay(&overrides.flags()).unwrap(), overrides);
        let error = Overrides::replay(&["--quiet".into()]).unwrap_err();
        assert!(
            error.to_string().starts_with("--quiet: not an option"),
            "{error}"
        );
    }

    #[test]
    fn a_robot_named_by_its_path_has_the_keys_of_the_table() {
        let of = |set: &str, key| value(set, "robot", key);
        assert_eq!(
            of("robot.end_effector=tool", "file"),
            Value::Text("r".into())
        );
        assert_eq!(
            of("robot.end_effector=tool", "end_effector"),
            Value::Text("tool".into())
        );
        assert_eq!(of("robot.file=x", "file"), Value::Text("x".into()));
    }

    #[test]
    fn an_assignment_must_be_one() {
        for (set, expected) in [
            (
                "mesh.points",
                "--set mesh.points: no '='; expected --set key.path=value",
            ),
            (
                "mesh..x=1",
                "--set mesh..x=1: a part of the key is empty; expected --set key.path=value",
            ),
            (
                "mesh.points.x=1",
                "--set mesh.points.x=1: mesh.points: 5; expected a table, so that a key in it can be set",
            ),
            (
                "mesh.points[0]=1",
                "--set mesh.points[0]=1: mesh.points: 5; expected an array, so that its value [0] can be set",
            ),
            (
                "goal[2]=1",
                "--set goal[2]=1: goal: an array of 2 values; expected at least 3 values, so that [2] can be set",
            ),
        ] {
            assert_eq!(document(&[set]).unwrap_err().to_string(), expected);
        }
    }
}
