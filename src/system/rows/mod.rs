//! Rows of the problem, one file a kind: path rows, rows of the end and of way-points.
//!
//! A kind of path row says its bounds, values and derivatives by [`PathRows`]; a kind of row of the
//! end by [`EndRows`]. [`PathBlock`] and [`EndBlock`] list the kinds, [`path`] and [`end`] make
//! those that a problem has. All else (order, structure, limits that give way, units, warnings)
//! follows from these lists.

mod base_position;
mod base_rate;
mod block;
mod end_effector;
mod keep_out;
mod peak;
mod rotation_angle;
mod row;
mod torque;
mod way_point;

pub use row::{BoundId, Component, Measure, Row};

pub(crate) use row::of_joint;

pub(crate) use block::{EndRows, PathRows};
pub(crate) use end_effector::EndEffectorRows;
pub(crate) use peak::PeakRow;
pub(crate) use rotation_angle::{NAME as ROTATION_ANGLE, held};
pub(crate) use way_point::{WayPointRows, way_point};

use super::instant::{Instant, Needs, Pose};
use super::linearization::{Adjoint, Linearization, Lower};
use super::plant::Plant;
use crate::autodiff::Scalar;
use crate::dynamics::space::Space;
use crate::problem::Problem;
use base_position::BasePositionRows;
use base_rate::BaseRateRows;
use keep_out::KeepOutRow;
use rotation_angle::RotationAngleRow;
use torque::TorqueRows;

/// The kinds of path rows.
#[derive(Debug, Clone)]
pub(crate) enum PathBlock<Sp: Space> {
    BaseRate(BaseRateRows),
    Torque(TorqueRows),
    RotationAngle(RotationAngleRow),
    BasePosition(BasePositionRows),
    Peak(PeakRow),
    KeepOut(Box<KeepOutRow<Sp>>),
}

macro_rules! each_path {
    ($block:expr, $rows:ident => $do:expr) => {
        match $block {
            PathBlock::BaseRate($rows) => $do,
            PathBlock::Torque($rows) => $do,
            PathBlock::RotationAngle($rows) => $do,
            PathBlock::BasePosition($rows) => $do,
            PathBlock::Peak($rows) => $do,
            PathBlock::KeepOut(boxed) => {
                let $rows = boxed.as_ref();
                $do
            }
        }
    };
}

/// The path rows of `problem`, in the order of the programme.
pub(crate) fn path<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<PathBlock<Sp>> {
    let mut blocks = Vec::new();
    blocks.extend(BaseRateRows::new(problem, plant).map(PathBlock::BaseRate));
    blocks.extend(TorqueRows::new(problem).map(PathBlock::Torque));
    blocks.extend(RotationAngleRow::path(problem, plant).map(PathBlock::RotationAngle));
    blocks.extend(BasePositionRows::new(problem).map(PathBlock::BasePosition));
    blocks.extend(KeepOutRow::all(problem, plant).map(|row| PathBlock::KeepOut(Box::new(row))));
    blocks.extend(PeakRow::all(problem).into_iter().map(PathBlock::Peak));
    blocks
}

/// The kinds of rows of the end.
#[derive(Debug, Clone)]
pub(crate) enum EndBlock<Sp: Space> {
    EndEffector(EndEffectorRows<Sp>),
    RotationAngle(RotationAngleRow),
    BasePosition(BasePositionRows),
    Peak(PeakRow),
    KeepOut(Box<KeepOutRow<Sp>>),
}

macro_rules! each_end {
    ($block:expr, $rows:ident => $do:expr) => {
        match $block {
            EndBlock::EndEffector($rows) => $do,
            EndBlock::RotationAngle($rows) => $do,
            EndBlock::BasePosition($rows) => $do,
            EndBlock::Peak($rows) => $do,
            EndBlock::KeepOut(boxed) => {
                let $rows = boxed.as_ref();
                $do
            }
        }
    };
}

/// The rows of the end of `problem`, in the order of the programme.
pub(crate) fn end<Sp: Space>(problem: &Problem, plant: &Plant<Sp>) -> Vec<EndBlock<Sp>> {
    let mut blocks = Vec::new();
    blocks.extend(EndEffectorRows::at_end(problem, plant).map(EndBlock::EndEffector));
    blocks.extend(RotationAngleRow::ends(problem, plant).map(EndBlock::RotationAngle));
    blocks.extend(BasePositionRows::new(problem).map(EndBlock::BasePosition));
    blocks.extend(KeepOutRow::all(problem, plant).map(|row| EndBlock::KeepOut(Box::new(row))));
    let peaks = PeakRow::all(problem).into_iter();
    blocks.extend(peaks.filter(PeakRow::reaches_the_end).map(EndBlock::Peak));
    blocks
}

impl<Sp: Space> PathRows<Sp> for PathBlock<Sp> {
    fn rows(&self) -> &[Row] {
        each_path!(self, block => PathRows::<Sp>::rows(block))
    }

    fn needs(&self) -> Needs {
        each_path!(self, block => PathRows::<Sp>::needs(block))
    }

    fn values<S: Scalar>(&self, at: &Instant<'_, Sp, S>, rows: &mut [S]) {
        each_path!(self, block => PathRows::<Sp>::values(block, at, rows));
    }

    fn gradient(&self, at: &Linearization<'_, Sp>, rows: &mut [f64]) {
        each_path!(self, block => block.gradient(at, rows));
    }

    fn weigh(&self, at: &Linearization<'_, Sp>, weights: &[f64], adjoint: &mut Adjoint<'_>) {
        each_path!(self, block => block.weigh(at, weights, adjoint));
    }

    fn curvature(&self, at: &Linearization<'_, Sp>, weights: &[f64], hessian: &mut Lower<'_>) {
        each_path!(self, block => block.curvature(at, weights, hessian));
    }
}

impl<Sp: Space> EndRows<Sp> for EndBlock<Sp> {
    fn rows(&self) -> &[Row] {
        each_end!(self, block => EndRows::<Sp>::rows(block))
    }

    fn needs(&self) -> Needs {
        each_end!(self, block => EndRows::<Sp>::needs(block))
    }

    fn values<S: Scalar>(&self, at: &Pose<'_, Sp, S>, rows: &mut [S]) {
        each_end!(self, block => EndRows::<Sp>::values(block, at, rows));
    }
}
