"""Motions over time: the paper's figures 9 to 12 and 16 to 19, and joints with their limits."""

from __future__ import annotations

from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from elbowroom._core import Plan
from elbowroom._errors import BadSetting
from elbowroom._numbered import numbered
from elbowroom._plan import AnyPlan
from elbowroom._samples import Floats
from elbowroom._scene import Joint
from elbowroom.figures._links import link_colours
from elbowroom.figures._style import (
    DASHES,
    INK,
    MOTION,
    PATH,
    legend_beside,
    new_figure,
)

ROWS = 12
"""Entries in a column of the legend beside a panel."""


def joint_lines(joints: int) -> list[tuple[str, str]]:
    """Return a colour and a dash for each joint: the colour is that of its link, neighbours differ in dash too."""
    return list(zip(link_colours(joints), cycle(DASHES), strict=False))


def tip_curve(plan: AnyPlan, *, of: str) -> Figure:
    """Return ``x``, ``y``, or the angle of a joint, such as ``theta 1``, over time, the via points marked.

    Raises:
        BadSetting: There is no such curve.
    """
    units = plan.scene.units
    tips = {axis: (f"{axis} of the tip ({units.length})", colour) for axis, colour in (("x", PATH), ("y", MOTION))}
    lines = joint_lines(len(plan.scene.arm.joints))
    angles = {f"theta {j}": (f"theta {j} ({units.angle})", colour) for j, (colour, _) in enumerate(lines, 1)}
    if of not in tips | angles:
        raise BadSetting(f"no curve is called '{of}'; x, y, theta 1 to theta {len(angles)}", setting="of")
    label, colour = (tips | angles)[of]
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


def joint_curves(plan: AnyPlan) -> Figure:
    """Return position, velocity, acceleration and jerk of all joints over time, with their limits drawn."""
    joints = len(plan.scene.arm.joints)
    figure = Figure(figsize=(7.4 + 0.9 * ((joints - 1) // ROWS), 8.4), layout="constrained")
    t = np.linspace(0.0, plan.motion.duration, 4001)
    samples = plan.at(t)
    panels = (
        (samples.q, "position"),
        (samples.v, "velocity"),
        (samples.a, "acceleration"),
        (samples.j, "jerk"),
    )
    for i, (values, rate) in enumerate(panels):
        axes = figure.add_subplot(4, 1, i + 1)
        for j, (colour, dash) in enumerate(joint_lines(joints)):
            free = " (continuous)" if plan.scene.arm.joints[j].continuous else ""
            name = f"joint {j + 1}{free}" if i == 0 else None
            axes.plot(t, values[:, j] * plan.scene.units.per_radian, color=colour, linestyle=dash, label=name)
        _draw_limits(axes, plan, rate)
        axes.set_ylabel(f"{rate} ({plan.scene.units.rate_unit(i)})")
        axes.set_xlim(0.0, plan.motion.duration or 1.0)
        axes.grid(alpha=0.3)
        if axes.get_legend_handles_labels()[0]:
            legend_beside(axes, size=8, rows=ROWS)
        if i == 0:
            axes.set_title(f"task '{plan.task}': joints over time", fontsize=11)
    axes.set_xlabel("time (s)")
    return figure


def _draw_limits(axes: Axes, plan: AnyPlan, rate: str) -> None:
    """Draw the limits on ``rate``, one pair of lines for joints that have the same."""
    groups: dict[tuple[tuple[float, ...], bool], list[int]] = {}
    for j in range(len(plan.scene.arm.joints)):
        limits, assumed = _limits(plan, j, rate)
        groups.setdefault((tuple(limits), assumed), []).append(j)
    lines = joint_lines(len(plan.scene.arm.joints))
    for (values, assumed), alike in groups.items():
        whose = numbered("joint", [j + 1 for j in alike])
        for k, value in enumerate(values):
            axes.axhline(
                value * plan.scene.units.per_radian,
                color=lines[alike[0]][0] if len(alike) == 1 else INK,
                linewidth=1.0,
                linestyle=":" if assumed else (0, (6, 2)),
                alpha=0.8,
                label=f"limit of {whose}{' (assumed)' if assumed else ''}" if k == 0 else None,
            )


def _limits(plan: AnyPlan, j: int, rate: str) -> tuple[list[float], bool]:
    """The limits of joint ``j`` on ``rate``, and whether they were assumed."""
    joint: Joint = plan.scene.arm.joints[j]
    if rate == "position":
        return [limit for limit in (joint.min, joint.max) if limit is not None], False
    stated = getattr(joint, rate)
    if stated is not None:
        return [-stated, stated], False
    for number, name, value in plan.assumed_limits if isinstance(plan, Plan) else []:
        if (number, name) == (j + 1, rate):
            return [-value, value], True
    return [], False


def _values(plan: AnyPlan, of: str, t: Floats) -> Floats:
    samples = plan.at(t)
    if of in ("x", "y"):
        values: Floats = samples.tip[:, "xy".index(of)] * plan.scene.units.per_metre
        return values
    angles: Floats = samples.q[:, int(of.removeprefix("theta ")) - 1] * plan.scene.units.per_radian
    return angles
