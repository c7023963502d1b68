"""An independent judge of motions: dense samples, plain NumPy, files read by other means; nothing of elbowroom's.

What it finds is there: a sample that is in contact or beyond a limit, a jump, an end that moves. What lies between two
samples it does not see, so it can convict a verdict of SAFE, not confirm one.
"""

from __future__ import annotations

import csv
import json
import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SAMPLES = 200
"""A piece of a motion."""

LOADER = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
"""Reads all values as text."""

DEPTH = 1e-9
"""Contact deeper than this counts (m), and joints beyond their limits by more (rad)."""

SHARE = 1e-9
"""Rates beyond their limits by a greater share count."""

REST = 1.1e-6
"""Speed at an end that counts (rad/s), and jumps between pieces (rad, rad/s, rad/s²)."""


@dataclass(frozen=True)
class Shape:
    """An obstacle: points (m) that are a disc, a wall or a polygon with a radius, and how it moves."""

    points: Floats
    radius: float
    motion: Mapping[str, Any]
    speed: float

    def shift(self, t: Floats, metres: float) -> Floats:
        """Where it is moved to at ``t``."""
        moved = np.zeros((len(t), 2))
        if "waypoints" in self.motion:
            times = [float(point["time"]) for point in self.motion["waypoints"]]
            for axis in (0, 1):
                shifts = [float(point["shift"][axis]) * metres for point in self.motion["waypoints"]]
                moved[:, axis] = np.interp(t, times, shifts)
        elif "velocity" in self.motion:
            going = np.maximum(t - float(self.motion.get("start", 0.0)), 0.0)
            moved = going[:, np.newaxis] * np.array([float(rate) * metres for rate in self.motion["velocity"]])
        return moved

    def grown(self, t: Floats) -> Floats:
        """Its radius at ``t``: what pursues may be anywhere that its speed allows."""
        return self.radius + (self.speed * np.abs(t) if "chases" in self.motion else np.zeros(len(t)))


@dataclass(frozen=True)
class World:
    """What a scene file says, in metres and radians; read by another reader than elbowroom's."""

    links: Sequence[float]
    half_width: float
    base: Sequence[float]
    limits: Sequence[Mapping[str, float]]
    apart: bool
    shapes: Sequence[Shape]
    metres: float
    radians: float
    tasks: Mapping[str, Any]

    @classmethod
    def read(cls, text: str) -> World:
        """Read a scene file whose values are plain."""
        # A line of blanks says nothing, but this reader minds tabs in it.
        told = yaml.load(re.sub(r"^[ \t]+$", "", text, flags=re.MULTILINE), Loader=LOADER)
        metres = {"m": 1.0, "cm": 0.01, "mm": 0.001}[told["units"]["length"]]
        radians = {"rad": 1.0, "deg": math.pi / 180.0}[told["units"]["angle"]]
        arm = told["arm"]
        rates = ("min", "max", "velocity", "acceleration", "jerk")
        return cls(
            links=[float(length) * metres for length in arm["links"]],
            half_width=float(arm.get("half_width", 0.0)) * metres,
            base=[float(value) * metres for value in arm.get("base", (0.0, 0.0))],
            limits=[{key: float(joint[key]) * radians for key in rates if key in joint} for joint in arm["joints"]],
            apart=arm.get("self_collision", "false") == "true",
            shapes=[_shape(obstacle, metres) for obstacle in told.get("obstacles") or ()],
            metres=metres,
            radians=radians,
            tasks=told.get("tasks") or {},
        )

    def ends(self, q: Floats) -> Floats:
        """Base, joints and tip, ``(n, links + 1, 2)``."""
        angles = np.cumsum(q, axis=1)
        steps = np.stack([np.cos(angles), np.sin(angles)], axis=2) * np.array(self.links)[:, np.newaxis]
        arms: Floats = np.concatenate([np.zeros((len(q), 1, 2)), np.cumsum(steps, axis=1)], axis=1)
        moved: Floats = arms + np.array(self.base)
        return moved

    def clearance(self, t: Floats, q: Floats) -> float:
        """The least distance of the links from what they must not touch; negative in contact."""
        ends, least = self.ends(q), math.inf
        links = [(ends[:, i], ends[:, i + 1]) for i in range(len(self.links))]
        for shape in self.shapes:
            corners = shape.points[np.newaxis] + shape.shift(t, self.metres)[:, np.newaxis]
            for a, b in links:
                away = _from_shape(a, b, corners) - shape.grown(t) - self.half_width
                least = min(least, float(away.min()))
        if self.apart:
            for i, (a, b) in enumerate(links):
                for c, d in links[i + 2 :]:
                    least = min(least, float(_between(a, b, c, d).min()) - 2.0 * self.half_width)
        return least


