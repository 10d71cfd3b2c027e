//! Runs the program on files in a folder of their own.
#![allow(dead_code)] // each test file uses its own part

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// A problem that is solved in some ten milliseconds.
pub const PROBLEM: &str = r#"schema = 1
name = "case"
robot = "robot.toml"

[task]
duration = 20.0
initial.joints = [0.0, 0.0]
final.joints = [0.5, 1.0]

[limits]
joint_position = 1.5
joint_velocity = 0.9
control = [5.0, 4.0]

[cost]
final_base_attitude = 1.0
joint_rate = 0.2
control = 0.1

[mesh]
segments = 4
points = 5
tolerance = 1e-3
"#;

/// The text with `old` replaced, which must be there once.
pub fn edited(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "{old:?} in the text");
    text.replace(old, new)
}

/// The folder of one test, with `case.toml` and `robot.toml` in it.
pub struct Folder(TempDir);

impl Folder {
    pub fn new(problem: &str) -> Self {
        let folder = Self(tempfile::tempdir().expect("a temporary folder"));
        folder.write("case.toml", problem);
        folder.write(
            "robot.toml",
            include_str!("../../config/robots/planar-2link.toml"),
        );
        folder
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    pub fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.path().join(name);
        fs::write(&path, text).expect("a file in the temporary folder");
        path
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path().join(name)).expect(name)
    }

    /// Names of all files and folders, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.path()).expect("the temporary folder");
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// Runs the program in the folder.
    pub fn run(&self, arguments: &[&str]) -> Run {
        let output = Command::new(env!("CARGO_BIN_EXE_ffsm-ipopt"))
            .args(arguments)
            .current_dir(self.path())
            .output()
            .expect("the program runs");
        Run::of(output)
    }
}

/// What a run left behind.
#[derive(Debug)]
pub struct Run {
    pub code: i32,
    pub stdout: String,
    pub stderr: String,
}

impl Run {
    fn of(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        Self {
            code: output.status.code().expect("an exit status"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}
