from __future__ import annotations

import math
import re
import subprocess
import sys
from collections import Counter
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import pytest

import elbowroom as er
from elbowroom._own_planners import OWN
from elbowroom.compare import Row, compare
from elbowroom.compare._report import write_report
from elbowroom.compare._row import Problem
from elbowroom.compare._run import run
from elbowroom.compare._worker import Batch
from elbowroom.planners import Choice, all_chosen, chosen, known

TESTS = Path(__file__).parent


def installed(folder: Path, plugins: dict[str, str]) -> Path:
    """A folder for PYTHONPATH with an installed package whose entry points are ``plugins``."""
    about = folder / "odd_planners-1.2.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: odd-planners\nVersion: 1.2\n")
    lines = [f"{name} = {value}" for name, value in plugins.items()]
    (about / "entry_points.txt").write_text("[elbowroom.planners]\n" + "\n".join(lines) + "\n")
    (folder / "compare_plugins.py").write_bytes((TESTS / "compare_plugins.py").read_bytes())
    return folder


PLUGINS = {
    "detour": "compare_plugins:detour",
    "raises": "compare_plugins:raises",
    "leaves": "compare_plugins:leaves",
    "crashes": "compare_plugins:crashes",
    "text": "compare_plugins:answers_text",
    "nonsense": "compare_plugins:answers_nonsense",
    "through": "compare_plugins:straight_through",
    "elsewhere": "compare_plugins:plans_elsewhere",
    "lies": "compare_plugins:lies",
    "direct": "compare_plugins:direct",
    "goes-on": "compare_plugins:goes_on",
    "threads": "compare_plugins:says_threads",
    "refuses": "compare_plugins:refuses",
    "number": "compare_plugins:not_callable",
    "gone": "compare_plugins_that_are_not_there:plan",
}


