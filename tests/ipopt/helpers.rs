//! What the tests share: runs, comparisons, tests in a process of their own.

use crate::programmes::Dense;
use ffsm_ipopt::nlp::ipopt::{IpoptError, solve};
use ffsm_ipopt::nlp::{Control, Iterate, Nlp, OptionValue, Settings, Solution};
use std::path::Path;
use std::process::Command;

pub fn run(nlp: &mut impl Nlp, settings: &Settings, start: &[f64]) -> Result<Solution, IpoptError> {
    solve(nlp, settings, &Iterate::primal(start.to_vec()), &mut |_| {
        Control::Continue
    })
}

pub fn with_option(name: &str, value: OptionValue) -> Settings {
    with(|settings| settings.options = vec![(name.into(), value)])
}

/// The default settings with a change.
pub fn with(change: impl FnOnce(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    change(&mut settings);
    settings
}

pub fn text(value: &str) -> OptionValue {
    OptionValue::Text(value.into())
}

pub fn assert_near(found: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!(
            (found - wanted).abs() <= tolerance,
            "{found} is not {wanted} to {tolerance}"
        );
    }
}

/// A bound as Ipopt relaxes it, and a little more.
pub fn relaxed(bound: f64, outwards: f64) -> f64 {
    bound + outwards * 1.01e-8 * bound.abs().max(1.0)
}

/// Asserts stationarity, complementarity and signs, worked out from the programme itself.
pub fn assert_optimal(nlp: &mut Dense, solution: &Solution, tolerance: f64) {
    let (n, m) = (nlp.n(), nlp.m());
    let Iterate {
        x,
        multipliers,
        lower_multipliers,
        upper_multipliers,
    } = &solution.iterate;
    let (mut df, mut dg, mut g) = (vec![0.0; n], vec![0.0; n * m], vec![0.0; m]);
    (nlp.df)(x, &mut df);
    (nlp.dg)(x, &mut dg);
    (nlp.g)(x, &mut g);
    assert_near(&solution.constraints, &g, 1e-12);
    assert_near(&[solution.objective], &[(nlp.f)(x)], 1e-12);
    for j in 0..n {
        let [lower, upper] = [nlp.variables[0][j], nlp.variables[1][j]];
        let (z_lower, z_upper) = (lower_multipliers[j], upper_multipliers[j]);
        let inside = relaxed(lower, -1.0)..=relaxed(upper, 1.0);
        assert!(inside.contains(&x[j]), "variable {j} is inside");
        assert!(z_lower >= 0.0 && z_upper >= 0.0);
        if lower == upper {
            continue;
        }
        let reduced = df[j] + (0..m).map(|i| multipliers[i] * dg[i * n + j]).sum::<f64>();
        assert!(
            (reduced - z_lower + z_upper).abs() <= tolerance,
            "variable {j} is stationary"
        );
        assert!(lower.is_infinite() || z_lower * (x[j] - lower) <= tolerance);
        assert!(upper.is_infinite() || z_upper * (upper - x[j]) <= tolerance);
    }
    for i in 0..m {
        let [lower, upper] = [nlp.constraints[0][i], nlp.constraints[1][i]];
        let inside = relaxed(lower, -1.0)..=relaxed(upper, 1.0);
        assert!(
            lower == upper && (g[i] - lower).abs() <= tolerance || inside.contains(&g[i]),
            "row {i} is feasible"
        );
        if lower < upper {
            // In f + λᵀg a lower bound pushes with λ < 0, an upper one with λ > 0.
            let active = if multipliers[i] < 0.0 {
                g[i] - lower
            } else {
                upper - g[i]
            };
            assert!(
                multipliers[i].abs() <= tolerance || active <= 1e-6,
                "row {i} is complementary"
            );
        }
    }
}

/// Runs one of these tests alone in another process, with `directory` its working directory and
/// `FFSM_CHILD` set; returns what it printed.
pub fn child(test: &str, directory: &Path) -> String {
    let output = Command::new(std::env::current_exe().expect("this test's own path"))
        .args([test, "--exact", "--nocapture", "--test-threads=1"])
        .env("FFSM_CHILD", "1")
        .current_dir(directory)
        .output()
        .expect("the test starts again");
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success(),
        "{printed}\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(
        printed.contains("1 passed"),
        "no test is named {test}: {printed}"
    );
    printed
}

pub fn is_child() -> bool {
    std::env::var_os("FFSM_CHILD").is_some()
}