def _shape(obstacle: Mapping[str, Any], metres: float) -> Shape:
    if "circle" in obstacle:
        points, radius = [obstacle["circle"]["center"]], obstacle["circle"]["radius"]
    elif "polygon" in obstacle:
        points, radius = obstacle["polygon"], 0.0
    else:
        wall = obstacle["segment"]
        points, radius = [wall["from"], wall["to"]], wall.get("radius", 0.0)
    return Shape(
        points=np.array([[float(value) * metres for value in point] for point in points]),
        radius=float(radius) * metres,
        motion=obstacle.get("motion") or {},
        speed=float(obstacle.get("greatest_speed", 0.0)) * metres,
    )


def _point_to(p: Floats, a: Floats, b: Floats) -> Floats:
    """How far points are from segments."""
    along = b - a
    squared = np.maximum((along**2).sum(axis=-1), 1e-300)
    share = np.clip(((p - a) * along).sum(axis=-1) / squared, 0.0, 1.0)
    return np.asarray(np.hypot(*np.moveaxis(p - a - share[..., np.newaxis] * along, -1, 0)))


def _side(a: Floats, b: Floats, p: Floats) -> Floats:
    return np.asarray(
        (b[..., 0] - a[..., 0]) * (p[..., 1] - a[..., 1]) - (b[..., 1] - a[..., 1]) * (p[..., 0] - a[..., 0])
    )


def _between(a: Floats, b: Floats, c: Floats, d: Floats) -> Floats:
    """How far segments are from segments; 0 where they cross."""
    nearest: Floats = np.minimum.reduce(
        [_point_to(a, c, d), _point_to(b, c, d), _point_to(c, a, b), _point_to(d, a, b)]
    )
    crossed = (_side(a, b, c) * _side(a, b, d) < 0.0) & (_side(c, d, a) * _side(c, d, b) < 0.0)
    return np.where(crossed, 0.0, nearest)


def _from_shape(a: Floats, b: Floats, corners: Floats) -> Floats:
    """How far links are from points, walls and polygons; less than 0 inside a polygon."""
    count = corners.shape[1]
    if count == 1:
        return _point_to(corners[:, 0], a, b)
    edges = [(i, (i + 1) % count) for i in range(count if count > 2 else 1)]
    nearest: Floats = np.minimum.reduce([_between(a, b, corners[:, i], corners[:, j]) for i, j in edges])
    if count == 2:
        return nearest
    inside = np.zeros(len(a), dtype=bool)
    for i, j in edges:
        p, q = corners[:, i], corners[:, j]
        spans = (p[:, 1] > a[:, 1]) != (q[:, 1] > a[:, 1])
        with np.errstate(divide="ignore", invalid="ignore"):
            crosses = p[:, 0] + (a[:, 1] - p[:, 1]) / (q[:, 1] - p[:, 1]) * (q[:, 0] - p[:, 0])
        inside ^= spans & (a[:, 0] < crosses)
    return np.where(inside, -np.maximum(nearest, 2.0 * DEPTH), nearest)


@dataclass(frozen=True)
class Rows:
    """A trajectory as a file tells it: of each row time, positions and, where it states them, rates."""

    t: list[float]
    q: list[list[float]]
    rates: list[list[list[float]]]
    since_start: bool


def read(text: str, *, kind: str, joints: int, names: Sequence[str] | None, message: int | None) -> list[Rows]:
    """Read a trajectory file whose values are plain, or one message of it."""
    if kind == "csv":
        return [_table(text, joints)]
    documents = [json.loads(text)] if kind == "json" else list(yaml.load_all(text, Loader=LOADER))
    found = [document for document in documents if document not in (None, "")]
    chosen = found if message is None else [found[message - 1]]
    return [_message(document, joints, names) for document in chosen]


