//! The tables of a problem file, each read over the defaults that stand in the problem.

use super::ConfigError;
use super::document::{Value, quoted};
use super::goal;
use super::item::Item;
use super::keep_out;
use super::robot::Robot;
use super::trust::Origin;
use super::values::Components;
use super::way_point;
use crate::nlp::ipopt::{access_of_option, access_of_solver};
use crate::nlp::{self, OptionValue};
use crate::ocp::Interval;
use crate::problem::{
    ComponentKind, CostId, LimitId, Limits, Momentum, Preset, ProblemBuilder, Task,
};
use crate::refine::{self, ErrorMeasure, Law, Method};
use crate::system;
use std::time::Duration;

/// Most segments and mesh iterations: beyond them a typing error is more likely than a wish. How many
/// points a mesh may have in all is checked with the problem.
const MOST: usize = 100_000;
/// Most LGR points in one segment.
const MOST_POINTS: usize = 1_000;

/// `[task]`.
pub(super) fn task(
    item: &Item<'_>,
    joints: &Components,
    angles: &Components,
    lengths: &Components,
) -> Result<Task, ConfigError> {
    let section = item.section(&["duration", "initial", "final", "way_points"])?;
    let expected = "a table with joints, the joint positions at the start";
    let initial = section.require("initial", expected)?.section(&[
        "joints",
        "rates",
        "base_attitude",
        "linear_momentum",
        "angular_momentum",
    ])?;
    let expected = "a table with joints, the joint positions at the end, or end_effector";
    let goal = section
        .require("final", expected)?
        .section(&["joints", "guess", "end_effector"])?;
    let expected = format!("joint positions, one a joint: {}", joints.names.join(", "));
    let initial_joints = joints.vector(initial.require("joints", &expected)?)?;
    let end_effector = match goal.get("end_effector") {
        Some(item) => Some(goal::end_effector(item, angles, lengths)?),
        None => None,
    };
    let (final_joints, free_joints) = match (&end_effector, goal.get("joints")) {
        (None, _) => {
            let at = joints.vector(goal.require("joints", &expected)?)?;
            (at, vec![false; joints.names.len()])
        }
        (Some(_), given) => goal::joints(given, goal.get("guess"), joints, &initial_joints)?,
    };
    let way_points = match section.get("way_points") {
        Some(item) => way_point::read(item, joints, angles, lengths)?,
        None => Vec::new(),
    };
    Ok(Task {
        way_points,
        duration: duration(section.require("duration", DURATION)?)?,
        initial_rates: match initial.get("rates") {
            // One for all: typically 0.
            Some(item) if item.as_number().is_some() => {
                vec![item.number("a finite rate, rad/s or m/s")?; joints.names.len()]
            }
            item => or_zero(item, joints)?,
        },
        initial_base_attitude: or_zero(initial.get("base_attitude"), angles)?,
        initial_momentum: Momentum {
            linear: or_zero(initial.get("linear_momentum"), lengths)?,
            angular: or_zero(initial.get("angular_momentum"), angles)?,
        },
        initial_joints,
        final_joints,
        free_joints,
        end_effector,
    })
}

/// One number a component, zero where the key is left out.
fn or_zero(item: Option<&Item<'_>>, components: &Components) -> Result<Vec<f64>, ConfigError> {
    match item {
        Some(item) => components.vector(item),
        None => Ok(vec![0.0; components.names.len()]),
    }
}

const DURATION: &str = "a finite duration above zero, s, or { min = …, max = … }";

fn duration(item: &Item<'_>) -> Result<Interval, ConfigError> {
    if item.as_entries().is_none() {
        return item.positive(DURATION).map(Interval::fixed);
    }
    let section = item.section(&["min", "max"])?;
    let end = |name| {
        let expected = "a finite duration above zero, s";
        section.require(name, expected)?.positive(expected)
    };
    let (min, max) = (end("min")?, end("max")?);
    if min > max {
        return Err(item.error(format!("min {min} above max {max}"), "min not above max"));
    }
    Ok(Interval::new(min, max))
}

/// What limits and costs may have one component of.
pub(super) struct EveryComponent {
    pub joint: Components,
    pub base_attitude: Components,
    pub base_rate: Components,
    pub base_position: Components,
    pub base: Components,
}