@pytest.fixture
def plugins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The odd planners, installed for this process and its children."""
    folder = installed(tmp_path / "site", PLUGINS)
    monkeypatch.setenv("PYTHONPATH", str(folder))
    monkeypatch.syspath_prepend(folder)
    monkeypatch.delitem(sys.modules, "compare_plugins", raising=False)


def problem(choice: Choice, scene: Path, *, task: str = "first", seed: int = 0, **asked: Any) -> Problem:
    given: dict[str, Any] = {"budget": None, "timeout": None, "objective": "tip"} | asked
    return Problem.of(choice, scene=er.Scene.load(scene), file=str(scene), task=task, seed=seed, **given)


def once(text: str, scene: Path, **asked: Any) -> Row:
    return run(problem(chosen(text), scene, **asked), er.Scene.load(scene))


def lasting(rows: list[Row]) -> list[dict[str, Any]]:
    return [row.lasting for row in rows]


@pytest.mark.usefixtures("plugins")
def test_planners_are_listed_and_chosen() -> None:
    assert known()[: len(OWN)] == list(OWN)
    assert {"ompl", *PLUGINS} <= set(known())
    choice = chosen("detour:stops=false:by=0.5:name=y:tries=3")
    assert choice.given == {"stops": False, "by": 0.5, "name": "y"}
    assert choice.settings == {"stops": False, "by": 0.5, "name": "y", "tries": 3}
    assert choice.label == "detour:by=0.5:name=y:stops=false"
    assert chosen(choice.label) == choice
    assert choice.provider == "odd-planners 1.2, detour 7"
    assert chosen("dstar").provider == f"elbowroom {er.__version__}"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("rrt", f"no planner is called 'rrt'; known: {', '.join(OWN)}, "),
        ("dstar,,rrt", "no planner is called 'rrt'"),
        ("", f"no planner is named; known: {', '.join(OWN)}"),
        (" , ", "no planner is named"),
        ("dstar, dstar", "planner dstar is named twice"),
        ("detour,detour:tries=3", "planner detour is named twice"),
        ("dstar:x=1", "planner dstar has no option 'x'; known: it has none"),
        ("detour:x=1", "planner detour has no option 'x'; known: stops, by, name, tries"),
        ("detour:stops", "'stops' is not option=value"),
        ("detour:stops=2", "option stops of planner detour is '2', it must be true or false"),
        ("detour:by=much", "must be a finite number"),
        ("detour:by=nan", "must be a finite number"),
        ("detour:tries=1.5", "must be a whole number"),
    ],
)
@pytest.mark.usefixtures("plugins")
def test_wrong_names_are_told_the_known_ones(text: str, words: str) -> None:
    with pytest.raises(er.BadSetting) as caught:
        all_chosen(text)
    assert words in str(caught.value)


def test_two_planners_of_one_name_are_refused_when_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(installed(tmp_path, {"dstar": "compare_plugins:detour"}))
    with pytest.raises(er.BadSetting, match=r"2 planners are called 'dstar': of elbowroom, odd-planners 1.2"):
        chosen("dstar")
    assert chosen("optimal").name == "optimal"


def test_a_plugin_that_lacks_something_says_so_before_the_start(monkeypatch: pytest.MonkeyPatch) -> None:
    def load(_: EntryPoint) -> None:
        raise er.BadSetting("planner ompl needs the extra: pip install 'elbowroom[ompl]'", setting="planners")

    monkeypatch.setattr(EntryPoint, "load", load)
    with pytest.raises(er.BadSetting, match="needs the extra"):
        all_chosen("dstar,ompl")


# One run


@pytest.mark.usefixtures("plugins")
def test_what_becomes_of_planners(scenes: Path) -> None:
    scene = scenes / "paper-standin.yaml"
    good = once("detour", scene, seed=4, budget=50)
    assert (good.success, good.found, good.safe, good.failure, good.message) == (True, True, True, None, None)
    assert (good.evaluations, good.lower_bound, good.budget, good.seed) == (150, 0.5, 50, 4)
    assert good.cost == good.tip_length_m
    assert good.gap == pytest.approx(good.cost / 0.5 - 1.0)  # type: ignore[operator]
    assert good.convergence is not None
    assert good.convergence[-1][0] == 50
    assert set(good.stages_s) == {"search", "verdict"}
    assert good.time_s > 0.0
    assert Row.from_line(good.as_line()) == Row.from_line(Row.from_line(good.as_line()).as_line())
    by_rows = once("detour:stops=false", scene, objective="time")
    assert by_rows.success
    assert by_rows.cost == by_rows.duration_s == once("dstar", scene, objective="time").cost

    for text, failure, words in (
        ("raises", "broken", "RuntimeError: two lines | and a bar"),
        ("leaves", "broken", "SystemExit: 3"),
        ("text", "no_motion", "returned str, not a Proposal"),
        ("nonsense", "no_motion", ""),
        ("crashes", "not_found", "nothing here"),
        ("refuses", "refused", "serves no arm"),
        ("number", "broken", "int, not a callable"),
        ("gone", "broken", "No module named 'compare_plugins_that_are_not_there'"),
    ):
        row = once(text, scene)
        assert (row.found, row.success, row.safe, row.failure) == (False, False, None, failure)
        assert words in (row.message or "")
    assert {once("nonsense", scene, seed=seed).failure for seed in range(3)} == {"no_motion"}
    unsafe = once("through", scene)
    assert (unsafe.found, unsafe.success, unsafe.safe, unsafe.failure) == (True, False, False, "unsafe")
    assert "touches obstacle" in (unsafe.message or "")
    assert unsafe.least_clearance_m is not None
    assert unsafe.least_clearance_m < 0.0
    elsewhere = once("detour:by=0.00002", scene)
    assert (elsewhere.found, elsewhere.success, elsewhere.safe, elsewhere.failure) == (True, False, True, "wrong_end")
    late = once("dstar", scene, timeout=0.0)
    assert (late.failure, late.found) == ("timed_out", False)
    nowhere = once("dstar", scenes / "paper-table1.yaml")
    assert nowhere.failure == "not_found"
    budgeted = [once("dstar-pso", scene, task="second", seed=1, budget=budget).evaluations for budget in (1, None)]
    assert budgeted == [1, 300]


@pytest.mark.usefixtures("plugins")
def test_what_a_plugin_says_of_itself_is_judged_again(scenes: Path) -> None:
    scene = scenes / "paper-standin.yaml"
    other_task = once("elsewhere", scene)
    assert (other_task.safe, other_task.success, other_task.failure) == (True, False, "wrong_end")
    other_scene = once("elsewhere", scenes / "narrow.yaml", seed=1)
    assert (other_scene.safe, other_scene.success, other_scene.failure) == (False, False, "unsafe")
    assert other_scene.lower_bound is None
    assert "verdict" in other_scene.stages_s
    through = once("lies", scene)
    assert (through.safe, through.success, through.failure) == (False, False, "unsafe")
    bound = once("lies", scene, seed=1)
    assert (bound.safe, bound.success, bound.failure, bound.gap) == (True, False, "broken", None)
    assert "no motion costs less than 9; its own costs" in (bound.message or "")


FOUR_LINKS = """\
elbowroom: 1
units: {length: cm, angle: deg}
arm:
  links: [15, 12, 12, 11]
  joints: [{continuous: true}, {min: -150, max: 150}, {min: -150, max: 150}, {min: -150, max: 150}]
  self_collision: true
