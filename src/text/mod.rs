//! Numbers and foreign text as a person is shown them.
//!
//! | file | does |
//! | --- | --- |
//! | `digits` | numbers with as many digits as their size needs |
//! | `printable` | text from files without what steers a terminal or breaks XML |

pub(crate) mod digits;
pub(crate) mod printable;
