"""Intervals, tests and effect sizes for the comparison: pure functions of numbers, each with its source."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

RESAMPLES = 10_000
"""Bootstrap samples drawn for an interval."""

LARGEST_EXACT = 20_000_000
"""Additions that an exact distribution may cost; above, the normal approximation is taken."""


@dataclass(frozen=True)
class Interval:
    """An estimate and the ends of its interval."""

    value: float
    low: float
    high: float


def median_interval(values: ArrayLike, *, seed: int, level: float = 0.95) -> Interval:
    """Return the median of ``values`` with its percentile bootstrap interval.

    Reference:
        Efron and Tibshirani, *An Introduction to the Bootstrap* (1993), section 13.3.
    """
    sample = np.asarray(values, dtype=np.float64)
    if not sample.size:
        raise ValueError("no values")
    if np.all(sample == sample[0]):
        return Interval(float(sample[0]), float(sample[0]), float(sample[0]))
    drawn = np.random.default_rng(seed).integers(0, sample.size, (RESAMPLES, sample.size))
    medians = np.median(sample[drawn], axis=1)
    low, high = np.quantile(medians, [(1.0 - level) / 2.0, (1.0 + level) / 2.0])
    return Interval(float(np.median(sample)), float(low), float(high))


def wilson_interval(successes: int, runs: int, *, level: float = 0.95) -> Interval:
    """Return the share of ``successes`` in ``runs`` with Wilson's score interval.

    Reference:
        Wilson, *Probable inference, the law of succession, and statistical inference* (1927).
    """
    if not 0 <= successes <= runs or not runs:
        raise ValueError(f"{successes} successes in {runs} runs")
    z = NormalDist().inv_cdf((1.0 + level) / 2.0)
    share = successes / runs
    middle = (share + z * z / (2 * runs)) / (1.0 + z * z / runs)
    half = z / (1.0 + z * z / runs) * math.sqrt(share * (1.0 - share) / runs + z * z / (4 * runs * runs))
    # At no and at all successes one end is 0 or 1 exactly, which rounding would miss.
    low = 0.0 if successes == 0 else middle - half
    high = 1.0 if successes == runs else middle + half
    return Interval(share, low, high)


def midranks(values: ArrayLike) -> Floats:
    """Return the ranks of ``values`` from 1, equal ones sharing the mean of theirs; infinities are ranked too."""
    sample = np.asarray(values, dtype=np.float64)
    ordered = np.sort(sample)
    first = np.searchsorted(ordered, sample, side="left")
    after = np.searchsorted(ordered, sample, side="right")
    ranks: Floats = (first + after + 1) / 2.0
    return ranks


def signed_rank(first: ArrayLike, second: ArrayLike) -> float:
    """Return the two-sided p-value of Wilcoxon's signed-rank test on pairs; pairs without a difference are left out.

    Exact, ties included: the distribution over all signs of the ranks found. Two infinite values of a pair count as
    equal. 1 if no pair differs.

    Reference:
        Wilcoxon, *Individual comparisons by ranking methods* (1945); for ties Hollander and Wolfe, *Nonparametric
        Statistical Methods* (1999), section 3.1.
    """
    a, b = (np.asarray(values, dtype=np.float64) for values in (first, second))
    if a.shape != b.shape:
        raise ValueError(f"{a.size} and {b.size} values make no pairs")
    differs = a != b
    differences = a[differs] - b[differs]
    if not differences.size:
        return 1.0
    # Midranks are halves: doubled they are whole numbers, over which sums can be counted.
    ranks = np.rint(2.0 * midranks(np.abs(differences))).astype(np.int64)
    positive, total = int(ranks[differences > 0].sum()), int(ranks.sum())
    if ranks.size * total > LARGEST_EXACT:
        spread = math.sqrt(float(np.sum(ranks.astype(np.float64) ** 2)) / 4.0)
        return _normal(positive - total / 2.0, spread)
    share = np.zeros(total + 1)
    share[0] = 1.0
    for rank in ranks:
        shifted = np.zeros_like(share)
        shifted[rank:] = share[: share.size - rank]
        share = (share + shifted) / 2.0
    return _two_sided(share, positive)


def mann_whitney(first: ArrayLike, second: ArrayLike) -> float:
    """Return the two-sided p-value of the Mann-Whitney test on two independent samples.

    Exact where that is not too much work, ties included: the distribution over all ways to share the ranks out.

    Reference:
        Mann and Whitney, *On a test of whether one of two random variables is stochastically larger than the other*
        (1947); for ties Lehmann, *Nonparametrics* (1975), section 1.4.
    """
    a, b = (np.asarray(values, dtype=np.float64) for values in (first, second))
    if not a.size or not b.size:
        raise ValueError("a sample is empty")
    ranks = np.rint(2.0 * midranks(np.concatenate([a, b]))).astype(np.int64)
    found, count, size = int(ranks[: a.size].sum()), a.size, ranks.size
    if count * int(ranks.sum()) * size > LARGEST_EXACT * 10:
        spread = math.sqrt(count * b.size / size * float(np.var(ranks, ddof=1)))
        return _normal(found - count * (size + 1), spread)
    # ways[k, s]: the share of choices of k ranks, among those seen so far, whose sum is s. Shares instead of counts, so
    # that nothing overflows: a rank seen as number n belongs to the first sample of k with probability k / n.
    ways = np.zeros((count + 1, int(ranks.sum()) + 1))
    ways[0, 0] = 1.0
    for seen, rank in enumerate(ranks):
        taken = np.zeros_like(ways)
        left = count - np.arange(count)
        room = size - seen
        taken[1:, rank:] = ways[:-1, : ways.shape[1] - rank] * (left / room)[:, None]
        stay = np.clip(1.0 - (count - np.arange(count + 1)) / room, 0.0, 1.0)
        ways = ways * stay[:, None] + taken
    return _two_sided(ways[count], found)


def _two_sided(share: Floats, found: int) -> float:
    """Twice the smaller tail of a distribution over whole numbers, the value found included."""
    return min(1.0, 2.0 * min(float(share[: found + 1].sum()), float(share[found:].sum())))


def _normal(distance: float, spread: float) -> float:
    """Twice the tail of a normal distribution; half a rank (one, doubled) is taken off for continuity."""
    if spread == 0.0:
        return 1.0
    return min(1.0, 2.0 * NormalDist().cdf(-max(abs(distance) - 1.0, 0.0) / spread))


def cliffs_delta(first: ArrayLike, second: ArrayLike) -> float:
    """Return how much oftener a value of ``first`` is greater than one of ``second`` than smaller, from -1 to 1.

    Reference:
        Cliff, *Dominance statistics: ordinal analyses to answer ordinal questions* (1993).
    """
    a, b = (np.sort(np.asarray(values, dtype=np.float64)) for values in (first, second))
    if not a.size or not b.size:
        raise ValueError("a sample is empty")
    smaller = np.searchsorted(b, a, side="left").sum()
    greater = (b.size - np.searchsorted(b, a, side="right")).sum()
    return float(smaller - greater) / (a.size * b.size)


def a12(delta: float) -> float:
    """Return the probability that a value of the first sample is greater than one of the second, ties counting half, of
    their Cliff's ``delta``.

    Reference:
        Vargha and Delaney, *A critique and improvement of the CL common language effect size statistics* (2000).
    """
    return (delta + 1.0) / 2.0


def holm(p_values: Sequence[float]) -> list[float]:
    """Return the p-values adjusted so that the chance of any false alarm among them stays below the level.

    Reference:
        Holm, *A simple sequentially rejective multiple test procedure* (1979).
    """
    order = sorted(range(len(p_values)), key=lambda i: p_values[i])
    adjusted = [0.0] * len(p_values)
    least = 0.0
    for place, i in enumerate(order):
        least = max(least, min(1.0, p_values[i] * (len(p_values) - place)))
        adjusted[i] = least
    return adjusted
