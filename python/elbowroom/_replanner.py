"""Planning while the arm moves."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from elbowroom import _core
from elbowroom._core import Verdict
from elbowroom._errors import BadSetting, NotFree
from elbowroom._known import Known, all_known
from elbowroom._plan import located
from elbowroom._samples import Floats, Samples, sampled
from elbowroom._scene import Scene, need_scene
from elbowroom._whole import check_whole
from elbowroom._world import joint_values

Decision = Literal["keep", "new", "stop"]


@dataclass(frozen=True, eq=False, kw_only=True)
class Update:
    """What an update came to.

    Attributes:
        decision: ``keep`` the running motion, run a ``new`` one from now on, or ``stop``: come to rest on one that is
            not proved to be safe, because nothing better was found in time.
        motion: The one that now runs, in the replanner's time; it ends at rest, and after its end the arm stands.
        reaches_goal: Whether it ends at the goal.
        verdict: What the verifier says of what is left of it: until the arm has come to rest and, among obstacles whose
            trajectory is known, for eight seconds more.
        seconds: How long the update took (s).
    """

    scene: Scene
    decision: Decision
    motion: _core.Motion
    reaches_goal: bool
    verdict: Verdict
    seconds: float

    @property
    def safe(self) -> bool:
        """Whether what is left of the motion is proved to be safe."""
        return self.verdict.safe

    def at(self, t: ArrayLike) -> Samples:
        """Return the motion at the instants ``t``, shape ``(n,)`` (s); beyond its ends the arm stands."""
        return sampled(self.scene, self.motion, t)


class Replanner:
    """Keeps an arm of two links going to a goal, safely, among obstacles that move.

    Call ``update`` at the rate of your controller, with the state of the arm and what is known of the obstacles that
    move, and have the arm run ``Update.motion``. What it is given always ends at rest, and takes over without a jump
    in position, velocity or acceleration.

    Args:
        scene: Arm and obstacles; those with a motion may move, the others are static.
        task: Which one; may be left out if there is only one.
        seed: Random seed: same seed, same decisions, as long as no deadline cuts an update short.
        q: Where the arm is (rad); None for the task's start, elbow-up where it may be either posture.

    Raises:
        UnknownTask: The scene has no such task.
        NotFree: The arm cannot stand at the start, or at the goal whatever moves.
        BadSetting: The arm has more than two links, or the task keeps a posture.

    Example:
        >>> import elbowroom as er
        >>> scene = er.Scene.example("moving-one")
        >>> replanner = er.Replanner(scene)
        >>> update = replanner.update(now=0.0, q=replanner.start)
        >>> update.decision, update.reaches_goal, update.safe
        ('new', True, True)
        >>> soon = update.at(0.02)  # position, velocity and acceleration for the controller
        >>> update = replanner.update(now=0.02, q=soon.q[0], v=soon.v[0], a=soon.a[0])
        >>> update.decision
        'keep'
    """

    def __init__(self, scene: Scene, *, task: str | None = None, seed: int = 0, q: ArrayLike | None = None) -> None:
        check_whole("seed", seed)
        need_scene(scene)
        if len(scene.arm.links) != 2:
            raise BadSetting(
                "planning while the arm moves needs an arm of 2 links; the arm of this scene has "
                f"{len(scene.arm.links)}",
                setting="arm",
            )
        self.scene = scene
        self.task = _core.only_task(scene, task)
        self.seed = seed
        start = None if q is None else joint_values("q", q)
        try:
            self._core = _core.Replanner(scene, self.task, seed=seed, q=start)
        except NotFree as error:
            raise (located(scene, error) if q is None or error.end == "goal" else error) from None

    @property
    def start(self) -> Floats:
        """Where the arm stands at the beginning, shape ``(2,)`` (rad)."""
        return self._core.start

    @property
    def motion(self) -> _core.Motion:
        """The motion that runs; before its start and after its end the arm stands."""
        return self._core.motion

    @property
    def reaches_goal(self) -> bool:
        """Whether it ends at the goal."""
        return self._core.reaches_goal

    def update(
        self,
        known: Mapping[int | str, Known] | None = None,
        *,
        now: float,
        q: ArrayLike,
        v: ArrayLike | None = None,
        a: ArrayLike | None = None,
        deadline: float | None = None,
    ) -> Update:
        """Return what the arm is to do now.

        Args:
            known: What is known of the obstacles that move, by name or place among the scene's: a trajectory, a
                sighting, or None for one that is not there as far as anyone knows. One left out has that of the scene.
            now: What time it is (s), of the clock that the trajectories go by.
            q: Where the joints are (rad).
            v: Their velocities (rad/s); None for an arm at rest.
            a: Their accelerations (rad/s²); None for 0.
            deadline: How long the update may search for something better (s); None for no limit. It ends
                some milliseconds later at most.

        Raises:
            BadSetting: A number makes no sense, or ``known`` does not fit the scene.
        """
        if not (math.isfinite(now) and abs(now) <= LATEST):
            raise BadSetting(f"now is {now} s, it must be finite and at most {LATEST:g} s", setting="now")
        if deadline is not None and not deadline >= 0.0:
            raise BadSetting(f"deadline is {deadline} s, it must not be negative", setting="deadline")
        begun = time.perf_counter()
        position = joint_values("q", q)
        decision, motion, reaches_goal, verdict = self._core.update(
            self.scene,
            all_known(self.scene, known or {}),
            now=now,
            q=position,
            v=np.zeros_like(position) if v is None else joint_values("v", v),
            a=np.zeros_like(position) if a is None else joint_values("a", a),
            deadline=deadline,
        )
        return Update(
            scene=self.scene,
            decision=decision,
            motion=motion,
            reaches_goal=reaches_goal,
            verdict=verdict,
            seconds=time.perf_counter() - begun,
        )


LATEST = 1e6
"""Latest time that is served (s)."""
