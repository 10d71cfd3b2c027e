"""Many problems into a data set, as the command ``batch`` plans them."""

import sys
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple

from . import _native
from .planning import _whole
from .problem import Path, _text

#: Begins a process that plans rows.
_WORKER = [sys.executable, "-m", "ffsm_ipopt._worker"]


#: Least limit on the memory of a process, MiB, as the command has it.
_LEAST_MEMORY = 16


class BatchSummary(NamedTuple):
    """How far a data set is."""

    #: Rows of the whole batch.
    rows: int
    #: How many of the rows that are done ended how, by status.
    ended: Dict[str, int]

    @property
    def done(self) -> int:
        """Rows that are done, however they ended."""
        return sum(self.ended.values())


class _Job(NamedTuple):
    """Which rows of a batch are planned, how, and where they go."""

    batch: str
    out: str
    shard: Tuple[int, int]
    resume: bool
    retry: List[str]
    jobs: Optional[int]
    time_limit: Optional[float]
    warm_start: Optional[str]
    trajectories: bool
    isolate: bool
    memory: Optional[int]


def _job(
    batch: Path,
    out: Path,
    *,
    shard: Optional[Tuple[int, int]],
    resume: bool,
    retry: Sequence[str],
    jobs: Optional[int],
    time_limit: Optional[float],
    start: Optional[Path],
    trajectories: bool,
    isolate: bool,
    memory: Optional[int],
) -> _Job:
    if isinstance(retry, str):
        raise TypeError(f"retry: {retry!r}; expected a list of statuses")
    if retry and shard is not None:
        raise ValueError("retry: takes rows out of the whole folder; give it without shard")
    if memory is not None and not isolate:
        raise ValueError("memory: is a limit of processes; give it with isolate")
    if memory is not None:
        memory = _whole("memory", memory, _LEAST_MEMORY)
    if jobs is not None:
        jobs = _whole("jobs", jobs, 1)
    if shard is not None and not (isinstance(shard, tuple) and len(shard) == 2):
        raise TypeError(f"shard: {shard!r}; expected (i, n), the ith of n shards")
    if not _text(out):
        raise ValueError("out: is empty; expected the path of a folder")
    return _Job(
        _text(batch),
        _text(out),
        shard or (1, 1),
        resume,
        list(retry),
        jobs,
        time_limit,
        None if start is None else _text(start),
        trajectories,
        isolate,
        memory,
    )


def _summary(out: str) -> BatchSummary:
    return BatchSummary(*_native.ended(out))


def batch(
    path: Path,
    out: Path,
    *,
    jobs: Optional[int] = None,
    shard: Optional[Tuple[int, int]] = None,
    resume: bool = False,
    retry: Sequence[str] = (),
    time_limit: Optional[float] = None,
    start: Optional[Path] = None,
    trajectories: bool = False,
    isolate: bool = False,
    memory: Optional[int] = None,
    on_row: Optional[Callable[[str], object]] = None,
) -> BatchSummary:
    """Plans the rows of a batch into a data set: those of ``ffsm-ipopt batch``, bit for bit.

    Rows that are done are kept whatever ends the run; with ``resume`` the next one plans the rest. The
    lock of the interpreter is released; Ctrl-C ends the run after an iteration, with what is done
    written.

    Args:
        path: a batch file, or JSON lines of whole problems (``.jsonl``).
        out: the folder of the data set; pandas, Polars and PyArrow read it, also meanwhile.
        jobs: plans at a time; one a processor unless given.
        shard: ``(i, n)`` for every nth row from the ith on, i from 1 to n; shards of one n may write to
            one folder at the same time.
        resume: whether to go on where the folder has rows of this batch.
        retry: rows that ended with one of these statuses are planned again, and those that are not done.
        time_limit: limit on the time of each plan, s.
        start: path of a saved solution that every plan begins at.
        trajectories: whether the data set has the planned motions.
        isolate: whether plans are made in processes of their own: what ends one of them is a row with
            its reason. It is so anyway where the linear solver cannot serve two threads.
        memory: limit on the memory of each of these processes, MiB.
        on_row: called with the status of every row as it ends; what it raises ends the run.

    Returns:
        How far the data set is, with the rows of other shards and of runs before.

    Raises:
        ProblemError: the batch file, or the problem it varies, cannot be used.
        SolutionError: the start is no solution, or belongs to another robot.
        DataSetError: the folder cannot be written, or has other rows.
        DataSetInUseError: another run writes to these rows.
        KeyboardInterrupt: it was ended by Ctrl-C.
    """
    job = _job(
        path,
        out,
        shard=shard,
        resume=resume,
        retry=retry,
        jobs=jobs,
        time_limit=time_limit,
        start=start,
        trajectories=trajectories,
        isolate=isolate,
        memory=memory,
    )

    def told(status: Optional[str]) -> None:
        if status is not None and on_row is not None:
            on_row(status)

    _native.run_batch(job, _WORKER, told)
    return _summary(job.out)
