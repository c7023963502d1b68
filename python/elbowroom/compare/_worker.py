"""What happens in a worker: a batch of runs on one scene, one after the other, on a single thread."""

from __future__ import annotations

import faulthandler
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from time import monotonic

from elbowroom._scene import Scene
from elbowroom.compare._row import Problem, Row
from elbowroom.compare._run import run

ONE_THREAD = dict.fromkeys(("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""The environment of workers: the cores are shared out by runs, and a run's time is that of one core."""

GRACE = 10.0
"""How long after its timeout a planner may go on (s) before its process is ended."""

LONGEST_WATCH = 1e6
"""Timeouts beyond this (s) are not watched over: nobody waits."""


@dataclass(frozen=True)
class Batch:
    """Runs on one scene, whose text goes with them: the file may change, or lie on another machine."""

    file: str
    text: str
    problems: Sequence[Problem]


@dataclass(frozen=True)
class Begun:
    """Says that a run has begun, so that it is known which one ended the process."""

    number: int


def answers(batch: Batch) -> Iterator[Begun | Row]:
    """Yield the rows of ``batch`` in order, each after word that it has begun."""
    scene = Scene.parse(batch.text, file=batch.file)
    for number, problem in enumerate(batch.problems):
        yield Begun(number)
        with _watched(problem.timeout_s):
            row = run(problem, scene)
        yield row


@contextmanager
def _watched(timeout: float | None) -> Iterator[None]:
    """End the process if the block far exceeds ``timeout``, even while foreign code holds the interpreter."""
    if timeout is None or timeout > LONGEST_WATCH:
        yield
        return
    with open(os.devnull, "wb") as nowhere:
        faulthandler.dump_traceback_later(timeout + GRACE, exit=True, file=nowhere)
        try:
            yield
        finally:
            faulthandler.cancel_dump_traceback_later()


class Progress:
    """What is known of a batch under way, from its messages."""

    def __init__(self, batch: Batch) -> None:
        self.batch = batch
        self.done = 0
        self._begun: float | None = None

    def heard(self, message: Begun | Row) -> Row | None:
        """Take in a message; return it if it is a row."""
        if isinstance(message, Begun):
            self._begun = monotonic()
            return None
        self.done += 1
        self._begun = None
        return message

    def lost(self) -> tuple[Row | None, Batch | None]:
        """Return the row of the run that ended the process, None if none had begun, and the batch that is left."""
        problems = self.batch.problems[self.done :]
        row = None
        if self._begun is not None:
            problem, problems = problems[0], problems[1:]
            row = _ended(problem, monotonic() - self._begun)
        return row, Batch(self.batch.file, self.batch.text, problems) if problems else None


def _ended(problem: Problem, spent: float) -> Row:
    timeout = problem.timeout_s
    if timeout is not None and spent >= timeout + GRACE * 0.9:
        message = f"the planner did not keep its timeout of {timeout:g} s and was ended"
        return Row.failed(problem, "timed_out", message, time_s=spent)
    return Row.failed(problem, "crashed", "the planner ended its process", time_s=spent)