def _table(text: str, joints: int) -> Rows:
    header, *body = [row for row in csv.reader(text.lstrip("\ufeff").splitlines()) if row]
    place = {name.strip(): i for i, name in enumerate(header)}

    def columns(row: Sequence[str], letter: str, unit: str) -> list[float]:
        return [float(row[place[f"{letter}{joint}_{unit}"]]) for joint in range(1, joints + 1)]

    known = [(letter, unit) for letter, unit in (("v", "rad_s"), ("a", "rad_s2")) if f"{letter}1_{unit}" in place]
    return Rows(
        t=[float(row[place["time_s"]]) for row in body],
        q=[columns(row, "q", "rad") for row in body],
        rates=[[columns(row, letter, unit) for letter, unit in known] for row in body],
        since_start=False,
    )


def _message(document: Any, joints: int, names: Sequence[str] | None) -> Rows:
    while "points" not in document:
        document = next(document[key] for key in ("goal", "trajectory", "joint_trajectory") if key in document)
    found = document["joint_names"]
    if names is None:
        numbers = [int(re.findall(r"[0-9]+", name)[-1]) for name in found]
        order = [numbers.index(joint) for joint in range(1, joints + 1)]
    else:
        order = [found.index(name) for name in names]

    def instant(time: Any) -> float:
        if not isinstance(time, Mapping):
            return float(time)
        return float(time.get("sec", time.get("secs"))) + 1e-9 * float(time.get("nanosec", time.get("nsecs", 0)))

    points = document["points"]
    return Rows(
        t=[instant(point["time_from_start"]) for point in points],
        q=[[float(point["positions"][i]) for i in order] for point in points],
        rates=[
            [[float(point[name][i]) for i in order] for name in ("velocities", "accelerations") if point.get(name)]
            for point in points
        ],
        since_start=True,
    )


@dataclass
class Pieces:
    """Polynomials between instants: coefficients of each joint, low to high, in the time since the piece began."""

    starts: list[float] = field(default_factory=list)
    durations: list[float] = field(default_factory=list)
    coefficients: list[Floats] = field(default_factory=list)

    def sampled(self) -> Iterator[tuple[Floats, list[Floats]]]:
        """Of each piece the instants, and positions, velocities, accelerations and jerks at them, ``(n, joints)``."""
        share = np.linspace(0.0, 1.0, SAMPLES + 1)
        for start, duration, rows in zip(self.starts, self.durations, self.coefficients, strict=True):
            s, told = share * duration, []
            powers: Any = rows
            for _ in range(4):
                told.append(np.stack([np.polynomial.polynomial.polyval(s, row) for row in powers], axis=1))
                powers = np.polynomial.polynomial.polyder(powers, axis=1) if powers.shape[1] > 1 else 0.0 * powers
            yield start + s, told


def interpolated(rows: Rows) -> Pieces:
    """Between rows as a controller would: as many derivatives as both rows state."""
    pieces = Pieces()
    for i, (begin, end) in enumerate(pairwise(rows.t)):
        order = min(len(rows.rates[i]), len(rows.rates[i + 1]))
        duration = end - begin
        known = [[rows.q[k], *rows.rates[k][:order]] for k in (i, i + 1)]
        size = 2 * (order + 1)
        # Derivatives at both ends of a polynomial in the share of the piece, as a system of equations.
        matrix, right = np.zeros((size, size)), np.zeros((size, len(rows.q[0])))
        for which, at in enumerate((0.0, 1.0)):
            for derivative in range(order + 1):
                line = which * (order + 1) + derivative
                right[line] = np.array(known[which][derivative]) * duration**derivative
                for power in range(derivative, size):
                    matrix[line, power] = math.perm(power, derivative) * (at ** (power - derivative))
        solved = np.linalg.solve(matrix, right).T
        pieces.starts.append(begin)
        pieces.durations.append(duration)
        pieces.coefficients.append(solved / duration ** np.arange(size))
    return pieces


