"""Where a task ends, computed independently of the planner."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from elbowroom._samples import Samples
from elbowroom._scene import Configuration, Joint, Pair, Place, PostureWish, Scene

NEAR = 1e-6
"""An arm this near to a place and this slow is at rest there (m, rad, rad/s, rad/s²)."""


@dataclass(frozen=True)
class Goal:
    """The goal of a task of a scene: where the tip is there (m), and what else is asked for."""

    tip: Pair
    place: Place
    posture: PostureWish
    joints: tuple[Joint, ...]

    @classmethod
    def of(cls, scene: Scene, task: str) -> Goal:
        """Return the goal of the task called ``task``."""
        asked = scene.tasks[task]
        tip = asked.goal
        if isinstance(tip, Configuration):
            x, y = scene.link_ends(np.array([tip.q], dtype=np.float64))[0, -1].tolist()
            tip = (x, y)
        return cls(tip, asked.goal, asked.posture, tuple(scene.arm.joints))

    def is_at(self, samples: Samples) -> bool:
        """Return whether the arm is at rest at the goal at the first of ``samples``."""
        q = samples.q[0]
        slow = bool(np.all(np.abs(samples.v[0]) < NEAR) and np.all(np.abs(samples.a[0]) < NEAR))
        if not slow or np.hypot(*(samples.tip[0] - self.tip)) > NEAR:
            return False
        if isinstance(self.place, Configuration):
            return all(
                abs(np.remainder(off + np.pi, 2.0 * np.pi) - np.pi if joint.continuous else off) < NEAR
                for off, joint in zip(q - np.array(self.place.q), self.joints, strict=True)
            )
        # The elbow is up where the second joint is negative; with the links in line it is either.
        bend = float(np.sin(q[1]))
        return {"up": bend <= NEAR, "down": bend >= -NEAR}.get(self.posture, True)
