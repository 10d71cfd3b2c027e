//! Whatever ends a batch, `--resume` ends with the rows of one that nothing disturbed.

use crate::program::{Folder, PROBLEM, edited};
use crate::rows::*;
use ffsm_ipopt::config::BatchFile;
use ffsm_ipopt::nlp::ipopt::interrupt;
use ffsm_ipopt::study::batch::{RowPlanner, RowStatus};
use std::cell::Cell;
use std::process::{Child, Command};
use std::time::Duration;

/// Rows enough to be ended among.
fn many() -> Folder {
    let folder = folder(&edited(BATCH, "count = 12", "count = 400"));
    // Plans of some length, so that batches last seconds.
    folder.write(
        "case.toml",
        &edited(PROBLEM, "segments = 4", "segments = 12"),
    );
    folder
}

fn send(signal: &str, process: u32) {
    // The shell's own: a bare Debian has no program of that name. One that is gone is no failure.
    let kill = format!("kill -{signal} {process} 2>/dev/null");
    Command::new("sh").args(["-c", &kill]).status().unwrap();
}

/// The workers of a batch.
fn workers(of: &Child) -> Vec<u32> {
    let children = format!("/proc/{0}/task", of.id());
    let tasks = std::fs::read_dir(children).into_iter().flatten().flatten();
    let lists = tasks.filter_map(|task| std::fs::read_to_string(task.path().join("children")).ok());
    let ids: Vec<u32> = lists
        .flat_map(|list| {
            list.split_whitespace()
                .filter_map(|id| id.parse().ok())
                .collect::<Vec<_>>()
        })
        .collect();
    ids
}

/// `FFSM_BATCH_KILLS=50` for the whole of it.
#[test]
fn killed_at_random_moments_a_batch_loses_nothing() {
    let kills = std::env::var("FFSM_BATCH_KILLS").ok();
    let kills: u32 = kills.map_or(6, |kills| kills.parse().expect("a number"));
    let folder = many();
    plan(&folder, "undisturbed", &[]);
    let expected = rows(&folder, "undisturbed");
    assert_eq!(expected.len(), 400);
    let mut random = fastrand::Rng::with_seed(11);
    let mut left = kills;
    while left > 0 {
        let out = format!("o{left}");
        // Some runs in threads, some in processes; workers killed first, then all.
        loop {
            let isolated = random.bool();
            let arguments: &[&str] = match isolated {
                true => &["--resume", "--isolate", "--jobs", "2"],
                false => &["--resume", "--jobs", "2"],
            };
            let mut child = begin(&folder, &out, arguments);
            std::thread::sleep(Duration::from_millis(random.u64(20..3000)));
            if isolated && random.bool() {
                workers(&child)
                    .into_iter()
                    .for_each(|worker| send("KILL", worker));
                std::thread::sleep(Duration::from_millis(random.u64(0..500)));
            }
            if left > 0 {
                left -= 1;
                let _ = child.kill();
            }
            if child.wait().unwrap().success() {
                break;
            }
            if left == 0 {
                plan(&folder, &out, &["--resume"]);
                break;
            }
        }
        assert_eq!(rows(&folder, &out), expected);
    }
}

#[test]
fn signals_end_a_batch_that_goes_on_later() {
    let folder = many();
    for (signal, isolate) in [("INT", false), ("TERM", true)] {
        let out = format!("o-{signal}");
        let arguments: &[&str] = if isolate { &["--isolate"] } else { &[] };
        let mut child = begin(&folder, &out, arguments);
        wait_for_part(&folder, &out);
        let at_work = workers(&child);
        assert_eq!(at_work.is_empty(), !isolate);
        send(signal, child.id());
        assert_eq!(child.wait().unwrap().code(), Some(130));
        for worker in at_work {
            assert!(
                !std::path::Path::new(&format!("/proc/{worker}")).exists(),
                "left behind"
            );
        }
        let kept = rows(&folder, &out);
        assert!(!kept.is_empty() && kept.len() < 400, "{}", kept.len());
        for row in kept.values() {
            assert_eq!(row["status"], "solved");
        }
        plan(&folder, &out, &["--resume"]);
        let all = rows(&folder, &out);
        assert_eq!(all.len(), 400);
        assert!(kept.iter().all(|(position, row)| all[position] == *row));
    }
}

