"""A joint path as those see it who time it: the derivatives of q(u) by a parameter u, cell by cell."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

import elbowroom as er

Floats = NDArray[np.float64]
Derivatives = Callable[[Floats], tuple[Floats, Floats, Floats]]


@dataclass(frozen=True)
class JointPath:
    """A path over cells of ``u``, shape ``(cells + 1,)``.

    ``first``, ``second`` and ``third`` derivative (rad) stand at both ends of every cell, seen from within, shape
    ``(cells, 2, joints)``: the third may jump from cell to cell.
    """

    u: Floats
    first: Floats
    second: Floats
    third: Floats

    @property
    def at_nodes(self) -> tuple[Floats, Floats]:
        """First and second derivative at the ends of cells, shape ``(cells + 1, joints)`` each."""
        first, second = (np.concatenate([of[:, 0], of[-1:, 1]]) for of in (self.first, self.second))
        return first, second


def along(derivatives: Derivatives, u: ArrayLike) -> JointPath:
    """Return the path whose ``derivatives``, shape ``(n, joints)`` each, are smooth within the cells of ``u``."""
    nodes = np.asarray(u, dtype=np.float64)
    ends = np.stack([nodes[:-1], nodes[1:]], axis=1)
    first, second, third = (of.reshape(*ends.shape, -1) for of in derivatives(ends.ravel()))
    return JointPath(nodes, first, second, third)


def of_motion(motion: er.Motion, cells: int) -> JointPath:
    """Return the path of ``motion``, its own time (s) as the parameter; each piece in so many ``cells``."""
    at: list[Floats] = []
    found: list[list[Floats]] = [[], [], []]
    for start, duration, coefficients in zip(motion.starts, motion.durations, motion.coefficients, strict=True):
        since = duration * np.arange(cells + 1) / cells
        at.append(start + since[:-1])
        for order, into in enumerate(found, start=1):
            values = np.stack([np.polynomial.Polynomial(c).deriv(order)(since) for c in coefficients], axis=-1)
            into.append(np.stack([values[:-1], values[1:]], axis=1))
    first, second, third = (np.concatenate(of) for of in found)
    return JointPath(np.append(np.concatenate(at), motion.end), first, second, third)
