"""How near to the best plans are proved to be, and a task that no motion can do: writes docs/bounds.md."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import elbowroom as er
from bench.objectives import cases
from elbowroom import figures

BEST_KNOWN = {
    ("paper-standin", "first", "continuous"): 3.1415,
    ("paper-standin", "second", "continuous"): 3.4454,
    ("paper-standin", "first", "0 to 360"): 3.1415,
    ("paper-standin", "second", "0 to 360"): 4.8746,
    ("narrow", "first", "continuous"): 4.1906,
    ("narrow", "second", "continuous"): 3.5240,
    ("narrow", "first", "0 to 360"): 4.9238,
    ("narrow", "second", "0 to 360"): 5.7470,
}
"""Joint travel (rad) found by a 0.2 degree joint grid with shortcuts: a reference, not a proved optimum."""

FASTEST_KNOWN = {
    ("abb-irb-910sc-065", "pick"): 1.629,
    ("abb-irb-910sc-065", "place"): 1.852,
    ("fanuc-sr-3ia", "shelf"): 2.033,
    ("fanuc-sr-3ia", "across"): 2.276,
    ("paper-standin", "first"): 2.536,
    ("paper-standin", "second"): 2.775,
    ("narrow", "first"): 3.279,
    ("narrow", "second"): 3.014,
}
"""Duration (s) that direct transcription from many starts reached: a reference, not a proved optimum."""


def duration() -> list[str]:
    """Return the table of time, the scenes as they are."""
    rows = [
        "| scene | task | planned (s) | proved least | gap | best known | above the bound |",
        "|---|---|---|---|---|---|---|",
    ]
    for (name, task), known in FASTEST_KNOWN.items():
        plan = er.plan(er.Scene.example(name), task=task, planner="optimal", objective="time")
        assert plan.lower_bound is not None
        assert plan.gap is not None
        rows.append(
            f"| {name} | {task} | {plan.cost:.4f} | {plan.lower_bound:.4f} | {100 * plan.gap:.2f} % "
            f"| {known:.3f} | {100 * (known / plan.lower_bound - 1):.2f} % |"
        )
    return rows


def joint_travel() -> list[str]:
    """Return the table of joint travel: as planned by default and with a gap of 0.1 % asked for."""
    rows = [
        "| scene | joint 1 | task | planned (rad) | proved least | gap "
        "| with `--gap 0.001` | proved least | gap | reference |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for case in cases():
        for task in case.scene.tasks:
            known = BEST_KNOWN.get((case.name, task, case.kind))
            cells = [_cells(case.scene, task, "joint", gap) for gap in (None, 0.001)]
            reference = "" if known is None else f"{known:.4f}"
            rows.append(f"| {case.name} | {case.kind} | {task} | {cells[0]} | {cells[1]} | {reference} |")
    return rows


def tip_travel() -> list[str]:
    """Return the table of tip travel, the scenes without obstacles included."""
    rows = ["| scene | joint 1 | task | planned (cm) | proved least | gap |", "|---|---|---|---|---|---|"]
    scenes = [(case.name, case.kind, case.scene) for case in cases()]
    scenes += [(name, "continuous", er.Scene.example(name)) for name in ("paper-empty", "paper-table1")]
    for name, kind, scene in scenes:
        rows += [f"| {name} | {kind} | {task} | {_cells(scene, task, 'tip', None, 100.0)} |" for task in scene.tasks]
    return rows


def _cells(scene: er.Scene, task: str, objective: str, gap: float | None, scale: float = 1.0) -> str:
    plan = er.plan(scene, task=task, planner="optimal", objective=objective, gap=gap)  # type: ignore[arg-type]
    if plan.lower_bound is None or plan.gap is None:
        return f"{plan.cost * scale:.4f} | none | unknown"
    return f"{plan.cost * scale:.4f} | {plan.lower_bound * scale:.4f} | {100 * plan.gap:.2f} %"


def narrow_within_90(picture: Path) -> list[str]:
    """Return what is proved of `narrow` with joint 2 within 90 degrees; the proof is drawn to ``picture``."""
    scene = er.Scene.example("narrow")
    joint = er.Joint(min=-math.pi / 2, max=math.pi / 2)
    scene = scene.replace(arm=scene.arm.replace(joints=(scene.arm.joints[0], joint)))
    said = []
    for task in scene.tasks:
        try:
            plan = er.plan(scene, task=task, planner="optimal")
            said.append(f"- task {task}: a path, {plan.cost:.4f} m of tip travel")
        except er.NoPath as proof:
            said.append(f"- task {task}: **no path**, proved by the walls around {len(proof.reachable)} cells")
            figures.save(figures.no_path(scene, proof), picture)
    return said


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("docs/bounds.md"))
    options = parser.parse_args()
    picture = options.out.parent / "images" / "no_path.png"
    page = Path(__file__).with_name("bounds_page.md").read_text(encoding="utf-8")
    tables = {
        "{time}": duration(),
        "{joint}": joint_travel(),
        "{tip}": tip_travel(),
        "{narrow}": narrow_within_90(picture),
    }
    for place, rows in tables.items():
        page = page.replace(place, "\n".join(rows))
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
