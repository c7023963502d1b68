"""What one task of one scene gives."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from elbowroom._core import PaperPlan
from elbowroom._free_space import FreeSpace
from elbowroom._paper.printed import PrintedTask
from elbowroom._scene import Scene


@dataclass(frozen=True)
class Trial:
    """What one task of one scene gives. ``dstar`` and ``swarm`` are None where no path was found down to the grid
    ``step`` (m).
    """

    name: str
    scene: Scene
    space: FreeSpace
    task: PrintedTask
    step: float
    steps_without_path: tuple[float, ...]
    dstar: PaperPlan | None
    swarm: PaperPlan | None
    met_optimum: int
    jumped: int
    seeds: int
    pictures: tuple[Path, ...]
