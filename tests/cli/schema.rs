//! `schema`: that its keys are those of the program. Whether it allows what the program takes is asked of a
//! validator from outside, in `python/tests/test_schema.py`.

use crate::program::{Folder, PROBLEM};
use serde_json::Value;
use std::collections::BTreeSet;

fn printed() -> Value {
    let run = Folder::new(PROBLEM).run(&["schema"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{run:?}");
    serde_json::from_str(&run.stdout).unwrap()
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
