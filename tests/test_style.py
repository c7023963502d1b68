"""Obstacles as pictures show them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.patches import Circle, Polygon

import elbowroom as er
from elbowroom.figures._style import corners_of, plane


def distance(point: tuple[float, float], a: tuple[float, float], b: tuple[float, float]) -> float:
    """From a point to the line between two."""
    p, a_, b_ = np.array(point), np.array(a), np.array(b)
    t = np.clip((p - a_) @ (b_ - a_) / ((b_ - a_) @ (b_ - a_)), 0.0, 1.0)
    return float(np.linalg.norm(p - a_ - t * (b_ - a_)))


def area(corners: np.ndarray) -> float:
    """What corners go round, negative if the wrong way."""
    x, y = corners.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0


@pytest.mark.parametrize("ends", [((0.1, 0.2), (0.4, -0.3)), ((0.4, -0.3), (0.1, 0.2)), ((0.0, 0.0), (-0.5, 0.0))])
def test_a_segment_is_as_thick_as_it_is_all_round(ends: tuple[tuple[float, float], tuple[float, float]]) -> None:
    corners = corners_of((ends, 0.05))
    assert all(distance(corner, *ends) == pytest.approx(0.05, abs=1e-12) for corner in corners)
    length = math.dist(*ends)
    assert area(np.array(corners)) == pytest.approx(2 * 0.05 * length + math.pi * 0.05**2, rel=1e-3)


@pytest.mark.parametrize("turned", [False, True])
def test_a_polygon_is_rounded_outwards(turned: bool) -> None:
    square = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.2), (0.0, 0.2)]
    corners = corners_of((square[::-1] if turned else square, 0.1))
    assert area(np.array(corners)) == pytest.approx(0.04 + 4 * 0.2 * 0.1 + math.pi * 0.01, rel=1e-3)
    assert corners_of((square, 0.0)) == square


def test_every_shape_is_drawn_as_large_as_it_is(standin: er.Scene) -> None:
    thin = er.Segment(start=(-0.3, 0.1), end=(-0.1, 0.3))
    thick = thin.replace(radius=0.02)
    wedge = er.Polygon(vertices=[(0.1, 0.1), (0.3, 0.1), (0.2, 0.4)])
    disc = er.Circle(center=(0.1, -0.3), radius=0.07)
    _, axes = plane("shapes", standin.replace(obstacles=[thin, thick, wedge, disc], tasks={}))
    line, wall, corners, circle = axes.patches
    assert isinstance(line, Polygon)
    assert isinstance(circle, Circle)
    assert line.get_xy()[:2].tolist() == [[-0.3, 0.1], [-0.1, 0.3]]
    assert line.get_linewidth() > 0.0
    assert line.get_edgecolor()[3] == 1.0
    for patch, (x0, y0, x1, y1) in ((wall, (-0.32, 0.08, -0.08, 0.32)), (corners, (0.1, 0.1, 0.3, 0.4))):
        box = patch.get_path().get_extents()
        assert (box.x0, box.y0, box.x1, box.y1) == pytest.approx((x0, y0, x1, y1), abs=1e-4)
        assert patch.get_edgecolor()[3] == 0.0
    assert circle.radius == pytest.approx(0.07)