#[test]
fn a_second_run_into_one_folder_is_refused() {
    let folder = many();
    let mut first = begin(&folder, "o", &[]);
    wait_for_part(&folder, "o");
    for arguments in [&["--resume"][..], &["--shard", "1/2"]] {
        let all = [&["batch", "batch.toml", "--out", "o"], arguments].concat();
        let run = folder.run(&all);
        assert_eq!(run.code, 2, "{run:?}");
        assert_eq!(
            run.stderr,
            "o: another run writes to it; wait for its end, or choose another --out\n"
        );
    }
    // Reading it needs no permission.
    assert_eq!(folder.run(&["batch", "show", "o"]).code, 0);
    let _ = first.kill();
    first.wait().unwrap();
}

/// Needs a file system of its own, and so the right to mount one.
#[test]
fn a_full_disk_ends_a_batch_that_goes_on_later() {
    let folder = folder(&edited(BATCH, "count = 12", "count = 60"));
    let disk = folder.path().join("disk");
    std::fs::create_dir(&disk).unwrap();
    let mount = |options: &str| {
        let mut command = Command::new("mount");
        command
            .args(["-t", "tmpfs", "-o", options, "tmpfs"])
            .arg(&disk);
        command.output().is_ok_and(|output| output.status.success())
    };
    if !mount("size=64k") {
        eprintln!("skipped: no right to mount a tmpfs");
        return;
    }
    let run = folder.run(&["batch", "batch.toml", "--out", "disk/o", "--trajectories"]);
    let full = (run.code, run.stderr.clone());
    let grown = mount("remount,size=64m");
    let again = folder.run(&[
        "batch",
        "batch.toml",
        "--out",
        "disk/o",
        "--trajectories",
        "--resume",
        "--quiet",
    ]);
    let found = std::panic::catch_unwind(|| rows(&folder, "disk/o"));
    Command::new("umount").arg(&disk).status().unwrap();
    assert!(grown);
    assert_eq!(full.0, 1, "{run:?}");
    assert!(full.1.contains("No space left on device"), "{}", full.1);
    assert!(full.1.contains("--resume goes on from there"), "{}", full.1);
    assert_eq!(again.code, 0, "{again:?}");
    plan(&folder, "o", &["--trajectories"]);
    assert_eq!(found.unwrap(), rows(&folder, "o"));
}

/// Whoever reads the folder meanwhile finds parts that are whole.
#[test]
fn a_data_set_is_readable_while_it_grows() {
    let folder = many();
    let mut child = begin(&folder, "o", &[]);
    let mut most = 0;
    wait_for_part(&folder, "o");
    while child.try_wait().unwrap().is_none() {
        let count = rows(&folder, "o").len();
        assert!(count >= most, "{count} after {most}");
        most = count;
        std::thread::sleep(Duration::from_millis(50));
    }
    assert!(child.wait().unwrap().success());
    assert_eq!(rows(&folder, "o").len(), 400);
}

#[test]
fn a_row_that_is_stopped_ends_alone() {
    let folder = folder(BATCH);
    let batch = BatchFile::load(&folder.path().join("batch.toml"), None).expect("a batch");
    let mut planner = RowPlanner::new(None, false);
    let asked = Cell::new(0);
    let stopped = || {
        asked.set(asked.get() + 1);
        asked.get() > 3
    };
    let row = planner.plan_until(&batch, 0, &stopped);
    assert_eq!(row.status, RowStatus::Interrupted);
    assert!(!interrupt::requested());
    assert_eq!(planner.plan(&batch, 0).status, RowStatus::Solved);
}
