from __future__ import annotations

import itertools
import math
from statistics import NormalDist

import numpy as np
import pytest

from elbowroom.compare import _statistics as statistics
from elbowroom.compare._statistics import (
    a12,
    cliffs_delta,
    holm,
    mann_whitney,
    median_interval,
    midranks,
    signed_rank,
    wilson_interval,
)


def slow_ranks(values: list[float]) -> list[float]:
    """Ranks by counting, halves where equal."""
    return [sum(w < v for w in values) + (sum(w == v for w in values) + 1) / 2 for v in values]


def tails(sums: list[float], found: float) -> float:
    low = sum(s <= found + 1e-9 for s in sums) / len(sums)
    high = sum(s >= found - 1e-9 for s in sums) / len(sums)
    return min(1.0, 2.0 * min(low, high))


def test_wilson_ends_solve_the_score_equation() -> None:
    for runs in (1, 2, 7, 30, 1000):
        for successes in {0, 1, runs // 2, runs - 1, runs}:
            found = wilson_interval(successes, runs)
            z = NormalDist().inv_cdf(0.975)
            for end in (found.low, found.high):
                if 0.0 < end < 1.0:
                    assert abs(successes / runs - end) == pytest.approx(z * math.sqrt(end * (1 - end) / runs))
            assert 0.0 <= found.low <= found.value <= found.high <= 1.0
    # The textbook's 9 of 10.
    assert wilson_interval(9, 10).low == pytest.approx(0.5958, abs=1e-4)
    assert wilson_interval(9, 10).high == pytest.approx(0.9821, abs=1e-4)
    for wrong in ((0, 0), (3, 2), (-1, 2)):
        with pytest.raises(ValueError, match="successes"):
            wilson_interval(*wrong)


def test_the_bootstrap_meets_the_whole_distribution_of_small_samples() -> None:
    values = [1.0, 2.0, 4.0, 8.0, 16.0]
    every = sorted(float(np.median(drawn)) for drawn in itertools.product(values, repeat=5))
    found = median_interval(values, seed=3)
    low, high = np.quantile(every, [0.025, 0.975])
    assert (found.value, found.low, found.high) == (4.0, low, high)
    assert found == median_interval(values, seed=3)
    assert median_interval([2.5] * 9, seed=0) == statistics.Interval(2.5, 2.5, 2.5)
    assert median_interval([7.0], seed=0).high == 7.0
    with pytest.raises(ValueError, match="no values"):
        median_interval([], seed=0)


def test_the_bootstrap_covers_the_median_about_as_often_as_it_says() -> None:
    random = np.random.default_rng(8)
    inside = 0
    for i in range(200):
        found = median_interval(random.exponential(size=30), seed=i)
        inside += found.low <= math.log(2.0) <= found.high
    assert 180 <= inside <= 200


def test_midranks_count() -> None:
    random = np.random.default_rng(1)
    for _ in range(300):
        values = random.integers(0, 5, random.integers(1, 12)).astype(float)
        values[random.random(values.size) < 0.2] = math.inf
        assert midranks(values).tolist() == slow_ranks(values.tolist())


def test_signed_rank_is_the_share_of_all_signs() -> None:
    random = np.random.default_rng(2)
    for _ in range(300):
        size = int(random.integers(1, 9))
        a, b = random.integers(0, 6, (2, size)).astype(float)
        if random.random() < 0.3:
            a[0] = math.inf
        differences = [x - y for x, y in zip(a, b, strict=True) if x != y]
        ranks = slow_ranks([abs(d) for d in differences])
        sums = [
            sum(r for r, up in zip(ranks, signs, strict=True) if up)
            for signs in itertools.product((False, True), repeat=len(ranks))
        ]
        found = sum(r for r, d in zip(ranks, differences, strict=True) if d > 0)
        assert signed_rank(a, b) == pytest.approx(tails(sums, found), abs=1e-12)
        assert signed_rank(a, b) == pytest.approx(signed_rank(b, a), abs=1e-12)
    assert signed_rank([1.0, math.inf], [1.0, math.inf]) == 1.0
    # Ten pairs that all go one way: 2 of 2 to the 10th.
    assert signed_rank(range(10), range(1, 11)) == pytest.approx(2.0 / 1024.0)
    with pytest.raises(ValueError, match="pairs"):
        signed_rank([1.0], [1.0, 2.0])


def test_mann_whitney_is_the_share_of_all_ways_to_share_out() -> None:
    random = np.random.default_rng(3)
    for _ in range(200):
        m, n = random.integers(1, 6, 2)
        values = random.integers(0, 7, m + n).astype(float)
        values[random.random(values.size) < 0.1] = math.inf
        ranks = slow_ranks(values.tolist())
        sums = [sum(chosen) for chosen in itertools.combinations(ranks, int(m))]
        p = mann_whitney(values[:m], values[m:])
        assert p == pytest.approx(tails(sums, sum(ranks[:m])), abs=1e-12)
        assert p == pytest.approx(mann_whitney(values[m:], values[:m]), abs=1e-12)
    assert mann_whitney([1.0] * 30, [1.0] * 30) == 1.0
    # All of one sample below all of the other: 2 of C(60, 30).
    assert mann_whitney(range(30), range(30, 60)) == pytest.approx(2.0 / math.comb(60, 30), rel=1e-9)
    with pytest.raises(ValueError, match="empty"):
        mann_whitney([], [1.0])


def test_large_samples_go_over_to_the_normal_without_a_step(monkeypatch: pytest.MonkeyPatch) -> None:
    random = np.random.default_rng(4)
    a, b = random.normal(0.0, 1.0, 40).round(1), random.normal(0.4, 1.0, 40).round(1)
    exact = signed_rank(a, b), mann_whitney(a, b)
    monkeypatch.setattr(statistics, "LARGEST_EXACT", 0)
    near = signed_rank(a, b), mann_whitney(a, b)
    assert near == pytest.approx(exact, abs=2e-3)
    assert mann_whitney([1.0] * 5, [1.0] * 5) == 1.0


def test_against_scipy() -> None:
    stats = pytest.importorskip("scipy.stats")
    random = np.random.default_rng(5)
    for _ in range(20):
        a, b = random.normal(0.0, 1.0, 12), random.normal(0.5, 1.0, 12)
        assert signed_rank(a, b) == pytest.approx(stats.wilcoxon(a, b, mode="exact").pvalue)
        assert mann_whitney(a, b) == pytest.approx(stats.mannwhitneyu(a, b, method="exact").pvalue)


def test_effect_sizes_are_counts_of_pairs() -> None:
    random = np.random.default_rng(6)
    for _ in range(200):
        a = random.integers(0, 5, random.integers(1, 10)).astype(float)
        b = random.integers(0, 5, random.integers(1, 10)).astype(float)
        pairs = [int(x > y) - int(x < y) for x in a for y in b]
        assert cliffs_delta(a, b) == pytest.approx(sum(pairs) / len(pairs), abs=1e-15)
        assert cliffs_delta(a, b) == -cliffs_delta(b, a)
        wins = sum(1.0 if x > y else 0.5 if x == y else 0.0 for x in a for y in b)
        assert a12(cliffs_delta(a, b)) == pytest.approx(wins / len(pairs))
    assert cliffs_delta([math.inf], [math.inf]) == 0.0
    with pytest.raises(ValueError, match="empty"):
        cliffs_delta([1.0], [])


def test_holm_steps_down() -> None:
    # By hand: 0.01 * 4, 0.013 * 3 raised to it, 0.02 * 2 the same, 0.9.
    assert holm([0.02, 0.01, 0.9, 0.013]) == pytest.approx([0.04, 0.04, 0.9, 0.04])
    assert holm([]) == []
    assert holm([0.6, 0.7]) == [1.0, 1.0]
    random = np.random.default_rng(7)
    for _ in range(200):
        p = random.random(6) ** 3
        adjusted = holm(p.tolist())
        # Rejecting adjusted values below a level is the step-down procedure itself.
        for level in (0.01, 0.05, 0.2):
            rejected = set()
            for place, i in enumerate(np.argsort(p, kind="stable")):
                if p[i] * (6 - place) >= level:
                    break
                rejected.add(int(i))
            assert {i for i in range(6) if adjusted[i] < level} == rejected
