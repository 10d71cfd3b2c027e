//! What an option of Ipopt can do beyond steering a solve.
//!
//! Some options name a library that Ipopt loads and runs, or a file that it reads or writes. A problem
//! file that comes from somebody else must not do either. Text options that are known to choose
//! between Ipopt's own algorithms are listed; whatever else takes a text may be a path.

use crate::nlp::{LinearSolver, OptionValue};
use std::fmt;

/// What an option can do beyond steering a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum OptionAccess {
    /// Load a library and run code in it.
    Code,
    /// Read or write files.
    Files,
    /// Not known: the option takes a text and is none of the known ones.
    Unknown,
}

impl fmt::Display for OptionAccess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Code => "loads a library",
            Self::Files => "reads or writes files",
            Self::Unknown => "is not known to do without libraries and files",
        })
    }
}

/// Options that write files or load libraries without a path as their value.
const FILES: [&str; 6] = [
    "wsmp_write_matrix_iteration",
    "ma97_dump_matrix",
    "output_file",
    "option_file_name",
    "file_print_level",
    "file_append",
];

/// Options that name a library.
const CODE: [&str; 4] = ["hsllib", "pardisolib", "wsmplib", "spral_use_gpu"];

/// Values, of an option that is otherwise harmless, for which a library is loaded.
const CODE_VALUES: [(&str, &[&str]); 3] = [
    ("nlp_scaling_method", &["equilibration-based"]),
    ("linear_system_scaling", &["mc19"]),
    ("dependency_detector", &["ma28", "wsmp"]),
];

/// Options that take a word and choose by it between Ipopt's own algorithms, of 3.11 to 3.14.
const HARMLESS: [&str; 66] = [
    "accept_every_trial_step",
    "adaptive_mu_globalization",
    "adaptive_mu_kkt_norm_type",
    "adaptive_mu_restore_previous_iterate",
    "alpha_for_y",
    "bound_mult_init_method",
    "check_derivatives_for_naninf",
    "corrector_type",
    "dependency_detection_with_rhs",
    "dependency_detector",
    "derivative_test",
    "derivative_test_print_all",
    "evaluate_orig_obj_at_resto_trial",
    "expect_infeasible_problem",
    "fast_step_computation",
    "fixed_mu_oracle",
    "fixed_variable_treatment",
    "flexible_penalty_function",
    "grad_f_constant",
    "gradient_approximation",
    "hessian_approximation",
    "hessian_approximation_space",
    "hessian_constant",
    "honor_original_bounds",
    "inf_pr_output",
    "jac_c_constant",
    "jac_d_constant",
    "jacobian_approximation",
    "least_square_init_duals",
    "least_square_init_primal",
    "limited_memory_aug_solver",
    "limited_memory_initialization",
    "limited_memory_special_for_resto",
    "limited_memory_update_type",
    "line_search_method",
    "linear_scaling_on_demand",
    "linear_system_scaling",
    "ma27_ignore_singularity",
    "ma27_skip_inertia_check",
    "ma57_automatic_scaling",
    "ma77_order",
    "ma86_order",
    "ma86_scaling",
    "ma97_order",
    "ma97_scaling",
    "magic_steps",
    "mehrotra_algorithm",
    "mu_allow_fast_monotone_decrease",
    "mu_oracle",
    "mu_strategy",
    "neg_curv_test_reg",
    "nlp_scaling_method",
    "perturb_always_cd",
    "print_info_string",
    "print_timing_statistics",
    "quality_function_balancing_term",
    "quality_function_centrality",
    "quality_function_norm_type",
    "recalc_y",
    "replace_bounds",
    "skip_corr_if_neg_curv",
    "skip_corr_in_monotone_mode",
    "start_with_resto",
    "timing_statistics",
    "warm_start_init_point",
    "warm_start_same_structure",
];

/// What the option `name` with `value` can do beyond steering a solve; `None` where that is nothing.
pub fn access_of_option(name: &str, value: &OptionValue) -> Option<OptionAccess> {
    let name = name.to_ascii_lowercase();
    // Ipopt's own parts may have options of their own, by a prefix.
    let name = name.rsplit('.').next().unwrap_or_default();
    if CODE.contains(&name) {
        return Some(OptionAccess::Code);
    }
    if FILES.contains(&name) {
        return Some(OptionAccess::Files);
    }
    let OptionValue::Text(value) = value else {
        return None;
    };
    if name == "linear_solver" {
        return access_of_solver(&value.as_str().into());
    }
    let mut loading = CODE_VALUES.iter().filter(|(option, _)| *option == name);
    let is_loading =
        |(_, values): &(&str, &[&str])| values.iter().any(|of| value.eq_ignore_ascii_case(of));
    if loading.any(is_loading) {
        Some(OptionAccess::Code)
    } else if HARMLESS.contains(&name) {
        None
    } else {
        Some(OptionAccess::Unknown)
    }
}

/// What the linear solver does beyond solving: all but those built in are loaded from a library.
pub fn access_of_solver(solver: &LinearSolver) -> Option<OptionAccess> {
    match solver {
        LinearSolver::Auto | LinearSolver::Multifrontal | LinearSolver::Mumps => None,
        _ => Some(OptionAccess::Code),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(name: &str, value: &str) -> Option<OptionAccess> {
        access_of_option(name, &OptionValue::Text(value.into()))
    }

    #[test]
    fn what_loads_code_or_touches_files_is_known() {
        assert_eq!(of("hsllib", "x.so"), Some(OptionAccess::Code));
        assert_eq!(of("resto.HSLLib", "x.so"), Some(OptionAccess::Code));
        assert_eq!(of("linear_solver", "MA57"), Some(OptionAccess::Code));
        assert_eq!(of("output_file", "x"), Some(OptionAccess::Files));
        assert_eq!(of("some_new_path", "x"), Some(OptionAccess::Unknown));
        let scaling = "nlp_scaling_method";
        assert_eq!(of(scaling, "Equilibration-Based"), Some(OptionAccess::Code));
        assert_eq!(of(scaling, "none"), None);
        assert_eq!(of("mu_strategy", "adaptive"), None);
        assert_eq!(of("linear_solver", "mumps"), None);
        let number = OptionValue::Integer(1);
        assert_eq!(access_of_option("max_soc", &number), None);
        let writes = access_of_option("wsmp_write_matrix_iteration", &number);
        assert_eq!(writes, Some(OptionAccess::Files));
    }
}
