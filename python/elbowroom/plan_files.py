"""A plan as files: ``plan.json`` and ``trajectory.csv``, all SI."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from elbowroom._core import TICK, __version__
from elbowroom.plan import Plan, Samples
from elbowroom.trajectory_files import RATES, columns_of


def columns(joints: int) -> list[str]:
    """Return the columns of ``trajectory.csv`` for an arm of so many joints."""
    rates = [name for letter, unit, _ in RATES for name in columns_of(joints, letter, unit)]
    return ["time_s", *columns_of(joints), *rates, "x_m", "y_m"]


def as_json(plan: Plan) -> dict[str, Any]:
    """Return ``plan`` as what ``plan.json`` holds."""
    starts, durations = plan.motion.starts.tolist(), plan.motion.durations.tolist()
    coefficients = plan.motion.coefficients.tolist()
    return {
        "version": __version__,
        "scene": plan.scene.file,
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
        "jumps": [{"index": index, "kind": kind} for index, kind in plan.jumps],
        "vias": plan.vias,
        "stops": plan.stops,
        "assumed_limits": [
            {"joint": joint, "rate": rate, "value": value} for joint, rate, value in plan.assumed_limits
        ],
        "pieces": [
            {"start": start, "duration": duration, "coefficients": of_joints}
            for start, duration, of_joints in zip(starts, durations, coefficients, strict=True)
        ],
        "verified": plan.verdict is not None and bool(plan.verdict["safe"]),
        "verdict": plan.verdict,
        "evaluations": plan.evaluations,
        "convergence": None if plan.convergence is None else [list(point) for point in plan.convergence],
        "timings_s": plan.timings,
    }


def write_plan(plan: Plan, folder: Path) -> list[Path]:
    """Write ``plan.json`` and ``trajectory.csv`` into ``folder``, which is made if need be; return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    document = folder / "plan.json"
    document.write_text(json.dumps(as_json(plan), indent=1, allow_nan=False) + "\n", encoding="utf-8")
    table = folder / "trajectory.csv"
    table.write_text(as_csv(plan), encoding="utf-8", newline="")
    return [document, table]


def as_csv(plan: Plan) -> str:
    """Return the motion every 10 ms, both ends included, as text of floats that round-trip."""
    return table(plan.sample(period=TICK))


def table(samples: Samples) -> str:
    """Return ``samples`` as the text of a ``trajectory.csv``, floats that round-trip."""
    values = [samples.t, *samples.q.T, *samples.v.T, *samples.a.T, *samples.tip.T]
    rows = zip(*(column.tolist() for column in values), strict=True)
    header = ",".join(columns(samples.q.shape[1]))
    return "\n".join([header, *(",".join(map(repr, row)) for row in rows)]) + "\n"
