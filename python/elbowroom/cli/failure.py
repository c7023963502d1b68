"""Exit codes, and errors as one to three lines."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager

DONE, NO_PATH, BAD_INPUT, NOTHING_FOUND, UNSAFE = range(5)

INTERRUPTED = 130


@contextmanager
def reported() -> Iterator[None]:
    """Turn what elbowroom raises into a line on stderr and an exit code."""
    import typer

    from elbowroom.errors import ElbowroomError, InternalError, NoPath, NotFound, TimedOut

    try:
        yield
    except NoPath as error:
        tell(str(error))
        raise typer.Exit(NO_PATH) from None
    except (NotFound, TimedOut) as error:
        tell(str(error))
        raise typer.Exit(NOTHING_FOUND) from None
    except InternalError:
        raise
    except ElbowroomError as error:
        tell(str(error))
        raise typer.Exit(BAD_INPUT) from None
    except BrokenPipeError:
        # Whoever read our output has had enough; so that Python does not complain again at its end:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise typer.Exit(DONE) from None
    except OSError as error:
        tell(f"{error.filename or 'file'}: {error.strerror or error}")
        raise typer.Exit(BAD_INPUT) from None
    except KeyboardInterrupt:
        tell("interrupted")
        raise typer.Exit(INTERRUPTED) from None


def tell(message: str) -> None:
    """Say ``message`` on stderr."""
    print(f"error: {message}", file=sys.stderr)
