"""Why there is no path: what can be reached from the start, and what is around it."""

from __future__ import annotations

import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from elbowroom._errors import NoPath
from elbowroom._scene import Scene
from elbowroom._walls import reachable_cells, walls_in_words
from elbowroom.figures._configuration_space import draw_contacts, joint_plane, shown_range
from elbowroom.figures._style import FREE, legend_beside, mark_goal, mark_start


def no_path(scene: Scene, proof: NoPath) -> Figure:
    """Return both joint angles with what is in contact, all that can be reached from the start, and the goals."""
    scale = scene.units.per_radian
    ends = [np.array(proof.starts), np.array(proof.goals)]
    shown = np.vstack([*ends, *(np.array(cell) for cell in proof.reachable)])
    ranges = [shown_range(joint, shown[:, j]) for j, joint in enumerate(scene.arm.joints)]
    figure, axes = joint_plane(scene, ranges)
    contacts = draw_contacts(axes, scene.with_clearance(proof.clearance), ranges)
    cells = [cell * scale for cell in reachable_cells(scene, proof)]
    axes.add_collection(PolyCollection(cells, facecolors=FREE, edgecolors=FREE, linewidths=0.3, zorder=1.5))
    starts, goals = ([(float(q[0]) * scale, float(q[1]) * scale) for q in end] for end in ends)
    mark_start(axes, starts)
    mark_goal(axes, goals)
    walls = walls_in_words(scene, proof)
    around = f"\naround what the start can reach: {walls}" if walls else ""
    axes.set_title(f"task '{proof.task}': no path, proved{around}", fontsize=10)
    legend_beside(axes, before=[Patch(color=FREE, label="all that the\nstart can reach"), *contacts])
    return figure
