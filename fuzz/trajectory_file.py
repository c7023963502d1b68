"""Whatever a trajectory file holds, it is read or refused; needs atheris."""

import contextlib
import sys
import tempfile
from pathlib import Path

import atheris

with atheris.instrument_imports():
    from elbowroom._errors import TrajectoryError
    from elbowroom._trajectory_files import read_messages

FOLDER = Path(tempfile.mkdtemp())


def one(data: bytes) -> None:
    """Read the bytes as each kind of file, every message of it, with joints by number and by name."""
    for kind in ("csv", "json", "yaml"):
        path = FOLDER / f"t.{kind}"
        path.write_bytes(data)
        with contextlib.suppress(TrajectoryError):
            for message in read_messages(path):
                for names in (None, ["shoulder", "elbow"]):
                    with contextlib.suppress(TrajectoryError):
                        message.read(joints=2, names=names)


atheris.Setup(sys.argv, one)
atheris.Fuzz()
