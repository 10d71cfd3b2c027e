//! Linear solvers by name.

use std::fmt;

/// The linear solver inside Ipopt.
///
/// [`From<&str>`] reads a name, in any case; [`Self::name`] gives it back. `"ours"`, the earlier
/// name of [`Self::Multifrontal`], is still read.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum LinearSolver {
    /// [`Self::Multifrontal`] where this Ipopt can be given it, else [`Self::Mumps`].
    #[default]
    Auto,
    /// The solver of this crate, [`crate::nlp::kkt`]. MUMPS stands in where Ipopt cannot be given it.
    Multifrontal,
    /// MUMPS.
    Mumps,
    /// HSL_MA27.
    Ma27,
    /// HSL_MA57.
    Ma57,
    /// HSL_MA77.
    Ma77,
    /// HSL_MA86.
    Ma86,
    /// HSL_MA97.
    Ma97,
    /// Pardiso.
    Pardiso,
    /// Pardiso of Intel's MKL.
    PardisoMkl,
    /// SPRAL.
    Spral,
    /// WSMP.
    Wsmp,
    /// Any other, by Ipopt's name for it.
    Other(String),
}

impl LinearSolver {
    /// Every linear solver that this crate knows by name, [`Self::Auto`] apart.
    pub const KNOWN: [Self; 11] = [
        Self::Multifrontal,
        Self::Mumps,
        Self::Ma27,
        Self::Ma57,
        Self::Ma77,
        Self::Ma86,
        Self::Ma97,
        Self::Pardiso,
        Self::PardisoMkl,
        Self::Spral,
        Self::Wsmp,
    ];

    /// Its name, as in problem files; Ipopt's name for all but the first two.
    pub fn name(&self) -> &str {
        match self {
            Self::Auto => "auto",
            Self::Multifrontal => "multifrontal",
            Self::Mumps => "mumps",
            Self::Ma27 => "ma27",
            Self::Ma57 => "ma57",
            Self::Ma77 => "ma77",
            Self::Ma86 => "ma86",
            Self::Ma97 => "ma97",
            Self::Pardiso => "pardiso",
            Self::PardisoMkl => "pardisomkl",
            Self::Spral => "spral",
            Self::Wsmp => "wsmp",
            Self::Other(name) => name,
        }
    }

    /// A list of names, separated by commas, with earlier names replaced by today's.
    pub(crate) fn current_names(list: &str) -> String {
        let names = list.split(", ").map(Self::from);
        let names: Vec<String> = names.map(|solver| solver.to_string()).collect();
        names.join(", ")
    }
}

impl From<&str> for LinearSolver {
    fn from(name: &str) -> Self {
        let name = name.to_ascii_lowercase();
        if name == "auto" {
            return Self::Auto;
        }
        if name == "ours" {
            return Self::Multifrontal;
        }
        let known = Self::KNOWN.into_iter().find(|solver| solver.name() == name);
        known.unwrap_or(Self::Other(name))
    }
}

impl fmt::Display for LinearSolver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::LinearSolver;

    #[test]
    fn every_name_is_read_back_in_any_case() {
        for solver in LinearSolver::KNOWN.into_iter().chain([LinearSolver::Auto]) {
            assert_eq!(LinearSolver::from(solver.name()), solver);
            let upper = solver.name().to_uppercase();
            assert_eq!(LinearSolver::from(&*upper), solver);
        }
        let other = LinearSolver::from("Custom");
        assert_eq!(other, LinearSolver::Other("custom".into()));
    }

    #[test]
    fn the_earlier_name_of_the_multifrontal_solver_is_read() {
        assert_eq!(LinearSolver::from("ours"), LinearSolver::Multifrontal);
        let names = LinearSolver::current_names("ours, mumps");
        assert_eq!(names, "multifrontal, mumps");
        assert_eq!(LinearSolver::current_names("none"), "none");
    }
}
