"""How near the arm came to each obstacle."""

from __future__ import annotations

import numpy as np

from elbowroom._numbered import called_obstacle
from elbowroom._samples import Floats
from elbowroom.follow._courses import shifted, shifts
from elbowroom.follow._followed import Followed


def clearances(followed: Followed) -> dict[str, Floats]:
    """Return the arm's clearance over the samples from each obstacle that moves, by what it is called, and from those
    that are static together (m).
    """
    scene, samples = followed.true_scene, followed.samples
    still = [obstacle for obstacle in scene.obstacles if obstacle.motion is None]
    found: dict[str, Floats] = {}
    for i, obstacle in enumerate(scene.obstacles):
        if obstacle.motion is not None:
            places = shifts(obstacle.motion, samples.t).tolist()
            found[called_obstacle(i, obstacle.name)] = np.array(
                [
                    scene.replace(obstacles=[shifted(obstacle, (x, y))], tasks={}).link_clearances(q).min()
                    for (x, y), q in zip(places, samples.q[:, np.newaxis], strict=True)
                ]
            )
    if still:
        found["static obstacles"] = scene.replace(obstacles=still).link_clearances(samples.q).min(axis=1)
    return found
