"""Trajectories of other tools: our CSV, and dumps of ROS 2's JointTrajectory."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from elbowroom.errors import TrajectoryError

Floats = NDArray[np.float64]

LARGEST_FILE = 256 * 1024 * 1024
"""Largest trajectory file that is read (bytes)."""

CONSTRUCTOR_ERRORS = (RecursionError, ValueError, ArithmeticError, AttributeError, LookupError, TypeError)
"""What PyYAML may fail with, besides its own errors, where a value is not what its tag says."""

RATES = (("v", "rad_s", "velocities"), ("a", "rad_s2", "accelerations"))


def columns_of(joints: int, letter: str = "q", unit: str = "rad") -> list[str]:
    """Return the names of a CSV's columns for so many joints: their positions, or another rate."""
    return [f"{letter}{joint}_{unit}" for joint in range(1, joints + 1)]


@dataclass(frozen=True, eq=False)
class TrajectorySamples:
    """Times (s) and joint positions, velocities and accelerations at them; None where the file has none."""

    t: Floats
    q: Floats
    v: Floats | None
    a: Floats | None


def read_trajectory(path: Path, *, joints: int, names: Sequence[str] | None = None) -> TrajectorySamples:
    """Return the trajectory in the file at ``path``: CSV, or a JSON or YAML dump of a JointTrajectory.

    Args:
        path: Of the file.
        joints: How many the arm has.
        names: Of the joints in a JointTrajectory, base first, where they do not end in 1, 2, ...

    Raises:
        TrajectoryError: The file cannot be read or is no trajectory of such an arm; the message leaves out its name.
    """
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise TrajectoryError("more than 256 MiB, which is the most a trajectory file may have")
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise TrajectoryError(f"cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError as error:
        raise TrajectoryError(f"byte {error.start} is not UTF-8") from None
    if not text.strip():
        raise TrajectoryError("the file is empty")
    if path.suffix.lower() in (".json", ".yaml", ".yml"):
        return _joint_trajectory(_document(text, path), joints, names)
    return _table(text, joints)


def _table(text: str, joints: int) -> TrajectorySamples:
    try:
        rows = [row for row in csv.reader(io.StringIO(text)) if row]
    except csv.Error as error:
        raise TrajectoryError(f"not CSV: {error}") from None
    header, body = [name.strip() for name in rows[0]], rows[1:]
    needed = ["time_s", *columns_of(joints)]
    known = {*needed, "x_m", "y_m", *(name for letter, unit, _ in RATES for name in columns_of(joints, letter, unit))}
    if missing := [name for name in needed if name not in header]:
        raise TrajectoryError(
            f"column {missing[0]} is missing, the arm has {joints} joints; found {_shown(', '.join(header))}"
        )
    beyond = [name for name in header if (m := re.match(r"[qva]([1-9]\d{0,8})_", name)) and int(m[1]) > joints]
    if beyond:
        raise TrajectoryError(f"column {_shown(beyond[0])} is of a joint too many: the arm has {joints} joints")
    if unknown := [name for name in header if name not in known]:
        raise TrajectoryError(
            f"no such column: {_shown(unknown[0])}; known for an arm of {joints} joints are time_s, "
            + ", ".join(
                f"{letter}1_{unit} to {letter}{joints}_{unit}"
                for letter, unit in (("q", "rad"), *(rate[:2] for rate in RATES))
            )
            + ", x_m, y_m"
        )
    if len(set(header)) != len(header):
        raise TrajectoryError("a column comes twice")
    values = np.empty((len(body), len(header)))
    for i, row in enumerate(body):
        if len(row) != len(header):
            raise TrajectoryError(f"row {i + 1} has {len(row)} cells for {len(header)} columns")
        try:
            values[i] = [float(cell) for cell in row]
        except ValueError:
            raise TrajectoryError(f"row {i + 1} has a cell that is no number") from None

    def columns(letter: str, unit: str) -> Floats | None:
        names = columns_of(joints, letter, unit)
        there = [name in header for name in names]
        if not any(there):
            return None
        if not all(there):
            raise TrajectoryError(f"column {names[there.index(False)]} is missing beside {names[there.index(True)]}")
        return values[:, [header.index(name) for name in names]]

    velocities, accelerations = (columns(letter, unit) for letter, unit, _ in RATES)
    if velocities is None and accelerations is not None:
        raise TrajectoryError("columns of accelerations without columns of velocities")
    time, *positions = (values[:, header.index(name)] for name in needed)
    return TrajectorySamples(time, np.column_stack(positions), velocities, accelerations)


def _document(text: str, path: Path) -> Any:
    if path.suffix.lower() == ".json":
        try:
            return json.loads(text)
        except (ValueError, RecursionError) as error:
            raise TrajectoryError(f"not JSON: {_shown(str(error))}") from None
    import yaml

    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        # A dump of a topic may hold several messages; the first is taken.
        return next(iter(yaml.load_all(text, Loader=loader)), None)
    except (yaml.YAMLError, *CONSTRUCTOR_ERRORS) as error:
        raise TrajectoryError(f"not YAML: {_shown(' '.join(str(error).split()))}") from None


def _joint_trajectory(document: Any, joints: int, names: Sequence[str] | None) -> TrajectorySamples:
    for wrapper in ("trajectory", "joint_trajectory"):
        if isinstance(document, Mapping) and wrapper in document and "points" not in document:
            document = document[wrapper]
    if not (isinstance(document, Mapping) and "joint_names" in document and "points" in document):
        raise TrajectoryError("no JointTrajectory: joint_names and points are needed")
    order = _order(document["joint_names"], joints, names)
    points = document["points"]
    if not isinstance(points, Sequence) or isinstance(points, str) or not points:
        raise TrajectoryError("points is not a list of at least one point")
    times = np.array([_time(point, i) for i, point in enumerate(points)])
    positions = np.array([_values(point, i, "positions", joints) for i, point in enumerate(points)])
    rates: list[Floats | None] = []
    for _, _, name in RATES:
        there = [bool(point.get(name)) for point in points]
        if any(there) and not all(there):
            raise TrajectoryError(f"point {there.index(False) + 1} has no {name}, others have")
        values = [_values(point, i, name, joints) for i, point in enumerate(points)] if all(there) else None
        rates.append(None if values is None else np.array(values)[:, order])
    velocities, accelerations = rates
    if velocities is None and accelerations is not None:
        raise TrajectoryError("accelerations without velocities")
    return TrajectorySamples(times, positions[:, order], velocities, accelerations)


def _order(names: Any, joints: int, asked: Sequence[str] | None) -> list[int]:
    """Where the joint at the base and those after it are in the lists of the file."""
    if not (isinstance(names, Sequence) and all(isinstance(name, str) for name in names)) or isinstance(names, str):
        raise TrajectoryError("joint_names is not a list of names")
    if len(names) != joints:
        raise TrajectoryError(f"{len(names)} joint names; the arm has {joints} joints")
    if asked is not None:
        if sorted(asked) != sorted(names):
            raise TrajectoryError(f"joint names are {_shown(', '.join(names))}; asked for were {', '.join(asked)}")
        return [names.index(joint) for joint in asked]
    stems = [m for name in names if (m := re.fullmatch(r"(.*?)0*([1-9]\d{0,8})(\D*)", name))]
    numbers = [int(m[2]) for m in stems]
    if sorted(numbers) == list(range(1, joints + 1)) and len({(m[1], m[3]) for m in stems}) == 1:
        return sorted(range(joints), key=lambda i: numbers[i])
    found = _shown(", ".join(names))
    raise TrajectoryError(
        f"joint names are {found}: which is at the base? Name them, base first: --joints FIRST,SECOND"
        + ",..." * (joints > 2)
    )


def _time(point: Any, index: int) -> float:
    if not isinstance(point, Mapping):
        raise TrajectoryError(f"point {index + 1} is not a mapping")
    time = point.get("time_from_start")
    try:
        if isinstance(time, Mapping):
            seconds = time.get("sec", time.get("secs"))
            fraction = time.get("nanosec", time.get("nsecs", 0))
            return float(seconds) + float(fraction) * 1e-9
        if isinstance(time, bool) or time is None:
            raise TypeError
        return float(time)
    except (TypeError, ValueError, OverflowError):
        raise TrajectoryError(f"point {index + 1} has no time_from_start with sec and nanosec") from None


def _values(point: Any, index: int, name: str, joints: int) -> list[float]:
    values = point.get(name)
    try:
        # Text and mappings can be gone through too, and would give numbers that nobody wrote.
        if (
            not isinstance(values, Sequence)
            or isinstance(values, str | bytes)
            or any(v is True or v is False for v in values)
        ):
            raise TypeError
        # Numbers such as 1e-3 are text in YAML 1.1.
        numbers = [float(value) for value in values]
    except (TypeError, ValueError, OverflowError):
        raise TrajectoryError(f"point {index + 1} has no list of numbers as {name}") from None
    if len(numbers) != joints:
        raise TrajectoryError(f"point {index + 1} has {len(numbers)} {name} for {joints} joints")
    return numbers


def _shown(text: str) -> str:
    """The text as it can stand in a message of one line."""
    shown = "".join(letter if letter.isprintable() else repr(letter)[1:-1] for letter in text[:200])
    return shown + "..." * (len(text) > 200)
