//! With which base MATPM would turn as far as was measured.

use crate::dynamics::{Body, Inertia, Model};
use crate::problem::Problem;
use crate::system::straight_line;
use serde::Serialize;

/// Factors on the published inertia among which the answer is sought.
const FACTORS: [f64; 2] = [0.1, 100.0];

/// Inertia of the base about the plane's normal, and how far the base then turns under MATPM, which
/// follows the straight joint path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BaseInertia {
    /// Table I, kg m².
    pub published: f64,
    /// Turn with it, rad.
    pub turn: f64,
    /// The inertia with which it turns as far as was measured, kg m².
    pub needed: f64,
    /// As was measured, rad.
    pub measured: f64,
}

impl BaseInertia {
    /// Finds the inertia with which the base of `problem`'s planar robot ends `measured` (rad) off,
    /// to all digits shown. `None` where none between a tenth and a hundred times the robot's own
    /// does that.
    pub fn explaining(problem: &Problem, measured: f64) -> Option<Self> {
        let turn = |factor: f64| Some(straight_line(&scaled(problem, factor)?).base_attitude[0]);
        // A base that is harder to turn turns less.
        let [mut low, mut high] = FACTORS;
        if turn(low)?.abs() < measured || turn(high)?.abs() > measured {
            return None;
        }
        while high / low > 1.0 + 1e-9 {
            let middle = (low * high).sqrt();
            if turn(middle)?.abs() > measured {
                low = middle;
            } else {
                high = middle;
            }
        }
        let published = spin(&problem.robot)?;
        Some(Self {
            published,
            turn: turn(1.0)?,
            needed: published * low,
            measured,
        })
    }
}

/// Inertia of the base about the plane's normal.
fn spin(robot: &Model) -> Option<f64> {
    let normal = robot.plane()?.basis.column(2).into_owned();
    Some(normal.dot(&(robot.base().inertia.rotational() * normal)))
}

fn scaled(problem: &Problem, factor: f64) -> Option<Problem> {
    let robot = &problem.robot;
    let Body { name, inertia } = robot.base();
    let rotational = inertia.rotational() * factor;
    let base = Body {
        name: name.clone(),
        inertia: Inertia::new(inertia.mass(), *inertia.center(), rotational).ok()?,
    };
    let robot = Model::new(robot.name(), base, robot.joints().to_vec()).ok()?;
    problem.edited(|scaled| scaled.robot = robot).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::ProblemFile;

    #[test]
    fn the_inertia_found_turns_the_base_as_far_as_asked_for() {
        let problem = ProblemFile::shipped("table1-relaxed").unwrap().problem;
        let found = BaseInertia::explaining(&problem, 25.8f64.to_radians()).unwrap();
        assert_eq!(found.published, 0.1454);
        let again = scaled(&problem, found.needed / found.published).unwrap();
        let turn = straight_line(&again).base_attitude[0].to_degrees();
        assert!((turn + 25.8).abs() < 1e-6, "{turn}");
        assert_eq!(BaseInertia::explaining(&problem, 3.0), None);
    }
}
