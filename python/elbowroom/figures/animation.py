"""The motion as a moving picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.artist import Artist

from elbowroom.figures.style import CM, INK, LINK_1, LINK_2, SMOOTHED, mark_base, mark_ends, plane
from elbowroom.plan import Plan

FRAMES_PER_SECOND = 20

MOST_FRAMES = 400
"""A longer motion is shown faster than it is."""


def animate(plan: Plan, path: Path) -> Path:
    """Write a GIF of the arm along its motion to ``path`` and return it; in real time up to 20 s."""
    duration = plan.motion.duration
    frames = min(max(round(duration * FRAMES_PER_SECOND), 1), MOST_FRAMES)
    samples = plan.at(np.linspace(0.0, duration, frames + 1))
    figure, axes = plane(f"task '{plan.task}'", plan.scene)
    figure.set_dpi(80)
    start, goal = samples.tip[0], samples.tip[-1]
    mark_ends(axes, (start[0], start[1]), (goal[0], goal[1]))
    mark_base(axes, plan.scene)
    base = np.asarray(plan.scene.arm.base) * CM
    trail = axes.plot([], [], color=SMOOTHED, linewidth=1.6, zorder=4, label="tip")[0]
    first = axes.plot([], [], color=LINK_1, linewidth=4.0, zorder=5, solid_capstyle="round", label="link 1")[0]
    second = axes.plot([], [], color=LINK_2, linewidth=4.0, zorder=5, solid_capstyle="round", label="link 2")[0]
    clock = axes.text(0.02, 0.97, "", transform=axes.transAxes, va="top", color=INK, fontsize=10)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, fontsize=9, frameon=False)

    def show(i: int) -> list[Artist]:
        elbow, tip = samples.elbow[i] * CM, samples.tip[i] * CM
        trail.set_data(samples.tip[: i + 1, 0] * CM, samples.tip[: i + 1, 1] * CM)
        first.set_data([base[0], elbow[0]], [base[1], elbow[1]])
        second.set_data([elbow[0], tip[0]], [elbow[1], tip[1]])
        clock.set_text(f"{samples.t[i]:.2f} s")
        return [trail, first, second, clock]

    path.parent.mkdir(parents=True, exist_ok=True)
    moving = FuncAnimation(figure, show, frames=frames + 1)
    moving.save(path, writer=PillowWriter(fps=FRAMES_PER_SECOND))
    return path
