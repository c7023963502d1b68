"""Judges anybody's trajectory."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from elbowroom import _core
from elbowroom._arrays import real_array
from elbowroom._core import Check
from elbowroom._errors import BadSetting, TrajectoryError
from elbowroom._rounding import rounding_of
from elbowroom._scene import Scene, need_scene
from elbowroom._trajectory_files import Message, read_messages
from elbowroom._trajectory_samples import TrajectorySamples
from elbowroom._whole import is_whole

FAR = 2.0 * math.tau
"""Joints that are farther from 0 than this (rad) may have been meant in degrees."""

START_ROUNDING = 1e-9
"""How far from a first row at 0 s the arm may stand (rad): room for the rounding of degrees."""


def check(
    scene: Scene,
    *,
    t: ArrayLike,
    q: ArrayLike,
    v: ArrayLike | None = None,
    a: ArrayLike | None = None,
    start: ArrayLike | None = None,
    open_end: bool = False,
    margin: float = 0.0,
    limit_tolerance: float = 0.0,
    timeout: float | None = None,
) -> Check:
    """Return the verifier's answer on a trajectory given by samples: safe only if all of it is, from rest to rest.

    ``bool(check)`` is whether it is proved to be safe, in all that was judged: ``check.verdict.unjudged`` has the rates
    that the rows, by their rounding and spacing, do not tell well enough.

    Args:
        scene: Arm and obstacles.
        t: Times since the start, ascending, shape ``(n,)`` (s). Where the first is later than 0, how the arm
            gets to the first row is not known, and the answer is no: give ``start``, or ``t - t[0]``.
        q: Configurations, shape ``(n, joints)`` (rad).
        v: Velocities, if known, shape ``(n, joints)`` (rad/s).
        a: Accelerations, if known, shape ``(n, joints)`` (rad/s²).
        start: Where the arm stands at 0 s, shape ``(joints,)`` (rad); it then moves to the first row as a controller
            would have it move.
        open_end: It is a part of a longer motion, and may begin and end while joints move; what comes before and after
            it is not judged.
        margin: Clearance to keep (m).
        limit_tolerance: By what share motion limits may be exceeded, besides what the rounding of the rows explains.
            Contact and joint limits know none.
        timeout: When to give up (s).

    Raises:
        TrajectoryError: The samples make no motion of this arm.
        TimedOut: The timeout came first.

    Example:
        >>> import elbowroom as er
        >>> scene = er.Scene.example("paper-standin")
        >>> bool(er.check(scene, t=[0.0, 5.0], q=[[0.0, 0.0], [1.5, 0.0]]))
        False
    """
    need_scene(scene)
    times = real_array("t", t, dimensions=1, shape="(n,)")
    rows = [
        None if values is None else real_array(name, values, dimensions=2, shape="(n, joints)")
        for name, values in (("q", q), ("v", v), ("a", a))
    ]
    positions, velocities, accelerations = rows
    assert positions is not None
    if velocities is None and accelerations is not None:
        raise TrajectoryError("a without v: velocities are needed where accelerations are given")
    first = float(times[0]) if times.size else 0.0
    with np.errstate(invalid="ignore", over="ignore"):
        since_first = times - first
    samples = TrajectorySamples(
        t=since_first, first=first, since_start=True, q=positions, v=velocities, a=accelerations
    )
    return judged(
        scene,
        samples,
        start=start,
        open_end=open_end,
        margin=margin,
        limit_tolerance=limit_tolerance,
        timeout=timeout,
    )


def judged(
    scene: Scene,
    samples: TrajectorySamples,
    *,
    start: ArrayLike | None = None,
    open_end: bool = False,
    margin: float = 0.0,
    limit_tolerance: float = 0.0,
    timeout: float | None = None,
) -> Check:
    """Return the verifier's answer on ``samples``; for the rest see ``check``."""
    if len(samples.t) == 1 and (start is None or samples.first <= 0.0):
        raise TrajectoryError(
            "one point is no motion: nothing says how the arm gets there. Say where it starts, and it is judged from "
            "there: --from Q1,Q2,... on the command line, start=[...] in Python; the point has to be later than 0 s"
        )
    _check_times(samples)
    lead = max(samples.first, 0.0) if samples.since_start else 0.0
    rounding = rounding_of(samples)
    if start is not None:
        samples, lead = _from_start(samples, start), 0.0
    t = samples.t
    if start is not None or _moves(scene):
        t = t + samples.first
    motion, curve, ends = _core.interpolated(t, samples.q, samples.v, samples.a, samples.stated)
    at_rest = None if open_end else ends
    alike = samples.stated is None or len(set(samples.stated[start is not None :].tolist())) == 1
    rows = (curve if alike else None, rounding.quanta.tolist(), rounding.time, limit_tolerance)
    return _core.verify(
        scene, motion, curve=curve, margin=margin, at_rest=at_rest, lead=lead, rows=rows, timeout=timeout
    )


