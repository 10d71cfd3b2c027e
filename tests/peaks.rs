//! The largest values along the path as a cost, presets of weights, what planning gained and what limits
//! cost.

mod problems;

use ffsm_ipopt::config::{Overrides, ProblemFile};
use ffsm_ipopt::nlp::Control;
use ffsm_ipopt::ocp::Interval;
use ffsm_ipopt::planner::{Method, Plan, Planner, Start, Status, plan};
use ffsm_ipopt::problem::{CostId, LimitId, Preset, Problem, ProblemBuilder, Sizes};
use ffsm_ipopt::report;
use ffsm_ipopt::study::{BaseMotion, Baselines, Gain};
use ffsm_ipopt::system::{cost_terms, shadow_prices};
use ffsm_ipopt::verify::verify;

/// `table1-smooth` with a weight on the largest base angle.
fn peaked() -> Problem {
    let edited = problems::smooth().edited(|problem| {
        problem.name = "peaked".into();
        problem.cost.peak_base_attitude = vec![20.0];
    });
    edited.unwrap()
}

fn solved(problem: &Problem) -> Plan {
    let plan = plan(problem).unwrap();
    assert_eq!(plan.status, Status::Solved, "{:?}", plan.warnings);
    plan
}

#[test]
fn the_peak_is_the_largest_angle_and_no_larger() {
    let problem = peaked();
    let plan = solved(&problem);
    let [peak] = plan.discretization.parameters[..] else {
        panic!("{:?}", plan.discretization.parameters);
    };
    let largest = plan.metrics.max_base_attitude;
    assert!((peak - largest).abs() < 1e-3 * peak, "{peak}, {largest}");
    let without = solved(&problems::smooth());
    assert!(largest < without.metrics.max_base_attitude);
    // Its share of J, and all of J, follow from the motion alone.
    let terms = cost_terms(&problem, &plan.discretization);
    assert!((terms.of(CostId::PeakBaseAttitude) - 20.0 * peak).abs() < 1e-6);
    assert!((terms.total() - plan.objective).abs() < 1e-6);
}

/// The hand goes 2.7 m; the straight path to the same joint positions turns the base by 11.7°.
#[test]
fn the_shipped_arm_keeps_its_base_still() {
    let file = ProblemFile::load("config/still-base.toml".as_ref(), &Overrides::default());
    let problem = file.unwrap().problem;
    let plan = solved(&problem);
    assert!(plan.metrics.max_base_attitude.to_degrees() < 0.25);
    let straight = Baselines::of(&problem, &plan.discretization)
        .straight
        .unwrap();
    assert!(straight.largest.to_degrees() > 11.0);
    let verification = verify(&problem, &plan.discretization).unwrap();
    assert!(verification.max_base_attitude_drift.to_degrees() < 1e-3);
}

#[test]
fn a_bound_at_the_peak_gives_the_same_motion() {
    let plan = solved(&peaked());
    let peak = plan.discretization.parameters[0];
    let bounded = problems::smooth().edited(|problem| {
        problem.limits.base_attitude = vec![Interval::symmetric(peak)];
    });
    let other = solved(&bounded.unwrap());
    let own = plan.objective - 20.0 * peak;
    assert!((other.objective - own).abs() < 1e-5 * own, "{own}");
}

