"""How pictures look: one palette, whose pairs that meet are told apart by colour-blind readers and in grey print (a
test measures it), the units of the scene, one way to draw a scene.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from textwrap import fill

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle as CirclePatch
from matplotlib.patches import Polygon as PolygonPatch
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from elbowroom._outlines import middle
from elbowroom._samples import Floats
from elbowroom._scene import Outline, Pair, Scene
from elbowroom._whole_files import written_whole

LINK_1 = "#B13F00"
LINK_2 = "#35B98A"
PATH = "#0072B2"
MOTION = "#08306B"
START = "#E69F00"
GOAL = "#F0E442"
OBSTACLE = "#404040"
FREE = "#9CCDE8"
LIMIT = "#F6E3B4"
LIMIT_LINE = "#8C510A"
COLLISION = "#6E6E6E"
COLLISION_2 = "#A0A0A0"
"""Of link 2, where the links are told apart."""
OUT_OF_REACH = "#F2F2F2"
INK = "#222222"

HATCH = "////"
HATCH_LINE = "#C4C4C4"
"""Over what is forbidden, for whoever sees no colours."""

COLOURS = (PATH, START, "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#999999")
"""For many curves beside each other (Okabe and Ito): in this order neighbours differ most in lightness too."""

DASHES = ("-", "--", ":", "-.")
"""To go with colours: seven of those and four of these make 28 kinds of lines."""

WALL = 1.2
"""Width of the line that stands for a wall without thickness (points)."""

ARC = math.radians(5.0)
"""Angle from one corner to the next where corners stand for something round."""

WIDEST_LABEL = 26
"""Letters in a line of a legend."""

LONGEST_NAME = 12
"""Letters of a name that is written beside an obstacle's number; texts have longer ones."""

MOST_NUMBERED = 60
"""With more obstacles than this none is numbered: the numbers would cover each other."""

LONGEST_LEGEND = 16
"""A legend with more entries gets another column."""


def new_figure(width: float = 6.4, height: float = 5.2) -> tuple[Figure, Axes]:
    """Return an empty figure of that size (inches) and its axes."""
    figure = Figure(figsize=(width, height), layout="constrained")
    return figure, figure.add_subplot()


def plane(title: str, scene: Scene, *, moving: bool = True) -> tuple[Figure, Axes]:
    """Return a figure of the plane of ``scene``'s grid, both axes in the same scale, the obstacles as large as they
    are, with those that are ``moving`` or without.
    """
    figure, axes = new_figure(width=7.6)
    axes.set_aspect("equal")
    axes.set_xlim(*_shown(scene, scene.grid.x))
    axes.set_ylim(*_shown(scene, scene.grid.y))
    axes.set_xlabel(f"x ({scene.units.length})")
    axes.set_ylabel(f"y ({scene.units.length})")
    axes.set_title(title, fontsize=11)
    draw_obstacles(axes, scene, moving=moving)
    return figure, axes


def _shown(scene: Scene, place: Pair) -> Pair:
    """A pair of lengths (m) as ``scene``'s pictures show it."""
    return place[0] * scene.units.per_metre, place[1] * scene.units.per_metre


def coordinates(scene: Scene, points: Floats) -> tuple[Floats, Floats]:
    """Return x and y of ``points``, shape ``(n, 2)`` (m), as ``scene``'s pictures show them."""
    return points[:, 0] * scene.units.per_metre, points[:, 1] * scene.units.per_metre


def draw_obstacles(axes: Axes, scene: Scene, *, moving: bool = True) -> None:
    """Draw the obstacles of ``scene``, each with its number, from 1, and its name."""
    scale = scene.units.per_metre
    drawn = [(i, obstacle) for i, obstacle in enumerate(scene.obstacles) if moving or obstacle.motion is None]
    for i, obstacle in drawn:
        label = "obstacle" if i == drawn[0][0] else None
        points, radius = obstacle.outline
        if len(points) == 1:
            center = _shown(scene, points[0])
            axes.add_patch(
                CirclePatch(center, radius * scale, facecolor=OBSTACLE, edgecolor="none", zorder=3, label=label)
            )
        else:
            corners = [_shown(scene, corner) for corner in corners_of(obstacle.outline)]
            look = {"edgecolor": OBSTACLE, "linewidth": WALL} if len(corners) == 2 else {"edgecolor": "none"}
            axes.add_patch(PolygonPatch(corners, closed=True, facecolor=OBSTACLE, zorder=3, label=label, **look))
    if len(drawn) <= MOST_NUMBERED:
        for i, obstacle in drawn:
            x, y = middle(obstacle)
            number(axes, _shown(scene, (x, y)), obstacle_label(i, obstacle.name))


