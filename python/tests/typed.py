"""Held against the types by mypy: what a user writes."""

from pathlib import Path
from typing import List

import numpy as np
import numpy.typing as npt

import ffsm_ipopt as ffsm


def angles(path: Path) -> npt.NDArray[np.float64]:
    problem = ffsm.Problem.from_toml(path, {"task.duration": 20.0})
    try:
        plan = ffsm.plan(problem, search=8, on_progress=lambda step: print(step.stage))
    except ffsm.ProblemError as error:
        print(error.key, error.file, error.line)
        raise
    records: List[ffsm.Record] = ffsm.plan_many([problem], start=plan)
    print(records[0].row(), plan.sample(1.0).control.shape)
    return plan.base_attitude
