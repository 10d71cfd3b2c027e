"""Plans: those of the command line, their arrays, searches, starts, errors."""

import json
import pickle

import numpy as np
import pytest

import ffsm_ipopt as ffsm
from conftest import CONFIG

QUANTITIES = ffsm.Trajectory._fields


@pytest.fixture(scope="module")
def saved(command, tmp_path_factory):
    folder = tmp_path_factory.mktemp("out")
    command("plan", CONFIG / "table1-smooth.toml", "--quiet", "--out", folder)
    return folder


def test_a_plan_is_that_of_the_command(planned, saved):
    theirs = json.loads((saved / "solution.json").read_text())
    assert planned.status == theirs["status"] == "solved"
    assert planned.objective == theirs["objective"]
    for name in QUANTITIES:
        np.testing.assert_array_equal(getattr(planned, name), theirs["trajectory"][name], err_msg=name)
    ours = planned.to_dict()
    for found in (ours, theirs):
        del found["timing"]
        del found["provenance"]["problem"]["path"], found["provenance"]["robot"]["path"]
        for record in found["iterations"]:
            del record["seconds"]
    assert ours == theirs


def test_figures_are_those_of_the_file(planned):
    found = planned.to_dict()
    assert planned.metrics.max_base_attitude == found["metrics"]["max_base_attitude"]
    assert planned.verification.max_joint_drift == found["verification"]["max_joint_drift"]
    assert [record.points for record in planned.iterations][-1] == planned.points
    assert len(planned.t) == planned.points + 1
    assert len(planned.breakpoints) == planned.segments + 1
    assert sum(planned.points_per_segment) == planned.points
    assert sum(term.value for term in planned.cost_terms) == pytest.approx(planned.objective)
    assert planned.max_error <= planned.tolerance
    assert planned.method == "a-rpm"
    assert planned.diagnosis is None and planned.search is None and planned.goals == ()
    assert planned.timing.total > 0.0


def test_arrays_have_their_shapes_and_cannot_be_written_to(planned):
    n, rows = 2, len(planned.t)
    widths = {"base_attitude": 1, "base_position": 2, "base_rate": 1}
    for name in QUANTITIES[1:]:
        array = getattr(planned, name)
        assert array.shape == (rows, widths.get(name, n)), name
        assert array.dtype == np.float64
        assert array is getattr(planned, name)
        with pytest.raises(ValueError, match="read-only"):
            array[0, 0] = 1.0


def test_samples_at_the_nodes_are_the_nodes(planned):
    sampled = planned.sample(planned.t)
    for name in QUANTITIES:
        np.testing.assert_allclose(
            getattr(sampled, name), getattr(planned, name), rtol=1e-9, atol=1e-12, err_msg=name
        )


def test_samples_between_the_nodes_are_a_motion(planned):
    """Rates are the slopes of positions, by central differences."""
    t, h = np.linspace(1.0, 19.0, 37), 1e-4
    ahead, behind, at = (planned.sample(t + d) for d in (h, -h, 0.0))
    for position, rate in (("joint_position", "joint_velocity"), ("base_attitude", "base_rate")):
        slope = (getattr(ahead, position) - getattr(behind, position)) / (2.0 * h)
        np.testing.assert_allclose(slope, getattr(at, rate), atol=2e-5)


def test_a_single_time_has_single_rows(planned):
    middle = planned.sample(10.0)
    assert middle.joint_position.shape == (2,)
    assert middle.t == 10.0
    np.testing.assert_array_equal(middle.control, planned.sample([10.0]).control[0])
    nothing = planned.sample([])
    assert (nothing.t.shape, nothing.joint_position.shape) == ((0,), (0, 2))


@pytest.mark.parametrize("t", [-0.1, 20.1, float("nan"), [1.0, 30.0], [[1.0]]])
def test_times_outside_are_refused(planned, t):
    with pytest.raises(ValueError, match="^t: "):
        planned.sample(t)


def test_a_saved_plan_is_read_again(planned, saved, tmp_path):
    planned.save(tmp_path / "new" / "solution.json")
    for path in (tmp_path / "new" / "solution.json", saved / "solution.json"):
        again = ffsm.Solution.load(path)
        assert again.objective == planned.objective
        np.testing.assert_array_equal(again.control, planned.control)
        np.testing.assert_array_equal(again.sample(3.3).control, planned.sample(3.3).control)
        assert again.problem.name == "table1-smooth"
    copy = pickle.loads(pickle.dumps(planned))
    assert copy.to_dict() == planned.to_dict()


def test_what_is_no_solution_is_refused(tmp_path):
    path = tmp_path / "solution.json"
    path.write_text('{"schema": 1}')
    with pytest.raises(ffsm.SolutionError) as caught:
        ffsm.Solution.load(path)
    assert caught.value.file == str(path)
    assert caught.value.key
    with pytest.raises(ffsm.SolutionError, match="cannot be read"):
        ffsm.Solution.load(tmp_path / "nowhere.json")


