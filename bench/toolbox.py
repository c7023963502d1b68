"""roboticstoolbox's D* in a process of its own, so that it can be stopped: prints milliseconds.

``field MASK POINTS ROW COLUMN OUT`` plans the whole field; ``repair FILE`` moves obstacles one by one.
"""

from __future__ import annotations

import json
import sys
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray
from roboticstoolbox.mobile import DstarPlanner


def planned(free: NDArray[np.bool_], goal: tuple[int, int]) -> tuple[float, Any]:
    """Return how long D* takes for the whole field (ms), and the planner; ``goal`` is row and column."""
    planner = DstarPlanner(costmap=np.where(free, 1.0, np.inf), goal=goal[::-1])
    begun = time.perf_counter()
    planner.plan()
    return (time.perf_counter() - begun) * 1e3, planner


def costs(planner: Any) -> NDArray[np.float64]:
    """Return the cost-to-go; infinite where D* never came."""
    rows = planner._Map._Map
    return np.array([[state.h if state.t.name != "NEW" else np.inf for state in row] for row in rows])


def repaired(planner: Any, start: tuple[int, int], changes: list[tuple[int, int, float]]) -> tuple[float, float]:
    """Return how long it takes to take in changed cells (ms), and the cost-to-go from ``start`` after it.

    The planner repairs when a sensor tells of changes at the first step of a query, as far as the start needs it.
    """
    state = planner._Map._Map[start[0]][start[1]]
    told: list[float] = []
    heard: list[float] = []

    def sensor(_place: Any) -> list[tuple[int, int, float]] | None:
        if told:
            if len(heard) < 2:
                heard.extend([time.perf_counter(), float(state.h)])
            return None
        told.append(time.perf_counter())
        return changes

    planner.query(start=start[::-1], sensor=sensor)
    return (heard[0] - told[0]) * 1e3, heard[1]


def main() -> None:
    """Do what the arguments say."""
    match sys.argv[1:]:
        case ["field", file, points, row, column, out]:
            free = np.fromfile(file, dtype=np.bool_).reshape(int(points), int(points))
            ms, planner = planned(free, (int(row), int(column)))
            costs(planner).tofile(out)
            print(ms)
        case ["repair", file]:
            given = np.load(file)
            goal, start = ((int(given[end][0]), int(given[end][1])) for end in ("goal", "start"))
            found = []
            for after in given["after"]:
                before = given["before"]
                _, planner = planned(before, goal)
                changed = np.argwhere(before != after)
                changes = [(int(c), int(r), 1.0 if after[r, c] else np.inf) for r, c in changed]
                found.append(repaired(planner, start, changes))
            print(json.dumps(found))


if __name__ == "__main__":
    main()
