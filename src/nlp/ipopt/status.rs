//! From Ipopt's return status to a graded one.

use super::IpoptError;
use crate::nlp::{LinearSolver, Status};
use ipopt_sys as ip;

/// Ipopt 3.14 and later; the headers of 3.11 do not name it.
const MAXIMUM_WALL_TIME_EXCEEDED: ip::ApplicationReturnStatus = -5;

/// The graded status of Ipopt's `code`.
pub(super) fn grade(
    code: ip::ApplicationReturnStatus,
    linear_solver: &LinearSolver,
) -> Result<Status, IpoptError> {
    Ok(match code {
        ip::Solve_Succeeded => Status::Solved,
        ip::Solved_To_Acceptable_Level => Status::SolvedToAcceptableLevel,
        ip::Feasible_Point_Found => Status::FeasiblePointFound,
        ip::Infeasible_Problem_Detected => Status::LocallyInfeasible,
        ip::Search_Direction_Becomes_Too_Small => Status::SearchDirectionTooSmall,
        ip::Diverging_Iterates => Status::Diverging,
        ip::Restoration_Failed => Status::RestorationFailed,
        ip::Maximum_Iterations_Exceeded => Status::MaxIterations,
        ip::Maximum_CpuTime_Exceeded | MAXIMUM_WALL_TIME_EXCEEDED => Status::TimeLimit,
        ip::User_Requested_Stop => Status::Interrupted,
        ip::Invalid_Number_Detected => Status::InvalidNumber,
        ip::Not_Enough_Degrees_Of_Freedom => Status::TooFewDegreesOfFreedom,
        ip::Invalid_Option => {
            return Err(IpoptError::OptionsRefused {
                linear_solver: linear_solver.clone(),
            });
        }
        other => Status::Internal(other),
    })
}
