"""Whole numbers that the core takes: seeds, budgets, counts."""

from __future__ import annotations

from elbowroom._errors import BadSetting

LARGEST = 2**63 - 1
"""The core counts in 64 bits with a sign, and so do Parquet files."""


def is_whole(value: object, *, least: int = 0) -> bool:
    """Return whether ``value`` is a whole number from ``least`` on that the core can hold; True is none."""
    return isinstance(value, int) and not isinstance(value, bool) and least <= value <= LARGEST


def check_whole(name: str, value: int, *, least: int = 0) -> None:
    """Refuse a ``value`` of the setting ``name`` that is not whole, or less than ``least``.

    Raises:
        BadSetting: It is.
    """
    if not is_whole(value, least=least):
        raise BadSetting(f"{name} is {value}, it must be a whole number from {least} on", setting=name)
