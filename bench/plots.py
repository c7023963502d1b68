"""The pictures of the page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from bench.entries import Comparison, Section
from bench.table import number

OURS, THEIRS, WORSE = "#0b6e4f", "#7f8c9b", "#c1440e"
SAVED: dict[str, Any] = {"dpi": 150, "metadata": {"Software": None}}
mpl.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False})

SHOWN = {"map": "1001", "field": "1001", "repair": "1001", "plan": "", "swarm": "", "timing": ""}
"""Which comparisons of a section are drawn: those whose title holds this."""


def draw(sections: Sequence[Section], folder: Path) -> None:
    """Draw all pictures into ``folder``."""
    folder.mkdir(parents=True, exist_ok=True)
    ratios(sections).savefig(folder / "benchmarks_ratios.png", **SAVED)
    plots: Mapping[str, Any] = {"paths": paths, "sizes": sizes}
    for section in sections:
        for name, points in section.plots.items():
            plots[name](points).savefig(folder / f"benchmarks_{name}.png", **SAVED)


def ratios(sections: Sequence[Section]) -> Figure:
    """Return bars: how many times as long as ours each peer takes."""
    shown: list[tuple[str, Comparison]] = [
        (section.title, comparison)
        for section in sections
        if section.key in SHOWN
        for comparison in section.comparisons
        if SHOWN[section.key] in comparison.title
    ]
    bars: list[tuple[str, float] | str] = []
    for title, comparison in shown:
        bars.append(f"{title}: {comparison.title}")
        found = [(entry.who, comparison.ratio(entry)) for entry in comparison.entries[1:]]
        bars += [(who, ratio) for who, ratio in found if ratio is not None]
    figure = Figure(figsize=(9, 0.23 * len(bars) + 0.9), layout="constrained")
    axes = figure.subplots()
    for at, bar in enumerate(bars):
        if isinstance(bar, str):
            axes.text(-0.01, at, bar, transform=axes.get_yaxis_transform(), ha="right", va="center", weight="bold")
            continue
        who, ratio = bar
        color = OURS if who.startswith("elbowroom") else THEIRS if ratio >= 1 else WORSE
        axes.barh(at, ratio - 1, left=1, color=color)
        axes.text(-0.01, at, who, transform=axes.get_yaxis_transform(), ha="right", va="center")
        inside = ratio >= 1
        axes.annotate(
            number(ratio), (ratio, at), (3 if inside else -3, 0), textcoords="offset points", va="center",
            ha="left" if inside else "right", fontsize=8,
        )  # fmt: skip
    axes.set(
        xscale="log",
        yticks=[],
        ylim=(len(bars) - 0.4, -0.6),
        xlabel="times as long as elbowroom (first row of each table)",
    )
    axes.axvline(1, color="black", linewidth=0.8)
    axes.margins(x=0.12)
    axes.legend(
        handles=[
            Patch(color=THEIRS, label="a peer, slower"),
            Patch(color=WORSE, label="a peer, faster"),
            Patch(color=OURS, label="elbowroom in another way"),
        ],
        loc="upper center",
        bbox_to_anchor=(0.5, 1.0),
        ncols=3,
        frameon=False,
    )
    axes.set_ylim(len(bars) - 0.4, -2.4)
    return figure


def paths(points: Sequence[Mapping[str, Any]]) -> Figure:
    """Return the time to 1 % by planner, a point for each case; where no run came so far, at the right."""
    planners = list(dict.fromkeys(str(point["who"]) for point in points))
    figure = Figure(figsize=(9, 0.34 * len(planners) + 1.2), layout="constrained")
    axes = figure.subplots()
    latest = 2 * max((point["ms"] for point in points if point["ms"]), default=1000.0)
    for row, who in enumerate(planners):
        own = [point for point in points if point["who"] == who]
        for i, point in enumerate(own):
            color = OURS if who.startswith("elbowroom") else THEIRS
            y = row + 0.5 * (i / max(len(own) - 1, 1) - 0.5)
            if point["ms"]:
                size = 60 * point["share"]
                axes.scatter(point["ms"], y, s=size, color=color, edgecolors="none", zorder=2)
            else:
                axes.scatter(latest, y, s=22, marker="x", color=WORSE, zorder=2)
    axes.set(xscale="log", yticks=range(len(planners)), yticklabels=planners, ylim=(len(planners) - 0.5, -0.5))
    axes.set_xlabel("time to a safe path within 1 % of the best known length (ms)")
    axes.legend(
        handles=[
            _marker("o", OURS, "elbowroom, a task (area: share of runs)"),
            _marker("o", THEIRS, "a peer, a task"),
            _marker("x", WORSE, "no run came within 1 %"),
        ],
        loc="lower center",
        bbox_to_anchor=(0.5, 1.0),
        ncols=3,
        frameon=False,
    )
    axes.grid(axis="x", linewidth=0.3)
    return figure


def _marker(marker: str, color: str, label: str) -> Line2D:
    return Line2D([], [], color=color, marker=marker, linestyle="none", label=label)


def sizes(points: Sequence[Mapping[str, Any]]) -> Figure:
    """Return time and memory over the size, both axes logarithmic."""
    figure = Figure(figsize=(9, 3.8), layout="constrained")
    time, memory = figure.subplots(1, 2)
    colors = {"map": OURS, "field": "#2f6fb3", "plan": WORSE}
    for what, color in colors.items():
        own = [point for point in points if point["what"] == what]
        x = [point["points"] ** 2 for point in own]
        time.plot(x, [point["ms"] for point in own], "o-", color=color, label=what)
        memory.plot(x, [point["mib"] for point in own], "o-", color=color, label=what)
    first = [point for point in points if point["what"] == "map"]
    if first:
        low, high = first[0]["points"] ** 2, first[-1]["points"] ** 2
        line = [first[0]["ms"], first[0]["ms"] * high / low]
        time.plot([low, high], line, ":", color="black", linewidth=0.8, label="slope 1")
    time.set(ylabel="time, one core (ms)")
    memory.set(ylabel="peak memory of the process (MiB)")
    for axes in (time, memory):
        axes.set(xscale="log", yscale="log", xlabel="points of the grid")
        axes.grid(linewidth=0.3)
        axes.legend()
    return figure
