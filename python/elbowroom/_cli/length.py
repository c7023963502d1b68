"""Lengths on the command line."""

from __future__ import annotations

import re
from typing import get_args

from elbowroom._core import Units
from elbowroom._errors import BadSetting
from elbowroom._scene import LengthUnit


def metres(text: str, units: Units, *, setting: str) -> float:
    """Return the length in ``text`` (m): a number in the unit of the scene, or with a unit of its own, such as ``5mm``.

    Raises:
        BadSetting: It is neither.
    """
    number = re.fullmatch(r"\s*([^\s]*?[\d.])\s*(m|cm|mm)?\s*", text)
    try:
        value = float(number[1]) if number else None
    except ValueError:
        value = None
    if number is None or value is None:
        listed = ", ".join(get_args(LengthUnit))
        message = f"{setting} is '{text}'; a length in {units.length}, or one with its unit, such as 5mm ({listed})"
        raise BadSetting(message, setting=setting)
    return value / (Units(length=number[2]) if number[2] else units).per_metre  # type: ignore[arg-type]
