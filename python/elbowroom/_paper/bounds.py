"""Lengths known in closed form: what no path can beat."""

from __future__ import annotations

import math

Pair = tuple[float, float]


def octile(start: Pair, goal: Pair) -> float:
    """Return the least cost of an eight-neighbour grid path without obstacles (same unit)."""
    dx, dy = abs(goal[0] - start[0]), abs(goal[1] - start[1])
    return max(dx, dy) + (math.sqrt(2.0) - 1.0) * min(dx, dy)


def around_disc(start: Pair, goal: Pair, radius: float, *, long_way: bool = False) -> float:
    """Return the length of the shortest path from ``start`` to ``goal`` around a disc about the origin.

    The straight line if it misses the disc; else a tangent, an arc and a tangent. With ``long_way`` on the other side
    of the disc.
    """
    a, b = math.hypot(*start), math.hypot(*goal)
    turn = abs(math.remainder(math.atan2(goal[1], goal[0]) - math.atan2(start[1], start[0]), math.tau))
    if long_way:
        turn = math.tau - turn
    arc = turn - math.acos(radius / a) - math.acos(radius / b)
    if arc <= 0.0:
        return math.dist(start, goal)
    return math.sqrt(a * a - radius * radius) + math.sqrt(b * b - radius * radius) + radius * arc


def nearest_reach(links: Pair, bend: float) -> float:
    """Return how near to the base the tip can come with the second joint within ``±bend`` (rad)."""
    l1, l2 = links
    return math.sqrt(l1 * l1 + l2 * l2 + 2.0 * l1 * l2 * math.cos(bend))
