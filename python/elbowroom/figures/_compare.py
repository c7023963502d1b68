"""Planners side by side: box plots of what their runs gave, success with its interval, and convergence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from elbowroom.figures._style import COLOURS, DASHES, INK

Curve = Sequence[tuple[int, float]]
"""Evaluations made and the best cost by then, ascending."""


@dataclass(frozen=True)
class Panel:
    """One box plot: the values of each planner, in the order of the figure; an empty list draws no box."""

    label: str
    values: Sequence[Sequence[float]]
    logarithmic: bool = False


@dataclass(frozen=True)
class Shares:
    """One plot of shares: value, lower and upper end for each planner, all from 0 to 1."""

    label: str
    values: Sequence[tuple[float, float, float]]


def side_by_side(title: str, planners: Sequence[str], panels: Sequence[Panel | Shares]) -> Figure:
    """Return a figure with ``planners`` as rows, the same in every panel: boxes with all values as points on them,
    a diamond where all values are one.
    """
    widest = max(map(len, planners))
    width = 0.08 * widest + 2.5 * len(panels)
    figure = Figure(figsize=(width, 1.15 + 0.42 * max(len(planners), 3)), layout="constrained")
    figure.suptitle(title, fontsize=11)
    first: Axes | None = None
    for i, panel in enumerate(panels):
        axes = figure.add_subplot(1, len(panels), i + 1, sharey=first)
        if isinstance(panel, Shares):
            _draw_shares(axes, panel)
        else:
            _draw_boxes(axes, panel)
        axes.set_xlabel(panel.label, fontsize=9)
        axes.tick_params(labelsize=8, labelleft=first is None)
        axes.grid(axis="x", alpha=0.3)
        axes.margins(x=0.08)
        if first is None:
            first = axes
            axes.set_yticks(range(len(planners)), planners)
            axes.set_ylim(len(planners) - 0.4, -0.6)
    return figure


def _draw_boxes(axes: Axes, panel: Panel) -> None:
    for place, values in enumerate(panel.values):
        if not len(values):
            continue
        colour = COLOURS[place % len(COLOURS)]
        if min(values) == max(values):
            # A box without height would be a bare line.
            axes.plot(values[0], place, "D", color=colour, markeredgecolor=INK, markersize=7, linestyle="none")
            continue
        axes.boxplot(
            [values],
            positions=[place],
            orientation="horizontal",
            widths=0.6,
            patch_artist=True,
            showfliers=False,
            manage_ticks=False,
            boxprops={"facecolor": colour, "alpha": 0.45, "edgecolor": INK},
            medianprops={"color": INK, "linewidth": 2.0},
            whiskerprops={"color": INK},
            capprops={"color": INK},
        )
        # Spread evenly by order, not at random: the same rows give the same picture.
        heights = place + 0.2 * ((np.arange(len(values)) * 0.618) % 1.0 - 0.5)
        axes.plot(values, heights, ".", color=INK, markersize=3, alpha=0.6, linestyle="none")
    if not panel.logarithmic:
        axes.xaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10]))
    if panel.logarithmic and any(len(values) for values in panel.values):
        axes.set_xscale("log")
        every = [value for values in panel.values for value in values]
        subs = (1.0, 2.0, 5.0) if max(every) <= 20.0 * min(every) else (1.0, 3.0)
        axes.xaxis.set_major_locator(LogLocator(subs=subs))
        axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _place: f"{value:g}"))
        axes.xaxis.set_minor_formatter(NullFormatter())


def _draw_shares(axes: Axes, panel: Shares) -> None:
    for place, (value, low, high) in enumerate(panel.values):
        axes.plot([100.0 * low, 100.0 * high], [place, place], color=INK, linewidth=1.5)
        axes.plot(
            100.0 * value,
            place,
            "o",
            color=COLOURS[place % len(COLOURS)],
            markeredgecolor=INK,
            markersize=7,
            clip_on=False,
        )
    axes.set_xlim(-6.0, 106.0)
    axes.set_xticks([0.0, 25.0, 50.0, 75.0, 100.0])


def convergence(title: str, label: str, curves: Mapping[str, Sequence[Curve]]) -> Figure:
    """Return the best cost against evaluations: for each planner the median of its runs and the band of their middle
    half, drawn from where all of its runs have a cost.

    Args:
        title: Above the figure.
        label: Of the cost, with its unit.
        curves: For each planner the curves of its runs.
    """
    figure = Figure(figsize=(6.4, 4.0), layout="constrained")
    axes = figure.add_subplot()
    farthest = max((curve[-1][0] for runs in curves.values() for curve in runs if len(curve)), default=1.0)
    for i, (planner, runs) in enumerate(curves.items()):
        drawn = [np.asarray(curve, dtype=np.float64) for curve in runs if len(curve)]
        if not drawn:
            continue
        steps = np.unique(np.concatenate([curve[:, 0] for curve in drawn] + [np.array([farthest])]))
        steps = steps[steps >= max(curve[0, 0] for curve in drawn)]
        costs = np.array([curve[np.searchsorted(curve[:, 0], steps, side="right") - 1, 1] for curve in drawn])
        low, middle, high = np.quantile(costs, [0.25, 0.5, 0.75], axis=0)
        colour = COLOURS[i % len(COLOURS)]
        axes.fill_between(steps, low, high, step="post", color=colour, alpha=0.25, linewidth=0)
        axes.step(
            steps, middle, where="post", color=colour, linestyle=DASHES[i % len(DASHES)], linewidth=2.0, label=planner
        )
    axes.set_xscale("log")
    axes.set_xlabel("evaluations", fontsize=9)
    axes.set_ylabel(f"best {label} so far", fontsize=9)
    axes.set_title(title, fontsize=11)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=9, frameon=False)
    return figure
