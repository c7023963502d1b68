"""Clearance over time."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from elbowroom.figures.style import INK, LINK_1, LINK_2, new_figure
from elbowroom.plan import Plan


def clearance_curve(plan: Plan) -> Figure:
    """Return the clearance of each link over time, with the least one that the verifier found."""
    figure, axes = new_figure(width=6.4, height=3.4)
    t = np.linspace(0.0, plan.motion.duration, 4001)
    clearance = plan.scene.core.link_clearances(plan.at(t).q) * 1e3
    for link, colour, style in ((0, LINK_1, "-"), (1, LINK_2, "--")):
        if np.isfinite(clearance[:, link]).any():
            axes.plot(t, clearance[:, link], color=colour, linestyle=style, linewidth=1.8, label=f"link {link + 1}")
    least = plan.verdict["least_clearance"] if plan.verdict else None
    if least is not None:
        axes.plot(
            least["time"],
            least["distance"] * 1e3,
            "v",
            color=INK,
            markersize=7,
            label=f"least: {least['distance'] * 1e3:.3f} mm",
            linestyle="none",
            clip_on=False,
            zorder=5,
        )
    axes.axhline(0.0, color=INK, linewidth=0.8)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("clearance (mm)")
    axes.set_title(f"task '{plan.task}': clearance of the links", fontsize=11)
    axes.set_xlim(0.0, plan.motion.duration or 1.0)
    axes.grid(alpha=0.3)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=9, frameon=False)
    return figure
