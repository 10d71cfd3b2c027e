//! The cost (14) of a planned motion, term by term.

use crate::problem::CostId;

/// Whose motion a term of the cost is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Side {
    /// The base's alone.
    Base,
    /// The joints' motion and effort alone.
    Joints,
    /// Both, or the duration.
    Both,
}

/// A term of the cost.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct CostTerm {
    /// The weights behind it.
    pub id: CostId,
    /// Whose motion it is about.
    pub side: Side,
    /// Its value, with its weights.
    pub value: f64,
}

/// The terms of (14) that have weights, by the quadrature of (25). Their sum is J.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct CostTerms {
    /// In no particular order; the matrix Λ gives up to three, one a side.
    pub terms: Vec<CostTerm>,
}

impl CostTerms {
    /// J.
    pub fn total(&self) -> f64 {
        self.sum(|_| true)
    }

    /// What is about the base's motion alone.
    pub fn base(&self) -> f64 {
        self.sum(|term| term.side == Side::Base)
    }

    /// What is about the joints' motion and effort alone.
    pub fn joints(&self) -> f64 {
        self.sum(|term| term.side == Side::Joints)
    }

    /// What the weights behind `id` add; 0 where there are none.
    pub fn of(&self, id: CostId) -> f64 {
        self.sum(|term| term.id == id)
    }

    fn sum(&self, which: impl Fn(&CostTerm) -> bool) -> f64 {
        let chosen = self.terms.iter().filter(|term| which(term));
        chosen.map(|term| term.value).sum()
    }
}
