//! What is refused before anything is planned: one line, status 2, nothing written.

use crate::program::{Folder, edited};
use crate::rows::*;

#[track_caller]
fn complaint(folder: &Folder, arguments: &[&str]) -> String {
    let before = folder.names();
    let run = folder.run(&[&["batch"], arguments].concat());
    assert_eq!(run.code, 2, "{run:?}");
    assert_eq!(run.stdout, "");
    assert_eq!(run.stderr.lines().count(), 1, "one line: {}", run.stderr);
    assert_eq!(folder.names(), before, "nothing written");
    run.stderr.trim_end().to_owned()
}

const TO: [&str; 3] = ["batch.toml", "--out", "o"];

#[test]
fn batch_files() {
    for (old, new, expected) in [
        (
            "seed = 5",
            "seed = -1",
            "batch.toml:3: seed: -1; expected a whole number from 0",
        ),
        (
            "seed = 5",
            "sed = 5",
            "batch.toml:3: sed: unknown key; did you mean 'seed'?",
        ),
        (
            "count = 12\n",
            "",
            "batch.toml: count: missing; expected how many rows to draw, a whole number from 1",
        ),
        (
            "count = 12",
            "count = 1000000000000",
            "batch.toml:4: count: 1000000000000; expected a whole number from 1 to 100000000",
        ),
        (
            "uniform = [0.3, 0.7]",
            "uniform = [0.7, 0.3]",
            "batch.toml:8: vary[0].uniform: [0.7, 0.3]; expected [a, b], a below b",
        ),
        (
            "uniform = [0.3, 0.7]",
            "log_uniform = [0, 0.3]",
            "batch.toml:8: vary[0].log_uniform: [0, 0.3]; expected [a, b], a above zero and below b",
        ),
        (
            "uniform = [0.3, 0.7]",
            "uniform = [0.3, 0.7]\nvalues = [1]",
            "batch.toml:6: vary[0]: 2 of them; expected one of values, uniform, log_uniform, normal, or table with column",
        ),
        (
            "sd = 0.2",
            "sd = 0",
            "batch.toml:12: vary[1].normal.sd: 0; expected a finite number above zero, the standard deviation",
        ),
        (
            "min = 1.0",
            "min = 3.0",
            "batch.toml:12: vary[1].normal: less than 0.01 of the distribution between min and max; expected min and max around more of it",
        ),
        (
            "[0.9, 0.8, 0.7]",
            "[0.9, \"a\"]",
            "batch.toml:16: vary[2].values[1]: a string (\"a\"); expected values of one kind",
        ),
        (
            "key = \"limits.joint_velocity\"",
            "key = \"task.final.joints[0]\"",
            "batch.toml:15: vary.key: \"task.final.joints[0]\" for the second time; expected every key once",
        ),
        (
            "problem = \"case.toml\"",
            "problem = \"none.toml\"",
            "none.toml: cannot be read: No such file or directory (os error 2); expected a problem file",
        ),
    ] {
        let folder = folder(&edited(BATCH, old, new));
        assert_eq!(complaint(&folder, &TO), expected);
    }
}

/// A key that does not get into the problem is found out before anything is planned.
#[test]
fn keys_that_change_nothing() {
    let key = |key: &str| {
        edited(
            BATCH,
            "key = \"task.final.joints[0]\"",
            &format!("key = \"{key}\""),
        )
    };
    for (name, expected) in [
        (
            "task.final.joint[0]",
            "row 0: batch.toml:7: task.final.joint: a table; expected an array",
        ),
        (
            "limits.torqe",
            "row 0: batch.toml:7: limits.torqe: unknown key; did you mean 'torque'?",
        ),
        (
            "robot.bodies.hand.mass",
            "row 0: batch.toml:7: robot.bodies.hand: unknown key",
        ),
        (
            "task.final.joints[2]",
            "row 0: batch.toml:7: task.final.joints: an array of 2 values; expected at least 3 values, so that [2] can be set",
        ),
        // Read, but no figure of the problem.
        ("robot.minimum_mass", "batch.toml:7: robot.minimum_mass: 0."),
    ] {
        let found = complaint(&folder(&key(name)), &TO);
        assert!(found.starts_with(expected), "{found}");
    }
}

/// What a file may not do, a batch file may not do either.
#[test]
fn libraries_are_not_loaded() {
    let old = "key = \"limits.joint_velocity\"\nvalues = [0.9, 0.8, 0.7]";
    let new = "key = \"solver.linear_solver\"\nvalues = [\"ma57\"]";
    let found = complaint(&folder(&edited(BATCH, old, new)), &TO);
    assert!(
        found.starts_with("row 0: batch.toml:15: solver.linear_solver: "),
        "{found}"
    );
    assert!(found.contains("--trust-options"), "{found}");
}

