"""The configuration space: which joint angles touch what, and the motion through it."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from elbowroom._errors import BadSetting
from elbowroom._plan import AnyPlan
from elbowroom._samples import Floats
from elbowroom._scene import Joint, Scene
from elbowroom.figures._style import (
    COLLISION,
    COLLISION_2,
    HATCH,
    INK,
    LIMIT_LINE,
    MOTION,
    hatch,
    legend_beside,
    mark_goal,
    mark_start,
    new_figure,
    number,
    obstacle_label,
)

POINTS = 361
"""How finely each joint's range is sampled; the picture shows, the verifier decides."""

COARSE = 91
"""How finely it is sampled to find a place for an obstacle's number."""

MOST_LABELLED = 24
"""With more obstacles than this their regions are not numbered."""

Range = tuple[float, float]
Mask = NDArray[np.bool_]


def configuration_space(plan: AnyPlan) -> Figure:
    """Return both joint angles with the configurations in contact, the joint limits, and the motion through them.

    Raises:
        BadSetting: The arm does not have two links.
    """
    links = len(plan.scene.arm.links)
    if links != 2:
        message = f"the configuration space is drawn of arms of 2 links; this one has {links}"
        raise BadSetting(message, setting="arm")
    samples = plan.at(np.linspace(0.0, plan.motion.duration, 4001))
    ranges = [shown_range(joint, samples.q[:, j]) for j, joint in enumerate(plan.scene.arm.joints)]
    figure, axes = joint_plane(plan.scene, ranges)
    contacts = draw_contacts(axes, plan.scene, ranges)
    scale = plan.scene.units.per_radian
    shown = samples.q * scale
    [line] = axes.plot(shown[:, 0], shown[:, 1], color=MOTION, linewidth=2.2, zorder=4, label="motion")
    line.set_path_effects([withStroke(linewidth=4.4, foreground="white")])
    places = plan.at(np.append(plan.motion.starts, plan.motion.duration)).q * scale
    axes.plot(
        places[:, 0],
        places[:, 1],
        "D",
        color="white",
        markeredgecolor=INK,
        markersize=4,
        zorder=5,
        label="via point",
        linestyle="none",
    )
    mark_start(axes, [(shown[0, 0], shown[0, 1])])
    mark_goal(axes, [(shown[-1, 0], shown[-1, 1])])
    axes.set_title(f"task '{plan.task}': configuration space", fontsize=11)
    legend_beside(axes, before=contacts)
    return figure


def joint_plane(scene: Scene, ranges: list[Range]) -> tuple[Figure, Axes]:
    """Return a figure of both joint angles in the same scale, no larger than ``ranges`` (rad) ask for."""
    scale = scene.units.per_radian
    wide, high = ((end - begin) * scale for begin, end in ranges)
    # What the axes get of a figure 7.4 inches wide beside a legend, and what title and labels take.
    figure, axes = new_figure(width=7.4, height=min(max(4.5 * high / wide + 0.9, 2.8), 6.4))
    axes.set_aspect("equal")
    axes.set_xlim(ranges[0][0] * scale, ranges[0][1] * scale)
    axes.set_ylim(ranges[1][0] * scale, ranges[1][1] * scale)
    axes.set_xlabel(f"joint 1 ({scene.units.angle})")
    axes.set_ylabel(f"joint 2 ({scene.units.angle})")
    return figure, axes


