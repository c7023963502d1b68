"""toppra and ruckig through waypoints, and their answers as rows."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SAME = 1e-6
"""Changes of jerk that are no farther apart are one (s)."""


def by_toppra(vias: Floats, limits: Floats, parametrizer: str) -> Callable[[], Any]:
    """Return what times a cubic spline through ``vias`` by TOPP-RA under the limits on velocity and acceleration.

    ``limits`` are those of ``motion_limits.limits_of``.
    """
    import toppra
    from toppra import algorithm, constraint

    toppra.setup_logging("ERROR")
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(vias, axis=0), axis=1))])
    bounds = [constraint.JointVelocityConstraint(limits[0]), constraint.JointAccelerationConstraint(limits[1])]

    def timed() -> Any:
        path = toppra.SplineInterpolator(along, vias)
        found = algorithm.TOPPRA(bounds, path, parametrizer=parametrizer).compute_trajectory()
        if found is None:
            raise RuntimeError("toppra found no trajectory")
        return found

    return timed


def toppra_rows(found: Any, period: float) -> tuple[Floats, Floats, Floats, Floats]:
    """Return times, positions, velocities and accelerations about every ``period`` (s)."""
    t = np.linspace(0.0, found.duration, 1 + int(np.ceil(found.duration / period)))
    return t, found(t), found(t, 1), found(t, 2)


def by_ruckig(vias: Floats, limits: Floats) -> Callable[[], list[Any]]:
    """Return what turns straight from stop to stop: passing through vias is left to ruckig's cloud service, which is
    not asked.
    """
    from ruckig import InputParameter, Result, Ruckig, Synchronization, Trajectory

    joints = vias.shape[1]

    def timed() -> list[Any]:
        otg, pieces = Ruckig(joints), []
        for here, there in pairwise(vias):
            given = InputParameter(joints)
            given.current_position, given.target_position = here.tolist(), there.tolist()
            given.max_velocity, given.max_acceleration, given.max_jerk = limits.tolist()
            given.synchronization = Synchronization.Phase
            piece = Trajectory(joints)
            if otg.calculate(given, piece) not in (Result.Working, Result.Finished):
                raise RuntimeError("ruckig found no trajectory")
            pieces.append(piece)
        return pieces

    return timed


def ruckig_rows(pieces: list[Any], period: float) -> tuple[Floats, Floats, Floats, Floats]:
    """Return times, positions, velocities and accelerations about every ``period`` (s), and at every stop."""
    return _rows_at(
        pieces,
        [np.linspace(0.0, piece.duration, 1 + int(np.ceil(piece.duration / period))) for piece in pieces],
    )


def ruckig_knots(pieces: list[Any]) -> tuple[Floats, Floats, Floats, Floats]:
    """Return the same wherever a jerk changes: quintics between these rows are ruckig's own motion."""
    knots = []
    for piece in pieces:
        changes = np.concatenate([np.cumsum(profile.t) for profile in piece.profiles[0]])
        at = np.unique(np.clip(np.concatenate([[0.0], changes]), 0.0, piece.duration))
        at = at[np.append(True, np.diff(at) > SAME)]
        at[-1] = piece.duration
        knots.append(at)
    return _rows_at(pieces, knots)


def _rows_at(pieces: list[Any], instants: list[Floats]) -> tuple[Floats, Floats, Floats, Floats]:
    t: list[float] = []
    rows: list[list[list[float]]] = []
    begin = 0.0
    for piece, at_times in zip(pieces, instants, strict=True):
        for at in at_times[bool(t) :]:
            t.append(begin + at)
            rows.append(list(piece.at_time(at)))
        begin += piece.duration
    q, v, a = (np.array([row[of] for row in rows]) for of in range(3))
    return np.array(t), q, v, a
