"""Random scenes around the paper's arm, or one of more links, as files: the same seed gives the same bytes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from elbowroom._errors import BadSetting, SceneError
from elbowroom._scene import Scene
from elbowroom._whole import check_whole
from elbowroom._whole_files import write_whole
from elbowroom.compare._generate_chain import generated_chain

LINK = 25.0
"""Length of both links (cm)."""

BEND = 150.0
"""Range of joint 2 to either side (degrees)."""

OBSTACLES = (5, 11)
"""Fewest and most obstacles."""

RADII = (2.0, 6.0)
"""Smallest and largest of an obstacle (cm)."""

NEAREST = 8.0
"""No obstacle comes nearer to the base than this (cm)."""

ROOM = 0.005
"""Clearance that start and goal keep (m)."""

FARTHEST_TIP = 48.0
"""Largest distance of a start or goal from the base (cm)."""

APART = 30.0
"""Least distance between start and goal (cm)."""

TRIES = 1000
"""Places drawn for a task before the obstacles are drawn anew."""

HEAD = """# Scene {number} of seed {seed}, drawn at random around the paper's arm.
elbowroom: 1
units: {{length: cm, angle: deg}}

arm:
  links: [{link:g}, {link:g}]
  joints:
    - {{continuous: true}}
    - {{min: -{bend:g}, max: {bend:g}}}

grid: {{x: [-50, 50], y: [-50, 50], step: 1}}

obstacles:
{obstacles}
"""

MOST_LINKS = 30
"""Most links of an arm: shorter ones would leave no room between those that must not touch."""

Point = tuple[float, float]


def generated(number: int, *, seed: int) -> str:
    """Return scene ``number`` of ``seed`` as YAML: circles and polygons, and two tasks that are free at both ends.

    At most one obstacle reaches into the circle that link 1 sweeps: two would often leave no path at all.
    """
    random = np.random.default_rng([seed, number])
    while True:
        text = HEAD.format(number=number, seed=seed, link=LINK, bend=BEND, obstacles="\n".join(_obstacles(random)))
        try:
            bare = Scene.parse(text, file="generated")
        except SceneError:
            # A polygon whose corners, rounded to a millimetre, fall together.
            continue
        tasks = [_task(random, bare) for _ in range(2)]
        lines = [
            f"  {name}: {{start: [{a[0]:g}, {a[1]:g}], goal: [{b[0]:g}, {b[1]:g}]}}"
            for name, (a, b) in zip(("first", "second"), filter(None, tasks), strict=False)
        ]
        if len(lines) == 2:
            return text + "\ntasks:\n" + "\n".join(lines) + "\n"


def write_scenes(count: int, folder: Path, *, seed: int, links: int = 2) -> list[Path]:
    """Write ``count`` scenes of ``seed`` into ``folder``, which is made if need be; return their paths.

    Two links are those of the paper's arm; arms of more must not touch themselves, and go from one configuration to
    another.

    Raises:
        BadSetting: ``count``, ``seed`` or ``links`` makes no sense.
    """
    if not 2 <= links <= MOST_LINKS:
        raise BadSetting(f"links is {links}, it must be a whole number from 2 to {MOST_LINKS}", setting="links")
    for name, value, least in (("count", count, 1), ("seed", seed, 0)):
        check_whole(name, value, least=least)
    folder.mkdir(parents=True, exist_ok=True)
    digits = len(str(count))
    paths = []
    for number in range(1, count + 1):
        arm = "" if links == 2 else f"links{links}-"
        path = folder / f"{arm}seed{seed}-{number:0{digits}d}.yaml"
        if links == 2:
            text = generated(number, seed=seed)
        else:
            text = generated_chain(number, seed=seed, links=links, obstacles=_obstacles)
        write_whole(path, text)
        paths.append(path)
    return paths


def _obstacles(random: np.random.Generator) -> Iterator[str]:
    near = 0
    for _ in range(random.integers(OBSTACLES[0], OBSTACLES[1] + 1)):
        radius = random.uniform(*RADII)
        while True:
            distance = 2.0 * LINK * math.sqrt(random.uniform())
            inside = distance - radius < LINK
            if distance - radius > NEAREST and not (inside and near):
                break
        near += inside
        turn = random.uniform(0.0, math.tau)
        x, y = distance * math.cos(turn), distance * math.sin(turn)
        if random.uniform() < 0.5:
            yield f"  - circle: {{center: [{_mm(x)}, {_mm(y)}], radius: {_mm(radius)}}}"
            continue
        corners = random.integers(3, 8)
        angles = np.sort(random.uniform(0.0, math.tau, corners))
        distances = radius * random.uniform(0.4, 1.0, corners)
        listed = ", ".join(
            f"[{_mm(x + r * math.cos(a))}, {_mm(y + r * math.sin(a))}]" for a, r in zip(angles, distances, strict=True)
        )
        yield f"  - polygon: [{listed}]"


def _mm(centimetres: float) -> str:
    """To a millimetre, and without a negative zero."""
    return f"{round(centimetres, 1) + 0.0:g}"


def _task(random: np.random.Generator, scene: Scene) -> tuple[Point, Point] | None:
    """Two free places of the tip far enough apart, on the grid; None if none turn up."""
    found: list[Point] = []
    for _ in range(TRIES):
        x, y = (float(value) for value in random.integers(-50, 51, 2))
        if math.hypot(x, y) > FARTHEST_TIP or not _free(scene, x, y):
            continue
        if not found or math.dist(found[0], (x, y)) >= APART:
            found.append((x, y))
        if len(found) == 2:
            return found[0], found[1]
    return None


def _free(scene: Scene, x: float, y: float) -> bool:
    """Whether the arm can stand there, in some posture, with room to spare."""
    distance = math.hypot(x, y)
    bend = 2.0 * math.acos(min(distance / (2.0 * LINK), 1.0))
    if math.degrees(bend) > BEND:
        return False
    # Links of equal length: the first is half the bend off the straight line to the tip.
    q = np.array([[math.atan2(y, x) - sign * bend / 2.0, sign * bend] for sign in (-1.0, 1.0)])
    clearances = scene.link_clearances(q)
    return bool(clearances.min(axis=1).max() > ROOM)
