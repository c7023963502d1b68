"""Plans with OMPL's Python package, as ``ompl_cpp`` does in C++: ``PLANNER STEP SECONDS SEED TARGET < problem``.

The checker is plain Python, which is faster here than calling NumPy for one state. STEP is the distance between checked
states (rad).
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable

from ompl import base as ob
from ompl import geometric as og
from ompl import util as ou

Corners = list[tuple[float, float]]
Edges = list[tuple[float, float, float, float]]


class Problem:
    """What the lines of standard input say; see ``bench.ompl_peers.problem``."""

    def __init__(self, text: str) -> None:
        self.circles: list[tuple[float, float, float]] = []
        self.polygons: list[tuple[float, float, float, Edges]] = []
        self.bounds: Corners = []
        self.ends: dict[str, Corners] = {"start": [], "goal": []}
        for line in text.splitlines():
            what, *words = line.split()
            numbers = list(map(float, words))
            match what:
                case "links":
                    self.links = numbers
                case "joint1" | "joint2":
                    self.bounds.append((numbers[0], numbers[1]))
                case "circle":
                    self.circles.append((numbers[0], numbers[1], numbers[2] ** 2))
                case "polygon":
                    corners = list(zip(numbers[::2], numbers[1::2], strict=True))
                    x, y = (sum(values) / len(corners) for values in zip(*corners, strict=True))
                    squared = max((a - x) ** 2 + (b - y) ** 2 for a, b in corners)
                    edges = [(*a, *b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
                    self.polygons.append((x, y, squared, edges))
                case _:
                    self.ends[what].append((numbers[0], numbers[1]))

    def free(self, q1: float, q2: float) -> bool:
        """Return whether the arm touches nothing."""
        first, second = self.links
        c1, s1, c2, s2 = math.cos(q1), math.sin(q1), math.cos(q1 + q2), math.sin(q1 + q2)
        x, y = first * c1, first * s1
        for cx, cy, squared in self.circles:
            t = min(max(cx * c1 + cy * s1, 0.0), first)
            if (cx - t * c1) ** 2 + (cy - t * s1) ** 2 <= squared:
                return False
            t = min(max((cx - x) * c2 + (cy - y) * s2, 0.0), second)
            if (cx - x - t * c2) ** 2 + (cy - y - t * s2) ** 2 <= squared:
                return False
        for cx, cy, squared, edges in self.polygons:
            t = min(max(cx * c1 + cy * s1, 0.0), first)
            if (cx - t * c1) ** 2 + (cy - t * s1) ** 2 <= squared and crosses(0.0, 0.0, x, y, edges):
                return False
            t = min(max((cx - x) * c2 + (cy - y) * s2, 0.0), second)
            if (cx - x - t * c2) ** 2 + (cy - y - t * s2) ** 2 <= squared and crosses(
                x, y, x + second * c2, y + second * s2, edges
            ):
                return False
        return True


def crosses(ax: float, ay: float, bx: float, by: float, edges: Edges) -> bool:
    """Return whether the segment from a to b crosses an edge."""
    dx, dy = bx - ax, by - ay
    for px, py, qx, qy in edges:
        if (dx * (py - ay) - dy * (px - ax) > 0.0) != (dx * (qy - ay) - dy * (qx - ax) > 0.0):
            ex, ey = qx - px, qy - py
            if (ex * (ay - py) - ey * (ax - px) > 0.0) != (ex * (by - py) - ey * (bx - px) > 0.0):
                return True
    return False


def solve(planner: str, step: float, seconds: float, target: float, problem: Problem) -> dict[str, object]:
    """Return how long it took (s) and the corners of the path."""
    space = ob.RealVectorStateSpace(2)
    bounds = ob.RealVectorBounds(2)
    for joint, (low, high) in enumerate(problem.bounds):
        bounds.setLow(joint, low)
        bounds.setHigh(joint, high)
    space.setBounds(bounds)
    setup = og.SimpleSetup(space)
    information = setup.getSpaceInformation()
    setup.setStateValidityChecker(lambda state: problem.free(state[0], state[1]))
    information.setStateValidityCheckingResolution(step / space.getMaximumExtent())
    objective = ob.PathLengthOptimizationObjective(information)
    objective.setCostThreshold(ob.Cost(target))
    setup.setOptimizationObjective(objective)
    goals = ob.GoalStates(information)
    adders: dict[str, Callable[[ob.State], None]] = {"start": setup.addStartState, "goal": goals.addState}
    for end, add in adders.items():
        for q in problem.ends[end]:
            state = space.allocState()
            state[0], state[1] = q
            add(state)
    setup.setGoal(goals)
    setup.setPlanner(getattr(og, planner)(information))
    setup.setup()

    begun = time.perf_counter()
    length, corners, first = math.inf, [], 0.0
    while True:
        setup.clear()
        setup.solve(max(seconds - (time.perf_counter() - begun), 0.0))
        if not setup.haveExactSolutionPath():
            break
        if planner == "RRTConnect":
            setup.simplifySolution()
        path = setup.getSolutionPath()
        if path.length() < length:
            length, corners = path.length(), [(state[0], state[1]) for state in path.getStates()]
        first = first or time.perf_counter() - begun
        # RRTConnect does not go on by itself: it is begun again, each path simplified, the shortest kept.
        if planner != "RRTConnect" or length <= target or time.perf_counter() - begun >= seconds:
            break
    return {"seconds": time.perf_counter() - begun, "first": first, "path": corners}


def main() -> None:
    """Plan what the arguments say."""
    planner, step, seconds, seed, target = sys.argv[1:]
    ou.setLogLevel(ou.LOG_NONE)
    ou.RNG.setSeed(int(seed))
    print(json.dumps(solve(planner, float(step), float(seconds), float(target), Problem(sys.stdin.read()))))


if __name__ == "__main__":
    main()
