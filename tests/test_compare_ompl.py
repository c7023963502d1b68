from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import elbowroom as er
from elbowroom.compare._row import Problem, Row
from elbowroom.compare._run import run
from elbowroom.planners import chosen

pytest.importorskip("ompl")

from elbowroom.compare._ompl_planner import configurations, plan


def row(scene: Path, text: str = "ompl", *, task: str = "first", seed: int = 0, timeout: float = 20.0) -> Row:
    loaded = er.Scene.load(scene)
    asked = Problem.of(
        chosen(text),
        scene=loaded,
        file=str(scene),
        task=task,
        seed=seed,
        budget=None,
        timeout=timeout,
        objective="tip",
    )
    return run(asked, loaded)


def test_a_seed_gives_one_path_whatever_came_before(scenes: Path) -> None:
    scene = scenes / "paper-standin.yaml"
    first = [row(scene, seed=seed) for seed in (0, 1, 2)]
    again = [row(scene, seed=seed) for seed in (2, 0, 1)]
    assert [r.lasting for r in first] == [again[i].lasting for i in (1, 2, 0)]
    assert len({r.cost for r in first}) == 3
    assert "ompl 2" in first[0].provider
    assert set(first[0].stages_s) == {"search", "simplify", "verdict"}


def test_whole_motions_are_safe_and_states_alone_are_not(scenes: Path) -> None:
    for name in ("paper-standin", "paper-table1"):
        for task in ("first", "second"):
            rows = [row(scenes / f"{name}.yaml", "ompl:continuous=true", task=task, seed=seed) for seed in range(3)]
            assert all(r.success for r in rows), [r.message for r in rows]
    coarse = [row(scenes / "narrow.yaml", "ompl:resolution=0.1", seed=seed) for seed in range(6)]
    assert {r.failure for r in coarse} >= {"unsafe"}
    assert all(r.found for r in coarse)


def test_what_ompl_cannot_do_is_a_failure_of_its_row(scenes: Path, tmp_path: Path) -> None:
    scene = scenes / "paper-standin.yaml"
    unknown = row(scene, "ompl:algorithm=Magic")
    assert unknown.failure == "refused"
    assert "no planner 'Magic'; known: " in (unknown.message or "")
    assert "RRTConnect" in (unknown.message or "")
    text = scene.read_text()
    for old, new, failure, words in (
        ("goal: [-45, -15]}", "goal: [-45, -15], posture: keep}", "refused", "cannot keep"),
        ("goal: [-45, -15]}", "goal: [-80, -15]}", "not_found", "no free configuration at the goal"),
        ("start: [40, 10]", "start: [22, 22]", "not_found", "no free configuration at the start"),
    ):
        other = tmp_path / "other.yaml"
        other.write_text(text.replace(old, new))
        found = row(other)
        assert (found.failure, found.success) == (failure, False)
        assert words in (found.message or "")
    # Circles to both sides of link 1 cut the configurations apart: there is no way.
    walls = "obstacles:\n  - circle: {center: [0, 20], radius: 4}\n  - circle: {center: [0, -20], radius: 4}\n"
    shut = tmp_path / "shut.yaml"
    shut.write_text(text[: text.index("obstacles:")] + walls + text[text.index("tasks:") :])
    late = row(shut, timeout=0.3)
    assert (late.failure, late.message) == ("timed_out", "nothing found within 0.3 s")


@pytest.mark.parametrize("posture", ["up", "down"])
def test_the_posture_asked_for_is_reached(standin: er.Scene, posture: Any) -> None:
    scene = standin.replace(tasks={"go": er.Task(start=(0.4, 0.1), goal=(-0.45, -0.15), posture=posture)})
    found = plan(scene, "go", seed=3, timeout=20.0, budget=None, objective="tip", continuous=True)
    bend = math.remainder(float(np.asarray(found.q)[-1, 1]), math.tau)
    assert (bend < 0) == (posture == "up")


def test_configurations_are_at_the_place_and_within_the_limits(standin: er.Scene) -> None:
    random = np.random.default_rng(0)
    bend = math.radians(150)
    wide = (er.Joint(min=-2.0 * math.tau, max=math.tau), er.Joint(min=-bend, max=bend))
    scene = standin.replace(arm=er.Arm(links=(0.3, 0.2), joints=wide, base=(0.1, -0.2)), obstacles=())
    counts = set()
    for _ in range(200):
        x, y = random.uniform(-0.6, 0.6, 2)
        found = configurations(scene, (x, y))
        counts.add(len(found))
        for q in found:
            np.testing.assert_allclose(scene.link_ends(q[None])[0, -1], (x, y), atol=1e-12)
            assert -2.0 * math.tau <= q[0] <= math.tau
            assert abs(q[1]) <= bend
        assert len({tuple(q) for q in found}) == len(found)
    # Three turns of joint 1 for each posture, or no way to get there.
    assert counts == {0, 6}