def obstacle_label(index: int, name: str | None) -> str:
    """Return what pictures write beside the obstacle at ``index``: its number, from 1, and a name if short."""
    return f"{index + 1}" if name is None or len(name) > LONGEST_NAME else f"{index + 1} {name}"


def number(axes: Axes, place: Pair, text: str) -> None:
    """Write ``text`` at ``place``, readable over anything."""
    written = axes.text(*place, text, ha="center", va="center", fontsize=8, color=INK, zorder=7, clip_on=True)
    written.set_path_effects([withStroke(linewidth=2.5, foreground="white")])


def hatch(axes: Axes, mask: NDArray[np.bool_], extent: tuple[float, float, float, float], *, colour: str) -> None:
    """Hatch with lines of ``colour`` where ``mask`` holds, rows from bottom to top.

    Args:
        axes: Where to.
        mask: What is hatched.
        extent: Left, right, bottom and top of it.
        colour: Of the lines.
    """
    left, right, bottom, top = extent
    rows, columns = mask.shape
    if mask.any() and rows > 1 and columns > 1:
        x, y = np.linspace(left, right, columns), np.linspace(bottom, top, rows)
        hatched = axes.contourf(x, y, mask, levels=[0.5, 1.5], colors="none", hatches=[HATCH], zorder=1.2)
        hatched.set_edgecolor(colour)
        hatched.set_linewidth(0.0)


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


def mark_ends(axes: Axes, scene: Scene, start: Pair, goal: Pair) -> None:
    """Mark start and goal (m)."""
    mark_start(axes, [_shown(scene, start)])
    mark_goal(axes, [_shown(scene, goal)])


def mark_start(axes: Axes, places: Sequence[Pair]) -> None:
    """Mark starts, in the coordinates of the picture."""
    _mark(axes, places, "o", START, 9, "start")


def mark_goal(axes: Axes, places: Sequence[Pair]) -> None:
    """Mark goals, in the coordinates of the picture."""
    _mark(axes, places, "*", GOAL, 14, "goal")


def _mark(axes: Axes, places: Sequence[Pair], marker: str, colour: str, size: int, label: str) -> None:
    look = {"color": colour, "markeredgecolor": INK, "markersize": size, "linestyle": "none", "zorder": 6}
    axes.plot(*zip(*places, strict=True), marker, label=label, **look)  # type: ignore[arg-type]


def mark_base(axes: Axes, scene: Scene) -> None:
    """Mark the base of the arm."""
    axes.plot(
        *_shown(scene, scene.arm.base),
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
    title: str | None = None,
) -> None:
    """Put the legend outside, where it hides nothing, in columns of at most so many rows.

    Args:
        axes: Whose labelled artists it shows.
        before: Artists that come first.
        after: Artists that come last.
        size: Of the letters (points).
        rows: Most of them in a column.
        title: Above it.
    """
    handles = [*before, *axes.get_legend_handles_labels()[0], *after]
    axes.legend(
        handles,
        [_wrapped(str(handle.get_label())) for handle in handles],
        loc="upper left",
        bbox_to_anchor=(1.01, 1.0),
        borderaxespad=0.0,
        fontsize=size,
        frameon=False,
        ncols=-(-len(handles) // rows) or 1,
        title=title,
        alignment="left",
    )


def _wrapped(label: str) -> str:
    """``label`` in lines that a legend has room for."""
    return "\n".join(fill(line, WIDEST_LABEL) for line in label.split("\n"))


def save(figure: Figure, path: str | Path) -> Path:
    """Write ``figure`` to ``path`` and return it."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with written_whole(path) as fresh:
        figure.savefig(fresh, dpi=120, metadata={"Software": None} if path.suffix == ".png" else None)
    return path
