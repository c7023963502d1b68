"""What can go wrong, as classes whose attributes carry the numbers. Bad input is also a ``ValueError``."""

from collections.abc import Sequence
from typing import TypedDict


class ElbowroomError(Exception):
    """Whatever elbowroom raises on purpose."""

    def __init__(self, message: str, **fields: object) -> None:
        super().__init__(message)
        self._fields = fields
        for name, value in fields.items():
            setattr(self, name, value)

    def __reduce__(self) -> tuple[object, ...]:
        return _restored, (type(self), str(self), self._fields)


def _restored(kind: type[ElbowroomError], message: str, fields: dict[str, object]) -> ElbowroomError:
    return kind(message, **fields)


class SceneError(ElbowroomError, ValueError):
    """A scene, from a file or built in code, makes no sense.

    ``key`` is the path to the part, such as ``arm.joints[1].min``; ``file``, ``line`` and ``column`` (from 1) are
    None for scenes built in code.
    """

    key: str
    file: str | None
    line: int | None
    column: int | None

    def __init__(
        self,
        message: str,
        *,
        key: str,
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
    ) -> None:
        super().__init__(message, key=key, file=file, line=line, column=column)


class BadSetting(ElbowroomError, ValueError):
    """A setting of a planner makes no sense; ``setting`` is its name."""

    setting: str

    def __init__(self, message: str, *, setting: str) -> None:
        super().__init__(message, setting=setting)


class UnknownTask(ElbowroomError, ValueError):
    """The scene has no task called ``name``; ``known`` lists those it has."""

    name: str
    known: Sequence[str]

    def __init__(self, message: str, *, name: str, known: Sequence[str]) -> None:
        super().__init__(message, name=name, known=known)


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


class NotFree(ElbowroomError, ValueError):
    """A task's ``end``, "start" or "goal", is a place where the arm cannot stand.

    ``reasons`` says why, once per posture for a tip; ``nearest_free`` is the free grid point nearest to where the
    tip would be (m), or None if there is none.
    """

    task: str
    end: str
    tip: tuple[float, float] | None
    configuration: tuple[float, ...] | None
    reasons: Sequence[Reason]
    nearest_free: tuple[float, float] | None

    def __init__(
        self,
        message: str,
        *,
        task: str,
        end: str,
        reasons: Sequence[Reason],
        nearest_free: tuple[float, float] | None,
        tip: tuple[float, float] | None = None,
        configuration: tuple[float, ...] | None = None,
    ) -> None:
        super().__init__(
            message,
            task=task,
            end=end,
            reasons=reasons,
            nearest_free=nearest_free,
            tip=tip,
            configuration=configuration,
        )


class NoPath(ElbowroomError):
    """It is proved that no motion does the task.

    ``reachable`` holds the corners (rad) of convex cells in the plane of both joints, cell by cell: together they hold
    every configuration that can be reached from ``starts``, and their outer walls are forbidden all along. None of
    ``goals`` lies there.
    """

    task: str
    reachable: Sequence[Sequence[Sequence[float]]]
    starts: Sequence[Sequence[float]]
    goals: Sequence[Sequence[float]]

    def __init__(
        self,
        message: str,
        *,
        task: str,
        reachable: Sequence[Sequence[Sequence[float]]],
        starts: Sequence[Sequence[float]],
        goals: Sequence[Sequence[float]],
    ) -> None:
        super().__init__(message, task=task, reachable=reachable, starts=starts, goals=goals)


class NotFound(ElbowroomError):
    """No path at this resolution or in this budget; it is not proved that there is none.

    ``step`` is the distance between grid points (m) or, for ``optimal``, the least that paths kept from forbidden
    joint angles (rad); None for planners that have neither.
    """

    step: float | None

    def __init__(self, message: str, *, step: float | None) -> None:
        super().__init__(message, step=step)


class TimedOut(ElbowroomError):
    """The timeout (s) came before a result."""

    timeout: float | None

    def __init__(self, message: str, *, timeout: float | None) -> None:
        super().__init__(message, timeout=timeout)


class TrajectoryError(ElbowroomError, ValueError):
    """A file or samples are no trajectory."""


class InternalError(ElbowroomError):
    """A bug in elbowroom itself."""
