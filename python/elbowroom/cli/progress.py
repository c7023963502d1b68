"""What is being done, on stderr and only where someone looks."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager

WORDS = {
    "free_space": "mapping the free space",
    "cost_to_go": "cost-to-go by D*",
    "bound": "bounding the cost from below",
    "tip_path": "drawing paths",
    "joint_path": "following with the joints",
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
