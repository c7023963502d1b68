"""Options of the command line that take a number or a folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import typer

from elbowroom._plain_numbers import number, whole


def number_option(*names: str, help: str) -> Any:  # noqa: A002 (typer's word)
    """Return an option that takes a plain number."""
    return typer.Option(*names, parser=_number, metavar="NUMBER", help=help)


def whole_option(*names: str, help: str, least: int | None = None) -> Any:  # noqa: A002 (typer's word)
    """Return an option that takes a whole number, from ``least`` on."""
    said = help if least is None else f"{help} [from {least} on]"
    return typer.Option(*names, parser=_whole_from(least), metavar="INTEGER", help=said)


def folder_option(*names: str, help: str) -> Any:  # noqa: A002 (typer's word)
    """Return an option that takes a folder to write into."""
    return typer.Option(*names, parser=_folder, metavar="FOLDER", help=help)


def _number(given: Any) -> float:
    # What an option is by default is a number already.
    if isinstance(given, float | int):
        return given
    try:
        return number(given)
    except ValueError:
        raise typer.BadParameter(f"'{given}' is not a number such as 2, 0.5 or 1e-3") from None


def _whole_from(least: int | None) -> Callable[[Any], int]:
    def read(given: Any) -> int:
        try:
            found = given if isinstance(given, int) else whole(given)
        except ValueError:
            raise typer.BadParameter(f"'{given}' is not a whole number") from None
        if least is not None and found < least:
            raise typer.BadParameter(f"{found} is less than {least}")
        return found

    return read


def _folder(given: Any) -> Path:
    # An empty path is the folder one is in, which is what a variable that is not set comes to.
    if not str(given).strip():
        raise typer.BadParameter("the name of the folder is empty; for the one you are in, write .")
    # An output folder is made if need be, but not where a file is.
    if Path(given).is_file():
        raise typer.BadParameter(f"{given} is a file; a folder is needed")
    return Path(given)
