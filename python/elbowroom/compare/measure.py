"""How long a motion is, and whether it does its task: the same measure for every planner."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from elbowroom._core import Motion, Verdict
from elbowroom.scene import Configuration, Place, Scene

NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
PARTS = 64
"""Each piece is integrated in so many equal parts: where the tip all but stops to turn, its speed has a kink."""

NEAR_ENOUGH = 1e-6
"""How far from its place a motion may begin or end (m, rad): room for rounding in files and unit conversions."""


@dataclass(frozen=True)
class Lengths:
    """Of a motion: travel of the tip (m), of the joints (rad, Euclidean), and time (s)."""

    tip: float
    joint: float
    time: float

    def by(self, objective: str) -> float:
        """Return the one that ``objective`` goes by."""
        return {"tip": self.tip, "joint": self.joint, "time": self.time}[objective]


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
    return Lengths(float(weights @ speed), float(weights @ np.linalg.norm(v, axis=1)), float(motion.duration))


def misses(scene: Scene, task: str, motion: Motion, verdict: Verdict) -> str | None:
    """Return how ``motion`` fails to do ``task``, or None if it does it."""
    asked = scene.tasks[task]
    q = motion.sample(np.array([0.0, motion.duration]))[0]
    for name, place, at in (("start", asked.start, q[0]), ("goal", asked.goal, q[1])):
        if away := _away(scene, place, at):
            return f"the motion is {away} from the {name}"
    if q.shape[1] != 2:
        # Postures are those of two links.
        return None
    bend = math.remainder(float(q[1][1]), math.tau)
    if asked.posture == "up" and bend > NEAR_ENOUGH:
        return "the motion ends elbow-down, the task asks for elbow-up"
    if asked.posture == "down" and bend < -NEAR_ENOUGH:
        return "the motion ends elbow-up, the task asks for elbow-down"
    if asked.posture == "keep" and verdict.posture_changes:
        return f"the posture changes at {verdict.posture_changes[0]:.3f} s, the task asks to keep it"
    return None


def _away(scene: Scene, place: Place, q: np.ndarray[tuple[int], np.dtype[np.float64]]) -> str | None:
    if isinstance(place, Configuration):
        turns = [
            math.remainder(at - asked, math.tau) if joint.continuous else at - asked
            for at, asked, joint in zip(q.tolist(), place.q, scene.arm.joints, strict=True)
        ]
        farthest = max(map(abs, turns))
        return f"{farthest:.6g} rad" if farthest > NEAR_ENOUGH else None
    tip = scene.core.link_ends(np.ascontiguousarray(q[None]))[0, -1]
    distance = math.dist(tip, place)
    return f"{distance:.6g} m" if distance > NEAR_ENOUGH else None
