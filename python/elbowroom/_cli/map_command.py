"""The command ``elbowroom map``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from elbowroom._cli.failure import reported
from elbowroom._cli.options import folder_option


def map_command(
    scene: Annotated[Path, typer.Argument(help="Scene file (YAML).")],
    out: Annotated[Path | None, folder_option(help="Folder for the pictures of the maps.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Map the reachable, collision-free tip positions per posture, and why the others are not."""
    with reported():
        import json

        from elbowroom._cli.progress import progress
        from elbowroom._errors import BadSetting
        from elbowroom._free_space import free_space
        from elbowroom._scene import Scene

        loaded = Scene.load(scene)
        links = len(loaded.arm.links)
        if links != 2:
            raise BadSetting(
                f"{scene}: maps are per posture, which only arms of 2 links have; this one has {links}: "
                "plan, check and compare take it",
                setting="arm",
            )
        with progress() as show:
            show("free_space")
            space = free_space(loaded)
            written: list[Path] = []
            if out is not None:
                from elbowroom import figures

                show("drawing")
                for posture in ("elbow-up", "elbow-down"):
                    figure = figures.posture_map(loaded, space, posture=posture)
                    written.append(figures.save(figure, out / f"free_space_{posture.replace('-', '_')}.png"))
                written.append(figures.save(figures.union_map(loaded, space), out / "free_space_union.png"))
        from elbowroom._cli.map_table import as_table, summary

        report = summary(space)
        if as_json:
            typer.echo(json.dumps({"scene": str(scene), **report, "written": [str(path) for path in written]}))
            return
        typer.echo(as_table(report))
        for path in written:
            typer.echo(f"wrote {path}")
