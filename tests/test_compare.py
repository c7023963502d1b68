from __future__ import annotations

import json
import math
import os
import re
import signal
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

import elbowroom as er
from elbowroom._core import ASSUMED_LIMITS, interpolated, mismatch
from elbowroom._own_planners import OWN
from elbowroom.compare import Row, Table, compare, straight_turns
from elbowroom.compare._local import run_locally
from elbowroom.compare._measure import Lengths, lengths
from elbowroom.compare._row import Problem
from elbowroom.compare._run import run
from elbowroom.compare._table import DamagedTable, parquet_is_there, write_parquet
from elbowroom.compare._worker import Batch
from elbowroom.planners import Choice, all_chosen, chosen

TESTS = Path(__file__).parent


def problem(choice: Choice, scene: Path, *, task: str = "first", seed: int = 0, **asked: Any) -> Problem:
    given: dict[str, Any] = {"budget": None, "timeout": None, "objective": "tip"} | asked
    return Problem.of(choice, scene=er.Scene.load(scene), file=str(scene), task=task, seed=seed, **given)


def once(text: str, scene: Path, **asked: Any) -> Row:
    return run(problem(chosen(text), scene, **asked), er.Scene.load(scene))


def lasting(rows: list[Row]) -> list[dict[str, Any]]:
    return [row.lasting for row in rows]


@pytest.mark.parametrize("planner", [name for name, kind in OWN.items() if kind.least == 2])
def test_lengths_are_those_of_the_core(standin: er.Scene, planner: Any) -> None:
    for task in standin.tasks:
        for objective in ("tip", "joint", "time"):
            plan = er.plan(standin, task=task, planner=planner, objective=objective)  # type: ignore[arg-type]
            assert lengths(standin, plan.motion).by(objective) == pytest.approx(plan.cost, rel=1e-7)
            assert plan.verdict is not None
            assert mismatch(standin, task, plan.motion, plan.verdict.posture_changes) is None


def test_lengths_in_closed_form(standin: er.Scene) -> None:
    still, _, _ = interpolated(np.zeros(1), np.array([[0.1, 0.2]]))
    assert lengths(standin, still) == Lengths(0.0, 0.0, 0.0)
    # Joint 2 alone swings the tip on a circle of radius 0.25; joint 1 the stretched arm on one of 0.5.
    swings = er.check(standin, t=[0.0, 2.0, 3.0], q=[[0.0, 1.0], [0.0, 0.0], [0.5, 0.0]])
    found = lengths(standin, swings.motion)
    assert (found.tip, found.joint, found.time) == pytest.approx((0.25 + 0.25, 1.5, 3.0), rel=1e-12)


def test_a_motion_that_does_another_task_misses(standin: er.Scene) -> None:
    plan = er.plan(standin, task="first")
    assert plan.verdict is not None
    assert "m from the start" in str(mismatch(standin, "second", plan.motion, plan.verdict.posture_changes))
    end = plan.configurations[-1]
    for posture, fits in (("up", end[1] < 0), ("down", end[1] > 0), ("any", True)):
        asked = er.Task(start=(0.4, 0.1), goal=(-0.45, -0.15), posture=posture)  # type: ignore[arg-type]
        scene = er.Scene(arm=standin.arm, grid=standin.grid, obstacles=standin.obstacles, tasks={"first": asked})
        assert (mismatch(scene, "first", plan.motion, plan.verdict.posture_changes) is None) == fits
    turned = er.Configuration((float(end[0]) + math.tau, float(end[1])))
    asked = er.Task(start=(0.4, 0.1), goal=turned)
    scene = er.Scene(arm=standin.arm, grid=standin.grid, obstacles=standin.obstacles, tasks={"first": asked})
    assert mismatch(scene, "first", plan.motion, plan.verdict.posture_changes) is None
    asked = er.Task(start=(0.4, 0.1), goal=er.Configuration((float(end[0]), float(end[1]) + 0.01)))
    scene = er.Scene(arm=standin.arm, grid=standin.grid, obstacles=standin.obstacles, tasks={"first": asked})
    assert (
        mismatch(scene, "first", plan.motion, plan.verdict.posture_changes) == "the motion is 0.0100 rad from the goal"
    )


