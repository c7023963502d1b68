"""``report.md``: the paper's printed numbers beside ours, and what bounds them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from elbowroom._core import __version__
from elbowroom._paper.bounds import around_disc, nearest_reach, octile
from elbowroom._paper.printed import BEND, LINKS, TASKS

if TYPE_CHECKING:
    from elbowroom._free_space import FreeSpace
    from elbowroom._paper.trial import Trial

Maps = Mapping[str, tuple["FreeSpace", list[Path]]]


def as_markdown(trials: Sequence[Trial], maps: Maps, *, seed: int, folder: Path) -> str:
    """Return the report; pictures are linked relative to ``folder``."""
    parts = [
        f"# The paper's experiments, run by elbowroom {__version__}\n\n"
        "Lengths in cm. Planned as in the paper: the union of both postures, eight neighbours, grid points checked and "
        "nothing between them, quintic pieces through random via points. **None of these motions is verified.** "
        "The paper prints its obstacles only in figures: the five circles of `paper-standin` and `paper-table1` are "
        f"ours. Pictures are those of seed {seed}.",
        _printed(trials),
        _bounds(),
        _runs(trials),
        _table_1(trials),
        _cases(maps),
        _pictures(trials, maps, folder),
    ]
    return "\n\n".join(parts) + "\n"


def _printed(trials: Sequence[Trial]) -> str:
    rows = ["| paper | prints | ours | attainable? | because |", "|---|---|---|---|---|"]
    radius = nearest_reach(LINKS, math.radians(BEND))
    for task in TASKS:
        standin, empty = _of(trials, "paper-standin", task.name), _of(trials, "paper-empty", task.name)
        grid = octile(task.start, task.goal)
        ours = f"`paper-standin`: {_cost(standin)}; `paper-empty`: {_cost(empty)}"
        if task.name == "first":
            bound = around_disc(task.start, task.goal, radius)
            answer = "no"
            why = (
                f"with joint 2 within ±{BEND:g}° every path goes around the hole, {bound:.3f} at least; without the "
                f"limit an eight-neighbour path on a 1 cm grid costs {grid:.4f} at least"
            )
        else:
            bound = around_disc(task.start, task.goal, radius, long_way=True)
            free_turning = around_disc(task.start, task.goal, radius)
            answer = "not with Table 1"
            why = (
                f"with joint 1 limited to 0° to 360° the tip has to take the longer path round the hole, {bound:.3f} "
                f"at least; a continuous joint 1 would allow {free_turning:.3f} off the grid; without limits a "
                f"1 cm grid allows {grid:.4f}"
            )
        rows.append(f"| cost, task {task.name} | {task.cost} | {ours} | {answer} | {why} |")
    for task in TASKS:
        standin = _of(trials, "paper-standin", task.name)
        spent = sum(standin.swarm.timings.values()) if standin.swarm else math.nan
        rows.append(
            f"| run time, task {task.name} | {task.run_time:g} s | {spent * 1e3:.1f} ms | yes | Matlab 2015a on a "
            f"machine not named against this one: {task.run_time / spent:,.0f} times shorter, and not comparable |"
        )
    rows.append("| duration of the motion | 10 s | 10 s | yes | chosen, not found |")
    rows.append(
        "| Table 2: CBPSO 64.65 s, D* PSO 63.5 s | | not run | | the two were timed on different tasks; 63.5 is the "
        "mean of 78 and 49 |"
    )
    return "## What the paper prints\n\n" + "\n".join(rows)


def _bounds() -> str:
    radius = nearest_reach(LINKS, math.radians(BEND))
    rows = ["| bound | task first | task second |", "|---|---|---|"]
    lines = (
        ("straight line", [math.dist(t.start, t.goal) for t in TASKS]),
        ("eight neighbours, 1 cm, no obstacles", [octile(t.start, t.goal) for t in TASKS]),
        (f"around the hole of {radius:.3f}", [around_disc(t.start, t.goal, radius) for t in TASKS]),
        ("around the hole, the longer path", [around_disc(t.start, t.goal, radius, long_way=True) for t in TASKS]),
    )
    rows += [f"| {name} | {first:.4f} | {second:.4f} |" for name, (first, second) in lines]
    return (
        "## Bounds in closed form\n\n"
        f"With links of {LINKS[0]:g} + {LINKS[1]:g} and joint 2 within ±{BEND:g}° the tip cannot come nearer to the "
        f"base than {radius:.3f}: the workspace is a ring, and a path through it is never shorter than a tangent, an "
        "arc of the hole and a tangent.\n\n" + "\n".join(rows)
    )


def _runs(trials: Sequence[Trial]) -> str:
    rows = [
        "| scene | task | grid | D* | dstar-pso | seeds that meet D* | paths of that cost | seeds whose path jumps |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for trial in trials:
        grid = f"{trial.step * 100:g}"
        name = trial.name
        if trial.dstar is None or trial.swarm is None:
            rows.append(f"| {name} | {trial.task.name} | {grid} | not found | not found | | | |")
            continue
        rows.append(
            f"| {name} | {trial.task.name} | {grid} | {trial.dstar.cost * 100:.4f} | {trial.swarm.cost * 100:.4f} | "
            f"{trial.met_optimum} of {trial.seeds} | {len(trial.swarm.equal_paths)} | "
            f"{trial.jumped} of {trial.seeds} |"
        )
    return (
        "## Runs\n\n"
        + "\n".join(rows)
        + "\n\nA path jumps if, with the best choice of a configuration for each of its "
        "places, some step would need the other posture away from full stretch, or a joint beyond its limit: no arm "
        "can follow it."
    )


def _table_1(trials: Sequence[Trial]) -> str:
    lines = [
        "## With the joint limits of Table 1",
        "",
        "Touching counts as collision. On `paper-table1` the free space of a 1 cm grid does not connect either task's "
        "start with its goal; a finer grid may, where a gap is narrower than a step:",
        "",
    ]
    for task in TASKS:
        trial = _of(trials, "paper-table1", task.name)
        missed = ", ".join(f"{step * 100:g}" for step in trial.steps_without_path)
        found = f"found at {trial.step * 100:g} cm: {_cost(trial)}" if trial.dstar else "no finer grid tried finds one"
        lines.append(f"- task {task.name}: no path at {missed} cm; {found}.")
    return "\n".join(lines)


def _cases(maps: Maps) -> str:
    rows = ["| scene | two configurations | one | none |", "|---|---|---|---|"]
    for name, (space, _) in maps.items():
        rows.append(f"| {name} | {space.cases['two']} | {space.cases['one']} | {space.cases['none']} |")
    return (
        "## The three cases of section 4\n\nGrid points by how many free configurations put the tip there.\n\n"
        + "\n".join(rows)
    )


def _pictures(trials: Sequence[Trial], maps: Maps, folder: Path) -> str:
    lines = [
        "## Figures",
        "",
        "Numbered as in the paper; its elbow-down is the negative sign of its equations, elbow-up here.",
    ]
    for name, (_, pictures) in maps.items():
        lines += ["", f"### {name}", ""]
        all_pictures = [*pictures, *(p for trial in trials if _named(trial, name) for p in trial.pictures)]
        lines += [f"![{path.stem.replace('_', ' ')}]({path.relative_to(folder).as_posix()})" for path in all_pictures]
    return "\n".join(lines)


def _of(trials: Sequence[Trial], scene: str, task: str) -> Trial:
    return next(trial for trial in trials if _named(trial, scene) and trial.task.name == task)


def _named(trial: Trial, scene: str) -> bool:
    return trial.name == scene


def _cost(trial: Trial) -> str:
    if trial.dstar is None or trial.swarm is None:
        return "no path"
    return f"D* {trial.dstar.cost * 100:.4f}, swarm {trial.swarm.cost * 100:.4f}"
