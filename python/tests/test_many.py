"""Many plans side by side."""

import numpy as np
import pytest

import ffsm_ipopt as ffsm


def goals(problem, count):
    return [problem.with_values({"task.final.joints[1]": 0.9 + 0.03 * k}) for k in range(count)]


def test_each_plan_is_as_if_it_were_alone(smooth):
    problems = goals(smooth, 5)
    records = ffsm.plan_many(problems, jobs=2, trajectories=True)
    assert [record.position for record in records] == list(range(5))
    for problem, record in zip(problems, records):
        alone = ffsm.plan(problem)
        assert record.status == alone.status == "solved"
        assert record.figures.objective == alone.objective
        assert record.figures.verification_joint == alone.verification.max_joint_drift
        np.testing.assert_array_equal(record.trajectory.control, alone.control)


def test_one_that_fails_fails_alone(smooth):
    limits = {"limits.base_attitude": 0.01, "limits.final_base_attitude": 0.01}
    problems = goals(smooth, 2) + [smooth.with_values(limits)]
    told = []
    records = ffsm.plan_many(problems, on_record=told.append)
    assert [record.status for record in records] == ["solved", "solved", "infeasible"]
    assert sorted(record.position for record in told) == [0, 1, 2]
    assert "cannot hold" in records[2].reason
    assert records[0].trajectory is None
    assert records[0].row()["objective"] == records[0].figures.objective


def test_a_start_is_one_for_all(smooth, planned):
    cold = ffsm.plan_many(goals(smooth, 3))
    warm = ffsm.plan_many(goals(smooth, 3), start=planned)
    for one, other in zip(cold, warm):
        assert other.figures.nlp_iterations < one.figures.nlp_iterations
        assert other.figures.objective == pytest.approx(one.figures.objective, rel=1e-4)


def test_what_a_callback_raises_ends_all(smooth):
    told = []

    def refuse(record):
        told.append(record)
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        ffsm.plan_many(goals(smooth, 20), on_record=refuse)
    assert len(told) == 1


def test_nothing_to_plan_is_nothing():
    assert ffsm.plan_many([]) == []
    with pytest.raises((ValueError, TypeError)):
        ffsm.plan_many([], jobs=0)
