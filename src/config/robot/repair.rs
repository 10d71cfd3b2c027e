//! What a robot's file leaves open: inertias that no body has, links without mass.
//!
//! Nothing is changed that was not asked for, and each change is said. A root link whose own
//! figures cannot be used is left aside where `[base]` brings the spacecraft.

use super::description::Description;
use crate::config::ConfigError;
use crate::config::faults::Faults;
use crate::config::figures::{Figures, Unusable};
use crate::config::item::{Item, Section};
use crate::dynamics::{Inertia, InertiaError, Placement};
use nalgebra::Matrix3;
use std::collections::HashMap;

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
        let unusable = std::mem::take(&mut self.unusable);
        let places = if unusable.is_empty() {
            HashMap::new()
        } else {
            self.places()
        };
        for (name, unusable) in unusable {
            let place = &places[&name];
            let inertia = settle_body(unusable, place, repair, loaded, &mut settled);
            let at = &place.placement;
            self.add(
                &inertia.placed(&at.rotation, &at.translation),
                place.carrier,
            );
        }
        if let Some(least) = repair.minimum_mass {
            self.give_mass(least, &mut settled.changes);
        }
        settled
    }

    /// Where every body is, by its name.
    fn places(&self) -> HashMap<String, Place> {
        let mut places = HashMap::new();
        let mut put = |name: &str, carrier: Option<usize>, placement, moves| {
            let is_root = self.base.name == name || (carrier.is_none() && self.root_is_frame);
            let place = Place {
                carrier,
                placement,
                is_root,
                moves,
            };
            places.entry(name.to_owned()).or_insert(place);
        };
        let own = Placement::identity;
        put(&self.base.name, None, own(), false);
        for (j, entry) in self.joints.iter().enumerate() {
            put(&entry.joint.body.name, Some(j), own(), true);
        }
        for frame in &self.frames {
            put(&frame.name, frame.carrier, frame.placement.clone(), false);
        }
        places
    }

    /// Makes what a joint moves at least so heavy, by a ball of water at its mass centre.
    fn give_mass(&mut self, least: f64, changes: &mut Vec<String>) {
        for entry in &mut self.joints {
            let body = &mut entry.joint.body;
            let mass = body.inertia.mass();
            if mass < least {
                let ball = Inertia::ball(least - mass);
                let ball = ball.placed(&Matrix3::identity(), body.inertia.center());
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

/// Where a body is.
struct Place {
    /// The joint whose body it is part of; `None` for the base.
    carrier: Option<usize>,
    /// Its frame there.
    placement: Placement,
    /// Whether a spacecraft would stand for it.
    is_root: bool,
    /// Whether a joint moves it by itself.
    moves: bool,
}

fn settle_body(
    unusable: Unusable,
    place: &Place,
    repair: &Repair,
    loaded: bool,
    settled: &mut Settled,
) -> Inertia {
    match unusable {
        unusable if loaded && place.is_root => {
            let aside = |fault| format!("{fault}; left aside, [base] stands for this link");
            let faults = unusable.faults(false);
            settled.changes.extend(faults.iter().map(aside));
            Inertia::massless()
        }
        Unusable::Unphysical(figures, cause) if repair.inertia => {
            let gets_mass = figures.mass == 0.0 && repair.minimum_mass.is_some();
            match figures.repaired(place.moves && !gets_mass) {
                Ok((inertia, moments)) => {
                    let change = repaired(&figures, &cause, &inertia, moments);
                    settled.changes.push(change);
                    inertia
                }
                Err(_) => refused(Unusable::Unphysical(figures, cause), place.moves, settled),
            }
        }
        unusable => refused(unusable, place.moves, settled),
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
