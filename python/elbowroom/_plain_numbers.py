"""Numbers as people write them in files and on the command line, and nothing that Python alone takes for one.

``float`` reads ``1_0``, Arabic digits and True as well; where a wrong number moves an arm these are slips of the pen.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal

DECIMAL = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?", re.ASCII)
NOT_FINITE = re.compile(r"[+-]?\.?(?:nan|inf|infinity)", re.ASCII | re.IGNORECASE)
WHOLE = re.compile(r"[+-]?[0-9]+", re.ASCII)

MOST_DIGITS = 400
"""Longer numbers are none that anybody wrote; Python takes long for them."""


def number(value: object) -> float:
    """Return ``value``, a number or the text of one, as a float; NaN and infinity too, which others refuse.

    Raises:
        ValueError: It is neither; True and False are none.
    """
    if isinstance(value, str):
        text = value.strip(" \t\r\n")
        if len(text) <= MOST_DIGITS and DECIMAL.fullmatch(text):
            return float(text)
        if NOT_FINITE.fullmatch(text):
            return float(text.replace(".", ""))
    elif isinstance(value, int | float) and not isinstance(value, bool):
        try:
            return float(value)
        except OverflowError:
            pass
    raise ValueError("not a number")


def whole(text: str) -> int:
    """Return the whole number that ``text`` is.

    Raises:
        ValueError: It is none.
    """
    if len(text) <= MOST_DIGITS and WHOLE.fullmatch(text.strip(" \t\r\n")):
        return int(text)
    raise ValueError("not a whole number")


def exact(value: object) -> Decimal:
    """Return ``value``, a number or the text of one, without rounding it.

    Raises:
        ValueError: It is neither, or not finite.
    """
    nearest = number(value)
    if not math.isfinite(nearest):
        raise ValueError("not finite")
    # What is 0 as a float may have an exponent that would fill the memory.
    if nearest == 0.0:
        return Decimal(0)
    if isinstance(value, int):
        return Decimal(value)
    return Decimal(value.strip(" \t\r\n") if isinstance(value, str) else nearest)
