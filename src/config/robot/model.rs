//! The model of a robot as read, or all that keeps it from being one.

use super::Robot;
use super::description::Entry;
use super::repair::Settled;
use crate::config::faults::Faults;
use crate::config::{ConfigError, Place};
use crate::dynamics::{Inertia, Model, ModelError};

impl Robot {
    /// The model. What was changed for it is in `changes` from then on.
    ///
    /// # Errors
    /// All that keeps the robot from being one.
    pub(in crate::config) fn model(&mut self) -> Result<Model, ConfigError> {
        let mut faults = self.description.faults.clone();
        let Settled {
            faults: unphysical,
            changes,
        } = self
            .description
            .settle(&self.repair, self.spacecraft.is_some());
        faults.append(unphysical);
        self.changes = changes;
        faults.keep(refuse(&self.description.joints));
        let model = match self.description.model() {
            Ok(model) => Some(model),
            Err(_) => {
                self.model_faults(&mut faults);
                None
            }
        };
        let file = Place {
            source: self.file.path.as_str().into(),
            line: None,
        };
        match model {
            Some(model) if faults.is_empty() => Ok(model),
            _ => Err(faults.into_error(file)),
        }
    }

    /// What keeps the bodies from being a model: each thing is mended for as long as it takes to
    /// find the next.
    fn model_faults(&self, faults: &mut Faults) {
        let mut mended = self.description.clone();
        let mut massless = Vec::new();
        let mut base = None;
        while let Err(cause) = mended.model() {
            match cause {
                ModelError::Base { .. } => {
                    mended.base.inertia = Inertia::ball(1.0);
                    base = Some(cause);
                }
                ModelError::MasslessJoint { ref joint, .. } if !known(&massless, joint) => {
                    let entry = mended.joints.iter_mut().find(|e| e.joint.name == *joint);
                    let entry = entry.expect("a joint of this robot");
                    entry.joint.body.inertia = entry.joint.body.inertia.lumped(&Inertia::ball(1.0));
                    massless.push((joint.clone(), cause));
                }
                ModelError::MasslessJoint { .. } => break,
                cause => {
                    faults.push(ConfigError::Model {
                        place: self.place.clone(),
                        key: self.key.clone(),
                        cause,
                    });
                    break;
                }
            }
        }
        let lacking = base.is_some() || !massless.is_empty();
        match &self.description.kinematic {
            Some(place) if lacking && self.repair.minimum_mass.is_none() => {
                faults.push(kinematic(place));
            }
            _ => {
                faults.keep(base.map_or(Ok(()), |cause| Err(self.base_fault(&cause))));
                faults.keep(self.massless_fault(massless).map_or(Ok(()), Err));
            }
        }
    }

    fn base_fault(&self, cause: &ModelError) -> ConfigError {
        ConfigError::Value {
            place: self.place.clone(),
            key: self.key.clone(),
            found: cause.to_string(),
            expected: "a heavier root link, or a spacecraft under it: [base] with mass and inertia"
                .into(),
        }
    }

    /// The first in full, the others by name.
    fn massless_fault(&self, massless: Vec<(String, ModelError)>) -> Option<ConfigError> {
        let (others, mut found) = (massless.get(1..)?, massless.iter());
        let (first, cause) = found.next()?;
        let entry = self
            .description
            .joints
            .iter()
            .find(|e| e.joint.name == *first);
        let others: Vec<String> = others.iter().map(|(name, _)| format!("'{name}'")).collect();
        let likewise = match others.is_empty() {
            true => String::new(),
            false => format!("; likewise {}", others.join(", ")),
        };
        Some(ConfigError::Format {
            place: entry.map_or(&self.place, |entry| &entry.place).clone(),
            message: format!(
                "{cause}; expected bodies with mass, a fixed joint, this one in robot.lock, or \
                 robot.minimum_mass{likewise}"
            ),
        })
    }
}

/// Massless joints that are named at most.
const MOST_MASSLESS: usize = 40;

/// Whether the search for massless joints ends: mass does not help one of two about the same axis.
fn known(massless: &[(String, ModelError)], joint: &str) -> bool {
    massless.len() == MOST_MASSLESS || massless.iter().any(|(name, _)| name == joint)
}

/// Not one link has a mass: said once, and not of every joint.
fn kinematic(place: &Place) -> ConfigError {
    ConfigError::Format {
        place: place.clone(),
        message: "no link has <inertial>: a kinematic model, and how it moves depends on masses; \
                  expected <inertial> in the links that joints move, or robot.minimum_mass, and a \
                  spacecraft under them: [base] with mass and inertia"
            .into(),
    }
}

/// Refuses joints that cannot move by themselves: the first with its reason, all by name.
fn refuse(entries: &[Entry]) -> Result<(), ConfigError> {
    let mut refused = entries.iter().filter(|entry| entry.refusal.is_some());
    let Some(mut error) = refused.next().and_then(|entry| entry.refusal.clone()) else {
        return Ok(());
    };
    let others: Vec<String> = refused.map(|e| format!("'{}'", e.joint.name)).collect();
    if let (ConfigError::Value { expected, .. }, false) = (&mut error, others.is_empty()) {
        expected.push_str(&format!("; likewise {}", others.join(", ")));
    }
    Err(error)
}
