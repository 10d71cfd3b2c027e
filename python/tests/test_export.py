"""What other tools make of exported plans: MuJoCo, ROS 2, pandas and Arrow."""

import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest

from conftest import CONFIG

# table1 is infeasible as published.
SHIPPED = sorted({*CONFIG.glob("*.toml"), CONFIG / "starter" / "problem.toml"} - {CONFIG / "table1.toml"})


@pytest.fixture(scope="module")
def smooth_folder(command, tmp_path_factory):
    folder = tmp_path_factory.mktemp("smooth")
    command("plan", CONFIG / "table1-smooth.toml", "--quiet", "--out", folder)
    return folder


def export(command, folder, *arguments):
    command("export", folder / "solution.json", "--format", *arguments)


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_mujoco_ends_where_the_plan_does(command, tmp_path, path):
    command("plan", path, "--quiet", "--no-report", "--out", tmp_path)
    export(command, tmp_path, "mujoco")
    player = tmp_path / "mujoco" / "play.py"
    # Not the tests' own warnings as errors: the player is a program of its own.
    said = subprocess.run([sys.executable, player], check=True, capture_output=True, text=True).stdout
    off = re.search(r"off by (\S+) deg\n", said)
    assert off and float(off[1]) < 1e-3, said
    metres = re.search(r"base off by (\S+) m", said)
    assert metres and float(metres[1]) < 1e-4, said
    # It moves, as the plan says.
    turned = re.search(r"base turned by (\S+) deg", said)
    solution = json.loads((tmp_path / "solution.json").read_text())
    between = np.degrees(solution["metrics"]["final_base_attitude"])
    if solution["trajectory"]["base_attitude"][0] == [0.0] * len(solution["trajectory"]["base_attitude"][0]):
        assert turned and float(turned[1]) == pytest.approx(between, abs=2e-3), said


def test_keyframes_are_the_plan(command, smooth_folder):
    import mujoco

    export(command, smooth_folder, "mujoco")
    model = mujoco.MjModel.from_xml_path(str(smooth_folder / "mujoco" / "model.xml"))
    solution = json.loads((smooth_folder / "solution.json").read_text())
    names = [joint["name"] for joint in solution["joints"]]
    assert [model.joint(k).name for k in range(1, model.njnt)] == names
    assert model.nkey == 11
    motion = solution["trajectory"]
    for key, row in ((0, 0), (model.nkey - 1, -1)):
        assert model.key_qpos[key, 7:] == pytest.approx(motion["joint_position"][row], abs=1e-12)
        assert model.key_qvel[key, 6:] == pytest.approx(motion["joint_velocity"][row], abs=1e-12)
        assert model.key_ctrl[key] == pytest.approx(motion["joint_torque"][row], abs=1e-12)


@pytest.mark.parametrize("rate", [[], ["--rate", "50"], ["--effort"]], ids=["nodes", "even", "effort"])
def test_messages_are_those_of_ros(command, smooth_folder, rate):
    import yaml
    from rosbags.typesys import Stores, get_typestore

    export(command, smooth_folder, "joint-trajectory", *rate)
    message = yaml.safe_load((smooth_folder / "joint_trajectory.yaml").read_text())
    goal = yaml.safe_load((smooth_folder / "follow_joint_trajectory.yaml").read_text())
    assert goal["trajectory"] == message
    assert set(goal) == {"trajectory", "path_tolerance", "goal_tolerance", "goal_time_tolerance"}

    store = get_typestore(Stores.ROS2_HUMBLE)
    of = lambda name: store.types[name]  # noqa: E731
    Duration = of("builtin_interfaces/msg/Duration")
    Point = of("trajectory_msgs/msg/JointTrajectoryPoint")
    points = [
        Point(
            **{key: np.array(point[key]) for key in ("positions", "velocities", "accelerations", "effort")},
            time_from_start=Duration(**point["time_from_start"]),
        )
        for point in message["points"]
    ]
    assert all(set(point) == set(Point.__dataclass_fields__) - {"__msgtype__"} for point in message["points"])
    header = of("std_msgs/msg/Header")(
        stamp=of("builtin_interfaces/msg/Time")(**message["header"]["stamp"]), frame_id=""
    )
    trajectory = of("trajectory_msgs/msg/JointTrajectory")(
        header=header, joint_names=message["joint_names"], points=points
    )
    wire = store.serialize_cdr(trajectory, "trajectory_msgs/msg/JointTrajectory")
    read = store.deserialize_cdr(wire, "trajectory_msgs/msg/JointTrajectory")

    solution = json.loads((smooth_folder / "solution.json").read_text())
    assert read.joint_names == [joint["name"] for joint in solution["joints"]]
    times = [p.time_from_start.sec + 1e-9 * p.time_from_start.nanosec for p in read.points]
    assert np.all(np.diff(times) > 0)
    assert times[-1] == pytest.approx(solution["trajectory"]["t"][-1], abs=1e-9)
    assert len(times) == (1001 if "--rate" in rate else len(solution["trajectory"]["t"]))
    # joint_trajectory_controller refuses a motion that does not end at rest, and efforts unless it commands them.
    assert np.all(np.abs(read.points[-1].velocities) <= np.finfo(np.float32).eps)
    efforts = solution["trajectory"]["joint_torque"][-1] if "--effort" in rate else []
    assert read.points[-1].effort == pytest.approx(efforts, abs=1e-12)
    assert read.points[-1].positions == pytest.approx(solution["trajectory"]["joint_position"][-1], abs=1e-12)


def test_tables_say_names_and_units(command, smooth_folder, pandas):
    import pyarrow.parquet

    for kind in ("csv", "parquet"):
        export(command, smooth_folder, kind, "--rate", "20")
    text = pandas.read_csv(smooth_folder / "motion.csv")
    table = pandas.read_parquet(smooth_folder / "motion.parquet")
    assert len(text) == len(table) == 401
    metadata = pyarrow.parquet.read_metadata(smooth_folder / "motion.parquet").metadata
    units = json.loads(metadata[b"units"])
    assert [f"{name} [{units[name]}]" for name in table.columns] == list(text.columns)
    assert np.array_equal(table.to_numpy(), text.to_numpy())
    assert metadata[b"status"] == b"solved"
    assert json.loads(metadata[b"provenance"])["version"]


def test_samples_are_those_of_the_package(command, smooth_folder, pandas):
    import ffsm_ipopt as ffsm

    command("sample", smooth_folder / "solution.json", "--rate", "5")
    table = pandas.read_csv(smooth_folder / "motion.csv")
    solution = ffsm.Solution.load(smooth_folder / "solution.json")
    motion = solution.sample(table["time [s]"].to_numpy())
    positions = table.filter(like="joint_position.").to_numpy()
    assert np.allclose(positions, motion.joint_position, rtol=0, atol=1e-12)
    assert os.path.getsize(smooth_folder / "motion.csv") > 1000
