"""What is around all that a start can reach, where it is proved that there is no path."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from elbowroom._errors import NoPath
from elbowroom._numbered import called_obstacle
from elbowroom._samples import Floats
from elbowroom._scene import Scene

POINTS = 181
"""Angles of each joint that are sampled: this is to name what is there, the proof does not rest on it."""

MOST_NAMED = 4
"""So many obstacles are named, those with the longest walls."""


def reachable_cells(scene: Scene, proof: NoPath) -> list[Floats]:
    """Return the cells that can be reached (rad), of continuous joints in the revolutions around too."""
    cells = [np.array(cell) for cell in proof.reachable]
    for j, joint in enumerate(scene.arm.joints):
        if joint.continuous:
            shifts = [np.eye(2)[j] * turn for turn in (-2.0 * np.pi, 0.0, 2.0 * np.pi)]
            cells = [cell + shift for cell in cells for shift in shifts]
    return cells


def walls_in_words(scene: Scene, proof: NoPath) -> str:
    """Return which obstacles, and whether joint limits, are around all that the start can reach; empty if none is."""
    cells = reachable_cells(scene, proof)
    corners = np.vstack([np.array(cell) for cell in proof.reachable])
    low, high = corners.min(axis=0), corners.max(axis=0)
    step = np.maximum((high - low) / POINTS, 1e-6)
    axes = [np.linspace(low[j] - 2 * step[j], high[j] + 2 * step[j], POINTS) for j in (0, 1)]
    q1, q2 = np.meshgrid(*axes)
    places = np.column_stack([q1.ravel(), q2.ravel()])
    reached = _covered(axes, cells)
    ring = (_grown(_grown(reached)) & ~reached).ravel()
    lengths = {}
    for i, obstacle in enumerate(scene.obstacles):
        alone = scene.replace(obstacles=[obstacle], tasks={})
        touching = int(np.count_nonzero(alone.link_clearances(places[ring]).min(axis=1) <= proof.clearance))
        if touching:
            lengths[called_obstacle(i, obstacle.name)] = touching
    named = sorted(lengths, key=lambda called: -lengths[called])
    words = named[:MOST_NAMED]
    if len(named) > MOST_NAMED:
        words.append(f"{len(named) - MOST_NAMED} more")
    if _limits_are_near(scene, low, high, step):
        words.append("joint limits")
    return ", ".join(words)


def _covered(axes: Sequence[Floats], cells: Iterable[Floats]) -> NDArray[np.bool_]:
    """Which points of a grid lie in one of ``cells``; each is asked of the points near it alone."""
    covered: NDArray[np.bool_] = np.zeros((len(axes[1]), len(axes[0])), dtype=bool)
    for cell in cells:
        columns, rows = (
            slice(np.searchsorted(axis, cell[:, j].min()), np.searchsorted(axis, cell[:, j].max(), side="right"))
            for j, axis in enumerate(axes)
        )
        near = np.stack(np.meshgrid(axes[0][columns], axes[1][rows]), axis=-1)
        covered[rows, columns] |= _within(near.reshape(-1, 2), cell).reshape(near.shape[:2])
    return covered


def _within(places: Floats, cell: Floats) -> NDArray[np.bool_]:
    """Which of ``places`` lie in the convex ``cell``, whose corners go round counter-clockwise."""
    along = np.roll(cell, -1, axis=0) - cell
    away = places[:, None, :] - cell
    left_of = along[:, 0] * away[..., 1] - along[:, 1] * away[..., 0]
    inside: NDArray[np.bool_] = np.greater_equal(left_of.min(axis=1), 0.0)
    return inside


def _grown(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """``mask`` and its neighbours."""
    padded = np.pad(mask, 1)
    around = [padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]]
    grown: NDArray[np.bool_] = np.greater(np.sum([mask, *around], axis=0), 0)
    return grown


def _limits_are_near(scene: Scene, low: Floats, high: Floats, step: Floats) -> bool:
    return any(
        joint.min is not None
        and joint.max is not None
        and (low[j] - joint.min < step[j] or joint.max - high[j] < step[j])
        for j, joint in enumerate(scene.arm.joints)
    )
