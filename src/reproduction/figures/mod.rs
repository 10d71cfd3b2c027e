//! Figures 2 to 6 of the paper, from this code's own runs.
//!
//! The published case has no solution. Figures are drawn for the relaxed and the smooth case,
//! some also for the *bounded* one: as published, but with its bounds on the base attitude widened to
//! where a motion exists, and for a base that turns harder. Titles say which.

mod comparison;
mod errors;
mod extremes;
mod sampler;
mod sequence;
mod states;

pub use comparison::comparison;
pub use errors::{errors, worst};
pub use extremes::Extremes;
pub use sampler::{Sample, Sampler};
pub use sequence::sequence;
pub use states::states;

use super::{CASES, HEAVY, ReproductionError, Session};
use crate::config::ProblemFile;
use crate::planner::{Method, Plan};
use crate::plot::Figure;
use crate::problem::Problem;
use crate::refine::Record;
use crate::transcription::Discretization;

/// A problem, its plan, and what a title calls it.
#[derive(Debug, Clone)]
pub struct Case {
    /// "relaxed", "smooth", "bounded", "heavy-base"; also part of file names.
    pub name: &'static str,
    /// The problem.
    pub problem: Problem,
    /// The motion: states [η, θ, θ̇].
    pub trajectory: Discretization,
    /// One record a mesh iteration; none where nothing was optimised.
    pub iterations: Vec<Record>,
}

impl Case {
    /// A plan for `problem`.
    pub fn new(name: &'static str, problem: Problem, plan: Plan) -> Self {
        Self {
            name,
            problem,
            trajectory: plan.discretization,
            iterations: plan.iterations,
        }
    }
}

/// The plans that the figures show.
#[derive(Debug, Clone)]
pub struct Plans {
    /// A-RPM on the relaxed and on the smooth case.
    pub cases: Vec<Case>,
    /// A-RPM on the published case with a base that turns harder.
    pub heavy: Case,
    /// MATPM on the relaxed case.
    pub matpm: Case,
    /// MATPM with a base that turns harder.
    pub heavy_matpm: Case,
}

impl Plans {
    /// Plans them.
    ///
    /// # Errors
    /// Those of [`Session::plan`].
    pub fn make(session: &mut Session<'_>) -> Result<Self, ReproductionError> {
        let mut cases = Vec::new();
        for (file, _) in CASES {
            let problem = ProblemFile::shipped(file)?.problem;
            let plan = session.plan(file, &problem, None)?.plan;
            cases.push(Case::new(file.trim_start_matches("table1-"), problem, plan));
        }
        let problem = cases[0].problem.clone();
        let plan = session.plan_by(Method::Matpm, "matpm", &problem)?;
        let matpm = Case::new("matpm", problem, plan);
        let problem = ProblemFile::shipped(HEAVY)?.problem;
        let plan = session.plan(HEAVY, &problem, None)?.plan;
        let heavy = Case::new("heavy-base", problem.clone(), plan);
        let plan = session.plan_by(Method::Matpm, "matpm", &problem)?;
        let heavy_matpm = Case::new("matpm", problem, plan);
        Ok(Self {
            cases,
            heavy,
            matpm,
            heavy_matpm,
        })
    }
}

/// A figure with its file name and its caption.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// File name without an ending.
    pub name: String,
    /// What it shows, and which case.
    pub caption: String,
    /// The figure.
    pub figure: Figure,
}

/// All figures, in the paper's order.
pub fn all(plans: &Plans, bounded: &Case) -> Vec<Drawn> {
    let mut drawn = Vec::new();
    let published = &plans.cases[0].problem;
    let described = |case: &Case| described(case, published);
    let mut add = |name: String, caption: String, figure: Option<Figure>| {
        drawn.extend(figure.map(|figure| Drawn {
            name,
            caption,
            figure,
        }));
    };
    for case in plans.cases.iter().chain([bounded, &plans.heavy]) {
        add(
            format!("figure2-{}", case.name),
            format!(
                "Figure 2, {}: (a) base attitude and joint angles, (b) angular velocities, \
                 (c) base displacement. Grey lines are the boundaries of the segments. {}",
                described(case),
                Extremes::of(case).map_or_else(String::new, |found| found.describe())
            ),
            states(case),
        );
    }
    for case in &plans.cases {
        let (error, at) = worst(&case.iterations[0], case.trajectory.duration);
        add(
            format!("figure3-{}", case.name),
            format!(
                "Figure 3, {}: largest error (28) of every state in every segment at each mesh \
                 iteration, all segments drawn equally wide. In the first iteration it is \
                 {error:.3e}, in the segment around t = {at:.0} s.",
                described(case)
            ),
            Some(errors(case)),
        );
    }
    let relaxed = &plans.cases[0];
    for (name, case) in [("figure4", relaxed), ("figure4-bounded", bounded)] {
        add(
            name.into(),
            format!(
                "Figure 4: motion sequence under A-RPM, {}, to scale. The dashed outline is the \
                 base at the start.",
                described(case)
            ),
            sequence(case, "A-RPM"),
        );
    }
    add(
        "figure5".into(),
        "Figure 5: motion sequence under MATPM, to scale. The dashed outline is the base at the \
         start."
            .into(),
        sequence(&plans.matpm, "MATPM"),
    );
    let compared = [
        ("A-RPM, relaxed", relaxed),
        ("A-RPM, bounded", bounded),
        ("MATPM", &plans.matpm),
    ];
    add(
        "figure6".into(),
        "Figure 6: (a) attitude and (b) displacement of the base, (c) joint angles, as planned. \
         Marks are the published measurements: largest and final attitude, final displacement in \
         x and y."
            .into(),
        comparison(&compared),
    );
    let compared = [
        ("A-RPM, heavy-base", &plans.heavy),
        ("MATPM, heavy-base", &plans.heavy_matpm),
    ];
    add(
        "figure6-heavy-base".into(),
        format!("Figure 6, {}: as above.", described(&plans.heavy)),
        comparison(&compared),
    );
    drawn
}

/// The case in a caption, with what differs from the `published` one.
fn described(case: &Case, published: &Problem) -> String {
    let spin = |problem: &Problem| problem.robot.base().inertia.rotational()[(2, 2)];
    let own = spin(&case.problem);
    if own != spin(published) {
        return format!(
            "{} case (as published, but with a base of {own} kg m²)",
            case.name
        );
    }
    let bound = case.problem.limits.base_attitude.first();
    match bound.filter(|bound| !bound.is_free()) {
        Some(bound) => format!(
            "{} case (as published, but with the base within ±{:.0}°)",
            case.name,
            bound.upper.to_degrees()
        ),
        None => format!("{} case", case.name),
    }
}
