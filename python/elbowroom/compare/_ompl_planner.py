"""The plug-in ``ompl``: planners of the Open Motion Planning Library, checked by elbowroom's verifier."""

from __future__ import annotations

import math
from importlib.metadata import version
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from elbowroom._errors import BadSetting, NotFound, TimedOut
from elbowroom._objectives import Objective
from elbowroom._plugins import Proposal
from elbowroom._scene import Configuration, Place, Scene
from elbowroom.compare._straight_turns import straight_turns

try:
    from ompl import base as ob
    from ompl import geometric as og
    from ompl import util as ou
except ImportError:
    raise BadSetting("planner ompl needs the extra: pip install 'elbowroom[ompl]'", setting="planners") from None

Floats = NDArray[np.float64]

LONGEST_SEARCH = 10.0
"""How long OMPL may search where no timeout is given (s)."""

NEAREST = 1e-6
"""Clearance below which a whole motion is refused (m): with less, its steps would become too many."""


class OmplPlanner:
    """Plans with OMPL in the space of the joints; its path becomes straight joint motions, at rest at each corner."""

    version = f"ompl {version('ompl')}"

    def __call__(
        self,
        scene: Scene,
        task: str,
        *,
        seed: int,
        timeout: float | None,
        budget: int | None,  # noqa: ARG002 (OMPL checks states, not candidate paths)
        objective: Objective,  # noqa: ARG002 (joint travel is what OMPL's planners make short, where they do)
        algorithm: str = "RRTConnect",
        simplify: bool = True,
        resolution: float = 0.01,
        continuous: bool = False,
    ) -> Proposal:
        """Return OMPL's path as a trajectory.

        Args:
            scene: Arm and obstacles.
            task: The name of one of its tasks.
            seed: Of OMPL's random numbers.
            timeout: When to give up (s); 10 s if None.
            budget: Has no meaning here.
            objective: Has no meaning here.
            algorithm: A planner of ``ompl.geometric``.
            simplify: Whether the path is shortened afterwards.
            resolution: Share of the largest extent of the space between states that are checked.
            continuous: Whole motions are checked instead of states.
        """
        begun = perf_counter()
        ou.setLogLevel(ou.LOG_NONE)
        # OMPL takes no 0, and numbers of 32 bits; the sequence of its samplers starts anew with every call.
        ou.RNG.setSeed(seed % (2**32 - 2) + 1)
        setup = _setup(scene, task, resolution=resolution, continuous=continuous)
        setup.setPlanner(_planner(algorithm, setup))
        limit = LONGEST_SEARCH if timeout is None else timeout
        setup.solve(limit)
        searched = perf_counter()
        if not setup.haveExactSolutionPath():
            if searched - begun >= limit:
                raise TimedOut(f"nothing found within {limit:g} s", timeout=limit)
            raise NotFound(f"{algorithm} gave up")
        if simplify:
            setup.simplifySolution()
        corners = np.array([_angles(scene, state) for state in setup.getSolutionPath().getStates()])
        for j, joint in enumerate(scene.arm.joints):
            if joint.continuous:
                corners[:, j] = np.unwrap(corners[:, j])
        timings = {"search": searched - begun, "simplify": perf_counter() - searched}
        return straight_turns(scene, corners, timings=timings)


plan = OmplPlanner()


def _planner(algorithm: str, setup: og.SimpleSetup) -> ob.Planner:
    kind = getattr(og, algorithm, None)
    if not (isinstance(kind, type) and issubclass(kind, ob.Planner)):
        listed = [name for name in dir(og) if isinstance(k := getattr(og, name), type) and issubclass(k, ob.Planner)]
        raise BadSetting(f"OMPL has no planner '{algorithm}'; known: {', '.join(listed)}", setting="algorithm")
    return kind(setup.getSpaceInformation())


