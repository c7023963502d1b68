"""How long updates took, and how near the arm came to the obstacles."""

from __future__ import annotations

from itertools import cycle
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from elbowroom._core import measured
from elbowroom.figures._style import (
    COLLISION,
    COLOURS,
    DASHES,
    INK,
    LINK_1,
    OBSTACLE,
    PATH,
    START,
    legend_beside,
    new_figure,
    save,
)
from elbowroom.follow._clearances import clearances
from elbowroom.follow._followed import Followed


def draw(followed: Followed, folder: Path) -> list[Path]:
    """Draw ``latency.png`` and ``clearance.png`` into ``folder``; return their paths."""
    return [
        save(latency(followed), folder / "latency.png"),
        save(clearance(followed), folder / "clearance.png"),
    ]


def latency(followed: Followed) -> Figure:
    """Return the histogram of update times, logarithmic both ways, with median, p99, p99.9 and their period."""
    figure, axes = new_figure(width=7.4, height=3.6)
    spent = followed.update_times * 1e3
    step = 1e3 / followed.rate
    low, high = np.log10(spent.min() / 1.3), np.log10(max(spent.max(), step) * 1.3)
    axes.hist(spent, bins=np.logspace(low, high, 50).tolist(), color=PATH, edgecolor="white", linewidth=0.4)
    marks = (("median", 0.5, "-", INK), ("p99", 0.99, "--", LINK_1), ("p99.9", 0.999, ":", LINK_1))
    for name, share, dash, colour in marks:
        value = float(np.quantile(spent, share))
        axes.axvline(value, color=colour, linestyle=dash, linewidth=1.8, label=f"{name}: {measured(value)} ms")
    axes.axvline(step, color=START, linewidth=3.0, alpha=0.8, label=f"period: {step:g} ms")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.set_ylim(bottom=0.7)
    axes.set_xlabel("time of an update (ms)")
    axes.set_ylabel("updates")
    axes.set_title(f"task '{followed.task}': {len(spent)} updates at {followed.rate:g} Hz", fontsize=11)
    axes.grid(alpha=0.3)
    legend_beside(axes)
    return figure


def clearance(followed: Followed) -> Figure:
    """Return the clearance from each moving obstacle and from the static ones over time, contact marked."""
    figure, axes = new_figure(width=7.4, height=3.8)
    t = followed.samples.t
    units, scale = followed.scene.units, followed.scene.units.per_metre
    found = clearances(followed)
    looks = cycle(zip(COLOURS, DASHES, strict=False))
    for name, values in found.items():
        colour, dash = (OBSTACLE, "-.") if name == "static obstacles" else next(looks)
        axes.plot(t, values * scale, color=colour, linestyle=dash, linewidth=1.8, label=name)
    least = followed.check.verdict.least_clearance
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
    top = max((float(values.max()) for values in found.values()), default=0.1) * 1.05 * scale
    bottom = min(-0.04 * top, min((float(values.min()) for values in found.values()), default=0.0) * 1.05 * scale)
    axes.axhspan(bottom, 0.0, color=COLLISION, alpha=0.6, label="contact")
    axes.axhline(0.0, color=INK, linewidth=1.2)
    axes.set_ylim(bottom, top)
    axes.set_xlabel("time (s)")
    axes.set_ylabel(f"clearance ({units.length})")
    axes.set_title(f"task '{followed.task}': clearance of the arm", fontsize=11)
    axes.set_xlim(0.0, float(t[-1]) or 1.0)
    axes.grid(alpha=0.3)
    legend_beside(axes)
    return figure