impl EveryComponent {
    fn of(&self, kind: ComponentKind) -> &Components {
        match kind {
            ComponentKind::Joint => &self.joint,
            ComponentKind::BaseAttitude => &self.base_attitude,
            ComponentKind::BaseRate => &self.base_rate,
            ComponentKind::BasePosition => &self.base_position,
            ComponentKind::Base => &self.base,
        }
    }
}

/// `[limits]`.
pub(super) fn limits(
    item: &Item<'_>,
    limits: &mut Limits,
    robot: &Robot,
    components: &EveryComponent,
) -> Result<(), ConfigError> {
    let known = limits.entries().map(|entry| entry.id);
    let others = [LimitId::BaseMotion, LimitId::KeepOut];
    let known: Vec<_> = known.chain(others).map(LimitId::name).collect();
    let section = item.section(&known)?;
    for entry in limits.entries_mut() {
        if let Some(item) = section.get(entry.id.name()) {
            *entry.bounds = components.of(entry.components).bounds(
                item,
                entry.bounds,
                entry.id.may_exclude_zero(),
            )?;
        }
    }
    if let Some(item) = section.get(LimitId::BaseMotion.name()) {
        limits.base_motion =
            item.positive("a number above zero, as the base's terms of the cost")?;
    }
    if let Some(item) = section.get(LimitId::KeepOut.name()) {
        limits.keep_out = keep_out::read(item, robot)?;
    }
    Ok(())
}

/// `[cost]`.
pub(super) fn cost(
    item: &Item<'_>,
    problem: &mut ProblemBuilder,
    components: &EveryComponent,
) -> Result<(), ConfigError> {
    let known = problem.cost.entries().map(|entry| entry.id);
    let others = [CostId::Duration, CostId::RateMatrix];
    let known = known.chain(others).map(CostId::name);
    let section = item.section(&known.chain([PRESET]).collect::<Vec<_>>())?;
    if let Some(item) = section.get(PRESET) {
        let preset = preset(item)?;
        // A problem that cannot be is refused once all of it is read.
        if let Ok(valid) = problem.clone().build() {
            preset.weigh(&system::sizes(&valid), &mut problem.cost);
        }
    }
    let cost = &mut problem.cost;
    for entry in cost.entries_mut() {
        if let Some(item) = section.get(entry.id.name()) {
            *entry.weights = components.of(entry.components).weights(item)?;
        }
    }
    if let Some(item) = section.get(CostId::Duration.name()) {
        cost.duration = item.number("a finite weight, zero or above")?;
    }
    if let Some(item) = section.get(CostId::RateMatrix.name()) {
        cost.rate_matrix = Some(matrix(item)?);
    }
    Ok(())
}

const PRESET: &str = "preset";

fn preset(item: &Item<'_>) -> Result<Preset, ConfigError> {
    let expected = Preset::ALL.map(|preset| quoted(preset.name())).join(" or ");
    let name = item.text(&expected)?;
    let found = Preset::ALL.into_iter().find(|preset| preset.name() == name);
    found.ok_or_else(|| item.error(quoted(name), &expected))
}

/// Rows of numbers; the problem itself checks their lengths.
fn matrix(item: &Item<'_>) -> Result<Vec<Vec<f64>>, ConfigError> {
    let expected = "an array of rows, one a base angle and joint, each an array of numbers";
    let rows = |item: &Item<'_>| {
        let row = item
            .as_elements()
            .ok_or_else(|| item.unexpected(expected))?;
        row.iter()
            .map(|element| element.number("a finite number"))
            .collect()
    };
    item.as_elements()
        .ok_or_else(|| item.unexpected(expected))?
        .iter()
        .map(rows)
        .collect()
}

