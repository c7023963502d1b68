"""The arm in pictures: a colour for each link, and bodies as wide as they are."""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_hex, to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from elbowroom.figures.style import CM, INK, LINK_1, LINK_2
from elbowroom.samples import Floats
from elbowroom.scene import Scene

SHADES = ("viridis", 0.1, 0.82)
"""Where the shades of more than two links are from: dark at the base, light at the tip, told apart by lightness too."""

MOST_NAMED = 12
"""With more links than this not every one is in the legend."""

ROUND = 16
"""Corners that stand for half a circle."""


def link_colours(links: int) -> list[str]:
    """Return a colour for each link: the paper's two, or for more links one sequence of shades from base to tip."""
    if links == 2:
        return [LINK_1, LINK_2]
    name, dark, light = SHADES
    return [to_hex(colormaps[name](value)) for value in np.linspace(dark, light, links)]


def link_legend(scene: Scene) -> list[Line2D]:
    """Return what a legend shows of the links, base first."""
    links = len(scene.arm.links)
    colours = link_colours(links)
    shown = range(links)
    if links > MOST_NAMED:
        shown = sorted({round(value) for value in np.linspace(0, links - 1, MOST_NAMED)})  # type: ignore[assignment]
    return [Line2D([], [], color=colours[i], linewidth=3.0, label=f"link {i + 1}") for i in shown]


def segments(scene: Scene, link_ends: Floats) -> Floats:
    """Return the links as segments (cm), base first, shape ``(..., links, 2, 2)``, from where they end (m)."""
    base = np.broadcast_to(np.asarray(scene.arm.base, dtype=np.float64), (*link_ends.shape[:-2], 1, 2))
    ends = np.concatenate([base, link_ends], axis=-2) * CM
    joined: Floats = np.stack([ends[..., :-1, :], ends[..., 1:, :]], axis=-2)
    return joined


def capsule(segment: Floats, half_width: float) -> Floats:
    """Return the outline of the body around ``segment``, shape ``(corners, 2)``, in the unit of both."""
    along = segment[1] - segment[0]
    ahead = np.arctan2(along[1], along[0])
    turn = ahead + np.linspace(-np.pi / 2.0, np.pi / 2.0, ROUND + 1)
    cap = half_width * np.column_stack([np.cos(turn), np.sin(turn)])
    outline: Floats = np.vstack([segment[1] + cap, segment[0] - cap])
    return outline


def draw_stills(axes: Axes, scene: Scene, link_ends: Floats) -> None:
    """Draw the arm at instants, shape ``(n, links, 2)`` (m), darker with time; bodies as wide as they are."""
    colours = [to_rgb(colour) for colour in link_colours(len(scene.arm.links))]
    stills = segments(scene, link_ends)
    strengths = np.linspace(0.25, 1.0, len(stills))
    lines = [segment for still in stills for segment in still]
    axes.add_collection(
        LineCollection(
            lines,
            colors=[(*colour, strength) for strength in strengths for colour in colours],
            linewidths=1.6,
            capstyle="round",
            zorder=4,
        )
    )
    if scene.arm.half_width > 0.0:
        bodies = [capsule(segment, scene.arm.half_width * CM) for segment in lines]
        fills = [(*colour, 0.16 * strength) for strength in strengths for colour in colours]
        axes.add_collection(PolyCollection(bodies, facecolors=fills, edgecolors="none", zorder=3.5))


class DrawnArm:
    """The arm in one configuration, to be moved from frame to frame: capsules as wide as they are, or strokes."""

    def __init__(self, axes: Axes, scene: Scene) -> None:
        self._scene = scene
        self._half_width = scene.arm.half_width * CM
        self._strokes: list[Line2D] = []
        self._bodies: list[Polygon] = []
        for colour in link_colours(len(scene.arm.links)):
            if self._half_width > 0.0:
                body = Polygon(np.zeros((1, 2)), facecolor=colour, edgecolor=INK, linewidth=0.6, zorder=5)
                self._bodies.append(body)
                axes.add_patch(body)
            else:
                stroke = axes.plot([], [], color=colour, linewidth=4.0, zorder=5, solid_capstyle="round")[0]
                self._strokes.append(stroke)

    def move(self, link_ends: Floats) -> list[Artist]:
        """Put the arm where its links end there, shape ``(links, 2)`` (m); return what is drawn."""
        links = segments(self._scene, link_ends)
        for stroke, link in zip(self._strokes, links, strict=False):
            stroke.set_data(link[:, 0], link[:, 1])
        for body, link in zip(self._bodies, links, strict=False):
            body.set_xy(capsule(link, self._half_width))
        return [*self._strokes, *self._bodies]
