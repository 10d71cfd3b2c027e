#!/usr/bin/env python3
"""Plays motion.csv in model.xml: the joints are driven along the plan, the base is free.

    play.py           how far the base ends from where the plan has it
    play.py --view    the same in MuJoCo's viewer, in real time

Needs MuJoCo and NumPy (pip install mujoco). The joints follow the plan by computed torques with feedback
that makes up for rounding; no force or torque acts on the base, so that it goes where the joints' motion
takes it.
"""

import argparse
import csv
import math
import pathlib
import sys
import time

import mujoco
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
RATE = 40.0  # rad/s, of the critically damped feedback


class Motion:
    """The plan between its rows, by cubics through positions and velocities."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            names, *rows = csv.reader(file)
        table = np.array(rows, dtype=float)
        by_name = dict(zip((name.rsplit(" [", 1)[0] for name in names), table.T))

        def columns(start):
            return np.column_stack([by_name[name] for name in by_name if name.startswith(start)])

        self.t = by_name["time"]
        self.position = columns("joint_position.")
        self.velocity = columns("joint_velocity.")
        self.base_position = columns("base_position.")
        self.base_quaternion = columns("base_quaternion.")
        self.base_velocity = columns("base_velocity.")
        self.base_angular_velocity = columns("base_angular_velocity.")

    def joints(self, t):
        """Positions, velocities and accelerations of the joints."""
        k = int(np.clip(np.searchsorted(self.t, t, side="right") - 1, 0, len(self.t) - 2))
        h = self.t[k + 1] - self.t[k]
        s = min(max((t - self.t[k]) / h, 0.0), 1.0)
        p, q = self.position[k], self.position[k + 1]
        v, w = h * self.velocity[k], h * self.velocity[k + 1]
        a, b = 3 * (q - p) - 2 * v - w, 2 * (p - q) + v + w
        return (
            p + s * (v + s * (a + s * b)),
            (v + s * (2 * a + 3 * s * b)) / h,
            (2 * a + 6 * s * b) / h**2,
        )


def mass_matrix(model, data, full):
    """The mass matrix into ``full``."""
    try:
        mujoco.mj_fullM(model, data, full)
    except TypeError:  # before MuJoCo 4
        mujoco.mj_fullM(model, full, data.qM)


def driver(model, motion):
    """A callback that drives the joints."""
    full = np.zeros((model.nv, model.nv))

    def drive(_, data):
        position, velocity, acceleration = motion.joints(data.time)
        wanted = acceleration + RATE**2 * (position - data.qpos[7:]) + 2 * RATE * (velocity - data.qvel[6:])
        mass_matrix(model, data, full)
        bias = data.qfrc_bias
        base = np.linalg.solve(full[:6, :6], -full[:6, 6:] @ wanted - bias[:6])
        data.ctrl[:] = full[6:, :6] @ base + full[6:, 6:] @ wanted + bias[6:]

    return drive


def start(model, motion):
    """The state at the first row."""
    data = mujoco.MjData(model)
    data.time = motion.t[0]
    data.qpos[:3], data.qpos[3:7] = motion.base_position[0], motion.base_quaternion[0]
    data.qvel[:3], data.qvel[3:6] = motion.base_velocity[0], motion.base_angular_velocity[0]
    data.qpos[7:], data.qvel[6:] = motion.position[0], motion.velocity[0]
    mujoco.mj_forward(model, data)
    return data


def angle(a, b):
    """Angle between two orientations, degrees."""
    difference, inverse, both = np.zeros(4), np.zeros(4), np.zeros(3)
    mujoco.mju_negQuat(inverse, a)
    mujoco.mju_mulQuat(difference, inverse, b)
    mujoco.mju_quat2Vel(both, difference, 1.0)
    return math.degrees(np.linalg.norm(both))


def play(model, motion, each=lambda data: None):
    """Plays all; the largest gap of a joint on the way."""
    data, longest, gap = start(model, motion), model.opt.timestep, 0.0
    for begin, end in zip(motion.t[:-1], motion.t[1:]):
        # Whole steps between two rows, since the plan may bend there.
        steps = max(1, math.ceil((end - begin) / longest))
        model.opt.timestep = (end - begin) / steps
        for _ in range(steps):
            mujoco.mj_step(model, data)
            each(data)
        gap = max(gap, np.abs(motion.joints(end)[0] - data.qpos[7:]).max())
    model.opt.timestep = longest
    return data, gap


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--view", action="store_true", help="show it")
    arguments = parser.parse_args()
    model = mujoco.MjModel.from_xml_path(str(HERE / "model.xml"))
    motion = Motion(HERE / "motion.csv")
    mujoco.set_mjcb_control(driver(model, motion))
    try:
        if arguments.view:
            from mujoco import viewer as viewers

            shown = start(model, motion)
            with viewers.launch_passive(model, shown) as viewer:

                def show(data):
                    if not viewer.is_running():
                        sys.exit(0)
                    shown.qpos[:], shown.time = data.qpos, data.time
                    mujoco.mj_kinematics(model, shown)
                    viewer.sync()
                    time.sleep(model.opt.timestep)

                data, gap = play(model, motion, show)
        else:
            data, gap = play(model, motion)
    finally:
        mujoco.set_mjcb_control(None)
    print(f"joints off the plan by at most {gap:.2e}")
    print(f"base turned by {angle(motion.base_quaternion[0], data.qpos[3:7]):.6f} deg")
    print(f"  in the plan {angle(motion.base_quaternion[0], motion.base_quaternion[-1]):.6f} deg")
    print(f"  off by {angle(motion.base_quaternion[-1], data.qpos[3:7]):.2e} deg")
    print(f"base off by {np.linalg.norm(motion.base_position[-1] - data.qpos[:3]):.2e} m")


if __name__ == "__main__":
    main()
