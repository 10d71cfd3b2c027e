//! `schema`: that it allows what the program takes, and nothing it does not know.

use crate::program::{Folder, PROBLEM};
use jsonschema::Validator;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

fn printed() -> Value {
    let run = Folder::new(PROBLEM).run(&["schema"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    serde_json::from_str(&run.stdout).unwrap()
}

fn validator() -> Validator {
    jsonschema::validator_for(&printed()).expect("a valid schema")
}

/// TOML as JSON; an infinite number as a large one.
fn json(text: &str) -> Value {
    fn convert(value: toml::Value) -> Value {
        match value {
            toml::Value::Table(table) => {
                let entry = |(key, value)| (key, convert(value));
                Value::Object(table.into_iter().map(entry).collect())
            }
            toml::Value::Array(values) => values.into_iter().map(convert).collect(),
            toml::Value::Float(value) => value.clamp(f64::MIN, f64::MAX).into(),
            toml::Value::Integer(value) => value.into(),
            toml::Value::Boolean(value) => value.into(),
            toml::Value::String(value) => value.into(),
            toml::Value::Datetime(value) => value.to_string().into(),
        }
    }
    convert(toml::Value::Table(text.parse().expect("TOML")))
}

#[test]
fn problems_that_are_shipped_are_allowed() {
    let validator = validator();
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("config");
    let files = std::fs::read_dir(&config).unwrap();
    let files = files.map(|entry| entry.unwrap().path());
    let problems = files.filter(|path| path.extension().is_some_and(|end| end == "toml"));
    let mut count = 0;
    for path in problems.chain([config.join("starter/problem.toml")]) {
        let problem = json(&std::fs::read_to_string(&path).unwrap());
        let errors: Vec<String> = validator
            .iter_errors(&problem)
            .map(|error| format!("{}: {error}", error.instance_path()))
            .collect();
        assert_eq!(errors, [""; 0], "{}", path.display());
        count += 1;
    }
    assert!(count > 10, "{count} problems");
    assert!(validator.is_valid(&json(PROBLEM)));
}

/// Tables of the problem file: an assignment of an unknown key in each, and where its keys stand in
/// the schema.
const TABLES: [(&str, &str); 17] = [
    ("zzzz=1", ""),
    (
        "robot={file='robot.toml',zzzz=1}",
        "/properties/robot/anyOf/1",
    ),
    ("base={zzzz=1}", "/properties/base"),
    ("task.zzzz=1", "/properties/task"),
    (
        "task.duration={zzzz=1}",
        "/properties/task/properties/duration/anyOf/1",
    ),
    ("task.initial.zzzz=1", "/properties/task/properties/initial"),
    ("task.final.zzzz=1", "/properties/task/properties/final"),
    ("task.final.end_effector={zzzz=1}", "/$defs/end_effector"),
    ("task.way_points=[{zzzz=1}]", "/$defs/way_point"),
    (
        "task.way_points=[{fraction=0.5,end_effector={zzzz=1}}]",
        "/$defs/end_effector",
    ),
    ("limits.zzzz=1", "/properties/limits"),
    (
        "limits.keep_out=[{zzzz=1}]",
        "/properties/limits/properties/keep_out/items",
    ),
    (
        "limits.keep_out=[{name='a',sphere={zzzz=1}}]",
        "/$defs/sphere",
    ),
    ("cost.zzzz=1", "/properties/cost"),
    ("mesh.zzzz=1", "/properties/mesh"),
    ("solver.zzzz=1", "/properties/solver"),
    (
        "limits.keep_out=[{name='a',sphere={body='forearm',center=[0,0,0],radius=1},from={half=1,zzzz=1}}]",
        "/properties/limits/properties/keep_out/items/properties/from/anyOf/0",
    ),
];

#[test]
fn keys_are_those_that_the_program_knows() {
    let schema = printed();
    for (assignment, pointer) in TABLES {
        let folder = Folder::new(PROBLEM);
        let run = folder.run(&["plan", "case.toml", "--set", assignment]);
        assert_eq!(run.code, 2, "{assignment}: {run:?}");
        let (_, known) = run
            .stderr
            .split_once("zzzz: unknown key; expected one of ")
            .unwrap_or_else(|| panic!("{assignment}: {}", run.stderr));
        let known: BTreeSet<&str> = known.trim_end().split(", ").collect();
        let table = schema.pointer(pointer).expect(pointer);
        let keys = table["properties"].as_object().expect(pointer).keys();
        let keys: BTreeSet<&str> = keys.map(String::as_str).collect();
        assert_eq!(keys, known, "{assignment}");
        assert_eq!(table["additionalProperties"], false, "{pointer}");
    }
}

#[test]
fn what_the_program_refuses_is_not_allowed() {
    let validator = validator();
    for (old, new) in [
        ("schema = 1", "schema = 2"),
        ("schema = 1", ""),
        ("robot = \"robot.toml\"", ""),
        ("duration = 20.0", "duration = -1.0"),
        ("duration = 20.0", "duration = { min = 5.0 }"),
        ("joint_velocity = 0.9", "joint_velocity = -0.9"),
        (
            "joint_velocity = 0.9",
            "joint_velocity = [1.0, 2.0, 3.0, [1]]",
        ),
        ("control = [5.0, 4.0]", "contrl = [5.0, 4.0]"),
        ("joint_rate = 0.2", "joint_rate = \"much\""),
        ("segments = 4", "segments = 0"),
        ("points = 5", "points = 2.5"),
        ("tolerance = 1e-3", "tolerance = 0.0"),
    ] {
        assert_eq!(PROBLEM.matches(old).count(), 1, "{old}");
        let text = PROBLEM.replace(old, new);
        assert!(!validator.is_valid(&json(&text)), "{new:?} is allowed");
        let run = Folder::new(&text).run(&["check", "case.toml"]);
        assert_eq!(run.code, 2, "{new:?}: {run:?}");
    }
}
