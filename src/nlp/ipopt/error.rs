//! Why a solve could not begin.

use crate::nlp::LinearSolver;

/// A solve could not begin. Each message says what was wrong and what to do about it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IpoptError {
    /// An option's name, type or value is not one this Ipopt knows.
    #[error(
        "Ipopt {version} refused the option {name} = {value}: the name is unknown to this \
         version, or the value has the wrong type or range; see Ipopt's options reference",
        version = super::version()
    )]
    OptionRefused {
        /// Name of the option.
        name: String,
        /// Value that was to be set.
        value: String,
    },

    /// Ipopt took each option but could not work with them together.
    #[error(
        "Ipopt {version} could not start with the options given: most likely the linear solver \
         {linear_solver} is not part of this installation; use linear_solver = \"mumps\", and \
         look through the other options",
        version = super::version()
    )]
    OptionsRefused {
        /// The linear solver asked for.
        linear_solver: LinearSolver,
    },

    /// An option needs a library that this machine does not have.
    #[error(
        "the option {name} = {value} needs {library}, which was not found; install it where the \
         dynamic loader looks, or use {instead}"
    )]
    MissingLibrary {
        /// Name of the option.
        name: &'static str,
        /// Value that was to be set.
        value: String,
        /// What was not found.
        library: String,
        /// What works without it.
        instead: &'static str,
    },

    /// The start has the wrong number of values.
    #[error(
        "the start has {found} {what}, the programme has {expected}: build the start for this \
         programme"
    )]
    StartDimension {
        /// Which values.
        what: &'static str,
        /// How many the programme has.
        expected: usize,
        /// How many the start has.
        found: usize,
    },

    /// A value of the start is infinite or not a number.
    #[error("the start is not finite: {what} of {name} is {value}; give it a finite value")]
    StartNotFinite {
        /// Which value ("value", "multiplier", …).
        what: &'static str,
        /// Name of the variable or constraint.
        name: String,
        /// The value.
        value: f64,
    },

    /// A warm start was asked for, but the start has no multipliers.
    #[error(
        "a warm start needs all multipliers in the start: pass the iterate of an earlier \
         solution, or leave warm_start unset"
    )]
    NoMultipliers,

    /// The barrier parameter of a warm start cannot be used.
    #[error("the barrier parameter of the warm start is {0}: it must be positive and finite")]
    Barrier(f64),

    /// No value lies between two bounds, or a bound is not a number.
    #[error("no value of {name} satisfies its bounds, {lower} to {upper}: correct the bounds")]
    Bounds {
        /// Name of the variable or constraint.
        name: String,
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
    },

    /// A nonzero lies outside its matrix, or above the Hessian's diagonal.
    #[error(
        "entry {entry} of the structure of the {matrix} is at row {row}, column {column}, which \
         is not in its {shape}: the programme's structure functions are wrong"
    )]
    Structure {
        /// Which matrix.
        matrix: &'static str,
        /// Position in the list of nonzeros.
        entry: usize,
        /// Zero-based row.
        row: usize,
        /// Zero-based column.
        column: usize,
        /// What the entry had to lie in.
        shape: String,
    },

    /// The programme has more of something than Ipopt can count.
    #[error(
        "the programme has {found} {what}, Ipopt counts to {}: use a coarser mesh",
        i32::MAX
    )]
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How many there are.
        found: usize,
    },

    /// Ipopt made no problem of these sizes.
    #[error(
        "Ipopt makes no problem of {variables} variables and {constraints} constraints with \
         {jacobian_nonzeros} Jacobian nonzeros: there must be a variable, and constraints must \
         have nonzeros"
    )]
    Creation {
        /// Number of variables.
        variables: usize,
        /// Number of constraints.
        constraints: usize,
        /// Nonzeros of the Jacobian.
        jacobian_nonzeros: usize,
    },

    /// A solve was begun inside a callback of another one.
    #[error(
        "a solve with the linear solver {0} was begun inside a callback of another solve: it \
         cannot do two at a time; solve the inner programme before or after"
    )]
    Nested(LinearSolver),
}
