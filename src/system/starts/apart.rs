//! How deep a joint path leads into what is kept apart from the arm.

use crate::dynamics::space::Space;
use crate::ocp::{Ocp, Point};
use crate::problem::LimitId;
use crate::system::free_floating::FreeFloating;
use crate::system::guess::JointPath;

/// Parts of a path at whose ends limits are asked for.
pub(super) const SAMPLES: usize = 48;

/// The pairs of bodies that are kept apart.
#[derive(Debug)]
pub(super) struct Apart<'a, Sp: Space> {
    system: &'a FreeFloating<Sp>,
    /// Which of the path rows are clearances.
    rows: Vec<usize>,
}

impl<'a, Sp: Space> Apart<'a, Sp> {
    pub fn new(system: &'a FreeFloating<Sp>) -> Self {
        let rows = system.path_rows().iter().enumerate();
        let clearances = rows.filter(|(_, row)| row.id.limit == LimitId::KeepOut);
        Self {
            system,
            rows: clearances.map(|(p, _)| p).collect(),
        }
    }

    /// The deepest overlap of any pair along `path`, m; negative where all are apart throughout.
    pub fn overlap(&self, path: &JointPath) -> f64 {
        if self.rows.is_empty() {
            return f64::NEG_INFINITY;
        }
        let system = self.system;
        let joints = system.joint_count();
        let attitude = system.start_attitude();
        let mut x = [attitude, &vec![0.0; 2 * joints]].concat();
        let mut scratch = system.scratch::<f64>();
        let mut derivatives = vec![0.0; x.len()];
        let mut values = vec![0.0; system.path_rows().len()];
        // The control, and rates by the fraction of the duration: clearance depends on neither.
        let (u, mut rest) = (vec![0.0; joints], [vec![0.0; joints], vec![0.0; joints]]);
        let peaks = vec![1.0; system.formulation.parameters.len()];
        let mut deepest = f64::NEG_INFINITY;
        for k in 0..=SAMPLES {
            let [dq, ddq] = &mut rest;
            let q = &mut x[attitude.len()..][..joints];
            path.at_fraction(k as f64 / SAMPLES as f64, q, dq, ddq);
            let point = Point {
                x: &x,
                u: &u,
                t: 0.0,
                parameters: &peaks,
            };
            system.continuous(point, &mut scratch, &mut derivatives, &mut values);
            let overlaps = self.rows.iter().map(|&p| -values[p]);
            deepest = overlaps.fold(deepest, f64::max);
        }
        deepest
    }
}