def _check_times(samples: TrajectorySamples) -> None:
    """Refuse times that do not ascend, told as they are in the file."""
    back = np.flatnonzero(np.diff(samples.t) <= 0.0)
    if back.size:
        before, after = (f"{samples.t[back[0] + i] + samples.first:.15g}" for i in (0, 1))
        raise TrajectoryError(f"row {back[0] + 2} is at {after} s, which is not after the {before} s of the row before")


def _moves(scene: Scene) -> bool:
    """Whether obstacles move: they do so by the clock that the times of a trajectory are of."""
    return any(obstacle.motion is not None for obstacle in scene.obstacles)


def _from_start(samples: TrajectorySamples, start: ArrayLike) -> TrajectorySamples:
    """``samples`` with a row more: the arm at rest at ``start`` at 0 s, as a controller would know it."""
    first, q = samples.first, samples.q
    q0 = real_array("start", start, dimensions=1, shape="(joints,)")
    if q0.shape != q.shape[1:]:
        raise TrajectoryError(f"the start has {len(q0)} joints, the rows have {q.shape[1]}")
    if not 0.0 <= first < math.inf:
        raise TrajectoryError(f"the first row is at {first:g} s; with a start, times count from there, at 0 s")
    if first == 0.0:
        if q.size and not np.allclose(q0, q[0], rtol=0.0, atol=START_ROUNDING):
            raise TrajectoryError("the first row is at 0 s and not where the arm starts: it needs time to get there")
        return samples
    rates = [None if values is None else np.vstack([np.zeros_like(q0), values]) for values in (samples.v, samples.a)]
    return replace(
        samples,
        t=np.concatenate([[0.0], samples.t + first]),
        first=0.0,
        q=np.vstack([q0, q]),
        v=rates[0],
        a=rates[1],
        stated=None if samples.stated is None else np.concatenate([[2], samples.stated]),
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class JudgedMessage:
    """A trajectory of a file and the verifier's answer on it; true if it is proved to be safe.

    Attributes:
        number: Which of the file's, from 1.
        count: How many the file holds.
        check: The answer.
        notes: What has to be known of how the file was read, such as joints that were left out.
    """

    number: int
    count: int
    check: Check
    notes: tuple[str, ...]

    @property
    def safe(self) -> bool:
        """Whether it is proved to be safe."""
        return self.check.safe

    def __bool__(self) -> bool:
        return self.safe


def check_messages(
    scene: Scene,
    path: str | Path,
    *,
    message: int | None = None,
    joints: Sequence[str] | None = None,
    start: ArrayLike | None = None,
    open_end: bool = False,
    margin: float = 0.0,
    limit_tolerance: float = 0.0,
    timeout: float | None = None,
) -> list[JudgedMessage]:
    """Return the verifier's answer on each trajectory in the file at ``path``.

    A file that a topic was written to may hold several messages; each is judged by itself, not how the arm gets from
    the end of one to the start of the next.

    Args:
        scene: Arm and obstacles.
        path: As for ``check_file``.
        message: Judge this one alone, from 1.
        joints: As for ``check_file``.
        start: Where the arm stands at 0 s, shape ``(joints,)`` (rad), as for ``check``.
        open_end: Parts of longer motions, as for ``check``.
        margin: Clearance to keep (m).
        limit_tolerance: By what share motion limits may be exceeded, besides what the rounding of the rows explains.
            Contact and joint limits know none.
        timeout: When to give up on one of them (s).

    Raises:
        TrajectoryError: The file cannot be read, or one of its messages is no trajectory of this arm.
        BadSetting: There is no such message, or the names of the joints make no sense.
        TimedOut: The timeout came first.
    """
    found = _found(scene, path, joints)
    chosen = range(1, len(found) + 1) if message is None else [message]
    return [
        _answer(
            scene,
            path,
            found,
            number,
            joints,
            start=start,
            open_end=open_end,
            margin=margin,
            limit_tolerance=limit_tolerance,
            timeout=timeout,
        )
        for number in chosen
    ]


def check_file(
    scene: Scene,
    path: str | Path,
    *,
    message: int | None = None,
    joints: Sequence[str] | None = None,
    start: ArrayLike | None = None,
    open_end: bool = False,
    margin: float = 0.0,
    limit_tolerance: float = 0.0,
    timeout: float | None = None,
) -> Check:
    """Return the verifier's answer on the trajectory in the file at ``path``: our CSV, or a JointTrajectory.

    Args:
        scene: Arm and obstacles.
        path: CSV with ``time_s,q1_rad,q2_rad,...`` and, if known, ``v1_rad_s,...`` and ``a1_rad_s2,...``, whose times
            may be those of any clock: they count from the first row. Or a JSON or YAML dump of a ROS 2
            ``trajectory_msgs/JointTrajectory``, whose times count from the start of the motion.
        message: Which one, from 1, of a file that holds several; ``check_messages`` judges them all.
        joints: The joints' names in a JointTrajectory, base first, where they do not end in 1, 2, ... or the file has
            others too, which are left out.
        start: Where the arm stands at 0 s, shape ``(joints,)`` (rad), for a file whose first row is later than that.
        open_end: It is a part of a longer motion, and may begin and end while joints move.
        margin: Clearance to keep (m).
        limit_tolerance: By what share motion limits may be exceeded, besides what the rounding of the rows explains.
            Contact and joint limits know none.
        timeout: When to give up (s).

    Raises:
        TrajectoryError: The file cannot be read or is no trajectory of this arm, or holds several messages.
        BadSetting: There is no such message, or the names of the joints make no sense.
        TimedOut: The timeout came first.
    """
    found = _found(scene, path, joints)
    if message is None and len(found) > 1:
        raise TrajectoryError(
            f"{path}: {len(found)} messages, of which one alone would be judged: name it, message=1 to {len(found)}, "
            "or have check_messages judge them all"
        )
    number = 1 if message is None else message
    return _answer(
        scene,
        path,
        found,
        number,
        joints,
        start=start,
        open_end=open_end,
        margin=margin,
        limit_tolerance=limit_tolerance,
        timeout=timeout,
    ).check


def _found(scene: Scene, path: str | Path, joints: Sequence[str] | None) -> list[Message]:
    """The messages of the file, to be read with these names of joints."""
    need_scene(scene)
    if joints is not None:
        if twice := next((name for i, name in enumerate(joints) if name in joints[:i]), None):
            raise BadSetting(
                f"joints names '{twice}' twice; each joint of the arm has one of its own", setting="joints"
            )
        if len(joints) != len(scene.arm.joints):
            message = f"joints names {len(joints)}; the arm has {len(scene.arm.joints)} joints"
            raise BadSetting(message, setting="joints")
    try:
        return read_messages(Path(path))
    except TrajectoryError as error:
        raise TrajectoryError(f"{path}: {error}") from None


def _answer(
    scene: Scene,
    path: str | Path,
    found: Sequence[Message],
    number: int,
    joints: Sequence[str] | None,
    *,
    start: ArrayLike | None,
    open_end: bool,
    margin: float,
    limit_tolerance: float,
    timeout: float | None,
) -> JudgedMessage:
    if not (is_whole(number, least=1) and number <= len(found)):
        raise BadSetting(f"message is {number}; {path} holds {len(found)}, counted from 1", setting="message")
    try:
        samples = found[number - 1].read(joints=len(scene.arm.joints), names=joints)
        answer = judged(
            scene,
            samples,
            start=start,
            open_end=open_end,
            margin=margin,
            limit_tolerance=limit_tolerance,
            timeout=timeout,
        )
    except TrajectoryError as error:
        which = f" message {number}:" if len(found) > 1 else ""
        raise TrajectoryError(f"{path}:{which} {error}") from None
    notes = samples.notes
    if (greatest := float(np.abs(samples.q).max(initial=0.0))) > FAR:
        notes = (
            *notes,
            f"positions are up to {greatest:.3g} rad, {greatest / math.tau:.1f} revolutions: are they degrees?",
        )
    if samples.first != 0.0 and not samples.since_start and start is None and not _moves(scene):
        notes = (*notes, f"times count from the first row, which is at {samples.first:.17g} s in the file")
    return JudgedMessage(number=number, count=len(found), check=answer, notes=notes)
