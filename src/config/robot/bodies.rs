//! `robot.bodies.<name>`: mass properties of named bodies that go before those of the robot's file:
//! a payload, or a robot whose masses are not as drawn.
//!
//! They are laid over the figures of the file before bodies are welded together, so that a link
//! behind a fixed joint can be changed as any other.

use crate::config::ConfigError;
use crate::config::Place;
use crate::config::figures::{Figures, Unusable, last_digit};
use crate::config::inertia::{EXPECTED, matrix};
use crate::config::item::{Item, hint};
use crate::dynamics::{Inertia, InertiaError, Placement};
use nalgebra::{Matrix3, Vector3};

/// What is given of one body.
#[derive(Debug, Clone, PartialEq)]
struct Given {
    name: String,
    place: Place,
    key: String,
    /// kg.
    mass: Option<f64>,
    /// m, in the body's frame.
    com: Option<Vector3<f64>>,
    /// Rotational inertia about the mass centre, in the body's axes, kg m², with its own place and
    /// key.
    inertia: Option<(Matrix3<f64>, Place, String)>,
}

/// What is given of the bodies of a robot.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Bodies {
    given: Vec<Given>,
}

impl Bodies {
    /// Reads the table.
    pub(super) fn read(item: &Item<'_>) -> Result<Self, ConfigError> {
        let expected = "a table of bodies by name, each with mass, com or inertia";
        let bodies = item.entries(expected)?;
        let given = bodies.iter().map(body).collect::<Result<_, _>>()?;
        Ok(Self { given })
    }

    fn of(&self, name: &str) -> Option<&Given> {
        self.given.iter().find(|given| given.name == name)
    }

    /// Whether anything is given of the body `name`.
    pub(super) fn has(&self, name: &str) -> bool {
        self.of(name).is_some()
    }

    /// Lays what is given of the body `name` over its figures from the robot's file.
    pub(super) fn change(&self, name: &str, figures: &mut Figures) {
        let Some(given) = self.of(name) else { return };
        figures.place = given.place.clone();
        figures.key = given.key.clone();
        if let Some(mass) = given.mass {
            figures.mass = mass;
        }
        if let Some(com) = given.com {
            figures.pose.translation = com;
        }
        if let Some((own, place, key)) = &given.inertia {
            figures.own = *own;
            figures.rounding = rounding(own);
            figures.pose.rotation = Matrix3::identity();
            figures.place = place.clone();
            figures.key = key.clone();
        }
    }

    /// The mass properties of a body of which the robot's file says nothing, massless where nothing
    /// is given either.
    pub(super) fn whole(&self, name: &str) -> Result<Inertia, Unusable> {
        let Some(given) = self.of(name) else {
            return Ok(Inertia::massless());
        };
        let missing = |part: &str, expected: &str| {
            let fault = ConfigError::Missing {
                place: given.place.clone(),
                key: format!("{}.{part}", given.key),
                expected: format!("{expected}; the robot's file gives none"),
            };
            Unusable::Unread(fault.into())
        };
        let mass = given.mass.ok_or_else(|| missing("mass", MASS))?;
        let inertia = given.inertia.as_ref();
        let (own, place, key) = inertia.ok_or_else(|| missing("inertia", EXPECTED))?;
        let figures = Figures {
            place: place.clone(),
            key: key.clone(),
            mass,
            own: *own,
            rounding: rounding(own),
            pose: Placement {
                translation: given.com.unwrap_or_default(),
                ..Placement::identity()
            },
        };
        figures
            .inertia()
            .map_err(|cause| Unusable::Unphysical(Box::new(figures), cause))
    }

    /// Refuses what is given of a body that is none of `names`.
    pub(super) fn check(&self, names: &[&str]) -> Result<(), ConfigError> {
        let unknown = |given: &&Given| !names.contains(&given.name.as_str());
        match self.given.iter().find(unknown) {
            Some(given) => Err(ConfigError::UnknownKey {
                place: given.place.clone(),
                key: given.key.clone(),
                hint: hint(&given.name, names),
            }),
            None => Ok(()),
        }
    }
}

const MASS: &str = "a finite mass above zero, kg";

fn body(item: &Item<'_>) -> Result<Given, ConfigError> {
    let section = item.section(&["mass", "com", "inertia"])?;
    let mass = section.get("mass");
    let com = section.get("com");
    let inertia = section.get("inertia");
    if mass.is_none() && com.is_none() && inertia.is_none() {
        return Err(item.error("an empty table", "mass, com or inertia"));
    }
    let given = Given {
        name: item.name.into(),
        place: item.node.place.clone(),
        key: item.key.clone(),
        mass: mass.map(|item| item.positive(MASS)).transpose()?,
        com: com
            .map(|item| item.triple("an array of 3 lengths, m").map(Vector3::from))
            .transpose()?,
        inertia: inertia
            .map(|item| matrix(item).map(|own| (own, item.node.place.clone(), item.key.clone())))
            .transpose()?,
    };
    // What is too large is so whatever stands in the robot's file.
    let whole = [
        (mass, (given.mass, None, None)),
        (com, (None, given.com, None)),
        (inertia, (None, None, given.inertia.as_ref())),
    ];
    for (item, (mass, com, inertia)) in whole {
        let own = inertia.map_or(Matrix3::identity(), |(own, ..)| *own);
        let found = Inertia::new(mass.unwrap_or(1.0), com.unwrap_or_default(), own);
        if let (Some(item), Err(cause @ InertiaError::TooLarge { .. })) = (item, found) {
            return Err(ConfigError::Inertia {
                place: item.node.place.clone(),
                key: item.key.clone(),
                cause,
            });
        }
    }
    Ok(given)
}

/// By how much rounding may have changed figures, as the shortest way to write them has it.
fn rounding(own: &Matrix3<f64>) -> Matrix3<f64> {
    own.map(|figure| 0.5 * last_digit(&format!("{figure:e}")))
}
