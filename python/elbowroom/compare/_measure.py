"""How long a motion is: the same measure for every planner."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elbowroom._core import Motion
from elbowroom._scene import Scene

NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
PARTS = 64
"""Each piece is integrated in so many equal parts: where the tip all but stops to reverse, its speed has a kink."""


@dataclass(frozen=True)
class Lengths:
    """Of a motion: travel of the tip (m), of the joints (rad, Euclidean), and time (s)."""

    tip: float
    joint: float
    time: float

    def by(self, objective: str) -> float:
        """Return the one that ``objective`` goes by."""
        return float(getattr(self, objective))


def lengths(scene: Scene, motion: Motion) -> Lengths:
    """Return how long ``motion`` is, by Gauss-Legendre quadrature over its pieces."""
    durations = np.asarray(motion.durations, dtype=np.float64)
    if not durations.size:
        return Lengths(0.0, 0.0, float(motion.duration))
    parts = np.repeat(durations / PARTS, PARTS)
    begins = (motion.starts[:, None] + durations[:, None] / PARTS * np.arange(PARTS)).ravel()
    times = begins[:, None] + parts[:, None] * (NODES + 1.0) / 2.0
    weights = (parts[:, None] * WEIGHTS / 2.0).ravel()
    q, v, _, _ = motion.sample(times.ravel())
    angles, turning = np.cumsum(q, axis=1), np.cumsum(v, axis=1)
    links = np.asarray(scene.arm.links)
    speed = np.hypot((links * turning * np.sin(angles)).sum(axis=1), (links * turning * np.cos(angles)).sum(axis=1))
    # Not a dot product: how BLAS adds up depends on its threads.
    tip, joint = (float(np.sum(weights * rate)) for rate in (speed, np.linalg.norm(v, axis=1)))
    return Lengths(tip, joint, float(motion.duration))
