"""Maps of the free Cartesian space: the paper's figures 4 and 5."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from elbowroom.figures.style import CM, COLLISION, FREE, LIMIT, OUT_OF_REACH, mark_base, plane
from elbowroom.free_space import STATES, FreeSpace, FreeSpaceMap
from elbowroom.scene import Scene

COLOURS = (FREE, OUT_OF_REACH, LIMIT, COLLISION)
TWO_POSTURES = "#5FA8D3"


def posture_map(scene: Scene, space: FreeSpace, *, posture: str) -> Figure:
    """Return the map of one posture, ``elbow-up`` or ``elbow-down``: each grid point coloured by what holds there."""
    chosen: FreeSpaceMap = {"elbow-up": space.elbow_up, "elbow-down": space.elbow_down}[posture]
    figure, axes = plane(f"free space, {posture} ({scene.grid.step * CM:g} cm grid)", scene)
    _show(axes, scene, chosen.state, COLOURS)
    share = [np.count_nonzero(chosen.state == i) for i in range(len(STATES))]
    patches = [
        Patch(color=colour, label=f"{name} ({count})")
        for name, colour, count in zip(STATES, COLOURS, share, strict=True)
        if count
    ]
    _finish(axes, scene, patches)
    return figure


def union_map(scene: Scene, space: FreeSpace) -> Figure:
    """Return the map of both postures together: how many free configurations put the tip on each grid point."""
    figure, axes = plane(f"free Cartesian space, both postures ({scene.grid.step * CM:g} cm grid)", scene)
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
    half = scene.grid.step / 2
    rows, columns = values.shape
    left, bottom = scene.grid.x[0] - half, scene.grid.y[0] - half
    extent = (left, left + columns * scene.grid.step, bottom, bottom + rows * scene.grid.step)
    left, right, bottom, top = (side * CM for side in extent)
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


def _finish(axes: Axes, scene: Scene, patches: list[Patch]) -> None:
    mark_base(axes, scene)
    handles, labels = axes.get_legend_handles_labels()
    axes.legend(
        [*patches, *handles],
        [*(str(patch.get_label()) for patch in patches), *labels],
        loc="upper left",
        bbox_to_anchor=(1.01, 1.0),
        borderaxespad=0.0,
        fontsize=9,
        frameon=False,
        title="grid points",
        alignment="left",
    )
