"""How long after its timeout, or after Ctrl-C, a plan comes back: ``python -m bench.overrun``, docs/overrun.md.

Scenes made to be slow, seeded: polygons of many vertices, many circles, joints of many turns, many links, fine grids.
"""

from __future__ import annotations

import argparse
import math
import os
import random
import signal
import threading
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

import elbowroom as er
from bench.clock import ROOT
from bench.machine import machine
from elbowroom._own_planners import OWN

KINDS = ("vertices", "circles", "ranges", "links", "grid")
LIMIT = 0.2
"""How long a plan may take (s)."""


def joint(rng: random.Random) -> er.Joint:
    """Continuous, or within limits up to 20 turns apart."""
    half = math.pi * rng.choice([0.8, 1, 2, 20])
    return er.Joint(continuous=True) if rng.random() < 0.4 else er.Joint(min=-half, max=half)


def star(rng: random.Random, vertices: int) -> er.Polygon:
    """A polygon of that many vertices around a place beside the arm, the distance of each drawn."""
    x, y = rng.uniform(1.2, 1.6), rng.uniform(-0.5, 0.5)
    radii = [0.4 * rng.uniform(0.3, 1.0) for _ in range(vertices)]
    angles = [2 * math.pi * i / vertices for i in range(vertices)]
    return er.Polygon(vertices=[(x + r * math.cos(a), y + r * math.sin(a)) for r, a in zip(radii, angles, strict=True)])


def free_place(rng: random.Random, scene: er.Scene) -> list[float]:
    """Positions of the joints (rad) at which the arm touches nothing, if some are soon drawn."""
    ranges = [(-3.0, 3.0) if it.min is None or it.max is None else (it.min, it.max) for it in scene.arm.joints]
    drawn: list[list[float]] = [[rng.uniform(low, high) for low, high in ranges] for _ in range(100)]
    clear = [bool(np.min(row) > 0) for row in scene.link_clearances(np.array(drawn))]
    return drawn[clear.index(True) if True in clear else 0]


def hostile(seed: int) -> tuple[str, er.Scene, str, er.objectives.Objective]:
    """A kind, a scene of it with the task ``go``, a planner and an objective to ask it for."""
    rng = random.Random(seed)
    kind = KINDS[seed % len(KINDS)]
    links = rng.choice([3, 5, 10, 24]) if kind == "links" else 2
    joints = [joint(rng) for _ in range(links)]
    count = rng.choice([232, 1000, 5000]) if kind == "circles" else rng.choice([1, 20, 200])
    obstacles: list[er.Circle | er.Polygon | er.Segment] = []
    for _ in range(count):
        r, angle = rng.uniform(0.9, 2.2), rng.uniform(-math.pi, math.pi)
        center = (r * math.cos(angle), r * math.sin(angle))
        obstacles.append(er.Circle(center=center, radius=10 ** rng.uniform(-4, -1.5)))
    if kind == "vertices":
        obstacles.append(star(rng, rng.choice([1000, 5000, 10000])))

    empty = er.Scene(
        arm=er.Arm(links=[2 / links] * links, joints=joints, half_width=rng.choice([0.0, 0.02])),
        grid=er.Grid(x=(-2.2, 2.2), y=(-2.2, 2.2), step=rng.choice([0.004, 0.002]) if kind == "grid" else 0.05),
        obstacles=obstacles,
    )
    start, goal = (er.Configuration(free_place(rng, empty)) for _ in range(2))
    scene = empty.replace(tasks={"go": er.Task(start=start, goal=goal)})
    served = [name for name in OWN if OWN[name].serves(scene)]
    return kind, scene, rng.choice(served), rng.choice(["tip", "joint", "time"])


def overrun(scene: er.Scene, planner: str, objective: er.objectives.Objective, *, interrupted: bool) -> float | None:
    """How much later than asked the plan came back (s); None where it was done in time."""
    begun = time.perf_counter()
    timer = threading.Timer(LIMIT, os.kill, (os.getpid(), signal.SIGINT))
    if interrupted:
        timer.start()
    try:
        er.plan(scene, task="go", planner=planner, objective=objective, timeout=None if interrupted else LIMIT)
    except (er.TimedOut, KeyboardInterrupt):
        return time.perf_counter() - begun - LIMIT
    except er.ElbowroomError:
        pass
    finally:
        timer.cancel()
        if interrupted:
            timer.join()
    return None


def quantile(values: Sequence[float], share: float) -> float:
    """The value that this share does not exceed."""
    return sorted(values)[min(len(values) - 1, math.ceil(share * len(values)) - 1)]


def main() -> None:
    """Ask for all, print the slow ones, write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=0, help="of the first scene")
    parser.add_argument("--page", type=Path, default=ROOT / "docs" / "overrun.md")
    chosen = parser.parse_args()
    late: dict[tuple[str, str], list[float]] = {}
    for seed in range(chosen.seed, chosen.seed + chosen.count):
        kind, scene, planner, objective = hostile(seed)
        for how in ("timeout", "Ctrl-C"):
            try:
                by = overrun(scene, planner, objective, interrupted=how == "Ctrl-C")
            except KeyboardInterrupt:
                continue  # It came when the plan was just done.
            if by is None:
                continue
            late.setdefault((how, kind), []).append(by)
            if by > 0.05:
                print(f"seed {seed}: {kind}, {planner}, {objective}, {how}: {1e3 * by:.0f} ms late", flush=True)
    rows = []
    for how in ("timeout", "Ctrl-C"):
        for kind in (*KINDS, "all"):
            found = [by for (h, k), times in late.items() if h == how and kind in (k, "all") for by in times]
            if found:
                figures = [quantile(found, share) for share in (0.5, 0.99, 0.999, 1.0)]
                rows.append(
                    f"| {how} | {kind} | {len(found)} | " + " | ".join(f"{1e3 * f:.0f}" for f in figures) + " |"
                )
    text = (
        "# How late a plan comes back\n\n"
        f"`python -m bench.overrun`: {chosen.count} scenes made to be slow (polygons of up to 10,000 vertices, up to "
        "5,000 circles, joints of up to 20 turns, up to 24 links, grids of up to 5 million points), a planner and an "
        "objective drawn for each. Each is asked for twice: with a timeout of "
        f"{1e3 * LIMIT:.0f} ms, and with Ctrl-C after as long. Late is what lies between that and the answer, in ms; "
        "plans that were done before are not counted.\n\n"
        f"{machine()}\n\n"
        "| how it ends | scenes with many | plans | median | 99 % | 99.9 % | worst |\n|---|---|---|---|---|---|---|\n"
        + "\n".join(rows)
        + "\n"
    )
    print(text)
    chosen.page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
