"""The command ``elbowroom paper``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elbowroom._cli.failure import reported
from elbowroom._cli.options import folder_option, whole_option


def paper_command(
    out: Annotated[Path, folder_option(help="Folder for the pictures and report.md.")] = Path("out/paper"),
    seed: Annotated[int, whole_option(help="Random seed of the runs in the pictures.")] = 0,
    seeds: Annotated[int, whole_option(least=1, help="Number of seeds for the statistics.")] = 100,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Reproduce the paper's experiments: its figures 4 to 19, and its printed numbers beside ours."""
    with reported():
        import json

        from elbowroom._cli.progress import progress
        from elbowroom._paper import reproduce

        with progress() as show:
            report = reproduce(out, seed=seed, seeds=seeds, show=show)
        if as_json:
            typer.echo(json.dumps({"report": str(report), "pictures": str(out)}))
        else:
            typer.echo(f"wrote {report}; the pictures are in the folders beside it")
