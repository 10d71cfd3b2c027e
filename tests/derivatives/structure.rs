//! Derivatives by structure against sweeps.

use crate::allocations;
use crate::checks::groups;
use crate::problem_kinds::*;
use crate::problems;
use crate::trees;
use ffsm_ipopt::autodiff::Scalar;
use ffsm_ipopt::collocation::Mesh;
use ffsm_ipopt::nalgebra::Vector3;
use ffsm_ipopt::nlp::Nlp;
use ffsm_ipopt::ocp::{Elastic, Ends, Formulation, InteriorPoint, Interval, Ocp, Point};
use ffsm_ipopt::problem::{KeepOut, Problem, Solid};
use ffsm_ipopt::system::FreeFloating;
use ffsm_ipopt::transcription::{Patterns, Transcription};

/// A problem without derivatives of its own, so that dual numbers are swept over all of it.
struct Swept<'a, O>(&'a O);

impl<O: Ocp> Ocp for Swept<'_, O> {
    type Scratch<S: Scalar> = O::Scratch<S>;

    fn formulation(&self) -> Formulation {
        self.0.formulation()
    }

    fn scratch<S: Scalar>(&self) -> Self::Scratch<S> {
        self.0.scratch()
    }

    fn continuous<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rates: &mut [S],
        path: &mut [S],
    ) -> S {
        self.0.continuous(point, scratch, rates, path)
    }

    fn integrands<S: Scalar>(
        &self,
        point: Point<'_, S>,
        scratch: &mut Self::Scratch<S>,
        integrands: &mut [S],
    ) {
        self.0.integrands(point, scratch, integrands);
    }

    fn boundary<S: Scalar>(
        &self,
        ends: Ends<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) -> S {
        self.0.boundary(ends, scratch, rows)
    }

    fn way_point<S: Scalar>(
        &self,
        point: InteriorPoint<'_, S>,
        scratch: &mut Self::Scratch<S>,
        rows: &mut [S],
    ) {
        self.0.way_point(point, scratch, rows);
    }
}

/// Jacobian and Hessian of one programme by structure and by sweeps, to 1e-12 of the largest; a
/// second evaluation by structure allocates nothing.
fn compare<O: Ocp>(ocp: &O, mesh: Mesh) {
    assert!(ocp.derivatives().is_some(), "derivatives of its own");
    let patterns = Patterns::detect(ocp);
    let swept = Swept(ocp);
    let mut by_structure = Transcription::new(ocp, &patterns, mesh.clone());
    let mut by_sweeps = Transcription::new(&swept, &patterns, mesh);
    let size = by_structure.size();
    let mut random = fastrand::Rng::with_seed(3);
    let mut draw =
        |count: usize| -> Vec<f64> { (0..count).map(|_| 2.0 * random.f64() - 1.0).collect() };
    let lambda = draw(size.constraints);
    let [mut jacobian, mut expected] = [(); 2].map(|()| vec![0.0; size.jacobian_nonzeros]);
    let [mut hessian, mut expected_hessian] = [(); 2].map(|()| vec![0.0; size.hessian_nonzeros]);
    for round in 0..3 {
        let x = draw(size.variables);
        let before = allocations::so_far();
        by_structure.new_point();
        by_structure.objective(&x).unwrap();
        by_structure.jacobian(&x, &mut jacobian).unwrap();
        by_structure
            .hessian(&x, 0.8, &lambda, &mut hessian)
            .unwrap();
        assert!(round == 0 || allocations::so_far() == before, "allocates");
        by_sweeps.new_point();
        by_sweeps.jacobian(&x, &mut expected).unwrap();
        by_sweeps
            .hessian(&x, 0.8, &lambda, &mut expected_hessian)
            .unwrap();
        for (found, expected) in [(&jacobian, &expected), (&hessian, &expected_hessian)] {
            let scale = expected.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
                assert!(
                    (found - expected).abs() <= 1e-12 * scale,
                    "nonzero {k}: {found:e} instead of {expected:e}, of {scale:e}"
                );
            }
        }
    }
}

/// Every weight, limit and coupling at once, for robots of all kinds.
#[test]
fn structure_and_sweeps_agree() {
    let rng = &mut fastrand::Rng::with_seed(23);
    let mut robots = trees::zoo(9);
    robots.push(problems::two_link());
    robots.push(trees::planar(rng, Vector3::new(0.3, -0.5, 0.8)));
    robots.push(trees::chain(10, 2));
    for robot in robots {
        let mut problem = loaded(robot).into_builder();
        let n = problem.robot.joint_count();
        let (angles, _) = Problem::base_sizes(&problem.robot);
        problem.limits.torque = vec![Interval::symmetric(3.0); n];
        problem.cost.torque = trees::values(rng, n, 0.2);
        problem.cost.torque.iter_mut().for_each(|w| *w = w.abs());
        let rates = angles + n;
        let half: Vec<Vec<f64>> = (0..rates)
            .map(|_| (0..rates).map(|_| 0.05 * trees::uniform(rng)).collect())
            .collect();
        let element = |i: usize, j: usize| match i == j {
            true => rates as f64,
            false => half[i][j] + half[j][i],
        };
        let row = |i: usize| (0..rates).map(|j| element(i, j)).collect();
        problem.cost.rate_matrix = Some((0..rates).map(row).collect());
        let center = [0.3, 0.1, -0.2];
        let apart = |second| KeepOut {
            name: "apart".into(),
            first: Solid::sphere(Some(n - 1), center, 0.1),
            second,
        };
        problem.limits.keep_out = vec![
            apart(Solid::sphere(None, center, 0.1)),
            apart(Solid::cuboid(Some(0), [0.1, -0.2, 0.3], [0.3, 0.2, 0.4])),
        ];
        let mesh = || Mesh::uniform(1, 2).unwrap();
        for tumbling in [0.0, 0.3] {
            problem.task.initial_momentum.angular = vec![tumbling; angles];
            let problem = problem.clone().build().unwrap();
            match FreeFloating::planar(&problem) {
                Some(system) => {
                    compare(&system, mesh());
                    compare(&Elastic::new(&system, groups(&system), 1e-3), mesh());
                }
                None => {
                    let system = FreeFloating::spatial(&problem);
                    compare(&system, mesh());
                    compare(&Elastic::new(&system, groups(&system), 1e-3), mesh());
                }
            }
        }
    }
}
