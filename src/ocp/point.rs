//! Where the functions of an optimal control problem are evaluated.

/// One instant on the path.
#[derive(Debug, Clone, Copy)]
pub struct Point<'a, S> {
    /// States, in the order of [`Formulation::states`](super::Formulation::states).
    pub x: &'a [S],
    /// Controls.
    pub u: &'a [S],
    /// Time, s.
    pub t: S,
}

/// Both ends of the path.
#[derive(Debug, Clone, Copy)]
pub struct Ends<'a, S> {
    /// States at t₀.
    pub initial: &'a [S],
    /// States at t_f.
    pub terminal: &'a [S],
    /// Duration t_f − t₀, s.
    pub duration: S,
}

/// The instant of a way-point: where an interior-point constraint is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct InteriorPoint<'a, S> {
    /// Which one, in the order of [`Formulation::way_points`](super::Formulation::way_points).
    pub way_point: usize,
    /// States there.
    pub x: &'a [S],
    /// Time there, s.
    pub t: S,
}
