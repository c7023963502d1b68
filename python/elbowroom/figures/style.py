"""How pictures look: one palette (Okabe and Ito, told apart by colour-blind readers), one unit, one way to draw a
scene.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle as CirclePatch
from matplotlib.patches import Polygon as PolygonPatch

from elbowroom.scene import Outline, Pair, Scene
from elbowroom.whole_files import written_whole

CM = 100.0
"""Pictures show centimetres, as the paper does."""

LINK_1 = "#D55E00"
LINK_2 = "#009E73"
PATH = "#0072B2"
SMOOTHED = "#CC79A7"
START = "#E69F00"
GOAL = "#56B4E9"
OBSTACLE = "#404040"
FREE = "#9CCDE8"
LIMIT = "#F6E3B4"
COLLISION = "#D9A5C2"
OUT_OF_REACH = "#F2F2F2"
INK = "#222222"

COLOURS = (PATH, START, LINK_2, SMOOTHED, GOAL, LINK_1, "#999999")
"""For many curves beside each other: in this order neighbours differ most in lightness too."""

DASHES = ("-", "--", ":", "-.")
"""To go with colours: seven of those and four of these make 28 kinds of lines."""

WALL = 1.2
"""Width of the line that stands for a wall without thickness (points)."""

ARC = math.radians(5.0)
"""Turn from one corner to the next where corners stand for something round."""

LONGEST_LEGEND = 16
"""A legend with more entries gets another column."""


def new_figure(width: float = 6.4, height: float = 5.2) -> tuple[Figure, Axes]:
    """Return an empty figure of that size (inches) and its axes."""
    figure = Figure(figsize=(width, height), layout="constrained")
    return figure, figure.add_subplot()


def plane(title: str, scene: Scene) -> tuple[Figure, Axes]:
    """Return a figure of the plane of ``scene``'s grid, both axes in the same scale, the obstacles as large as they
    are.
    """
    figure, axes = new_figure(width=7.2)
    axes.set_aspect("equal")
    axes.set_xlim(scene.grid.x[0] * CM, scene.grid.x[1] * CM)
    axes.set_ylim(scene.grid.y[0] * CM, scene.grid.y[1] * CM)
    axes.set_xlabel("x (cm)")
    axes.set_ylabel("y (cm)")
    axes.set_title(title, fontsize=11)
    draw_obstacles(axes, scene)
    return figure, axes


def draw_obstacles(axes: Axes, scene: Scene) -> None:
    """Draw the obstacles of ``scene``."""
    for i, obstacle in enumerate(scene.obstacles):
        label = "obstacle" if i == 0 else None
        points, radius = obstacle.outline
        if len(points) == 1:
            center = (points[0][0] * CM, points[0][1] * CM)
            axes.add_patch(
                CirclePatch(center, radius * CM, facecolor=OBSTACLE, edgecolor="none", zorder=3, label=label)
            )
        else:
            corners = [(x * CM, y * CM) for x, y in corners_of(obstacle.outline)]
            look = {"edgecolor": OBSTACLE, "linewidth": WALL} if len(corners) == 2 else {"edgecolor": "none"}
            axes.add_patch(PolygonPatch(corners, closed=True, facecolor=OBSTACLE, zorder=3, label=label, **look))


def corners_of(outline: Outline) -> Sequence[Pair]:
    """Return the corners of a shape that is more than a disc (m), with arcs where a radius rounds it."""
    points, radius = outline
    if radius == 0.0:
        return points
    twice_area = sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, [*points[1:], points[0]], strict=True))
    points = list(points) if twice_area >= 0.0 else list(reversed(points))
    corners = []
    for i, (x, y) in enumerate(points):
        before, after = points[i - 1], points[(i + 1) % len(points)]
        heading = math.atan2(y - before[1], x - before[0])
        turn = math.remainder(math.atan2(after[1] - y, after[0] - x) - heading, math.tau)
        # Round the end of a line it goes the outer way.
        turn = math.pi if len(points) == 2 else turn
        steps = max(math.ceil(abs(turn) / ARC), 1)
        angles = [heading - math.pi / 2.0 + turn * k / steps for k in range(steps + 1)]
        corners += [(x + radius * math.cos(angle), y + radius * math.sin(angle)) for angle in angles]
    return corners


def mark_ends(axes: Axes, start: tuple[float, float], goal: tuple[float, float]) -> None:
    """Mark start and goal (m)."""
    for (x, y), marker, colour, label in ((start, "o", START, "start"), (goal, "*", GOAL, "goal")):
        axes.plot(
            x * CM,
            y * CM,
            marker,
            color=colour,
            markeredgecolor=INK,
            markersize=9 if marker == "o" else 14,
            linestyle="none",
            zorder=6,
            label=label,
        )


def mark_base(axes: Axes, scene: Scene) -> None:
    """Mark the base of the arm."""
    axes.plot(
        scene.arm.base[0] * CM,
        scene.arm.base[1] * CM,
        "s",
        color=INK,
        markersize=6,
        zorder=6,
        label="base",
        linestyle="none",
    )


def legend_beside(
    axes: Axes,
    *,
    before: Sequence[Artist] = (),
    after: Sequence[Artist] = (),
    size: int = 9,
    rows: int = LONGEST_LEGEND,
) -> None:
    """Put the legend outside, where it hides nothing, in columns of at most so many rows.

    Args:
        axes: Whose labelled artists it shows.
        before: Artists that come first.
        after: Artists that come last.
        size: Of the letters (points).
        rows: Most of them in a column.
    """
    handles = [*before, *axes.get_legend_handles_labels()[0], *after]
    axes.legend(
        handles,
        [str(handle.get_label()) for handle in handles],
        loc="upper left",
        bbox_to_anchor=(1.01, 1.0),
        borderaxespad=0.0,
        fontsize=size,
        frameon=False,
        ncols=-(-len(handles) // rows) or 1,
    )


def save(figure: Figure, path: Path) -> Path:
    """Write ``figure`` to ``path`` and return it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with written_whole(path) as fresh:
        figure.savefig(fresh, dpi=120, metadata={"Software": None} if path.suffix == ".png" else None)
    return path
