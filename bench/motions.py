"""How long motions take, and what a clearance costs: writes the tables and the picture of docs/motions.md."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import elbowroom as er
from elbowroom import figures

TASKS: tuple[tuple[str, str, float], ...] = (
    ("abb-irb-910sc-065", "pick", 1.629),
    ("abb-irb-910sc-065", "place", 1.852),
    ("fanuc-sr-3ia", "shelf", 2.031),
    ("fanuc-sr-3ia", "across", 2.276),
    ("paper-standin", "first", 2.536),
    ("paper-standin", "second", 2.775),
    ("narrow", "first", 3.279),
    ("narrow", "second", 2.992),
)
"""Scene, task, and the shortest duration that is known (s), by collocation with IPOPT from many starts, or by ours."""

CLEARANCES = (0.0, 0.002, 0.005, 0.01, 0.02, 0.03, 0.04, 0.05)
"""What is asked for (m)."""

WEIGHED = (("abb-irb-910sc-065", "place"), ("paper-standin", "first"))
"""Scenes and tasks of the curve of clearance and time."""


def durations(tasks: Sequence[tuple[str, str, float]]) -> list[str]:
    """Return the table of durations by objective."""
    rows = [
        "| scene | task | shortest known (s) | `time` (s) | `tip` (s) | tip travel (m) | `tip`, no slack (s) "
        "| `joint` (s) | joint travel (rad) |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for name, task, best in tasks:
        scene = er.Scene.example(name)
        time, tip, joint = (er.plan(scene, task=task, objective=objective) for objective in ("time", "tip", "joint"))
        strict = er.plan(scene, task=task, objective="tip", slack=0.0)
        rows.append(
            f"| {name} | {task} | {best:.3f} | {time.motion.duration:.3f} | {tip.motion.duration:.3f} | {tip.cost:.4f} "
            f"| {strict.motion.duration:.3f} | {joint.motion.duration:.3f} | {joint.cost:.4f} |"
        )
    return rows


def kept(name: str, task: str, clearances: Sequence[float]) -> list[tuple[float, float, float]]:
    """Return asked clearance (m), least clearance (m) and duration (s), as long as there is a motion."""
    found = []
    for clearance in clearances:
        try:
            plan = er.plan(er.Scene.example(name), task=task, objective="time", clearance=clearance)
        except (er.NotFree, er.NoPath, er.NotFound):
            break
        least = plan.verdict.least_clearance
        assert least is not None
        found.append((clearance, least.distance, plan.motion.duration))
    return found


def weighed(clearances: Sequence[float]) -> list[str]:
    """Return the table of what clearances cost."""
    rows = ["| scene | task | asked (mm) | least on the way (mm) | duration (s) |", "|---|---|---|---|---|"]
    for name, task in WEIGHED:
        for asked, least, duration in kept(name, task, clearances):
            rows.append(f"| {name} | {task} | {1e3 * asked:g} | {1e3 * least:.2f} | {duration:.3f} |")
    return rows


def drawn(out: Path) -> None:
    """Draw the curve of clearance and time."""
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(6.4, 4.0), layout="constrained")
    for (name, task), marker in zip(WEIGHED, ("o", "s"), strict=True):
        curve = kept(name, task, CLEARANCES)
        axes.plot(
            [1e3 * asked for asked, _, _ in curve], [d for _, _, d in curve], marker=marker, label=f"{name}, {task}"
        )
    axes.set_xlabel("clearance asked for (mm)")
    axes.set_ylabel("duration (s)")
    axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
    axes.legend()
    figures.save(figure, out)


def filled(lines: Sequence[str], table: Sequence[str]) -> list[str]:
    """Return ``lines`` with ``table`` in place of the one that has the same header."""
    begin = list(lines).index(table[0])
    end = next((i for i in range(begin, len(lines)) if not lines[i].startswith("|")), len(lines))
    return [*lines[:begin], *table, *lines[end:]]


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("docs/motions.md"))
    options = parser.parse_args()
    lines = options.out.read_text(encoding="utf-8").splitlines()
    for table in (durations(TASKS), weighed(CLEARANCES)):
        lines = filled(lines, table)
    options.out.write_text("\n".join(lines) + "\n", encoding="utf-8")
    drawn(options.out.parent / "images" / "clearance_time.png")


if __name__ == "__main__":
    main()
