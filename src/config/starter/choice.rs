//! Which joints move, where the end effector is, whether a spacecraft is needed.

use crate::config::robot::{Outline, OutlineJoint};

/// What is chosen of a robot.
#[derive(Debug)]
pub(super) struct Choice {
    /// Where each joint is held; `None` for those that move.
    pub locked: Vec<Option<f64>>,
    /// The link at whose frame the end effector is.
    pub end_effector: String,
    /// Mass of the spacecraft under the root link, kg.
    pub spacecraft: Option<f64>,
}

/// Joints along a finger at most.
const FINGER: usize = 4;
/// Joints that an arm has at least, if what follows is to be a hand.
const ARM: usize = 3;
/// Mass of the spacecraft, and of a root link that is one, over that of what moves.
const SPACECRAFT: f64 = 4.0;

impl Choice {
    /// The longest arm moves, without its fingers; all other joints are held.
    pub(super) fn of(robot: &Outline) -> Self {
        let joints = &robot.joints;
        let tip = arm(joints);
        let mut moves = vec![false; joints.len()];
        for joint in path(joints, tip) {
            moves[joint] = !joints[joint].follows;
        }
        let held = |(joint, moves): (&OutlineJoint, &bool)| (!moves).then(|| rest(joint));
        let arms: f64 = joints.iter().map(|joint| joint.mass).sum();
        let heavy = robot
            .root_mass
            .is_some_and(|mass| mass >= SPACECRAFT / 2.0 * arms);
        // Of a kinematic model nothing is known.
        let mass = if arms > 0.0 { arms } else { 10.0 };
        Self {
            locked: joints.iter().zip(&moves).map(held).collect(),
            end_effector: end_effector(robot, tip),
            spacecraft: (!heavy).then(|| rounded(SPACECRAFT * mass)),
        }
    }
}

/// Two digits.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// Where a joint that is held stands: at zero where its limits allow it.
fn rest(joint: &OutlineJoint) -> f64 {
    let [lower, upper] = joint.limits.position;
    if lower <= 0.0 && upper >= 0.0 {
        return 0.0;
    }
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => 0.5 * (lower + upper),
        (true, false) => lower,
        _ => upper,
    }
}

/// The joint at the end of the longest arm; `None` for a robot without joints.
fn arm(joints: &[OutlineJoint]) -> Option<usize> {
    let depth = |joint: usize| {
        let moving = path(joints, Some(joint)).filter(|j| !joints[*j].follows);
        moving.count()
    };
    let leaf = |joint: &usize| !joints.iter().any(|other| other.parent == Some(*joint));
    // The first of several alike.
    let longest = (0..joints.len())
        .filter(leaf)
        .rev()
        .max_by_key(|joint| depth(*joint))?;
    let mut tip = longest;
    for joint in path(joints, Some(longest)) {
        let Some(wrist) = joints[joint].parent else {
            continue;
        };
        let branches = joints
            .iter()
            .filter(|other| other.parent == Some(wrist))
            .count();
        let is_hand = branches > 1 || joints[joint].follows || says_finger(&joints[joint]);
        if is_hand && depth(wrist) >= ARM && height(joints, wrist) <= FINGER {
            tip = wrist;
        }
    }
    Some(tip)
}

fn says_finger(joint: &OutlineJoint) -> bool {
    let name = joint.name.to_lowercase();
    ["finger", "gripper", "jaw", "claw", "thumb"]
        .iter()
        .any(|word| name.contains(word))
}

/// Joints from `tip` to the root.
fn path(joints: &[OutlineJoint], tip: Option<usize>) -> impl Iterator<Item = usize> {
    std::iter::successors(tip, |joint| joints[*joint].parent)
}

/// Joints on the longest way outwards from `joint`, itself left out.
fn height(joints: &[OutlineJoint], joint: usize) -> usize {
    let beyond = |tip: usize| path(joints, Some(tip)).position(|other| other == joint);
    (0..joints.len()).filter_map(beyond).max().unwrap_or(0)
}

/// Words in the names of links to hold things with, the surest first.
const TOOLS: [&str; 10] = [
    "tcp", "tool", "tool0", "ee", "eef", "effector", "grasp", "tip", "flange", "hand",
];

/// The link that is to be the end effector: of those that `tip` carries the one that is called so,
/// or else the link at the tip itself.
fn end_effector(robot: &Outline, tip: Option<usize>) -> String {
    if let Some((name, carrier)) = &robot.tip
        && *carrier == tip
    {
        return name.clone();
    }
    let carried = robot.links.iter().filter(|(_, carrier)| *carrier == tip);
    let names: Vec<&String> = carried.map(|(name, _)| name).collect();
    let called = |word: &str| {
        let has = |name: &&&String| {
            let name = name.to_lowercase();
            name.split(|c: char| !c.is_alphanumeric())
                .any(|part| part == word)
        };
        names.iter().rev().find(has)
    };
    let found = TOOLS.iter().find_map(|word| called(word));
    let own = tip.map_or(&robot.root, |joint| &robot.joints[joint].link);
    found.map_or(own, |name| name).clone()
}