grid: {x: [-50, 50], y: [-50, 50], step: 1}
obstacles:
  - circle: {center: [40, -30], radius: 5}
tasks:
  go: {start: {q: [0, 30, 30, 30]}, goal: {q: [90, -30, 40, 10]}}
  fold: {start: {q: [0, 30, 30, 30]}, goal: {q: [90, 120, 120, 120]}}
"""


@pytest.mark.usefixtures("plugins")
def test_what_becomes_of_arms_of_many_links(tmp_path: Path) -> None:
    scene = tmp_path / "four.yaml"
    scene.write_text(FOUR_LINKS)
    good = once("direct", scene, task="go", objective="joint")
    assert (good.success, good.safe, good.failure, good.evaluations) == (True, True, None, 1)
    assert good.cost == good.joint_travel_rad == pytest.approx(math.radians(math.hypot(90, 60, 10, 20)), rel=1e-9)
    assert good.least_clearance_m is not None
    elsewhere = once("direct:short=0.01", scene, task="go")
    assert (elsewhere.failure, elsewhere.message) == ("wrong_end", "the motion is 0.573 deg from the goal")
    folded = once("direct", scene, task="fold")
    assert (folded.failure, folded.found) == ("unsafe", True)
    assert "touches link" in (folded.message or "")
    refused = once("optimal", scene, task="go")
    assert (refused.failure, refused.found) == ("refused", False)
    assert refused.message.startswith(
        "planner optimal is for arms of 2 links; this one has 4; those that serve it: guided-rrt-connect, "
    )
    names = ["direct", "optimal"]
    found = compare([scene], planners=all_chosen(",".join(names)), seeds=range(2), out=tmp_path / "out", jobs=1)
    became = Counter((row.planner, row.task, row.failure) for row in found.rows)
    assert became == {
        ("direct", "go", None): 2,
        ("direct", "fold", "unsafe"): 2,
        ("optimal", "go", "refused"): 2,
        ("optimal", "fold", "refused"): 2,
    }
    report, *_ = write_report(found.rows, tmp_path / "out", planners=names, command="c")
    assert "the planner does not serve this arm, task or setting" in report.read_text()


def test_options_of_our_own_planners(scenes: Path) -> None:
    scene = scenes / "paper-standin.yaml"
    for name, kind in OWN.items():
        assert chosen(name).settings == kind.options
        assert kind.budget is None or isinstance(kind.options[kind.budget], int)
        for option, value in kind.options.items():
            assert chosen(f"{name}:{option}={value}").given == {}
            with pytest.raises(er.BadSetting, match=f"option {option} of planner {name} is 'no such word', it must be"):
                chosen(f"{name}:{option}=no such word")
            if isinstance(value, int):
                assert chosen(f"{name}:{option}={value + 1}").label == f"{name}:{option}={value + 1}"
                with pytest.raises(er.BadSetting, match=f"option {option} of planner {name} is -1, it must be a whole"):
                    chosen(f"{name}:{option}=-1")
    # A budget stands for one of the options, and the row says so.
    assert problem(chosen("dstar-pso"), scene, budget=50).settings == {"candidates": 50}
    assert problem(chosen("dstar-pso"), scene).settings == {"candidates": 300}
    few, same = once("dstar-pso:candidates=2", scene), once("dstar-pso", scene, budget=2)
    assert few.settings == same.settings
    assert (few.cost, few.planner, same.planner) == (same.cost, "dstar-pso:candidates=2", "dstar-pso")
    assert problem(chosen("dstar-pso:candidates=2"), scene, budget=2).settings == {"candidates": 2}
    with pytest.raises(er.BadSetting, match=r"planner dstar-pso:candidates=2 has candidates of its own and a budget"):
        problem(chosen("dstar-pso:candidates=2"), scene, budget=3)


# Rows


@pytest.mark.usefixtures("plugins")
def test_broken_plugins_fail_their_rows_and_no_others(scenes: Path, tmp_path: Path) -> None:
    names = "dstar,raises,leaves,crashes,text,gone,detour,threads"
    found = compare(
        [scenes / "paper-standin.yaml"], planners=all_chosen(names), seeds=range(3), out=tmp_path / "out", jobs=2
    )
    assert len(found.rows) == 2 * 8 * 3
    became = Counter((row.planner, row.failure) for row in found.rows)
    assert became == {
        ("dstar", None): 6,
        ("raises", "broken"): 6,
        ("leaves", "broken"): 6,
        ("crashes", "not_found"): 4,
        ("crashes", "crashed"): 2,
        ("text", "no_motion"): 6,
        ("gone", "broken"): 6,
        ("detour", None): 6,
        ("threads", "not_found"): 6,
    }
    assert {row.message for row in found.rows if row.planner == "threads"} == {"1 1 1 1"}
    report, pairs, *pictures = write_report(
        found.rows, tmp_path / "out", planners=names.split(","), command="elbowroom compare x"
    )
    text = report.read_text()
    assert "raises, 3 of 3: the planner raised what it should not" in text.replace("`", "")
    assert "two lines \\| and a bar" in text
    for picture in pictures:
        assert picture.stat().st_size > 1000
        assert f"({picture.relative_to(tmp_path / 'out').as_posix()})" in text
    assert {path.stem.rpartition("_")[2] for path in pictures} >= {"overall", "first", "second", "convergence"}
    assert pairs.read_text().startswith("metric,scene,task,first,second,test,less,equal,greater,p,p_holm,delta,a12\n")


@pytest.mark.usefixtures("plugins")
def test_a_planner_that_goes_on_is_ended(scenes: Path, tmp_path: Path) -> None:
    scene = scenes / "paper-standin.yaml"
    short = [problem(chosen(name), scene, timeout=seconds) for name, seconds in (("goes-on", 0.2), ("dstar", 5.0))]
    script = tmp_path / "ended.py"
    script.write_text(
        "import pickle, sys\n"
        "from elbowroom.compare import _local, _worker\n"
        "_worker.GRACE = 0.5\n"
        "if __name__ == '__main__':\n"
        "    batch = pickle.load(open(sys.argv[1], 'rb'))\n"
        "    rows = list(_local.run_locally([batch], jobs=1))\n"
        "    pickle.dump(rows, open(sys.argv[2], 'wb'))\n"
    )
    import pickle

    (tmp_path / "batch").write_bytes(pickle.dumps(Batch(str(scene), scene.read_text(), short)))
    subprocess.run([sys.executable, script, tmp_path / "batch", tmp_path / "rows"], check=True, timeout=60)
    ended, after = pickle.loads((tmp_path / "rows").read_bytes())
    assert (ended.failure, ended.message) == (
        "timed_out",
        "the planner did not keep its timeout of 0.2 s and was ended",
    )
    assert after.success


def test_the_planner_in_the_docs_plans(standin: er.Scene) -> None:
    page = (TESTS.parent / "docs" / "compare.md").read_text()
    block = re.search(r"<!-- plug-in -->\n```python\n(.*?)```", page, re.DOTALL)
    assert block is not None
    names: dict[str, Any] = {}
    exec(block[1], names)
    ends = (er.Configuration((0.0, 0.5)), er.Configuration((-2.0, 0.6)))
    scene = standin.replace(tasks={"go": er.Task(start=ends[0], goal=ends[1])})
    asked = {"seed": 0, "timeout": None, "budget": None, "objective": "tip"}
    found = names["halfway"](scene, "go", **asked)
    assert er.check(scene, t=found.t, q=found.q, v=found.v, a=found.a).safe
    assert found.evaluations > 1
    with pytest.raises(er.NotFound, match="no middle is clear"):
        names["halfway"](scene, "go", **{**asked, "budget": 1})
