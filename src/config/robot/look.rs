//! A part of a link as it is drawn.

use crate::config::appearance::Form;
use crate::dynamics::Placement;

/// A part of a link, in the link's frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Look {
    pub placement: Placement,
    pub form: Form,
    pub colour: Option<[f64; 3]>,
    pub is_collision: bool,
}
