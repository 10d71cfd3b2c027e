//! What is not known exactly when a plan is carried out, and how it is distributed.
//!
//! Values are given by `--set KEY=DISTRIBUTION`; docs/dispersion.md describes keys and distributions.

mod quantity;
mod value;

pub use quantity::Dispersed;

use super::distribution::Distribution;
use super::{ConfigError, Place};
use crate::dynamics::Model;

/// Standard deviation of masses, a part of each.
const MASS: f64 = 0.01;
/// Standard deviation of mass centres along each axis, m.
const COM: f64 = 1e-3;
/// Standard deviation of the factors on second moments of mass.
const INERTIA: f64 = 0.02;
/// Standard deviation of the constant errors of joints, rad or m.
const OFFSET: f64 = 5e-4;
/// Standard deviation of the joints' tracking errors at every instant, rad or m.
const TRACKING: f64 = 1e-3;
/// Standard deviations of the base's velocity (m/s) and angular velocity (rad/s) that a thruster
/// control leaves along each axis.
const RESIDUAL: f64 = 1e-5;
/// Part of a distribution of what has to be above zero that may be below it, and is drawn again.
const MOST_BELOW_ZERO: f64 = 0.01;
/// Least value of what has to be above zero, as a part of its value in the plan.
const LEAST: f64 = 1e-3;

/// A quantity with its distribution.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Perturbation {
    /// What it is.
    pub quantity: Dispersed,
    /// Its key.
    pub key: String,
    /// How it is distributed, in its unit; each of its components by itself.
    pub distribution: Distribution,
}

/// All that is perturbed.
#[derive(Debug, Clone, PartialEq)]
pub struct Dispersion {
    perturbations: Vec<Perturbation>,
}

impl Dispersion {
    /// Nothing is perturbed: every quantity of `model` has its value in the plan.
    pub fn none(model: &Model) -> Self {
        Self::with(model, |quantity| {
            Distribution::Fixed(quantity.nominal(model))
        })
    }

    /// What is usual for a spacecraft of which nothing is known: standard deviations of 1 % of each
    /// mass, 1 mm of each mass centre, 2 % of each second moment of mass, 0.5 mrad of each joint's
    /// zero and 1 mrad of its tracking error (mm where it slides), and as much momentum as a velocity
    /// of 0.01 mm/s of the whole and an angular velocity of 0.01 mrad/s of the base about the axis of
    /// its largest moment.
    pub fn usual(model: &Model) -> Self {
        let [.., turning] = model.base().inertia.moments();
        Self::with(model, |quantity| match quantity {
            Dispersed::Mass(_) => {
                let mass = quantity.nominal(model);
                positive(Distribution::normal(mass, MASS * mass), mass)
            }
            Dispersed::Com(_) => Distribution::normal(0.0, COM),
            Dispersed::Inertia(_) => positive(Distribution::normal(1.0, INERTIA), 1.0),
            Dispersed::Offset(_) => Distribution::normal(0.0, OFFSET),
            Dispersed::Tracking(_) => Distribution::normal(0.0, TRACKING),
            Dispersed::LinearMomentum => Distribution::normal(0.0, RESIDUAL * model.total_mass()),
            Dispersed::AngularMomentum => Distribution::normal(0.0, RESIDUAL * turning),
        })
    }

    fn with(model: &Model, distribution: impl Fn(Dispersed) -> Distribution) -> Self {
        let all = Dispersed::all(model).into_iter();
        Self {
            perturbations: all
                .map(|quantity| Perturbation {
                    quantity,
                    key: quantity.key(model),
                    distribution: distribution(quantity),
                })
                .collect(),
        }
    }

    /// Every quantity, in a fixed order: bodies, the base first, joints, momentum.
    pub fn perturbations(&self) -> &[Perturbation] {
        &self.perturbations
    }