#[test]
fn tables() {
    let folder = folder(&edited(
        BATCH,
        "values = [0.9, 0.8, 0.7]",
        "table = \"t.csv\"\ncolumn = \"x\"",
    ));
    let place = "batch.toml:16: vary[2].table";
    assert_eq!(
        complaint(&folder, &TO),
        format!(
            "{place}: t.csv: cannot be read: No such file or directory (os error 2); expected a table of the values of keys, a row a plan"
        )
    );
    folder.write("t.csv", "y,z\n1,2\n");
    assert_eq!(
        complaint(&folder, &TO),
        "batch.toml:17: vary[2].column: \"x\"; expected a column of it; did you mean 'y'?"
    );
    folder.write("t.csv", "x\n1\n\"\"\n");
    assert!(complaint(&folder, &TO).contains("row 1 of the column has \"\""));
    folder.write("t.csv", "x\n1\n2,3\n");
    assert!(
        complaint(&folder, &TO).starts_with(&format!("{place}: t.csv: cannot be read: CSV error"))
    );
}

#[test]
fn folders_and_flags() {
    let folder = folder(&edited(BATCH, "count = 12", "count = 2"));
    plan(&folder, "o", &[]);
    assert_eq!(
        complaint(&folder, &TO),
        "o: has 2 rows of this batch already; --resume goes on with the rest, or choose another --out"
    );
    folder.write("batch.toml", &edited(BATCH, "seed = 5", "seed = 6"));
    assert_eq!(
        complaint(&folder, &[&TO[..], &["--resume"]].concat()),
        "o: has rows of another batch: problem, robot, seed or values differ; choose another --out"
    );
    folder.write("batch.toml", BATCH);
    assert_eq!(
        complaint(
            &folder,
            &[&TO[..], &["--resume", "--trajectories"]].concat()
        ),
        "o: has rows of another batch: --trajectories differ; choose another --out"
    );
    assert_eq!(
        complaint(&folder, &[&TO[..], &["--solutions", "5-99"]].concat()),
        "--solutions 5-99: no such row; expected 5-00000000 to 5-00000011"
    );
    assert_eq!(
        complaint(&folder, &["show", "nowhere"]),
        "nowhere: holds no data set; expected a folder that batch --out wrote to"
    );
    folder.write("o/part-000000.parquet", "no Parquet");
    let damaged = complaint(&folder, &["show", "o"]);
    assert!(
        damaged.starts_with("o/part-000000.parquet: is no part of this data set: "),
        "{damaged}"
    );
}

#[test]
fn a_folder_has_rows_of_one_batch_and_every_row_once() {
    let folder = folder(&edited(BATCH, "count = 12", "count = 4"));
    plan(&folder, "o", &[]);
    let part = |out: &str, number: u8| {
        folder
            .path()
            .join(format!("{out}/part-00000{number}.parquet"))
    };
    std::fs::copy(part("o", 0), part("o", 7)).unwrap();
    for arguments in [&[&TO[..], &["--resume"]].concat()[..], &["show", "o"]] {
        assert_eq!(
            complaint(&folder, arguments),
            "o/part-000007.parquet: has row 0, which another part has as well; move the one that is a \
             copy away"
        );
    }
    std::fs::remove_file(part("o", 7)).unwrap();
    let other = edited(BATCH, "seed = 5", "seed = 6");
    folder.write("batch.toml", &edited(&other, "count = 12", "count = 8"));
    plan(&folder, "p", &[]);
    std::fs::copy(part("p", 0), part("o", 7)).unwrap();
    std::fs::remove_file(folder.path().join("o/_batch.json")).unwrap();
    let refused = complaint(&folder, &[&TO[..], &["--resume"]].concat());
    assert!(
        refused.starts_with("o/part-000000.parquet: has rows of another batch: "),
        "{refused}"
    );
    // It leaves the folder to the batch that it is of.
    assert!(!folder.path().join("o/_batch.json").exists());
    std::fs::remove_file(part("o", 7)).unwrap();
    folder.write("batch.toml", &edited(BATCH, "count = 12", "count = 4"));
    plan(&folder, "o", &["--resume"]);
    // Rows of a time when the batch had more of them are kept.
    folder.write("batch.toml", &edited(BATCH, "count = 12", "count = 2"));
    plan(&folder, "o", &["--retry", "solved"]);
    folder.write("batch.toml", &edited(BATCH, "count = 12", "count = 4"));
    assert_eq!(
        complaint(&folder, &TO),
        "o: has 4 rows of this batch already; --resume goes on with the rest, or choose another --out"
    );
}
