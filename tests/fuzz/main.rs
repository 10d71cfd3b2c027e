//! Files that are nearly right, by the thousand: read without a panic, and refused in one line.
//!
//! `make fuzz` reads a million of each kind in release, and then also asserts that none takes a second
//! and that memory stays below 512 MiB. A failure names kind, seed and number: the same input is made
//! again by `FFSM_FUZZ_ONLY=number`.

mod mutator;
mod targets;

use mutator::Mutator;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// Inputs of each kind in an ordinary test, which is not optimised.
const FEW: u64 = 300;
const SEED: u64 = 13;

/// A number given by the environment.
fn given(name: &str) -> Option<u64> {
    std::env::var(name).ok()?.parse().ok()
}

/// Reads mutated `corpus` by `read`, which says what is wrong with an input where it is refused.
#[track_caller]
fn fuzz(kind: &str, corpus: &[String], read: impl Fn(&str) -> Result<(), String>) {
    let asked = given("FFSM_FUZZ_INPUTS");
    let only = given("FFSM_FUZZ_ONLY");
    let seed = given("FFSM_FUZZ_SEED").unwrap_or(SEED);
    let inputs = match only {
        Some(number) => number..number + 1,
        None => 0..asked.unwrap_or(FEW),
    };
    let (mut accepted, mut slowest) = (0u64, (Duration::ZERO, 0));
    for number in inputs {
        let input = Mutator::new(seed.wrapping_add(number)).mutated(corpus);
        if only.is_some() {
            println!("{input}");
        }
        let begin = Instant::now();
        let what = format!("{kind}, seed {seed}, number {number}");
        match catch_unwind(AssertUnwindSafe(|| read(&input))) {
            Ok(Ok(())) => accepted += 1,
            Ok(Err(message)) => {
                let lines = message.lines().count();
                assert_eq!(lines, 1, "{what}: {message}");
            }
            Err(_) => panic!("{what}: a panic"),
        }
        slowest = slowest.max((begin.elapsed(), number));
    }
    println!("{kind}: {accepted} accepted, slowest {slowest:?}");
    if asked.is_some() {
        assert!(slowest.0 < Duration::from_secs(1), "{kind}: {slowest:?}");
        if let Some(mib) = most_memory() {
            assert!(mib < 512, "{kind}: {mib} MiB");
        }
    }
}

/// The most memory this process has had, MiB.
fn most_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(kib / 1024)
}

#[test]
fn problem_files() {
    fuzz("problem", &targets::problems(), targets::read_problem);
}

#[test]
fn robot_files() {
    fuzz("robot", &targets::robots(), targets::read_robot);
}

#[test]
fn urdf_files() {
    fuzz("urdf", &targets::urdfs(), targets::read_urdf);
}

#[test]
fn platform_files() {
    fuzz("platform", &targets::platforms(), targets::read_platform);
}

#[test]
fn solution_files() {
    fuzz("solution", &targets::solutions(), targets::read_solution);
}
