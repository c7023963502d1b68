"""Clearance over time."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from elbowroom._plan import AnyPlan
from elbowroom.figures._links import link_colours
from elbowroom.figures._style import DASHES, INK, legend_beside, new_figure


def clearance_curve(plan: AnyPlan) -> Figure:
    """Return the clearance of each link over time, that between links where they have to keep clear of each other, and
    the least one that the verifier found.
    """
    links = len(plan.scene.arm.links)
    figure, axes = new_figure(width=6.4 if links == 2 else 7.4, height=3.4 if links <= 8 else 4.2)
    t = np.linspace(0.0, plan.motion.duration, 4001)
    q = plan.at(t).q
    units, scale = plan.scene.units, plan.scene.units.per_metre
    clearance = plan.scene.link_clearances(q) * scale
    for link, colour in enumerate(link_colours(links)):
        if np.isfinite(clearance[:, link]).any():
            dash = DASHES[link % len(DASHES)]
            axes.plot(t, clearance[:, link], color=colour, linestyle=dash, linewidth=1.8, label=f"link {link + 1}")
    between = plan.scene.self_clearances(q) * scale
    if np.isfinite(between).any():
        axes.plot(t, between, color=INK, linestyle=(0, (1, 1)), linewidth=2.2, label="between links")
    least = plan.verdict.least_clearance if plan.verdict is not None else None
    if least is not None:
        axes.plot(
            least.time,
            least.distance * scale,
            "v",
            color=INK,
            markersize=7,
            label=f"least: {units.measured_length(least.distance)}\nto {least.against}",
            linestyle="none",
            clip_on=False,
            zorder=5,
        )
    axes.axhline(0.0, color=INK, linewidth=0.8)
    axes.set_xlabel("time (s)")
    axes.set_ylabel(f"clearance ({units.length})")
    axes.set_title(f"task '{plan.task}': clearance of the links", fontsize=11)
    axes.set_xlim(0.0, plan.motion.duration or 1.0)
    axes.grid(alpha=0.3)
    legend_beside(axes)
    return figure