/// The shipped chaser on its first mesh alone, its base turned by one rotation angle. Without a peak the
/// bound on that angle is the argument.
fn chaser(edit: impl FnOnce(&mut ProblemBuilder)) -> Problem {
    let overrides = [r#"base.attitude="quaternion""#, "mesh.max_iterations=1"].map(String::from);
    let overrides = Overrides::of(&overrides).unwrap();
    let file = ProblemFile::load("config/chaser-7dof.toml".as_ref(), &overrides).unwrap();
    file.problem.edited(edit).unwrap()
}

/// The first solve of `problem` from the motion and the multipliers of `from`.
fn first_solve(problem: &Problem, from: &Plan) -> Plan {
    let start = Start {
        trajectory: from.discretization.clone(),
        iterate: Some(from.iterate.clone()),
    };
    let mut planner = Planner::new();
    let found = planner.plan_with(problem, Some(&start), &mut |_| Control::Continue);
    found.unwrap()
}

/// Where a bound's shadow price is the weight of the peak, the bound is the peak: found by bisection.
#[test]
fn the_chasers_peak_is_what_bisection_on_the_bound_finds() {
    let weight = 10.0;
    let peaked = chaser(|problem| problem.cost.peak_base_attitude = vec![weight]);
    let plan = plan(&peaked).unwrap();
    let peak = plan.discretization.parameters[0];
    let own = plan.objective - weight * peak;

    let (mut low, mut high) = (0.97 * peak, 1.03 * peak);
    let mut nearest = f64::INFINITY;
    while high - low > 2e-5 * peak {
        let bound = 0.5 * (low + high);
        let bounded = chaser(|problem| {
            problem.limits.base_attitude = vec![Interval::symmetric(bound)];
        });
        let found = first_solve(&bounded, &plan);
        let prices = shadow_prices(&bounded, &found.discretization, &found.iterate);
        let of_bound = prices
            .iter()
            .filter(|p| p.id.limit == LimitId::BaseAttitude);
        // A price is that of a wider bound by a part of its size.
        let price = of_bound.map(|p| p.price).sum::<f64>() / bound;
        if price > weight {
            low = bound;
        } else {
            high = bound;
        }
        nearest = nearest.min((found.objective - own).abs());
    }
    let found = 0.5 * (low + high);
    assert!((found - peak).abs() < 1e-4 * peak, "{found}, {peak}");
    assert!(nearest < 1e-4 * own, "{nearest:e}, {own}");
}

#[test]
fn displacement_and_rate_have_peaks_as_well() {
    let plain = solved(&problems::smooth());
    let largest = |plan: &Plan| {
        let rows = plan.trajectory.base_rate.iter().flatten();
        rows.fold(0.0, |most: f64, rate| most.max(rate.abs()))
    };
    let slow = problems::smooth().edited(|problem| problem.cost.peak_base_rate = vec![20.0]);
    let slow = solved(&slow.unwrap());
    assert!(largest(&slow) < 0.99 * largest(&plain));
    assert!((slow.discretization.parameters[0] - largest(&slow)).abs() < 1e-6);
    let near = problems::smooth().edited(|problem| problem.cost.peak_base_position = vec![50.0]);
    let near = solved(&near.unwrap());
    let [a, b] = [&near, &plain].map(|plan| plan.metrics.max_base_displacement);
    assert!(a <= b, "{a} and {b}");
    assert!((near.discretization.parameters[0] - a).abs() < 1e-3 * a);
}

#[test]
fn a_saved_motion_is_a_start_with_or_without_peaks() {
    let with = solved(&peaked());
    let without = solved(&problems::smooth());
    for (problem, from) in [
        (peaked(), &without),
        (peaked(), &with),
        (problems::smooth(), &with),
    ] {
        let start = Start {
            trajectory: from.discretization.clone(),
            iterate: Some(from.iterate.clone()),
        };
        let mut planner = Planner::new();
        let found = planner.plan_with(&problem, Some(&start), &mut |_| Control::Continue);
        let found = found.unwrap();
        assert_eq!(found.status, Status::Solved);
        let again = if problem.cost.peak_base_attitude[0] > 0.0 {
            &with
        } else {
            &without
        };
        assert!((found.objective - again.objective).abs() < 1e-6 * again.objective);
    }
}

#[test]
fn no_place_is_forbidden_by_a_peak() {
    let found = ffsm_ipopt::system::impossible(&peaked());
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn a_plan_without_parameters_has_peaks_in_its_cost() {
    let problem = peaked();
    let plan = Planner::new().plan_by(Method::Matpm, &problem, None, &mut |_| Control::Continue);
    let plan = plan.unwrap();
    let peak = 20.0 * plan.metrics.max_base_attitude;
    let share = plan.cost_terms.of(CostId::PeakBaseAttitude);
    assert!((share - peak).abs() < 1e-6 * peak, "{share}, {peak}");
}

#[test]
fn presets_are_in_units_of_the_problem() {
    let mut problem = problems::relaxed().into_builder();
    let sizes = Sizes::new(20.0, 0.5, 2.0);
    Preset::Still.weigh(&sizes, &mut problem.cost);
    let still = problem.cost.clone();
    Preset::Gentle.weigh(&sizes, &mut problem.cost);
    let gentle = problem.cost.clone();
    // The straight path's effort costs one a term, and the base more the more it is to be still.
    assert!((still.joint_rate[0] * 2.0 / 20.0 - 1.0).abs() < 1e-12);
    assert!((still.control[0] * 12.0 * 2.0 / 8000.0 - 1.0).abs() < 1e-12);
    let of = |weight: f64| weight * 0.25;
    assert!(of(still.final_base_attitude[0]) > of(gentle.final_base_attitude[0]));
    assert!((still.base_attitude[0] * 20.0 - still.final_base_attitude[0]).abs() < 1e-9);
    problem.cost = problems::smooth().cost.clone();
    Preset::Paper.weigh(&sizes, &mut problem.cost);
    assert_eq!(problem.cost.final_base_attitude, [1.0]);
    assert_eq!(problem.cost.base_rate, [0.6]);
    assert_eq!(problem.cost.joint_rate, [0.2; 2]);
}

#[test]
fn explicit_weights_win_over_a_preset() {
    let overrides = ["cost.preset=\"still\"", "cost.control=0.25"].map(String::from);
    let load = |overrides: &[String]| {
        let overrides = Overrides::of(overrides).unwrap();
        ProblemFile::load("config/table1-smooth.toml".as_ref(), &overrides)
    };
    let cost = load(&overrides).unwrap().problem.cost.clone();
    assert_eq!(cost.control, [0.25; 2]);
    // Those of the file win as well.
    assert_eq!(cost.joint_rate, [0.2; 2]);
    assert!(cost.base_attitude[0] > 0.0);
    let refused = load(&["cost.preset=\"calm\"".into()])
        .unwrap_err()
        .to_string();
    assert!(
        refused.contains("\"still\" or \"gentle\" or \"paper\""),
        "{refused}"
    );
}

#[test]
fn what_was_gained_is_said() {
    let motion = |largest: f64, last: f64| BaseMotion { largest, last };
    let straight = motion(0.5, 0.4);
    for (planned, expected) in [
        (motion(0.1, 0.05), Gain::Clear),
        (motion(0.48, 0.39), Gain::Little),
        (motion(0.6, 0.01), Gain::EndAlone),
    ] {
        assert_eq!(Gain::of(planned, straight), expected);
    }
    assert_eq!(Gain::of(straight, motion(0.0, 0.0)), Gain::Needless);

    let problem = problems::smooth();
    let plan = solved(&problem);
    let found = Baselines::of(&problem, &plan.discretization);
    let straight = found.straight.unwrap();
    assert!((straight.last.to_degrees() - 36.648_820).abs() < 1e-4);
    assert!((found.matpm.unwrap().last - straight.last).abs() < 1e-3);
    let planned = BaseMotion::planned(&plan.metrics);
    assert_eq!(Gain::of(planned, straight), Gain::Little);
    let summary = report::summary(&problem, &plan, &found, &[]);
    assert!(summary.contains("straight line"), "{summary}");
    assert!(
        summary.contains("hardly less than along the straight joint path"),
        "{summary}"
    );
}

/// Each price against the cost of the problem planned again with that limit wider and narrower.
#[test]
fn prices_foretell_what_wider_limits_save() {
    let limited = |limit: LimitId, by: f64| {
        let bounds = |size: f64| Interval::symmetric(by * size);
        let edited = problems::smooth().edited(|problem| match limit {
            LimitId::JointVelocity => {
                problem.limits.joint_velocity = vec![bounds(0.028), bounds(0.056)];
            }
            LimitId::FinalBaseAttitude => problem.limits.final_base_attitude = vec![bounds(0.62)],
            LimitId::BaseAttitude => problem.limits.base_attitude = vec![bounds(0.62)],
            _ => problem.limits.base_rate = vec![bounds(0.034)],
        });
        edited.unwrap()
    };
    // Bounds of states along the path, of a state that is largest at t_f, and of a path row.
    for limit in [
        LimitId::JointVelocity,
        LimitId::FinalBaseAttitude,
        LimitId::BaseAttitude,
        LimitId::BaseRate,
    ] {
        let problem = limited(limit, 1.0);
        let plan = solved(&problem);
        let prices = shadow_prices(&problem, &plan.discretization, &plan.iterate);
        assert_eq!(prices[0].id.limit, limit);
        let price: f64 = prices
            .iter()
            .filter(|found| found.id.limit == limit)
            .map(|found| found.price)
            .sum();
        let cost = |by: f64| solved(&limited(limit, by)).objective;
        let slope = (cost(0.999) - cost(1.001)) / 2e-3;
        let close = (price - slope).abs() < 0.03 * slope;
        assert!(close, "{limit:?}: {price:e}, {slope:e}");
        let others = prices.iter().filter(|found| found.id.limit != limit);
        let others: f64 = others.map(|found| found.price).sum();
        assert!(others < 0.05 * price, "{limit:?}: {prices:?}");

        let mut without = plan.iterate.clone();
        without.multipliers.clear();
        assert!(shadow_prices(&problem, &plan.discretization, &without).is_empty());
    }
}
