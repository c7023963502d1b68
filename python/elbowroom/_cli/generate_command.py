"""The command ``elbowroom generate``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elbowroom._cli.failure import reported
from elbowroom._cli.options import folder_option, whole_option


def generate_command(
    out: Annotated[Path, folder_option(help="Folder for the scene files.")],
    count: Annotated[int, whole_option(least=1, help="Number of scenes.")] = 50,
    seed: Annotated[int, whole_option(least=0, help="Random seed.")] = 0,
    links: Annotated[int, whole_option(least=2, help="Number of links; arms of more than 2 avoid self-collision.")] = 2,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Generate random scenes around the paper's arm, or one of more links, to compare planners on."""
    with reported():
        import json

        from elbowroom.compare._generate import write_scenes

        written = write_scenes(count, out, seed=seed, links=links)
        if as_json:
            typer.echo(json.dumps({"written": [str(path) for path in written]}))
        else:
            names = written[0].name if count == 1 else f"{written[0].name} to {written[-1].name}"
            typer.echo(f"wrote {count} {'scene' if count == 1 else 'scenes'}, {names}, into {out}")
