"""Random scenes around arms of more links than two, as text: the same seed gives the same bytes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from elbowroom._errors import SceneError
from elbowroom._scene import Scene

REACH = 50.0
"""What the links add up to, about (cm)."""

UNEVEN = 0.15
"""By which share of their mean links may differ from it."""

HALF_WIDTH = 0.2
"""Of every link (cm)."""

BEND = 150.0
"""Range of the joints after the first to either side (degrees)."""

ROOM = 0.005
"""Clearance that start and goal keep from obstacles, and links from each other (m)."""

APART = 0.3
"""Least distance between the tips at start and goal (m)."""

TRIES = 2000
"""Configurations drawn for a task before the obstacles are drawn anew."""

HEAD = """# Scene {number} of seed {seed}, drawn at random around an arm of {links} links.
elbowroom: 1
units: {{length: cm, angle: deg}}

arm:
  links: [{lengths}]
  joints:
    - {{continuous: true}}
{stops}
  half_width: {half_width:g}
  self_collision: true

grid: {{x: [-50, 50], y: [-50, 50], step: 1}}

obstacles:
{obstacles}
"""


def generated_chain(
    number: int, *, seed: int, links: int, obstacles: Callable[[np.random.Generator], Iterator[str]]
) -> str:
    """Return scene ``number`` of ``seed`` as YAML, with ``obstacles`` and two tasks that are free at both ends.

    Starts and goals are configurations; whether there is a path between them is not checked.
    """
    random = np.random.default_rng([seed, number, links])
    while True:
        lengths = REACH / links * random.uniform(1.0 - UNEVEN, 1.0 + UNEVEN, links)
        text = HEAD.format(
            number=number,
            seed=seed,
            links=links,
            lengths=", ".join(f"{length:.2f}" for length in lengths),
            stops="\n".join([f"    - {{min: -{BEND:g}, max: {BEND:g}}}"] * (links - 1)),
            half_width=HALF_WIDTH,
            obstacles="\n".join(obstacles(random)),
        )
        try:
            bare = Scene.parse(text, file="generated")
        except SceneError:
            # A polygon whose corners, rounded to a millimetre, fall together.
            continue
        tasks = [_task(random, bare, links) for _ in range(2)]
        lines = [
            f"  {name}: {{start: {{q: {_listed(a)}}}, goal: {{q: {_listed(b)}}}}}"
            for name, (a, b) in zip(("first", "second"), filter(None, tasks), strict=False)
        ]
        if len(lines) == 2:
            return text + "\ntasks:\n" + "\n".join(lines) + "\n"


def _task(
    random: np.random.Generator, scene: Scene, links: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Two free configurations (degrees) whose tips are far enough apart; None if none turn up."""
    # Many joints bend less each, or the arm would nearly always meet itself.
    widest = BEND * min(1.0, 2.0 / math.sqrt(links))
    drawn = random.uniform(-widest, widest, (TRIES, links))
    drawn[:, 0] = random.uniform(-180.0, 180.0, TRIES)
    # Rounded before they are checked: what is free is what the file says.
    drawn = np.round(drawn, 1) + 0.0
    q = np.radians(drawn)
    clear = np.minimum(scene.link_clearances(q).min(axis=1), scene.self_clearances(q))
    free = np.flatnonzero(clear > ROOM)
    if not free.size:
        return None
    tips = scene.link_ends(q[free])[:, -1]
    far = np.flatnonzero(np.hypot(*(tips - tips[0]).T) >= APART)
    return (drawn[free[0]], drawn[free[far[0]]]) if far.size else None


def _listed(degrees: NDArray[np.float64]) -> str:
    return "[" + ", ".join(f"{angle:g}" for angle in degrees) + "]"
