"""Held against the types by mypy: what a user writes."""

from pathlib import Path
from typing import List

import numpy as np
import numpy.typing as npt
from distributed import Client

import ffsm_ipopt as ffsm
import ffsm_ipopt.dask


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


def done(path: Path, client: Client) -> int:
    here: ffsm.BatchSummary = ffsm.batch(path, "out", shard=(1, 2), on_row=print)
    try:
        there = ffsm_ipopt.dask.run(
            path, client, "out", resume=True, on_shard=lambda done, of: print(done, of)
        )
    except ffsm.ShardsFailedError as error:
        print(error.failures[1])
        raise
    return here.ended["solved"] + there.done
