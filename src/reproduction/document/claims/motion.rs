//! Section IV.A: the bounds, and the motion of figure 2.

use super::{Claim, Findings, Verdict, close, degrees, optional};
use crate::reproduction::figures::Extremes;
use crate::reproduction::{A_RPM, HEAVY};

/// The published bounds on the base attitude.
pub(super) fn feasible(found: &Findings) -> Claim {
    let bounds = &found.bounds;
    let platform = &found.platform;
    let heavier = match platform.plan(HEAVY, A_RPM) {
        Some(played) if played.solved => format!(
            "; with a base of {} kg m² instead of 0.1454 it holds",
            platform.heavier
        ),
        _ => String::new(),
    };
    Claim {
        claim: "IV.A: the task can be done with the base within ±π/12 along the path and at t_f",
        published: "15°",
        ours: format!(
            "{} at least (dynamic programming); {} found to work",
            degrees(bounds.smallest_bound_proven),
            optional(bounds.smallest_bound_by_diagnosis)
        ),
        verdict: Verdict::whether(bounds.smallest_bound_proven <= bounds.published_bound),
        why: format!("momentum conservation with Table I, see below{heavier}"),
        check: &[
            "ffsm-ipopt plan config/table1.toml",
            "ffsm-ipopt reproduce bounds",
            "ffsm-ipopt plan config/table1-heavy-base.toml",
        ],
    }
}

/// Figure 2.
pub(super) fn motion(found: &Findings) -> Vec<Claim> {
    let plans = &found.plans;
    let [Some(relaxed), Some(smooth), Some(bounded), Some(heavy)] = [
        Extremes::of(&plans.cases[0]),
        Extremes::of(&plans.cases[1]),
        Extremes::of(&found.bounded),
        Extremes::of(&plans.heavy),
    ] else {
        return Vec::new();
    };
    let yes = |is: bool| if is { "yes" } else { "no" };
    let near = |case: &Extremes| {
        let [x, y] = case.largest_displacement;
        close(x, 8.5) && close(y, 7.0)
    };
    let only_bounded = |holds: &dyn Fn(&Extremes) -> bool| {
        if holds(&relaxed) && holds(&smooth) {
            Verdict::Holds
        } else if holds(&bounded) || holds(&heavy) {
            Verdict::Partly
        } else {
            Verdict::Fails
        }
    };
    let displacement = |case: &Extremes| {
        let [x, y] = case.largest_displacement;
        format!("{x:.2} and {y:.2} cm")
    };
    vec![
        Claim {
            claim: "Fig. 2(a): largest offset of the base attitude",
            published: "around 0.35 deg",
            ours: format!(
                "relaxed {}, smooth {}, bounded {}, heavy-base {}",
                degrees(relaxed.largest_attitude),
                degrees(smooth.largest_attitude),
                degrees(bounded.largest_attitude),
                degrees(heavy.largest_attitude)
            ),
            verdict: Verdict::of(
                close(relaxed.largest_attitude, 0.35),
                close(smooth.largest_attitude, 0.35),
            ),
            why: format!(
                "no motion with Table I ends nearer than {} (dynamic programming); 0.35 rad would be \
                 {}",
                degrees(found.bounds.nearest_final_proven),
                degrees(0.35_f64.to_degrees())
            ),
            check: &["ffsm-ipopt figures", "ffsm-ipopt reproduce bounds"],
        },
        Claim {
            claim: "Fig. 2(a): θ_b decreases again after a large deviation",
            published: "yes",
            ours: format!(
                "relaxed {}, smooth {}, bounded {}, heavy-base {}; where η(t_f) alone is the cost it \
                 passes through {} to end at {}",
                yes(relaxed.returns),
                yes(smooth.returns),
                yes(bounded.returns),
                yes(heavy.returns),
                optional(found.bounds.largest_on_the_way),
                optional(found.bounds.nearest_final_by_control)
            ),
            verdict: only_bounded(&|case| case.returns),
            why: "with the published weights the cost of moving the joints outweighs the attitude; a \
                  bound on it makes the base swing"
                .into(),
            check: &["ffsm-ipopt figures", "ffsm-ipopt reproduce bounds"],
        },
        Claim {
            claim: "Fig. 2(b): the joints first turn in the opposite direction",
            published: "yes",
            ours: format!(
                "relaxed {}, smooth {}, bounded {}, heavy-base {}",
                yes(relaxed.opposite),
                yes(smooth.opposite),
                yes(bounded.opposite),
                yes(heavy.opposite)
            ),
            verdict: only_bounded(&|case| case.opposite),
            why: "only a motion that is made to turn the base less needs the detour".into(),
            check: &["ffsm-ipopt figures"],
        },
        Claim {
            claim: "Fig. 2(c): largest base displacement, x and y",
            published: "8.5 cm, 7.0 cm",
            ours: format!(
                "relaxed {}, bounded {}, heavy-base {}",
                displacement(&relaxed),
                displacement(&bounded),
                displacement(&heavy)
            ),
            verdict: Verdict::of(near(&relaxed), near(&smooth)),
            why: "the base position follows from joints and attitude alone (Remark 1)".into(),
            check: &["ffsm-ipopt figures"],
        },
    ]
}
