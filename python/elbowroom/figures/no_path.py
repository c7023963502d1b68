"""Why there is no path: what can be reached from the start, and the walls around it."""

from __future__ import annotations

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from elbowroom.errors import NoPath
from elbowroom.figures.configuration_space import draw_contacts, shown_range
from elbowroom.figures.style import COLLISION, FREE, GOAL, INK, LIMIT, START, new_figure
from elbowroom.scene import Scene


def no_path(scene: Scene, proof: NoPath) -> Figure:
    """Return theta 1 and theta 2 with what is in contact, all that can be reached from the start, and the goals."""
    cells = [np.degrees(cell) for cell in proof.reachable]
    ends = {"start": np.array(proof.starts), "goal": np.array(proof.goals)}
    shown = np.vstack([*ends.values(), *(np.radians(cell) for cell in cells)])
    ranges = [shown_range(joint, shown[:, j]) for j, joint in enumerate(scene.arm.joints)]
    figure, axes = new_figure(width=7.4, height=5.4)
    draw_contacts(axes, scene, ranges)
    # Cells of a continuous joint may begin anywhere: each is shown in every turn within the picture.
    for joint, turns in ((0, _turns(scene, 0)), (1, _turns(scene, 1))):
        cells = [cell + np.eye(2)[joint] * turn for cell in cells for turn in turns]
    axes.add_collection(PolyCollection(cells, facecolors=FREE, edgecolors=FREE, linewidths=0.3, zorder=1.5))
    for (label, q), marker, size, colour in zip(ends.items(), "o*", (9, 14), (START, GOAL), strict=True):
        axes.plot(
            *np.degrees(q).T,
            marker,
            color=colour,
            markeredgecolor=INK,
            markersize=size,
            zorder=6,
            label=label,
            linestyle="none",
        )
    axes.set_xlim(*np.degrees(ranges[0]))
    axes.set_ylim(*np.degrees(ranges[1]))
    axes.set_title(f"task '{proof.task}': no path, proved", fontsize=11)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(
        [Patch(color=FREE), Patch(color=COLLISION), Patch(color=LIMIT), *handles],
        ["all that can be reached", "contact", "stop", *labels],
        loc="upper left",
        bbox_to_anchor=(1.01, 1.0),
        borderaxespad=0.0,
        fontsize=9,
        frameon=False,
    )
    return figure


def _turns(scene: Scene, joint: int) -> tuple[float, ...]:
    return (-360.0, 0.0, 360.0) if scene.arm.joints[joint].continuous else (0.0,)
