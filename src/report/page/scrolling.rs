//! Tables that may be wider than the window.

use maud::{Markup, html};

/// The table, which scrolls by itself; it takes the focus, so that keys scroll it.
pub(super) fn scrolling(label: &str, table: &Markup) -> Markup {
    html! {
        div.scrolling tabindex="0" role="region" aria-label=(label) { (table) }
    }
}
