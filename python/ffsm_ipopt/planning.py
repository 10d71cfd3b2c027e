"""From problems to plans."""

import json
import operator
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Optional, Tuple, Union

from . import _native
from .problem import Path, Problem, _text
from .solution import Solution, Verification, _numbers
from .trajectory import Trajectory

_Start = Union[Solution, Path]
#: Starts of a search, as the command has them.
_STARTS = 32


class Progress(NamedTuple):
    """A step of planning."""

    #: "mesh" begins, an "iteration" of the solver, a mesh is "solved", a start of the "search", a start of
    #: "diagnosing", a "step" of a planner that works along the motion.
    stage: str
    #: Which mesh, iteration, start or step, from 1; of "solved" the number of iterations.
    number: Optional[int]
    #: How many there are, where that is known.
    of: Optional[int]
    #: Collocation points of the mesh.
    points: Optional[int]
    #: J so far.
    objective: Optional[float]
    #: Largest error (28) on the mesh.
    max_error: Optional[float]


class Figures(NamedTuple):
    """Figures of one of many plans, SI units and radians; those of :class:`Metrics` and more."""

    objective: float
    max_error: float
    points: int
    segments: int
    mesh_iterations: int
    nlp_iterations: int
    max_base_attitude: float
    final_base_attitude: float
    max_base_displacement: float
    final_base_displacement: float
    peak_joint_velocity: float
    peak_joint_torque: float
    #: Largest distance from a goal of the end effector, m, and largest angle, rad.
    goal_distance: Optional[float]
    goal_angle: Optional[float]
    #: By how much the re-integrated motion leaves the plan: attitude, rad; position, m; joint, rad or m.
    verification_attitude: Optional[float]
    verification_position: Optional[float]
    verification_joint: Optional[float]


class Record(NamedTuple):
    """What became of one of many problems."""

    #: Its position among the problems, from 0.
    position: int
    #: Name of the problem.
    name: str
    #: "solved", "infeasible", "not_converged", "timed_out", "malformed", "panicked" or "failed".
    status: str
    #: Why it ended so; empty where it is solved.
    reason: str
    #: Wall time, s.
    seconds: float
    #: Figures of the plan, where there is one.
    figures: Optional[Figures]
    #: The planned motion at its nodes, where it was asked for.
    trajectory: Optional[Trajectory]

    def row(self) -> Dict[str, Any]:
        """All but the motion in one mapping, as a row of a table."""
        row = {name: getattr(self, name) for name in ("position", "name", "status", "reason", "seconds")}
        figures = self.figures._asdict() if self.figures else dict.fromkeys(Figures._fields)
        return {**row, **figures}


def plan(
    problem: Problem,
    *,
    start: Optional[_Start] = None,
    search: Union[bool, int] = False,
    seed: int = 1,
    method: Optional[str] = None,
    verify: bool = True,
    on_progress: Optional[Callable[[Progress], object]] = None,
) -> Solution:
    """Plans a problem. The lock of the interpreter is released; Ctrl-C ends it after an iteration.

    Args:
        problem: the problem.
        start: a solution, or the path of one, to begin at; else the straight joint path.
        search: number of starts to plan from, of which the best is kept; True for 32.
        seed: what the random numbers of the search begin with.
        method: one of :data:`METHODS`, instead of the problem's.
        verify: whether the plan is integrated again with the full dynamics: one that this does not
            confirm is "not_converged".
        on_progress: called with every step; what it raises ends the plan and is raised here.

    Returns:
        The plan, whatever its status.

    Raises:
        ProblemError: the method is not made for the problem.
        PlanError: the solver refuses it.
        SolutionError: the start is no solution, or belongs to another robot.
        KeyboardInterrupt: it was ended by Ctrl-C.
    """
    starts = _STARTS if search is True else _whole("search", search, 0)

    def told(values: Tuple[Any, ...]) -> None:
        if on_progress is not None:
            on_progress(Progress(*values))

    found = _native.plan(
        _native_of(problem),
        _start(start),
        (starts, seed) if starts else None,
        method,
        verify,
        None if on_progress is None else told,
    )
    return Solution._of(found)


def plan_many(
    problems: Iterable[Problem],
    *,
    jobs: Optional[int] = None,
    start: Optional[_Start] = None,
    trajectories: bool = False,
    on_record: Optional[Callable[[Record], object]] = None,
) -> List[Record]:
    """Plans problems side by side, each as if it were alone; one that fails, fails alone.

    Every plan is that of :func:`plan` by the problem's own method, bit for bit, and verified. The lock of
    the interpreter is released; Ctrl-C ends all of them.

    Args:
        problems: the problems.
        jobs: plans at a time; one a processor unless given.
        start: a solution, or the path of one, that all of them begin at.
        trajectories: whether the records have the motions.
        on_record: called with each record as its plan ends, in no order; what it raises ends the rest.

    Returns:
        A record a problem, in their order.
    """
    records: List[Record] = []

    def told(
        position: int,
        name: str,
        status: str,
        reason: str,
        seconds: float,
        figures: Optional[Dict[str, Any]],
        motion: Optional[Tuple[Any, ...]],
    ) -> None:
        record = Record(
            position,
            name,
            status,
            reason,
            seconds,
            None if figures is None else Figures(**figures),
            None if motion is None else Trajectory(*motion),
        )
        records.append(record)
        if on_record is not None:
            on_record(record)

    natives = [_native_of(problem) for problem in problems]
    if jobs is not None:
        jobs = _whole("jobs", jobs, 1)
    _native.plan_many(natives, jobs, _start(start), trajectories, told)
    records.sort(key=lambda record: record.position)
    return records


def check(problem: "Union[Problem, Path]") -> str:
    """What a problem, or a problem file, was understood to say, a line each; plans nothing.

    Raises:
        ProblemError: what is wrong with the file.
    """
    if not isinstance(problem, Problem):
        problem = Problem.from_toml(problem)
    return problem._inner.understood()


class Judgement(NamedTuple):
    """What :func:`verify` finds."""

    #: Whether nothing speaks against the plan.
    confirmed: bool
    #: What does.
    doubt: Optional[str]
    #: Drifts, momentum and energy; None where the integration failed.
    verification: Optional[Verification]


def verify(solution: "Union[Solution, Path]") -> Judgement:
    """Integrates a plan, or a saved one, again with the full dynamics, and holds it against its task.

    Raises:
        SolutionError: the file is no solution.
    """
    if not isinstance(solution, Solution):
        solution = Solution.load(solution)
    found = json.loads(solution._inner.verify())
    figures = found["verification"]
    return Judgement(
        found["confirmed"],
        found["doubt"],
        None if figures is None else Verification(**_numbers(figures)),
    )


def _native_of(problem: Problem) -> _native.Problem:
    if not isinstance(problem, Problem):
        raise TypeError(f"problem: {problem!r}; expected a Problem, as Problem.from_toml makes one")
    return problem._inner


def _whole(name: str, value: Any, least: int) -> int:
    """``value`` as a whole number of at least ``least``."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: {value!r}; expected a whole number from {least}") from None
    if number < least:
        raise ValueError(f"{name}: {number}; expected a whole number from {least}")
    return number


def _start(start: Optional[_Start]) -> Optional[_native.Solution]:
    if start is None:
        return None
    if not isinstance(start, Solution):
        start = Solution.load(_text(start))
    return start._inner