/// `[mesh]`.
pub(super) fn mesh(item: &Item<'_>, mesh: &mut refine::Settings) -> Result<(), ConfigError> {
    let section = item.section(&[
        "method",
        "law",
        "segments",
        "points",
        "tolerance",
        "bound_tolerance",
        "objective_tolerance",
        "max_iterations",
        "max_points",
        "lambda1",
        "lambda2",
        "r_max",
        "error",
        "max_global_points",
        "global_points",
    ])?;
    if let Some(item) = section.get("method") {
        let expected = Method::ALL.map(|method| quoted(method.name())).join(" or ");
        let name = item.text(&expected)?;
        let found = Method::ALL.into_iter().find(|method| method.name() == name);
        mesh.method = found.ok_or_else(|| item.error(quoted(name), &expected))?;
    }
    if let Some(item) = section.get("law") {
        let expected = Law::ALL.map(|law| quoted(law.name())).join(" or ");
        let name = item.text(&expected)?;
        let found = Law::ALL.into_iter().find(|law| law.name() == name);
        mesh.law = found.ok_or_else(|| item.error(quoted(name), &expected))?;
    }
    for (name, value, most) in [
        ("segments", &mut mesh.segments, MOST),
        ("points", &mut mesh.points, MOST_POINTS),
        ("max_points", &mut mesh.max_points, MOST_POINTS),
        (
            "max_global_points",
            &mut mesh.max_global_points,
            MOST_POINTS,
        ),
        ("global_points", &mut mesh.global_points, MOST_POINTS),
    ] {
        if let Some(item) = section.get(name) {
            *value = item.count(most)?;
        }
    }
    if let Some(item) = section.get("max_iterations") {
        mesh.max_iterations = Some(item.count(MOST)?);
    }
    for (name, value) in [
        ("tolerance", &mut mesh.tolerance),
        ("bound_tolerance", &mut mesh.bound_tolerance),
        ("lambda1", &mut mesh.lambda1),
        ("lambda2", &mut mesh.lambda2),
        ("r_max", &mut mesh.r_max),
    ] {
        if let Some(item) = section.get(name) {
            *value = item.positive("a finite number above zero")?;
        }
    }
    if let Some(item) = section.get("objective_tolerance") {
        let value = item.positive("a finite number above zero")?;
        mesh.objective_tolerance = Some(value);
    }
    if let Some(item) = section.get("error") {
        let expected = ErrorMeasure::ALL
            .map(|measure| quoted(measure.name()))
            .join(" or ");
        let name = item.text(&expected)?;
        let found = ErrorMeasure::ALL
            .into_iter()
            .find(|measure| measure.name() == name);
        mesh.error = found.ok_or_else(|| item.error(quoted(name), &expected))?;
    }
    Ok(())
}

/// `[solver]`.
pub(super) fn solver(
    item: &Item<'_>,
    solver: &mut nlp::Settings,
    origin: Origin,
) -> Result<(), ConfigError> {
    let section = item.section(&[
        "tolerance",
        "max_iterations",
        "time_limit",
        "linear_solver",
        "options",
    ])?;
    if let Some(item) = section.get("tolerance") {
        solver.tolerance = item.positive("a finite number above zero")?;
    }
    if let Some(item) = section.get("max_iterations") {
        solver.max_iterations = item.count(i32::MAX as usize)? as u32;
    }
    if let Some(item) = section.get("time_limit") {
        let expected = "a finite time above zero, s";
        let limit = Duration::try_from_secs_f64(item.positive(expected)?);
        solver.time_limit = Some(limit.map_err(|_| item.unexpected(expected))?);
    }
    if let Some(item) = section.get("linear_solver") {
        let expected = "\"auto\", \"multifrontal\", or Ipopt's name of a linear solver";
        solver.linear_solver = item.text(expected)?.into();
        origin.check(item, access_of_solver(&solver.linear_solver))?;
    }
    if let Some(item) = section.get("options") {
        for item in item.entries("a table of Ipopt's options by name")? {
            let value = match &item.node.value {
                Value::Integer(number) => i32::try_from(*number).ok().map(OptionValue::Integer),
                Value::Float(number) if number.is_finite() => Some(OptionValue::Real(*number)),
                Value::Text(text) => Some(OptionValue::Text(text.clone())),
                Value::Boolean(yes) => {
                    Some(OptionValue::Text(if *yes { "yes" } else { "no" }.into()))
                }
                _ => None,
            };
            let value = value.ok_or_else(|| item.unexpected("a finite number or a string"))?;
            origin.check(&item, access_of_option(item.name, &value))?;
            solver.options.push((item.name.into(), value));
        }
    }
    Ok(())
}
