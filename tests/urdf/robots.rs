//! Robots in URDF, and problems about them.

use crate::program::{Folder, Run, edited};
use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::dynamics::Model;
use ffsm_ipopt::nalgebra::Vector3;

pub const ARM: &str = include_str!("../data/urdf/arm.urdf");
pub const TWO_ARMS: &str = include_str!("../data/urdf/two-arms.urdf");
pub const EXPORTED: &str = include_str!("../data/urdf/exported.urdf");
pub const FLOATING: &str = include_str!("../data/urdf/floating-base.urdf");
pub const WRIST: &str = include_str!("../data/urdf/wrist.urdf");
pub const GRIPPER: &str = include_str!("../data/urdf/gripper.urdf");
pub const ROUNDED: &str = include_str!("../data/urdf/rounded.urdf");

/// A folder with `arm.urdf` and a problem whose key `robot` is as given.
pub fn folder(urdf: &str, robot: &str, joints: usize, more: &str) -> Folder {
    let goal = vec!["0.3"; joints].join(", ");
    let start = vec!["0.1"; joints].join(", ");
    let folder = Folder::new(&format!(
        "schema = 1\nname = \"case\"\nrobot = {robot}\n\n[task]\nduration = 20.0\n\
         initial.joints = [{start}]\nfinal.joints = [{goal}]\n\n\
         [cost]\nfinal_base_attitude = 1.0\njoint_rate = 0.2\ncontrol = 0.1\n\n\
         [mesh]\nsegments = 4\npoints = 5\ntolerance = 1e-3\n{more}"
    ));
    folder.write("arm.urdf", urdf);
    folder
}

pub const FILE: &str = "\"arm.urdf\"";
pub const SPACECRAFT: &str = "\n[base]\nmass = 200\ninertia = [20, 21, 22]\ncom = [0.1, 0, 0]\n";

pub fn load(folder: &Folder) -> ProblemFile {
    let path = folder.path().join("case.toml");
    ProblemFile::load(&path, &Overrides::default()).expect("a valid problem")
}

/// The robot of `arm.urdf` and the notes on it.
pub fn read(urdf: &str, joints: usize) -> (Model, Vec<String>) {
    let file = load(&folder(urdf, FILE, joints, ""));
    (file.problem.into_builder().robot, file.notes)
}

/// The one line with which `check` and `plan` refuse the files.
#[track_caller]
pub fn complaint(folder: &Folder) -> String {
    let refused = |command: &str| -> Run {
        let run = folder.run(&[command, "case.toml"]);
        assert_eq!(run.code, 2, "{run:?}");
        assert_eq!(run.stdout, "");
        run
    };
    let run = refused("plan");
    assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    assert_eq!(refused("check").stderr, run.stderr);
    run.stderr.trim_end().to_owned()
}

/// The complaint about an URDF file as a whole.
#[track_caller]
pub fn refusal(urdf: &str) -> String {
    complaint(&folder(urdf, FILE, 2, ""))
}

/// The complaint about `arm.urdf` with `old` replaced.
#[track_caller]
pub fn edit(old: &str, new: &str) -> String {
    refusal(&edited(ARM, old, new))
}

#[track_caller]
pub fn assert_near(found: &Vector3<f64>, expected: [f64; 3]) {
    let gap = (found - Vector3::from(expected)).amax();
    assert!(gap < 1e-12, "{found} instead of {expected:?}");
}
