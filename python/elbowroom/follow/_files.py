"""What was followed as files, all SI: ``follow.json``, ``decisions.jsonl`` and ``trajectory.csv``."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from elbowroom._core import __version__
from elbowroom._known import Known, Sighting
from elbowroom._plan_files import table
from elbowroom._whole_files import write_whole
from elbowroom.follow._followed import Followed, Step


def summary(followed: Followed) -> dict[str, Any]:
    """Return what ``follow.json`` holds."""
    decisions = Counter(step.decision for step in followed.steps)
    seconds = followed.update_times
    return {
        "version": __version__,
        "scene": followed.scene.file,
        "task": followed.task,
        "rate_hz": followed.rate,
        "horizon_s": followed.horizon,
        "seed": followed.seed,
        "deadline_s": followed.deadline,
        "outcome": followed.outcome,
        "reached": followed.reached,
        "given_up": followed.given_up,
        "duration_s": followed.duration,
        "decisions": {name: decisions[name] for name in ("keep", "new", "stop")},
        "updates": len(followed.steps),
        "updates_not_safe": sum(not step.safe for step in followed.steps),
        "update_s": {
            "median": float(np.median(seconds)),
            "p99": float(np.quantile(seconds, 0.99)),
            "p99.9": float(np.quantile(seconds, 0.999)),
            "greatest": float(seconds.max()),
            "longer_than_a_step": int(np.count_nonzero(seconds > 1.0 / followed.rate)),
        },
        "verdict": followed.check.verdict.as_dict(),
    }


def write_followed(followed: Followed, folder: Path) -> list[Path]:
    """Write the three files into ``folder``, which is made if need be; return their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    texts = {
        "follow.json": json.dumps(summary(followed), indent=1, allow_nan=False) + "\n",
        "decisions.jsonl": "".join(json.dumps(record(followed, step)) + "\n" for step in followed.steps),
        "trajectory.csv": table(followed.samples),
    }
    for name, text in texts.items():
        write_whole(folder / name, text)
    return [folder / name for name in texts]


def record(followed: Followed, step: Step) -> dict[str, Any]:
    """Return the line of ``step`` in ``decisions.jsonl``."""
    row = int(np.searchsorted(followed.samples.t, step.time - 1e-9))
    return {
        "time_s": step.time,
        "decision": step.decision,
        "reaches_goal": step.reaches_goal,
        "safe": step.safe,
        "motion_ends_s": step.motion.end,
        "update_s": step.seconds,
        "q_rad": followed.samples.q[row].tolist(),
        "v_rad_s": followed.samples.v[row].tolist(),
        "a_rad_s2": followed.samples.a[row].tolist(),
        "known": {_name(followed, index): _word(known) for index, known in step.known.items()},
    }


def _name(followed: Followed, index: int) -> str:
    return followed.scene.obstacles[index].name or str(index)


def _word(known: Known) -> str:
    if known is None:
        return "unseen"
    return "sighting" if isinstance(known, Sighting) else "course"
