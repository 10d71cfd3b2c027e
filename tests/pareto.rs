//! The trade-off between base and joints: by weights, and by a bound on the base's motion.

mod problems;

use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::planner::{Status, plan};
use ffsm_ipopt::problem::{LimitId, Problem};
use ffsm_ipopt::study::pareto::{ParetoFront, factors};
use ffsm_ipopt::study::search::SearchEvent;
use ffsm_ipopt::system::cost_terms;

/// Base motion B and joint effort E of the best motion under `problem`.
fn sides(problem: &Problem) -> (f64, f64) {
    let plan = plan(problem).unwrap();
    assert_eq!(plan.status, Status::Solved);
    let terms = cost_terms(problem, &plan.discretization);
    (terms.base(), terms.joints())
}

/// The problem of Section IV.A with a smooth control, whose front is convex.
fn weighed(factor: f64) -> Problem {
    let edited = problems::smooth().edited(|problem| {
        let cost = &mut problem.cost;
        for weights in [
            &mut cost.base_rate,
            &mut cost.final_base_attitude,
            &mut cost.final_base_position,
        ] {
            weights.iter_mut().for_each(|weight| *weight *= factor);
        }
        problem.mesh.tolerance = 1e-6;
    });
    edited.unwrap()
}

/// On a convex front the least effort for a given base motion is that of the weights which lead to that
/// base motion: two different programmes with one answer.
#[test]
fn a_bound_on_base_motion_gives_what_weights_give() {
    let factor = 30.0;
    let (base, effort) = sides(&weighed(factor));
    let (base, free) = (base / factor, sides(&weighed(1.0)).0);
    assert!(free > 1.01 * base, "{free} {base}");
    let bounded = weighed(1.0).edited(|problem| problem.limits.base_motion = base);
    let (reached, least) = sides(&bounded.unwrap());
    assert!((reached / base - 1.0).abs() < 1e-5, "{reached} {base}");
    assert!((least / effort - 1.0).abs() < 1e-3, "{least} {effort}");
}

#[test]
fn less_base_motion_than_there_can_be_is_infeasible_and_diagnosed() {
    let free = sides(&weighed(1.0)).0;
    let bounded = weighed(1.0).edited(|problem| problem.limits.base_motion = 1e-3 * free);
    let plan = plan(&bounded.unwrap()).unwrap();
    assert_eq!(plan.status, Status::Infeasible);
    let diagnosis = plan.diagnosis.unwrap();
    let found = diagnosis
        .limits
        .iter()
        .find(|finding| finding.limit == LimitId::BaseMotion)
        .unwrap();
    assert!(found.smallest_bound.upper > 1e-3 * free);
}

#[test]
fn what_is_bounded_has_a_weight() {
    let unweighed = problems::smooth().edited(|problem| {
        for entry in problem.cost.entries_mut() {
            if entry.components.is_on_base() {
                entry.weights.fill(0.0);
            }
        }
        problem.limits.base_motion = 1.0;
    });
    assert_eq!(unweighed.unwrap_err().key, "limits.base_motion");
    let none = problems::smooth().edited(|problem| problem.limits.base_motion = 0.0);
    assert_eq!(none.unwrap_err().key, "limits.base_motion");
}

/// Between two optima of other kinds there is a part that no factor leads to; there B is bounded.
#[test]
fn gaps_that_no_factor_leads_into_are_filled_under_bounds() {
    let problem = problems::relaxed();
    let mut front = ParetoFront::new(&problem);
    let go_on = |_: f64, _: &SearchEvent<'_>| Control::Continue;
    front
        .sweep(&factors(1.0, 1000.0, 2), &mut { go_on })
        .unwrap();
    front.fill(6, &mut { go_on }).unwrap();
    let points = front.points();
    for pair in points.windows(2) {
        assert!(pair[0].base >= pair[1].base * (1.0 - 1e-9), "{pair:?}");
        assert!(pair[0].joints <= pair[1].joints * (1.0 + 1e-9), "{pair:?}");
    }
    let bounded = points
        .iter()
        .filter_map(|point| Some((point.bound?, point)));
    for (bound, point) in bounded {
        assert_eq!(point.plan.status, Status::Solved);
        assert!(point.base <= bound * (1.0 + 1e-6));
    }
}
