"""Waypoints for those who time a path and do not plan: few corners of a motion of ours."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

import elbowroom as er

Floats = NDArray[np.float64]

CLEARANCES = (0.01, 0.005, 0.002, 0.0)
"""What the motion that waypoints are taken from keeps (m): the first for which there is one."""

COARSEST, FINEST = 0.2, 1e-4
"""Between what waypoints stand off that motion (rad)."""


def waypoints(scene: er.Scene, task: str, *, otherwise: er.Plan) -> Floats:
    """Return the joint path of a motion of ours that keeps a clearance, simplified to few corners that are free.

    Where none is, they are those of ``otherwise``.
    """
    for clearance in CLEARANCES:
        try:
            plan = er.plan(scene, task=task, objective="time", clearance=clearance)
        except (er.NotFree, er.NoPath, er.NotFound):
            continue
        path, within = plan.configurations, COARSEST
        while within > FINEST:
            corners = simplified(path, within)
            if scene.link_clearances(densely(corners)).min() > 0.0:
                return corners
            within /= 2.0
    return otherwise.configurations


def simplified(path: Floats, within: float) -> Floats:
    """Return corners of a polyline that stays ``within`` (rad) of ``path``, as Douglas and Peucker choose them."""
    chord = path[-1] - path[0]
    length = float(chord @ chord)
    share = (path - path[0]) @ chord / length if length > 0.0 else np.zeros(len(path))
    off = np.linalg.norm(path - path[0] - np.clip(share, 0.0, 1.0)[:, None] * chord, axis=1)
    at = int(off.argmax())
    if off[at] <= within:
        return path[[0, -1]]
    return np.concatenate([simplified(path[: at + 1], within)[:-1], simplified(path[at:], within)])


def densely(corners: Floats) -> Floats:
    """Return configurations along straight joint motions between ``corners``."""
    u = np.linspace(0.0, 1.0, 200)[:, None]
    return np.concatenate([here + u * (there - here) for here, there in pairwise(corners)])
