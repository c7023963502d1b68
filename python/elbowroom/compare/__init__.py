"""Planners side by side: the same tasks, seeds and limits for all, every motion checked by the verifier.

Example:
    >>> from pathlib import Path
    >>> from elbowroom.compare import compare
    >>> from elbowroom.planners import all_chosen
    >>> def compare_two(scene: Path) -> list[float | None]:
    ...     found = compare([scene], planners=all_chosen("dstar,optimal"), seeds=range(3), out=Path("out/two"))
    ...     return [row.cost for row in found.rows]
"""

from elbowroom.compare._comparison import Comparison, compare
from elbowroom.compare._row import Problem, Row
from elbowroom.compare._run import run
from elbowroom.compare._straight_turns import straight_turns
from elbowroom.compare._table import Table

__all__ = ["Comparison", "Problem", "Row", "Table", "compare", "run", "straight_turns"]
