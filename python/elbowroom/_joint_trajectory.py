"""Dumps of ROS 2's (and ROS 1's) JointTrajectory."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from typing import Any

import numpy as np
from numpy.typing import NDArray

from elbowroom._documents import shown
from elbowroom._errors import TrajectoryError
from elbowroom._plain_numbers import exact, number
from elbowroom._trajectory_samples import Floats, TrajectorySamples, since_first

WRAPPERS = ("goal", "trajectory", "joint_trajectory")
"""What messages have a JointTrajectory under: goals of actions, recorded or not."""

SHORTEST = 1e-5
"""Rows that are nearer to each other than this (s) are more likely a slip of the pen than what a controller is sent."""


def joint_trajectory(document: Any, *, joints: int, names: Sequence[str] | None) -> TrajectorySamples:
    """Return the trajectory that ``document`` holds.

    Args:
        document: A message.
        joints: How many the arm has.
        names: Of the arm's joints in it, base first; None if they end in 1, 2, ...

    Raises:
        TrajectoryError: It holds none of such an arm.
    """
    message = _unwrapped(document)
    order, left_out = _order(message["joint_names"], joints, names)
    points = message["points"]
    if not isinstance(points, Sequence) or isinstance(points, str) or not points:
        raise TrajectoryError("points is not a list of at least one point")
    count = len(message["joint_names"])
    times = [_time(point, i) for i, point in enumerate(points, 1)]
    positions = np.array([_values(point, i, "positions", count) for i, point in enumerate(points, 1)])
    stated = np.array([_stated(point, i) for i, point in enumerate(points, 1)])

    def rates(name: str, least: int) -> Floats | None:
        if stated.max() < least:
            return None
        rows = [
            _values(point, i, name, count) if of >= least else [0.0] * count
            for i, (point, of) in enumerate(zip(points, stated, strict=True), 1)
        ]
        return np.array(rows)[:, order]

    t, first = since_first(times)
    return TrajectorySamples(
        t=t,
        first=first,
        since_start=True,
        q=positions[:, order],
        v=rates("velocities", 1),
        a=rates("accelerations", 2),
        stated=stated,
        notes=tuple(_notes(left_out, stated, t)),
    )


def _unwrapped(document: Any) -> Mapping[str, Any]:
    for wrapper in WRAPPERS:
        if isinstance(document, Mapping) and wrapper in document and "points" not in document:
            document = document[wrapper]
    if not (isinstance(document, Mapping) and "joint_names" in document and "points" in document):
        raise TrajectoryError("no JointTrajectory: joint_names and points are needed")
    return document


def _order(names: Any, joints: int, asked: Sequence[str] | None) -> tuple[list[int], list[str]]:
    """Where the joint at the base and those after it are in the lists of the file, and the names of the others."""
    if not (isinstance(names, Sequence) and all(isinstance(name, str) for name in names)) or isinstance(names, str):
        raise TrajectoryError("joint_names is not a list of names")
    found = shown(", ".join(names))
    if twice := next((name for i, name in enumerate(names) if name in names[:i]), None):
        raise TrajectoryError(f"joint_names has '{shown(twice)}' twice; which of them counts?")
    example = "--joints FIRST,SECOND" + ",..." * (joints > 2)
    if asked is not None:
        if missing := next((joint for joint in asked if joint not in names), None):
            raise TrajectoryError(f"joint names are {found}; asked for were {', '.join(asked)}: no '{missing}'")
        return [names.index(joint) for joint in asked], [name for name in names if name not in asked]
    if len(names) > joints:
        raise TrajectoryError(
            f"{len(names)} joint names, {found}; the arm has {joints} joints. Name those, base first: {example}"
        )
    if len(names) < joints:
        raise TrajectoryError(f"{len(names)} joint names; the arm has {joints} joints")
    stems = [m for name in names if (m := re.fullmatch(r"(.*?)0*([1-9]\d{0,8})(\D*)", name, re.ASCII))]
    numbers = [int(m[2]) for m in stems]
    if sorted(numbers) == list(range(1, joints + 1)) and len({(m[1], m[3]) for m in stems}) == 1:
        return sorted(range(joints), key=lambda i: numbers[i]), []
    raise TrajectoryError(f"joint names are {found}: which is at the base? Name them, base first: {example}")


def _time(point: Any, row: int) -> Decimal:
    if not isinstance(point, Mapping):
        raise TrajectoryError(f"point {row} is not a mapping")
    time = point.get("time_from_start")
    try:
        if isinstance(time, Mapping):
            seconds = time.get("sec", time.get("secs"))
            return exact(seconds) + exact(time.get("nanosec", time.get("nsecs", 0))).scaleb(-9)
        return exact(time)
    except ValueError:
        raise TrajectoryError(f"point {row} has no time_from_start with sec and nanosec") from None


def _stated(point: Mapping[str, Any], row: int) -> int:
    has_velocities, has_accelerations = (bool(point.get(name)) for name in ("velocities", "accelerations"))
    if has_accelerations and not has_velocities:
        raise TrajectoryError(f"point {row} has accelerations without velocities")
    return has_velocities + has_accelerations


def _values(point: Mapping[str, Any], row: int, name: str, joints: int) -> list[float]:
    values = point.get(name)
    try:
        # Text and mappings can be gone through too, and would give numbers that nobody wrote.
        if not isinstance(values, Sequence) or isinstance(values, str | bytes):
            raise ValueError
        numbers = [number(value) for value in values]
    except ValueError:
        raise TrajectoryError(f"point {row} has no list of numbers as {name}") from None
    if len(numbers) != joints:
        raise TrajectoryError(f"point {row} has {len(numbers)} {name} for {joints} joints")
    return numbers


def _notes(left_out: Sequence[str], stated: NDArray[np.int64], t: Floats) -> list[str]:
    notes = []
    if left_out:
        notes.append(f"joints of the file that are not the arm's, left out: {shown(', '.join(left_out))}")
    linear = np.flatnonzero(np.minimum(stated[:-1], stated[1:]) == 0) + 1
    if stated.any() and linear.size:
        notes.append(
            f"linear where a row at either end states no velocities: {_listed(linear.tolist())} of {len(t) - 1}"
        )
    gaps = np.diff(t)
    if gaps.size and 0.0 < gaps.min() < SHORTEST:
        row = int(gaps.argmin()) + 2
        notes.append(f"point {row} comes only {gaps.min() * 1e9:.9g} ns after the one before it: were seconds meant?")
    return notes


def _listed(numbers: Sequence[int]) -> str:
    shown_of = [str(number) for number in numbers[:8]]
    return f"piece{'s' * (len(numbers) > 1)} {', '.join(shown_of)}{', ...' * (len(numbers) > 8)}"