def draw_contacts(axes: Axes, scene: Scene, ranges: list[Range]) -> list[Artist]:
    """Draw which link is in contact and where the joint limits are, for joints within ``ranges`` (rad), and number the
    obstacles; return what a legend shows of it.
    """
    touching = link_contacts(scene, ranges, POINTS)
    which = np.where(touching[0], 1, np.where(touching[1], 2, 0))
    scale = scene.units.per_radian
    left, right, bottom, top = (end * scale for pair in ranges for end in pair)
    axes.imshow(
        which,
        origin="lower",
        extent=(left, right, bottom, top),
        cmap=ListedColormap(["white", COLLISION, COLLISION_2]),
        interpolation="nearest",
        vmin=0,
        vmax=2,
        zorder=1,
    )
    hatch(axes, which == 2, (left, right, bottom, top), colour=COLLISION)
    legend: list[Artist] = []
    if (which == 1).any():
        legend.append(Patch(facecolor=COLLISION, label="link 1 in contact"))
    if (which == 2).any():
        legend.append(Patch(facecolor=COLLISION_2, edgecolor=COLLISION, hatch=HATCH, label="link 2 in contact"))
    limited = False
    for joint, line in zip(scene.arm.joints, (axes.axvline, axes.axhline), strict=True):
        if not joint.continuous and joint.min is not None and joint.max is not None:
            limited = True
            for limit in (joint.min, joint.max):
                line(limit * scale, color=LIMIT_LINE, linewidth=2.0, linestyle="--", zorder=2)
    if limited:
        legend.append(Line2D([], [], color=LIMIT_LINE, linewidth=2.0, linestyle="--", label="joint limit"))
    axes.axhline(0.0, color=INK, linewidth=0.8, linestyle=":", zorder=2)
    legend.append(Line2D([], [], color=INK, linewidth=0.8, linestyle=":", label="arm stretched:\npostures meet"))
    if len(scene.obstacles) <= MOST_LABELLED:
        _number_obstacles(axes, scene, ranges)
    return legend


def link_contacts(scene: Scene, ranges: list[Range], points: int) -> list[Mask]:
    """Return for each link where it is in contact, over ``points`` angles of each joint, joint 2 along the rows."""
    q1, q2 = np.meshgrid(*(np.linspace(low, high, points) for low, high in ranges))
    clearances = scene.link_clearances(np.column_stack([q1.ravel(), q2.ravel()]))
    return [(clearances[:, link] <= 0.0).reshape(q1.shape) for link in range(clearances.shape[1])]


def obstacle_contacts(scene: Scene, ranges: list[Range], points: int) -> list[Mask]:
    """Return for each obstacle where the arm touches it, as ``link_contacts``."""
    alone = (scene.replace(obstacles=[obstacle], tasks={}) for obstacle in scene.obstacles)
    return [np.any(link_contacts(one, ranges, points), axis=0) for one in alone]


def _number_obstacles(axes: Axes, scene: Scene, ranges: list[Range]) -> None:
    """Write each obstacle's number into what it forbids, once for each posture."""
    angles = [np.linspace(low, high, COARSE) * scene.units.per_radian for low, high in ranges]
    for i, (obstacle, touching) in enumerate(
        zip(scene.obstacles, obstacle_contacts(scene, ranges, COARSE), strict=True)
    ):
        for posture in (angles[1] < 0.0, angles[1] >= 0.0):
            place = _innermost(touching & posture[:, None])
            if place is not None:
                number(axes, (angles[0][place[1]], angles[1][place[0]]), obstacle_label(i, obstacle.name))


def _innermost(mask: Mask) -> tuple[int, int] | None:
    """A place within ``mask`` as far from its edge as any; None if it is empty."""
    if not mask.any():
        return None
    while True:
        padded = np.pad(mask, 1)
        inner = mask & padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
        if not inner.any():
            rows, columns = np.nonzero(mask)
            # Of those left the one in their middle.
            centre = np.array([np.median(rows), np.median(columns)])
            nearest = int(np.argmin(np.hypot(rows - centre[0], columns - centre[1])))
            return int(rows[nearest]), int(columns[nearest])
        mask = inner


def shown_range(joint: Joint, q: Floats) -> Range:
    """What is shown of a joint: its range with a little room, or the revolution around the motion."""
    if not joint.continuous and joint.min is not None and joint.max is not None:
        room = 0.05
        return joint.min - room, joint.max + room
    middle = (q.min() + q.max()) / 2
    half = max(np.pi, (q.max() - q.min()) / 2 + 0.2)
    return middle - half, middle + half
