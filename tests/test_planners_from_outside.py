"""Planners that somebody else wrote: what is right becomes a plan, what is wrong is found out."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import elbowroom as er
from elbowroom.compare import compare, straight_turns
from elbowroom.planners import Proposal, all_chosen
from tests import compare_plugins
from tests.test_compare_planners import PLUGINS, installed


@pytest.fixture
def scene(scenes: Path) -> er.Scene:
    return er.Scene.load(scenes / "paper-standin.yaml")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder for PYTHONPATH with the plug-ins of the tests, installed."""
    site = installed(tmp_path / "site", PLUGINS)
    monkeypatch.setenv("PYTHONPATH", str(site))
    monkeypatch.syspath_prepend(site)
    return site


def honest(scene: er.Scene, task: str, *, seed: int, shift: float = 0.0, **_: object) -> Proposal:
    """dstar's path, without its times."""
    q = er.plan(scene, task=task, planner="dstar", seed=seed).configurations + shift
    return Proposal(t=np.arange(float(len(q))), q=q, evaluations=3, convergence=[(3, 1.0)])


def test_a_path_becomes_a_motion(scene: er.Scene) -> None:
    plan = er.plan(scene, task="first", planner=honest, seed=5)
    assert (plan.planner, plan.seed, plan.settings["shift"], plan.evaluations) == ("honest", 5, 0.0, 3)
    assert plan.verdict.safe
    assert plan.lower_bound is not None
    assert plan.lower_bound <= plan.cost
    assert next(iter(plan.timings)) == "search"
    samples = plan.sample()
    assert er.check(scene, t=samples.t, q=samples.q, v=samples.v, a=samples.a).safe
    again = pickle.loads(pickle.dumps(plan))
    assert again == plan
    slow = er.plan(scene, task="first", planner=honest, duration=30.0)
    assert slow.motion.duration == pytest.approx(30.0)


def test_a_motion_and_a_plan_are_taken_as_they_are(scene: er.Scene) -> None:
    own = er.plan(scene, task="first", planner="dstar")
    samples = own.sample()

    def with_times(*_: object, **__: object) -> Proposal:
        return Proposal(t=samples.t, q=samples.q, v=samples.v, a=samples.a)

    taken = er.plan(scene, task="first", planner=with_times)
    assert taken.cost == pytest.approx(own.cost, rel=1e-9)
    handed_on = er.plan(scene, task="first", planner=lambda *_, **__: own)  # type: ignore[arg-type,misc]
    assert handed_on.motion == own.motion
    assert handed_on.planner.endswith("<lambda>")


def test_more_links_are_served_too(scenes: Path) -> None:
    scene = er.Scene.load(scenes / "five-links.yaml")

    def own(scene: er.Scene, task: str, *, seed: int, **_: object) -> er.Plan:
        return er.plan(scene, task=task, seed=seed)

    plan = er.plan(scene, task="reach", planner=own)
    assert plan.verdict.safe
    assert own(scene, "reach", seed=0).planner == "guided-rrt-connect"


@pytest.mark.parametrize(
    ("planner", "words"),
    [
        (compare_plugins.straight_through, "is not certified free|is not proved to be safe"),
        (compare_plugins.lies, "is not certified free|is not proved to be safe"),
        (compare_plugins.answers_text, "returned str, not a Proposal"),
        (compare_plugins.answers_nonsense, "planner answers_nonsense: "),
        (compare_plugins.raises, "planner raises failed: RuntimeError: two"),
        (compare_plugins.leaves, "planner leaves failed: SystemExit: 3"),
        (compare_plugins.plans_elsewhere, "the motion is 41.* cm from the start"),
    ],
)
def test_what_is_wrong_is_found_out(scene: er.Scene, planner: Any, words: str) -> None:
    with pytest.raises(er.PlannerFault, match=words) as caught:
        er.plan(scene, task="first", planner=planner)
    assert caught.value.planner == planner.__name__


def test_a_motion_that_is_not_safe_comes_with_its_verdict(scenes: Path) -> None:
    scene = er.Scene.load(scenes / "narrow.yaml")

    def through(scene: er.Scene, task: str, **_: object) -> Proposal:
        free = er.plan(scene.replace(obstacles=()), task=task).sample()
        return Proposal(t=free.t, q=free.q, v=free.v, a=free.a)

    with pytest.raises(er.PlannerFault, match=r"planner .*through: its motion is not proved to be safe") as caught:
        er.plan(scene, task="first", planner=through)
    assert caught.value.verdict is not None
    assert not caught.value.verdict.safe


def test_what_it_tells_of_its_search_has_to_be_numbers(scene: er.Scene) -> None:
    def counts(evaluations: Any, convergence: Any) -> Any:
        def counted(scene: er.Scene, task: str, **_: object) -> Proposal:
            q = er.plan(scene, task=task, planner="dstar").configurations
            return Proposal(t=range(len(q)), q=q, evaluations=evaluations, convergence=convergence)

        return counted

    told = er.plan(scene, task="first", planner=counts(np.int64(5), [(np.int32(3), np.float32(1.5))]))
    assert (told.evaluations, told.convergence) == (5, [(3, 1.5)])
    for evaluations, convergence in (("many", None), (-1, None), (5, [1, 2]), (5, "abc")):
        with pytest.raises(er.PlannerFault, match=r"planner .*counted: "):
            er.plan(scene, task="first", planner=counts(evaluations, convergence))


