from __future__ import annotations

import json
import math
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from msgspec import structs
from msgspec.structs import fields
from typer.testing import CliRunner

import elbowroom as er
from elbowroom._cli.compare_command import _serving
from elbowroom._cli.main import app
from elbowroom._own_planners import OWN
from elbowroom.compare import Row
from elbowroom.compare._generate import generated, write_scenes
from elbowroom.compare._report import write_report
from elbowroom.compare._row import FAILURES
from elbowroom.compare._summary import summarised

TESTS = Path(__file__).parent


def shell(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", "from elbowroom._cli import main; main()", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def made(planner: str, seed: int, cost: float | None, *, task: str = "a", scene: str = "s.yaml") -> Row:
    common: dict[str, Any] = {
        "scene": scene,
        "scene_sha256": scene,
        "task": task,
        "planner": planner,
        "settings": {},
        "seed": seed,
        "budget": None,
        "timeout_s": None,
        "objective": "tip",
        "version": "0",
        "provider": "x",
        "time_s": 0.5,
        "stages_s": {},
    }
    if cost is None:
        return Row(**common, found=True, safe=False, success=False, failure="unsafe", message="m")
    return Row(**common, found=True, safe=True, success=True, cost=cost, tip_length_m=cost)


def test_the_summary_counts() -> None:
    rows = [made("x", i, cost) for i, cost in enumerate((1.0, 2.0, 3.0, None))]
    rows += [made("y", i, cost) for i, cost in enumerate((2.0, 2.0 * (1 + 1e-14), None, None))]
    rows += [made("x", 0, 4.0, task="b"), made("y", 0, None, task="b")]
    summary = summarised(rows, ["y", "x"])
    first, second = summary.tasks
    assert [cell.planner for cell in first.cells] == ["y", "x"]
    assert [cell.success.value for cell in first.cells if cell.success] == [0.5, 0.75]
    assert [cell.unsafe for cell in first.cells] == [2, 1]
    medians = [cell.medians["tip_length_m"] for cell in first.cells]
    assert [interval.value for interval in medians if interval] == pytest.approx([200.0, 200.0])
    assert second.cells[0].medians["tip_length_m"] is None
    cost = next(pair for pair in first.pairs if pair.metric == "cost")
    # y has 2, 2, inf, inf and x has 1, 2, 3, inf.
    assert (cost.less, cost.equal, cost.greater) == (4, 4, 8)
    assert cost.delta == pytest.approx(0.25)
    assert cost.a12 == pytest.approx(0.625)
    y, x = summary.overall
    assert x.success
    assert y.success
    assert (x.success.value, y.success.value) == (0.8, 0.4)
    assert (x.ratios, x.best_on, y.ratios, y.best_on) == ([1.0, 1.0], 2, [1.0], 1)
    # Over the tasks, medians with failures behind: y inf, inf against x 2.5, 4.
    over = next(pair for pair in summary.pairs if pair.metric == "cost")
    assert (over.less, over.equal, over.greater, over.p) == (0, 0, 2, 0.5)
    assert summarised(rows[:8], ["x", "y"]).pairs == []


def refused(planner: str, seed: int, *, task: str = "a") -> Row:
    return structs.replace(
        made(planner, seed, None, task=task), found=False, safe=None, failure="refused", message="for 2 links"
    )


def test_a_planner_that_does_not_serve_an_arm_is_not_applicable(tmp_path: Path) -> None:
    rows = [made("x", s, 1.0 + s, task=task) for task in "abc" for s in range(3)]
    rows += [refused("y", s, task=task) for task in "ab" for s in range(3)]
    rows += [made("y", s, 0.5, task="c") for s in range(3)]
    rows += [refused("z", s, task=task) for task in "abc" for s in range(3)]
    summary = summarised(rows, ["x", "y", "z"])
    first, _, third = summary.tasks
    assert [cell.success is None for cell in first.cells] == [False, True, True]
    assert first.pairs == []
    assert [(pair.first, pair.second) for pair in third.pairs] == [("x", "y"), ("x", "y")]
    x, y, z = summary.overall
    assert y.success
    assert (y.success.value, y.tasks, y.best_on, y.ratios) == (1.0, 1, 1, [1.0])
    assert (z.success, z.tasks, x.tasks) == (None, 0, 3)
    # Over the tasks that both serve: one.
    assert [(pair.first, pair.second, pair.greater) for pair in summary.pairs if pair.metric == "cost"] == [
        ("x", "y", 1)
    ]
    report, *_ = write_report(rows, tmp_path, planners=["x", "y", "z"], command="c")
    text = report.read_text()
    assert "| `z` | not applicable | - |" in text
    assert "Not applicable, and in no count or test:\n\n- `y`: for 2 links\n- `z`: for 2 links" in text
    assert "0 of 3" not in text
    # A task that nobody serves has no picture.
    write_report([refused("x", 0), refused("y", 0)], tmp_path / "none", planners=["x", "y"], command="c")


def test_compare_counts_what_does_not_apply_apart(scenes: Path, tmp_path: Path) -> None:
    call = ("compare", scenes / "three-links.yaml", "--seeds", "1", "--planners", "dstar,optimal", "--out", tmp_path)
    told = json.loads(shell(*call, "--json").stdout)
    assert (told["runs"], told["success"], told["not_applicable"]) == (4, 0, 4)
    assert "4 not applicable" in shell(*call).stdout


def test_many_tasks_have_a_line_each(tmp_path: Path) -> None:
    rows = [made(p, s, 1.0 + s, task=f"t{i}") for i in range(30) for p in "xy" for s in range(2)]
    report, _, *pictures = write_report(rows, tmp_path, planners=["x", "y"], command="c")
    assert [path.name for path in pictures] == ["overall.png"]
    assert report.read_text().count("| s | t") == 30
    same_name = [made("x", 0, 1.0, scene="a/s.yaml"), made("x", 0, 1.0, scene="b/s.yaml")]
    assert [task.scene for task in summarised(same_name, ["x"]).tasks] == ["a/s.yaml", "b/s.yaml"]


def test_generated_scenes_are_the_same_for_a_seed_and_free_at_both_ends(tmp_path: Path) -> None:
    paths = write_scenes(12, tmp_path / "new", seed=5)
    assert [path.name for path in paths][:2] == ["seed5-01.yaml", "seed5-02.yaml"]
    assert len({path.read_bytes() for path in paths}) == 12
    kinds: Counter[str] = Counter()
    for number, path in enumerate(paths, 1):
        assert path.read_text() == generated(number, seed=5)
        scene = er.Scene.load(path)
        kinds.update(type(obstacle).__name__ for obstacle in scene.obstacles)
        assert list(scene.tasks) == ["first", "second"]
        for task in scene.tasks.values():
            start, goal = task.start, task.goal
            assert not isinstance(start, er.Configuration)
            assert not isinstance(goal, er.Configuration)
            assert math.dist(start, goal) >= 0.3
        space = er.free_space(scene)
        for task in scene.tasks.values():
            for x, y in (task.start, task.goal):  # type: ignore[misc]
                column, row = round((x + 0.5) / 0.01), round((y + 0.5) / 0.01)
                assert space.union[row, column]
    assert min(kinds.values()) > 10
    with pytest.raises(er.BadSetting, match="count is 0"):
        write_scenes(0, tmp_path, seed=0)


def test_compare_on_the_command_line(tmp_path: Path) -> None:
    generate = shell("generate", "--count", "1", "--seed", "1", "--out", tmp_path / "scenes")
    assert generate.stdout.startswith("wrote 1 scene, seed1-1.yaml")
    files = sorted((tmp_path / "scenes").iterdir())
    call = (
        "compare",
        *files,
        "--seeds",
        "2",
        "--planners",
        "dstar,optimal",
        "--out",
        tmp_path / "out",
        "--timeout",
        "60",
    )
    done = shell(*call, "--json")
    assert done.returncode == 0
    assert done.stderr == ""
    told = json.loads(done.stdout)
    assert (told["runs"], told["run_now"]) == (8, 8)
    again = shell(*call)
    assert "8 were there already" in again.stdout
    report = (tmp_path / "out" / "report.md").read_text()
    assert report.count("## ") == 4
    assert "--planners dstar,optimal --seeds 2 --timeout 60.0 --objective tip" in report


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("missing.yaml",), "missing.yaml: cannot be read"),
        (("SCENE", "--planners", "rrt"), f"known: {', '.join(OWN)}"),
        (("SCENE", "--planners", "dstar:speed=2"), "no option 'speed'"),
        (("SCENE", "--seeds", "0"), "--seeds"),
        (("SCENE", "--objective", "fun"), "tip, joint or time"),
        (("SCENE", "--out", "FILE"), "is a file; a folder is needed"),
        (("SCENE", "--out", "FILE/below"), "Not a directory"),
        (("SCENE", "--on", "moon"), "local or ray"),
    ],
)
def test_bad_input_is_one_message(scenes: Path, tmp_path: Path, arguments: tuple[str, ...], words: str) -> None:
    (tmp_path / "file").write_text("")
    stand_ins = {"SCENE": str(scenes / "paper-standin.yaml"), "FILE": str(tmp_path / "file")}
    call = []
    for argument in arguments:
        for name, value in stand_ins.items():
            argument = argument.replace(name, value)
        call.append(argument)
    if "--out" not in call:
        call += ["--out", str(tmp_path / "out")]
    failed = CliRunner().invoke(app, ["compare", *call])
    assert failed.exit_code == 2
    assert words in failed.stderr
    assert "Traceback" not in failed.stderr
    assert failed.stdout == ""


