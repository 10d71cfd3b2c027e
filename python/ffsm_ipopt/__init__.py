"""Trajectory optimisation for free-floating space manipulators.

A robot arm hangs on a spacecraft whose thrusters are off; its motion is planned so that the base hardly
moves. Quantities are in SI units and radians everywhere.

>>> import ffsm_ipopt as ffsm
>>> problem = ffsm.Problem.from_toml("config/table1-smooth.toml")
>>> solution = ffsm.plan(problem)
>>> solution.status
'solved'
"""

# Before anything is planned: the first array would otherwise wait for it.
import numpy as _numpy  # noqa: F401

from ._native import build as _build
from ._native import set_thread_count
from .data_set import BatchSummary, batch
from .errors import (
    DataSetError,
    DataSetInUseError,
    Error,
    PlanError,
    ProblemError,
    ShardCancelledError,
    ShardsFailedError,
    SolutionError,
)
from .planning import Figures, Judgement, Progress, Record, check, plan, plan_many, verify
from .problem import Problem
from .solution import (
    CostTerm,
    Diagnosis,
    Goal,
    Iteration,
    LimitFinding,
    Metrics,
    Solution,
    Timing,
    Verification,
)
from .trajectory import Trajectory

__version__: str
__ipopt_version__: str
METHODS: "tuple[str, ...]"
__version__, __ipopt_version__, _methods = _build()
METHODS = tuple(_methods)

__all__ = [
    "METHODS",
    "BatchSummary",
    "CostTerm",
    "DataSetError",
    "DataSetInUseError",
    "Diagnosis",
    "Error",
    "Figures",
    "Goal",
    "Iteration",
    "Judgement",
    "LimitFinding",
    "Metrics",
    "PlanError",
    "Problem",
    "ProblemError",
    "Progress",
    "Record",
    "ShardCancelledError",
    "ShardsFailedError",
    "Solution",
    "SolutionError",
    "Timing",
    "Trajectory",
    "Verification",
    "batch",
    "check",
    "plan",
    "plan_many",
    "set_thread_count",
    "verify",
]
