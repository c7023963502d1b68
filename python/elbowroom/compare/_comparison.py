"""Runs every planner on every task of every scene, for every seed."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import Literal, get_args

from elbowroom._errors import BadSetting
from elbowroom._objectives import LISTED, OBJECTIVES, Objective
from elbowroom._plugins import PlannerPlugin
from elbowroom._scene import Scene, text_of
from elbowroom._whole import check_whole, is_whole
from elbowroom.compare._local import cores, run_locally
from elbowroom.compare._on_ray import ray_is_there, run_on_ray
from elbowroom.compare._row import Problem, Row
from elbowroom.compare._table import Table, in_order, parquet_is_there, write_parquet
from elbowroom.compare._worker import Batch
from elbowroom.planners import Choice
from elbowroom.planners import given as choice_of

Place = Literal["local", "ray"]

BATCHES_A_JOB = 8
"""A job gets its runs in at least so many batches, so that none ends long after the others."""

LARGEST_BATCH = 64


@dataclass(frozen=True)
class Comparison:
    """What was asked and what came of it.

    Attributes:
        rows: Of all runs that were asked for, in order.
        fresh: How many of them were run now; the others were in the table.
        beside: How many rows of other runs the table holds.
        healed: Whether a half-written last line was cut off.
        table: The rows as JSON Lines.
        parquet: The same as Parquet; None without pyarrow.
    """

    rows: list[Row]
    fresh: int
    beside: int
    healed: bool
    table: Path
    parquet: Path | None


def compare(
    scenes: Sequence[Path],
    *,
    planners: Sequence[Choice | PlannerPlugin],
    out: Path,
    tasks: Collection[str] | None = None,
    seeds: Sequence[int] = range(30),
    budget: int | None = None,
    timeout: float | None = None,
    objective: Objective = "tip",
    jobs: int | None = None,
    on: Place = "local",
    show: Callable[[int, int], None] = lambda _done, _all: None,
) -> Comparison:
    """Return the rows of all ``planners`` on the tasks of ``scenes`` for all ``seeds``.

    The rows are kept in ``out``: those that are there are not run again, so a comparison that was stopped goes on.

    Args:
        scenes: Files.
        planners: As ``elbowroom.planners.all_chosen`` gives them, and callables like
            ``elbowroom.planners.PlannerPlugin``: functions at the top level of a module or script, which the processes
            that run them can find.
        out: Folder of ``rows.jsonl``, made if need be.
        tasks: Names of the tasks to do in each scene; None for all that it has.
        seeds: Of the planners.
        budget: Evaluations a run, for planners that take a number.
        timeout: When a run shall give up (s).
        objective: Quantity to minimise: ``tip`` travel, ``joint`` travel or ``time``.
        jobs: Runs at a time; None for all cores of this machine or of the cluster.
        on: ``local``, or ``ray``.
        show: Called with the number of rows done and of all, at the start and after each.

    Raises:
        BadSetting: A setting makes no sense.
        SceneError: A file cannot be read, or is no scene.
        DamagedTable: The folder holds a table with a line that is no row.
    """
    choices = [planner if isinstance(planner, Choice) else choice_of(planner) for planner in planners]
    _check(
        scenes,
        planners=choices,
        tasks=tasks,
        seeds=seeds,
        budget=budget,
        timeout=timeout,
        objective=objective,
        jobs=jobs,
        on=on,
    )
    asked = list(_asked(scenes, choices, tasks, seeds, budget=budget, timeout=timeout, objective=objective))
    problems = [problem for batch in asked for problem in batch.problems]
    table = Table(out / "rows.jsonl")
    workers = jobs or cores()
    open_batches = list(_split(_missing(asked, table), workers))
    left = sum(len(batch.problems) for batch in open_batches)
    show(len(problems) - left, len(problems))
    try:
        rows = run_on_ray(open_batches, jobs=jobs) if on == "ray" else run_locally(open_batches, jobs=workers)
        for done, row in enumerate(rows, len(problems) - left + 1):
            table.add(row)
            show(done, len(problems))
    except BaseException:
        table.abandon()
        raise
    table.close()
    every = in_order(table.rows.values())
    return Comparison(
        rows=in_order(table.rows[problem.key] for problem in problems),
        fresh=left,
        beside=len(every) - len(problems),
        healed=table.healed,
        table=table.path,
        parquet=write_parquet(every, out / "rows.parquet") if parquet_is_there() else None,
    )


def _check(
    scenes: Sequence[Path],
    *,
    planners: Sequence[Choice],
    tasks: Collection[str] | None,
    seeds: Sequence[int],
    budget: int | None,
    timeout: float | None,
    objective: str,
    jobs: int | None,
    on: str,
) -> None:
    def refuse(message: str, setting: str) -> None:
        raise BadSetting(message, setting=setting)

    for name, given in (("scenes", scenes), ("planners", planners), ("tasks", tasks), ("seeds", seeds)):
        if given is not None and not len(given):
            refuse(f"no {name} to compare", name)
    if len(set(seeds)) != len(seeds) or not all(map(is_whole, seeds)):
        refuse("seeds are different whole numbers from 0 on", "seeds")
    if objective not in OBJECTIVES:
        refuse(f"no objective is called '{objective}'; {LISTED}", "objective")
    if on not in get_args(Place):
        refuse(f"nothing to run on is called '{on}'; local or ray", "on")
    if on == "ray" and not ray_is_there():
        refuse("--on ray needs the extra: pip install 'elbowroom[ray]'", "on")
    for name, number in (("budget", budget), ("jobs", jobs)):
        if number is not None:
            check_whole(name, number, least=1)
    if timeout is not None and not 0.0 <= timeout < math.inf:
        refuse(f"timeout is {timeout} s, it must be finite and not negative", "timeout")


def _asked(
    scenes: Sequence[Path],
    planners: Sequence[Choice],
    tasks: Collection[str] | None,
    seeds: Sequence[int],
    *,
    budget: int | None,
    timeout: float | None,
    objective: Objective,
) -> Iterator[Batch]:
    """All runs, those on a scene together."""
    seen: dict[str, str] = {}
    for path in scenes:
        text = text_of(path)
        scene = Scene.parse(text, file=str(path))
        if not scene.tasks:
            raise BadSetting(f"{path}: the scene has no tasks to compare on", setting="scenes")
        for task in tasks or ():
            if task not in scene.tasks:
                raise BadSetting(f"{path} has no task '{task}', only {', '.join(scene.tasks)}", setting="tasks")
        problems = [
            Problem.of(
                choice,
                scene=scene,
                file=str(path),
                task=task,
                seed=seed,
                budget=budget,
                timeout=None if timeout is None else float(timeout),
                objective=objective,
            )
            for task in scene.tasks
            if tasks is None or task in tasks
            for seed in seeds
            for choice in planners
        ]
        digest = problems[0].scene_sha256
        if digest in seen:
            raise BadSetting(f"{seen[digest]} and {path} are the same scene", setting="scenes")
        seen[digest] = str(path)
        yield Batch(str(path), text, problems)


def _missing(batches: Sequence[Batch], table: Table) -> Iterator[Batch]:
    for batch in batches:
        problems = [problem for problem in batch.problems if problem.key not in table.rows]
        if problems:
            yield Batch(batch.file, batch.text, problems)


def _split(batches: Iterator[Batch], jobs: int) -> Iterator[Batch]:
    """Batches of a size that keeps all jobs busy to the end, and the scene's text from being sent for every run."""
    together = list(batches)
    total = sum(len(batch.problems) for batch in together)
    size = max(1, min(LARGEST_BATCH, total // (jobs * BATCHES_A_JOB)))
    for batch in together:
        for _, part in groupby(enumerate(batch.problems), key=lambda numbered: numbered[0] // size):
            yield Batch(batch.file, batch.text, [problem for _, problem in part])
