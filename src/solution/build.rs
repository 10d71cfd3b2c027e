//! What this program was built from.

/// Facts recorded when the program was compiled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Build {
    /// Version of the package.
    pub version: &'static str,
    /// Git revision, with a `+` where files were changed since; "unknown" outside a repository.
    pub revision: &'static str,
    /// Target triple.
    pub target: &'static str,
    /// Instruction sets the compiler could count on.
    pub target_features: &'static str,
    /// "release" or "debug".
    pub profile: &'static str,
    /// Compiler.
    pub rustc: &'static str,
}

impl Build {
    /// Version with the git revision, "0.1.0 (1a2b3c4d5e6f)".
    pub const VERSION: &'static str = concat!(
        env!("CARGO_PKG_VERSION"),
        " (",
        env!("FFSM_GIT_REVISION"),
        ")"
    );

    /// This program's.
    pub const THIS: Self = Self {
        version: env!("CARGO_PKG_VERSION"),
        revision: env!("FFSM_GIT_REVISION"),
        target: env!("FFSM_TARGET"),
        target_features: env!("FFSM_TARGET_FEATURES"),
        profile: env!("FFSM_PROFILE"),
        rustc: env!("FFSM_RUSTC"),
    };
}
