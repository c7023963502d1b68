"""Least time by direct transcription with CasADi and IPOPT: what a user of both would write.

Time has phases with a duration each, a phase some pieces of constant jerk. Velocities (between knots too),
accelerations and jerks are bounded, joints kept within their limits, and at some places of every piece the signed
distance of either link from every circle and convex polygon. The solver knows nothing of what is between them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench.motion_limits import limits_of

Floats = NDArray[np.float64]
Pairs = Sequence[tuple[int, int]]

PHASES, PIECES = 8, 6
BETWEEN = (0.25, 0.5, 0.75)
"""Where velocities are bounded besides knots: shares of a piece."""

NEAR = 0.15
"""Obstacles that a link comes no nearer along the start are left to the verifier: a share of the reach."""

SECONDS = 60.0
"""How long IPOPT may take, of the processor's time."""


@dataclass(frozen=True)
class Rows:
    """A motion by rows, as ``elbowroom.check`` takes it: pieces of constant jerk between them."""

    t: Floats
    q: Floats
    v: Floats
    a: Floats

    def slower(self, times: float) -> Rows:
        """Return the same, so many times as long."""
        return Rows(self.t * times, self.q, self.v / times, self.a / times**2)


class NotSolved(Exception):
    """IPOPT gave up, and says why."""


class Collocation:
    """The nonlinear program of a scene about a start: at so many ``places`` of every piece a ``margin`` (m) is kept."""

    def __init__(self, scene: er.Scene, start: Rows, places: int, margin: float) -> None:
        velocity, acceleration, jerk = limits_of(scene)
        joints = scene.arm.joints
        lowest = [-np.inf if joint.min is None else joint.min for joint in joints]
        highest = [np.inf if joint.max is None else joint.max for joint in joints]
        self.knots = PHASES * PIECES + 1
        self.joints = n = len(joints)
        self._start = start
        piece = self._piece(scene, near(scene, start.q), places)
        states, jerks, times = (
            ca.MX.sym(name, *shape)
            for name, shape in (("states", (3 * n, self.knots)), ("jerks", (n, self.knots - 1)), ("times", (1, PHASES)))
        )
        h = ca.horzcat(*[times[phase] for phase in range(PHASES) for _ in range(PIECES)])
        ends, speeds, clear = piece.map(self.knots - 1)(states[:, :-1], jerks, h)
        kept = clear.shape[0] * clear.shape[1]
        rows = ca.vertcat(ca.vec(ends - states[:, 1:]), ca.vec(speeds), ca.vec(clear))
        defects = np.zeros(3 * n * (self.knots - 1))
        fast = np.tile(velocity, len(BETWEEN) * (self.knots - 1))
        bounds = np.concatenate([velocity, acceleration])
        state_low = np.tile(np.concatenate([lowest, -bounds]), (self.knots, 1))
        state_high = np.tile(np.concatenate([highest, bounds]), (self.knots, 1))
        self._states = state_low, state_high
        self._jerk = np.tile(jerk, self.knots - 1)
        self._rows = (
            np.concatenate([defects, -fast, np.full(kept, margin)]),
            np.concatenate([defects, fast, np.full(kept, np.inf)]),
        )
        self._solver = ca.nlpsol(
            "least_time",
            "ipopt",
            {"x": ca.vertcat(ca.vec(states), ca.vec(jerks), times.T), "f": PIECES * ca.sum2(times), "g": rows},
            {
                "print_time": False,
                "ipopt": {
                    "print_level": 0,
                    "sb": "yes",
                    "max_iter": 1000,
                    "max_cpu_time": SECONDS,
                    "tol": 1e-8,
                    "constr_viol_tol": 1e-12,
                    "mu_strategy": "adaptive",
                },
            },
        )

    def _piece(self, scene: er.Scene, pairs: Pairs, places: int) -> ca.Function:
        """Return what becomes of a state: where the piece ends, speeds between, clearances on its way."""
        n = len(scene.arm.joints)
        state, jerk, h = ca.SX.sym("state", 3 * n), ca.SX.sym("jerk", n), ca.SX.sym("h")
        q, v, a = state[:n], state[n : 2 * n], state[2 * n :]

        def at(t: Any) -> tuple[Any, Any, Any]:
            return q + v * t + a * t**2 / 2 + jerk * t**3 / 6, v + a * t + jerk * t**2 / 2, a + jerk * t

        clear = [clearance for k in range(places) for clearance in clearances(scene, pairs, at(h * k / places)[0])]
        speeds = [at(h * share)[1] for share in BETWEEN]
        return ca.Function("piece", [state, jerk, h], [ca.vertcat(*at(h)), ca.vertcat(*speeds), ca.vertcat(*clear)])

    def solved(self) -> Rows:
        """Return the motion that IPOPT makes of the start, from rest to rest between the same ends.

        Raises:
            NotSolved: It makes none.
        """
        n, knots, start = self.joints, self.knots, self._start
        t = np.linspace(0.0, start.t[-1], knots)
        columns = [
            np.column_stack([np.interp(t, start.t, of[:, joint]) for joint in range(n)])
            for of in (start.q, start.v, start.a)
        ]
        guess = np.concatenate(columns, axis=1)
        low, high = (of.copy() for of in self._states)
        for end in (0, -1):
            low[end] = high[end] = np.concatenate([start.q[end], np.zeros(2 * n)])
        first = np.clip(np.diff(columns[2], axis=0) / np.diff(t)[:, None], -self._jerk[:n], self._jerk[:n])
        # In pieces of no length any jerk fits.
        shortest, longest = np.full(PHASES, 0.25 * t[1]), np.full(PHASES, np.inf)
        found = self._solver(
            x0=np.concatenate([guess.ravel(), first.ravel(), np.full(PHASES, t[1])]),
            lbx=np.concatenate([low.ravel(), -self._jerk, shortest]),
            ubx=np.concatenate([high.ravel(), self._jerk, longest]),
            lbg=self._rows[0],
            ubg=self._rows[1],
        )
        stats = self._solver.stats()
        if not stats["success"]:
            raise NotSolved(f"{stats['return_status']} after {stats['iter_count']} iterations")
        x = np.asarray(found["x"]).ravel()
        states = x[: 3 * n * knots].reshape(knots, 3 * n)
        times = np.concatenate([[0.0], np.cumsum(np.repeat(x[-PHASES:], PIECES))])
        return Rows(times, states[:, :n], states[:, n : 2 * n], states[:, 2 * n :])


