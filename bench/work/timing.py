"""Time parametrisation of one path: toppra and ruckig beside the core."""

from __future__ import annotations

import json
import statistics
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench.clock import OUT, ROOT, core, median_ms
from bench.entries import Comparison, Entry, Section, Table, attempt

Floats = NDArray[np.float64]

CASES = (("paper-standin", "first"), ("narrow", "second"))
RUNS = 15
PERIOD = 0.01

PROMISES = (
    ("elbowroom", "polynomials, contact and limits proved on them", "kept", "kept"),
    (
        "toppra",
        "time-optimal on the spline, up to its grid; contact is not its business",
        "kept at grid points",
        "none",
    ),
    ("ruckig", "time-optimal from stop to stop, exact; contact is not its business", "kept", "kept"),
)


def by_toppra(scene: er.Scene, vias: Floats, limits: list[float]) -> Entry:
    """A cubic spline through the vias, then TOPP-RA with limits on velocity and acceleration."""
    import toppra
    from toppra import algorithm, constraint

    toppra.setup_logging("ERROR")
    velocity, acceleration, _ = limits
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(vias, axis=0), axis=1))])
    bounds = [
        constraint.JointVelocityConstraint(np.full(2, velocity)),
        constraint.JointAccelerationConstraint(np.full(2, acceleration)),
    ]

    def timed() -> Any:
        path = toppra.SplineInterpolator(along, vias)
        return algorithm.TOPPRA(bounds, path, parametrizer="ParametrizeConstAccel").compute_trajectory()

    ms, found = median_ms(timed, RUNS)
    t = np.append(np.arange(0.0, found.duration, PERIOD), found.duration)
    return entry(scene, "toppra", ms, t, found(t), found(t, 1))


def by_ruckig(scene: er.Scene, vias: Floats, limits: list[float]) -> Entry:
    """Straight turns from stop to stop: passing through vias is left to ruckig's cloud service, which is not asked."""
    from ruckig import InputParameter, Result, Ruckig, Synchronization, Trajectory

    def timed() -> list[Any]:
        otg, pieces = Ruckig(2), []
        for here, there in pairwise(vias):
            given = InputParameter(2)
            given.current_position, given.target_position = here.tolist(), there.tolist()
            given.max_velocity, given.max_acceleration, given.max_jerk = ([limit] * 2 for limit in limits)
            given.synchronization = Synchronization.Phase
            piece = Trajectory(2)
            if otg.calculate(given, piece) not in (Result.Working, Result.Finished):
                raise RuntimeError("ruckig found no trajectory")
            pieces.append(piece)
        return pieces

    ms, pieces = median_ms(timed, RUNS)
    t: list[float] = []
    q: list[list[float]] = []
    v: list[list[float]] = []
    begin = 0.0
    for piece in pieces:
        for at in np.linspace(0.0, piece.duration, 1 + int(np.ceil(piece.duration / PERIOD)))[bool(t) :]:
            position, speed, _ = piece.at_time(at)
            t.append(begin + at)
            q.append(position)
            v.append(speed)
        begin += piece.duration
    return entry(scene, "ruckig, a stop at every via", ms, np.array(t), np.array(q), np.array(v))


def entry(scene: er.Scene, who: str, ms: float, t: Floats, q: Floats, v: Floats) -> Entry:
    """Return the entry of a timed path, judged by our verifier as a controller would run its samples."""
    check = er.check(scene, t=t, q=q, v=v)
    contacts = [violation for violation in check.verdict.violations if violation.kind == "contact"]
    others = sorted({violation.kind for violation in check.verdict.violations} - {"contact"})
    said = f"**meets {len(contacts)} obstacles**" if contacts else "free of contact"
    return Entry(who, ms, f"{t[-1]:.2f} s, {said}{', ' if others else ''}{', '.join(others)}")


def measure() -> Section:
    """Return the section."""
    comparisons = []
    for name, task in CASES:
        scene = er.Scene.example(name)
        plan = er.plan(scene, task=task, planner="dstar-pso", objective="time", seed=1)
        vias = plan.configurations[plan.vias]
        file = OUT / f"vias_{name}_{task}.json"
        file.write_text(json.dumps(vias.tolist()))
        ours = core("timing", ROOT / "scenes" / f"{name}.yaml", file, RUNS)
        said = f"{ours['duration']:.2f} s, {'proved safe' if ours['safe'] else '**not proved safe**'}"
        limits = ours["limits"]
        comparisons.append(
            Comparison(
                f"{name}.yaml, task {task}: {len(vias)} vias",
                [
                    Entry("elbowroom, timed and verified", statistics.median(ours["verified_ms"]), said),
                    Entry("elbowroom, timed only", statistics.median(ours["times_ms"]), "the same polynomials"),
                    attempt("toppra", partial(by_toppra, scene, vias, limits)),
                    attempt("ruckig", partial(by_ruckig, scene, vias, limits)),
                ],
            )
        )
    words = f"""
The vias of one plan of ours, timed by each under the same limits: {limits[0]:.3f} rad/s, {limits[1]:.3f} rad/s²,
{limits[2]:.3f} rad/s³ a joint. The curves through the vias differ, so the durations do not compare one quality: the
second table says what each promises. Contact is judged by our verifier on samples every 10 ms, as a controller
would run them.
"""
    header = ("who", "what it promises", "velocity and acceleration", "jerk")
    return Section("timing", "Time along a path", words.strip(), comparisons, [Table("Promises", header, PROMISES)])
