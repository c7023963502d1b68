"""A plan as files: ``plan.json`` and ``trajectory.csv``, all SI."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from elbowroom._core import MAX_ROWS, TICK, PaperPlan, Plan, __version__
from elbowroom._errors import BadSetting
from elbowroom._plan import AnyPlan
from elbowroom._samples import Samples
from elbowroom._trajectory_files import RATES, columns_of
from elbowroom._whole_files import write_whole

ON_TICK = 1e-6
"""How far from a tick, in ticks, pieces meet that meet on it."""


def columns(joints: int) -> list[str]:
    """Return the columns of ``trajectory.csv`` for an arm of so many joints."""
    rates = [name for letter, unit in RATES for name in columns_of(joints, letter, unit)]
    return ["time_s", *columns_of(joints), *rates, "x_m", "y_m"]


def as_json(plan: AnyPlan) -> dict[str, Any]:
    """Return ``plan`` as what ``plan.json`` holds."""
    starts, durations = plan.motion.starts.tolist(), plan.motion.durations.tolist()
    coefficients = plan.motion.coefficients.tolist()
    proved = plan if isinstance(plan, Plan) else None
    drawn = plan if isinstance(plan, PaperPlan) else None
    return {
        "version": __version__,
        "scene": plan.scene.file,
        "scene_sha256": plan.scene.sha256,
        "task": plan.task,
        "planner": plan.planner,
        "settings": plan.settings,
        "seed": plan.seed,
        "objective": plan.objective,
        "cost": plan.cost,
        "path_cost": plan.path_cost,
        "lower_bound": plan.lower_bound,
        "gap": plan.gap,
        "tip_path": plan.tip_path.tolist(),
        "configurations": plan.configurations.tolist(),
        "postures": plan.postures,
        "jumps": [{"index": index, "kind": kind} for index, kind in (drawn.jumps if drawn is not None else [])],
        "vias": plan.vias,
        "stops": proved.stops if proved is not None else 0,
        "assumed_limits": [
            {"joint": joint, "rate": rate, "value": value}
            for joint, rate, value in (proved.assumed_limits if proved is not None else [])
        ],
        "pieces": [
            {"start": start, "duration": duration, "coefficients": of_joints}
            for start, duration, of_joints in zip(starts, durations, coefficients, strict=True)
        ],
        "clearance": proved.clearance if proved is not None else 0.0,
        "verified": proved is not None,
        "verdict": proved.verdict.as_dict() if proved is not None else None,
        "evaluations": proved.evaluations if proved is not None else None,
        "convergence": proved.convergence if proved is not None else None,
        "timings_s": plan.timings,
    }


def check_length(duration: float) -> None:
    """Refuse a motion of ``duration`` (s) whose ``trajectory.csv`` would be too long to be read again.

    Raises:
        BadSetting: It is.
    """
    # So long that rows cannot be counted is for others to refuse.
    if duration / TICK > MAX_ROWS - 1 and math.isfinite(duration):
        longest = (MAX_ROWS - 1) * TICK
        message = (
            f"a motion of {duration:g} s does not fit into trajectory.csv, whose rows are {TICK} s apart: at most "
        )
        raise BadSetting(f"{message}{longest:g} s do", setting="out")


def write_plan(plan: AnyPlan, folder: Path) -> list[Path]:
    """Write ``plan.json`` and ``trajectory.csv`` into ``folder``, which is made if need be; return their paths.

    Raises:
        BadSetting: The motion is too long for a table of it.
        OSError: The folder cannot be written to; no file is left half written.
    """
    check_length(plan.motion.duration)
    folder.mkdir(parents=True, exist_ok=True)
    return [
        write_whole(folder / "plan.json", json.dumps(as_json(plan), indent=1, allow_nan=False) + "\n"),
        write_whole(folder / "trajectory.csv", as_csv(plan)),
    ]


def as_csv(plan: AnyPlan) -> str:
    """Return the motion every 10 ms or somewhat less, both ends included, as text of floats that round-trip.

    There is a row wherever two pieces of a verified motion meet, so that what is read back is the motion itself.
    """
    starts, durations = plan.motion.starts, plan.motion.durations
    on_ticks = np.abs(starts / TICK - np.round(starts / TICK)) < ON_TICK
    if isinstance(plan, PaperPlan) or bool(on_ticks.all()):
        return table(plan.sample(period=TICK))
    rows = [
        start + duration * np.arange(count) / count
        for start, duration, count in zip(starts, durations, np.ceil(durations / TICK - ON_TICK), strict=True)
    ]
    return table(plan.at(np.append(np.concatenate(rows), plan.motion.duration)))


def table(samples: Samples) -> str:
    """Return ``samples`` as the text of a ``trajectory.csv``, floats that round-trip."""
    values = [samples.t, *samples.q.T, *samples.v.T, *samples.a.T, *samples.tip.T]
    rows = zip(*(column.tolist() for column in values), strict=True)
    header = ",".join(columns(samples.q.shape[1]))
    return "\n".join([header, *(",".join(map(repr, row)) for row in rows)]) + "\n"
