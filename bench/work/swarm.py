"""A particle swarm on the 30-D sphere: pyswarms and bare numpy beside the core."""

from __future__ import annotations

import contextlib
import statistics
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.clock import OUT, core, median_ms
from bench.entries import Comparison, Entry, Goal, Section, attempt

Floats = NDArray[np.float64]

PARTICLES, ITERATIONS, DIMENSIONS, SIDE = 50, 300, 30, 5.12
INERTIA, PULL = 0.729, 1.494
RUNS = 9


def sphere(x: Floats) -> Floats:
    """Return the objective of every particle at once."""
    return np.asarray((x * x).sum(axis=1))


def numpy_swarm(seed: int) -> float:
    """Return the least value that a global-best swarm finds; no box, which is faster."""
    random = np.random.default_rng(seed)
    shape = (PARTICLES, DIMENSIONS)
    x = random.uniform(-SIDE, SIDE, shape)
    v = (random.uniform(-SIDE, SIDE, shape) - x) / 2
    best, values = x.copy(), sphere(x)
    for _ in range(ITERATIONS - 1):
        r1, r2 = random.random((2, *shape))
        v = INERTIA * v + PULL * r1 * (best - x) + PULL * r2 * (best[values.argmin()] - x)
        x = x + v
        found = sphere(x)
        better = found < values
        best[better], values[better] = x[better], found[better]
    return float(values.min())


def pyswarms_best(swarm: str, options: dict[str, Any], seed: int) -> float:
    """Return the least value that a swarm of pyswarms finds; no box, which is faster."""
    with contextlib.chdir(OUT):  # It writes a report.log where it stands.
        import pyswarms

        np.random.seed(seed)
        start = np.random.uniform(-SIDE, SIDE, (PARTICLES, DIMENSIONS))
        options = {"w": INERTIA, "c1": PULL, "c2": PULL, **options}
        optimizer = getattr(pyswarms.single, swarm)(PARTICLES, DIMENSIONS, options, init_pos=start)
        return float(optimizer.optimize(sphere, ITERATIONS, verbose=False)[0])


def entry(who: str, ms: float, bests: list[float]) -> Entry:
    """Return the entry of a swarm: how fast, how far it came."""
    updates = PARTICLES * ITERATIONS / ms
    return Entry(who, ms, f"{updates / 1000:.2f} million updates/s, best {statistics.median(bests):.1e}")


def timed(who: str, best_of: Any) -> Entry:
    """Return the entry of a peer, another seed every time."""
    bests: list[float] = []
    ms, _ = median_ms(lambda: bests.append(best_of(len(bests) + 1)), RUNS)
    return entry(who, ms, bests)


def measure() -> Section:
    """Return the section."""
    found = core("swarm", RUNS * 5)
    ours = {
        name: entry(name, statistics.median(one["times_ms"]), one["best"])
        for name, one in found.items()
        if name != "peak_mib"
    }
    ring = {"k": 5, "p": 2}
    everybody = Comparison(
        "global best",
        [
            Entry("elbowroom, one core", ours["global"].ms, ours["global"].answer),
            attempt(
                "pyswarms", lambda: timed("pyswarms GlobalBestPSO", lambda s: pyswarms_best("GlobalBestPSO", {}, s))
            ),
            attempt("numpy", lambda: timed("numpy", numpy_swarm)),
        ],
    )
    neighbours = Comparison(
        "local best, five neighbours",
        [
            Entry("elbowroom, one core", ours["ring"].ms, ours["ring"].answer),
            attempt(
                "pyswarms", lambda: timed("pyswarms LocalBestPSO", lambda s: pyswarms_best("LocalBestPSO", ring, s))
            ),
        ],
    )
    ratio = everybody.ratio(everybody.of("pyswarms"))
    goal = Goal(
        "swarm on 30-D sphere, 50 particles",
        ">= 20 x pyswarms a core",
        "no pyswarms" if ratio is None else f"{ratio:.1f} x",
        None if ratio is None else ratio >= 20.0,
    )
    words = f"""
{PARTICLES} particles, {ITERATIONS} iterations, inertia {INERTIA}, both pulls {PULL} for all. The peers take an
objective of all particles at once, ours one of each. Ours clamps speeds and positions to a box; the others are
spared that. Local best: ours is a ring, pyswarms looks for the nearest particles anew each time. The goal of 20 x was
set beside a pyswarms of 0.16 million updates/s; this one makes several times as many. A third of our own time goes into
random numbers, half into moving the particles (perf).
"""
    return Section("swarm", "Particle swarm", words.strip(), [everybody, neighbours], goals=[goal])
