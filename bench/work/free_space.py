"""The free-space map of both postures: numpy and shapely beside the core."""

from __future__ import annotations

import math
import os
import statistics
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import elbowroom as er
from bench.clock import OUT, ROOT, core, median_ms
from bench.entries import MS_CLASS, Comparison, Entry, Goal, Section, attempt
from elbowroom._scene import Obstacle

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mask = NDArray[np.bool_]

SCENE = "narrow"
CHUNK = 65_536
"""Points that numpy takes at a time: its temporaries stay in the cache, which makes it half as fast again."""

SIDES = 128
"""Corners of the polygons that shapely has for circles."""


def with_points(scene: er.Scene, points: int) -> er.Scene:
    """Return ``scene`` with ``points`` along each side of its grid."""
    low, high = scene.grid.x
    return scene.replace(grid=scene.grid.replace(step=(high - low) / (points - 1)))


def core_map(file: Path, points: int, runs: int, threads: int | None) -> tuple[float, Mask]:
    """Return how long the core takes (ms) and its maps, elbow-up first, shape ``(2, rows, columns)``."""
    out = OUT / f"map_{points}.bin"
    times = core("map", file, points, runs, out, threads=threads)["times_ms"]
    return statistics.median(times), np.fromfile(out, dtype=np.bool_).reshape(2, points, points)


