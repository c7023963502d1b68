"""Where an arm starts, as the command line has it."""

from __future__ import annotations

import math

from elbowroom._errors import BadSetting
from elbowroom._plain_numbers import number
from elbowroom._scene import Scene


def start_of(text: str, scene: Scene) -> list[float]:
    """Return the configuration (rad) that ``text`` names in the scene's unit of angles.

    Raises:
        BadSetting: It is not a number for each joint.
    """
    joints = len(scene.arm.joints)
    try:
        values = [number(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != joints or not all(map(math.isfinite, values)):
        raise BadSetting(f"--from is '{text}'; {joints} numbers are needed, Q1,Q2,... base first", setting="from")
    # As the core reads a scene file, to the last bit: a start may stand on a joint limit.
    return [math.radians(value) for value in values] if scene.units.angle == "deg" else values
