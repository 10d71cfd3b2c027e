"""A batch over the workers of a Dask cluster, shard by shard (``pip install ffsm_ipopt[dask]``).

The part files in the folder are the truth: a worker, a scheduler or a client that dies costs what the
shards in flight had not written yet, and nothing else.
"""

import asyncio
import logging
import os
import threading
import time
import uuid
from typing import Callable, Dict, Optional, Sequence, Set, Tuple

from distributed import Client, Future, as_completed

from . import _native
from .data_set import _WORKER, BatchSummary, _Job, _job, _summary
from .errors import DataSetError, DataSetInUseError, ShardCancelledError, ShardsFailedError
from .problem import Path

_log = logging.getLogger(__name__)

#: Rows of a shard at least, so that what a shard costs by itself does not matter, and shards at least,
#: so that a cluster that still grows has work for all.
_LEAST_ROWS = 16
_LEAST_SHARDS = 64
#: Shards for each thread of the cluster: the last of them leave few idle.
_SHARDS_A_THREAD = 4
#: Pause before asking again, s, and how often where a folder is looked at that others write to.
_PAUSE = 1.0
_LOOKS = 60
#: How long the workers are waited for that are told to end, s.
_PATIENCE = 10.0

#: The runs that this worker is to end.
_stopped: Set[str] = set()


class _Stopped(Exception):
    """Nobody waits for this shard any more."""


def run(
    batch: Path,
    client: Client,
    out: Path,
    *,
    shards: Optional[int] = None,
    jobs: int = 1,
    resume: bool = False,
    retry: Sequence[str] = (),
    time_limit: Optional[float] = None,
    start: Optional[Path] = None,
    trajectories: bool = False,
    isolate: bool = False,
    memory: Optional[int] = None,
    retries: int = 3,
    on_shard: Optional[Callable[[int, int], object]] = None,
) -> BatchSummary:
    """Plans the rows of a batch on the workers of ``client``: those of ``ffsm-ipopt batch``, bit for bit.

    Client and workers have to see ``batch``, the files it names and ``out`` at the same paths, on a file
    system with ``flock``. Ctrl-C ends the shards on all workers, with what is done written.

    A shard whose worker dies is planned on by another, from its last part file. Where the old worker is
    alive after all, the new one waits for its end: no row is planned twice.

    Args:
        batch: a batch file, or JSON lines of whole problems (``.jsonl``).
        client: of the cluster.
        out: the folder of the data set.
        shards: how many shards the rows are dealt to, each a task; four for each thread of the cluster,
            and more where it is small, unless given.
        jobs: plans at a time in each shard; where that is more than one, give the workers one thread.
        resume: whether to go on where the folder has rows of this batch, also with other ``shards``.
        retry: rows that ended with one of these statuses are planned again, and those that are not done.
        time_limit: limit on the time of each plan, s.
        start: path of a saved solution that every plan begins at.
        trajectories: whether the data set has the planned motions.
        isolate: whether plans are made in processes of their own: a plan that ends its process is a
            row with its reason, and the worker lives on.
        memory: limit on the memory of each of these processes, MiB.
        retries: how often in a row a shard that fails without a row more is tried again.
        on_shard: called with the number of shards that are done, and of all of them, as they end; what
            it raises ends the run.

    Returns:
        How far the data set is.

    Raises:
        ProblemError: the batch file, or the problem it varies, cannot be used.
        SolutionError: the start is no solution, or belongs to another robot.
        DataSetError: the folder cannot be written, has other rows, or is not the same for all.
        DataSetInUseError: another run writes to the folder, and it may not ``resume``.
        ShardsFailedError: shards were given up; all others are done.
        ShardCancelledError: the scheduler is gone, or somebody cancelled a shard.
    """
    if client.asynchronous:
        raise ValueError(
            "client: is asynchronous; expected one that waits, as Client(...) is outside of async"
        )
    if shards is not None and shards < 1:
        raise ValueError(f"shards: {shards}; expected a number from 1")
    job = _job(
        os.path.abspath(batch),
        os.path.abspath(out),
        shard=None,
        resume=resume,
        retry=retry,
        jobs=jobs,
        time_limit=time_limit,
        start=None if start is None else os.path.abspath(start),
        trajectories=trajectories,
        isolate=isolate,
        memory=memory,
    )
    # Here, so that what is wrong is found before a worker has it, and all shards go on with one data set.
    rows = _native.batch_rows(job)
    _begin(job)
    count = _count(client, rows) if shards is None else min(shards, max(rows, 1))
    deal = _Deal(client, job._replace(resume=True, retry=[]), count)
    try:
        failures = deal.plan(retries, on_shard)
    except BaseException:
        deal.stop()
        raise
    if failures:
        first = min(failures)
        raise ShardsFailedError(
            f"{len(failures)} of {count} shards failed again and again, the first, {first}, with: "
            f"{failures[first]}; the rows of the others are done, resume goes on from there",
            failures,
        ) from failures[first]
    return _complete(job.out, rows)


