"""Draws a path that OMPL accepts at its default resolution although the arm passes through a post."""

from __future__ import annotations

import argparse
from itertools import pairwise
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from ompl import util as ou
from ompl_safety import (
    KINDS,
    LINK,
    SETTINGS,
    Floats,
    World,
    ompl_accepts,
    ompl_path,
    ompl_setup,
    polyline,
    state,
    world,
)

import elbowroom as er

CHECKED, CONTACT, POST, START, GOAL = "#0072B2", "#D55E00", "#404040", "#E69F00", "#009E73"
MM = 1000.0


def arm(q: Floats) -> Floats:
    """Return base, elbow and tip (m)."""
    elbow = LINK * np.array([np.cos(q[0]), np.sin(q[0])])
    return np.array([(0.0, 0.0), elbow, elbow + LINK * np.array([np.cos(q[0] + q[1]), np.sin(q[0] + q[1])])])


def checked_states(world: World, corners: Floats) -> Floats:
    """Return the states that OMPL's check of the path looks at."""
    setup = ompl_setup(world, 0.01)
    setup.setup()
    space = setup.getStateSpace()
    states = [corners[:1]]
    for first, last in pairwise(corners):
        count = space.validSegmentCount(state(space, first), state(space, last))
        states.append(first + np.arange(1, count + 1)[:, None] / count * (last - first))
    return np.vstack(states)


def first_accepted_contact(seed: int) -> tuple[World, Floats, er.Check]:
    """Return the first world whose path OMPL's own check accepts and the verifier does not."""
    for number in range(100):
        drawn = world(KINDS["thin"], seed, number)
        corners = ompl_path(drawn, SETTINGS[0])
        if corners is not None and ompl_accepts(drawn, corners, 0.01):
            check = polyline(drawn, corners)
            if not check.safe:
                return drawn, corners, check
    raise SystemExit("no path of OMPL is unsafe in 100 worlds")


def picture(seed: int) -> Figure:
    """Return the whole motion, and to scale the post that it passes through first."""
    drawn, corners, check = first_accepted_contact(seed)
    contacts = [v for v in check.verdict.violations if v.kind == "contact"]
    contact = min(contacts, key=lambda v: v.time)
    touching = check.motion.sample(np.array([contact.time]))[0][0]
    checked = checked_states(drawn, corners)
    figure = Figure(figsize=(11, 6.5), layout="constrained")
    whole, near = figure.subplots(1, 2)
    for q in checked:
        whole.plot(*(MM * arm(q)).T, color=CHECKED, linewidth=0.5, alpha=0.35)
    for q, colour, label in ((corners[0], START, "start"), (corners[-1], GOAL, "goal"), (touching, CONTACT, "contact")):
        whole.plot(*(MM * arm(q)).T, color=colour, linewidth=2.2, marker="o", markersize=3, label=label)
    whole.plot(*(MM * drawn.centers).T, "o", color=POST, markersize=3, label="posts (enlarged)")
    hit = drawn.centers[[v.obstacle for v in contacts]]
    whole.plot(*(MM * hit).T, "o", color=CONTACT, markersize=8, fillstyle="none", label="posts the path meets")
    whole.plot([], [], color=CHECKED, linewidth=0.5, label="states OMPL checks")
    _frame(whole, (0.0, 0.0), 510.0)
    whole.set_title(f"OMPL RRTConnect, default resolution: {len(checked)} states checked, all free", fontsize=10)
    center = MM * drawn.centers[contact.obstacle]
    for i, q in enumerate(checked):
        near.plot(*(MM * arm(q)).T, color=CHECKED, linewidth=1.2, label=None if i else "states OMPL checks")
    near.plot(*(MM * arm(touching)).T, color=CONTACT, linewidth=1.6, label="the arm at first contact")
    near.add_patch(Circle((center[0], center[1]), MM * drawn.kind.radius, color=POST, label="post, to scale"))
    _frame(near, (center[0], center[1]), 15.0)
    near.set_title(f"The first post met, radius {MM * drawn.kind.radius:g} mm, between two checked states", fontsize=10)
    return figure


def _frame(axes: Axes, center: tuple[float, float], half: float) -> None:
    axes.set_aspect("equal")
    axes.set_xlim(center[0] - half, center[0] + half)
    axes.set_ylim(center[1] - half, center[1] + half)
    axes.set_xlabel("x (mm)")
    axes.set_ylabel("y (mm)")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=3, fontsize=8, frameon=False)


def main() -> None:
    """Draw the picture."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, required=True)
    chosen = parser.parse_args()
    ou.setLogLevel(ou.LOG_NONE)
    ou.RNG.setSeed(chosen.seed + 1)
    picture(chosen.seed).savefig(chosen.out, dpi=110)


if __name__ == "__main__":
    main()
