//! The free-floating manipulator as an optimal control problem, eq. (7) to (18).
//!
//! | file | holds |
//! | --- | --- |
//! | `plant` | the robot on its free base with the momentum it started with |
//! | `instant` | what rows and cost terms are functions of: the pose, and the motion at an instant |
//! | `linearization` | its first derivatives at a collocation point |
//! | `rows/`, `cost/` | path and boundary rows and cost terms, one file a kind |
//! | `free_floating`, `formulation` | the problem they make |
//! | `dispatch` | planar or spatial |
//! | `pose_function` | derivatives of what depends on the attitude and the mass centre |
//! | `functions`, `derivatives` | its values, and its derivatives by structure |
//! | `guess`, `straight_line`, `trajectory` | motions: where the search begins, what planning has to beat, what was planned |
//! | `starts/` | paths unlike each other to begin a search with |
//! | `drift`, `tumble` | what a momentum from the start does to the base, for long as well |
//! | `quintic` | the timing law of motions that are made up |
//! | `torques` | joint torques from controls |
//! | `motion`, `accelerations`, `metrics` | a motion over time, its figures, the base angle |
//! | `peaks` | the largest values that the cost is about |
//! | `limits`, `row_values`, `goal_errors` | what gives way, and what was reached |
//! | `shadow_prices` | what each limit costs |
//! | `sizes` | sizes of the task, by which presets of weights are measured |
//! | `impossible/` | what no motion can do, found before any solve |

mod accelerations;
mod cost;
mod derivatives;
mod dispatch;
mod drift;
mod formulation;
mod free_floating;
mod functions;
mod goal_errors;
mod guess;
mod impossible;
mod instant;
mod limits;
mod linearization;
mod metrics;
mod motion;
mod peaks;
mod plant;
mod pose_function;
mod quintic;
mod row_values;
mod rows;
mod shadow_prices;
mod sizes;
mod starts;
mod straight_line;
mod torques;
mod trajectory;
mod tumble;

pub use accelerations::joint_accelerations;
pub use cost::{CostTerm, CostTerms, JointEffort, Side};
pub use dispatch::System;
pub use free_floating::FreeFloating;
pub use goal_errors::{GoalError, goal_errors};
pub use guess::through;
pub use impossible::impossible;
pub use limits::ElasticLimit;
pub use metrics::{
    WatchedPose, at_nodes, base_angles, base_displacements, finely, metrics_of, watched_poses,
};
pub use motion::{Metrics, Trajectory};
pub use peaks::with_peaks;
pub use row_values::cost_terms;
pub use rows::{BoundId, Component, Measure, Row};
pub use shadow_prices::{ShadowPrice, shadow_prices};
pub use sizes::sizes;
pub use starts::StartKind;
pub use straight_line::{StraightLine, straight_line, straight_motion};
pub use trajectory::{at_fractions, limited_angles, resampled};

pub(crate) use dispatch::with_system;
pub(crate) use goal_errors::goal_errors_in;
pub(crate) use guess::{JointPath, along};
pub(crate) use impossible::never_kept;
pub(crate) use metrics::metrics;
pub(crate) use quintic::quintic;
pub(crate) use rows::{ROTATION_ANGLE, of_joint};
pub(crate) use starts::Starts;
pub(crate) use trajectory::trajectory;
pub(crate) use tumble::{by_quaternion, describe, settle, steps as tumbling_steps};
