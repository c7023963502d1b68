"""What is read from trajectory files: instants, and what is stated of the joints at them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

DIGITS = 60
"""Digits that differences of times are worked out with: of a clock since 1970 those of attoseconds, twice over."""


@dataclass(frozen=True, eq=False, kw_only=True)
class TrajectorySamples:
    """Rows of a trajectory.

    Attributes:
        t: Times since the first row (s).
        first: Time of the first row, as the file counts (s).
        since_start: Whether the file counts from the start of the motion: then the arm is on its way to a first row
            that is later than that. Else its times are those of some clock.
        q: Positions (rad), a row each.
        v: Velocities (rad/s); None where no row states any.
        a: Accelerations (rad/s²), the same.
        stated: What each row states: 0 positions alone, 1 velocities too, 2 accelerations too; None if all the same.
        notes: What a reader of the verdict has to know of how the file was read.
    """

    t: Floats
    first: float = 0.0
    since_start: bool
    q: Floats
    v: Floats | None
    a: Floats | None
    stated: NDArray[np.int64] | None = None
    notes: tuple[str, ...] = ()


def since_first(times: Sequence[Decimal]) -> tuple[Floats, float]:
    """Return ``times`` counted from the first, rounded only then, and the first.

    Clocks count from 1970, and there a float knows no tenth of a microsecond.
    """
    if not times:
        return np.empty(0), 0.0
    first = times[0]
    with localcontext(prec=DIGITS):
        return np.array([float(time - first) for time in times]), float(first)
