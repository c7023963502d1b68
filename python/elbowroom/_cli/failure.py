"""Exit codes, and errors as one to three lines."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

DONE, NO_PATH, BAD_INPUT, NOTHING_FOUND, UNSAFE = range(5)

FAULT = 70
"""A fault of elbowroom itself: as sysexits.h has it."""

INTERRUPTED = 130


@contextmanager
def reported() -> Iterator[None]:
    """Turn whatever is raised into a line on stderr, or two, and an exit code."""
    import typer

    try:
        yield
    except BaseException as error:
        code = told(error)
        if code is None:
            raise
        raise typer.Exit(code) from None


def told(error: BaseException) -> int | None:
    """Say on stderr what ``error`` is about and return the exit code; None for what is not one of ours to tell."""
    from elbowroom._errors import ElbowroomError, InternalError, NoPath, NotFound, TimedOut

    match error:
        case KeyboardInterrupt():
            tell("interrupted")
            return INTERRUPTED
        case NoPath():
            tell(str(error))
            return NO_PATH
        case NotFound() | TimedOut():
            tell(str(error))
            return NOTHING_FOUND
        case InternalError():
            return _fault(str(error))
        case ElbowroomError():
            tell(str(error))
            return BAD_INPUT
        case OSError():
            return _of_files(error)
    if _is_of_typer(error):
        return None
    return _fault(f"{type(error).__name__}: {error}{_place(error)}")


def tell(message: str) -> None:
    """Say ``message`` on stderr."""
    print(f"error: {message}", file=sys.stderr)


def _of_files(error: OSError) -> int:
    if isinstance(error, BrokenPipeError) or error.filename is None:
        # Whoever reads our output has had enough, or has no room left: Python is not to complain again at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if isinstance(error, BrokenPipeError) or error.errno == errno.EPIPE:
        return DONE
    tell(f"{error.filename or 'output'}: {error.strerror or error}")
    return BAD_INPUT


def _is_of_typer(error: BaseException) -> bool:
    """Whether it is an exit that has its code, or a complaint about the words of the command line."""
    import typer

    return isinstance(error, SystemExit | GeneratorExit | typer.Exit | typer.Abort) or hasattr(error, "exit_code")


def _fault(what: str) -> int:
    import platform

    from elbowroom._core import __version__

    tell(f"a fault of elbowroom itself, not of what it was given: {' '.join(what.split())}")
    system = f"Python {platform.python_version()}, {platform.system()} {platform.machine()}"
    print(
        f"please report it: this message, the command, the files it was given; elbowroom {__version__}, {system}",
        file=sys.stderr,
    )
    return FAULT


def _place(error: BaseException) -> str:
    """Where it was raised: of the calls in elbowroom's own files the last."""
    own = os.path.dirname(os.path.dirname(__file__))
    found, trace = "", error.__traceback__
    while trace is not None:
        file = trace.tb_frame.f_code.co_filename
        if file.startswith(own):
            found = f" ({os.path.relpath(file, own)}:{trace.tb_lineno})"
        trace = trace.tb_next
    return found
