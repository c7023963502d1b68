"""Joints, links and obstacles by their numbers, and how many of something, in words."""

from __future__ import annotations

from collections.abc import Sequence


def called_obstacle(index: int, name: str | None) -> str:
    """Return what texts call the obstacle at ``index``.

    Example:
        >>> called_obstacle(0, None), called_obstacle(1, "post")
        ('obstacle 1', 'obstacle 2 (post)')
    """
    return f"obstacle {index + 1}" + ("" if name is None else f" ({name})")


def counted(number: int, noun: str) -> str:
    """Return ``number`` of ``noun``.

    Example:
        >>> counted(1, "piece"), counted(0, "piece"), counted(12, "linear piece")
        ('1 piece', '0 pieces', '12 linear pieces')
    """
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def numbered(noun: str, numbers: Sequence[int]) -> str:
    """Return ``noun`` with ascending ``numbers``, runs of more than two as from and to.

    Example:
        >>> numbered("joint", [2]), numbered("joint", [1, 2]), numbered("joint", [1, 2, 3, 4, 7])
        ('joint 2', 'joints 1 and 2', 'joints 1 to 4 and 7')
    """
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    parts = [word for run in runs for word in ([f"{run[0]} to {run[-1]}"] if len(run) > 2 else map(str, run))]
    listed = ", ".join(parts[:-1]) + " and " * (len(parts) > 1) + parts[-1] if parts else ""
    return f"{noun}{'s' if len(numbers) > 1 else ''} {listed}".strip()
