//! Way-points as the optimal control problem has them.

use super::GoalRows;
use crate::dynamics::space::Space;
use crate::ocp::{self, Interval, Quantity};
use crate::problem::WayPoint;

/// The same as the optimal control problem has it, whose first states are the `attitude`
/// parameters of the base, and the rows of its goal.
pub(crate) fn formulate<Sp: Space>(
    way_point: &WayPoint,
    index: usize,
    duration: &Interval,
    attitude: usize,
    start: Sp::Linear<f64>,
) -> (ocp::WayPoint, Option<GoalRows<Sp>>) {
    let goal = way_point.end_effector.as_ref();
    let goal = goal.map(|goal| GoalRows::new(goal, start));
    let on_the_way = |row: Quantity| {
        let name = format!("{}, way-point {}", row.name, index + 1);
        Quantity::new(name, row.bounds)
    };
    let bound = |value: &Option<f64>| value.map_or(Interval::FREE, Interval::fixed);
    let joints = way_point
        .joints
        .iter()
        .chain(&way_point.joint_rates)
        .map(bound);
    let point = ocp::WayPoint {
        fraction: way_point.fraction(duration),
        states: std::iter::repeat_n(Interval::FREE, attitude)
            .chain(joints)
            .collect(),
        rows: goal
            .iter()
            .flat_map(GoalRows::quantities)
            .map(on_the_way)
            .collect(),
    };
    (point, goal)
}
