"""A batch into a data set, and what reads it."""

import time

import pytest

import ffsm_ipopt as ffsm


def test_rows_are_those_of_the_command(batch, command, rows, tmp_path):
    path = batch(12)
    command("batch", path, "--out", tmp_path / "command", "--quiet", "--trajectories")
    told = []
    found = ffsm.batch(path, tmp_path / "ours", trajectories=True, on_row=told.append)
    assert found.rows == found.done == 12
    assert {name: told.count(name) for name in told} == found.ended
    assert rows(tmp_path / "ours") == rows(tmp_path / "command")


def test_shards_and_processes_write_the_same_rows(batch, rows, tmp_path):
    path = batch(12)
    ffsm.batch(path, tmp_path / "whole")
    first = ffsm.batch(path, tmp_path / "shards", shard=(2, 3), jobs=1)
    assert (first.rows, first.done) == (12, 4)
    ffsm.batch(path, tmp_path / "shards", shard=(1, 3))
    ffsm.batch(path, tmp_path / "shards", resume=True, isolate=True, jobs=2, memory=4096)
    assert rows(tmp_path / "shards") == rows(tmp_path / "whole")


def test_rows_are_planned_again_by_their_status(batch, rows, tmp_path):
    path, out = batch(12), tmp_path / "o"
    before = ffsm.batch(path, out)
    told = []
    after = ffsm.batch(path, out, retry=["not_converged"], on_row=told.append)
    assert told == ["not_converged"] * before.ended["not_converged"]
    assert after == before


def test_pandas_and_polars_read_it(batch, pandas, polars, tmp_path):
    found = ffsm.batch(batch(6), tmp_path / "o", trajectories=True)
    frames = pandas.read_parquet(tmp_path / "o"), polars.read_parquet(tmp_path / "o" / "part-*.parquet")
    for frame in frames:
        assert sorted(frame["row"]) == list(range(6))
        assert list(frame["status"]).count("solved") == found.ended["solved"]
        assert {"task.final.joints[0]", "objective", "joint_position"} <= set(frame.columns)
    one, other = frames
    assert one["objective"].tolist() == other["objective"].to_list()
    assert [list(map(list, motion)) for motion in one["control"]] == other["control"].to_list()


def test_the_folder_is_a_data_set_while_it_grows(batch, arrow, rows, tmp_path):
    seen = []

    def look(_):
        seen.append(arrow.dataset(tmp_path / "o").count_rows())
        # Parts are half a second apart.
        time.sleep(0.04)

    ffsm.batch(batch(40), tmp_path / "o", on_row=look)
    assert seen == sorted(seen)
    assert any(0 < count < 40 for count in seen)
    assert len(rows(tmp_path / "o")) == 40


def test_what_a_callback_raises_keeps_what_is_done(batch, rows, tmp_path):
    path, told = batch(12), []

    def refuse(status):
        told.append(status)
        if len(told) == 3:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        ffsm.batch(path, tmp_path / "o", on_row=refuse)
    assert 3 <= len(rows(tmp_path / "o")) < 12
    assert ffsm.batch(path, tmp_path / "o", resume=True).done == 12


def test_what_cannot_be_is_refused(batch, smooth, tmp_path):
    path, out = batch(12), tmp_path / "o"
    with pytest.raises(ffsm.ProblemError) as caught:
        ffsm.batch(tmp_path / "nowhere.toml", out)
    assert caught.value.file == str(tmp_path / "nowhere.toml")
    for wrong in ({"shard": (3, 2)}, {"retry": ["lost"]}, {"time_limit": 0.0}, {"memory": 100}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            ffsm.batch(path, out, **wrong)
    with pytest.raises(ValueError, match="without shard"):
        ffsm.batch(path, out, retry=["failed"], shard=(1, 2))
    assert not out.exists()
    ffsm.batch(path, out, shard=(1, 6))
    with pytest.raises(ffsm.DataSetError, match="2 rows") as caught:
        ffsm.batch(path, out)
    assert caught.value.file == str(out)
    with pytest.raises(ffsm.DataSetError, match="another batch"):
        ffsm.batch(path, out, resume=True, trajectories=True)


def test_a_second_run_is_refused(batch, tmp_path):
    path, refused = batch(12), []

    def again(_):
        if not refused:
            with pytest.raises(ffsm.DataSetInUseError) as caught:
                ffsm.batch(path, tmp_path / "o", resume=True)
            refused.append(caught.value)

    ffsm.batch(path, tmp_path / "o", on_row=again)
    assert refused[0].file == str(tmp_path / "o")
