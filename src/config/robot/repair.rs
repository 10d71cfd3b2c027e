//! What a robot's file leaves open: inertias that no body has, links without mass.
//!
//! Nothing is changed that was not asked for, and each change is said. A root link whose own
//! figures cannot be used is left aside where `[base]` brings the spacecraft.

use super::description::Description;
use crate::config::ConfigError;
use crate::config::faults::Faults;
use crate::config::figures::{Figures, Unusable};
use crate::config::item::{Item, Section};
use crate::dynamics::{Inertia, InertiaError};

/// What may be changed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Repair {
    /// Whether the nearest inertia of a body is taken for one that no body has.
    pub inertia: bool,
    /// Least mass of what a joint moves, kg.
    pub minimum_mass: Option<f64>,
}

impl Repair {
    /// Keys of the table `robot`.
    pub(super) const KEYS: [&str; 2] = ["repair", "minimum_mass"];

    /// Reads them.
    pub(super) fn read(section: &Section<'_>) -> Result<Self, ConfigError> {
        let repair = |item: &Item<'_>| match item.text(REPAIR)? {
            "inertia" => Ok(true),
            _ => Err(item.unexpected(REPAIR)),
        };
        let mass = |item: &Item<'_>| item.positive("a finite mass above zero, kg");
        Ok(Self {
            inertia: section.get("repair").map_or(Ok(false), repair)?,
            minimum_mass: section.get("minimum_mass").map(mass).transpose()?,
        })
    }
}

const REPAIR: &str = "\"inertia\", the only repair there is";

/// What settling a robot came to.
#[derive(Debug, Default)]
pub(super) struct Settled {
    /// What cannot be used.
    pub faults: Faults,
    /// What was changed, a line each.
    pub changes: Vec<String>,
}

impl Description {
    /// Gives every body mass properties; `loaded` says whether a spacecraft stands for the root
    /// link. Bodies with a fault get some as well, so that their joints are not found at fault too.
    pub(super) fn settle(&mut self, repair: &Repair, loaded: bool) -> Settled {
        let mut settled = Settled::default();
        for (name, unusable) in std::mem::take(&mut self.unusable) {
            let inertia = self.settle_body(&name, unusable, repair, loaded, &mut settled);
            let (carrier, at) = self.body(&name).expect("a body of this robot");
            self.add(&inertia.placed(&at.rotation, &at.translation), carrier);
        }
        if let Some(least) = repair.minimum_mass {
            self.give_mass(least, &mut settled.changes);
        }
        settled
    }

    fn settle_body(
        &self,
        name: &str,
        unusable: Unusable,
        repair: &Repair,
        loaded: bool,
        settled: &mut Settled,
    ) -> Inertia {
        let (carrier, _) = self.body(name).expect("a body of this robot");
        let is_root = self.base.name == name || (carrier.is_none() && self.root_is_frame);
        let moves = self
            .joints
            .iter()
            .any(|entry| entry.joint.body.name == *name);
        let given_mass = repair.minimum_mass.is_some();
        match unusable {
            unusable if loaded && is_root => {
                let faults = unusable.faults(false);
                let aside = |fault| format!("{fault}; left aside, [base] stands for this link");
                settled.changes.extend(faults.iter().map(aside));
                Inertia::massless()
            }
            Unusable::Unphysical(figures, cause) if repair.inertia => {
                let held = figures.mass == 0.0 && given_mass;
                match figures.repaired(moves && !held) {
                    Ok((inertia, moments)) => {
                        let change = repaired(&figures, &cause, &inertia, moments);
                        settled.changes.push(change);
                        inertia
                    }
                    Err(_) => refused(Unusable::Unphysical(figures, cause), moves, settled),
                }
            }
            unusable => refused(unusable, moves, settled),
        }
    }

    /// Makes what a joint moves at least so heavy, by a ball of water at its mass centre.
    fn give_mass(&mut self, least: f64, changes: &mut Vec<String>) {
        for entry in &mut self.joints {
            let body = &mut entry.joint.body;
            let mass = body.inertia.mass();
            if mass < least {
                let ball = Inertia::ball(least - mass);
                let still = nalgebra::Matrix3::identity();
                let ball = ball.placed(&still, body.inertia.center());
                body.inertia = body.inertia.lumped(&ball);
                changes.push(format!(
                    "{}: joint '{}' moves {mass} kg in body '{}': made {least} kg by a ball of \
                     water at its mass centre, as robot.minimum_mass asks",
                    entry.place, entry.joint.name, body.name
                ));
            }
        }
    }
}

fn repaired(
    figures: &Figures,
    cause: &InertiaError,
    inertia: &Inertia,
    [a, b, c]: [f64; 3],
) -> String {
    let now = if inertia.mass() == 0.0 {
        "taken as neither".into()
    } else {
        format!("taken as the nearest that a body can have, {a:.6e}, {b:.6e}, {c:.6e} kg m²")
    };
    format!("{}: {}: {cause}; {now}", figures.place, figures.key)
}

/// Keeps the faults; the inertia is one with which the search for others can go on.
fn refused(unusable: Unusable, moves: bool, settled: &mut Settled) -> Inertia {
    for fault in unusable.faults(moves) {
        settled.faults.push(fault);
    }
    Inertia::ball(1.0)
}
