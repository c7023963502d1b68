"""The command ``elbowroom plan``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elbowroom.cli.failure import reported


def plan_command(
    scene: Annotated[Path, typer.Argument(help="Scene file (YAML).")],
    task: Annotated[str | None, typer.Option(help="Which task of the scene; may be left out if it has one.")] = None,
    planner: Annotated[str, typer.Option(help="dstar-pso or dstar.")] = "dstar-pso",
    seed: Annotated[int, typer.Option(help="Seed of the swarm and of the via points.")] = 0,
    timeout: Annotated[float | None, typer.Option(help="Give up after so many seconds.")] = None,
    duration: Annotated[float, typer.Option(help="How long the motion takes (s).")] = 10.0,
    out: Annotated[Path | None, typer.Option(help="Folder for plan.json, trajectory.csv and the pictures.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Plan a motion for a task."""
    with reported():
        import json

        from elbowroom.cli.plan_pictures import draw
        from elbowroom.cli.progress import progress
        from elbowroom.plan import plan_as_in_paper
        from elbowroom.plan_files import as_json as document
        from elbowroom.plan_files import write_plan
        from elbowroom.scene import Scene

        loaded = Scene.load(scene)
        with progress() as show:
            plan = plan_as_in_paper(
                loaded,
                task=task,
                planner=planner,  # type: ignore[arg-type]
                seed=seed,
                timeout=timeout,
                duration=duration,
                on_stage=show,
            )
            written: list[Path] = []
            if out is not None:
                show("drawing")
                written = [*write_plan(plan, out), *draw(plan, out)]
        if as_json:
            typer.echo(json.dumps(document(plan), allow_nan=False))
            return
        spent = sum(plan.timings.values())
        typer.echo(f"{plan.planner}: path of {plan.cost:.6f} m for task '{plan.task}', found in {spent * 1e3:.1f} ms")
        typer.echo(
            f"motion of {plan.motion.duration:g} s through {len(plan.vias)} via points: NOT VERIFIED, do not run it"
        )
        if plan.jumps:
            typer.echo(f"{len(plan.jumps)} of its steps jump between postures or across a stop: no arm can follow")
        for path in written:
            typer.echo(f"wrote {path}")
