//! The amounts by which a trajectory exceeds the limits that give way.

use super::limits::Elastic;
use crate::ocp::{Ends, InteriorPoint, Interval, Ocp, Point};

impl<O: Ocp> Elastic<'_, O> {
    /// The least amounts e_g within which a trajectory is: `points` along it and its `ends`, with the
    /// static parameters of the problem inside, and its points at the way-points. A value that is no
    /// number counts for nothing.
    pub fn needed<'p>(
        &self,
        points: impl Iterator<Item = Point<'p, f64>>,
        way_points: impl Iterator<Item = InteriorPoint<'p, f64>>,
        ends: Ends<'p, f64>,
    ) -> Vec<f64> {
        let mut needed = vec![0.0_f64; self.groups.len()];
        let mut scratch = self.inner.scratch::<f64>();
        let mut raise = |group: usize, bounds: &Interval, value: f64| {
            let amount = bounds.violation(value) / self.groups[group].scale;
            if amount.is_finite() {
                needed[group] = needed[group].max(amount);
            }
        };
        let mut rates = vec![0.0; self.base.states.len()];
        let mut path = vec![0.0; self.base.path.len()];
        for point in points {
            self.inner
                .continuous(point, &mut scratch, &mut rates, &mut path);
            for bound in &self.path {
                let value = bound.quantity.value(point.x, point.u, &path);
                raise(bound.group, &bound.bounds, value);
            }
        }
        for point in way_points {
            let w = point.way_point;
            let mut rows = vec![0.0; self.base.way_points[w].rows.len()];
            self.inner.way_point(point, &mut scratch, &mut rows);
            for bound in &self.way_points[w] {
                let value = bound.quantity.value(point.x, &rows);
                raise(bound.group, &bound.bounds, value);
            }
        }
        let mut rows = vec![0.0; self.base.boundary.len()];
        self.inner.boundary(ends, &mut scratch, &mut rows);
        for bound in &self.boundary {
            let value = bound.quantity.value(ends.terminal, &rows);
            raise(bound.group, &bound.bounds, value);
        }
        needed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::autodiff::Scalar;
    use crate::ocp::{Formulation, LimitGroup, Limited, Quantity};

    /// ẋ = u with a path row 2x.
    struct Line;

    impl Ocp for Line {
        type Scratch<S: Scalar> = ();

        fn formulation(&self) -> Formulation {
            let within = |name: &str, most: f64| Quantity::new(name, Interval::symmetric(most));
            Formulation::over(Interval::fixed(1.0))
                .state(within("x", 1.0), Interval::fixed(0.0), Interval::FREE)
                .control(within("u", 2.0))
                .path_row(within("twice", 3.0))
        }

        fn scratch<S: Scalar>(&self) {}

        fn continuous<S: Scalar>(
            &self,
            point: Point<'_, S>,
            (): &mut (),
            rates: &mut [S],
            path: &mut [S],
        ) -> S {
            rates[0] = point.u[0];
            path[0] = point.x[0] + point.x[0];
            S::zero()
        }

        fn boundary<S: Scalar>(&self, _: Ends<'_, S>, (): &mut (), _: &mut [S]) -> S {
            S::zero()
        }
    }

    #[test]
    fn amounts_are_the_largest_excess_in_units_of_the_scale() {
        let group = |member, scale| LimitGroup {
            name: "limit".into(),
            members: vec![member],
            scale,
        };
        let groups = vec![
            group(Limited::State(0), 0.5),
            group(Limited::Control(0), 1.0),
            group(Limited::Path(0), 4.0),
        ];
        let elastic = Elastic::new(&Line, groups, 1e-3);
        let point = |x, u| Point {
            x,
            u,
            parameters: &[],
            t: 0.0,
        };
        let points = [
            point(&[-2.0], &[1.0]),
            point(&[1.5], &[f64::NAN]),
            point(&[0.0], &[-1.5]),
        ];
        let ends = Ends {
            initial: &[0.0],
            terminal: &[-3.0],
            parameters: &[],
            integrals: &[],
            initial_time: 0.0,
            duration: 1.0,
        };
        let needed = elastic.needed(points.into_iter(), std::iter::empty(), ends);
        // The state is bounded at t_f as well: 2 beyond; 2x exceeds 3 by 1 at −2.
        assert_eq!(needed, [4.0, 0.0, 0.25]);

        // Tighter by a tenth of each scale, so that as much more is needed.
        let tighter = elastic.tightened(0.1);
        let at_rest = Ends {
            terminal: &[0.0],
            ..ends
        };
        let needed = tighter.needed(
            [point(&[1.0], &[2.0])].into_iter(),
            std::iter::empty(),
            at_rest,
        );
        assert!((needed[0] - 0.1).abs() < 1e-12 && (needed[1] - 0.1).abs() < 1e-12);
        assert_eq!(needed[2], 0.0);
    }
}
