//! The refinement laws, one file a law.
//!
//! | file | law |
//! | --- | --- |
//! | `adaptive` | the paper's: segments divided or degrees raised, eq. (29) to (32) |
//! | `structure` | breakpoints where controls switch, placed by the solve |
//! | `global` | the degree raised everywhere |
//!
//! A new law is a file here with its `Law`, and an entry in the list of `method`.

mod adaptive;
mod global;
mod raise;
mod structure;

use super::method::methods;
use super::{Law, Method, RefinementLaw, Settings};
use crate::collocation::{Mesh, MeshError};

macro_rules! choose {
    ($($(#[$doc:meta])* $variant:ident, $file:ident, $name:literal, $title:literal;)*) => {
        impl Settings {
            /// The law that these settings ask for.
            pub fn law(&self) -> Box<dyn RefinementLaw + '_> {
                match self.method {
                    Method::Adaptive if self.law == Law::Structure => {
                        Box::new(structure::Law(self))
                    }
                    $(Method::$variant => Box::new($file::Law(self)),)*
                }
            }
        }
    };
}
methods!(choose);

impl Settings {
    /// The first mesh of the law.
    ///
    /// # Errors
    /// [`MeshError`] where a count is zero.
    pub fn first_mesh(&self) -> Result<Mesh, MeshError> {
        self.law().first_mesh()
    }
}
