"""Time parametrisation of one path: toppra and ruckig beside the core."""

from __future__ import annotations

import json
import statistics
from functools import partial

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench import time_peers
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


def by_toppra(scene: er.Scene, vias: Floats, limits: Floats) -> Entry:
    """A cubic spline through the vias, then TOPP-RA with limits on velocity and acceleration."""
    ms, found = median_ms(time_peers.by_toppra(vias, limits, "ParametrizeConstAccel"), RUNS)
    t, q, v, _ = time_peers.toppra_rows(found, PERIOD)
    return entry(scene, "toppra", ms, t, q, v)


def by_ruckig(scene: er.Scene, vias: Floats, limits: Floats) -> Entry:
    """Straight turns from stop to stop."""
    ms, pieces = median_ms(time_peers.by_ruckig(vias, limits), RUNS)
    t, q, v, _ = time_peers.ruckig_rows(pieces, PERIOD)
    return entry(scene, "ruckig, a stop at every via", ms, t, q, v)


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
        of_joints = np.outer(limits, np.ones(len(scene.arm.joints)))
        comparisons.append(
            Comparison(
                f"{name}.yaml, task {task}: {len(vias)} vias",
                [
                    Entry("elbowroom, timed and verified", statistics.median(ours["verified_ms"]), said),
                    Entry("elbowroom, timed only", statistics.median(ours["times_ms"]), "the same polynomials"),
                    attempt("toppra", partial(by_toppra, scene, vias, of_joints)),
                    attempt("ruckig", partial(by_ruckig, scene, vias, of_joints)),
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
