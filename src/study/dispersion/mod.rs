//! One plan replayed under what is not known exactly: perturbed masses, mass centres and inertias,
//! tracking errors of the joints, initial momentum. The joints do what the plan says, but for their
//! errors; the base does what conservation of momentum makes of it.
//!
//! [`Replays`] has what all samples share; [`Replays::run`] gives the [`Figures`] of each sample,
//! [`Spread`] their distribution, [`Sensitivities`] which quantity they come from.
//!
//! | file | does |
//! | --- | --- |
//! | `draws` | every number drawn, a function of seed, key and sample |
//! | `perturbed`, `sample` | robots with these numbers: several side by side, and one taken apart |
//! | `chain`, `tracking`, `path` | what samples share: frames, harmonics of tracking errors, the joints' motion |
//! | `lanes` | numbers and vectors of several samples side by side |
//! | `base_rate` | the base's motion at one instant by conservation of momentum |
//! | `gauss`, `step`, `follow`, `schedule` | Gauss-Legendre collocation, one step of it, many, the choice of steps |
//! | `watch`, `figures` | what is looked at on the way |
//! | `replays` | all of it together, on several threads |
//! | `spread`, `sensitivity` | statistics |
//! | `error` | why there are none |
//!
//! docs/dispersion.md says what is modelled.

mod base_rate;
mod chain;
mod draws;
mod error;
mod figures;
mod follow;
mod gauss;
mod lanes;
mod path;
mod perturbed;
mod replays;
mod sample;
mod schedule;
mod sensitivity;
mod spread;
mod step;
mod tracking;
mod watch;

pub use error::DispersionError;
pub use figures::Figures;
pub use replays::{MOST_SAMPLES, Replays};
pub use sample::Sample;
pub use sensitivity::{Response, Sensitivities, Share};
pub use spread::Spread;
pub use tracking::HARMONICS;
