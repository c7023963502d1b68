"""A scene in time, to try a replanner in."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from elbowroom import _core
from elbowroom._errors import BadSetting
from elbowroom._known import Known, Sighting
from elbowroom._samples import Floats
from elbowroom._scene import Pair, Scene


class World:
    """The obstacles of a scene in time, from 0 s on: where they are, and what the arm knows of them.

    Raises:
        BadSetting: The scene's arm has more than two links.
    """

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self._core = _core.World(scene)

    @property
    def now(self) -> float:
        """What time it is (s)."""
        return self._core.now

    @property
    def shifts(self) -> dict[int, tuple[float, float]]:
        """How far each obstacle that moves is from where the scene has it (m), by its place among the obstacles."""
        movers = [i for i, obstacle in enumerate(self.scene.obstacles) if obstacle.motion is not None]
        return {i: (x, y) for i, (x, y) in zip(movers, self._core.shifts.tolist(), strict=True)}

    def advance(self, now: float, *, q: ArrayLike) -> None:
        """Let time go on to ``now`` (s) while the arm is at ``q`` (rad): obstacles that chase go after its tip.

        Raises:
            BadSetting: Time would go back, or ``q`` is no configuration.
        """
        if not (math.isfinite(now) and now >= self.now):
            raise BadSetting(f"now is {now} s; the world is at {self.now} s already", setting="now")
        self._core.advance(now, q=joint_values("q", q))

    def known(self, *, q: ArrayLike) -> dict[int, Known]:
        """Return what the arm, which is at ``q`` (rad), knows of each obstacle that moves, by its place among them all.

        Raises:
            BadSetting: ``q`` is no configuration.
        """
        found = self._core.known(q=joint_values("q", q))
        return {index: _sighting(*part) if isinstance(part, tuple) else part for index, part in found}


def _sighting(shift: Pair, time: float, greatest_speed: float) -> Sighting:
    return Sighting(shift=shift, time=time, greatest_speed=greatest_speed)


def joint_values(name: str, values: ArrayLike) -> Floats:
    """Return ``values``, one per joint, as an array.

    Raises:
        BadSetting: They are no such numbers; ``name`` is what the message calls them.
    """
    try:
        array = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise BadSetting(f"{name} must be numbers, one per joint", setting=name) from None
    if array.ndim != 1:
        raise BadSetting(f"{name} has shape {array.shape}; one number per joint is needed", setting=name)
    return array
