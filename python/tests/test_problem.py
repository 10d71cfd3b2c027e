"""Problems from files, texts, dictionaries and URDF; what is wrong with them."""

import pickle
import re
import shutil

import numpy as np
import pytest

import ffsm_ipopt as ffsm
from conftest import CONFIG, ROOT

TABLES = {
    "schema": 1,
    "name": "from-a-dict",
    "robot": "robots/planar-2link.toml",
    "task": {
        "duration": 20.0,
        "initial": {"joints": [0.0, 0.0]},
        "final": {"joints": np.radians([30.0, 60.0])},
    },
    "cost": {"base_rate": [1.0], "control": [0.1, 0.1]},
}


def test_a_problem_says_what_it_is(smooth):
    assert smooth.name == "table1-smooth"
    assert smooth.joint_names == ("shoulder", "elbow")
    assert smooth.duration == (20.0, 20.0)
    assert smooth.attitude == "angle"
    assert repr(smooth).startswith("<Problem 'table1-smooth'")


def test_file_text_and_values_are_one_problem(smooth):
    text = (CONFIG / "table1-smooth.toml").read_text()
    of_text = ffsm.Problem.from_toml(text, {"task.duration": 25}, folder=CONFIG)
    of_file = ffsm.Problem.from_toml(str(CONFIG / "table1-smooth.toml"), {"task.duration": 25.0})
    later = smooth.with_values({"task.duration": 25.0})
    for problem in (of_text, of_file, later):
        assert problem.duration == (25.0, 25.0)
    assert later.values == ("--set task.duration=25.0",)
    goals = [ffsm.plan(problem).objective for problem in (of_file, later)]
    assert goals[0] == goals[1]


def test_a_dict_is_a_problem():
    problem = ffsm.Problem.from_dict(TABLES, folder=CONFIG)
    assert problem.name == "from-a-dict"
    end = ffsm.plan(problem).joint_position[-1]
    np.testing.assert_allclose(end, np.radians([30.0, 60.0]), atol=1e-9)


def test_a_urdf_is_a_first_problem():
    path = CONFIG / "robots" / "chaser-7dof.urdf"
    problem = ffsm.Problem.from_urdf(path, {"task.duration": 33.0})
    assert len(problem.joint_names) == 7
    assert problem.duration == (33.0, 33.0)
    assert "[task]" in problem.text


def test_errors_have_key_and_place(tmp_path):
    text = (CONFIG / "table1-smooth.toml").read_text().replace("duration =", "duratoin =")
    path = tmp_path / "wrong.toml"
    path.write_text(text.replace('"robots/', f'"{CONFIG}/robots/'))
    with pytest.raises(ffsm.ProblemError) as caught:
        ffsm.Problem.from_toml(path)
    error = caught.value
    line = next(i for i, row in enumerate(text.splitlines(), 1) if "duratoin" in row)
    assert (error.key, error.file, error.line) == ("task.duratoin", str(path), line)
    assert isinstance(error, ValueError) and isinstance(error, ffsm.Error)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.key, again.line) == (str(error), error.key, error.line)


def test_an_error_of_a_dict_names_no_line_that_nobody_wrote():
    with pytest.raises(ffsm.ProblemError) as caught:
        ffsm.Problem.from_dict({**TABLES, "task": {**TABLES["task"], "duration": -1.0}}, folder=CONFIG)
    assert caught.value.key == "task.duration"
    assert caught.value.line is None
    assert not re.search(r"toml:\d", str(caught.value))


def test_an_error_of_a_value_names_the_value():
    with pytest.raises(ffsm.ProblemError) as caught:
        ffsm.Problem.from_toml(CONFIG / "table1-smooth.toml", {"task.duration": "long"})
    assert caught.value.key == "task.duration"
    assert caught.value.file == '--set task.duration="long"'


def test_a_task_that_no_motion_can_do_is_refused():
    with pytest.raises(ffsm.ProblemError, match="too short|at least") as caught:
        ffsm.Problem.from_toml(CONFIG / "table1-smooth.toml", {"task.duration": 0.1})
    assert caught.value.key == "task.duration"
    assert caught.value.line is None


def test_several_faults_are_all_there(smooth):
    with pytest.raises(ffsm.ProblemError) as caught:
        smooth.with_values({"task.initial.joints": [9.0, 9.0], "task.final.joints": [9.0, 9.0]})
    faults = caught.value.faults
    assert len(faults) > 1
    assert caught.value.key == faults[0].key
    assert all(fault.key and not fault.faults for fault in faults)


def test_a_missing_file_is_named():
    with pytest.raises(ffsm.ProblemError, match="nowhere.toml: cannot be read") as caught:
        ffsm.Problem.from_toml("nowhere.toml")
    assert caught.value.file == "nowhere.toml"


def test_values_of_other_types_are_refused(smooth):
    with pytest.raises(TypeError, match="expected a number"):
        smooth.with_values({"task.duration": object()})


def test_any_text_survives_as_toml(tmp_path):
    folder = tmp_path / 'a "b" \\ c'
    folder.mkdir()
    shutil.copy(CONFIG / TABLES["robot"], folder / "arm.toml")
    problem = ffsm.Problem.from_dict({**TABLES, "robot": folder / "arm.toml"})
    assert problem.robot == "planar-2link"


def test_a_problem_goes_through_pickle(smooth):
    again = pickle.loads(pickle.dumps(smooth.with_values({"task.duration": 21.0})))
    assert again.duration == (21.0, 21.0)


def test_check_says_what_the_command_says(command):
    path = CONFIG / "table1-smooth.toml"
    assert ffsm.check(path) == command("check", path).stdout
    assert "degrees of freedom" in ffsm.check(ffsm.Problem.from_toml(path))


def test_the_package_has_what_its_names_say():
    assert ffsm.METHODS[0] == "a-rpm"
    assert ffsm.__version__.split()[0] in (ROOT / "Cargo.toml").read_text()
    assert all(hasattr(ffsm, name) for name in ffsm.__all__)
    with pytest.raises(TypeError):
        ffsm.Problem()


def test_arguments_of_another_kind_are_refused_by_name(smooth, tmp_path):
    with pytest.raises(TypeError, match="problem: .*expected a Problem"):
        ffsm.plan("case.toml")
    with pytest.raises(TypeError, match="problem: .*expected a Problem"):
        ffsm.plan_many([smooth, None])
    with pytest.raises(TypeError, match="values: 'abc'; expected a mapping"):
        smooth.with_values("abc")
    with pytest.raises(ValueError, match="no '='"):
        smooth.with_values({"task.duration=3 #": 1})
    with pytest.raises(TypeError, match="search: 1.5; expected a whole number"):
        ffsm.plan(smooth, search=1.5)
    with pytest.raises(ValueError, match="jobs: 0; expected a whole number from 1"):
        ffsm.plan_many([smooth], jobs=0)
    assert smooth.with_values({"mesh.points": 6.0}).values == ("--set mesh.points=6.0",)
    text = bytes(CONFIG / "table1-smooth.toml")
    assert ffsm.Problem.from_toml(text).name == "table1-smooth"
