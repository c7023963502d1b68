"""Runs batches on a Ray cluster, or on a local Ray if none is named."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from typing import Any

from elbowroom.compare._row import Row
from elbowroom.compare._worker import ONE_THREAD, Batch, Begun, Progress, answers


def ray_is_there() -> bool:
    """Return whether ``run_on_ray`` can be called."""
    try:
        return find_spec("ray") is not None
    except ValueError:
        return False


def run_on_ray(batches: Sequence[Batch], *, jobs: int | None) -> Iterator[Row]:
    """Yield the rows of ``batches`` as they are finished, one core a batch and up to ``jobs`` batches at a time.

    The cluster is the one that Ray is connected to already, else that of ``RAY_ADDRESS``, else a local one.
    """
    import ray
    from ray.exceptions import RayError

    ours = not ray.is_initialized()
    if ours:
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
        # Ray's next default, chosen now so that it does not warn of the change.
        os.environ.setdefault("RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO", "0")
        local = {"include_dashboard": False} if "RAY_ADDRESS" not in os.environ else {}
        ray.init(log_to_driver=False, logging_level="ERROR", **local)
    remote = ray.remote(num_cpus=1, max_retries=0, num_returns="streaming")(_in_worker)
    waiting = deque(batches)
    under_way: dict[Any, Progress] = {}
    try:
        while waiting or under_way:
            while waiting and (jobs is None or len(under_way) < jobs):
                batch = waiting.popleft()
                under_way[remote.remote(batch)] = Progress(batch)
            ready, _ = ray.wait(list(under_way), num_returns=1)
            stream = ready[0]
            progress = under_way[stream]
            try:
                message = ray.get(next(stream))
            except StopIteration:
                del under_way[stream]
                continue
            except RayError:
                del under_way[stream]
                row, rest = progress.lost()
                if row is None:
                    raise
                yield row
                if rest is not None:
                    waiting.appendleft(rest)
                continue
            finished = progress.heard(message)
            if finished is not None:
                yield finished
    finally:
        for stream in under_way:
            ray.cancel(stream, force=True)
        if ours:
            ray.shutdown()


def _in_worker(batch: Batch) -> Iterator[Begun | Row]:
    os.environ.update(ONE_THREAD)
    yield from answers(batch)
