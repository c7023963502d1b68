"""What a piece of work has to tell: who took how long, what was answered, which goal was reached."""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Entry:
    """How long one of the peers took (ms, a median), or None and in ``answer`` why there is no time."""

    who: str
    ms: float | None
    answer: str


@dataclass(frozen=True)
class Comparison:
    """The same work by several; the first entry is ours, which the others are compared with."""

    title: str
    entries: Sequence[Entry]

    @property
    def ours(self) -> Entry:
        """The entry that the others are compared with."""
        return self.entries[0]

    def ratio(self, entry: Entry) -> float | None:
        """How many times as long as ours it took."""
        return None if entry.ms is None or self.ours.ms is None else entry.ms / self.ours.ms

    def of(self, who: str) -> Entry:
        """The entry whose name begins with ``who``."""
        return next(entry for entry in self.entries if entry.who.startswith(who))


@dataclass(frozen=True)
class Table:
    """Any other table."""

    title: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]


MS_CLASS = 1.3
"""Up to how many times its figure a goal in "ms-class" counts as reached: times vary by as much from run to run."""


@dataclass(frozen=True)
class Goal:
    """A speed to reach and what was measured; ``reached`` is None where it could not be measured."""

    work: str
    goal: str
    measured: str
    reached: bool | None


@dataclass(frozen=True)
class Section:
    """A piece of work on the page; ``key`` also names it on the command line."""

    key: str
    title: str
    words: str
    comparisons: Sequence[Comparison] = ()
    tables: Sequence[Table] = ()
    goals: Sequence[Goal] = ()
    plots: dict[str, list[dict[str, object]]] = field(default_factory=dict)
    """Points for the pictures, by picture."""


def attempt(who: str, work: Callable[[], Entry]) -> Entry:
    """Return the entry that ``work`` makes; a peer that is not there, or fails, is an entry too."""
    try:
        return work()
    except ImportError as error:
        return Entry(who, None, f"not installed ({error.name})")
    except Exception as error:
        return Entry(who, None, f"failed: {type(error).__name__}: {' '.join(str(error).split())[:100]}")


def median_of_ratios(theirs: Sequence[float], ours: Sequence[float]) -> float:
    """Return the median over pairs of how many times as long they took."""
    return statistics.median(a / b for a, b in zip(theirs, ours, strict=True))
