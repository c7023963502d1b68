"""What a motion shall cost little of, as the core lists it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from elbowroom import _core

Objective = Literal["tip", "joint", "time"]


@dataclass(frozen=True)
class Meaning:
    """Of an objective: what it is a number of, its unit, and the column of compared rows that holds it."""

    quantity: str
    unit: str
    column: str


_COLUMNS: Mapping[str, str] = {"tip": "tip_length_m", "joint": "joint_travel_rad", "time": "duration_s"}

OBJECTIVES: Mapping[str, Meaning] = {
    name: Meaning(quantity, unit, _COLUMNS[name]) for name, quantity, unit in _core.objectives()
}
"""All of them by name."""

LISTED = " or ".join([", ".join([*OBJECTIVES][:-1]), [*OBJECTIVES][-1]])
"""Their names as text: a, b or c."""