def test_the_stops_of_its_motion_are_counted(scene: er.Scene) -> None:
    def turns(scene: er.Scene, task: str, **_: object) -> Proposal:
        return straight_turns(scene, er.plan(scene, task=task, planner="dstar").configurations[::4])

    plan = er.plan(scene, task="second", planner=turns)
    assert plan.stops == len(plan.motion.starts) - 1


def test_what_a_planner_says_on_purpose_is_handed_on(scene: er.Scene) -> None:
    with pytest.raises(er.NotFound, match="nothing here"):
        er.plan(scene, task="first", planner=compare_plugins.crashes)
    with pytest.raises(er.BadSetting, match="planner honest has no option 'shift_by'; known: shift"):
        er.plan(scene, task="first", planner=honest, options={"shift_by": 1})
    for value in ("much", True, None, [1.0]):
        with pytest.raises(er.BadSetting, match=r"option shift of planner honest is .*, it must be of type float"):
            er.plan(scene, task="first", planner=honest, options={"shift": value})  # type: ignore[dict-item]
    assert er.plan(scene, task="first", planner=honest, options={"shift": 0}).settings["shift"] == 0
    with pytest.raises(er.BadSetting, match="gap is for planners that search in rounds"):
        er.plan(scene, task="first", planner=honest, gap=0.1)
    with pytest.raises(er.UnknownTask, match="no task is called 'third'"):
        er.plan(scene, task="third", planner=honest)
    with pytest.raises(er.PlannerFault):
        er.plan(scene, task="first", planner=honest, options={"shift": 0.3})


def test_callables_are_compared(scenes: Path, tmp_path: Path, folder: Path) -> None:
    path = scenes / "paper-standin.yaml"
    planners = [compare_plugins.detour, compare_plugins.lies, *all_chosen("dstar")]
    found = compare([path], planners=planners, seeds=[0], tasks=["first"], out=tmp_path / "out", jobs=1)  # type: ignore[list-item]
    became = {row.planner: row.failure for row in found.rows}
    assert became == {"tests.compare_plugins.detour": None, "tests.compare_plugins.lies": "unsafe", "dstar": None}
    again = compare([path], planners=planners, seeds=[0], tasks=["first"], out=tmp_path / "out", jobs=1)  # type: ignore[list-item]
    assert (again.fresh, again.rows) == (0, found.rows)
    with pytest.raises(er.BadSetting, match="top level of a module or of a script"):
        compare([path], planners=[lambda *_, **__: None], out=tmp_path / "none")  # type: ignore[list-item,misc]
    assert folder.exists()


def test_a_script_compares_its_own_function(scenes: Path, tmp_path: Path) -> None:
    script = tmp_path / "mine.py"
    script.write_text(f"""\
from pathlib import Path
import elbowroom as er
from elbowroom.compare import compare

def mine(scene, task, *, seed, **_):
    return er.plan(scene, task=task, planner="dstar", seed=seed)

if __name__ == "__main__":
    scene = Path({str(scenes / "paper-standin.yaml")!r})
    found = compare([scene], planners=[mine], seeds=[0], tasks=["first"], out=Path({str(tmp_path / "out")!r}), jobs=1)
    print([(row.planner, row.success) for row in found.rows])
""")
    told = subprocess.run([sys.executable, script], check=True, capture_output=True, text=True, timeout=120)
    assert told.stdout == "[('__main__.mine', True)]\n"


def command(*arguments: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-c", "from elbowroom._cli import main; main()", "plan", *arguments]
    return subprocess.run(line, check=False, capture_output=True, text=True, timeout=120)


@pytest.mark.usefixtures("folder")
def test_the_command_line_plans_with_those_that_are_installed(scenes: Path) -> None:
    scene = str(scenes / "paper-standin.yaml")
    good = command(scene, "--task", "first", "--planner", "detour:tries=2", "--json")
    assert good.returncode == 0, good.stderr
    assert '"planner": "detour"' in good.stdout
    for planner, words in [
        ("lies", "error: planner lies: "),
        ("raises", "error: planner raises failed: RuntimeError: two lines | and a bar"),
        ("gone", "error: planner gone cannot be loaded: ModuleNotFoundError"),
        ("number", "error: planner number cannot be loaded: "),
        ("text", "error: planner text returned str, not a Proposal"),
    ]:
        bad = command(scene, "--task", "first", "--planner", planner)
        assert bad.returncode == 2, (planner, bad.stderr)
        assert bad.stderr.startswith(words), bad.stderr
        assert len(bad.stderr.splitlines()) == 1, bad.stderr
    refused = command(scene, "--task", "first", "--planner", "refuses")
    assert (refused.returncode, "refuses serves no arm" in refused.stderr) == (2, True)


def test_a_scene_that_moves_is_certified_by_no_planner(scenes: Path) -> None:
    """Not even one that hands back what is safe while everything stands still."""
    moving = er.Scene.load(scenes / "late.yaml")
    task = next(iter(moving.tasks))
    still = moving.replace(obstacles=tuple(one.replace(motion=None) for one in moving.obstacles))
    with pytest.raises(er.BadSetting, match="moves"):
        er.plan(moving, task=task, planner=lambda *_, **__: er.plan(still, task=task))  # type: ignore[arg-type,misc]


def test_straight_turns_are_a_motion(scene: er.Scene) -> None:
    def turns(scene: er.Scene, task: str, **_: object) -> Proposal:
        return straight_turns(scene, er.plan(scene, task=task, planner="dstar").configurations)

    plan = er.plan(scene, task="second", planner=turns)
    assert plan.verdict.safe
