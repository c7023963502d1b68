"""What is known of obstacles that move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from elbowroom._errors import BadSetting
from elbowroom._scene import ObstacleMotion, Pair, Scene


@dataclass(frozen=True, kw_only=True)
class Sighting:
    """An obstacle was seen at ``time`` (s), ``shift`` away from where the scene has it (m); its trajectory is unknown.

    From there it may have gone anywhere at its maximum speed (m/s), that of the scene where none is given.
    """

    shift: Pair
    time: float
    greatest_speed: float | None = None


Known = ObstacleMotion | Sighting | None
"""A known trajectory, an observation, or None: it is not there, as far as anyone knows."""


def all_known(scene: Scene, known: Mapping[int | str, Known]) -> list[tuple[int, Known]]:
    """Return what is known of each obstacle of ``scene`` that moves, by its index among the obstacles.

    One left out of ``known`` has the trajectory that the scene gives it.

    Raises:
        BadSetting: A key is no obstacle that moves, or one is left out whose trajectory the scene does not give.
    """
    names = {obstacle.name: i for i, obstacle in enumerate(scene.obstacles) if obstacle.name is not None}
    movers = {i: obstacle.motion for i, obstacle in enumerate(scene.obstacles) if obstacle.motion is not None}
    given: dict[int, Known] = {}
    for key, value in known.items():
        index = names.get(key) if isinstance(key, str) else key
        if index not in movers:
            listed = ", ".join(_called(scene, i) for i in movers) or "none"
            raise BadSetting(
                f"known: no obstacle of the scene that moves is {key!r}; there are {listed}", setting="known"
            )
        if not isinstance(value, ObstacleMotion | Sighting | None):
            raise BadSetting(
                f"known[{key!r}] is a {type(value).__name__}; an ObstacleMotion, a Sighting or None is needed",
                setting="known",
            )
        given[index] = value
    for index, motion in movers.items():
        if index not in given:
            if motion.chases or motion.seen_from is not None or motion.sensing_radius is not None:
                raise BadSetting(
                    f"known has nothing about {_called(scene, index)}, and the scene does not give its trajectory from "
                    "the beginning: give its ObstacleMotion, a Sighting or None",
                    setting="known",
                )
            given[index] = motion
    return sorted(given.items(), key=lambda item: item[0])


def _called(scene: Scene, index: int) -> str:
    name = scene.obstacles[index].name
    return f"{index}" if name is None else f"{index} ({name!r})"
