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

from elbowroom._core import Clearance
from elbowroom._outlines import distances_to_lines
from elbowroom._samples import Floats
from elbowroom._scene import Scene
from elbowroom.figures._style import INK, LINK_1, LINK_2

SHADES = ("viridis", 0.1, 0.82)
"""Where the shades of more than two links are from: dark at the base, light at the tip, told apart by lightness too."""

MOST_NAMED = 12
"""With more links than this not every one is in the legend."""

SAMPLES = 401
"""Points of a link among which the nearest to an obstacle is sought."""

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
    """Return the links as segments in the unit of ``scene``, base first, shape ``(..., links, 2, 2)``, from where they
    end (m).
    """
    base = np.broadcast_to(np.asarray(scene.arm.base, dtype=np.float64), (*link_ends.shape[:-2], 1, 2))
    ends = np.concatenate([base, link_ends], axis=-2) * scene.units.per_metre
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


def draw_stills(axes: Axes, scene: Scene, link_ends: Floats, *, poses: Floats) -> None:
    """Draw the arm at instants, shape ``(n, links, 2)`` (m), as lines that get darker with time, and in ``poses``,
    of the same shape, with its bodies and joints.
    """
    colours = [to_rgb(colour) for colour in link_colours(len(scene.arm.links))]
    stills = segments(scene, link_ends)
    strengths = np.linspace(0.2, 0.9, len(stills))
    axes.add_collection(
        LineCollection(
            [segment for still in stills for segment in still],
            colors=[(*colour, strength) for strength in strengths for colour in colours],
            linewidths=1.1,
            capstyle="round",
            zorder=4,
        )
    )
    drawn = segments(scene, poses)
    if scene.arm.half_width > 0.0:
        half_width = scene.arm.half_width * scene.units.per_metre
        bodies = [capsule(segment, half_width) for pose in drawn for segment in pose]
        fills = [(*colour, 0.35) for colour in colours]
        axes.add_collection(PolyCollection(bodies, facecolors=fills, edgecolors=colours, linewidths=0.8, zorder=4.5))
    for pose in drawn:
        for segment, colour in zip(pose, colours, strict=True):
            axes.plot(*segment.T, color=colour, linewidth=2.6, zorder=4.6, solid_capstyle="round")
        joints = pose[1:, 0]
        axes.plot(*joints.T, "o", color="white", markeredgecolor=INK, markersize=4, zorder=4.7, linestyle="none")


def nearest_place(scene: Scene, link_ends: Floats, clearance: Clearance) -> Floats:
    """Return the place on the link's line (m) that is nearest to what ``clearance`` is from, the arm's links ending at
    ``link_ends``, shape ``(links, 2)`` (m).
    """
    joints = np.vstack([scene.arm.base, link_ends])
    link = np.linspace(joints[clearance.link - 1], joints[clearance.link], SAMPLES)
    if clearance.other_link is not None:
        other = joints[clearance.other_link - 1 : clearance.other_link + 1]
    else:
        other = np.array(scene.obstacles[clearance.obstacle or 0].outline[0])
    place: Floats = link[int(np.argmin(distances_to_lines(link, other)))]
    return place


class DrawnArm:
    """The arm in one configuration, to be moved from frame to frame: capsules as wide as they are, or strokes."""

    def __init__(self, axes: Axes, scene: Scene) -> None:
        self._scene = scene
        self._half_width = scene.arm.half_width * scene.units.per_metre
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
