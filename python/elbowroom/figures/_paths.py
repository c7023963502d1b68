"""Paths in the plane, and the arm that follows them: the paper's figures 6 to 8 and 13 to 15."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elbowroom._core import PaperPlan
from elbowroom._free_space import FreeSpace
from elbowroom._plan import AnyPlan
from elbowroom._samples import Floats
from elbowroom._scene import Scene
from elbowroom.figures._links import draw_stills, link_legend, nearest_place
from elbowroom.figures._style import (
    FREE,
    INK,
    MOTION,
    PATH,
    coordinates,
    legend_beside,
    mark_base,
    mark_ends,
    plane,
)

STILLS = 25
"""How many times the arm is drawn along its motion."""


def tip_path(plan: AnyPlan, space: FreeSpace | None) -> Figure:
    """Return the tip's path over the free grid points, if ``space`` is given, with the other paths of the same cost
    behind it.
    """
    title = f"task '{plan.task}': {plan.planner} path, {plan.scene.units.stated_length(plan.path_cost)}"
    figure, axes = plane(title, plan.scene)
    if space is not None:
        ys, xs = np.nonzero(space.union)
        x, y = coordinates(plan.scene, np.column_stack([space.x[xs], space.y[ys]]))
        axes.plot(x, y, ".", color=FREE, markersize=1.5, zorder=1, label="free grid point")
    others = plan.equal_paths[1:] if isinstance(plan, PaperPlan) else []
    for i, path in enumerate(others):
        label = f"{len(others)} other paths of this cost" if i == 0 else None
        _line(axes, plan.scene, path, color=PATH, linewidth=0.8, alpha=0.35, zorder=4, label=label)
    _line(axes, plan.scene, plan.tip_path, color=PATH, linewidth=2.2, zorder=5, label="path")
    _ends(axes, plan)
    mark_base(axes, plan.scene)
    legend_beside(axes)
    return figure


def smoothed_path(plan: AnyPlan) -> Figure:
    """Return the tip's motion along the quintic pieces, with the path and the via points that it was led through."""
    title = f"task '{plan.task}': quintic pieces, {plan.motion.duration:.4g} s"
    figure, axes = plane(with_verdict(title, plan), plan.scene)
    samples = plan.at(np.linspace(0.0, plan.motion.duration, 2001))
    _line(axes, plan.scene, plan.tip_path, color=PATH, linewidth=1.2, linestyle="--", zorder=4, label="path")
    _line(axes, plan.scene, samples.tip, color=MOTION, linewidth=2.2, zorder=5, label="smoothed")
    axes.plot(
        *coordinates(plan.scene, plan.tip_path[plan.vias]),
        "D",
        color="white",
        markeredgecolor=INK,
        markersize=5,
        zorder=6,
        label="via point",
        linestyle="none",
    )
    _ends(axes, plan)
    mark_base(axes, plan.scene)
    legend_beside(axes)
    return figure


def arm_tracking(plan: AnyPlan) -> Figure:
    """Return the arm at instants along the motion as lines, darker with time, and as wide as it is at the start, at the
    goal and where the clearance is least: of two links the first red and the second green, of more shades go from base
    to tip.
    """
    scene, duration = plan.scene, plan.motion.duration
    title = f"task '{plan.task}': {STILLS} poses in {duration:.3g} s, darker with time"
    figure, axes = plane(with_verdict(title, plan), scene)
    least = plan.verdict.least_clearance if plan.verdict is not None else None
    samples = plan.at(np.linspace(0.0, duration, STILLS))
    poses = [samples.link_ends[0], samples.link_ends[-1]]
    if least is not None:
        nearest = plan.at(np.array([least.time])).link_ends[0]
        poses.append(nearest)
    draw_stills(axes, scene, samples.link_ends, poses=np.array(poses))
    _line(
        axes, scene, plan.at(np.linspace(0.0, duration, 2001)).tip, color=MOTION, linewidth=1.4, zorder=5, label="tip"
    )
    if least is not None:
        place = nearest_place(scene, nearest, least)
        label = (
            f"least clearance:\n{scene.units.measured_length(least.distance)} at {least.time:.3g} s\nto {least.against}"
        )
        x, y = coordinates(scene, place[None, :])
        axes.plot(x, y, "v", color="white", markeredgecolor=INK, markersize=8, zorder=8, label=label, linestyle="none")
    _ends(axes, plan)
    mark_base(axes, scene)
    legend_beside(axes, before=link_legend(scene))
    return figure


def with_verdict(title: str, plan: AnyPlan) -> str:
    """Return ``title`` with what the verifier says of ``plan``."""
    if plan.verdict is None:
        return f"{title} (not verified)"
    return f"{title} (verified)" if plan.verdict.safe else f"{title} (NOT SAFE)"


def _ends(axes: Axes, plan: AnyPlan) -> None:
    start, goal = plan.tip_path[0], plan.tip_path[-1]
    mark_ends(axes, plan.scene, (start[0], start[1]), (goal[0], goal[1]))


def _line(axes: Axes, scene: Scene, points: Floats, **style: object) -> None:
    axes.plot(*coordinates(scene, points), solid_capstyle="round", **style)  # type: ignore[arg-type]
