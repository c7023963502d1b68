"""What the paper prints."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class PrintedTask:
    """A task of section 9: its name here, its ends (cm), the printed cost (cm) and run time (s), its first figure."""

    name: str
    start: tuple[float, float]
    goal: tuple[float, float]
    cost: float
    run_time: float
    first_figure: int


TASKS = (
    PrintedTask("first", (40.0, 10.0), (-45.0, -15.0), 92.6232, 78.0, 6),
    PrintedTask("second", (30.0, -30.0), (15.0, 45.0), 82.8733, 49.0, 13),
)

LINKS = (25.0, 25.0)
"""Link lengths (cm)."""

BEND = 90.0
"""Table 1: the second joint stays within ± this (degrees); the first within 0 to 360."""
