"""Clocks: of a Python function, of the core's example ``measure``, of a process with a time limit."""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

T = TypeVar("T")

ROOT = Path(__file__).parent.parent
OUT = ROOT / "out" / "bench"
MEASURE = ROOT / "target" / "release" / "examples" / "measure"

LONG = 1.0
"""Work that takes longer needs no warm-up (s)."""


class TooLong(Exception):
    """A process was stopped at its time limit."""


def median_ms(work: Callable[[], T], runs: int = 5) -> tuple[float, T]:
    """Return the median time of ``runs`` calls (ms), warmed up unless they are long, and the last answer."""
    spent: list[float] = []
    while len(spent) < runs + 1:
        begun = time.perf_counter()
        answer = work()
        spent.append(time.perf_counter() - begun)
        if len(spent) == runs and spent[0] > LONG:
            return statistics.median(spent) * 1e3, answer
    return statistics.median(spent[1:]) * 1e3, answer


def run(command: Sequence[str | Path], *, limit: float, threads: int | None = None, given: str = "") -> str:
    """Return what ``command`` prints; ``threads`` holds for the core's data-parallel loops.

    Raises:
        TooLong: It did not end within ``limit`` (s).
        RuntimeError: It failed; with the last line of its complaint.
    """
    environment = dict(os.environ) | ({} if threads is None else {"RAYON_NUM_THREADS": str(threads)})
    try:
        done = subprocess.run(
            command, input=given, capture_output=True, text=True, timeout=limit, env=environment, cwd=ROOT, check=False
        )
    except subprocess.TimeoutExpired:
        raise TooLong(f"over {limit:g} s") from None
    if done.returncode != 0:
        raise RuntimeError((done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1])
    return done.stdout


def core(*arguments: str | int | Path, threads: int | None = 1, limit: float = 120.0) -> dict[str, Any]:
    """Return what the core's example ``measure`` prints."""
    return dict(json.loads(run([MEASURE, *map(str, arguments)], limit=limit, threads=threads)))
