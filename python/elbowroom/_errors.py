"""What can go wrong, as classes whose attributes carry the numbers. Bad input is also a ``ValueError``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Literal, TypedDict

if TYPE_CHECKING:
    from elbowroom._core import Verdict


@dataclass(eq=False, repr=False)
class ElbowroomError(Exception):
    """Whatever elbowroom raises on purpose; ``message`` says it in words."""

    message: str

    def __post_init__(self) -> None:
        super().__init__(self.message)

    def __reduce__(self) -> tuple[object, ...]:
        return _restored, (type(self), {field.name: getattr(self, field.name) for field in fields(self)})


class WrongType(TypeError):
    """An argument is of the wrong type: a ``TypeError``, to the reader and when it is pickled.

    The extension says what was given and what is needed; the argument's name comes as a note, and goes before that.
    """

    def add_note(self, note: str, /) -> None:
        """Take the name of the argument out of ``note``."""
        before, _, name = note.partition("while processing ")
        if before or not name:
            super().add_note(note)
        else:
            self.args = (f"{name.strip(chr(39))} {self.args[0]}",)

    def __reduce__(self) -> tuple[object, ...]:
        return TypeError, self.args


WrongType.__module__, WrongType.__name__, WrongType.__qualname__ = "builtins", "TypeError", "TypeError"


def _restored(kind: type[ElbowroomError], said: dict[str, Any]) -> ElbowroomError:
    return kind(**said)


@dataclass(eq=False, repr=False, kw_only=True)
class SceneError(ElbowroomError, ValueError):
    """A scene, from a file or built in code, makes no sense.

    ``key`` is the path to the part, such as ``arm.joints[1].min``; ``file``, ``line`` and ``column`` (from 1) are
    None for scenes built in code.
    """

    key: str
    file: str | None = None
    line: int | None = None
    column: int | None = None


@dataclass(eq=False, repr=False, kw_only=True)
class BadSetting(ElbowroomError, ValueError):
    """A setting of a planner makes no sense; ``setting`` is its name."""

    setting: str


@dataclass(eq=False, repr=False, kw_only=True)
class UnknownTask(ElbowroomError, ValueError):
    """The scene has no task called ``name``; ``known`` lists those it has."""

    name: str
    known: Sequence[str]


class Reason(TypedDict, total=False):
    """What forbids a place. ``reason`` is out_of_reach, joint_limit, collision or self_collision; the other keys go
    with it.
    """

    posture: str | None
    reason: str
    distance: float
    nearest: float
    farthest: float
    joint: int
    angle: float
    link: int
    obstacle: int
    name: str | None
    other_link: int
    depth: float


@dataclass(eq=False, repr=False, kw_only=True)
class NotFree(ElbowroomError, ValueError):
    """A task's ``end``, "start" or "goal", is a place where the arm cannot stand.

    ``reasons`` says why, once per posture for a tip; ``nearest_free`` is the free grid point nearest to where the
    tip would be (m), or None if there is none.
    """

    task: str
    end: str
    reasons: Sequence[Reason]
    nearest_free: tuple[float, float] | None
    tip: tuple[float, float] | None = None
    configuration: tuple[float, ...] | None = None


@dataclass(eq=False, repr=False, kw_only=True)
class NoPath(ElbowroomError):
    """It is proved that no motion does the task.

    ``reachable`` holds the corners (rad) of convex cells in the plane of both joints, cell by cell: together they hold
    every configuration that can be reached from ``starts``, and their outer walls are forbidden all along. None of
    ``goals`` lies there. Where a ``clearance`` (m) was asked for, what comes nearer than that is forbidden.
    """

    task: str
    reachable: Sequence[Sequence[Sequence[float]]]
    starts: Sequence[Sequence[float]]
    goals: Sequence[Sequence[float]]
    clearance: float = 0.0


@dataclass(eq=False, repr=False, kw_only=True)
class NotFound(ElbowroomError):
    """No path at this resolution or in this budget; it is not proved that there is none.

    ``resolution`` is the distance between grid points (``unit`` "m") or, for ``optimal``, the least that paths kept
    from forbidden joint angles ("rad"); both are None for planners that have neither.
    """

    resolution: float | None = None
    unit: Literal["m", "rad"] | None = None


@dataclass(eq=False, repr=False, kw_only=True)
class TimedOut(ElbowroomError):
    """The timeout (s) came before a result."""

    timeout: float | None


@dataclass(eq=False, repr=False, kw_only=True)
class Refuted(ElbowroomError, ValueError):
    """A plan, check or verdict that was pickled claims what is not so; ``verdict`` is what the verifier says now, None
    if it is another claim than that of safety.
    """

    verdict: Verdict | None = None


@dataclass(eq=False, repr=False, kw_only=True)
class PlannerFault(ElbowroomError):
    """A planner of somebody else's failed, or what it proposed does not hold.

    ``planner`` is its name, ``verdict`` what the verifier says of its motion, None if that is not what is wrong.
    """

    planner: str
    verdict: Verdict | None = None


class TrajectoryError(ElbowroomError, ValueError):
    """A file or samples are no trajectory."""


class InternalError(ElbowroomError):
    """A bug in elbowroom itself."""
