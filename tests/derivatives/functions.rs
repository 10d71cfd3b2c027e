//! Elementary functions and mixed arithmetic of every number type, against `num-dual`.

use ffsm_ipopt::autodiff::{Dual, Function, HyperDual, Real, Scalar, Sparsity};
use num_dual::{DualNum, HyperDual64};

/// Values, first derivatives in two directions and the second across them.
type Expected = fn(HyperDual64, HyperDual64) -> HyperDual64;

/// A function of two numbers, generic and by `num-dual`.
macro_rules! cases {
    ($($name:ident: |$a:ident, $b:ident| $ours:expr, $theirs:expr;)*) => {
        $(
            struct $name;
            impl Function for $name {
                type Scratch<S: Scalar> = ();
                fn inputs(&self) -> usize {
                    2
                }
                fn outputs(&self) -> usize {
                    1
                }
                fn scratch<S: Scalar>(&self) {}
                fn evaluate<S: Scalar>(&self, v: &[S], _: &mut (), out: &mut [S]) {
                    let ($a, $b) = (v[0], v[1]);
                    let _ = ($a, $b);
                    out[0] = $ours;
                }
            }
        )*

        #[test]
        fn functions_agree_with_num_dual() {
            $(
                let theirs: Expected = |$a, $b| {
                    let _ = ($a, $b);
                    $theirs
                };
                compare(stringify!($name), &$name, theirs);
            )*
        }
    };
}

cases! {
    Powi: |a, b| a.powi(3) + b.powi(-2), a.powi(3) + b.powi(-2);
    PowiLow: |a, b| a.powi(0) + b.powi(1) + a.powi(2), b + a.powi(2) + 1.0;
    Powf: |a, b| (a * b).square().powf(1.7), (a * b).powi(2).powf(1.7);
    Tangent: |a, b| (a * b).tan(), (a * b).tan();
    ArcSine: |a, b| (a * b).asin() * a, (a * b).asin() * a;
    ArcCosine: |a, b| (a * b).acos() * a, (a * b).acos() * a;
    ArcTangent: |a, b| (a * b).atan() * a, (a * b).atan() * a;
    Angle: |a, b| a.atan2(b), a.atan2(b);
    HyperbolicTangent: |a, b| (a * b).tanh() * a, (a * b).tanh() * a;
    Left: |a, b| Real(2.0) - a / 3.0 + Real(4.0) / b * (Real(1.5) + Real(0.5) * a),
        -a / 3.0 + 2.0 + b.recip() * 4.0 * (a * 0.5 + 1.5);
    Assigned: |a, b| {
        let mut x = a;
        x += 2.0;
        x *= 3.0;
        x -= 1.0;
        x /= 7.0;
        x /= b;
        x
    }, ((a + 2.0) * 3.0 - 1.0) / 7.0 / b;
}

fn compare<F: Function>(name: &str, f: &F, theirs: Expected) {
    for at in [[0.4, 0.9], [-0.4, 0.9], [0.7, -0.3], [-0.6, -0.8]] {
        let [a, b] = at;
        let one = |re, eps1, eps2| HyperDual64::new(re, eps1, eps2, 0.0);
        // Mixed second derivative, and the pure ones by the same seed twice.
        let mixed = theirs(one(a, 1.0, 0.0), one(b, 0.0, 1.0));
        let pure = [
            theirs(one(a, 1.0, 1.0), one(b, 0.0, 0.0)).eps1eps2,
            theirs(one(a, 0.0, 0.0), one(b, 1.0, 1.0)).eps1eps2,
        ];
        let near = |found: f64, expected: f64, what: &str| {
            assert!(
                (found - expected).abs() <= 1e-12 * (1.0 + expected.abs()),
                "{name} at {at:?}, {what}: {found} instead of {expected}"
            );
        };
        near(run(f, at)[0], mixed.re, "value");
        let dual = run(f, [Dual::<2>::seeded(a, 0), Dual::seeded(b, 1)])[0];
        near(dual.value, mixed.re, "value of a dual number");
        near(dual.gradient[0], mixed.eps1, "first derivative");
        near(dual.gradient[1], mixed.eps2, "second first derivative");
        // In wide vectors, rounded once.
        let wide = run(f, [Dual::<8, true>::seeded(a, 3), Dual::seeded(b, 6)])[0];
        near(wide.gradient[3], mixed.eps1, "wide first derivative");
        near(wide.gradient[6], mixed.eps2, "wide second first derivative");
        let seeded = |value, i| HyperDual::<2, 2>::seeded(value, Some(i), Some(i));
        let hyper = run(f, [seeded(a, 0), seeded(b, 1)])[0];
        near(hyper.value, mixed.re, "value of a hyper-dual number");
        near(hyper.rows[0], mixed.eps1, "derivative by a row");
        near(hyper.columns[1], mixed.eps2, "derivative by a column");
        near(hyper.block[0][1], mixed.eps1eps2, "mixed derivative");
        near(hyper.block[0][0], pure[0], "curvature by the first");
        near(hyper.block[1][1], pure[1], "curvature by the second");
        // Every nonzero has its place.
        let pattern = Sparsity::traced(f, &[true; 2], &at);
        for (i, first) in [mixed.eps1, mixed.eps2].into_iter().enumerate() {
            assert!(first == 0.0 || pattern.jacobian[0].contains(&i), "{name}");
        }
        let second = [
            ((0, 0), pure[0]),
            ((1, 0), mixed.eps1eps2),
            ((1, 1), pure[1]),
        ];
        for (pair, value) in second {
            assert!(value == 0.0 || pattern.hessian.contains(&pair), "{name}");
        }
    }
}

fn run<F: Function, S: Scalar>(f: &F, v: [S; 2]) -> [S; 1] {
    let mut out = [S::zero()];
    f.evaluate(&v, &mut f.scratch(), &mut out);
    out
}

#[test]
fn a_plain_number_stands_on_both_sides_where_the_type_is_known() {
    let x = Dual::<1>::seeded(2.0, 0);
    let y = 3.0 / x + 2.0 * x - (1.0 - x) + (5.0 + x) / 2.0;
    assert_eq!(y.value, 1.5 + 4.0 + 1.0 + 3.5);
    assert_eq!(y.gradient, [-0.75 + 2.0 + 1.0 + 0.5]);
}

#[test]
fn powers_at_zero_are_numbers() {
    let zero = HyperDual::<1, 1>::seeded(0.0, Some(0), Some(0));
    for (power, [value, first, second]) in [
        (0, [1.0, 0.0, 0.0]),
        (1, [0.0, 1.0, 0.0]),
        (2, [0.0, 0.0, 2.0]),
        (3, [0.0, 0.0, 0.0]),
    ] {
        for found in [zero.powi(power), zero.powf(f64::from(power))] {
            let found = (found.value, found.rows[0], found.block[0][0]);
            assert_eq!(found, (value, first, second), "{power}");
        }
    }
}
