"""Where obstacles are, when."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from elbowroom._samples import Floats
from elbowroom._scene import Obstacle, ObstacleMotion, Pair, Scene


def shifts(motion: ObstacleMotion | None, t: Floats) -> Floats:
    """Return how far an obstacle on a known course is from where the scene has it at ``t`` (s), ``(n, 2)`` (m)."""
    if motion is not None and motion.waypoints is not None:
        times = np.array([time for time, _ in motion.waypoints])
        places = np.array([shift for _, shift in motion.waypoints], dtype=np.float64)
        return np.column_stack([np.interp(t, times, places[:, axis]) for axis in (0, 1)])
    if motion is not None and motion.velocity is not None:
        going = np.maximum(t - motion.start, 0.0)
        return np.column_stack([going * rate for rate in motion.velocity])
    return np.zeros((len(t), 2))


def shifted(obstacle: Obstacle, by: Pair) -> Obstacle:
    """Return ``obstacle`` as a static one, offset by so much (m)."""
    return obstacle.shifted(by).replace(motion=None)


def as_recorded(scene: Scene, recorded: Mapping[int, Sequence[tuple[float, Pair]]]) -> Scene:
    """Return ``scene`` with obstacles on the trajectories ``recorded``: times (s) and offsets (m), by their index."""
    obstacles = list(scene.obstacles)
    for index, points in recorded.items():
        motion = ObstacleMotion(waypoints=_without_needless(points))
        obstacles[index] = obstacles[index].replace(motion=motion)
    return scene.replace(obstacles=tuple(obstacles))


def _without_needless(points: Sequence[tuple[float, Pair]]) -> list[tuple[float, Pair]]:
    """Leave out the points at which an obstacle just goes on standing."""
    last = len(points) - 1
    return [
        point
        for i, point in enumerate(points)
        if i in (0, last) or not points[i - 1][1] == point[1] == points[i + 1][1]
    ]