class _Deal:
    """The shards of a run, each a task of the cluster."""

    def __init__(self, client: Client, job: _Job, count: int) -> None:
        self.client, self.job, self.count = client, job, count
        self.token = uuid.uuid4().hex
        self.futures: "Dict[str, Tuple[int, Future[None]]]" = {}

    def submit(self, number: int, attempt: int = 1) -> "Future[None]":
        job = self.job._replace(shard=(number, self.count))
        key = f"ffsm-ipopt-batch-{self.token}-{number}-{attempt}"
        future = self.client.submit(_plan_shard, self.token, job, key=key, pure=False)
        self.futures[key] = number, future
        return future

    def plan(
        self, retries: int, on_shard: Optional[Callable[[int, int], object]]
    ) -> Dict[int, BaseException]:
        """Has the shards planned; what those failed with that are given up."""
        failures: Dict[int, BaseException] = {}
        #: Rows of a shard at its last failure, failures since then, attempts in all.
        tried: Dict[int, Tuple[int, int, int]] = {}
        done = 0
        waiting = as_completed([self.submit(number) for number in range(1, self.count + 1)])
        for future in waiting:
            number, _ = self.futures.pop(future.key)
            if future.status not in ("finished", "error"):
                raise ShardCancelledError(
                    f"shard {number}/{self.count}: the cluster has no task for it any more: its scheduler "
                    "ended or the task was cancelled; the rows before are kept, resume goes on from there"
                )
            failure = future.exception()
            if failure is None:
                done += 1
                if on_shard is not None:
                    on_shard(done, self.count)
                continue
            rows = _native.rows_done(self.job.out, (number, self.count))
            before, fruitless, attempts = tried.get(number, (rows, 0, 1))
            fruitless = 0 if rows > before else fruitless + 1
            tried[number] = rows, fruitless, attempts + 1
            if fruitless > retries:
                failures[number] = failure
            else:
                waiting.add(self.submit(number, attempts + 1))
        return failures

    def stop(self) -> None:
        """Ends the shards, wherever they are planned."""
        # On a thread of its own: a worker that hangs is not to hold up who asked for an end.
        telling = threading.Thread(target=self._tell, name="ffsm-ipopt-stop", daemon=True)
        telling.start()
        telling.join(_PATIENCE)

    def _tell(self) -> None:
        try:
            self.client.cancel([future for _, future in self.futures.values()])
            self.client.run(_stop, self.token, on_error="ignore")
        except (Exception, asyncio.CancelledError):
            # The cluster may be gone, which is why the run ends.
            _log.warning("shards could not be told to end; they may go on to their end", exc_info=True)


def _begin(job: _Job) -> None:
    try:
        _native.begin_batch(job)
    except DataSetInUseError:
        if job.retry or not job.resume:
            raise
        # Shards of a client that is gone, as a rule.
        _log.warning("%s: another run writes to it; its rows are waited for", job.out)


def _count(client: Client, rows: int) -> int:
    threads: int = sum(client.nthreads().values())
    most = -(-rows // _LEAST_ROWS)
    return max(1, min(most, max(_LEAST_SHARDS, _SHARDS_A_THREAD * threads)))


def _complete(out: str, rows: int) -> BatchSummary:
    """The summary, once all rows are seen here: a network file system may show a new file late."""
    for _ in range(_LOOKS):
        summary = _summary(out)
        if summary.done >= rows:
            return summary
        time.sleep(_PAUSE)
    raise DataSetError(
        f"{out}: has {summary.done} of {rows} rows after all shards; expected a folder that client and "
        "workers see at the same path",
        file=out,
    )


def _stop(token: str) -> None:
    """On every worker."""
    _stopped.add(token)


def _plan_shard(token: str, job: _Job) -> None:
    """One shard, on a worker."""

    def told(_: Optional[str]) -> None:
        if token in _stopped:
            raise _Stopped

    if not os.path.isdir(job.out):
        message = f"{job.out}: is not there; expected the folder of the client, at the same path"
        raise DataSetError(message, file=job.out)
    waits = False
    while token not in _stopped:
        try:
            return _native.run_batch(job, _WORKER, told)
        except _Stopped:
            return
        except DataSetInUseError:
            # A worker that was given up, and is alive. It ends its shard, or dies and frees it.
            if not waits:
                waits = True
                _log.warning("shard %d/%d: another process is at it; its end is waited for", *job.shard)
            time.sleep(_PAUSE)
