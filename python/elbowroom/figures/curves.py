"""Motions over time: the paper's figures 9 to 12 and 16 to 19, and joints with their limits."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from elbowroom.figures.style import CM, INK, LINK_1, LINK_2, PATH, SMOOTHED, new_figure
from elbowroom.plan import Floats, Plan
from elbowroom.scene import Joint

CURVES = {
    "x": ("x of the tip (cm)", PATH),
    "y": ("y of the tip (cm)", SMOOTHED),
    "theta 1": ("theta 1 (deg)", LINK_1),
    "theta 2": ("theta 2 (deg)", LINK_2),
}


def tip_curve(plan: Plan, *, of: str) -> Figure:
    """Return ``x``, ``y``, ``theta 1`` or ``theta 2`` over time, the via points marked."""
    label, colour = CURVES[of]
    figure, axes = new_figure(width=6.4, height=3.4)
    t = np.linspace(0.0, plan.motion.duration, 2001)
    times = np.append(plan.motion.starts, plan.motion.duration)
    axes.plot(t, _values(plan, of, t), color=colour, linewidth=2.0, label=of)
    axes.plot(
        times,
        _values(plan, of, times),
        "D",
        color="white",
        markeredgecolor=INK,
        markersize=5,
        label="via point",
        linestyle="none",
        clip_on=False,
        zorder=5,
    )
    axes.set_xlabel("time (s)")
    axes.set_ylabel(label)
    axes.set_title(f"task '{plan.task}': {of} of the smoothed path", fontsize=11)
    axes.set_xlim(0.0, plan.motion.duration or 1.0)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=9, frameon=False)
    return figure


def joint_curves(plan: Plan) -> Figure:
    """Return position, velocity, acceleration and jerk of both joints over time, with their limits drawn."""
    figure = Figure(figsize=(7.4, 8.4), layout="constrained")
    t = np.linspace(0.0, plan.motion.duration, 4001)
    samples = plan.at(t)
    rows = (
        (samples.q, "position (deg)", "position"),
        (samples.v, "velocity (deg/s)", "velocity"),
        (samples.a, "acceleration (deg/s²)", "acceleration"),
        (samples.j, "jerk (deg/s³)", "jerk"),
    )
    for i, (values, label, rate) in enumerate(rows):
        axes = figure.add_subplot(4, 1, i + 1)
        for j, colour, style in ((0, LINK_1, "-"), (1, LINK_2, "--")):
            axes.plot(t, np.degrees(values[:, j]), color=colour, linestyle=style, label=f"joint {j + 1}")
            limits, assumed = _limits(plan, j, rate)
            for k, limit in enumerate(limits):
                axes.axhline(
                    np.degrees(limit),
                    color=colour,
                    linewidth=1.0,
                    linestyle=":" if assumed else (0, (6, 2)),
                    alpha=0.8,
                    label=f"limit of joint {j + 1}{' (assumed)' if assumed else ''}" if k == 0 else None,
                )
        axes.set_ylabel(label)
        axes.set_xlim(0.0, plan.motion.duration or 1.0)
        axes.grid(alpha=0.3)
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=8, frameon=False)
        if i == 0:
            axes.set_title(f"task '{plan.task}': joints over time", fontsize=11)
    axes.set_xlabel("time (s)")
    return figure


def _limits(plan: Plan, j: int, rate: str) -> tuple[list[float], bool]:
    """The limits of joint ``j`` on ``rate``, and whether they were assumed."""
    joint: Joint = plan.scene.arm.joints[j]
    if rate == "position":
        return [stop for stop in (joint.min, joint.max) if stop is not None], False
    stated = getattr(joint, rate)
    if stated is not None:
        return [-stated, stated], False
    for number, name, value in plan.assumed_limits:
        if (number, name) == (j + 1, rate):
            return [-value, value], True
    return [], False


def _values(plan: Plan, of: str, t: Floats) -> Floats:
    samples = plan.at(t)
    if of in ("x", "y"):
        values: Floats = samples.tip[:, "xy".index(of)] * CM
        return values
    angles: Floats = np.degrees(samples.q[:, int(of[-1]) - 1])
    return angles
