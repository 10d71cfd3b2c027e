//! What all pages begin with.

use crate::solution::Build;
use maud::{Markup, PreEscaped, html};

const STYLE: &str = include_str!("page.css");

/// The head of a page with this title.
pub(super) fn head(title: &str) -> Markup {
    html! {
        head {
            meta charset="utf-8";
            meta name="viewport" content="width=device-width, initial-scale=1";
            meta name="generator" content={ "ffsm-ipopt " (Build::VERSION) };
            title { (title) }
            style { (PreEscaped(STYLE)) }
        }
    }
}
