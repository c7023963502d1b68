"""What is being done, on stderr and only on a terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

WORDS = {
    "free_space": "mapping the free space",
    "cost_to_go": "cost-to-go by D*",
    "bound": "proving a lower bound",
    "tip_path": "sampling paths",
    "joint_path": "solving for the joints",
    "trajectory": "timing the motion",
    "verdict": "verifying",
}


@contextmanager
def progress() -> Iterator[Callable[[str], None]]:
    """Give a function that shows a stage or any other words; silent unless stderr is a terminal."""
    if not sys.stderr.isatty():
        yield lambda _stage: None
        return
    from rich.console import Console

    with Console(stderr=True).status("starting") as status:
        yield lambda stage: status.update(WORDS.get(stage, stage.replace("_", " ")))
