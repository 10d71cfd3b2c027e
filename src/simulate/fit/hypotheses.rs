//! Several hypotheses about one platform.

use super::{Experiments, Fit, Unknown};
use crate::parallel;
use crate::simulate::{Platform, SimulateError};

impl Experiments {
    /// Each set of unknowns fitted by itself, several at a time, as of [`Self::fit`].
    ///
    /// Searches are local. Where a set ends above the residual of another that is a part of it, it
    /// is searched again from there as well: what explains more with fewer numbers explains as
    /// much with more. Where `stop` says so the best so far are returned.
    ///
    /// # Errors
    /// [`SimulateError`] where `platform` itself cannot be simulated.
    pub fn fit_each(
        &self,
        platform: &Platform,
        hypotheses: &[Vec<Unknown>],
        starts: usize,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Vec<Fit>, SimulateError> {
        let fit = |h: usize| self.fit(platform, &hypotheses[h], starts, &stop);
        let mut fits = parallel::map(hypotheses.len(), &fit)
            .into_iter()
            .collect::<Result<Vec<_>, _>>()?;
        let mut order: Vec<usize> = (0..hypotheses.len()).collect();
        order.sort_by_key(|&h| hypotheses[h].len());
        for h in order {
            let within = |&part: &usize| {
                hypotheses[part].len() < hypotheses[h].len()
                    && hypotheses[part].iter().all(|u| hypotheses[h].contains(u))
            };
            let best = (0..hypotheses.len())
                .filter(within)
                .min_by(|&a, &b| fits[a].residual.total_cmp(&fits[b].residual));
            if let Some(part) = best.filter(|&part| fits[part].residual < fits[h].residual)
                && !stop()
            {
                let from = Some(&fits[part]);
                fits[h] = self.fit_from(platform, &hypotheses[h], starts, from, &stop)?;
            }
        }
        Ok(fits)
    }
}
