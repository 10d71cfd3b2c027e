//! One bounded quantity: which limit it belongs to, its unit, and a length in that unit.

use crate::dynamics::Joint;
use crate::ocp::{Interval, Quantity};
use crate::problem::{LimitId, Unit};

/// Which component of a limit a bounded quantity is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Component {
    /// A parameter of the base attitude, or the rate along it.
    Attitude(usize),
    /// The angle of the base's rotation from where it was at t₀.
    RotationAngle,
    /// A base axis, or a component of the base position.
    Axis(usize),
    /// The position of a joint, or what there is one of for each joint.
    Joint(usize),
    /// The rate of a joint at a way-point.
    JointRate(usize),
    /// A pair that is kept apart.
    Pair(usize),
    /// A component of the end effector's position.
    Position(usize),
    /// The sine of the end effector's rotation about an axis.
    Orientation(usize),
    /// That the end effector is not half a turn off.
    NotReversed,
    /// The largest value of a quantity of the base.
    Peak,
    /// All that the cost counts of the base.
    BaseMotion,
}

/// Which limit, and which component of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct BoundId {
    /// The limit.
    pub limit: LimitId,
    /// The component.
    pub component: Component,
}

impl BoundId {
    /// A component of a limit.
    pub fn new(limit: LimitId, component: Component) -> Self {
        Self { limit, component }
    }

    /// Whether the two can only give way together: the same component along the path and at t_f.
    pub fn gives_way_with(&self, other: &Self) -> bool {
        self.component == other.component
            && self.limit.along_the_path() == other.limit.along_the_path()
    }
}

/// How the value of a row measures the quantity it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Measure {
    /// It is the quantity.
    Itself,
    /// It is (quantity/`bound`)², which is smooth where the quantity is not.
    SquaredRatio {
        /// The bound, in the unit of the row.
        bound: f64,
    },
    /// The same where a static parameter is the bound: see [`Row::bounded_by`].
    SquaredRatioToParameter {
        /// Which one.
        parameter: usize,
    },
}

/// A state, control or row with its bounds, as the programme has it and as a person reads it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// Which limit it belongs to.
    pub id: BoundId,
    /// Unit of the quantity.
    pub unit: Unit,
    /// What counts as one where the bound gives way, in the programme's own measure.
    pub size: f64,
    /// How the programme's value measures the quantity.
    pub measure: Measure,
    /// Name and bounds in the programme.
    pub quantity: Quantity,
}

/// What a person calls a quantity of `joint`: "rate of joint elbow".
pub(crate) fn of_joint(what: &str, joint: &Joint) -> String {
    format!("{what} of joint {}", joint.name)
}

/// Angles and what is made of them are of size one whatever their bounds; lengths and torques are
/// not.
fn natural_scale(unit: Unit) -> Option<f64> {
    match unit {
        Unit::One | Unit::Radian | Unit::RadianPerSecond | Unit::RadianPerSecondSquared => {
            Some(1.0)
        }
        _ => None,
    }
}

/// Least size of a bound, so that a bound of zero has one.
const LEAST_SIZE: f64 = 1e-3;

impl Row {
    /// A quantity whose size is that of its bounds.
    pub fn new(id: BoundId, unit: Unit, name: impl Into<String>, bounds: Interval) -> Self {
        let ends = [bounds.lower, bounds.upper].map(f64::abs).into_iter();
        let finite = ends.filter(|end| end.is_finite());
        Self {
            id,
            unit,
            size: finite.fold(LEAST_SIZE, f64::max),
            measure: Measure::Itself,
            quantity: Quantity {
                scale: natural_scale(unit),
                ..Quantity::new(name, bounds)
            },
        }
    }

    /// The same with another size.
    pub fn sized(mut self, size: f64) -> Self {
        self.size = size;
        self.quantity.size = Some(size);
        self
    }

    /// The same with another scale of the programme.
    pub fn scaled(mut self, scale: f64) -> Self {
        self.quantity.scale = Some(scale);
        self
    }

    /// The same with the bound that a static parameter is, where one is.
    pub fn bounded_by(&self, parameters: &[f64]) -> Self {
        let mut row = self.clone();
        if let Measure::SquaredRatioToParameter { parameter } = self.measure {
            row.measure = Measure::SquaredRatio {
                bound: parameters[parameter],
            };
        }
        row
    }

    /// The quantity behind the programme's `value`, in the row's unit.
    pub fn measured(&self, value: f64) -> f64 {
        match self.measure {
            Measure::Itself => value,
            Measure::SquaredRatio { bound } => bound * value.max(0.0).sqrt(),
            // Of the bound, which is not known here.
            Measure::SquaredRatioToParameter { .. } => value.max(0.0).sqrt(),
        }
    }

    /// The bounds in the row's unit.
    pub fn measured_bounds(&self) -> Interval {
        match self.measure {
            Measure::Itself => self.quantity.bounds,
            Measure::SquaredRatio { .. } | Measure::SquaredRatioToParameter { .. } => {
                Interval::new(0.0, self.measured(self.quantity.bounds.upper))
            }
        }
    }
}
