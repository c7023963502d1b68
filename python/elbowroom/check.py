"""Judges anybody's trajectory."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from elbowroom import _core
from elbowroom._core import Check
from elbowroom.errors import TrajectoryError
from elbowroom.scene import Scene
from elbowroom.trajectory_files import TrajectorySamples, read_trajectory


def check(
    scene: Scene,
    *,
    t: ArrayLike,
    q: ArrayLike,
    v: ArrayLike | None = None,
    a: ArrayLike | None = None,
    margin: float = 0.0,
    timeout: float | None = None,
) -> Check:
    """Return the verifier's answer on a trajectory given by samples.

    Args:
        scene: Arm and obstacles.
        t: Times, ascending, shape ``(n,)`` (s).
        q: Configurations, shape ``(n, joints)`` (rad).
        v: Velocities, if known, shape ``(n, joints)`` (rad/s).
        a: Accelerations, if known, shape ``(n, joints)`` (rad/s²).
        margin: Clearance to keep (m).
        timeout: When to give up (s).

    Raises:
        TrajectoryError: The samples make no motion of this arm.
        TimedOut: The timeout came first.
    """
    arrays = [None if x is None else np.ascontiguousarray(x, dtype=np.float64) for x in (q, v, a)]
    motion, curve = _core.interpolated(np.ascontiguousarray(t, dtype=np.float64), *arrays)  # type: ignore[arg-type]
    return _core.verify(scene, motion, curve=curve, margin=margin, timeout=timeout)


def check_file(
    scene: Scene,
    path: str | Path,
    *,
    joints: Sequence[str] | None = None,
    margin: float = 0.0,
    timeout: float | None = None,
) -> Check:
    """Return the verifier's answer on the trajectory in the file at ``path``: our CSV, or a JointTrajectory.

    Args:
        scene: Arm and obstacles.
        path: CSV with ``time_s,q1_rad,q2_rad,...`` and, if known, ``v1_rad_s,...`` and ``a1_rad_s2,...``; or a JSON or
            YAML dump of a ROS 2 ``trajectory_msgs/JointTrajectory``.
        joints: The joints' names in a JointTrajectory, base first, where they do not end in 1, 2, ...
        margin: Clearance to keep (m).
        timeout: When to give up (s).

    Raises:
        TrajectoryError: The file cannot be read or is no trajectory of this arm.
        TimedOut: The timeout came first.
    """
    try:
        samples: TrajectorySamples = read_trajectory(Path(path), joints=len(scene.arm.joints), names=joints)
        return check(scene, t=samples.t, q=samples.q, v=samples.v, a=samples.a, margin=margin, timeout=timeout)
    except TrajectoryError as error:
        raise TrajectoryError(f"{path}: {error}") from None
