"""Runs batches in processes of this machine."""

from __future__ import annotations

import os
import signal
import sys
import threading
from collections import deque
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from typing import Any

from elbowroom._errors import ElbowroomError
from elbowroom.compare._row import Row
from elbowroom.compare._worker import ONE_THREAD, Batch, Progress, answers

SPAWN = get_context("spawn")


class WorkerLost(ElbowroomError):
    """A worker ended before it began with anything."""


def cores() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def run_locally(batches: Sequence[Batch], *, jobs: int) -> Iterator[Row]:
    """Yield the rows of ``batches`` as they are finished, by up to ``jobs`` processes at a time.

    A planner that ends its process costs its own row; the others of its batch go to a new process.

    Raises:
        WorkerLost: A process ended before it began with anything.
    """
    waiting = deque(batches)
    workers: dict[Any, _Worker] = {}
    try:
        for _ in range(min(jobs, len(waiting))):
            _employ(workers, waiting.popleft())
        while workers:
            for pipe in wait(list(workers)):
                worker = workers[pipe]
                try:
                    message = worker.pipe.recv()
                except (EOFError, OSError):
                    del workers[pipe]
                    worker.end()
                    row, rest = worker.progress.lost()
                    if row is None:
                        raise WorkerLost(
                            "a worker process ended before it began; a script that calls compare() needs "
                            "if __name__ == '__main__'"
                        ) from None
                    yield row
                    if rest is not None:
                        waiting.appendleft(rest)
                    if waiting:
                        _employ(workers, waiting.popleft())
                    continue
                if message is not None:
                    finished = worker.progress.heard(message)
                    if finished is not None:
                        yield finished
                elif waiting:
                    worker.take(waiting.popleft())
                else:
                    del workers[pipe]
                    worker.end()
    finally:
        for worker in workers.values():
            worker.end()


def _employ(workers: dict[Any, _Worker], batch: Batch) -> None:
    worker = _Worker(batch)
    workers[worker.pipe] = worker


class _Worker:
    """A process that takes batches through a pipe and answers with messages, None after each batch."""

    def __init__(self, batch: Batch) -> None:
        self.pipe, other_end = SPAWN.Pipe()
        self._process = SPAWN.Process(target=serve, args=(other_end,))
        with _in_environment(ONE_THREAD), _deaf_to_ctrl_c():
            self._process.start()
        other_end.close()
        self.take(batch)

    def take(self, batch: Batch) -> None:
        self.progress = Progress(batch)
        self.pipe.send(batch)

    def end(self) -> None:
        self.pipe.close()
        self._process.terminate()
        self._process.join()


def serve(pipe: Connection) -> None:
    """Answer batches until the other end closes; runs in a process of its own."""
    # What planners print does not belong among our answers on stdout.
    os.dup2(sys.__stderr__.fileno() if sys.__stderr__ else 2, 1)
    try:
        while True:
            for message in answers(pipe.recv()):
                pipe.send(message)
            pipe.send(None)
    except (EOFError, OSError):
        return


@contextmanager
def _deaf_to_ctrl_c() -> Iterator[None]:
    """Children started within leave Ctrl-C to us, from their first moment on; only the main thread can see to that."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def _in_environment(variables: dict[str, str]) -> Iterator[None]:
    """Children started within have ``variables``: they count from their very first import on."""
    before = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