    /// Takes `KEY=DISTRIBUTION`, as `--set` has it. `*` stands for every name: `body.*.mass`.
    ///
    /// # Errors
    /// [`ConfigError`] for a key that is none, saying what there is, and for a distribution that is
    /// none or makes no sense there.
    pub fn set(&mut self, model: &Model, assignment: &str) -> Result<(), ConfigError> {
        let place = Place {
            source: format!("--set {assignment}").into(),
            line: None,
        };
        let Some((key, text)) = assignment.split_once('=') else {
            let message =
                "no '='; expected --set KEY=DISTRIBUTION, as body.base.mass=normal(100%, 1%)";
            return Err(ConfigError::Format {
                place,
                message: message.into(),
            });
        };
        let key = key.trim();
        let chosen: Vec<usize> = (0..self.perturbations.len())
            .filter(|i| is_meant(key, &self.perturbations[*i].key))
            .collect();
        if chosen.is_empty() {
            return Err(ConfigError::UnknownKey {
                place,
                key: key.into(),
                hint: hint(model, key),
            });
        }
        for i in chosen {
            let quantity = self.perturbations[i].quantity;
            let nominal = Some(quantity.nominal(model)).filter(|nominal| *nominal != 0.0);
            let unusable = |expected: String| ConfigError::Value {
                place: place.clone(),
                key: self.perturbations[i].key.clone(),
                found: text.trim().to_owned(),
                expected,
            };
            let distribution = value::distribution(text, nominal)
                .map_err(|fault| unusable(fault.expected))
                .and_then(|found| sensible(quantity, nominal, found).map_err(&unusable))?;
            self.perturbations[i].distribution = distribution;
        }
        Ok(())
    }

    /// Whether every quantity has but one value.
    pub fn is_fixed(&self) -> bool {
        let mut all = self.perturbations.iter();
        all.all(|perturbation| perturbation.distribution.is_fixed())
    }
}

/// `found` with nothing in it that the quantity cannot be, or what was expected.
fn sensible(
    quantity: Dispersed,
    nominal: Option<f64>,
    found: Distribution,
) -> Result<Distribution, String> {
    let most = quantity.most();
    let sizes = match found {
        Distribution::Fixed(value) => [value, 0.0],
        Distribution::Uniform(ends) | Distribution::LogUniform(ends) => ends,
        Distribution::Normal { mean, sd, .. } => [mean, sd],
    };
    if sizes.iter().any(|size| size.abs() > most) {
        return Err(format!("numbers of at most {most:.3e}"));
    }
    if !quantity.is_positive() {
        return Ok(found);
    }
    let below = found.part_below_zero();
    let drawn_again = matches!(found, Distribution::Normal { .. });
    if below > if drawn_again { MOST_BELOW_ZERO } else { 0.0 } {
        return Err(match drawn_again {
            true => format!(
                "at most {} % of the distribution at or below zero, {:.0} % of this one is",
                100.0 * MOST_BELOW_ZERO,
                100.0 * below
            ),
            false => "values above zero".into(),
        });
    }
    Ok(positive(found, nominal.unwrap_or(1.0)))
}

/// A normal distribution drawn again where it is not above zero.
fn positive(distribution: Distribution, nominal: f64) -> Distribution {
    match distribution {
        Distribution::Normal { mean, sd, range } => Distribution::Normal {
            mean,
            sd,
            range: [range[0].max(LEAST * nominal.min(mean)), range[1]],
        },
        other => other,
    }
}

/// Whether `pattern`, in which `*` stands for the name of any body or joint, is `key`. Names may have dots.
fn is_meant(pattern: &str, key: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == key,
        Some((head, tail)) => {
            let for_a_name = matches!(head, "body." | "joint.") && tail.starts_with('.');
            for_a_name
                && key.len() > head.len() + tail.len()
                && key.starts_with(head)
                && key.ends_with(tail)
        }
    }
}

/// What there is instead of `key`.
fn hint(model: &Model, key: &str) -> String {
    let bodies = std::iter::once(&model.base().name)
        .chain(model.joints().iter().map(|joint| &joint.body.name));
    let list = |names: Vec<&str>| names.join(", ");
    let of = |what: &str, parts: &str, names: Vec<&str>| {
        format!(
            "expected {what}.NAME.{parts} with NAME one of {}",
            list(names)
        )
    };
    let (first, last) = (key.split('.').next(), key.rsplit('.').next());
    match (first, last) {
        (Some("body"), Some("mass" | "com" | "inertia")) => {
            let massless = "bodies without mass have nothing to perturb; ";
            let named = bodies
                .clone()
                .any(|name| key.starts_with(&format!("body.{name}.")));
            let why = if named { massless } else { "" };
            let names = bodies.map(String::as_str).collect();
            format!("{why}{}", of("body", "mass, .com or .inertia", names))
        }
        (Some("joint"), Some("offset" | "tracking")) => {
            let names = model.joints().iter().map(|joint| joint.name.as_str());
            of("joint", "offset or .tracking", names.collect())
        }
        _ => "expected body.NAME.mass, body.NAME.com, body.NAME.inertia, joint.NAME.offset, \
              joint.NAME.tracking, momentum.linear or momentum.angular; * stands for every NAME"
            .into(),
    }
}
