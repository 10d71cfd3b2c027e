//! Where a solve starts from and where it ends: primal and dual values together.

/// Primal and dual values of a programme: a starting point, or a result.
///
/// Signs as in Ipopt: the Lagrangian is f + λᵀg − z_Lᵀ(x − x_L) − z_Uᵀ(x_U − x), bound
/// multipliers are not negative.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Iterate {
    /// Variables x, length n.
    pub x: Vec<f64>,
    /// Constraint multipliers λ, length m (may be empty at a cold start).
    pub multipliers: Vec<f64>,
    /// Multipliers of the lower bounds z_L, length n (may be empty at a cold start).
    pub lower_multipliers: Vec<f64>,
    /// Multipliers of the upper bounds z_U, length n (may be empty at a cold start).
    pub upper_multipliers: Vec<f64>,
}

impl Iterate {
    /// A primal starting point without multipliers.
    pub fn primal(x: Vec<f64>) -> Self {
        Self {
            x,
            ..Self::default()
        }
    }

    /// Whether all multipliers are there, so that a warm start is possible.
    pub fn has_multipliers(&self, constraints: usize) -> bool {
        self.multipliers.len() == constraints
            && self.lower_multipliers.len() == self.x.len()
            && self.upper_multipliers.len() == self.x.len()
    }
}