def near(scene: er.Scene, q: Floats) -> Pairs:
    """Return which links, by index, come near which obstacles along ``q``, shape ``(n, joints)``."""
    apart = np.array(
        [scene.replace(obstacles=[one], tasks={}).link_clearances(q).min(axis=0) for one in scene.obstacles]
    )
    return [(int(link), int(obstacle)) for obstacle, link in np.argwhere(apart < NEAR * sum(scene.arm.links))]


def clearances(scene: er.Scene, pairs: Pairs, q: Any) -> Iterator[Any]:
    """Yield the clearance of links from obstacles, ``pairs`` of them, at the symbolic configuration ``q``."""
    ends, heading = [ca.DM(scene.arm.base)], 0.0
    for joint, length in enumerate(scene.arm.links):
        heading = heading + q[joint]
        ends.append(ends[-1] + length * ca.vertcat(ca.cos(heading), ca.sin(heading)))
    for link, obstacle in pairs:
        points, radius = scene.obstacles[obstacle].outline
        apart = distance(ends[link], ends[link + 1], [ca.DM(point) for point in points])
        yield apart - radius - scene.arm.half_width


def distance(begin: Any, end: Any, points: list[Any]) -> Any:
    """Return the signed distance of a link from a point or a convex polygon, negative by how far it is in it."""
    if len(points) == 1:
        return from_segment(points[0], begin, end)
    if len(points) == 2:
        raise ValueError("this collocation knows circles and convex polygons")
    if float(sum(cross(a, b) for a, b in pairwise([*points, points[0]]))) < 0.0:
        points = points[::-1]
    edges = list(pairwise([*points, points[0]]))
    near = [from_segment(end_of_link, a, b) for end_of_link in (begin, end) for a, b in edges]
    near += [from_segment(point, begin, end) for point in points]
    # Where no axis separates them they meet, as deep as the best axis says.
    across = [cross(end - begin, point - begin) / ca.norm_2(end - begin) for point in points]
    axes = [least(across), -greatest(across)]
    axes += [-greatest([cross(b - a, p - a) / ca.norm_2(b - a) for p in (begin, end)]) for a, b in edges]
    apart = greatest(axes)
    return ca.if_else(apart > 0.0, least(near), apart)


def from_segment(point: Any, begin: Any, end: Any) -> Any:
    """Return the distance of ``point`` from a segment."""
    along, to = end - begin, point - begin
    foot = ca.fmin(ca.fmax(ca.dot(to, along) / ca.dot(along, along), 0.0), 1.0)
    return ca.sqrt(ca.sumsqr(to - foot * along) + 1e-16)


def cross(a: Any, b: Any) -> Any:
    """Return the cross product of plane vectors."""
    return a[0] * b[1] - a[1] * b[0]


def least(values: list[Any]) -> Any:
    """Return the least of symbolic values."""
    return values[0] if len(values) == 1 else ca.fmin(values[0], least(values[1:]))


def greatest(values: list[Any]) -> Any:
    """Return the greatest of symbolic values."""
    return values[0] if len(values) == 1 else ca.fmax(values[0], greatest(values[1:]))
