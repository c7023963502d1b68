"""Trajectories of other tools: our CSV, and dumps of ROS 2's JointTrajectory."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from elbowroom._core import MAX_ROWS
from elbowroom._documents import documents, shown
from elbowroom._errors import TrajectoryError
from elbowroom._joint_trajectory import joint_trajectory
from elbowroom._plain_numbers import exact, number
from elbowroom._text_files import Unreadable, read_text
from elbowroom._trajectory_samples import Floats, TrajectorySamples, since_first

LARGEST_FILE = 256
"""Largest trajectory file that is read (MiB)."""

PLAIN = re.compile(r'[0-9+\-.eE,"\s]*', re.ASCII)

RATES = (("v", "rad_s"), ("a", "rad_s2"))
"""What a CSV may tell of each joint besides its position: the letter and the unit of its column."""


def columns_of(joints: int, letter: str = "q", unit: str = "rad") -> list[str]:
    """Return the names of a CSV's columns for so many joints: their positions, or another rate."""
    return [f"{letter}{joint}_{unit}" for joint in range(1, joints + 1)]


def read_messages(path: Path) -> list[Message]:
    """Return the trajectories in the file at ``path``, not yet known to be any: CSV holds one, YAML may hold several.

    Raises:
        TrajectoryError: The file cannot be read; the message leaves out its name.
    """
    try:
        text = read_text(path, mebibytes=LARGEST_FILE, kind="trajectory")
    except Unreadable as error:
        raise TrajectoryError(str(error)) from None
    if not text.strip():
        raise TrajectoryError("the file is empty")
    if path.suffix.lower() in (".json", ".yaml", ".yml"):
        found = documents(text, is_json=path.suffix.lower() == ".json")
        if not found:
            raise TrajectoryError("the file is empty")
        return [Message(document, is_table=False) for document in found]
    return [Message(text, is_table=True)]


@dataclass(frozen=True, eq=False)
class Message:
    """A trajectory in a file: the text of a CSV, or a document of JSON or YAML."""

    content: Any
    is_table: bool

    def read(self, *, joints: int, names: Sequence[str] | None = None) -> TrajectorySamples:
        """Return its rows.

        Args:
            joints: How many the arm has.
            names: Of the arm's joints in a JointTrajectory, base first, where they do not end in 1, 2, ...

        Raises:
            TrajectoryError: It is no trajectory of such an arm.
        """
        if not self.is_table:
            return joint_trajectory(self.content, joints=joints, names=names)
        if names is not None:
            raise TrajectoryError("a CSV has its joints by number, q1_rad at the base; names are for a JointTrajectory")
        return _table(self.content, joints)


def read_trajectory(path: Path, *, joints: int, names: Sequence[str] | None = None) -> TrajectorySamples:
    """Return the trajectory in the file at ``path`` if that holds only one.

    Raises:
        TrajectoryError: The file cannot be read or holds no trajectory of such an arm, or more than one.
    """
    messages = read_messages(path)
    if len(messages) > 1:
        raise TrajectoryError(f"{len(messages)} messages; which of them?")
    return messages[0].read(joints=joints, names=names)


def _advice(header: Sequence[str], needed: Sequence[str]) -> str:
    """What to do where the columns of other tools are found."""
    if any(";" in name or "\t" in name for name in header):
        return "; cells are separated by commas, and numbers have a point"
    if all(PLAIN.fullmatch(name) for name in header):
        return f"; the first row has to name the columns: {','.join(needed)}"
    if any(re.fullmatch(r"[qva]\d+_deg.*", name) for name in header):
        return "; angles are in radians: convert them, and name their columns q1_rad, ..."
    return ""


def _table(text: str, joints: int) -> TrajectorySamples:
    try:
        # One more than is read is as good as all of them.
        rows = list(islice((row for row in csv.reader(io.StringIO(text)) if row), MAX_ROWS + 2))
    except csv.Error as error:
        raise TrajectoryError(f"not CSV: {error}") from None
    header, body = [name.strip() for name in rows[0]], rows[1:]
    needed = ["time_s", *columns_of(joints)]
    known = {*needed, "x_m", "y_m", *(name for letter, unit in RATES for name in columns_of(joints, letter, unit))}
    if missing := [name for name in needed if name not in header]:
        raise TrajectoryError(
            f"column {missing[0]} is missing, the arm has {joints} joints; found {shown(', '.join(header))}"
            + _advice(header, needed)
        )
    beyond = [
        name for name in header if (m := re.match(r"[qva]([1-9]\d{0,8})_", name, re.ASCII)) and int(m[1]) > joints
    ]
    if beyond:
        raise TrajectoryError(f"column {shown(beyond[0])} is of a joint too many: the arm has {joints} joints")
    if unknown := [name for name in header if name not in known]:
        raise TrajectoryError(
            f"no such column: {shown(unknown[0])}; known for an arm of {joints} joints are time_s, "
            + ", ".join(f"{letter}1_{unit} to {letter}{joints}_{unit}" for letter, unit in (("q", "rad"), *RATES))
            + ", x_m, y_m"
        )
    if len(set(header)) != len(header):
        raise TrajectoryError("a column comes twice")
    if len(body) > MAX_ROWS:
        raise TrajectoryError(f"more than {MAX_ROWS} rows, which is the most a trajectory may have")
    values = np.empty((len(body), len(header)))
    # Where nothing but plain numbers is written, Python's own way to read them is as strict and ten times as fast.
    read = float if PLAIN.fullmatch(text, text.find("\n")) else number
    for i, row in enumerate(body):
        if len(row) != len(header):
            raise TrajectoryError(f"row {i + 1} has {len(row)} cells for {len(header)} columns")
        try:
            values[i] = [read(cell) for cell in row]
        except ValueError:
            raise TrajectoryError(f"row {i + 1} has a cell that is no number") from None
        if not np.isfinite(values[i]).all():
            raise TrajectoryError(f"row {i + 1} has a number that is not finite")

    def columns(letter: str, unit: str) -> Floats | None:
        names = columns_of(joints, letter, unit)
        there = [name in header for name in names]
        if not any(there):
            return None
        if not all(there):
            raise TrajectoryError(f"column {names[there.index(False)]} is missing beside {names[there.index(True)]}")
        return values[:, [header.index(name) for name in names]]

    velocities, accelerations = (columns(letter, unit) for letter, unit in RATES)
    if velocities is None and accelerations is not None:
        raise TrajectoryError("columns of accelerations without columns of velocities")
    positions = np.column_stack([values[:, header.index(name)] for name in needed[1:]])
    at = header.index("time_s")
    t, first = values[:, at], 0.0
    if len(body) and t[0] != 0.0:
        t, first = since_first([exact(row[at]) for row in body])
    return TrajectorySamples(t=t, first=first, since_start=False, q=positions, v=velocities, a=accelerations)
