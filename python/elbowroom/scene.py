"""What is asked: an arm among obstacles, the grid of its map, and tasks. Metres and radians throughout."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass, replace
from importlib import resources
from pathlib import Path
from typing import Any, Literal

from elbowroom import _core
from elbowroom.errors import SceneError

Pair = tuple[float, float]
Outline = tuple[Sequence[Pair], float]
"""A shape as points with a radius (m): all that is within it of one point, of the line between two, or of a polygon."""

PostureWish = Literal["up", "down", "any", "keep"]

LARGEST_FILE = 4 * 1024 * 1024
"""Largest scene file that is read (bytes)."""


@dataclass(frozen=True, kw_only=True)
class Joint:
    """Where a joint may turn (rad): all the way round if ``continuous``, else from ``min`` to ``max``, ends included.

    ``velocity``, ``acceleration`` and ``jerk`` are its greatest (rad/s, rad/s², rad/s³); None where none is stated.
    """

    continuous: bool = False
    min: float | None = None
    max: float | None = None
    velocity: float | None = None
    acceleration: float | None = None
    jerk: float | None = None


@dataclass(frozen=True, kw_only=True)
class Arm:
    """A planar arm: lengths (m) of two or more links, and joints, base first. Links are capsules of ``half_width`` (m).

    With ``self_collision`` links that are not neighbours must keep clear of each other.
    """

    links: Sequence[float]
    joints: Sequence[Joint]
    half_width: float = 0.0
    base: Pair = (0.0, 0.0)
    self_collision: bool = False


@dataclass(frozen=True, kw_only=True)
class Grid:
    """The points of the free-space map: ranges of x and y with both ends, ``step`` apart (m)."""

    x: Pair
    y: Pair
    step: float


@dataclass(frozen=True, kw_only=True)
class ObstacleMotion:
    """How an obstacle moves, without turning: by way-points, at one velocity, or after the arm's tip.

    Attributes:
        waypoints: Times (s) and shifts from where the scene has the obstacle (m): straight from one to the next, still
            before the first and after the last.
        velocity: In m/s, from ``start`` (s) on.
        start: When it begins to move at its velocity (s).
        chases: Whether it goes after the tip, at its greatest speed, but no nearer to the arm than ``keep_off`` (m).
        keep_off: See ``chases``.
        greatest_speed: It is never faster (m/s); None for that of its way-points or velocity.
        seen_from: Since when the arm knows of it (s); None, as ``sensing_radius``, if it always does.
        sensing_radius: The arm knows of it while it is no farther away than this (m).
    """

    waypoints: Sequence[tuple[float, Pair]] | None = None
    velocity: Pair | None = None
    start: float = 0.0
    chases: bool = False
    keep_off: float = 0.0
    greatest_speed: float | None = None
    seen_from: float | None = None
    sensing_radius: float | None = None


@dataclass(frozen=True, kw_only=True)
class Circle:
    """A disc that the arm must not touch (m), and how it moves if it does."""

    center: Pair
    radius: float
    name: str | None = None
    motion: ObstacleMotion | None = None

    @property
    def outline(self) -> Outline:
        """Its centre, with its radius."""
        return (self.center,), self.radius

    def shifted(self, by: Pair) -> Circle:
        """Return the same moved by so much (m)."""
        return replace(self, center=_plus(self.center, by))


@dataclass(frozen=True, kw_only=True)
class Segment:
    """A straight wall that the arm must not touch: all that is within ``radius`` of the line between two points (m)."""

    start: Pair
    end: Pair
    radius: float = 0.0
    name: str | None = None
    motion: ObstacleMotion | None = None

    @property
    def outline(self) -> Outline:
        """Its ends, with its radius."""
        return (self.start, self.end), self.radius

    def shifted(self, by: Pair) -> Segment:
        """Return the same moved by so much (m)."""
        return replace(self, start=_plus(self.start, by), end=_plus(self.end, by))


@dataclass(frozen=True, kw_only=True)
class Polygon:
    """A simple polygon, convex or not, that the arm must not touch: corners in either direction (m)."""

    vertices: Sequence[Pair]
    name: str | None = None
    motion: ObstacleMotion | None = None

    @property
    def outline(self) -> Outline:
        """Its corners, without a radius."""
        return self.vertices, 0.0

    def shifted(self, by: Pair) -> Polygon:
        """Return the same moved by so much (m)."""
        return replace(self, vertices=[_plus(vertex, by) for vertex in self.vertices])


Obstacle = Circle | Segment | Polygon
"""Something that the arm must not touch."""


def _plus(point: Pair, by: Pair) -> Pair:
    return (point[0] + by[0], point[1] + by[1])


@dataclass(frozen=True)
class Configuration:
    """Joint angles, base first (rad): a start or goal given by the joints."""

    q: Sequence[float]


Place = Pair | Configuration
"""Where a task begins or ends: a place of the tip (m), or a configuration."""


@dataclass(frozen=True, kw_only=True)
class Task:
    """A motion that is asked for, and the postures that will do."""

    start: Place
    goal: Place
    posture: PostureWish = "any"


@dataclass(frozen=True, kw_only=True)
class Scene:
    """An arm among obstacles, with the grid of its map and named tasks.

    Raises:
        SceneError: A part makes no sense.

    Example:
        >>> import math
        >>> import elbowroom as er
        >>> bend = math.radians(150)
        >>> scene = er.Scene(
        ...     arm=er.Arm(links=(0.25, 0.25), joints=(er.Joint(continuous=True), er.Joint(min=-bend, max=bend))),
        ...     grid=er.Grid(x=(-0.5, 0.5), y=(-0.5, 0.5), step=0.01),
        ...     obstacles=[er.Circle(center=(0.22, 0.22), radius=0.05)],
        ...     tasks={"first": er.Task(start=(0.4, 0.1), goal=(-0.45, -0.15))},
        ... )
        >>> er.free_space(scene).cases["two"] > 1000
        True
    """

    arm: Arm
    grid: Grid
    obstacles: Sequence[Obstacle] = ()
    tasks: Mapping[str, Task] = field(default_factory=dict)
    file: str | None = field(default=None, init=False, compare=False)
    """What the text is called that it was read from; None if it was made, or changed, in code."""
    locations: Mapping[tuple[str, str], tuple[int, int]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )
    """Line and column of each (task, "start" or "goal") in that text; none if there is none."""
    core: _core.Scene = field(init=False, repr=False, compare=False)
    """The same scene as the core holds it."""

    def __post_init__(self) -> None:
        core = _core.Scene(arm=self.arm, grid=self.grid, obstacles=list(self.obstacles), tasks=list(self.tasks.items()))
        object.__setattr__(self, "core", core)

    def __reduce__(self) -> tuple[object, ...]:
        parts = {part.name: getattr(self, part.name) for part in fields(self) if part.init}
        return _rebuilt, (parts, self.file, self.locations)

    @property
    def sha256(self) -> str:
        """Hash of what the scene says, in hexadecimal: arm, grid, obstacles and tasks, wherever they come from."""
        parts = {part.name: getattr(self, part.name) for part in fields(self) if part.init}
        text = json.dumps({name: _plain(part) for name, part in parts.items()}, sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()

    def _read_from(self, file: str | None, locations: Mapping[tuple[str, str], tuple[int, int]]) -> Scene:
        """The same scene as read from a text."""
        object.__setattr__(self, "file", file)
        object.__setattr__(self, "locations", locations)
        return self

    @classmethod
    def load(cls, path: str | Path) -> Scene:
        """Return the scene in the YAML file at ``path``; its format is ``schema/scene.schema.json``.

        Raises:
            SceneError: The file cannot be read or is no scene; with file, line, column and key.
        """
        return cls.parse(text_of(Path(path)), file=str(path))

    @classmethod
    def example(cls, name: str) -> Scene:
        """Return one of the scenes that come with the package, such as ``paper-standin``.

        Raises:
            SceneError: There is no such scene; the message lists those there are.
        """
        folder = resources.files("elbowroom") / "scenes"
        known = sorted(file.name.removesuffix(".yaml") for file in folder.iterdir() if file.name.endswith(".yaml"))
        if name not in known:
            raise SceneError(f"no example is called '{name}'; there are {', '.join(known)}", key="")
        return cls.parse((folder / f"{name}.yaml").read_text(encoding="utf-8"), file=f"scenes/{name}.yaml")

    @classmethod
    def parse(cls, text: str, *, file: str = "scene") -> Scene:
        """Return the scene in the YAML ``text``; errors call it ``file``.

        Raises:
            SceneError: The text is no scene; with file, line, column and key.
        """
        parsed = _core.SceneFile.parse(text, file)
        parts = parsed.parts()
        tasks = {name: _task(part) for name, part in parts["tasks"].items()}
        ends = [(name, end) for name in tasks for end in ("start", "goal")]
        located = {key: at for key in ends if (at := parsed.location(*key)) is not None}
        return cls(
            arm=Arm(**{**parts["arm"], "joints": tuple(Joint(**joint) for joint in parts["arm"]["joints"])}),
            grid=Grid(**parts["grid"]),
            obstacles=tuple(_obstacle(part) for part in parts["obstacles"]),
            tasks=tasks,
        )._read_from(file, located)


def _rebuilt(parts: dict[str, Any], file: str | None, locations: Mapping[tuple[str, str], tuple[int, int]]) -> Scene:
    return Scene(**parts)._read_from(file, locations)


def _plain(part: Any) -> Any:
    """A part of a scene in dictionaries, lists and numbers: equal parts give the same."""
    if is_dataclass(part):
        return {one.name: _plain(getattr(part, one.name)) for one in fields(part)}
    if isinstance(part, Mapping):
        return {str(name): _plain(value) for name, value in part.items()}
    if part is None or isinstance(part, str | bool):
        return part
    try:
        return float(part)
    except TypeError:
        return [_plain(value) for value in part]


def _obstacle(part: Mapping[str, Any]) -> Obstacle:
    points, radius, name = part["vertices"], part["radius"], part["name"]
    motion = ObstacleMotion(**part["motion"]) if "motion" in part else None
    match points:
        case [center]:
            return Circle(center=center, radius=radius, name=name, motion=motion)
        case [start, end]:
            return Segment(start=start, end=end, radius=radius, name=name, motion=motion)
        case _:
            return Polygon(vertices=points, name=name, motion=motion)


def text_of(path: Path) -> str:
    """Return the text of the scene file at ``path``.

    Raises:
        SceneError: The file cannot be read, is too large, or is no UTF-8.
    """

    def refused(what: str) -> SceneError:
        return SceneError(f"{path}: {what}", key="", file=str(path))

    try:
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except OSError as error:
        raise refused(f"cannot be read: {error.strerror or error}") from None
    if len(content) > LARGEST_FILE:
        raise refused("more than 4 MiB, which is the most a scene file may have")
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise refused(f"byte {error.start} is not UTF-8") from None


def _task(part: Mapping[str, Any]) -> Task:
    def place(end: str) -> Place:
        return part[end] if end in part else Configuration(tuple(part[f"{end}_q"]))

    return Task(start=place("start"), goal=place("goal"), posture=part["posture"])