def against(world: World, pieces: Pieces, *, open_end: bool, margin: float = 0.0) -> list[str]:
    """Say what samples of a motion show to be wrong with it."""
    found: list[str] = []
    before: list[Floats] | None = None
    # A row's rounding weighs as much as its numbers are great.
    for t, rates in pieces.sampled():
        clearance = world.clearance(t, rates[0])
        if clearance < margin - DEPTH:
            found.append(f"clearance {clearance} between {t[0]} and {t[-1]} s")
        for joint, limits in enumerate(world.limits):
            q = rates[0][:, joint]
            room = DEPTH + 1e-12 * float(np.abs(q).max())
            if q.min() < limits.get("min", -math.inf) - room or q.max() > limits.get("max", math.inf) + room:
                found.append(f"joint {joint + 1} between {q.min()} and {q.max()}")
            for name, values in zip(("velocity", "acceleration", "jerk"), rates[1:], strict=True):
                greatest = float(np.abs(values[:, joint]).max())
                if greatest > limits.get(name, math.inf) * (1.0 + SHARE) + 1e-9:
                    found.append(f"{name} of joint {joint + 1} is {greatest} at {t[0]} s")
            if before is not None:
                jumps = [abs(float(rates[k][0, joint] - before[k][-1, joint])) for k in range(3)]
                limited = [True, "acceleration" in limits, "jerk" in limits]
                found += [
                    f"derivative {k} of joint {joint + 1} jumps by {jumps[k]} at {t[0]} s"
                    for k in range(3)
                    if limited[k] and jumps[k] > REST + 1e-9 * float(np.abs(rates[k]).max())
                ]
        before = rates
    if not open_end:
        ends = list(pieces.sampled())
        for which, rates in (("begins", [values[0] for values in ends[0][1]]), ("ends", [v[-1] for v in ends[-1][1]])):
            order = pieces.coefficients[0 if which == "begins" else -1].shape[1]
            for joint, limits in enumerate(world.limits):
                # Straight lines have to jump where nothing limits the acceleration.
                if abs(rates[1][joint]) > REST and (order > 2 or "acceleration" in limits):
                    found.append(f"joint {joint + 1} {which} at {rates[1][joint]} rad/s")
    return found


def of_file(
    world: World,
    text: str,
    *,
    kind: str,
    names: Sequence[str] | None,
    start: Sequence[float] | None,
    open_end: bool,
    message: int | None,
    margin: float,
) -> list[str]:
    """Say what is wrong with the trajectories of a file that was called safe; in radians and metres."""
    found = []
    for rows in read(text, kind=kind, joints=len(world.links), names=names, message=message):
        first = rows.t[0]
        if start is not None and first > 0.0:
            still = [[0.0] * len(start)] * 2
            rows = Rows(
                [0.0, *rows.t],
                [list(start), *rows.q],
                [still[: max(map(len, rows.rates))], *rows.rates],
                rows.since_start,
            )
        elif rows.since_start and first > 0.0:
            found.append(f"the first row is at {first} s")
        elif start is None and not any(shape.motion for shape in world.shapes):
            rows = Rows([time - first for time in rows.t], rows.q, rows.rates, rows.since_start)
        if len(rows.t) < 2:
            found.append("one row")
            continue
        found += against(world, interpolated(rows), open_end=open_end, margin=margin)
    return found


def of_task(world: World, pieces: Pieces, task: str) -> list[str]:
    """Say whether a motion does not begin and end where its task says."""
    told, found = world.tasks[task], []
    ends = [rows[:, 0] for rows in pieces.coefficients[:1]]
    last, duration = pieces.coefficients[-1], pieces.durations[-1]
    ends.append(np.array([np.polynomial.polynomial.polyval(duration, row) for row in last]))
    for which, q in zip(("start", "goal"), ends, strict=True):
        place = told[which]
        if isinstance(place, Mapping):
            away = [float(a) * world.radians - b for a, b in zip(place["q"], q, strict=True)]
            for joint, limits in enumerate(world.limits):
                if "min" not in limits:
                    away[joint] = math.remainder(away[joint], math.tau)
        else:
            tip = world.ends(q[np.newaxis])[0, -1]
            away = [float(a) * world.metres - b for a, b in zip(place, tip, strict=True)]
        if max(map(abs, away)) > 1e-6:
            found.append(f"{which} is missed by {away}")
    return found
