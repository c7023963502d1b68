"""OMPL's planners, in C++ and in Python: where they are, what they are given, how they are run."""

from __future__ import annotations

import importlib.util
import json
import math
import shutil
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench.clock import OUT, ROOT, run

Floats = NDArray[np.float64]

STEP = math.radians(0.5)
"""Distance between the states that OMPL checks, where it does not check the whole motion (rad)."""

SEEDS = 10
PYTHON_SEEDS = 5
LIMIT = 1.0
"""How long OMPL may take in C++ for one path (s)."""

PYTHON_LIMIT = 2.0
TURN = math.tau


def configurations(scene: er.Scene, tip: tuple[float, float]) -> list[tuple[float, float]]:
    """Return the free configurations that put the tip there, joint 1 from 0 to a turn."""
    first, second = scene.arm.links
    distance = math.hypot(*tip)
    bend = math.acos((distance**2 - first**2 - second**2) / (2 * first * second))
    found = []
    for q2 in (bend, -bend):
        q1 = math.atan2(tip[1], tip[0]) - math.atan2(second * math.sin(q2), first + second * math.cos(q2))
        q = (q1 % TURN, q2)
        if scene.link_clearances(np.array([q])).min() > 0.0:
            found.append(q)
    return found


def problem(scene: er.Scene, task: str) -> str:
    """Return the task as lines of text: either posture at both ends.

    A continuous joint 1 is unrolled over three revolutions, with a copy of each goal in each: on OMPL's circle lengths
    would be sums over the joints, not those of the plane.
    """
    asked = scene.tasks[task]
    turns = (-TURN, 0.0, TURN) if scene.arm.joints[0].continuous else (0.0,)
    starts, goals = (configurations(scene, end) for end in (asked.start, asked.goal))  # type: ignore[arg-type]
    lines: list[tuple[object, ...]] = [
        ("links", *scene.arm.links),
        ("joint1", turns[0], turns[-1] + TURN),
        ("joint2", scene.arm.joints[1].min, scene.arm.joints[1].max),
        *(("start", *q) for q in starts),
        *(("goal", q[0] + turn, q[1]) for q in goals for turn in turns),
    ]
    for shape in scene.obstacles:
        if isinstance(shape, er.Circle):
            lines.append(("circle", *shape.center, shape.radius))
        else:
            assert isinstance(shape, er.Polygon), "the peers know circles and polygons"
            lines.append(("polygon", *(value for corner in shape.vertices for value in corner)))
    return "\n".join(" ".join(map(str, line)) for line in lines)


@dataclass(frozen=True)
class Peer:
    """A planner of OMPL, how it checks motions, and the program that runs it."""

    who: str
    command: Sequence[str | Path]
    planner: str
    check: str
    seeds: int
    limit: float

    def path(self, given: str, seed: int, target: float) -> tuple[float, Floats]:
        """Return how long it took (s) and the corners of its path, none if there is none.

        Raises:
            TooLong: It went far over its time limit.
            RuntimeError: It failed.
        """
        settings = [self.planner, self.check, str(self.limit), str(seed), str(target)]
        answer = json.loads(run([*self.command, *settings], limit=3 * self.limit + 2.0, given=given))
        return answer["seconds"], np.array(answer["path"])


PLANNERS = {"RRTConnect": "RRTConnect, simplified", "InformedRRTstar": "InformedRRT*", "BITstar": "BIT*"}


def peers() -> tuple[list[Peer], list[str]]:
    """Return the peers that are there, and what is not, in words."""
    found, missing = [], []
    program, why = built()
    if program is None:
        missing.append(f"OMPL in C++: {why}")
    else:
        for planner, who in PLANNERS.items():
            for check in ("whole", str(STEP)) if planner == "RRTConnect" else ("whole",):
                name = f"{who} (C++, {'whole motions' if check == 'whole' else 'states 0.5° apart'})"
                found.append(Peer(name, [program], planner, check, SEEDS, LIMIT))
    if importlib.util.find_spec("ompl") is None:
        missing.append("OMPL's Python package: not installed")
    else:
        command = [sys.executable, "-m", "bench.ompl_paths"]
        for planner, who in PLANNERS.items():
            found.append(Peer(f"{who} (Python)", command, planner, str(STEP), PYTHON_SEEDS, PYTHON_LIMIT))
    return found, missing


def built() -> tuple[Path | None, str]:
    """Return the C++ program, built if OMPL's headers are there, or None and why."""
    if shutil.which("cmake") is None:
        return None, "not built, cmake is not installed"
    folder = OUT / "ompl_cpp"
    sources = str(ROOT / "bench" / "ompl_cpp")
    configure = ["cmake", "-S", sources, "-B", str(folder), "-DCMAKE_BUILD_TYPE=Release"]
    if subprocess.run(configure, capture_output=True, check=False).returncode != 0:
        return None, "not installed (Debian's libompl-dev)"
    if subprocess.run(["cmake", "--build", str(folder)], capture_output=True, check=False).returncode != 0:
        return None, "does not build"
    return folder / "ompl_paths", ""


def ompl_versions() -> dict[str, str]:
    """Return the versions of OMPL that are there."""
    program, _ = built()
    found = {} if program is None else {"OMPL in C++": run([program, "version"], limit=10.0).strip()}
    return found | ({"ompl (Python)": version("ompl")} if importlib.util.find_spec("ompl") else {})
