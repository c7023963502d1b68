"""Slips of the pen and of the disk: numbers, bytes and lines of a file that are not what they were."""

from __future__ import annotations

import random
import re

NUMBER = re.compile(r"(?<![\w.])-?[0-9]+(?:\.[0-9]+)?(?:e-?[0-9]+)?(?![\w.])")

HOSTILE = ("nan", ".inf", "1e400", "-0", "1_0", "0x10", "1:30", "true", "null", "'1'", "9" * 400, "1e-300", "[1]", "{}")
BYTES = (
    "[",
    "]",
    "{",
    "}",
    ":",
    ",",
    "-",
    "\n",
    " ",
    "\t",
    "\r",
    "\0",
    '"',
    "'",
    "#",
    "&a ",
    "*a",
    "!!int ",
    "---\n",
    "\ufeff",
)


def numbers(rng: random.Random, text: str, *, most: int = 3) -> str:
    """Return ``text`` with a few of its numbers changed: a little, by a unit, or into something hostile."""
    for _ in range(rng.randint(1, most)):
        found = list(NUMBER.finditer(text))
        if not found:
            break
        of = rng.choice(found)
        value = float(of[0])
        new = rng.choice(
            [
                f"{value * rng.uniform(0.5, 1.5):.6g}",
                f"{value + rng.uniform(-0.1, 0.1):.9g}",
                f"{-value:g}",
                f"{value * rng.choice((0.001, 0.01, 57.29577951308232, 1000.0)):.9g}",
                "0",
                rng.choice(HOSTILE) if rng.random() < 0.3 else of[0],
            ]
        )
        text = text[: of.start()] + new + text[of.end() :]
    return text


def letters(rng: random.Random, text: str) -> str:
    """Return ``text`` with something put in, taken out, copied or moved."""
    at, there = rng.randrange(len(text) + 1), rng.randrange(len(text) + 1)
    match rng.randrange(4):
        case 0:
            return text[:at] + rng.choice(BYTES) + text[at:]
        case 1:
            return text[:at] + text[at + rng.randint(1, 20) :]
        case 2:
            return text[:there] + text[at : at + rng.randint(1, 60)] + text[there:]
    lines = text.splitlines(keepends=True)
    line = lines.pop(rng.randrange(len(lines))) if lines else ""
    for _ in range(rng.randrange(3)):
        lines.insert(rng.randrange(len(lines) + 1), line)
    return "".join(lines)
