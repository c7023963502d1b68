"""The page: tables of ratios in Markdown."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence

from bench.entries import MS_CLASS, Comparison, Entry, Goal, Section, Table

GOALS = ""
"""Stands for the key of the part with the goals."""


def page(sections: Sequence[Section], about: Mapping[str, str]) -> str:
    """Return the whole page; ``about`` says what it was measured on."""
    lines = [
        "# Benchmarks",
        "",
        "The same work by elbowroom and its peers, side by side in one run, everybody's answers checked. `make bench`",
        "writes this page; `.venv-bench/bin/python -m bench --only KEY` measures one section again (keys stand in the",
        "titles). Times are medians of the wall clock, on one core unless a row says otherwise: take the ratios from",
        "them.",
        "",
        *(f"- {what}: {value}" for what, value in about.items()),
        "",
        "## Speed to reach",
        "",
        f'Figures in "ms-class" count as reached up to {MS_CLASS} times as much.',
        "",
        *goals([goal for section in sections for goal in section.goals]),
        "",
        "![how many times as long as elbowroom the peers take](images/benchmarks_ratios.png)",
    ]
    for section in sections:
        lines += ["", *section_lines(section)]
    return "\n".join(lines) + "\n"


def spliced(text: str, sections: Sequence[Section], about: Mapping[str, str], order: Sequence[str]) -> str:
    """Return the page ``text`` with ``sections`` anew and all others as they were; ``order`` has all keys.

    What the sections were measured on stands below their titles: the rest of the page was measured on something else.
    """
    head, *parts = re.split(r"(?m)^(?=## )", text)
    kept = {_key(part): part.rstrip("\n") for part in parts}
    measured = "; ".join(f"{what}: {value}" for what, value in about.items())
    for section in sections:
        title, blank, *lines = section_lines(section)
        words = textwrap.wrap(f"Measured apart from the others, {measured}.", 120, break_on_hyphens=False)
        kept[section.key] = "\n".join([title, blank, *words, "", *lines])
    fresh = [goal for section in sections for goal in section.goals]
    kept[GOALS] = _goals_spliced(kept[GOALS], fresh)
    return "\n\n".join([head.rstrip("\n"), *(kept[key] for key in (GOALS, *order) if key in kept)]) + "\n"


def _key(part: str) -> str:
    """Return the key in the title of a part of the page; the goals' part has none of its own."""
    found = re.match(r"## .* \(`(\w+)`\)\n", part)
    return found[1] if found else GOALS


def _goals_spliced(part: str, fresh: Sequence[Goal]) -> str:
    """Return the part of the page with the goals, those of ``fresh`` in place of those of the same work."""
    lines = part.splitlines()
    begin = next(i for i, line in enumerate(lines) if line.startswith("|"))
    end = next(i for i, line in enumerate([*lines, ""]) if i > begin and not line.startswith("|"))
    of = {goal.work for goal in fresh}
    rows = [row for row in [*lines[begin + 2 : end]] if row.split(" | ")[0].removeprefix("| ") not in of]
    rows += [*goals(fresh)][2:]
    place = {"**not reached**": 0, "not measured": 1, "reached": 2}
    rows.sort(key=lambda row: place[row.split(" | ")[-1].removesuffix(" |")])
    return "\n".join([*lines[: begin + 2], *rows, *lines[end:]])


def goals(goals: Sequence[Goal]) -> Iterator[str]:
    """Yield the table of goals, those not reached first."""
    order = {False: 0, None: 1, True: 2}
    said = {False: "**not reached**", None: "not measured", True: "reached"}
    ordered = sorted(goals, key=lambda goal: order[goal.reached])
    rows = [[goal.work, goal.goal, goal.measured, said[goal.reached]] for goal in ordered]
    return markdown(["work", "goal", "measured", ""], rows)


def section_lines(section: Section) -> Iterator[str]:
    """Yield a section."""
    yield f"## {section.title} (`{section.key}`)"
    yield ""
    yield from textwrap.wrap(section.words, 120, break_long_words=False, break_on_hyphens=False)
    for picture in section.plots:
        yield ""
        yield f"![{section.title}](images/benchmarks_{picture}.png)"
    for comparison in section.comparisons:
        yield from ("", f"### {comparison.title}", "")
        yield from markdown(["", "time", "x ours", "answer"], [row(comparison, entry) for entry in comparison.entries])
    for table in section.tables:
        yield from ("", f"### {table.title}", "")
        yield from plain(table)


def row(comparison: Comparison, entry: Entry) -> list[str]:
    """Return the row of one entry."""
    ratio = comparison.ratio(entry)
    return [entry.who, duration(entry.ms), "-" if ratio is None else number(ratio), entry.answer]


def duration(ms: float | None) -> str:
    """Return a time in words; a dash where there is none."""
    if ms is None:
        return "-"
    return f"{number(ms / 1000)} s" if ms >= 10_000 else f"{number(ms)} ms" if ms >= 1 else f"{number(ms * 1000)} µs"


def number(value: float) -> str:
    """Return three significant digits."""
    decimals = 0 if value >= 100 else 1 if value >= 10 else 2
    return f"{value:,.{decimals}f}"


def plain(table: Table) -> Iterator[str]:
    """Yield a table as it is."""
    return markdown(table.header, table.rows)


def markdown(header: Sequence[str], rows: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield the lines of a table."""
    yield f"| {' | '.join(header)} |"
    yield f"|{'---|' * len(header)}"
    for cells in rows:
        yield f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
