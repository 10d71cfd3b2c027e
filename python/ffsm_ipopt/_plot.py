"""Charts of a motion."""

from typing import Any, Tuple

import numpy as np

from .trajectory import Trajectory


def figure(motion: Trajectory, joint_names: Tuple[str, ...]) -> Any:
    """Four charts below each other, one time axis."""
    from matplotlib import pyplot

    quaternion = motion.base_attitude.shape[-1] == 4
    attitude = motion.base_attitude if quaternion else np.degrees(motion.base_attitude)
    charts = (
        ("base attitude" + ("" if quaternion else " (°)"), attitude, ()),
        ("joint position (rad, m)", motion.joint_position, joint_names),
        ("joint rate (rad/s, m/s)", motion.joint_velocity, joint_names),
        ("torque (N·m, N)", motion.joint_torque, joint_names),
    )
    drawn, axes = pyplot.subplots(len(charts), sharex=True, figsize=(8, 9), layout="constrained")
    for axis, (label, values, names) in zip(axes, charts):
        lines = axis.plot(np.atleast_1d(motion.t), np.atleast_2d(values), "." if motion.t.ndim == 0 else "-")
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
        if names:
            axis.legend(lines, names, fontsize="small", loc="center left", bbox_to_anchor=(1.0, 0.5))
    axes[-1].set_xlabel("time (s)")
    return drawn
