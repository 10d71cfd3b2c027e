"""A motion over time."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import pandas

Array = npt.NDArray[np.float64]


class Trajectory(NamedTuple):
    """A motion at N times; n joints, and the base in m dimensions: 2 in the plane, else 3.

    The arrays cannot be written to. Of a single time they lack the first axis.
    """

    #: Times, s; (N,).
    t: Array
    #: Base attitude; (N, 1) angle in the plane, else (N, 3) angles or Rodrigues parameters, (N, 4)
    #: quaternion; rad where they are angles.
    base_attitude: Array
    #: Base position relative to the system's mass centre, inertial axes, m; (N, m).
    base_position: Array
    #: Rates of the attitude angles, or the angular velocity in base axes, rad/s; (N, 1) or (N, 3).
    base_rate: Array
    #: Joint positions, rad or m; (N, n).
    joint_position: Array
    #: Joint rates, rad/s or m/s; (N, n).
    joint_velocity: Array
    #: Controls u = H⁻¹τ, rad/s² or m/s²; (N, n).
    control: Array
    #: Joint torques, N·m, or forces, N; (N, n).
    joint_torque: Array

    def to_pandas(self) -> "pandas.DataFrame":
        """A data frame with the columns of ``trajectory.csv``: t, eta, zeta, th, dth, u, tau, deta, their
        components counted from 1. Needs pandas."""
        import pandas

        quantities = {
            "eta": self.base_attitude,
            "zeta": self.base_position,
            "th": self.joint_position,
            "dth": self.joint_velocity,
            "u": self.control,
            "tau": self.joint_torque,
            "deta": self.base_rate,
        }
        columns = {"t": np.atleast_1d(self.t)}
        for name, rows in quantities.items():
            for component, values in enumerate(np.atleast_2d(rows).T, start=1):
                columns[f"{name}_{component}"] = values
        return pandas.DataFrame(columns)

    def plot(self, joint_names: "tuple[str, ...]" = ()) -> Any:
        """A matplotlib figure of base attitude, joint positions, joint rates and torques over time.

        Needs matplotlib. Angles are drawn in degrees where the attitude is of angles.
        """
        from ._plot import figure

        return figure(self, joint_names)
