//! What a programme or a start may not be.

use crate::helpers::*;
use crate::programmes::*;
use ffsm_ipopt::nlp::ipopt::{IpoptError, solve};
use ffsm_ipopt::nlp::{Control, Settings};

#[test]
fn a_start_of_the_wrong_length_is_refused() {
    let error = run(&mut hs071(), &Settings::default(), &[1.0; 3]).unwrap_err();
    assert_eq!(
        error,
        IpoptError::StartDimension {
            what: "variables",
            expected: 4,
            found: 3
        },
        "{error}"
    );
}

#[test]
fn a_start_that_is_not_finite_is_refused_by_name() {
    let error = run(
        &mut hs071(),
        &Settings::default(),
        &[1.0, 5.0, f64::NAN, 1.0],
    )
    .unwrap_err();
    assert!(error.to_string().contains("length 2 is NaN"), "{error}");
}

#[test]
fn a_warm_start_needs_multipliers_and_a_barrier_parameter() {
    let settings = with(|settings| settings.warm_start = Some(1e-6));
    let error = run(&mut hs071(), &settings, &HS071_START).unwrap_err();
    assert_eq!(error, IpoptError::NoMultipliers);
    let settings = with(|settings| settings.warm_start = Some(0.0));
    let error = run(&mut hs071(), &settings, &HS071_START).unwrap_err();
    assert_eq!(error, IpoptError::Barrier(0.0));
    let mut start = run(&mut hs071(), &Settings::default(), &HS071_START)
        .unwrap()
        .iterate;
    start.multipliers[1] = f64::INFINITY;
    let settings = with(|settings| settings.warm_start = Some(1e-6));
    let error = solve(&mut hs071(), &settings, &start, &mut |_| Control::Continue).unwrap_err();
    assert!(
        error.to_string().contains("multiplier of row 1 is inf"),
        "{error}"
    );
}

#[test]
fn bounds_that_leave_no_value_are_refused_by_name() {
    let mut nlp = hs071();
    nlp.variables[0][1] = 6.0;
    let error = run(&mut nlp, &Settings::default(), &HS071_START).unwrap_err();
    assert!(error.to_string().contains("length 1") && error.to_string().contains("6 to 5"));
    for bad in [f64::NAN, f64::INFINITY] {
        let mut nlp = hs071();
        nlp.constraints[0][0] = bad;
        let error = run(&mut nlp, &Settings::default(), &HS071_START).unwrap_err();
        assert!(error.to_string().contains("row 0"), "{error}");
    }
}

#[test]
fn a_programme_without_variables_is_refused() {
    let mut nlp = Dense::new(|_| 0.0, |_, _| {}, |_, _, _, _| {}, free(0));
    let error = run(&mut nlp, &Settings::default(), &[]).unwrap_err();
    assert!(
        matches!(error, IpoptError::Creation { variables: 0, .. }),
        "{error}"
    );
}

#[test]
fn an_entry_above_the_diagonal_is_refused() {
    let mut nlp = Chain {
        points: 3,
        upper: true,
    };
    let error = run(&mut nlp, &Settings::default(), &[0.0; 3]).unwrap_err();
    assert!(
        matches!(
            error,
            IpoptError::Structure {
                entry: 3,
                row: 0,
                column: 1,
                ..
            }
        ),
        "{error}"
    );
}
