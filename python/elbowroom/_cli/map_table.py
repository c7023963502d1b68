"""A free-space map in numbers."""

from __future__ import annotations

from typing import Any

import numpy as np

from elbowroom._free_space import FreeSpace, FreeSpaceMap


def summary(space: FreeSpace) -> dict[str, Any]:
    """Return how many grid points are in which state."""
    rows, columns = space.union.shape
    return {
        "points": rows * columns,
        "columns": columns,
        "rows": rows,
        "cases": space.cases,
        "free_in_some_posture": int(np.count_nonzero(space.union)),
        "elbow_up": _reasons(space.elbow_up),
        "elbow_down": _reasons(space.elbow_down),
    }


def _reasons(of: FreeSpaceMap) -> dict[str, int]:
    def count(state: int, part: int) -> int:
        return int(np.count_nonzero((of.state == state) & (of.part == part)))

    return {
        "free": count(0, 0),
        "out_of_reach": count(1, 0),
        "joint_1_limit": count(2, 1),
        "joint_2_limit": count(2, 2),
        "link_1_collision": count(3, 1),
        "link_2_collision": count(3, 2),
    }


def as_table(report: dict[str, Any]) -> str:
    """Return ``report`` for people."""
    cases = report["cases"]
    lines = [
        f"{report['columns']} x {report['rows']} grid points, {report['free_in_some_posture']} free",
        f"two configurations {cases['two']}, one {cases['one']}, none {cases['none']}",
        "",
        f"{'':18}{'elbow-up':>10}{'elbow-down':>12}",
    ]
    for key in report["elbow_up"]:
        name = key.replace("_", " ")
        lines.append(f"{name:18}{report['elbow_up'][key]:>10}{report['elbow_down'][key]:>12}")
    return "\n".join(lines)
