"""How near the least time along their own path motions of ``tip`` and ``joint`` are: writes a table of docs/motions.md.

Needs CasADi: ``.venv-bench/bin/python -m bench.along_path``.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import elbowroom as er
from bench.joint_path import of_motion
from bench.least_time import bound, timed
from bench.motion_limits import limits_of
from bench.motions import TASKS, filled

CELLS, CELLS_OF_BOUND = 12, 60
"""Of each piece of a motion."""


def table(tasks: Sequence[tuple[str, str, float]]) -> list[str]:
    """Return the rows, a task and an objective each."""
    rows = [
        "| scene | task | objective | duration (s) | least time along its path (s) | ratio "
        "| least without jerk limits (s) |",
        "|---|---|---|---|---|---|---|",
    ]
    for name, task, _ in tasks:
        scene = er.Scene.example(name)
        limits = limits_of(scene)
        for objective in ("tip", "joint"):
            motion = er.plan(scene, task=task, objective=objective).motion
            least = timed(of_motion(motion, CELLS), limits).duration
            below = bound(of_motion(motion, CELLS_OF_BOUND), limits)
            rows.append(
                f"| {name} | {task} | `{objective}` | {motion.duration:.3f} | {least:.3f} "
                f"| {motion.duration / least:.3f} | {below:.3f} |"
            )
    return rows


def main() -> None:
    """Write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("docs/motions.md"))
    out = parser.parse_args().out
    lines = filled(out.read_text(encoding="utf-8").splitlines(), table(TASKS))
    out.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
