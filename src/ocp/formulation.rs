//! What there is to decide in an optimal control problem, and within which bounds.

use super::Interval;

/// A named quantity with its bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// What a person calls it ("rate of joint elbow").
    pub name: String,
    /// Bounds along the whole path (states, controls, path rows), at the ends (boundary rows), or of
    /// one value (parameters, integrals).
    pub bounds: Interval,
    /// What counts as one in it, in its unit; `None` for the size of its bounds.
    pub size: Option<f64>,
    /// What the solver and the error estimate count as one in it, in its unit, above zero; `None`
    /// where bounds, ends and the first trajectory are to tell.
    pub scale: Option<f64>,
}

impl Quantity {
    /// A quantity within bounds.
    pub fn new(name: impl Into<String>, bounds: Interval) -> Self {
        Self {
            name: name.into(),
            bounds,
            size: None,
            scale: None,
        }
    }

    /// The same with a size of its own.
    pub fn sized(self, size: f64) -> Self {
        Self {
            size: Some(size),
            ..self
        }
    }

    /// The same with a scale of its own.
    pub fn scaled(self, scale: f64) -> Self {
        Self {
            scale: Some(scale),
            ..self
        }
    }
}

/// What there is to decide and within which bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Formulation {
    /// States x, with their bounds along the path.
    pub states: Vec<Quantity>,
    /// Controls u, with their bounds.
    pub controls: Vec<Quantity>,
    /// Rows of the path constraint C, eq. (18), held at the collocation points.
    pub path: Vec<Quantity>,
    /// Rows of the boundary constraint E, eq. (18), beyond what `initial` and `terminal` say.
    pub boundary: Vec<Quantity>,
    /// Bounds of each state at t₀.
    pub initial: Vec<Interval>,
    /// Bounds of each state at t_f.
    pub terminal: Vec<Interval>,
    /// Static parameters p, with their bounds: unknowns that do not change in time.
    pub parameters: Vec<Quantity>,
    /// Their values to begin with, one each; what is outside the bounds begins on them.
    pub parameter_guess: Vec<f64>,
    /// Integrals ∫g dt from t₀ to t_f, with their bounds.
    pub integrals: Vec<Quantity>,
    /// Bounds of t₀ in s; fixed where both are equal.
    pub initial_time: Interval,
    /// Bounds of the duration t_f − t₀ in s; fixed where both are equal.
    pub duration: Interval,
    /// Bounds of t_f in s, beyond what `initial_time` and `duration` say.
    pub final_time: Interval,
    /// What has to hold between the ends, in the order of the fractions, no two at the same.
    pub way_points: Vec<WayPoint>,
}

/// Conditions at one instant between t₀ and t_f: an interior-point constraint.
///
/// The mesh has a breakpoint there, so that the states have a node and their costates may jump.
#[derive(Debug, Clone, PartialEq)]
pub struct WayPoint {
    /// Where it stands: fraction of the duration, above 0 and below 1.
    pub fraction: f64,
    /// Bounds of each state there, beyond those along the path.
    pub states: Vec<Interval>,
    /// Rows that are functions of the states there and of the time.
    pub rows: Vec<Quantity>,
}

impl Default for Formulation {
    /// Nothing yet, for one second from t₀ = 0 on.
    fn default() -> Self {
        Self {
            states: Vec::new(),
            controls: Vec::new(),
            path: Vec::new(),
            boundary: Vec::new(),
            initial: Vec::new(),
            terminal: Vec::new(),
            parameters: Vec::new(),
            parameter_guess: Vec::new(),
            integrals: Vec::new(),
            initial_time: Interval::fixed(0.0),
            duration: Interval::fixed(1.0),
            final_time: Interval::FREE,
            way_points: Vec::new(),
        }
    }
}

impl Formulation {
    /// Nothing yet, for `duration` from t₀ = 0 on.
    pub fn over(duration: Interval) -> Self {
        Self {
            duration,
            ..Self::default()
        }
    }

    /// Nothing yet, from a t₀ within `start` to a t_f within `end`.
    pub fn between(start: Interval, end: Interval) -> Self {
        let shortest = (end.lower - start.upper).max(0.0);
        Self {
            initial_time: start,
            duration: Interval::new(shortest, end.upper - start.lower),
            // With t₀ the duration alone tells t_f.
            final_time: match start.is_fixed() {
                true => Interval::FREE,
                false => end,
            },
            ..Self::default()
        }
    }

    /// With a static parameter more: its bounds and the value it begins with.
    pub fn parameter(mut self, parameter: Quantity, guess: f64) -> Self {
        self.parameters.push(parameter);
        self.parameter_guess.push(guess);
        self
    }

    /// With an integral more: the bounds of ∫g dt.
    pub fn integral(mut self, integral: Quantity) -> Self {
        self.integrals.push(integral);
        self
    }

    /// With a state more: its bounds along the path, at t₀ and at t_f.
    pub fn state(mut self, state: Quantity, initial: Interval, terminal: Interval) -> Self {
        self.states.push(state);
        self.initial.push(initial);
        self.terminal.push(terminal);
        self
    }

    /// With a control more.
    pub fn control(mut self, control: Quantity) -> Self {
        self.controls.push(control);
        self
    }

    /// With a path row more.
    pub fn path_row(mut self, row: Quantity) -> Self {
        self.path.push(row);
        self
    }

    /// With a boundary row more.
    pub fn boundary_row(mut self, row: Quantity) -> Self {
        self.boundary.push(row);
        self
    }

    /// With a way-point more, after those there are.
    pub fn way_point(mut self, point: WayPoint) -> Self {
        self.way_points.push(point);
        self
    }

    /// Number of states and of controls.
    pub fn widths(&self) -> (usize, usize) {
        (self.states.len(), self.controls.len())
    }

    /// Whether the time of a point is an unknown.
    pub fn has_free_time(&self) -> bool {
        !self.duration.is_fixed() || !self.initial_time.is_fixed()
    }

    /// Fractions of the duration at which the mesh needs a breakpoint, rising.
    pub fn way_point_fractions(&self) -> Vec<f64> {
        self.way_points.iter().map(|point| point.fraction).collect()
    }
}