def _setup(scene: Scene, task: str, *, resolution: float, continuous: bool) -> og.SimpleSetup:
    """OMPL's side of a task: continuous joints on the circle, the others on intervals, exact clearance as validity."""
    space = ob.CompoundStateSpace()
    for joint in scene.arm.joints:
        if joint.continuous:
            space.addSubspace(ob.SO2StateSpace(), 1.0)
            continue
        line = ob.RealVectorStateSpace(1)
        bounds = ob.RealVectorBounds(1)
        bounds.setLow(joint.min)
        bounds.setHigh(joint.max)
        line.setBounds(bounds)
        space.addSubspace(line, 1.0)
    setup = og.SimpleSetup(space)
    information = setup.getSpaceInformation()
    setup.setStateValidityChecker(lambda state: clearance(scene, _angles(scene, state)) > 0.0)
    if continuous:
        information.setMotionValidator(_WholeMotions(information, scene))
    else:
        information.setStateValidityCheckingResolution(resolution)
    asked = scene.tasks[task]
    starts = [q for q in configurations(scene, asked.start) if clearance(scene, q) > 0.0]
    goals = [q for q in configurations(scene, asked.goal, asked.posture) if clearance(scene, q) > 0.0]
    if not starts or not goals:
        raise NotFound(f"no free configuration at the {'goal' if starts else 'start'}")
    if asked.posture == "keep":
        raise BadSetting("planner ompl cannot keep a posture", setting="planners")
    for q in starts:
        setup.addStartState(_state(scene, space, q))
    ends = ob.GoalStates(information)
    for q in goals:
        ends.addState(_state(scene, space, q))
    setup.setGoal(ends)
    return setup


class _WholeMotions(ob.MotionValidator):  # type: ignore[misc]
    """Checks whole motions: steps no farther than the clearance allows."""

    def __init__(self, information: ob.SpaceInformation, scene: Scene) -> None:
        super().__init__(information)
        self.scene = scene

    def checkMotion(self, first: ob.State, last: ob.State) -> bool:  # noqa: N802 (OMPL's name)
        """Return whether the straight motion between two states is free."""
        q = _angles(self.scene, first)
        turn = _angles(self.scene, last) - q
        for j, joint in enumerate(self.scene.arm.joints):
            if joint.continuous:
                turn[j] = math.remainder(turn[j], math.tau)
        # No point of the arm moves farther than this, nor farther as seen from another link: each joint swings the
        # links from it on.
        reach = float(np.abs(turn) @ np.cumsum(np.asarray(self.scene.arm.links)[::-1])[::-1])
        at = 0.0
        while (near := clearance(self.scene, q + at * turn)) > NEAREST:
            if at == 1.0:
                return True
            at = min(at + near / reach, 1.0) if reach > 0.0 else 1.0
        return False


def clearance(scene: Scene, q: Floats) -> float:
    """Return how far the arm is from the nearest obstacle, and from itself where that counts (m)."""
    return float(min(scene.link_clearances(q[None]).min(), scene.self_clearances(q[None])[0]))


def configurations(scene: Scene, place: Place, posture: str = "any") -> list[Floats]:
    """Return the configurations within the joint limits that are at ``place``, in a posture that will do."""
    if isinstance(place, Configuration):
        return [np.array(place.q, dtype=np.float64)]
    if len(scene.arm.links) != 2:
        raise BadSetting("planner ompl takes tips to reach for arms of 2 links only", setting="planners")
    first, second = scene.arm.links
    x, y = place[0] - scene.arm.base[0], place[1] - scene.arm.base[1]
    distance = math.hypot(x, y)
    short, beyond = (first + second) ** 2 - distance**2, distance**2 - (first - second) ** 2
    if short < 0.0 or beyond < 0.0:
        return []
    bend = 2.0 * math.atan2(math.sqrt(short), math.sqrt(beyond))
    found = []
    for sign, name in ((-1.0, "up"), (1.0, "down")):
        if posture in ("up", "down") and posture != name:
            continue
        elbow = sign * bend
        shoulder = math.atan2(y, x) - math.atan2(second * math.sin(elbow), first + second * math.cos(elbow))
        q = np.array([shoulder, elbow])
        turned = [_within(joint.min, joint.max, angle) for joint, angle in zip(scene.arm.joints, q, strict=True)]
        found += [np.array([a, b]) for a in turned[0] for b in turned[1]]
    return found


def _within(least: float | None, most: float | None, angle: float) -> list[float]:
    """``angle`` by whole revolutions as often as the limits have room for it; once without limits."""
    if least is None or most is None:
        return [math.remainder(angle, math.tau)]
    turns = range(math.ceil((least - angle) / math.tau), math.floor((most - angle) / math.tau) + 1)
    return [angle + turn * math.tau for turn in turns]


def _state(scene: Scene, space: ob.StateSpace, q: Floats) -> ob.State:
    state = space.allocState()
    for j, joint in enumerate(scene.arm.joints):
        if joint.continuous:
            state[j].value = math.remainder(q[j], math.tau)
        else:
            state[j][0] = float(q[j])
    return state


def _angles(scene: Scene, state: ob.State) -> Floats:
    joints = enumerate(scene.arm.joints)
    return np.array([state[j].value if joint.continuous else state[j][0] for j, joint in joints])