def test_straight_turns_keep_the_limits_and_are_as_fast_as_they_allow(standin: er.Scene) -> None:
    random = np.random.default_rng(0)
    for _ in range(100):
        stated = {name: float(10.0 ** random.uniform(-1, 2)) for name in ("velocity", "acceleration", "jerk")}
        joints = tuple(er.Joint(continuous=True, **stated) for _ in range(2))
        scene = er.Scene(arm=er.Arm(links=(0.25, 0.25), joints=joints), grid=standin.grid)
        corners = np.cumsum(random.normal(size=(4, 2)), axis=0)
        corners[2] = corners[1]
        proposal = straight_turns(scene, corners)
        assert len(np.asarray(proposal.t)) == 3
        judged = er.check(scene, t=proposal.t, q=proposal.q, v=proposal.v, a=proposal.a)
        assert judged.safe, judged.verdict.violations
        assert lengths(scene, judged.motion).joint == pytest.approx(
            sum(math.dist(a, b) for a, b in pairwise(corners.tolist())), rel=1e-9
        )
        # A tick less for any turn, and some limit is broken.
        times = np.asarray(proposal.t)
        faster = times - np.array([0.0, 0.0, 0.0101])
        if faster[2] > faster[1]:
            assert not er.check(scene, t=faster, q=proposal.q, v=proposal.v, a=proposal.a).safe
    assumed = er.plan(standin, task="first").assumed_limits
    assert {rate: value for _, rate, value in assumed} == ASSUMED_LIMITS


def asked(folder: Path, out: Path, **more: Any) -> Any:
    given: dict[str, Any] = {"planners": all_chosen("dstar,dstar-pso"), "seeds": range(3), "out": out} | more
    files = given.pop("scenes", [folder / "paper-standin.yaml", folder / "paper-table1.yaml"])
    return compare(files, **given)


def test_rows_are_the_same_in_any_number_of_processes_and_after_a_stop(scenes: Path, tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    whole = asked(scenes, tmp_path / "two", jobs=2, show=lambda *count: seen.append(count))
    assert seen == [(i, 24) for i in range(25)]
    assert (whole.fresh, whole.beside, whole.healed, len(whole.rows)) == (24, 0, False, 24)
    in_process = [run(row, er.Scene.load(row.scene)) for row in whole.rows]
    assert lasting(in_process) == lasting(whole.rows)
    text = whole.table.read_text()
    assert [json.loads(line)["seed"] for line in text.splitlines()][:6] == [0, 1, 2, 0, 1, 2]

    # Stopped half-way by what shows the progress, in the middle of a line then.
    class Stop(Exception):
        pass

    def stop(done: int, _all: int) -> None:
        if done == 9:
            raise Stop

    with pytest.raises(Stop):
        asked(scenes, tmp_path / "one", jobs=1, show=stop)
    table = tmp_path / "one" / "rows.jsonl"
    finished = table.read_text().splitlines()
    assert len(finished) == 9
    with table.open("a") as file:
        file.write(text.splitlines()[-1][:200])
    again = asked(scenes, tmp_path / "one", jobs=1)
    assert (again.fresh, again.healed) == (15, True)
    assert lasting(again.rows) == lasting(whole.rows)
    assert set(finished) <= set(table.read_text().splitlines())
    before = table.read_bytes()
    third = asked(scenes, tmp_path / "one")
    assert (third.fresh, third.healed, table.read_bytes()) == (0, False, before)

    fewer = asked(scenes, tmp_path / "one", seeds=range(1), planners=all_chosen("dstar"))
    assert (fewer.fresh, fewer.beside, len(fewer.rows)) == (0, 20, 4)
    some = asked(scenes, tmp_path / "one", tasks=["second"])
    assert (some.fresh, {row.task for row in some.rows}, len(some.rows)) == (0, {"second"}, 12)
    other = asked(scenes, tmp_path / "one", seeds=range(1), planners=all_chosen("dstar"), timeout=60)
    assert (other.fresh, other.beside) == (4, 24)


def test_a_kill_loses_no_finished_row(scenes: Path, tmp_path: Path) -> None:
    command = [
        sys.executable,
        "-c",
        "from elbowroom._cli import main; main()",
        "compare",
        scenes / "paper-standin.yaml",
    ]
    command += ["--planners", "dstar-pso", "--seeds", "400", "--out", tmp_path]
    table = tmp_path / "rows.jsonl"
    running = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        until = time.monotonic() + 60.0
        while not (table.exists() and table.read_bytes().count(b"\n") >= 5) and time.monotonic() < until:
            time.sleep(0.05)
    finally:
        running.send_signal(signal.SIGKILL)
        running.wait()
    kept = table.read_bytes().count(b"\n")
    assert 5 <= kept < 800
    file = Table(table)
    file.abandon()
    assert len(file.rows) in (kept, kept + 1)
    assert all(row.success for row in file.rows.values())


def test_workers_leave_the_environment_alone(scenes: Path) -> None:
    before = dict(os.environ)
    scene = scenes / "paper-standin.yaml"
    batch = Batch(str(scene), scene.read_text(), [problem(chosen("dstar"), scene)])
    rows = run_locally([batch], jobs=1)
    assert next(rows).success
    rows.close()  # type: ignore[attr-defined]
    assert dict(os.environ) == before


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"seeds": []}, "no seeds to compare"),
        ({"seeds": [1, 1]}, "different whole numbers"),
        ({"seeds": [-1]}, "different whole numbers"),
        ({"planners": []}, "no planners"),
        ({"scenes": []}, "no scenes"),
        ({"tasks": []}, "no tasks"),
        ({"tasks": ["first", "third"]}, "no task 'third', only first, second"),
        ({"budget": 0}, "budget is 0"),
        ({"jobs": 0}, "jobs is 0"),
        ({"timeout": math.nan}, "timeout is nan"),
        ({"timeout": -1.0}, "timeout is -1.0"),
        ({"objective": "fun"}, "tip, joint or time"),
        ({"on": "moon"}, "local or ray"),
    ],
)
def test_settings_that_make_no_sense_are_refused(scenes: Path, tmp_path: Path, wrong: Any, words: str) -> None:
    with pytest.raises(er.BadSetting, match=words):
        asked(scenes, tmp_path / "out", **wrong)
    assert not (tmp_path / "out").exists()


