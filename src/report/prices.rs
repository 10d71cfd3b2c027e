//! What holds J up, in words.

use crate::digits::digits;
use crate::problem::LimitId;
use crate::system::ShadowPrice;

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
        if part >= LEAST {
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
