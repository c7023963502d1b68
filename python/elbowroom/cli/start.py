"""Where an arm starts, as the command line has it."""

from __future__ import annotations

import math
from pathlib import Path

from elbowroom.errors import BadSetting
from elbowroom.plain_numbers import number
from elbowroom.scene import Scene, text_of


def start_of(text: str, scene: Scene, file: Path) -> list[float]:
    """Return the configuration (rad) that ``text`` names in the unit of angles of the scene file at ``file``.

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
    return [math.radians(value) for value in values] if _in_degrees(file) else values


def _in_degrees(file: Path) -> bool:
    import yaml

    # It is a scene file: it states its units.
    units = yaml.safe_load(text_of(file))["units"]
    return bool(units["angle"] == "deg")
