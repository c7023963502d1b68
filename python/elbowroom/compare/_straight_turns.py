"""Times a path of straight joint motions, at rest at each corner, as fast as the motion limits allow."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from elbowroom._core import ASSUMED_LIMITS, TICK
from elbowroom._scene import Scene
from elbowroom.planners import Proposal

STEEPEST = {"velocity": (15.0 / 8.0, 1), "acceleration": (10.0 / math.sqrt(3.0), 2), "jerk": (60.0, 3)}
"""Greatest rates of the quintic from 0 to 1 in time 1, at rest at both ends; and the power of the time they fall by."""


def straight_turns(
    scene: Scene,
    corners: ArrayLike,
    *,
    evaluations: int | None = None,
    lower_bound: float | None = None,
    timings: Mapping[str, float] | None = None,
    convergence: Sequence[tuple[int, float]] | None = None,
) -> Proposal:
    """Return the path through ``corners`` as a trajectory: for plug-ins whose planners know no time.

    Every straight joint motion is a quintic at rest at both ends, so the joints move along straight lines, and lasts
    whole ticks of 10 ms. Motion limits that the scene does not state are assumed, as for elbowroom's own planners.

    Args:
        scene: Its arm has the motion limits.
        corners: Configurations, shape ``(n, joints)`` (rad); continuous joints count on instead of jumping.
        evaluations: For the proposal, like the others.
        lower_bound: Likewise.
        timings: Likewise.
        convergence: Likewise.
    """
    q = np.array(corners, dtype=np.float64)
    if q.ndim != 2 or not len(q):
        raise ValueError(f"corners have shape {q.shape}, at least one configuration is needed")
    turns = np.abs(np.diff(q, axis=0))
    durations = np.array([_duration(scene, turn) for turn in turns])
    kept = np.concatenate([[True], durations > 0.0])
    t = np.concatenate([[0.0], np.cumsum(durations)])[kept]
    rest = np.zeros_like(q[kept])
    return Proposal(
        t=t,
        q=q[kept],
        v=rest,
        a=rest,
        evaluations=evaluations,
        lower_bound=lower_bound,
        timings=timings or {},
        convergence=convergence,
    )


def _duration(scene: Scene, turn: Any) -> float:
    longest = 0.0
    for joint, angle in zip(scene.arm.joints, turn.tolist(), strict=True):
        for rate, (steepest, power) in STEEPEST.items():
            stated = getattr(joint, rate)
            limit = ASSUMED_LIMITS[rate] if stated is None else stated
            longest = max(longest, (angle * steepest / limit) ** (1.0 / power))
    # A hair more than a whole number of ticks is that number: rounding, not motion.
    return TICK * math.ceil(longest / TICK - 1e-9)
