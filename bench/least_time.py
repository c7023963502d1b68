"""The least time along a joint path, by code that shares nothing with the planner: dense time-optimal scaling.

The unknown is the square r(u) of the rate du/dt. Joint velocities are q' sqrt(r), accelerations q'' r + q' r' / 2,
jerks sqrt(r) (q''' r + 3/2 q'' r' + 1/2 q' r''), and the time is the integral of 1 / sqrt(r). r is a spline of
parabolas, one a cell, once continuously differentiable; limits are kept at both ends of every cell. IPOPT finds it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bench.joint_path import JointPath

Floats = NDArray[np.float64]

SLOWEST, FASTEST = 1e-4, 1e4
"""Between what r stays, of that of the path's own parameter run through in the time of the start."""

AT_REST = 1e-6
"""Up to what share of its greatest value a derivative counts as 0."""


@dataclass(frozen=True)
class Timing:
    """The least time (s), and r and its derivatives: at the ends of cells and, for the second, on each cell."""

    duration: float
    r: Floats
    slope: Floats
    bend: Floats


class NotTimed(Exception):
    """IPOPT did not converge."""


def timed(path: JointPath, limits: Floats) -> Timing:
    """Return the least time along ``path`` from rest to rest under ``limits``, shape ``(3, joints)``.

    The parameter has to be one in which the path itself comes out of rest and back to it, as a motion's own time is.

    Raises:
        ValueError: It is not.
        NotTimed: No answer was found.
    """
    import casadi as ca

    velocity, acceleration, jerk = limits
    first, second = path.at_nodes
    for of in (first, second):
        if np.abs(of[[0, -1]]).max() > AT_REST * np.abs(of).max():
            raise ValueError("the path does not come out of rest and back to it in this parameter")
    cells, joints = len(path.u) - 1, first.shape[1]
    h = np.diff(path.u)
    # Slow enough for every limit at a constant rate.
    start = min(
        float((limits[order] / np.abs(of).reshape(-1, joints).max(axis=0)).min()) ** (2.0 / (order + 1))
        for order, of in enumerate((first, second, path.third))
    )
    r, slope, bend = ca.MX.sym("r", cells + 1), ca.MX.sym("slope", cells + 1), ca.MX.sym("bend", cells)
    here, there = r[:-1], r[1:]
    middle = here + h / 2 * slope[:-1] + h**2 / 8 * bend
    time = ca.sum1(h / 6 * (here**-0.5 + 4 * middle**-0.5 + there**-0.5))
    rows = [here + h * slope[:-1] + h**2 / 2 * bend - there, slope[:-1] + h * bend - slope[1:], middle]
    low = [np.zeros(cells), np.zeros(cells), np.full(cells, SLOWEST * start)]
    high = [np.zeros(cells), np.zeros(cells), np.full(cells, np.inf)]

    def bounded(what: ca.MX, by: float) -> None:
        rows.append(what / by)
        low.append(np.full(what.shape[0], -1.0))
        high.append(np.ones(what.shape[0]))

    fastest = np.full(cells + 1, FASTEST * start)
    for joint in range(joints):
        with np.errstate(divide="ignore"):
            fastest = np.minimum(fastest, (velocity[joint] / np.abs(first[:, joint])) ** 2)
        bounded(second[:, joint] * r + 0.5 * first[:, joint] * slope, acceleration[joint])
        for end, (square, rise) in enumerate(((here, slope[:-1]), (there, slope[1:]))):
            one, two, three = (of[:, end, joint] for of in (path.first, path.second, path.third))
            bounded(ca.sqrt(square) * (three * square + 1.5 * two * rise + 0.5 * one * bend), jerk[joint])
    unknown = ca.vertcat(r, slope, bend)
    solver = ca.nlpsol(
        "timed",
        "ipopt",
        {"x": unknown, "f": time, "g": ca.vertcat(*rows)},
        {
            "print_time": False,
            "ipopt": {"print_level": 0, "sb": "yes", "max_iter": 500, "tol": 1e-8, "mu_strategy": "adaptive"},
        },
    )
    free = np.full(2 * cells + 1, np.inf)
    found = solver(
        x0=np.concatenate([np.full(cells + 1, start), np.zeros(2 * cells + 1)]),
        lbx=np.concatenate([np.full(cells + 1, SLOWEST * start), -free]),
        ubx=np.concatenate([fastest, free]),
        lbg=np.concatenate(low),
        ubg=np.concatenate(high),
    )
    if not solver.stats()["success"]:
        raise NotTimed(solver.stats()["return_status"])
    x = np.asarray(found["x"]).ravel()
    return Timing(float(found["f"]), x[: cells + 1], x[cells + 1 : 2 * cells + 2], x[2 * cells + 2 :])


def bound(path: JointPath, limits: Floats) -> float:
    """Return the least time along ``path`` (s) under the limits on velocity and acceleration alone: a lower bound.

    A pass back and one forth in the phase plane of arc length s and its squared speed, as TOPP-RA does it.
    """
    velocity, acceleration, _ = limits
    first, second = path.at_nodes
    h = np.diff(path.u)
    middle = (path.first[:, 0] + path.first[:, 1]) / 2 + h[:, None] / 8 * (path.second[:, 0] - path.second[:, 1])
    speeds = [np.linalg.norm(of, axis=1) for of in (path.first[:, 0], middle, path.first[:, 1])]
    steps = h / 6 * (speeds[0] + 4 * speeds[1] + speeds[2])
    speed = np.linalg.norm(first, axis=1)
    moving = speed > AT_REST * speed.max()
    tangent = np.concatenate([middle, middle[-1:]]) / np.concatenate([speeds[1], speeds[1][-1:]])[:, None]
    tangent[moving] = first[moving] / speed[moving, None]
    curvature = np.zeros_like(tangent)
    across = second - (second * tangent).sum(axis=1, keepdims=True) * tangent
    curvature[moving] = across[moving] / speed[moving, None] ** 2
    with np.errstate(divide="ignore"):
        fastest = ((velocity / np.abs(tangent)).min(axis=1)) ** 2
        fastest = np.minimum(
            fastest, (acceleration / np.abs(curvature)).min(axis=1, where=np.abs(tangent) < AT_REST, initial=np.inf)
        )
    # Slopes d of squared speed x that joint j allows: low + turn x <= d <= high + turn x.
    own = np.abs(tangent) >= AT_REST
    divided = np.where(own, tangent, 1.0) / 2.0
    most = np.where(own, acceleration / np.abs(divided), np.inf)
    turn = np.where(own, -curvature / divided, 0.0)
    fastest[[0, -1]] = 0.0
    reach = fastest.copy()
    for i in range(len(steps) - 1, -1, -1):
        if reach[i] <= 0.0:
            continue
        low = np.append(-most[i], 0.0)
        high = np.append(most[i], reach[i + 1] / steps[i])
        turns = np.append(turn[i], -1.0 / steps[i])
        rise = turns[:, None] - turns[None, :]
        room = high[None, :] - low[:, None]
        meets = rise > 0.0
        if meets.any():
            reach[i] = min(reach[i], float((room[meets] / rise[meets]).min()))
    x = np.zeros_like(reach)
    for i, step in enumerate(steps):
        x[i + 1] = min(reach[i + 1], max(0.0, x[i] + step * float((most[i] + turn[i] * x[i]).min())))
    roots = np.sqrt(x)
    return float((2.0 * steps / (roots[:-1] + roots[1:])).sum())
