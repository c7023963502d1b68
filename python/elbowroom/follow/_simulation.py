"""The arm and the obstacles in steps."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import numpy as np

from elbowroom._core import interpolated, verify
from elbowroom._errors import BadSetting
from elbowroom._replanner import Replanner
from elbowroom._samples import Floats, sampled
from elbowroom._scene import Pair, Scene
from elbowroom._world import World
from elbowroom.follow._courses import as_recorded
from elbowroom.follow._followed import Followed, Step
from elbowroom.follow._goal import Goal

MOST_STEPS = 100_000
"""Updates that are simulated at most."""

MOST_RECORDED = 10_000
"""Way-points that a course has at most; one that chases gets one a step."""

LONGEST_ROW = 10
"""Samples of the executed motion are at most so far apart (ms); the joints' polynomials begin and end at whole ones."""


def follow(
    scene: Scene,
    *,
    task: str | None = None,
    rate: float = 50.0,
    horizon: float = 60.0,
    seed: int = 0,
    deadline: float | None = None,
    timeout: float | None = None,
    on_step: Callable[[float], None] | None = None,
) -> Followed:
    """Return what an arm does that is replanned ``rate`` times a second until it rests at the goal.

    Time stands still while an update is made: with the same seed and no deadline the arm does the same on any machine.

    Args:
        scene: Arm and obstacles.
        task: Which one; may be left out if there is only one.
        rate: Updates a second (Hz); a step has to be a whole number of milliseconds.
        horizon: How long the arm has (s, simulated).
        seed: Of the replanner.
        deadline: Of an update (s, real); None for as long as it likes.
        timeout: When to give up (s, real).
        on_step: Called with the simulated time (s) before each update.

    Raises:
        UnknownTask: The scene has no such task.
        NotFree: The arm cannot stand at the start, or at the goal whatever moves.
        BadSetting: A number makes no sense, or the arm has more than two links.
    """
    period = _period(rate)
    steps_at_most = _steps_at_most(scene, horizon, period)
    if timeout is not None and not timeout >= 0.0:
        raise BadSetting(f"timeout is {timeout} s, it must not be negative", setting="timeout")
    replanner = Replanner(scene, task=task, seed=seed)
    goal = Goal.of(scene, replanner.task)
    world = World(scene)
    chasers = [i for i, obstacle in enumerate(scene.obstacles) if obstacle.motion and obstacle.motion.chases]
    recorded: dict[int, list[tuple[float, Pair]]] = {i: [(0.0, world.shifts[i])] for i in chasers}
    row = math.gcd(period, LONGEST_ROW)
    rest = np.zeros_like(replanner.start)
    q, v, a = replanner.start, rest, rest
    rows: list[tuple[float, Floats, Floats, Floats]] = [(0.0, q, v, a)]
    steps: list[Step] = []
    begun = time.monotonic()
    reached = given_up = False
    for k in range(steps_at_most + 1):
        now = k * period / 1000
        if on_step is not None:
            on_step(now)
        known = world.known(q=q)
        update = replanner.update(known, now=now, q=q, v=v, a=a, deadline=deadline)  # type: ignore[arg-type]
        steps.append(
            Step(
                time=now,
                known=known,
                decision=update.decision,
                motion=update.motion,
                reaches_goal=update.reaches_goal and goal.is_at(update.at(update.motion.end)),
                safe=update.safe,
                seconds=update.seconds,
            )
        )
        reached = goal.is_at(update.at(now))
        given_up = timeout is not None and time.monotonic() - begun >= timeout
        if reached or given_up or k == steps_at_most:
            break
        after = np.array([ms / 1000 for ms in range(k * period + row, (k + 1) * period + 1, row)])
        ahead = update.at(after)
        rows += zip(after.tolist(), ahead.q, ahead.v, ahead.a, strict=True)
        q, v, a = ahead.q[-1], ahead.v[-1], ahead.a[-1]
        world.advance(float(after[-1]), q=q)
        for i in chasers:
            recorded[i].append((float(after[-1]), world.shifts[i]))
    t = np.array([row[0] for row in rows])
    states = [np.array([row[k] for row in rows]) for k in (1, 2, 3)]
    true_scene = as_recorded(scene, recorded)
    # Where time ran out the arm may be on its way, and one that was there already has not moved.
    motion, curve, _ = interpolated(t, *states)
    judged = verify(true_scene, motion, curve=curve, margin=0.0)
    return Followed(
        scene=scene,
        true_scene=true_scene,
        task=replanner.task,
        rate=rate,
        horizon=horizon,
        seed=seed,
        deadline=deadline,
        steps=steps,
        samples=sampled(scene, judged.motion, t),
        check=judged,
        reached=reached,
        given_up=given_up and not reached,
    )


def _period(rate: float) -> int:
    """The time between updates (ms)."""
    if not (math.isfinite(rate) and 1.0 <= rate <= 1000.0):
        raise BadSetting(f"rate is {rate} Hz, it must be from 1 to 1000 Hz", setting="rate")
    period = round(1000 / rate)
    if not math.isclose(1000 / period, rate, rel_tol=1e-9):
        slower, faster = 1000 / math.ceil(1000 / rate), 1000 / math.floor(1000 / rate)
        raise BadSetting(
            f"rate is {rate:g} Hz, but a step has to be a whole number of milliseconds: "
            f"try {slower:.6g} or {faster:.6g} Hz",
            setting="rate",
        )
    return period


def _steps_at_most(scene: Scene, horizon: float, period: int) -> int:
    if not (math.isfinite(horizon) and horizon > 0.0):
        raise BadSetting(f"horizon is {horizon} s, it must be finite and greater than 0", setting="horizon")
    steps = math.ceil(horizon * 1000 / period - 1e-9)
    chases = any(obstacle.motion is not None and obstacle.motion.chases for obstacle in scene.obstacles)
    most = MOST_RECORDED - 1 if chases else MOST_STEPS
    if steps > most:
        raise BadSetting(
            f"horizon is {horizon:g} s, which makes {steps} steps; at most {most} are simulated"
            + (" with an obstacle that chases" if chases else ""),
            setting="horizon",
        )
    return steps
