"""The motion as a moving picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.artist import Artist

from elbowroom._plan import AnyPlan
from elbowroom._whole_files import written_whole
from elbowroom.figures._links import DrawnArm, link_legend
from elbowroom.figures._paths import with_verdict
from elbowroom.figures._style import INK, MOTION, coordinates, legend_beside, mark_base, mark_ends, plane

FRAMES_PER_SECOND = 20

END = 20
"""Frames that the last picture stays."""

MOST_FRAMES = 400
"""A longer motion is shown faster than it is."""


def animate(plan: AnyPlan, path: Path) -> Path:
    """Write a GIF of the arm along its motion to ``path`` and return it; in real time up to 20 s.

    Links are as wide as they are, strokes if they have no width. The clearance is that of the instant shown.
    """
    duration = plan.motion.duration
    frames = min(max(round(duration * FRAMES_PER_SECOND), 1), MOST_FRAMES)
    samples = plan.at(np.linspace(0.0, duration, frames + 1))
    figure, axes = plane(with_verdict(f"task '{plan.task}'", plan), plan.scene)
    figure.set_dpi(100)
    start, goal = samples.tip[0], samples.tip[-1]
    mark_ends(axes, plan.scene, (start[0], start[1]), (goal[0], goal[1]))
    mark_base(axes, plan.scene)
    trail = axes.plot([], [], color=MOTION, linewidth=1.6, zorder=4, label="tip")[0]
    arm = DrawnArm(axes, plan.scene)
    clock = axes.text(0.02, 0.97, "", transform=axes.transAxes, va="top", color=INK, fontsize=10)
    legend_beside(axes, after=link_legend(plan.scene))
    nearest = np.minimum(plan.scene.link_clearances(samples.q).min(axis=1), plan.scene.self_clearances(samples.q))
    said = [f"\nclearance {plan.scene.units.measured_length(c)}" if np.isfinite(c) else "" for c in nearest]

    def show(frame: int) -> list[Artist]:
        i = min(frame, frames)
        trail.set_data(*coordinates(plan.scene, samples.tip[: i + 1]))
        clock.set_text(f"{samples.t[i]:.2f} s" + said[i])
        return [trail, *arm.move(samples.link_ends[i]), clock]

    path.parent.mkdir(parents=True, exist_ok=True)
    moving = FuncAnimation(figure, show, frames=frames + 1 + END)
    with written_whole(path) as fresh:
        moving.save(fresh, writer=PillowWriter(fps=FRAMES_PER_SECOND))
    return path