def test_scenes_without_tasks_and_twice_the_same_are_refused(scenes: Path, tmp_path: Path) -> None:
    text = (scenes / "paper-standin.yaml").read_text()
    (tmp_path / "bare.yaml").write_text(text[: text.index("tasks:")])
    (tmp_path / "copy.yaml").write_text(f"# Said again.\n{text}")
    with pytest.raises(er.BadSetting, match="has no tasks"):
        asked(scenes, tmp_path / "out", scenes=[tmp_path / "bare.yaml"])
    with pytest.raises(er.BadSetting, match="are the same scene"):
        asked(scenes, tmp_path / "out", scenes=[scenes / "paper-standin.yaml", tmp_path / "copy.yaml"])


def test_damaged_lines_are_named_or_healed(scenes: Path, tmp_path: Path) -> None:
    rows = [once("dstar", scenes / "paper-standin.yaml", seed=seed) for seed in range(3)]
    path = tmp_path / "deep" / "rows.jsonl"
    table = Table(path)
    for row in reversed(rows):
        table.add(row)
    assert path.read_text().splitlines() == [row.as_line() for row in reversed(rows)]
    table.close()
    good = path.read_bytes()
    assert good.decode().splitlines() == [row.as_line() for row in rows]
    for cut in range(1, len(rows[2].as_line()) + 1, 37):
        path.write_bytes(good[:-cut])
        table = Table(path)
        table.abandon()
        # With nothing but the end of the line missing, the row is whole.
        assert (len(table.rows), table.healed) == (3 if cut == 1 else 2, True)
        assert path.read_bytes() == (good if cut == 1 else good[: good.rindex(b"\n", 0, -1) + 1])
    lines = good.splitlines(keepends=True)
    for damage, words in (
        (b"{\n", "no JSON"),
        (b"\xff\n", "no JSON"),
        (b"\n", "no JSON"),
        (b"[1]\n", "no JSON object"),
        (b"[" * 100_000 + b"\n", "no JSON"),
        (b"{}\n", "column scene is missing"),
        (lines[1].replace(b'{"scene"', b'{"more": 1, "scene"'), "no such column: more"),
        (re.sub(rb'"cost": [^,]+', b'"cost": "abc"', lines[1]), "column cost: expected `float | null`, got `str`"),
        (re.sub(rb'"success": \w+', b'"success": "no"', lines[1]), "column success: expected `bool`, got `str`"),
        (re.sub(rb'"seed": \d+', b'"seed": 1.5', lines[1]), "column seed: expected `int`, got `float`"),
        (re.sub(rb'"objective": "tip"', b'"objective": "fun"', lines[1]), "column objective: invalid enum value 'fun'"),
    ):
        path.write_bytes(lines[0] + damage + lines[2])
        with pytest.raises(DamagedTable, match=f"rows.jsonl:2: .*{re.escape(words)}") as caught:
            Table(path)
        assert caught.value.line == 2
        assert path.read_bytes() == lines[0] + damage + lines[2]


@pytest.mark.skipif(not parquet_is_there(), reason="pyarrow is not installed")
def test_parquet_holds_the_rows(scenes: Path, tmp_path: Path) -> None:
    import pyarrow.parquet as pq

    one, other = once("dstar", scenes / "paper-standin.yaml"), once("dstar", scenes / "paper-table1.yaml")
    told = msgspec.structs.replace(
        one, convergence=[(1, 2.5), (7, 1.5)], evaluations=7, settings={"by": 0.5, "stops": True}, budget=9
    )
    rows = [one, other, told]
    read = pq.read_table(write_parquet(rows, tmp_path / "rows.parquet")).to_pylist()
    for values, row in zip(read, rows, strict=True):
        for name in ("settings", "stages_s"):
            values[name] = json.loads(values[name])
        assert values == json.loads(row.as_line())