def test_figures_take_anything(standin: er.Scene) -> None:
    from elbowroom.figures._compare import Panel, Shares, convergence, side_by_side

    panels = [Panel("empty", [[], []], logarithmic=True), Panel("one", [[1.0], []]), Shares("s", [(0.5, 0.1, 0.9)] * 2)]
    side_by_side("none", ["x", "y"], panels).canvas.draw()
    curves: dict[str, Any] = {"x": [[(1, 5.0), (10, 2.0)], [(2, 4.0)]], "y": [[]], "z": []}
    convergence("c", "cost", curves).canvas.draw()
    assert standin


def test_the_library_is_not_needed_for_help() -> None:
    code = "import sys, elbowroom._cli.main as m; sys.exit(any(n.startswith('elbowroom.compare') for n in sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], timeout=60).returncode == 0


def test_the_docs_name_every_column_failure_and_file() -> None:
    page = (TESTS.parent / "docs" / "compare.md").read_text()
    for name in [
        *(part.name for part in fields(Row)),
        *FAILURES,
        "report.md",
        "rows.jsonl",
        "rows.parquet",
        "pairs.csv",
    ]:
        assert f"`{name}`" in page, name


def test_left_out_planners_are_those_that_serve_the_arm(scenes: Path) -> None:
    def serving(*names: str) -> set[str]:
        return set(_serving([scenes / f"{name}.yaml" for name in names]).split(","))

    two, five = serving("paper-standin"), serving("five-links")
    assert two == set(OWN) - {"guided-rrt-connect"}
    assert five == {"guided-rrt-connect", "pso", "cbpso", "nsc-pso", "ik-pso"}
    assert serving("paper-standin", "five-links") == set(OWN)
