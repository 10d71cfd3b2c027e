//! What is printed of a plan where there is no terminal for a live line.

use std::time::{Duration, Instant};

/// Lines of a plan in the making, one a mesh. They are held back at first, so that what is planned in
/// no time is planned without a word.
#[derive(Debug)]
pub(super) struct LogLines {
    began: Instant,
    patience: Duration,
    held: Vec<String>,
    /// What is being done, as long as it is not said.
    under_way: Option<String>,
}

impl LogLines {
    /// None yet, nor before `patience` is over.
    pub(super) fn after(patience: Duration) -> Self {
        Self {
            began: Instant::now(),
            patience,
            held: Vec::new(),
            under_way: None,
        }
    }

    /// Something begins.
    pub(super) fn begin(&mut self, line: String) {
        self.under_way = Some(line);
    }

    /// What had begun is done; one line for both where the first was not printed yet.
    pub(super) fn end(&mut self, line: String) {
        self.under_way = None;
        self.held.push(line);
    }

    /// The lines to be printed now.
    pub(super) fn due(&mut self) -> Vec<String> {
        if self.began.elapsed() < self.patience {
            return Vec::new();
        }
        let mut due = std::mem::take(&mut self.held);
        due.extend(self.under_way.take());
        due
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_a_mesh_is_held_back_until_it_takes_long() {
        let mut quick = LogLines::after(Duration::from_secs(3600));
        quick.begin("mesh 1".into());
        quick.end("mesh 1: J 2".into());
        assert!(quick.due().is_empty());
        quick.patience = Duration::ZERO;
        quick.begin("mesh 2".into());
        assert_eq!(quick.due(), ["mesh 1: J 2", "mesh 2"]);
        assert!(quick.due().is_empty());
        quick.end("mesh 2: J 1".into());
        quick.begin("mesh 3".into());
        quick.end("mesh 3: J 1".into());
        assert_eq!(quick.due(), ["mesh 2: J 1", "mesh 3: J 1"]);
    }
}
