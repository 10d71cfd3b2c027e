"""A batch over a Dask cluster on loopback, whatever becomes of its workers."""

import os
import signal
import subprocess
import threading
import time

import pytest

import ffsm_ipopt as ffsm

#: No port that somebody may have.
LOOPBACK = {"host": "127.0.0.1", "dashboard_address": "127.0.0.1:0"}


@pytest.fixture(scope="module")
def cluster():
    """A client of two worker processes."""
    from distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, **LOOPBACK) as workers, Client(workers) as client:
        yield client


@pytest.fixture
def run(cluster):
    from ffsm_ipopt import dask

    return dask.run


@pytest.fixture(scope="module")
def planned(command, rows, write_batch, tmp_path_factory):
    """A batch whose halves last long enough for a part in their middle, and what the command makes of it."""
    folder = tmp_path_factory.mktemp("command")
    path = write_batch(folder, 48)
    command("batch", path, "--out", folder / "o", "--quiet")
    return path, rows(folder / "o")


def parts(folder):
    return sorted(folder.glob("part-*.parquet"))


def wait_for(condition):
    for _ in range(30000):
        if condition():
            return
        time.sleep(0.01)
    raise TimeoutError("not within five minutes")


def test_rows_are_those_of_the_command(run, cluster, planned, rows, tmp_path):
    path, theirs = planned
    told = []
    found = run(path, cluster, tmp_path / "o", on_shard=lambda *count: told.append(count))
    assert found.rows == found.done == 48
    # Shards, not plans.
    assert told == [(count, 3) for count in range(1, 4)]
    assert rows(tmp_path / "o") == theirs


def test_a_killed_worker_costs_its_shards_retry(run, cluster, planned, rows, arrow, tmp_path):
    path, theirs = planned
    out, at = tmp_path / "o", []
    victim = next(iter(cluster.run(os.getpid).values()))

    def kill():
        wait_for(lambda: parts(out))
        at.append(arrow.dataset(out).count_rows())
        os.kill(victim, signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    # Two shards for two workers: the victim is at one of them.
    found = run(path, cluster, out, shards=2)
    killer.join()
    assert 0 < at[0] < 48 == found.done
    assert victim not in cluster.run(os.getpid).values()
    assert rows(out) == theirs


def test_a_shard_waits_for_the_worker_that_has_it_still(run, cluster, planned, rows, tmp_path):
    path, theirs = planned
    out = tmp_path / "o"
    program = os.environ["FFSM_IPOPT"]
    old = subprocess.Popen([program, "batch", path, "--out", out, "--shard", "1/2", "--jobs", "1", "--quiet"])
    try:
        wait_for(lambda: parts(out))
        old.send_signal(signal.SIGSTOP)
        with pytest.raises(ffsm.DataSetInUseError):
            run(path, cluster, out, shards=2)
        counts = []

        def end(*count):
            counts.append(count)
            if count == (1, 2):
                # Only the other shard can be done.
                assert old.poll() is None
                old.kill()

        found = run(path, cluster, out, shards=2, resume=True, on_shard=end)
    finally:
        old.kill()
        old.wait()
    assert counts == [(1, 2), (2, 2)]
    assert found.done == 48
    assert rows(out) == theirs


def test_what_ends_the_run_ends_its_shards(run, cluster, planned, rows, tmp_path):
    path, theirs = planned
    out = tmp_path / "o"

    def refuse(*_):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        run(path, cluster, out, shards=8, on_shard=refuse)

    def free():
        try:
            ffsm.batch(path, out, shard=(1, 8), resume=True)
            return True
        except ffsm.DataSetInUseError:
            return False

    wait_for(free)
    assert len(rows(out)) < 48
    assert run(path, cluster, out, shards=3, resume=True).done == 48
    assert rows(out) == theirs


def test_a_shard_that_is_cancelled_ends_the_run(run, cluster, planned, rows, tmp_path):
    from distributed import Future

    path, theirs = planned

    def cancel(*_):
        cluster.cancel([Future(key, cluster) for key in list(cluster.futures)])

    with pytest.raises(ffsm.ShardCancelledError):
        run(path, cluster, tmp_path / "o", shards=8, on_shard=cancel)
    # What is still at work on them ends first.
    assert run(path, cluster, tmp_path / "o", shards=8, resume=True).done == 48
    assert rows(tmp_path / "o") == theirs


@pytest.fixture
def here(cluster):
    """A client whose worker is a thread of this process."""
    from distributed import Client, LocalCluster

    threads = {"processes": False, "protocol": "tcp://", "n_workers": 1, "threads_per_worker": 1}
    with LocalCluster(**threads, **LOOPBACK) as workers, Client(workers) as client:
        yield client


def test_a_shard_that_fails_is_tried_again_and_given_up(run, here, batch, rows, tmp_path, monkeypatch):
    path = batch(12)
    out = tmp_path / "o"
    plan, tries = ffsm._native.run_batch, []

    def fail(job, worker, told):
        tries.append(job.shard[0])
        if job.shard[0] == 2:
            raise OSError("no luck")
        plan(job, worker, told)

    monkeypatch.setattr(ffsm._native, "run_batch", fail)
    with pytest.raises(ffsm.ShardsFailedError, match="no luck") as caught:
        run(path, here, out, shards=3, retries=1)
    assert list(caught.value.failures) == [2]
    assert isinstance(caught.value.failures[2], OSError)
    assert sorted(tries) == [1, 2, 2, 3]
    assert sorted(rows(out)) == [row for row in range(12) if row % 3 != 1]
    monkeypatch.undo()
    assert run(path, here, out, resume=True).done == 12


def test_what_cannot_be_is_refused_before_any_shard(run, cluster, batch, tmp_path):
    with pytest.raises(ffsm.ProblemError):
        run(tmp_path / "nowhere.toml", cluster, tmp_path / "o")
    for wrong in ({"shards": 0}, {"memory": 100}, {"time_limit": -1.0}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            run(batch(12), cluster, tmp_path / "o", **wrong)
    assert not (tmp_path / "o").exists()
