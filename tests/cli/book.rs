//! The commands of the book, run one after another in a folder as a reader has it: `config/` beside it and
//! an arm's URDF.

use std::env;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// What takes more than a few seconds.
const SLOW: [&str; 6] = [
    "--search",
    "pareto ",
    "batch ",
    "disperse ",
    "config/table1.toml",
    "chaser-7dof-heavy",
];
/// Ends of commands that show what goes wrong.
const STATUSES: [(&str, i32); 1] = [("plan config/table1.toml", 3)];

/// The documents in the order of the book.
fn chapters() -> Vec<PathBuf> {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let summary = std::fs::read_to_string(top.join("docs/SUMMARY.md")).unwrap();
    let names = summary.lines().filter_map(|line| {
        let (_, rest) = line.split_once("](")?;
        Some(top.join("docs").join(rest.strip_suffix(')')?))
    });
    names.collect()
}

/// Lines of code blocks that call the program.
fn commands(path: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut inside = false;
    let mut found = Vec::new();
    for line in text.lines() {
        if line.starts_with("```") {
            inside = !inside;
        }
        let line = line.strip_prefix("$ ").unwrap_or(line);
        let call = line.strip_prefix("ffsm-ipopt ");
        if inside && call.is_some_and(|call| call.starts_with(|c: char| c.is_ascii_lowercase())) {
            found.push(line.to_owned());
        }
    }
    found
}

/// Runs those that `wanted` holds of, of the book in one folder, of the README in another; how many there
/// were.
fn run(wanted: impl Fn(&str) -> bool) -> usize {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    run_all(&chapters(), &wanted) + run_all(&[readme], &wanted)
}

fn run_all(documents: &[PathBuf], wanted: impl Fn(&str) -> bool) -> usize {
    let top = Path::new(env!("CARGO_MANIFEST_DIR"));
    let place = tempfile::tempdir().unwrap();
    symlink(top.join("config"), place.path().join("config")).unwrap();
    std::fs::copy(
        top.join("config/starter/arm.urdf"),
        place.path().join("arm.urdf"),
    )
    .unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_ffsm-ipopt"))
        .parent()
        .unwrap();
    let paths = env::var_os("PATH").unwrap_or_default();
    let paths = [program.to_path_buf()]
        .into_iter()
        .chain(env::split_paths(&paths));
    let paths = env::join_paths(paths).unwrap();
    let mut count = 0;
    for document in documents {
        for line in commands(document).iter().filter(|line| wanted(line)) {
            let began = Instant::now();
            let ended = Command::new("sh")
                .args(["-c", line])
                .current_dir(place.path())
                .env("PATH", &paths)
                .stdin(Stdio::null())
                .output()
                .unwrap();
            println!("{:6.1} s  {line}", began.elapsed().as_secs_f64());
            let known = STATUSES.iter().find(|(part, _)| line.contains(part));
            let expected = known.map_or(0, |(_, status)| *status);
            let said = String::from_utf8_lossy(&ended.stderr);
            assert_eq!(
                ended.status.code(),
                Some(expected),
                "{}: {line}: {said}",
                document.display()
            );
            count += 1;
        }
    }
    count
}

#[test]
fn quick_commands_of_the_book_run() {
    let count = run(|line| !SLOW.iter().any(|part| line.contains(part)));
    assert!(count > 15, "{count} commands");
}

#[test]
#[ignore = "takes minutes"]
fn all_commands_of_the_book_run() {
    run(|_| true);
}
