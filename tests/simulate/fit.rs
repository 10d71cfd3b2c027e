//! Platform parameters from measurements.

use crate::platforms::*;
use crate::problems::smooth;
use ffsm_ipopt::planner::plan;
use ffsm_ipopt::simulate::fit::{Experiments, Measured, Parameter, Scale, Unknown};
use ffsm_ipopt::simulate::{Figures, Platform, Player};

#[test]
fn a_fit_finds_the_platform_that_was_measured() {
    let problem = smooth()
        .edited(|problem| problem.mesh.tolerance = 1e-3)
        .unwrap();
    let plan = plan(&problem).unwrap();
    let player = Player::new(&problem, &plan.discretization, Platform::default()).unwrap();
    let unknown = |key: &str, range: [f64; 2]| Unknown {
        parameter: Parameter::find(key).unwrap(),
        range,
        each: false,
    };
    let unknowns = [
        unknown("payload.inertia", [0.0, 0.5]),
        unknown("capture.point[1]", [-0.4, 0.4]),
    ];
    let truth = [0.12, 0.25];
    let mut hidden = Platform::default();
    hidden.payload.inertia = truth[0];
    hidden.capture.point[1] = truth[1];
    let figures = Figures::measured(&player.on(hidden).run(0).unwrap());
    let measured = |attitude: f64| Measured {
        name: "test".into(),
        max_attitude: Some(figures.max_attitude),
        final_attitude: Some(attitude),
        final_displacement: Some(figures.final_displacement.map(f64::abs)),
    };
    let scale = Scale {
        attitude: 1f64.to_radians(),
        length: 0.01,
    };
    let fit = |attitude: f64| {
        let experiment = (player.clone(), measured(attitude));
        Experiments::new(vec![experiment], scale)
            .fit(&Platform::default(), &unknowns, 2, &|| false)
            .unwrap()
    };
    let found = fit(figures.final_attitude.abs());
    assert!(found.start_residual > 1.0, "{}", found.start_residual);
    assert!(found.residual < 0.02, "{found:?}");
    for (fitted, truth) in found.parameters.iter().zip(truth) {
        assert_near(fitted.value, truth, 5e-3, fitted.parameter.key);
    }
    // What is found with fewer numbers is not missed with more, whatever the start.
    let experiment = (player.clone(), measured(figures.final_attitude.abs()));
    let experiments = Experiments::new(vec![experiment], scale);
    let hypotheses = [unknowns.to_vec(), unknowns[..1].to_vec()];
    let fits = experiments
        .fit_each(&Platform::default(), &hypotheses, 1, &|| false)
        .unwrap();
    assert!(fits[0].residual <= fits[1].residual, "{fits:?}");
    assert_eq!(fits[1].parameters.len(), 1);
    // A final attitude above the largest cannot be: what remains is shared, not hidden.
    let impossible = fit(figures.max_attitude + 4f64.to_radians());
    assert!(impossible.residual > 1.0, "{}", impossible.residual);
    let gap = |k: usize| {
        let c = &impossible.comparisons[k];
        (c.simulated.abs() - c.measured).to_degrees()
    };
    assert!(gap(0) > 1.0 && gap(1) < -1.0, "{} {}", gap(0), gap(1));
}
