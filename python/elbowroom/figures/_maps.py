"""Maps of the free Cartesian space: the paper's figures 4 and 5."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from elbowroom._free_space import STATES, FreeSpace, FreeSpaceMap
from elbowroom._scene import Scene
from elbowroom.figures._style import (
    COLLISION,
    FREE,
    HATCH,
    HATCH_LINE,
    LIMIT,
    OUT_OF_REACH,
    hatch,
    legend_beside,
    mark_base,
    plane,
)

COLOURS = (FREE, OUT_OF_REACH, LIMIT, COLLISION)
TWO_POSTURES = "#2F78A8"


def posture_map(scene: Scene, space: FreeSpace, *, posture: str) -> Figure:
    """Return the map of one posture, ``elbow-up`` or ``elbow-down``: each grid point coloured by what holds there."""
    chosen: FreeSpaceMap = {"elbow-up": space.elbow_up, "elbow-down": space.elbow_down}[posture]
    figure, axes = plane(f"free space, {posture} (grid step {scene.units.stated_length(scene.grid.step)})", scene)
    _show(axes, scene, chosen.state, COLOURS)
    hatch(
        axes,
        chosen.state == STATES.index("collision"),
        _extent(scene, chosen.state.shape, edge=False),
        colour=HATCH_LINE,
    )
    share = [np.count_nonzero(chosen.state == i) for i in range(len(STATES))]
    patches = [
        Patch(
            facecolor=colour,
            edgecolor=HATCH_LINE if name == "collision" else colour,
            hatch=HATCH if name == "collision" else None,
            label=f"{name} ({count})",
        )
        for name, colour, count in zip(STATES, COLOURS, share, strict=True)
        if count
    ]
    _finish(axes, scene, patches)
    return figure


def union_map(scene: Scene, space: FreeSpace) -> Figure:
    """Return the map of both postures together: how many free configurations put the tip on each grid point."""
    figure, axes = plane(
        f"free Cartesian space, both postures (grid step {scene.units.stated_length(scene.grid.step)})", scene
    )
    colours = (OUT_OF_REACH, FREE, TWO_POSTURES)
    _show(axes, scene, space.configurations, colours)
    counts = [space.cases[case] for case in ("none", "one", "two")]
    names = ("no configuration", "one configuration", "two configurations")
    patches = [
        Patch(color=colour, label=f"{name} ({count})")
        for name, colour, count in zip(names, colours, counts, strict=True)
        if count
    ]
    _finish(axes, scene, patches)
    return figure


def _show(axes: Axes, scene: Scene, values: NDArray[np.uint8], colours: tuple[str, ...]) -> None:
    """Colour the square around each grid point."""
    left, right, bottom, top = _extent(scene, values.shape, edge=True)
    axes.imshow(
        values,
        cmap=ListedColormap(list(colours)),
        vmin=-0.5,
        vmax=len(colours) - 0.5,
        origin="lower",
        extent=(left, right, bottom, top),
        interpolation="nearest",
        zorder=1,
    )
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)


def _extent(scene: Scene, shape: tuple[int, ...], *, edge: bool) -> tuple[float, float, float, float]:
    """From the first grid point to the last along both axes, with an ``edge`` of half a step."""
    rows, columns = shape
    step = scene.grid.step * scene.units.per_metre
    room = step / 2 if edge else 0.0
    left, bottom = scene.grid.x[0] * scene.units.per_metre, scene.grid.y[0] * scene.units.per_metre
    return left - room, left + (columns - 1) * step + room, bottom - room, bottom + (rows - 1) * step + room


def _finish(axes: Axes, scene: Scene, patches: list[Patch]) -> None:
    mark_base(axes, scene)
    legend_beside(axes, before=patches, title="grid points")
