//! Which derivatives of a function may be nonzero.

use super::dependence::Dependence;
use super::tape::Recording;
use super::{Function, Scalar, Trace};
use num_traits::Zero;

/// Nonzero pattern of a function's Jacobian and of its Hessians.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sparsity {
    /// Of each output, the inputs it depends on, ascending.
    pub jacobian: Vec<Vec<usize>>,
    /// Pairs (row ≥ column) of inputs by which any output has a second derivative, by rows.
    pub hessian: Vec<(usize, usize)>,
    /// Outputs with any second derivative.
    pub curved: Vec<usize>,
    /// Outputs that are not the constant zero.
    pub active: Vec<bool>,
    /// Whether the function asked for a value that varies, as it must to branch on one: with other
    /// values its derivatives may have other places.
    pub may_branch: bool,
}

impl Sparsity {
    /// Every derivative counts as nonzero, except those of the inputs where `used` is false.
    pub fn dense(outputs: usize, used: &[bool]) -> Self {
        let inputs: Vec<usize> = (0..used.len()).filter(|&i| used[i]).collect();
        let hessian = inputs
            .iter()
            .flat_map(|&i| {
                inputs
                    .iter()
                    .filter(move |&&j| j <= i)
                    .map(move |&j| (i, j))
            })
            .collect();
        Self {
            jacobian: vec![inputs; outputs],
            hessian,
            curved: (0..outputs).collect(),
            active: vec![true; outputs],
            may_branch: false,
        }
    }

    /// What may be nonzero by the operations of `f`, which one evaluation at `at` records.
    ///
    /// Inputs where `used` is false are no variables, but take other values than those in `at`.
    /// The result holds for all values of all inputs, but where `f` [may
    /// branch](Self::may_branch) on them. It may hold more than is ever nonzero: entries that cancel
    /// are not found out.
    pub fn traced<F: Function>(f: &F, used: &[bool], at: &[f64]) -> Self {
        let mut scratch = f.scratch::<Trace>();
        let mut out = vec![Trace::constant(0.0); f.outputs()];
        let recording = Recording::start();
        let inputs: Vec<Trace> = (at.iter().zip(used).enumerate())
            .map(|(i, (&value, used))| match used {
                true => Trace::variable(i, value),
                false => Trace::parameter(value),
            })
            .collect();
        f.evaluate(&inputs, &mut scratch, &mut out);
        let recorded = recording.finish();
        let outputs: Vec<Option<usize>> = out.iter().map(Trace::index).collect();
        let found = Dependence::of(&recorded.operations, &outputs, at.len());
        Self {
            jacobian: found.first,
            hessian: found.second,
            curved: found.curved,
            active: out.iter().map(|value| !value.is_zero()).collect(),
            may_branch: recorded.inspected,
        }
    }

    /// Number of nonzeros of the Jacobian.
    pub fn nonzeros(&self) -> usize {
        self.jacobian.iter().map(Vec::len).sum()
    }