def chunks(scene: er.Scene, chunk: int) -> Iterator[tuple[slice, NDArray[np.intp], Complex, Complex]]:
    """Yield rows of the grid, the places among their points within reach and joint limits, tips there, and the elbows
    of both postures, elbow-up first, shape ``(2, n)``; places are complex numbers.
    """
    low, high = scene.grid.x
    count = round((high - low) / scene.grid.step) + 1
    axis = low + scene.grid.step * np.arange(count)
    first, second = scene.arm.links
    bend = scene.arm.joints[1].max
    assert scene.arm.joints[0].continuous
    assert bend is not None
    assert scene.arm.joints[1].min == -bend
    rows = max(1, chunk // count)
    for begin in range(0, count, rows):
        part = slice(begin, min(begin + rows, count))
        tips = (axis[None, :] + 1j * axis[part, None]).ravel()
        squared = tips.real**2 + tips.imag**2
        cosine = (squared - first**2 - second**2) / (2 * first * second)
        # A tip at the end of the reach is within it, whatever the rounding.
        at = np.flatnonzero((cosine <= 1 + 1e-12) & (cosine >= math.cos(bend)))
        tips, squared = tips[at], squared[at]
        foot = (squared + first**2 - second**2) / (2 * squared)
        beside = np.sqrt(np.maximum(first**2 / squared - foot**2, 0.0))
        yield part, at, tips, np.stack([tips * (foot + 1j * beside), tips * (foot - 1j * beside)])


def numpy_map(scene: er.Scene) -> Mask:
    """Return the maps of both postures, elbow-up first."""
    low, high = scene.grid.x
    count = round((high - low) / scene.grid.step) + 1
    free = np.zeros((2, count, count), dtype=np.bool_)
    for part, at, tips, elbows in chunks(scene, CHUNK):
        for posture, elbow in enumerate(elbows):
            hit = np.zeros(len(at), dtype=np.bool_)
            for obstacle in scene.obstacles:
                for begin, along, length in (
                    (0j, elbow, scene.arm.links[0]),
                    (elbow, tips - elbow, scene.arm.links[1]),
                ):
                    hit |= touched(obstacle, begin, along, length)
            free[posture, part].ravel()[at] = ~hit
    return free


def touched(obstacle: Obstacle, begin: Complex | complex, along: Complex, length: float) -> Mask:
    """Return which links, from ``begin`` along ``along``, touch the obstacle."""
    if isinstance(obstacle, er.Circle):
        return near(complex(*obstacle.center), obstacle.radius, begin, along, length)
    assert isinstance(obstacle, er.Polygon), "this map knows circles and polygons"
    corners = np.array([complex(*corner) for corner in obstacle.vertices])
    center = corners.mean()
    hit = near(center, float(np.abs(corners - center).max()), begin, along, length)
    # Few links come near a polygon: only theirs are compared with its edges, all edges at once.
    few = np.flatnonzero(hit)
    starts = np.broadcast_to(begin, along.shape)[few][:, None]
    links = along[few][:, None]
    edges = np.roll(corners, -1) - corners
    to_corner = corners - starts
    sides = cross(links, to_corner)
    ends = cross(edges, -to_corner), cross(edges, links - to_corner)
    # The base is outside all polygons: what crosses no edge is outside.
    crossing = (sides * np.roll(sides, -1, axis=1) <= 0) & (ends[0] * ends[1] <= 0)
    hit[few] = crossing.any(axis=1)
    return hit


def near(center: complex, radius: float, begin: Complex | complex, along: Complex, length: float) -> Mask:
    """Return which links come within ``radius`` of ``center``."""
    to = center - begin
    t = np.clip((to.real * along.real + to.imag * along.imag) / length**2, 0.0, 1.0)
    x, y = to.real - t * along.real, to.imag - t * along.imag
    return np.asarray(x * x + y * y <= radius**2)


def cross(a: Complex, b: Complex) -> Floats:
    """Return the cross products of plane vectors."""
    return a.real * b.imag - a.imag * b.real


def shapely_core(obstacle: Obstacle) -> tuple[Any, float]:
    """Return the point, line or polygon that ``obstacle`` is all around, and how far (m)."""
    import shapely

    points, radius = obstacle.outline
    kind = {1: shapely.Point, 2: shapely.LineString}.get(len(points), shapely.Polygon)
    return kind(points), radius


def shapely_map(scene: er.Scene) -> Mask:
    """Return the maps by one prepared union of all obstacles: links are line strings from base to elbow to tip."""
    import shapely

    shapes = [
        inner.buffer(radius, quad_segs=SIDES // 4) if radius > 0.0 else inner
        for inner, radius in map(shapely_core, scene.obstacles)
    ]
    union = shapely.union_all(shapes)
    shapely.prepare(union)
    low, high = scene.grid.x
    count = round((high - low) / scene.grid.step) + 1
    free = np.zeros((2, count, count), dtype=np.bool_)
    for part, at, tips, elbows in chunks(scene, CHUNK):
        for posture, elbow in enumerate(elbows):
            coordinates = np.zeros((len(at), 3, 2))
            coordinates[:, 1, 0], coordinates[:, 1, 1] = elbow.real, elbow.imag
            coordinates[:, 2, 0], coordinates[:, 2, 1] = tips.real, tips.imag
            free[posture, part].ravel()[at] = ~shapely.intersects(union, shapely.linestrings(coordinates))
    return free


def only_touching(scene: er.Scene, ours: Mask, theirs: Mask, within: float) -> str:
    """Return in words how two maps differ, judged by shapely's distances.

    A difference is one of touching when the arm meets the obstacles grown by ``within`` (m), not those shrunk by it.
    """
    import shapely

    differ = ours != theirs
    if not differ.any():
        return f"{int(theirs.sum()):,} free, equal"
    apart = 0
    for part, at, tips, elbows in chunks(scene, CHUNK):
        for posture, elbow in enumerate(elbows):
            for i in np.flatnonzero(differ[posture, part].ravel()[at]):
                arm = shapely.LineString([(0, 0), (elbow[i].real, elbow[i].imag), (tips[i].real, tips[i].imag)])
                grown, shrunk = False, False
                for shape in scene.obstacles:
                    inner, radius = shapely_core(shape)
                    away = arm.distance(inner) - radius
                    grown, shrunk = grown or away <= within, shrunk or away <= -within
                    if radius == 0.0:
                        shrunk = shrunk or arm.intersects(inner.buffer(-within, join_style="mitre"))
                apart += not grown or shrunk
    rest = f"**{apart} of them not**" if apart else "all"
    return f"{int(theirs.sum()):,} free, {int(differ.sum())} differ, {rest} touching to within {within:g} m"


def measure() -> Section:
    """Return the section."""
    comparisons = []
    for points in (101, 1001):
        file = ROOT / "scenes" / f"{SCENE}.yaml"
        scene = with_points(er.Scene.load(file), points)
        runs = 3 if points > 101 else 9
        ours_ms, ours = core_map(file, points, 5 * runs, 1)
        all_ms, _ = core_map(file, points, 5 * runs, None)

        def in_python(scene: er.Scene = scene, ours: Mask = ours, runs: int = runs) -> Entry:
            ms, space = median_ms(lambda: er.free_space(scene), runs)
            found = np.stack([space.elbow_up.free, space.elbow_down.free])
            return Entry("elbowroom.free_space, all cores", ms, only_touching(scene, ours, found, 2e-9))

        def by_numpy(scene: er.Scene = scene, ours: Mask = ours, runs: int = runs) -> Entry:
            ms, found = median_ms(lambda: numpy_map(scene), runs)
            return Entry("numpy", ms, only_touching(scene, ours, found, 2e-9))

        def by_shapely(scene: er.Scene = scene, ours: Mask = ours, runs: int = runs) -> Entry:
            ms, found = median_ms(lambda: shapely_map(scene), runs)
            return Entry("shapely", ms, only_touching(scene, ours, found, 2e-5))

        comparisons.append(
            Comparison(
                f"{points} x {points} points, {SCENE}.yaml",
                [
                    Entry("elbowroom, one core", ours_ms, f"{int(ours.sum()):,} free"),
                    Entry(f"elbowroom, {os.cpu_count()} cores", all_ms, "same bytes"),
                    attempt("elbowroom.free_space", in_python),
                    attempt("numpy", by_numpy),
                    attempt("shapely", by_shapely),
                ],
            )
        )
    large = comparisons[-1]
    ratio = large.ratio(large.of("numpy"))
    assert large.ours.ms is not None
    goal = Goal(
        "free-space map, 1001 x 1001, both postures",
        ">= 100 x numpy, <= 12 ms-class on one core",
        f"{'no numpy' if ratio is None else f'{ratio:.1f} x numpy'}, {large.ours.ms:.1f} ms",
        None if ratio is None else ratio >= 100 and large.ours.ms <= 12.0 * MS_CLASS,
    )
    words = f"""
Both postures of every grid point: inverse kinematics, joint limits, both links against 12 obstacles. `numpy`
computes without trigonometry in chunks that fit the cache and looks at a polygon's edges only where a link comes
near it. `shapely` asks one prepared union, with circles of {SIDES} corners. `elbowroom.free_space` is the Python
function, which also hands out the reason for every point as arrays. Maps are compared point by point; ours counts a
clearance of up to 1e-9 m as contact. The goal of 100 x was set beside a numpy that took 1,247 ms; this one is several
times as fast. Of our own time six tenths are blocks and their rules, three tenths memory pages (perf).
"""
    return Section("map", "Free-space map", words.strip(), comparisons, goals=[goal])
