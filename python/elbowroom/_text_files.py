"""Text of files that anybody may hand in."""

from __future__ import annotations

from pathlib import Path


class Unreadable(Exception):
    """Why a file gives no text; the message leaves out its name."""


def read_text(path: Path, *, mebibytes: int, kind: str) -> str:
    """Return the text of the file at ``path``, which is UTF-8 and no larger than so many MiB.

    Raises:
        Unreadable: It cannot be read, is larger than a file of its ``kind`` may be, or is no UTF-8.
    """
    most = mebibytes << 20
    try:
        # Not by its size: what is no file in a folder, such as a pipe, has none.
        with path.open("rb") as file:
            content = file.read(most + 1)
    except OSError as error:
        raise Unreadable(f"cannot be read: {error.strerror or error}") from None
    # A path that has a NUL in it.
    except ValueError as error:
        raise Unreadable(f"cannot be read: {error}") from None
    if len(content) > most:
        raise Unreadable(f"more than {mebibytes} MiB, which is the most a {kind} file may have")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Unreadable(f"byte {error.start} is not UTF-8") from None
