//! Records what the program is built from, for `doctor` and every solution's provenance.

use std::env;
use std::path::Path;
use std::process::Command;

/// What a build depends on; changes to it mark the revision.
const SOURCES: [&str; 6] = [
    "src",
    "ffi",
    "config",
    "Cargo.toml",
    "Cargo.lock",
    "build.rs",
];

fn main() {
    for source in SOURCES.iter().filter(|source| Path::new(source).exists()) {
        println!("cargo::rerun-if-changed={source}");
    }
    let variable = |name| env::var(name).unwrap_or_default();
    let rustc = run(&variable("RUSTC"), &["--version"]);
    for (name, value) in [
        ("FFSM_GIT_REVISION", revision()),
        ("FFSM_TARGET", Some(variable("TARGET"))),
        (
            "FFSM_TARGET_FEATURES",
            Some(variable("CARGO_CFG_TARGET_FEATURE")),
        ),
        ("FFSM_PROFILE", Some(variable("PROFILE"))),
        ("FFSM_RUSTC", rustc),
    ] {
        println!(
            "cargo::rustc-env={name}={}",
            value.unwrap_or_else(|| "unknown".into())
        );
    }
}

/// Short revision, with a `+` where a source was changed since.
fn revision() -> Option<String> {
    // The reflog grows with every commit and checkout.
    for name in ["HEAD", "logs/HEAD"] {
        if let Some(path) = run("git", &["rev-parse", "--git-path", name])
            && Path::new(&path).exists()
        {
            println!("cargo::rerun-if-changed={path}");
        }
    }
    let revision = run("git", &["rev-parse", "--short=12", "HEAD"])?;
    let mut status = vec!["status", "--porcelain", "--"];
    status.extend(SOURCES);
    let changed = run("git", &status).is_some_and(|changes| !changes.is_empty());
    Some(if changed { revision + "+" } else { revision })
}

/// Standard output of a command that succeeds, trimmed.
fn run(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
