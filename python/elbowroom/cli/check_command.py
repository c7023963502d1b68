"""The command ``elbowroom check``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elbowroom.cli.failure import UNSAFE, reported


def check_command(
    scene: Annotated[Path, typer.Argument(help="Scene file (YAML).")],
    file: Annotated[
        Path, typer.Argument(help="Trajectory: CSV as plan writes it, or a ROS 2 JointTrajectory as JSON or YAML.")
    ],
    joints: Annotated[
        str | None, typer.Option(help="Names of the joints in the file, base first: FIRST,SECOND,...")
    ] = None,
    margin: Annotated[str, typer.Option(help="Clearance to keep, in the unit of the scene or as 5mm.")] = "0",
    timeout: Annotated[float | None, typer.Option(help="Give up after so many seconds.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Verify a trajectory: exit code 0 only if it is proved to be safe, otherwise 4."""
    with reported():
        import json

        from elbowroom.check import check_file
        from elbowroom.cli.length import metres
        from elbowroom.cli.plan_text import verdict_lines
        from elbowroom.errors import BadSetting
        from elbowroom.scene import Scene

        names = joints.split(",") if joints is not None else None
        loaded = Scene.load(scene)
        number = len(loaded.arm.joints)
        if names is not None and len(names) != number:
            raise BadSetting(f"--joints names {len(names)}; the arm of {scene} has {number} joints", setting="joints")
        keep = metres(margin, loaded.units, setting="margin")
        result = check_file(loaded, file, joints=names, margin=keep, timeout=timeout)
        if as_json:
            typer.echo(json.dumps({"curve": result.curve, **result.verdict.as_dict()}, allow_nan=False))
        else:
            pieces = len(result.motion.starts)
            typer.echo(f"{file}: {pieces} {result.curve} pieces, {result.motion.duration:.3f} s")
            typer.echo("\n".join(verdict_lines(result.verdict, loaded.units)))
        if not result.safe:
            raise typer.Exit(UNSAFE)
