//! Values given on the command line, laid over the problem file before it is read.

use super::document::{Node, Value};
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
    key: String,
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
        let key = key.trim();
        if key.split('.').any(|part| part.is_empty()) {
            let message = "a part of the key is empty; expected --set key.path=value".into();
            return Err(ConfigError::Format { place, message });
        }
        self.entries.push(Entry {
            value: value_of(&flag, value.trim()),
            key: key.into(),
            flag,
        });
        Ok(())
    }

    /// Adds a text for `key`, given by the option `flag`.
    pub fn text(&mut self, flag: &str, key: &str, value: &str) {
        let value = Value::Text(value.into());
        self.entries.push(Entry {
            flag: flag.into(),
            key: key.into(),
            value,
        });
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
        let value = Value::Float(value);
        self.entries.push(Entry {
            flag: flag.into(),
            key: key.into(),
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
        let place = place(&self.flag);
        let mut node = document;
        let mut path = String::new();
        for part in self.key.split('.') {
            if let (ROBOT, Value::Text(_)) = (path.as_str(), &node.value) {
                tabulate(node);
            }
            let found = node.describe();
            let Value::Table(entries) = &mut node.value else {
                let expected = "a table, so that a key in it can be set".into();
                return Err(ConfigError::Value {
                    place,
                    key: path,
                    found,
                    expected,
                });
            };
            let at = entries
                .iter()
                .position(|(key, _)| key == part)
                .unwrap_or_else(|| {
                    let table = Node {
                        place: place.clone(),
                        value: Value::Table(Vec::new()),
                    };
                    entries.push((part.into(), table));
                    entries.len() - 1
                });
            node = &mut entries[at].1;
            path = if path.is_empty() {
                part.into()
            } else {
                format!("{path}.{part}")
            };
        }
        *node = Node {
            place: place.clone(),
            value: self.value.clone(),
        };
        Ok(())
    }
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
        let mut node = Node::parse(&"a.toml".into(), "robot = \"r\"\n[mesh]\npoints = 5\n")?;
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
        ] {
            assert_eq!(document(&[set]).unwrap_err().to_string(), expected);
        }
    }
}
