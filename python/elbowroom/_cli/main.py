"""The program ``elbowroom``."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Annotated

import typer

from elbowroom._cli.check_command import check_command
from elbowroom._cli.compare_command import compare_command
from elbowroom._cli.failure import BAD_INPUT, told
from elbowroom._cli.follow_command import follow_command
from elbowroom._cli.generate_command import generate_command
from elbowroom._cli.map_command import map_command
from elbowroom._cli.paper_command import paper_command
from elbowroom._cli.plan_command import plan_command

app = typer.Typer(
    name="elbowroom",
    help="Plan motions for planar robot arms.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
    epilog="Exit codes: 0 done, 1 proved that there is no path, 2 bad input, 3 nothing found in time, 4 not safe, "
    "70 a fault of elbowroom itself.",
)
app.command("plan")(plan_command)
app.command("check")(check_command)
app.command("map")(map_command)
app.command("follow")(follow_command)
app.command("paper")(paper_command)
app.command("compare")(compare_command)
app.command("generate")(generate_command)


def _version(asked: bool) -> None:
    if asked:
        from importlib.metadata import version

        typer.echo(f"elbowroom {version('elbowroom')}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass


def main() -> None:
    """Run the program."""
    try:
        # Typer would end with 1 on Ctrl-C, which here says that there is no path.
        code = app(standalone_mode=False)
    except BaseException as error:
        if isinstance(error, SystemExit):
            raise
        code = _exit_code(error)
    sys.exit(code)


def _exit_code(error: BaseException) -> int:
    if isinstance(error, typer.Abort):
        error = KeyboardInterrupt()
    if (code := told(error)) is not None:
        return code
    # A complaint about the words of the command line.
    show: Callable[[], None] = getattr(error, "show", lambda: None)
    show()
    return int(getattr(error, "exit_code", BAD_INPUT))
