"""The command ``elbowroom plan``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from elbowroom._cli.failure import reported
from elbowroom._cli.options import folder_option, number_option, whole_option
from elbowroom._objectives import LISTED
from elbowroom._own_planners import OWN

if TYPE_CHECKING:
    from elbowroom._core import Plan
    from elbowroom._scene import Scene


def plan_command(
    scene: Annotated[Path, typer.Argument(help="Scene file (YAML).")],
    task: Annotated[str | None, typer.Option(help="Task of the scene; may be omitted if it has only one.")] = None,
    planner: Annotated[
        str | None,
        typer.Option(
            help=f"{', '.join(OWN)}, or a plug-in; options as NAME:OPTION=VALUE:OPTION=VALUE. "
            "Default: dstar-pso for two links, guided-rrt-connect for more."
        ),
    ] = None,
    objective: Annotated[str, typer.Option(help=f"Quantity to minimise: {LISTED}.")] = "tip",
    seed: Annotated[int, whole_option(help="Random seed.")] = 0,
    timeout: Annotated[float | None, number_option(help="Give up after so many seconds.")] = None,
    duration: Annotated[str, typer.Option(help="Duration of the motion (s), or fastest.")] = "fastest",
    gap: Annotated[
        float | None,
        number_option(help="With optimal: refine until the proven optimality gap is below this (0.01: 1 %)."),
    ] = None,
    slack: Annotated[
        float | None,
        number_option(
            help="With tip or joint: share by which a motion may be longer than the shortest to be faster (0.005)."
        ),
    ] = None,
    clearance: Annotated[
        str | None,
        typer.Option(help="Clearance to keep, in the unit of the scene or as 5mm. Default: that of the task."),
    ] = None,
    out: Annotated[Path | None, folder_option(help="Folder for plan.json, trajectory.csv and the pictures.")] = None,
    animate: Annotated[bool, typer.Option("--animate", help="With --out: also write an animation (GIF).")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Plan a motion that is proved to be safe."""
    with reported():
        import json

        from elbowroom._cli.length import metres
        from elbowroom._cli.plan_text import in_words
        from elbowroom._cli.progress import progress
        from elbowroom._errors import BadSetting
        from elbowroom._plan import plan as make_plan
        from elbowroom._plan_files import as_json as document
        from elbowroom._plan_files import check_length, write_plan
        from elbowroom._scene import Scene
        from elbowroom.planners import chosen

        seconds = _seconds(duration)
        choice = None if planner is None else chosen(planner)
        if animate and out is None:
            raise BadSetting("--animate needs --out, a folder to write to", setting="animate")
        if out is not None and seconds is not None:
            check_length(seconds)
        loaded = Scene.load(scene)
        room = None if clearance is None else metres(clearance, loaded.units, setting="clearance")
        with progress() as show:
            plan = _planned(
                lambda: make_plan(
                    loaded,
                    task=task,
                    planner=None if choice is None else choice.name,
                    options=None if choice is None else choice.given,
                    objective=objective,  # type: ignore[arg-type]
                    seed=seed,
                    timeout=timeout,
                    duration=seconds,
                    gap=gap,
                    slack=slack,
                    clearance=room,
                    on_stage=show,
                ),
                loaded,
                out,
            )
            written: list[Path] = []
            left_out: str | None = None
            if out is not None:
                from elbowroom._cli.plan_pictures import draw, not_drawn

                show("drawing")
                written = [*write_plan(plan, out), *draw(plan, out, animate=animate)]
                left_out = not_drawn(plan)
        if as_json:
            typer.echo(json.dumps(document(plan), allow_nan=False))
            return
        typer.echo(in_words(plan))
        for path in written:
            typer.echo(f"wrote {path}")
        if left_out is not None:
            typer.echo(left_out)


def _planned(make: Callable[[], Plan], scene: Scene, out: Path | None) -> Plan:
    """What ``make`` returns; where it proves that there is no path the proof is drawn into ``out``."""
    from dataclasses import replace

    from elbowroom._errors import NoPath
    from elbowroom._walls import walls_in_words

    try:
        return make()
    except NoPath as proof:
        if out is not None:
            from elbowroom import figures

            typer.echo(f"wrote {figures.save(figures.no_path(scene, proof), out / 'no_path.png')}", err=True)
        if walls := walls_in_words(scene, proof):
            raise replace(proof, message=f"{proof.message}\naround all that the start can reach: {walls}") from None
        raise


def _seconds(duration: str) -> float | None:
    from elbowroom._errors import BadSetting
    from elbowroom._plain_numbers import number

    if duration == "fastest":
        return None
    try:
        return number(duration)
    except ValueError:
        raise BadSetting(f"duration is '{duration}'; a number of seconds, or fastest", setting="duration") from None
