"""To what the numbers of a trajectory from elsewhere are rounded, as the numbers themselves tell."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from elbowroom._trajectory_samples import Floats, TrajectorySamples

FEWEST_ROWS = 8
"""Fewer rows are typed by hand, and meant as they are."""

COARSEST_DECIMALS, FINEST_DECIMALS = 3, 12
"""Numbers with fewer digits after the point are meant so; with more they have about all that a double has."""

COARSEST_COUNT = 0.02
"""Greatest step of an encoder (rad)."""

DENSE = 0.02
"""Rows of an encoder are no farther apart than this (s)."""

PLACES = 8 * math.ulp(1.0)
"""How far from a multiple a double may be that was meant to be one, as a share of it."""

ROUNDED = 0.3
"""Where this share of the fourth differences is not 0, a grid is rounding; of ramps that lie on one few are."""

FEWEST_COUNTS, MOST_COUNTS = 2, 12
"""Least number of counts that are seen of an encoder, and most that the least way between two rows may be."""

CHANCE = 14.0
"""So unlikely (as a logarithm) must it be that values lie on a grid of counts by chance."""


@dataclass(frozen=True, eq=False)
class Rounding:
    """To multiples of what the numbers of a trajectory are rounded; 0 where they have all digits, or are meant so.

    Attributes:
        quanta: Of positions, velocities and accelerations, a row each joint (rad, rad/s, rad/s²).
        time: Of times (s).
    """

    quanta: NDArray[np.float64]
    time: float


def rounding_of(samples: TrajectorySamples) -> Rounding:
    """Return to what the numbers of ``samples`` are rounded.

    Decimals are those of all joints together: whoever writes a table gives each joint the same. Counts of an encoder
    are those of one joint, and may have been rounded to decimals besides.
    """
    joints = samples.q.shape[1] if samples.q.ndim == 2 else 0
    quanta = np.zeros((joints, 3))
    if len(samples.t) >= FEWEST_ROWS:
        quanta[:] = _quanta([values for values in (samples.q, samples.v, samples.a) if values is not None])
        if float(np.median(np.diff(samples.t))) <= DENSE:
            for j in range(joints):
                quanta[j, 0] = max(quanta[j, 0], _count(samples.q[:, j], quanta[j, 0]))
    return Rounding(quanta, _time_quantum(samples.t))


def _quanta(tables: list[Floats]) -> list[float]:
    """The step of the coarsest decimal grid that each table lies on, if that is rounding; else 0."""
    grids = [_grid(values, in_degrees=order == 0) for order, values in enumerate(tables)]
    # With so many decimals one table is seen to be rounded: then so are those that have as many.
    seen = {
        grid
        for grid, values in zip(grids, tables, strict=True)
        if grid is not None and _is_rounded(values, _step(grid))
    }
    steps = [_step(grid) if grid in seen and grid is not None else 0.0 for grid in grids]
    steps = [step or _single(values) for step, values in zip(steps, tables, strict=True)]
    return steps + [0.0] * (3 - len(steps))


def _grid(values: Floats, *, in_degrees: bool) -> tuple[int, float] | None:
    """The fewest decimals, and the unit that they are of (rad), that all ``values`` are written with."""
    for unit in (1.0, math.radians(1.0)) if in_degrees else (1.0,):
        decimals = _decimals(values / unit)
        if decimals is not None:
            return (decimals, unit) if decimals >= COARSEST_DECIMALS - (unit != 1.0) else None
    return None


def _step(grid: tuple[int, float]) -> float:
    decimals, unit = grid
    return unit * 10.0**-decimals


def _single(values: Floats) -> float:
    """What numbers of single precision are rounded to, if ``values`` are such."""
    single = values.astype(np.float32)
    if not np.array_equal(values, single) or _decimals(values) is not None:
        return 0.0
    return float(np.spacing(np.abs(single).max()))


def _decimals(values: Floats) -> int | None:
    for decimals in range(FINEST_DECIMALS + 1):
        scaled = values * 10.0**decimals
        if np.all(np.abs(scaled - np.rint(scaled)) <= PLACES * np.abs(scaled)):
            return decimals
    return None


def _is_rounded(values: Floats, step: float) -> bool:
    """Whether rows on a grid are scattered on it as rounding does."""
    counts = np.rint(values / step)
    differences = np.diff(counts, n=4, axis=0)
    changes = np.ptp(np.lib.stride_tricks.sliding_window_view(counts, 5, axis=0), axis=-1) > 0.0
    moving = int(changes.sum())
    return moving > 0 and int(np.count_nonzero(differences)) >= ROUNDED * moving


def _count(column: Floats, decimal: float) -> float:
    """The step of an encoder that ``column`` is in counts of, to within its decimals; 0 if it is not."""
    distinct = np.unique(column)
    off = 2.0 * (decimal + PLACES * float(np.abs(column).max()))
    distinct = distinct[np.insert(np.diff(distinct) > off, 0, True)]
    if len(distinct) < FEWEST_COUNTS:
        return 0.0
    ways = distinct[1:] - distinct[0]
    least = float(np.diff(distinct).min())
    for part in range(1, MOST_COUNTS + 1):
        step = _refined(least / part, ways, off)
        if step is None or step > COARSEST_COUNT:
            continue
        counts = np.rint(ways / step)
        if math.gcd(*counts.astype(int).tolist()) != 1 or not np.all(np.abs(ways - counts * step) <= off):
            continue
        # Few values that are kept for long are counts as well.
        kept = 4 * len(distinct) <= len(column) and step >= 20.0 * off
        likely = len(ways) * math.log(max(step / (2.0 * off), 1.0)) > CHANCE
        scattered = _is_rounded((column - distinct[0])[:, None], step)
        return step if (kept or likely) and scattered else 0.0
    return 0.0


def _refined(step: float, ways: Floats, off: float) -> float | None:
    """The step near ``step`` that the ascending ``ways`` are multiples of; the longest tell it best."""
    # By what share of it the step may be off.
    share = off / float(ways[0])
    for way in ways.tolist():
        count = round(way / step)
        if count == 0 or abs(way - count * step) > off + min(share * way, 0.4 * step):
            return None
        if share * way < 0.4 * step:
            step, share = way / count, off / way
    return step


def _time_quantum(t: Floats) -> float:
    """The step of the decimal grid that times of an even clock were rounded to; 0 where they are as they should be."""
    if len(t) < FEWEST_ROWS:
        return 0.0
    decimals, without_last = _decimals(t), _decimals(t[:-1])
    if decimals is None or without_last is None or decimals < COARSEST_DECIMALS:
        return 0.0
    step = 10.0**-decimals
    counts = np.diff(np.rint(t / step))[1:-1]
    # Where a motion ends is told with all digits that there are, also where the clock needs fewer.
    uneven = np.ptp(counts) == 1.0 or (np.ptp(counts) == 0.0 and decimals > without_last)
    return step if uneven else 0.0
