from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import pytest

from bench import plots, table
from bench.clock import median_ms
from bench.entries import Comparison, Entry, Goal, Section, Table, attempt

COMPARISON = Comparison(
    "1001 x 1001 points",
    [
        Entry("elbowroom", 2.0, "9 free"),
        Entry("numpy", 250.0, "equal"),
        Entry("shapely", None, "not installed (shapely)"),
    ],
)
SECTION = Section(
    "map",
    "Free-space map",
    "All of\nit.",
    [COMPARISON],
    [Table("More", ["a", "b"], [["1", "2"]])],
    [Goal("map", "fast", "slow", False)],
)


def test_a_row_has_the_ratio_to_ours_and_a_peer_that_is_missing_says_so() -> None:
    lines = table.page([SECTION], {"machine": "any"}).splitlines()
    assert "| elbowroom | 2.00 ms | 1.00 | 9 free |" in lines
    assert "| numpy | 250 ms | 125 | equal |" in lines
    assert "| shapely | - | - | not installed (shapely) |" in lines
    assert "| 1 | 2 |" in lines
    assert "- machine: any" in lines
    assert "All of it." in lines


def test_goals_that_are_not_reached_come_first() -> None:
    states = (True, None, False)
    rows = list(table.goals([Goal(str(reached), "g", "m", reached) for reached in states]))[2:]
    assert [row.split(" | ")[0] for row in rows] == ["| False", "| None", "| True"]
    assert "**not reached**" in rows[0]


@pytest.mark.parametrize(
    ("ms", "said"),
    [(None, "-"), (0.0123, "12.3 µs"), (1.0, "1.00 ms"), (9999.0, "9,999 ms"), (35_507.0, "35.5 s")],
)
def test_times_are_said_in_their_unit(ms: float | None, said: str) -> None:
    assert table.duration(ms) == said


def test_a_peer_that_fails_is_an_entry() -> None:
    def missing() -> Entry:
        raise ModuleNotFoundError("No module named 'peer'", name="peer")

    def broken() -> Entry:
        raise ValueError("a | b")

    assert attempt("peer", missing) == Entry("peer", None, "not installed (peer)")
    failed = attempt("peer", broken)
    assert failed.ms is None
    assert "ValueError" in failed.answer
    [row] = list(table.markdown(["who", "answer"], [["peer", failed.answer]]))[2:]
    assert row == "| peer | failed: ValueError: a \\| b |"


def test_results_that_were_stored_make_the_same_page() -> None:
    from bench.__main__ import section_of

    again = section_of(json.loads(json.dumps(asdict(SECTION))))
    assert table.page([again], {}) == table.page([SECTION], {})


def test_a_section_that_was_measured_apart_leaves_the_others_as_they_are() -> None:
    other = Section("plan", "Whole plan", "Another.", [COMPARISON], goals=[Goal("plan", "g", "m", True)])
    whole = table.page([SECTION, other], {"machine": "old"})
    again = Section("plan", "Whole plan", "Anew.", [COMPARISON], goals=[Goal("plan", "g", "m", False)])
    late = Section("motions", "Motions", "New.", goals=[Goal("motions", "g", "m", True)])
    page = table.spliced(whole, [again, late], {"machine": "new"}, ["map", "motions", "plan"])
    assert [line for line in page.splitlines() if line.startswith("## ")] == [
        "## Speed to reach",
        "## Free-space map (`map`)",
        "## Motions (`motions`)",
        "## Whole plan (`plan`)",
    ]
    kept, title = whole.index("## Free-space"), "## Whole plan"
    assert whole[kept : whole.index(title)] in page
    assert "Another." not in page
    assert "- machine: old" in page
    assert page.count("Measured apart from the others, machine: new.") == 2
    rows = [line for line in page.splitlines() if line.endswith("reached** |") or line.endswith("| reached |")]
    assert [row.split(" | ")[0] for row in rows] == ["| map", "| plan", "| motions"]
    assert table.spliced(page, [again, late], {"machine": "new"}, ["map", "motions", "plan"]) == page


def test_pictures_are_drawn(tmp_path: Path) -> None:
    sizes = [{"what": what, "points": n, "ms": n / 10, "mib": n} for what in ("map", "field") for n in (101, 201)]
    paths = [{"who": who, "case": "a", "ms": ms, "share": 0.5} for who, ms in (("elbowroom", 3.0), ("peer", None))]
    more = Section("sizes", "Sizes", "", plots={"sizes": sizes, "paths": paths})
    plots.draw([SECTION, more], tmp_path)
    for figure in (plots.ratios([SECTION]), plots.paths(paths)):
        assert figure.axes[0].get_legend() is not None
    assert sorted(file.name for file in tmp_path.iterdir()) == [
        "benchmarks_paths.png",
        "benchmarks_ratios.png",
        "benchmarks_sizes.png",
    ]


def test_the_clock_warms_up_and_returns_the_answer() -> None:
    calls: list[int] = []
    ms, last = median_ms(lambda: calls.append(1) or len(calls), 3)  # type: ignore[func-returns-value]
    assert (len(calls), last) == (4, 4)
    assert ms >= 0.0
