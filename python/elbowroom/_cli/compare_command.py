"""The command ``elbowroom compare``."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from elbowroom._cli.failure import reported
from elbowroom._cli.options import folder_option, number_option, whole_option
from elbowroom._objectives import LISTED
from elbowroom._own_planners import OWN


def compare_command(
    scenes: Annotated[list[Path], typer.Argument(help="Scene files (YAML).")],
    planners: Annotated[
        str | None,
        typer.Option(
            help="Comma-separated names, options as NAME:OPTION=VALUE:OPTION=VALUE; default: those of "
            f"elbowroom's own that serve an arm of the scenes: {', '.join(OWN)}."
        ),
    ] = None,
    tasks: Annotated[
        str | None, typer.Option(help="Comma-separated names, which every scene must have; default: all.")
    ] = None,
    seeds: Annotated[int, whole_option(least=1, help="Seeds 0 to N-1 for every planner and task.")] = 30,
    budget: Annotated[
        int | None, whole_option(least=1, help="Evaluations per run, for planners that count them; default: their own.")
    ] = None,
    timeout: Annotated[float | None, number_option(help="Timeout of a run (s).")] = None,
    objective: Annotated[str, typer.Option(help=f"Quantity to minimise: {LISTED}.")] = "tip",
    out: Annotated[
        Path, folder_option(help="Folder for the rows, report.md and the pictures; existing rows are not run again.")
    ] = Path("out/compare"),
    jobs: Annotated[int | None, whole_option(least=1, help="Parallel runs; default: all cores.")] = None,
    on: Annotated[str, typer.Option(help="local, or ray for a Ray cluster.")] = "local",
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Compare planners: every planner, task and seed, each motion checked by the verifier.

    If interrupted, the same command resumes.
    """
    with reported():
        import json

        from elbowroom.compare import compare
        from elbowroom.compare._report import write_report
        from elbowroom.planners import all_chosen

        choices = all_chosen(_serving(scenes) if planners is None else planners)
        with _goes_on(out), _progress() as (count, say):
            done = compare(
                scenes,
                planners=choices,
                out=out,
                tasks=None if tasks is None else tasks.split(","),
                seeds=range(seeds),
                budget=budget,
                timeout=timeout,
                objective=objective,  # type: ignore[arg-type]
                jobs=jobs,
                on=on,  # type: ignore[arg-type]
                show=count,
            )
            labels = [choice.label for choice in choices]
            asked = {
                "--tasks": tasks,
                "--seeds": seeds,
                "--budget": budget,
                "--timeout": timeout,
                "--objective": objective,
            }
            command = _command(scenes, {"--planners": ",".join(labels), **asked})
            say("drawing")
            report, *_ = write_report(done.rows, out, planners=labels, command=command, show=say)
        successes = sum(row.success for row in done.rows)
        apart = sum(not row.applicable for row in done.rows)
        if as_json:
            found = {
                "runs": len(done.rows),
                "run_now": done.fresh,
                "success": successes,
                "not_applicable": apart,
                "rows": str(done.table),
                "parquet": None if done.parquet is None else str(done.parquet),
                "report": str(report),
            }
            typer.echo(json.dumps(found))
            return
        if done.healed:
            typer.echo(f"{done.table}: a half-written last line was cut off and its run made again")
        kept = len(done.rows) - done.fresh
        typer.echo(
            f"{len(done.rows)} runs, {successes} with success"
            + (f", {apart} not applicable: the planner does not serve the arm, task or setting" if apart else "")
            + (f"; {kept} were there already" if kept else "")
        )
        if done.beside:
            typer.echo(f"{done.beside} rows of other runs are in the table and not in the report")
        typer.echo(f"wrote {done.table}" + ("" if done.parquet is None else f" and {done.parquet.name}"))
        typer.echo(f"wrote {report}; the pictures are in {report.parent / 'figures'}")


def _command(scenes: list[Path], options: dict[str, Any]) -> str:
    """What to type for the same rows."""
    files = [shlex.quote(str(path)) for path in scenes]
    folder = scenes[0].parent
    if len(scenes) > 1 and set(scenes) == set(folder.glob("*.yaml")):
        files = [f"{shlex.quote(str(folder))}/*.yaml"]
    words = [word for name, value in options.items() if value is not None for word in (name, str(value))]
    return " ".join(["elbowroom", "compare", *files, shlex.join(words)])


def _serving(scenes: list[Path]) -> str:
    """Those of elbowroom's own planners that serve the arm of any of ``scenes``."""
    from elbowroom._scene import Scene

    loaded = [Scene.load(path) for path in scenes]
    return ",".join(name for name, kind in OWN.items() if any(map(kind.serves, loaded)))


@contextmanager
def _goes_on(out: Path) -> Iterator[None]:
    """Say on Ctrl-C that nothing is lost."""
    try:
        yield
    except KeyboardInterrupt:
        print(f"the rows so far are in {out}; the same command resumes from there", file=sys.stderr)
        raise


@contextmanager
def _progress() -> Iterator[tuple[Callable[[int, int], None], Callable[[str], None]]]:
    """Give a function for the runs done and of all, and one for words; both silent unless stderr is a terminal."""
    if not sys.stderr.isatty():
        yield lambda _done, _all: None, lambda _words: None
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        runs = bar.add_task("runs", total=None)
        yield (
            lambda done, total: bar.update(runs, completed=done, total=total),
            lambda words: bar.update(runs, description=words),
        )
