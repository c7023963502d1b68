"""Where the tip may stand: the free Cartesian space of each posture, and of both together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elbowroom import _core
from elbowroom._scene import Scene

STATES = ("free", "out of reach", "joint limit", "collision")
"""What the numbers in ``FreeSpaceMap.state`` mean."""


@dataclass(frozen=True, eq=False)
class FreeSpaceMap:
    """For each grid point whether the tip may stand there in one posture and, if not, why; shape ``(rows, columns)``.

    ``state`` counts into ``STATES``; ``part`` is the joint or link at fault, from 1, else 0; ``obstacle`` the one that
    is hit, from 0, else -1.
    """

    posture: str
    state: NDArray[np.uint8]
    part: NDArray[np.uint8]
    obstacle: NDArray[np.int32]

    @property
    def free(self) -> NDArray[np.bool_]:
        """Where the tip may stand."""
        return np.equal(self.state, 0)


@dataclass(frozen=True, eq=False)
class FreeSpace:
    """The maps of both postures over the grid points ``x`` (columns) and ``y`` (rows) (m).

    ``configurations`` says of each point, in shape ``(rows, columns)``, how many free configurations put the tip there:
    0, 1 or 2; at full stretch both postures are one. ``cases`` counts the points with ``two``, ``one`` and ``none``
    of them: the paper's three cases.
    """

    x: NDArray[np.float64]
    y: NDArray[np.float64]
    elbow_up: FreeSpaceMap
    elbow_down: FreeSpaceMap
    configurations: NDArray[np.uint8]
    cases: dict[str, int]

    @property
    def union(self) -> NDArray[np.bool_]:
        """Where the tip may stand in some posture, shape ``(rows, columns)``."""
        return self.elbow_up.free | self.elbow_down.free


def free_space(scene: Scene, *, timeout: float | None = None) -> FreeSpace:
    """Return the free Cartesian space of ``scene``.

    Raises:
        TimedOut: It took longer than ``timeout`` (s).
    """
    space = _core.free_space(scene, timeout=timeout)
    up, down = (FreeSpaceMap(posture, *space.states(i)) for i, posture in enumerate(("elbow-up", "elbow-down")))
    rows, columns = up.state.shape
    return FreeSpace(
        x=scene.grid.x[0] + scene.grid.step * np.arange(columns, dtype=np.float64),
        y=scene.grid.y[0] + scene.grid.step * np.arange(rows, dtype=np.float64),
        elbow_up=up,
        elbow_down=down,
        configurations=space.configurations,
        cases=space.cases,
    )
