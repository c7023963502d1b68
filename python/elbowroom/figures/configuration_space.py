"""The configuration space: which joint angles touch what, and the way through."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from elbowroom.errors import BadSetting
from elbowroom.figures.style import COLLISION, GOAL, INK, LIMIT, SMOOTHED, START, new_figure
from elbowroom.plan import AnyPlan
from elbowroom.scene import Joint, Scene

POINTS = 361
"""How finely each joint's range is looked at; the picture shows, the verifier decides."""


def configuration_space(plan: AnyPlan) -> Figure:
    """Return theta 1 and theta 2 with the configurations in contact, the stops, and the motion through them.

    Raises:
        BadSetting: The arm does not have two links.
    """
    links = len(plan.scene.arm.links)
    if links != 2:
        message = f"the configuration space is drawn of arms of 2 links; this one has {links}"
        raise BadSetting(message, setting="arm")
    samples = plan.at(np.linspace(0.0, plan.motion.duration, 4001))
    ranges = [shown_range(joint, samples.q[:, j]) for j, joint in enumerate(plan.scene.arm.joints)]
    figure, axes = new_figure(width=7.4, height=5.4)
    draw_contacts(axes, plan.scene, ranges)
    degrees = np.degrees(samples.q)
    axes.plot(degrees[:, 0], degrees[:, 1], color=SMOOTHED, linewidth=2.0, zorder=4, label="motion")
    places = np.degrees(plan.at(np.append(plan.motion.starts, plan.motion.duration)).q)
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
    for (x, y), marker, size, colour, label in (
        (degrees[0], "o", 9, START, "start"),
        (degrees[-1], "*", 14, GOAL, "goal"),
    ):
        axes.plot(
            x,
            y,
            marker,
            color=colour,
            markeredgecolor=INK,
            markersize=size,
            zorder=6,
            label=label,
            linestyle="none",
        )
    axes.set_title(f"task '{plan.task}': configuration space (postures meet on the dotted line)", fontsize=11)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(
        [Patch(color=COLLISION), Patch(color=LIMIT), *handles],
        ["contact", "stop", *labels],
        loc="upper left",
        bbox_to_anchor=(1.01, 1.0),
        borderaxespad=0.0,
        fontsize=9,
        frameon=False,
    )
    return figure


def draw_contacts(axes: Axes, scene: Scene, ranges: list[tuple[float, float]]) -> None:
    """Draw what is in contact and where the stops are, for joints within ``ranges`` (rad)."""
    q1, q2 = np.meshgrid(*(np.linspace(low, high, POINTS) for low, high in ranges))
    clearance = scene.link_clearances(np.column_stack([q1.ravel(), q2.ravel()])).min(axis=1).reshape(q1.shape)
    left, right, bottom, top = np.degrees([*ranges[0], *ranges[1]])
    axes.imshow(
        clearance <= 0.0,
        origin="lower",
        extent=(left, right, bottom, top),
        cmap=ListedColormap(["white", COLLISION]),
        interpolation="nearest",
        vmin=0,
        vmax=1,
        zorder=1,
    )
    for joint, line in zip(scene.arm.joints, (axes.axvline, axes.axhline), strict=True):
        if not joint.continuous and joint.min is not None and joint.max is not None:
            for stop in (joint.min, joint.max):
                line(np.degrees(stop), color=LIMIT, linewidth=3.0, zorder=2)
    axes.axhline(0.0, color=INK, linewidth=0.6, linestyle=":", zorder=2)
    axes.set_aspect("equal")
    axes.set_xlabel("theta 1 (deg)")
    axes.set_ylabel("theta 2 (deg)")


def shown_range(joint: Joint, q: np.typing.NDArray[np.float64]) -> tuple[float, float]:
    """What is shown of a joint: its range with a little room, or the turn around the motion."""
    if not joint.continuous and joint.min is not None and joint.max is not None:
        room = 0.05
        return joint.min - room, joint.max + room
    middle = (q.min() + q.max()) / 2
    half = max(np.pi, (q.max() - q.min()) / 2 + 0.2)
    return middle - half, middle + half
