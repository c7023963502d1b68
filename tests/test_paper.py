from __future__ import annotations

import itertools
import math
from pathlib import Path

import pytest

from elbowroom._paper import reproduce
from elbowroom._paper.bounds import around_disc, nearest_reach, octile


def test_bounds_are_the_known_ones() -> None:
    radius = nearest_reach((25.0, 25.0), math.radians(90))
    assert radius == pytest.approx(25 * math.sqrt(2))
    first, second = ((40.0, 10.0), (-45.0, -15.0)), ((30.0, -30.0), (15.0, 45.0))
    assert octile(*first) == pytest.approx(95.3553, abs=5e-5)
    assert octile(*second) == pytest.approx(81.2132, abs=5e-5)
    assert around_disc(*first, radius) == pytest.approx(116.287, abs=5e-4)
    assert around_disc(*second, radius) == pytest.approx(80.496, abs=5e-4)
    assert around_disc(*second, radius, long_way=True) == pytest.approx(158.78, abs=5e-3)
    assert around_disc((35.0, 10.0), (35.0, -10.0), radius) > 20.0
    assert around_disc((36.0, 1.0), (36.0, -1.0), radius) == 2.0


def test_around_disc_is_no_longer_than_any_polyline_that_misses_the_disc() -> None:
    start, goal, radius = (40.0, 10.0), (-45.0, -15.0), 35.0
    angles = [math.atan2(10, 40) - i * math.radians(175.6) / 400 for i in range(401)]
    polyline = [start, *((36.0 * math.cos(a), 36.0 * math.sin(a)) for a in angles), goal]
    length = sum(math.dist(a, b) for a, b in itertools.pairwise(polyline))
    assert around_disc(start, goal, radius) < length


def test_the_report_has_every_figure_and_number(tmp_path: Path) -> None:
    report = reproduce(tmp_path, seeds=2)
    text = report.read_text()
    for scene in ("paper-standin", "paper-empty"):
        numbers = ["04a", "04b", "05", *(f"{i:02}" for i in range(6, 20))]
        for number in numbers:
            assert (tmp_path / scene / f"figure_{number}.png").stat().st_size > 1000
            assert f"{scene}/figure_{number}.png" in text
    assert (tmp_path / "paper-table1" / "figure_06.png").exists()
    for number in ("92.6232", "82.8733", "95.3553", "81.2132", "116.287", "158.78", "124.468", "86.1838"):
        assert number in text, number
    assert "task first: no path at 1" in text
