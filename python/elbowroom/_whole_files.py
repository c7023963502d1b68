"""Files that are written whole or not at all: a full disk, a kill or Ctrl-C leaves the old one."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Give a path beside ``path`` to write to, which takes its place once all of it is on the disk.

    Raises:
        OSError: It cannot be written; what names no file names ``path``.
    """
    # The ending stays: it says to others what kind of file to write.
    fresh = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        yield fresh
        with fresh.open("rb+") as file:
            os.fsync(file.fileno())
        os.replace(fresh, path)
    except OSError as error:
        if error.filename in (None, str(fresh), fresh):
            raise OSError(error.errno, error.strerror or str(error), str(path)) from error
        raise
    finally:
        fresh.unlink(missing_ok=True)


def write_whole(path: Path, content: str | bytes) -> Path:
    """Write ``content`` to ``path``, text as UTF-8 with its line ends as they are, and return it.

    Raises:
        OSError: It cannot be written.
    """
    with written_whole(path) as fresh:
        fresh.write_bytes(content.encode() if isinstance(content, str) else content)
    return path
