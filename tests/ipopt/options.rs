//! Options, refused and taken.

use crate::helpers::*;
use crate::programmes::*;
use ffsm_ipopt::nlp::ipopt::{IpoptError, linear_solvers};
use ffsm_ipopt::nlp::{OptionValue, Status};

#[test]
fn a_refused_option_is_named() {
    for (name, value, shown) in [
        (
            "no_such_option",
            OptionValue::Integer(1),
            "no_such_option = 1",
        ),
        (
            "mu_strategy",
            text("sideways"),
            "mu_strategy = \"sideways\"",
        ),
        ("max_iter", OptionValue::Real(2.5), "max_iter = 2.5"),
        ("tol", OptionValue::Real(-1.0), "tol = -1"),
        ("mu_strategy", text("nul\0"), "mu_strategy"),
    ] {
        let error = run(&mut hs071(), &with_option(name, value), &HS071_START).unwrap_err();
        assert!(matches!(&error, IpoptError::OptionRefused { name: named, .. } if named == name));
        assert!(error.to_string().contains(shown), "{error}");
    }
}

#[test]
fn options_by_name_come_last() {
    let settings = with_option("max_iter", OptionValue::Integer(2));
    let solution = run(&mut hs071(), &settings, &HS071_START).unwrap();
    assert_eq!(solution.status, Status::MaxIterations);
    // A whole number will do for a real one.
    let settings = with_option("bound_relax_factor", OptionValue::Integer(0));
    let solution = run(&mut hs071(), &settings, &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
    // MUMPS's own choice of ordering is to be had.
    let mut settings = with_option("mumps_pivot_order", OptionValue::Integer(7));
    settings.linear_solver = "mumps".into();
    let solution = run(&mut hs071(), &settings, &HS071_START).unwrap();
    assert_eq!(solution.status, Status::Solved);
}

#[test]
fn an_absent_linear_solver_is_an_error_and_not_the_end_of_the_process() {
    for name in ["ma97", "MA97", "ma27", "pardiso"] {
        if linear_solvers().contains(&name.into()) {
            continue;
        }
        let error = run(
            &mut hs071(),
            &with_option("linear_solver", text(name)),
            &HS071_START,
        );
        let message = error.unwrap_err().to_string();
        assert!(
            message.contains(&name.to_lowercase()) && message.contains("mumps"),
            "{message}"
        );
    }
    let settings = with_option("nlp_scaling_method", text("equilibration-based"));
    if let Err(error) = run(&mut hs071(), &settings, &HS071_START) {
        assert!(error.to_string().contains("equilibration-based"), "{error}");
    }
}