def test_verify_confirms_a_plan_and_not_a_bent_one(planned, tmp_path):
    found = ffsm.verify(planned)
    assert found.confirmed and found.doubt is None
    assert found.verification.max_base_attitude_drift == planned.verification.max_base_attitude_drift
    bent = planned.to_dict()
    for row in bent["trajectory"]["control"]:
        row[0] += 0.05
    path = tmp_path / "bent.json"
    path.write_text(json.dumps(bent))
    judged = ffsm.verify(path)
    assert not judged.confirmed
    assert judged.doubt


def test_a_plan_without_verification_is_the_same_motion(smooth, planned):
    plan = ffsm.plan(smooth, verify=False)
    assert plan.verification is None
    np.testing.assert_array_equal(plan.control, planned.control)


def test_an_infeasible_problem_is_a_solution_with_a_diagnosis():
    limits = {"limits.base_attitude": 0.01, "limits.final_base_attitude": 0.01}
    problem = ffsm.Problem.from_toml(CONFIG / "table1-smooth.toml", limits)
    plan = ffsm.plan(problem)
    assert plan.status == "infeasible"
    limit = plan.diagnosis.limits[0]
    assert limit.key in limits
    assert limit.smallest_bound[1] > limit.bound[1] == 0.01
    assert plan.verification is None


def test_a_start_saves_iterations(smooth, planned, saved):
    problem = smooth.with_values({"task.final.joints[1]": 1.06})
    cold = ffsm.plan(problem)
    for start in (planned, saved / "solution.json"):
        warm = ffsm.plan(problem, start=start)
        count = [sum(record.nlp_iterations for record in plan.iterations) for plan in (warm, cold)]
        assert 2 * count[0] < count[1]
        assert warm.objective == pytest.approx(cold.objective, rel=1e-4)


def test_a_start_of_another_robot_is_refused(planned):
    problem = ffsm.Problem.from_toml(CONFIG / "chaser-7dof.toml")
    with pytest.raises(ffsm.SolutionError):
        ffsm.plan(problem, start=planned)


def test_methods_by_name(smooth, planned):
    assert set(ffsm.METHODS) >= {"a-rpm", "rpm", "matpm", "straight-line"}
    straight = ffsm.plan(smooth, method="straight-line")
    assert straight.method == "straight-line"
    assert straight.objective > planned.objective
    assert ffsm.plan(smooth, method="rpm").problem.values == ("--method rpm",)
    with pytest.raises(ValueError, match="method: .*expected one of a-rpm"):
        ffsm.plan(smooth, method="magic")
    with pytest.raises(ValueError, match="no starts to choose from"):
        ffsm.plan(smooth, method="matpm", search=True)


def test_a_search_is_never_worse_and_says_what_it_found(smooth, planned):
    seen = []
    found = ffsm.plan(smooth, search=6, seed=3, on_progress=seen.append)
    assert found.objective <= planned.objective * (1.0 + 1e-6)
    assert found.search["tried"] == 6 and found.search["seed"] == 3
    assert [step.number for step in seen if step.stage == "search"].count(6) == 1
    assert found.search["optima"] == ffsm.plan(smooth, search=6, seed=3).search["optima"]


def test_progress_is_told(smooth, planned):
    seen = []
    ffsm.plan(smooth, on_progress=seen.append)
    solved = [step for step in seen if step.stage == "solved"]
    assert [step.points for step in solved] == [record.points for record in planned.iterations]
    assert solved[-1].max_error == planned.max_error
    iterations = [step for step in seen if step.stage == "iteration"]
    assert len(iterations) >= sum(record.nlp_iterations for record in planned.iterations)


@pytest.mark.parametrize("search", [False, 6])
def test_what_a_callback_raises_ends_the_plan(smooth, search):
    calls = []

    def refuse(step):
        calls.append(step)
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        ffsm.plan(smooth, on_progress=refuse, search=search)
    assert len(calls) == 1
    assert ffsm.plan(smooth).status == "solved"


def test_a_data_frame_has_the_columns_of_the_file(planned, saved, pandas):
    theirs = pandas.read_csv(saved / "trajectory.csv")
    # Readers of CSV may miss the last digit.
    pandas.testing.assert_frame_equal(planned.to_pandas(), theirs, rtol=1e-14, atol=0.0)


def test_a_figure_is_drawn(planned, tmp_path, pyplot):
    figure = planned.plot(points=50)
    lines = [len(axis.lines) for axis in figure.axes]
    assert lines == [1, 2, 2, 2]
    angle = figure.axes[0].lines[0].get_ydata()[-1]
    assert angle == pytest.approx(np.degrees(planned.base_attitude[-1, 0]))
    figure.savefig(tmp_path / "motion.png")
    assert (tmp_path / "motion.png").stat().st_size > 0
    pyplot.close(figure)
