//! The refinement laws, one file a law.
//!
//! | file | law |
//! | --- | --- |
//! | `adaptive` | the paper's: segments divided or degrees raised, eq. (29) to (32) |
//! | `global` | the degree raised everywhere |
//!
//! A new law is a file here and a line in [`Settings::law`].

mod adaptive;
mod global;
mod raise;

use super::{Method, RefinementLaw, Settings};
use crate::collocation::{Mesh, MeshError};
use adaptive::Adaptive;
use global::Global;

impl Settings {
    /// The law that these settings ask for.
    pub fn law(&self) -> Box<dyn RefinementLaw + '_> {
        match self.method {
            Method::Adaptive => Box::new(Adaptive(self)),
            Method::Global => Box::new(Global(self)),
        }
    }

    /// The first mesh of that law.
    ///
    /// # Errors
    /// [`MeshError`] where a count is zero.
    pub fn first_mesh(&self) -> Result<Mesh, MeshError> {
        self.law().first_mesh()
    }
}
