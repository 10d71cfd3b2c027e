"""What planning came to."""

import json
from typing import TYPE_CHECKING, Any, Dict, NamedTuple, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _native
from .problem import Path, Problem, _text
from .trajectory import Array, Trajectory

if TYPE_CHECKING:
    import pandas

#: Lower and upper bound; None where there is none.
Bound = Tuple[Optional[float], Optional[float]]


class Metrics(NamedTuple):
    """Figures a person asks for first."""

    #: Largest base angle along the path, rad, and that at t_f.
    max_base_attitude: float
    final_base_attitude: float
    #: Largest distance of the base from where it started, m, and that at t_f.
    max_base_displacement: float
    final_base_displacement: float
    #: Largest joint rate, rad/s or m/s.
    peak_joint_velocity: float
    #: Largest joint torque, N·m or N.
    peak_joint_torque: float


class Iteration(NamedTuple):
    """One mesh iteration."""

    #: Collocation points and segments.
    points: int
    segments: int
    #: Largest error (28), and the largest relative error of the states by quadrature.
    max_error: float
    quadrature_error: float
    #: Largest part of its size by which a bound is exceeded between the nodes.
    max_violation: float
    #: Objective (25).
    objective: float
    #: J without the error of the mesh, less ``objective``: to first order, by the multipliers.
    objective_error: float
    #: Iterations of the solver and how it ended.
    nlp_iterations: int
    nlp_status: str
    #: Wall time, s.
    seconds: float


class CostTerm(NamedTuple):
    """A term of the cost, with its weight."""

    key: str
    formula: str
    value: float


class Goal(NamedTuple):
    """A goal for the end effector and how near it is met."""

    key: str
    #: When, s.
    t: float
    #: Distance, m, and angle, rad; None where none was asked for.
    distance: Optional[float]
    angle: Optional[float]


class LimitFinding(NamedTuple):
    """One limit that cannot hold."""

    key: str
    component: str
    bound: Bound
    unit: str
    #: How much it must give way at least.
    excess: float
    #: The smallest bound that was found to work.
    smallest_bound: Bound
    #: The bound below which none can work, where one is known.
    floor: Optional[float] = None


class Diagnosis(NamedTuple):
    """Why a problem is infeasible."""

    summary: str
    limits: Tuple[LimitFinding, ...]
    starts: int
    feasible_starts: int


class Timing(NamedTuple):
    """Where the time went, s."""

    setup: float
    derivatives: float
    linear_solver: float
    ipopt_other: float
    total: float


class Verification(NamedTuple):
    """Largest differences between a plan and its independent re-integration."""

    #: Base attitude, rad; base position, m; joints, rad or m.
    max_base_attitude_drift: float
    max_base_position_drift: float
    max_joint_drift: float
    #: The same of the base where the joints follow the planned path.
    replay_base_attitude_drift: float
    replay_base_position_drift: float
    #: Largest departure of the momentum: linear, kg m/s; angular, kg m²/s.
    max_linear_momentum: float
    max_angular_momentum: float
    #: Largest gap between kinetic energy and the joints' work, J.
    max_energy_gap: float
    #: Steps of the integrator.
    steps: int


