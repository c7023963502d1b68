"""Runs the experiments and writes the pictures and the report."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from elbowroom import figures
from elbowroom._core import PaperPlan
from elbowroom._errors import NotFound
from elbowroom._free_space import FreeSpace, free_space
from elbowroom._paper.printed import TASKS, PrintedTask
from elbowroom._paper.report import as_markdown
from elbowroom._paper.trial import Trial
from elbowroom._plan import plan_as_in_paper
from elbowroom._scene import Scene
from elbowroom._whole_files import write_whole

SCENES = ("paper-standin", "paper-table1", "paper-empty")

FINER_STEPS = (0.005, 0.002, 0.001)
"""Grids tried where 1 cm finds nothing (m)."""


def reproduce(out: Path, *, seed: int = 0, seeds: int = 100, show: Callable[[str], None] | None = None) -> Path:
    """Plan both tasks on the three scenes as in the paper; write pictures and ``report.md`` below ``out``.

    Args:
        out: Folder, made if need be.
        seed: Of the runs that are drawn.
        seeds: How many seeds the counts are over, from 0.
        show: Called with what is being done.

    Returns:
        Path of the report.
    """
    tell = show or (lambda _words: None)
    trials: list[Trial] = []
    maps: dict[str, tuple[FreeSpace, list[Path]]] = {}
    for name in SCENES:
        scene = Scene.example(name)
        folder = out / name
        tell(f"{name}: free space")
        space = free_space(scene)
        maps[name] = (space, _draw_maps(scene, space, folder))
        for task in TASKS:
            tell(f"{name}: task {task.name}")
            trials.append(_try(name, scene, space, task, folder, seed=seed, seeds=seeds, tell=tell))
    report = out / "report.md"
    write_whole(report, as_markdown(trials, maps, seed=seed, folder=out))
    return report


def _draw_maps(scene: Scene, space: FreeSpace, folder: Path) -> list[Path]:
    """Figures 4a, 4b and 5: the paper's elbow-down map is that of its negative sign, elbow-up here."""
    return [
        figures.save(figures.posture_map(scene, space, posture="elbow-up"), folder / "figure_04a.png"),
        figures.save(figures.posture_map(scene, space, posture="elbow-down"), folder / "figure_04b.png"),
        figures.save(figures.union_map(scene, space), folder / "figure_05.png"),
    ]


def _try(
    name: str,
    scene: Scene,
    space: FreeSpace,
    task: PrintedTask,
    folder: Path,
    *,
    seed: int,
    seeds: int,
    tell: Callable[[str], None],
) -> Trial:
    without_path: list[float] = []
    dstar = _plan_or_none(scene, task, planner_seed=seed, planner="dstar")
    for step in FINER_STEPS:
        if dstar is not None:
            break
        without_path.append(scene.grid.step)
        scene = scene.replace(grid=scene.grid.replace(step=step))
        tell(f"{name}: task {task.name} on a {step * 100:g} cm grid")
        dstar = _plan_or_none(scene, task, planner_seed=seed, planner="dstar")
    if dstar is None:
        without_path.append(scene.grid.step)
        return Trial(name, scene, space, task, scene.grid.step, tuple(without_path), None, None, 0, 0, 0, ())
    swarm = plan_as_in_paper(scene, task=task.name, seed=seed)
    # On a fine grid one run has hundreds of times the work.
    counted = seeds if not without_path else min(seeds, 3)
    met = jumped = 0
    for other in range(counted):
        plan = plan_as_in_paper(scene, task=task.name, seed=other)
        met += abs(plan.cost - dstar.cost) <= 1e-9 * dstar.cost
        jumped += bool(plan.jumps)
    tell(f"{name}: drawing task {task.name}")
    if without_path:
        space = free_space(scene)
    pictures = _draw(swarm, space, task, folder)
    return Trial(
        name,
        scene,
        space,
        task,
        scene.grid.step,
        tuple(without_path),
        dstar,
        swarm,
        met,
        jumped,
        counted,
        tuple(pictures),
    )


def _plan_or_none(scene: Scene, task: PrintedTask, *, planner_seed: int, planner: str) -> PaperPlan | None:
    try:
        return plan_as_in_paper(scene, task=task.name, planner=planner, seed=planner_seed)  # type: ignore[arg-type]
    except NotFound:
        return None


def _draw(plan: PaperPlan, space: FreeSpace, task: PrintedTask, folder: Path) -> list[Path]:
    """Figures 6 to 12 for the first task, 13 to 19 for the second."""
    drawn = [
        figures.tip_path(plan, space),
        figures.smoothed_path(plan),
        figures.arm_tracking(plan),
        *(figures.tip_curve(plan, of=of) for of in ("x", "y", "theta 1", "theta 2")),
    ]
    return [figures.save(figure, folder / f"figure_{task.first_figure + i:02}.png") for i, figure in enumerate(drawn)]
