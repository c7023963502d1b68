"""The command ``elbowroom check``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from elbowroom._cli.failure import UNSAFE, reported
from elbowroom._cli.options import number_option, whole_option
from elbowroom._numbered import counted

if TYPE_CHECKING:
    from elbowroom._check import JudgedMessage


def check_command(
    scene: Annotated[Path, typer.Argument(help="Scene file (YAML).")],
    file: Annotated[
        Path, typer.Argument(help="Trajectory: CSV as plan writes it, or a ROS 2 JointTrajectory as JSON or YAML.")
    ],
    joints: Annotated[
        str | None,
        typer.Option(help="Names of the arm's joints in the file, base first: FIRST,SECOND,...; others are left out."),
    ] = None,
    start: Annotated[
        str | None,
        typer.Option(
            "--from",
            help="Where the arm stands at 0 s, if the first row is later: Q1,Q2,... in the scene's unit of angles.",
        ),
    ] = None,
    open_end: Annotated[
        bool,
        typer.Option("--open-end", help="A part of a longer motion: it may begin and end while joints move."),
    ] = False,
    message: Annotated[
        int | None, whole_option(help="Judge this message alone, from 1; default: all of the file.")
    ] = None,
    margin: Annotated[str, typer.Option(help="Clearance to keep, in the unit of the scene or as 5mm.")] = "0",
    limit_tolerance: Annotated[
        float,
        number_option(
            "--limit-tolerance",
            help="Share by which motion limits may be exceeded, such as 0.01, besides what rounding explains.",
        ),
    ] = 0.0,
    timeout: Annotated[float | None, number_option(help="Give up after so many seconds.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Verify a trajectory, from rest to rest: exit code 0 only if it is proved to be safe, otherwise 4.

    Rates that the rows do not tell, for their rounding or spacing, are named as not judged, as those without limits.
    """
    with reported():
        import json

        from elbowroom._check import check_messages
        from elbowroom._cli.length import metres
        from elbowroom._cli.plan_text import verdict_lines
        from elbowroom._cli.start import start_of
        from elbowroom._scene import Scene

        names = joints.split(",") if joints is not None else None
        loaded = Scene.load(scene)
        answers = check_messages(
            loaded,
            file,
            message=message,
            joints=names,
            start=None if start is None else start_of(start, loaded),
            open_end=open_end,
            margin=metres(margin, loaded.units, setting="margin"),
            limit_tolerance=limit_tolerance,
            timeout=timeout,
        )
        safe = all(answer.safe for answer in answers)
        if as_json:
            told = [_document(answer) for answer in answers]
            whole = told[0] if len(told) == 1 else {"safe": safe, "messages": told}
            typer.echo(json.dumps(whole, allow_nan=False))
        else:
            for answer in answers:
                typer.echo(_title(file, answer))
                typer.echo("\n".join(verdict_lines(answer.check.verdict, loaded, open_end=open_end)))
                for note in answer.notes:
                    typer.echo(f"  {note}")
            if len(answers) > 1:
                typer.echo("how the arm gets from one message to the next was not judged")
        if not safe:
            raise typer.Exit(UNSAFE)


def _title(file: Path, answer: JudgedMessage) -> str:
    motion = answer.check.motion
    which = f", message {answer.number} of {answer.count}" if answer.count > 1 else ""
    pieces = counted(len(motion.starts), f"{answer.check.curve} piece")
    return f"{file}{which}: {pieces}, {motion.duration:.3f} s"


def _document(answer: JudgedMessage) -> dict[str, Any]:
    told: dict[str, Any] = {"curve": answer.check.curve, **answer.check.verdict.as_dict(), "notes": list(answer.notes)}
    return told if answer.count == 1 else {"message": answer.number, **told}
