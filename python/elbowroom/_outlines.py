"""Obstacles as points with a radius: where they are, and how far from them other points are."""

from __future__ import annotations

import numpy as np

from elbowroom._samples import Floats
from elbowroom._scene import Obstacle


def middle(obstacle: Obstacle) -> Floats:
    """Return the middle of ``obstacle`` where the scene has it (m): that of its box."""
    corners = np.array(obstacle.outline[0])
    centre: Floats = (corners.min(axis=0) + corners.max(axis=0)) / 2.0
    return centre


def distances_to_lines(points: Floats, corners: Floats) -> Floats:
    """Return how far each of ``points``, shape ``(n, 2)``, is from the lines round ``corners``, shape ``(k, 2)``: of
    one corner from that, of two from the line between them.
    """
    ends = np.roll(corners, -1, axis=0)
    along = ends - corners
    lengths = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    away = points[:, None, :] - corners
    shares = np.clip((away * along).sum(axis=2) / lengths, 0.0, 1.0)
    found: Floats = np.linalg.norm(away - shares[..., None] * along, axis=2).min(axis=1)
    return found
