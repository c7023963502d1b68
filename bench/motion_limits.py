"""Motion limits of a scene, the missing ones as planners assume them: peers get them, answers are judged by them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from elbowroom._core import ASSUMED_LIMITS

RATES = ("velocity", "acceleration", "jerk")


def limits_of(scene: er.Scene) -> NDArray[np.float64]:
    """Return greatest velocities, accelerations and jerks, shape ``(3, joints)`` (rad/s, rad/s², rad/s³)."""
    return np.array(
        [
            [ASSUMED_LIMITS[rate] if (own := getattr(joint, rate)) is None else own for joint in scene.arm.joints]
            for rate in RATES
        ]
    )


def with_limits(scene: er.Scene) -> er.Scene:
    """Return ``scene`` with all its motion limits stated, so that they are judged."""
    stated = [
        joint.replace(velocity=velocity, acceleration=acceleration, jerk=jerk)
        for joint, (velocity, acceleration, jerk) in zip(scene.arm.joints, limits_of(scene).T.tolist(), strict=True)
    ]
    return scene.replace(arm=scene.arm.replace(joints=stated))
