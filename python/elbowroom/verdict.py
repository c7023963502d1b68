"""What the verifier says of a motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NotRequired, TypedDict


class Violation(TypedDict, total=False):
    """A reason why a motion is not safe, first or worst of its kind per joint, or per link and what it is up against.

    ``kind`` is contact, undecided, joint_limit, velocity_limit, acceleration_limit, jerk_limit, position_jump,
    velocity_jump, acceleration_jump or too_large; ``message`` says it in words. Joints and links count from 1,
    obstacles from 0; depth is in metres. A link is up against an ``obstacle`` and its ``name``, or an ``other_link``.
    """

    kind: str
    message: str
    time: float
    joint: int
    link: int
    obstacle: int
    name: str | None
    other_link: int
    depth: float
    value: float
    limit: float


class LeastClearance(TypedDict):
    """The nearest that a link comes to an ``obstacle`` or to an ``other_link``, whichever is there (m); ``at_least`` is
    proved for the whole motion.
    """

    distance: float
    at_least: float | None
    time: float
    link: int
    obstacle: NotRequired[int]
    name: NotRequired[str | None]
    other_link: NotRequired[int]


class Margin(TypedDict):
    """The greatest absolute value of a rate, when, and its limit if one is stated."""

    largest: float
    time: float
    limit: float | None


class MotionMargins(TypedDict):
    """The greatest rates of one joint (rad/s, rad/s², rad/s³)."""

    velocity: Margin
    acceleration: Margin
    jerk: Margin


class Verdict(TypedDict):
    """What the verifier says of a motion; ``safe`` is a proof, down to a clearance of ``floor`` (m).

    ``joint_margins`` holds for each joint how near it comes to its stops (rad) and when, or None without stops;
    ``posture_changes`` when the elbow of a two-link arm changes sides (s).
    """

    safe: bool
    violations: Sequence[Violation]
    floor: float
    least_clearance: LeastClearance | None
    joint_margins: Sequence[tuple[float, float] | None]
    motion_margins: Sequence[MotionMargins]
    posture_changes: Sequence[float]