    /// Inputs that any output depends on, ascending.
    pub fn columns(&self) -> Vec<usize> {
        let mut columns: Vec<usize> = self.jacobian.iter().flatten().copied().collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function of `$n` inputs as the list of its outputs.
    macro_rules! function {
        ($name:ident, $n:expr, $m:expr, |$v:ident| $outputs:expr) => {
            struct $name;
            impl Function for $name {
                type Scratch<S: Scalar> = ();
                fn inputs(&self) -> usize {
                    $n
                }
                fn outputs(&self) -> usize {
                    $m
                }
                fn scratch<S: Scalar>(&self) {}
                fn evaluate<S: Scalar>(&self, $v: &[S], _: &mut (), out: &mut [S]) {
                    let outputs: [S; $m] = $outputs;
                    out.copy_from_slice(&outputs);
                }
            }
        };
    }

    fn traced<F: Function>(f: &F, at: &[f64]) -> Sparsity {
        Sparsity::traced(f, &vec![true; at.len()], at)
    }

    function!(Mixed, 4, 5, |v| {
        let [a, b, c, d] = [v[0], v[1], v[2], v[3]];
        [
            a * 2.0 - b + 1.0,
            (a + b) * c,
            c / d,
            d.sin_cos().0 + a,
            S::constant(3.0),
        ]
    });

    #[test]
    fn sums_products_quotients_and_functions() {
        let found = traced(&Mixed, &[0.0; 4]);
        let first = [vec![0, 1], vec![0, 1, 2], vec![2, 3], vec![0, 3], vec![]];
        assert_eq!(found.jacobian, first);
        assert_eq!(found.hessian, [(2, 0), (2, 1), (3, 2), (3, 3)]);
        assert_eq!(found.curved, [1, 2, 3]);
        assert_eq!(found.active, [true; 5]);
    }

    function!(Zeros, 3, 4, |v| {
        let (none, one) = (S::zero(), S::one());
        [
            v[0] * v[1] * 0.0,
            none * v[0].exp() + v[2],
            (none / v[0]).square() * v[1] + one * one - one,
            // The product reaches no output.
            v[1] * 1.0 + v[0] * v[2] * none,
        ]
    });

    #[test]
    fn constants_are_folded_and_what_reaches_no_output_does_not_count() {
        let found = traced(&Zeros, &[1.0, 2.0, 3.0]);
        assert_eq!(found.jacobian, [vec![], vec![2], vec![], vec![1]]);
        assert_eq!((found.hessian, found.curved), (vec![], vec![]));
        assert_eq!(found.active, [false, true, false, true]);
    }

    function!(Branching, 2, 1, |v| {
        [if v[0].value() > 0.0 { v[0] } else { v[1] }]
    });
    function!(Equal, 2, 1, |v| {
        [if v[0] == v[1] { v[0] } else { v[1] }]
    });
    function!(Elementary, 2, 4, |v| {
        let constant = S::constant(2.0);
        let [a, b] = [v[0] + constant.value(), v[1]];
        [
            a.sqrt() + a.exp() * b.ln() - b.recip() / a,
            a.sin() + b.cos() + a.tan() + a.tanh(),
            b.asin() - b.acos() + b.atan() - b.atan2(a),
            a.powi(3) + a.powf(0.5) - a.max(b) + a.min(b) * a.abs(),
        ]
    });

    #[test]
    fn who_asks_for_a_value_may_branch() {
        for at in [[1.0, 0.5], [-1.0, 0.5]] {
            assert!(traced(&Branching, &at).may_branch);
            assert!(traced(&Equal, &at).may_branch);
        }
        assert!(!traced(&Elementary, &[1.0, 0.5]).may_branch);
        assert!(!Sparsity::dense(1, &[true; 2]).may_branch);
    }

    // x′ = u − 5 exp(−2(t − 15)²) of x, u, t: by its values no function of t but near the bump.
    function!(Bump, 3, 1, |v| {
        [v[1] - ((v[2] - 15.0).square() * -2.0).exp() * 5.0]
    });

    #[test]
    fn a_derivative_that_underflows_is_found() {
        let far = [0.0, 0.0, 160.0];
        assert_eq!((-2.0 * (far[2] - 15.0_f64).powi(2)).exp(), 0.0);
        let found = traced(&Bump, &far);
        assert_eq!(found.jacobian, [vec![1, 2]]);
        assert_eq!((found.hessian, found.curved), (vec![(2, 2)], vec![0]));
    }

    function!(Pitch, 2, 1, |v| [v[0].sin() * v[1].sin()]);

    #[test]
    fn the_value_of_a_variable_does_not_matter() {
        // Both at zero, where all first derivatives vanish.
        assert_eq!(traced(&Pitch, &[0.0; 2]), traced(&Pitch, &[0.7, -0.3]));
        assert_eq!(traced(&Pitch, &[0.0; 2]).jacobian, [vec![0, 1]]);
    }

    #[test]
    fn an_input_that_is_no_variable_still_varies() {
        let found = Sparsity::traced(&Pitch, &[false, true], &[0.0; 2]);
        assert_eq!(found.jacobian, [vec![1]]);
        assert_eq!((found.hessian, found.curved), (vec![(1, 1)], vec![0]));
        let none = Sparsity::traced(&Pitch, &[false; 2], &[0.0; 2]);
        assert_eq!(
            (&none.jacobian[0], &none.active[..]),
            (&vec![], &[true][..])
        );
    }

    function!(Branches, 3, 3, |v| {
        [
            Scalar::max(v[0], v[1] * v[2]),
            Scalar::min(v[0], S::zero()),
            Scalar::abs(v[1] - v[2]),
        ]
    });

    #[test]
    fn both_sides_of_a_branch_are_kept() {
        for at in [[9.0, 1.0, 2.0], [-9.0, 1.0, 2.0]] {
            let found = traced(&Branches, &at);
            assert_eq!(found.jacobian, [vec![0, 1, 2], vec![0], vec![1, 2]]);
            assert_eq!((found.hessian, found.curved), (vec![(2, 1)], vec![0]));
        }
    }

    /// Finds another pattern while its own is being found.
    struct Nested;

    impl Function for Nested {
        type Scratch<S: Scalar> = ();
        fn inputs(&self) -> usize {
            2
        }
        fn outputs(&self) -> usize {
            1
        }
        fn scratch<S: Scalar>(&self) {}
        fn evaluate<S: Scalar>(&self, v: &[S], _: &mut (), out: &mut [S]) {
            let before = v[0] * v[0];
            assert_eq!(traced(&Pitch, &[0.0; 2]).hessian.len(), 3);
            out[0] = before + v[1];
        }
    }

    #[test]
    fn one_trace_within_another() {
        let found = traced(&Nested, &[0.0; 2]);
        assert_eq!(found.jacobian, [vec![0, 1]]);
        assert_eq!(found.hessian, [(0, 0)]);
    }

    function!(Panics, 1, 1, |v| {
        assert!(v[0].value() < 0.0, "on purpose");
        [v[0]]
    });

    #[test]
    fn nothing_is_left_behind() {
        assert!(std::panic::catch_unwind(|| traced(&Panics, &[1.0])).is_err());
        let kept = {
            let _recording = Recording::start();
            Trace::variable(0, 1.0)
        };
        let late = || std::panic::catch_unwind(|| kept * kept);
        assert!(late().is_err(), "no recording");
        let _recording = Recording::start();
        assert!(late().is_err(), "another recording");
        let elsewhere = std::thread::spawn(move || kept * kept).join();
        assert!(elsewhere.is_err(), "another thread");
        assert_eq!(kept.value(), 1.0);
    }

    // More variables than one word has bits.
    function!(Wide, 130, 2, |v| [v[0] * v[129] + v[64], v[63] + v[128]]);

    #[test]
    fn many_variables() {
        let found = traced(&Wide, &[0.5; 130]);
        assert_eq!(found.jacobian, [vec![0, 64, 129], vec![63, 128]]);
        assert_eq!(found.hessian, [(129, 0)]);
    }
}
