//! The plans played on the table with all its disturbances, many times.

use crate::config::{PlatformFile, ProblemFile};
use crate::planner::{Method, Status};
use crate::reproduction::figures::{Case, Extremes};
use crate::reproduction::{A_RPM, HEAVY, RELAXED, ReproductionError, Session};
use crate::simulate::{Figures, Player, SimulateError, Spread};
use serde::{Serialize, Serializer};

/// The platform that plans are played on.
pub const PLATFORM: &str = "air-bearing";
/// The problems that are planned.
const PROBLEMS: [&str; 2] = [RELAXED, HEAVY];

fn by_name<S: Serializer>(method: &Method, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(method.name())
}

/// One plan, and what it comes to on a platform with noise of its own in each run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Played {
    /// The shipped problem.
    pub problem: &'static str,
    /// The planner; written by its name in files.
    #[serde(serialize_with = "by_name")]
    pub method: Method,
    /// Whether the plan keeps the problem's limits and tolerance.
    pub solved: bool,
    /// The motion as planned.
    pub extremes: Extremes,
    /// Runs.
    pub runs: usize,
    /// Largest attitude (rad), final attitude (rad), final displacement along x and y (m) as motion
    /// capture has them: means over the runs.
    pub mean: [f64; 4],
    /// Their standard deviations.
    pub deviation: [f64; 4],
}

/// Plays A-RPM and MATPM, with Table I's base and with the heavier one.
///
/// # Errors
/// [`ReproductionError`] where a plan or a run fails, or it is stopped.
pub fn played(session: &mut Session<'_>) -> Result<Vec<Played>, ReproductionError> {
    let mut found = Vec::new();
    for name in PROBLEMS {
        let problem = ProblemFile::shipped(name)?.problem;
        for method in [A_RPM, Method::Matpm] {
            let title = format!("{name} by {} on {PLATFORM}", method.name());
            let failure = |cause: SimulateError| ReproductionError::Simulate {
                name: title.clone(),
                cause,
            };
            let plan = session.plan_by(method, &title, &problem)?;
            let solved = plan.status == Status::Solved;
            let platform = PlatformFile::shipped(PLATFORM, &problem.robot)?.platform;
            let player = Player::new(&problem, &plan.discretization, platform).map_err(failure)?;
            let runs = player.runs().map_err(failure)?;
            let measured: Vec<[f64; 4]> =
                runs.iter().map(|r| four(&Figures::measured(r))).collect();
            let spread = [0, 1, 2, 3].map(|i| Spread::of(measured.iter().map(|f| f[i])));
            let case = Case::new("platform", problem.clone(), plan);
            found.extend(Extremes::of(&case).map(|extremes| Played {
                problem: name,
                method,
                solved,
                extremes,
                runs: runs.len(),
                mean: spread.map(|s| s.mean),
                deviation: spread.map(|s| s.deviation),
            }));
        }
    }
    Ok(found)
}

impl Played {
    /// The commands that do the same.
    pub fn commands(&self) -> [String; 2] {
        let Self {
            problem, method, ..
        } = self;
        let (option, folder) = match *method {
            A_RPM => (String::new(), format!("out/{problem}")),
            other => {
                let method = other.name();
                let folder = format!("out/{problem}-{method}");
                (format!(" --method {method} --out {folder}"), folder)
            }
        };
        [
            format!("ffsm-ipopt plan config/{problem}.toml{option}"),
            format!("ffsm-ipopt simulate {folder}/solution.json config/platforms/{PLATFORM}.toml"),
        ]
    }
}

fn four(figures: &Figures) -> [f64; 4] {
    let [x, y] = figures.final_displacement;
    [figures.max_attitude, figures.final_attitude, x, y]
}
