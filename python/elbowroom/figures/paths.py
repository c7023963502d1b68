"""Paths in the plane, and the arm that follows them: the paper's figures 6 to 8 and 13 to 15."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elbowroom._core import PaperPlan
from elbowroom.figures.links import draw_stills, link_legend
from elbowroom.figures.style import CM, FREE, INK, PATH, SMOOTHED, legend_beside, mark_base, mark_ends, plane
from elbowroom.free_space import FreeSpace
from elbowroom.plan import AnyPlan
from elbowroom.samples import Floats

STILLS = 25
"""How many times the arm is drawn along its motion."""


def tip_path(plan: AnyPlan, space: FreeSpace | None) -> Figure:
    """Return the tip's path over the free grid points, if ``space`` is given, with the other paths of the same cost
    behind it.
    """
    title = f"task '{plan.task}': {plan.planner} path, {plan.path_cost * CM:.4f} cm"
    figure, axes = plane(title, plan.scene)
    if space is not None:
        ys, xs = np.nonzero(space.union)
        x, y = space.x[xs] * CM, space.y[ys] * CM
        axes.plot(x, y, ".", color=FREE, markersize=1.5, zorder=1, label="free grid point")
    others = plan.equal_paths[1:] if isinstance(plan, PaperPlan) else []
    for i, path in enumerate(others):
        label = f"{len(others)} other paths of this cost" if i == 0 else None
        _line(axes, path, color=PATH, linewidth=0.8, alpha=0.35, zorder=4, label=label)
    _line(axes, plan.tip_path, color=PATH, linewidth=2.2, zorder=5, label="path")
    _ends(axes, plan)
    mark_base(axes, plan.scene)
    legend_beside(axes)
    return figure


def smoothed_path(plan: AnyPlan) -> Figure:
    """Return the tip's way along the quintic pieces, with the path and the via points that it was led through."""
    title = f"task '{plan.task}': quintic pieces, {plan.motion.duration:.4g} s"
    figure, axes = plane(_with_verdict(title, plan), plan.scene)
    samples = plan.at(np.linspace(0.0, plan.motion.duration, 2001))
    _line(axes, plan.tip_path, color=PATH, linewidth=1.2, linestyle="--", zorder=4, label="path")
    _line(axes, samples.tip, color=SMOOTHED, linewidth=2.2, zorder=5, label="smoothed")
    vias = plan.tip_path[plan.vias] * CM
    axes.plot(
        vias[:, 0],
        vias[:, 1],
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
    """Return the arm at instants along the motion, darker with time: of two links the first red and the second green,
    of more the shades go from base to tip. Bodies are as wide as they are.
    """
    title = f"task '{plan.task}': the arm on its way"
    figure, axes = plane(_with_verdict(title, plan), plan.scene)
    samples = plan.at(np.linspace(0.0, plan.motion.duration, STILLS))
    draw_stills(axes, plan.scene, samples.link_ends)
    way = plan.at(np.linspace(0.0, plan.motion.duration, 2001)).tip
    _line(axes, way, color=SMOOTHED, linewidth=1.4, zorder=5, label="tip")
    _ends(axes, plan)
    mark_base(axes, plan.scene)
    legend_beside(axes, before=link_legend(plan.scene))
    return figure


def _with_verdict(title: str, plan: AnyPlan) -> str:
    if plan.verdict is None:
        return f"{title} (not verified)"
    return f"{title} (verified)" if plan.verdict.safe else f"{title} (NOT SAFE)"


def _ends(axes: Axes, plan: AnyPlan) -> None:
    start, goal = plan.tip_path[0], plan.tip_path[-1]
    mark_ends(axes, (start[0], start[1]), (goal[0], goal[1]))


def _line(axes: Axes, points: Floats, **style: object) -> None:
    axes.plot(points[:, 0] * CM, points[:, 1] * CM, solid_capstyle="round", **style)  # type: ignore[arg-type]
