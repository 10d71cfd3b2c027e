//! What holds J up, in words.

use crate::problem::LimitId;
use crate::system::ShadowPrice;
use crate::text::digits::digits;

/// How much wider the limits are thought to be.
const WIDER: f64 = 0.1;
/// Least part of J that is worth a word.
const LEAST: f64 = 0.005;
/// Most limits that are named.
const MOST: usize = 3;

/// By how much J would fall were the dearest limits a tenth wider, to first order; `None` where none
/// of them matters.
pub(super) fn dearest(prices: &[ShadowPrice], cost: f64) -> Option<String> {
    let mut named = Vec::new();
    for found in prices.iter().take(MOST) {
        let part = WIDER * found.price / cost;
        // No limit holds up more than all of J: where J is next to nothing, shares of it say nothing.
        if (LEAST..=1.0).contains(&part) {
            named.push(format!(
                "{}{}: J −{} %",
                found.name,
                place(found.id.limit),
                digits(100.0 * part, 2, 1)
            ));
        }
    }
    let all = named.join(", ");
    (!named.is_empty()).then(|| format!("{all}, were it a tenth wider"))
}

/// Where a limit holds that has the name of another along the path.
fn place(limit: LimitId) -> &'static str {
    match limit {
        LimitId::FinalBaseAttitude => " at the end",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::{BoundId, Component};

    #[test]
    fn shares_of_next_to_nothing_are_not_named() {
        let id = BoundId::new(LimitId::JointPosition, Component::Joint(0));
        let price = ShadowPrice {
            id,
            name: "position of joint elbow".into(),
            price: 1e-3,
        };
        let of = |cost| dearest(std::slice::from_ref(&price), cost);
        assert_eq!(
            of(1e-3).as_deref(),
            Some("position of joint elbow: J −10.00 %, were it a tenth wider")
        );
        for cost in [0.0, 1e-17, -1e-17, f64::NAN, 1.0] {
            assert_eq!(of(cost), None, "{cost}");
        }
    }
}