class Solution:
    """A plan with the problem it is for; cannot be changed.

    Complete whatever the status, so that the best motion is kept. Arrays at the N nodes of the mesh are
    those of :class:`Trajectory`; the last node is t_f.
    """

    __slots__ = ("_figures", "_inner", "_nodes", "_problem")
    _inner: _native.Solution
    _figures: Optional[Dict[str, Any]]
    _nodes: Optional[Trajectory]
    _problem: Optional[Problem]

    def __init__(self) -> None:
        raise TypeError("use plan, or Solution.load")

    @classmethod
    def _of(cls, native: _native.Solution, problem: Optional[Problem] = None) -> "Solution":
        solution = cls.__new__(cls)
        solution._inner = native
        solution._figures = None
        solution._nodes = None
        solution._problem = problem
        return solution

    @classmethod
    def load(cls, path: Path) -> "Solution":
        """Reads a ``solution.json``, of the command line or of :meth:`save`.

        Raises:
            SolutionError: it is none, or does not fit its own problem.
        """
        return cls._of(_native.Solution.load(_text(path)))

    def save(self, path: Path) -> None:
        """Writes a ``solution.json``, all of it or nothing, with problem and robot in it."""
        self._inner.save(_text(path))

    def to_dict(self) -> Dict[str, Any]:
        """The whole ``solution.json``: docs/solution-file.md."""
        found: Dict[str, Any] = json.loads(self._inner.text())
        return found

    @property
    def problem(self) -> Problem:
        """The problem."""
        if self._problem is None:
            self._problem = Problem._of(self._inner.problem)
        return self._problem

    @property
    def status(self) -> str:
        """"solved", "infeasible", "not_converged" or "interrupted"."""
        return self._inner.status

    @property
    def objective(self) -> float:
        """Cost J of (14)."""
        return self._inner.objective

    @property
    def duration(self) -> float:
        """Duration t_f, s."""
        return self._inner.duration

    def _figure(self, name: str) -> Any:
        if self._figures is None:
            self._figures = json.loads(self._inner.figures())
        return self._figures[name]

    @property
    def method(self) -> str:
        """The planner."""
        return str(self._figure("method"))

    @property
    def tolerance(self) -> float:
        """Tolerance on the largest error."""
        return _number(self._figure("tolerance"))

    @property
    def max_error(self) -> float:
        """Largest error (28) on the final mesh; nan where it is not finite."""
        return _number(self._figure("max_error"))

    @property
    def points(self) -> int:
        """Collocation points of the final mesh; N is one more."""
        return int(self._figure("points"))

    @property
    def segments(self) -> int:
        """Segments of the final mesh."""
        return int(self._figure("segments"))

    @property
    def breakpoints(self) -> Tuple[float, ...]:
        """Ends of the segments, fractions of the duration from 0 to 1; segments + 1 of them."""
        return tuple(self._figure("breakpoints"))

    @property
    def points_per_segment(self) -> Tuple[int, ...]:
        """LGR points of each segment."""
        return tuple(self._figure("points_per_segment"))

    @property
    def metrics(self) -> Metrics:
        """Figures a person asks for first."""
        return Metrics(**_numbers(self._figure("metrics")))

    @property
    def cost_terms(self) -> Tuple[CostTerm, ...]:
        """Terms of the cost; their sum is J."""
        return tuple(CostTerm(**_numbers(term)) for term in self._figure("cost_terms"))

    @property
    def iterations(self) -> Tuple[Iteration, ...]:
        """Mesh iterations, the last being that of the final mesh."""
        return tuple(Iteration(**_numbers(record)) for record in self._figure("iterations"))

    @property
    def goals(self) -> Tuple[Goal, ...]:
        """Goals for the end effector, in the order of time."""
        return tuple(Goal(**goal) for goal in self._figure("goals"))

    @property
    def diagnosis(self) -> Optional[Diagnosis]:
        """Why there is no plan; only where the status is "infeasible"."""
        found = self._figure("diagnosis")
        if found is None:
            return None
        limits = []
        for limit in found["limits"]:
            bounds = {key: tuple(limit[key]) for key in ("bound", "smallest_bound")}
            limits.append(LimitFinding(**{**limit, **bounds}))
        return Diagnosis(**{**found, "limits": tuple(limits)})

    @property
    def verification(self) -> Optional[Verification]:
        """What re-integration found when it was planned; None where there was none."""
        found = self._figure("verification")
        return None if found is None else Verification(**_numbers(found))

    @property
    def search(self) -> Optional[Dict[str, Any]]:
        """What a search found: seed, tried, solved, optima; None where there was none."""
        found: Optional[Dict[str, Any]] = self._figure("search")
        return found

    @property
    def warnings(self) -> Tuple[str, ...]:
        """What a user should know before using the plan."""
        return tuple(self._figure("warnings"))

    @property
    def timing(self) -> Timing:
        """Where the time went."""
        return Timing(**_numbers(self._figure("timing")))

    @property
    def trajectory(self) -> Trajectory:
        """The planned motion at the nodes; the same arrays every time."""
        if self._nodes is None:
            self._nodes = Trajectory(*self._inner.nodes())
        return self._nodes

    @property
    def t(self) -> Array:
        """Times of the nodes, s; (N,)."""
        return self.trajectory.t

    @property
    def base_attitude(self) -> Array:
        """Base attitude at the nodes, rad where it is of angles; (N, 1), (N, 3) or (N, 4)."""
        return self.trajectory.base_attitude

    @property
    def base_position(self) -> Array:
        """Base position relative to the system's mass centre, m; (N, 2) or (N, 3)."""
        return self.trajectory.base_position

    @property
    def base_rate(self) -> Array:
        """Rates of the attitude angles, or the angular velocity, rad/s; (N, 1) or (N, 3)."""
        return self.trajectory.base_rate

    @property
    def joint_position(self) -> Array:
        """Joint positions, rad or m; (N, n)."""
        return self.trajectory.joint_position

    @property
    def joint_velocity(self) -> Array:
        """Joint rates, rad/s or m/s; (N, n)."""
        return self.trajectory.joint_velocity

    @property
    def control(self) -> Array:
        """Controls u = H⁻¹τ, rad/s² or m/s²; (N, n)."""
        return self.trajectory.control

    @property
    def joint_torque(self) -> Array:
        """Joint torques, N·m, or forces, N; (N, n)."""
        return self.trajectory.joint_torque

    def sample(self, t: "Union[float, npt.ArrayLike]") -> Trajectory:
        """The planned motion at any times, from the polynomials of the collocation.

        Args:
            t: times from 0 to t_f, s: one, or (N,) of them.

        Returns:
            The motion at these times; of one time without the first axis.

        Raises:
            ValueError: a time is outside of the motion.
        """
        times = np.asarray(t, dtype=np.float64)
        if times.ndim > 1:
            raise ValueError(f"t: an array of {times.ndim} axes; expected a time or an array of one axis")
        outside = times[~((times >= 0.0) & (times <= self.duration))]
        if outside.size:
            raise ValueError(
                f"t: {outside.flat[0]} s is not in the motion; expected 0 to {self.duration} s"
            )
        # Without any time the shapes are those of one, cut off.
        fractions = np.atleast_1d(times / self.duration) if times.size else np.zeros(1)
        sampled = self._inner.sample(fractions.tolist())
        motion = Trajectory(*(rows[: times.size] for rows in sampled))
        # The time as it was given: one of a fraction may differ in the last digit.
        exact = np.atleast_1d(times).copy()
        exact.flags.writeable = False
        motion = motion._replace(t=exact)
        return motion if times.ndim else Trajectory(*(rows[0] for rows in motion))

    def to_pandas(self) -> "pandas.DataFrame":
        """The motion at the nodes, with the columns of ``trajectory.csv``. Needs pandas."""
        return self.trajectory.to_pandas()

    def plot(self, points: int = 500) -> Any:
        """A matplotlib figure of the motion, drawn at that many times. Needs matplotlib."""
        times = np.linspace(0.0, self.duration, points)
        return self.sample(times).plot(self.problem.joint_names)

    def __repr__(self) -> str:
        return f"<Solution of {self.problem.name!r}: {self.status}, J = {self.objective:.9g}>"

    def __reduce__(self) -> "Tuple[Any, Tuple[Any, ...]]":
        return _restored, (self._inner.text(),)


def _restored(text: str) -> Solution:
    return Solution._of(_native.Solution.of_text(text))


def _number(value: Optional[float]) -> float:
    """null stands for a number that is not finite."""
    return float("nan") if value is None else value


def _numbers(values: Dict[str, Any]) -> Dict[str, Any]:
    return {name: _number(value) if value is None else value for name, value in values.items()}
