"""The tables of docs/ whose rows are made in seconds hold what the program does now; measured times are left out."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from bench import bounds, moving, objectives, table2
from elbowroom._own_planners import OWN
from elbowroom.compare._report import task_table
from elbowroom.compare._summary import summarised
from elbowroom.planners import all_chosen

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"


def lines(page: str) -> list[str]:
    return (DOCS / page).read_text(encoding="utf-8").splitlines()


def table(page: str, header: str) -> list[str]:
    """The table under ``header``, with it."""
    of = lines(page)
    begin = of.index(header)
    return of[begin : of.index("", begin)] if "" in of[begin:] else of[begin:]


def cells(line: str) -> list[str]:
    return [cell.strip(" *") for cell in line.strip("|").split("|")]


@pytest.mark.parametrize("scene", moving.SCENES)
def test_followed_scenes_end_as_their_page_says(scene: str) -> None:
    [row] = [line for line in lines("moving.md") if line.startswith(f"| `{scene}` |")]
    assert row.rpartition("|")[0].rpartition("|")[0] + "|" == moving.outcome(scene)[0]


@pytest.mark.parametrize("made", [bounds.joint_travel, bounds.tip_travel])
def test_bounds_and_gaps_are_those_of_their_page(made: Callable[[], list[str]]) -> None:
    rows = made()
    assert table("bounds.md", rows[0]) == rows


def test_what_is_proved_to_have_no_path_is_on_its_page(tmp_path: Path) -> None:
    assert set(bounds.narrow_within_90(tmp_path / "no_path.png")) <= set(lines("bounds.md"))


def test_what_the_swarm_gains_is_what_its_page_says() -> None:
    """One of the six scenes: ten seeds of each row take their time."""
    chosen = [case for case in objectives.cases() if case.name == "abb-irb-910sc-065"]
    header, line, *rows = objectives.gains(10, chosen)
    told = [row for row in table("objectives.md", header)[2:] if cells(row)[0] == "abb-irb-910sc-065"]
    assert told == rows
    assert line.startswith("|---|")


def test_the_readme_shows_rows_of_the_whole_table() -> None:
    header = next(line for line in lines("objectives.md") if line.startswith("| scene |"))
    shown = (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
    begin = shown.index(header)
    rows = shown[begin : begin + shown[begin:].index("")]
    assert len(rows) > 10
    assert set(rows) <= set(table("objectives.md", header))


def test_planners_without_a_seed_have_the_rows_of_table_2(tmp_path: Path) -> None:
    named = "dstar,optimal"
    rows = table2.compared(table2.EXAMPLES, named, seeds=1, budget=None, out=tmp_path)
    page = lines("table2.md")
    summary = summarised(rows, [choice.label for choice in all_chosen(named)])
    assert len(summary.tasks) == 4
    for task in summary.tasks:
        begin = page.index(f"### {Path(task.scene).stem}, task {task.task}")
        header, _, *made = map(cells, task_table(task, "tip").splitlines())
        for row in made:
            told = next(cells(line) for line in page[begin:] if line.startswith(f"| {row[0]} |"))
            columns = cells(page[begin + 2])
            for name, value in zip(header, row, strict=True):
                if name not in ("success", "time (ms)"):
                    assert told[columns.index(name)] == value, (row[0], name)


@pytest.mark.parametrize("planner", OWN)
def test_pages_of_planners_have_their_options_with_their_defaults(planner: str) -> None:
    page = lines(os.path.join("planners", f"{planner}.md"))
    told = {cells(line)[0].strip("`"): cells(line)[1].strip("`") for line in page if line.startswith("| `")}
    assert told == {name: str(default) for name, default in OWN[planner].options.items()}
