"""How the scenes in which obstacles move end, and how long updates take: fills in the table of docs/moving.md."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import elbowroom as er
from elbowroom._core import measured
from elbowroom.follow import Followed, follow

SCENES = {
    "moving-one": "a disc crosses the path; the arm times its passing",
    "moving-three": "three discs come and go; the arm waits a moment and passes between them",
    "door": "the door shuts at once; the arm waits until it opens",
    "goal-blocked": "a disc stops on the goal; the arm arrives as it leaves",
    "chase": "a disc comes after the tip; the arm gets away",
    "late": "one disc appears on the path, the arm reverses; another comes near, it evades",
}
"""What happens in each."""


def outcome(name: str) -> tuple[str, Followed]:
    """Return all of a scene's row that is the same on every machine, and the run that it tells of."""
    followed = follow(er.Scene.example(name), seed=0)
    least = followed.check.verdict.least_clearance
    if followed.outcome != "reached" or least is None:
        raise SystemExit(f"{name}: {followed.outcome}")
    motions = sum(step.decision == "new" for step in followed.steps)
    clearance = measured(1e3 * least.distance)
    return f"| `{name}` | {SCENES[name]} | {followed.duration:.2f} | {motions} | {clearance} |", followed


def row(name: str, runs: int) -> str:
    """Return a scene's row, of the time of each update the median of so many equal runs."""
    told, first = outcome(name)
    seconds = np.median([first.update_times, *(outcome(name)[1].update_times for _ in range(runs - 1))], axis=0)
    times = (measured(1e3 * float(np.quantile(seconds, share))) for share in (0.5, 0.99, 0.999))
    return f"{told} {' / '.join(times)} |"


def main() -> None:
    """Write the rows into the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--out", type=Path, default=Path("docs/moving.md"))
    options = parser.parse_args()
    lines = options.out.read_text(encoding="utf-8").splitlines()
    rows = {name: row(name, options.runs) for name in SCENES}
    filled = [next((rows[name] for name in SCENES if line.startswith(f"| `{name}` |")), line) for line in lines]
    options.out.write_text("\n".join(filled) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
