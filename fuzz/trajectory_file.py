"""Whatever a trajectory file holds, it is read or refused; needs atheris."""

import contextlib
import sys
import tempfile
from pathlib import Path

import atheris

with atheris.instrument_imports():
    from elbowroom.errors import TrajectoryError
    from elbowroom.trajectory_files import read_trajectory

FOLDER = Path(tempfile.mkdtemp())


def one(data: bytes) -> None:
    """Read the bytes as each kind of file."""
    for kind in ("csv", "json", "yaml"):
        path = FOLDER / f"t.{kind}"
        path.write_bytes(data)
        with contextlib.suppress(TrajectoryError):
            read_trajectory(path, joints=2)


atheris.Setup(sys.argv, one)
atheris.Fuzz()
