//! Several bases followed over steps, compiled once for the vectors of each kind of machine.

use super::base_rate::Frame;
use super::chain::Chain;
use super::perturbed::Perturbed;
use super::step::{Bases, Step};
use super::watch::{Watched, Watching};
use crate::autodiff::{Kernel, dispatch};

/// What is done with the bases at each place.
pub(super) enum Looking<'a> {
    /// Their figures are taken.
    Figures(&'a [Watched], &'a mut Watching),
    /// They are kept.
    Poses(&'a mut Vec<Bases>),
}

/// Takes `bases` over `steps`; `frames` is room for one a joint. `false` where a step is too long.
pub(super) fn follow(
    steps: &[Step],
    chain: &Chain,
    robots: &Perturbed,
    frames: &mut [Frame],
    bases: &mut Bases,
    looking: Looking<'_>,
) -> bool {
    let mut solved = true;
    dispatch(Follow {
        steps,
        chain,
        robots,
        frames,
        bases,
        looking,
        solved: &mut solved,
    });
    solved
}

struct Follow<'a> {
    steps: &'a [Step],
    chain: &'a Chain,
    robots: &'a Perturbed,
    frames: &'a mut [Frame],
    bases: &'a mut Bases,
    looking: Looking<'a>,
    solved: &'a mut bool,
}

impl Kernel for Follow<'_> {
    #[inline(always)]
    fn run(mut self) {
        let mut at = 0;
        for step in self.steps {
            *self.solved &= step.take(
                self.chain,
                self.robots,
                self.frames,
                self.bases,
                #[inline(always)]
                |bases| {
                    match &mut self.looking {
                        Looking::Figures(watched, watching) => watching.look(&watched[at], bases),
                        Looking::Poses(found) => found.push(*bases),
                    }
                    at += 1;
                },
            );
        }
    }
}
