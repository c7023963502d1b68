"""The command ``elbowroom follow``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from elbowroom._cli.failure import NOTHING_FOUND, UNSAFE, reported
from elbowroom._cli.options import folder_option, number_option, whole_option

if TYPE_CHECKING:
    from elbowroom.follow import Followed


def follow_command(
    scene: Annotated[Path, typer.Argument(help="Scene file (YAML); its obstacles may move.")],
    task: Annotated[str | None, typer.Option(help="Task of the scene; may be omitted if it has only one.")] = None,
    rate: Annotated[float, number_option(help="Replanning rate (Hz); its period must be whole milliseconds.")] = 50.0,
    horizon: Annotated[float, number_option(help="Simulated time limit (s).")] = 60.0,
    seed: Annotated[int, whole_option(help="Random seed.")] = 0,
    deadline: Annotated[
        float | None,
        number_option(help="Time budget per replanning step (s); makes results timing-dependent."),
    ] = None,
    timeout: Annotated[float | None, number_option(help="Give up after so many seconds of real time.")] = None,
    out: Annotated[
        Path | None, folder_option(help="Folder for follow.json, decisions.jsonl, trajectory.csv and the pictures.")
    ] = None,
    animate: Annotated[bool, typer.Option("--animate", help="With --out: also write an animation (GIF).")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.")] = False,
) -> None:
    """Simulate online replanning among moving obstacles: exit code 0 if the arm reached the goal without contact.

    3 if it did not reach the goal in time, 4 if the verifier does not prove that the executed motion was safe.
    """
    with reported():
        import json

        from elbowroom._cli.follow_text import in_words
        from elbowroom._cli.progress import progress
        from elbowroom._errors import BadSetting
        from elbowroom._scene import Scene
        from elbowroom.follow import follow
        from elbowroom.follow._files import summary, write_followed

        if animate and out is None:
            raise BadSetting("--animate needs --out, a folder to write to", setting="animate")
        loaded = Scene.load(scene)
        with progress() as show:
            followed = follow(
                loaded,
                task=task,
                rate=rate,
                horizon=horizon,
                seed=seed,
                deadline=deadline,
                timeout=timeout,
                on_step=lambda now: show(f"following: {now:.1f} s"),
            )
            written: list[Path] = []
            if out is not None:
                from elbowroom.follow._animation import animate as write_animation
                from elbowroom.follow._pictures import draw

                show("drawing")
                written = [*write_followed(followed, out), *draw(followed, out)]
                if animate:
                    written.append(write_animation(followed, out / "follow.gif"))
        if as_json:
            typer.echo(json.dumps(summary(followed), allow_nan=False))
        else:
            typer.echo(in_words(followed))
            for path in written:
                typer.echo(f"wrote {path}")
        code = _code(followed)
        if code:
            raise typer.Exit(code)


def _code(followed: Followed) -> int:
    return {"reached": 0, "not reached": NOTHING_FOUND, "not safe": UNSAFE}[followed.outcome]
