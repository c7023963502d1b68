"""Processes made by fork and by spawn plan as any other."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from pathlib import Path

import pytest

import elbowroom as er


@pytest.mark.skipif(not hasattr(os, "fork"), reason="a system without fork")
def test_a_child_made_by_fork_plans_as_its_parent_does(tmp_path: Path) -> None:
    # In an interpreter of its own: this one may have threads, with which one must not fork.
    script = tmp_path / "forks.py"
    script.write_text("""\
import os
import sys

import elbowroom as er

scene = er.Scene.example("paper-standin")
fine = scene.replace(grid=scene.grid.replace(step=0.0025))
er.Replanner(er.Scene.example("late"))
plans = [er.plan(fine, task="first"), er.plan(scene, task="second", planner="optimal")]


def child(generations):
    er.Replanner(er.Scene.example("late"))
    again = [er.plan(fine, task="first", timeout=60), er.plan(scene, task="second", planner="optimal", timeout=60)]
    assert again == plans
    if generations > 1:
        forked(generations - 1)


def forked(generations):
    process = os.fork()
    if process == 0:
        code = 1
        try:
            child(generations)
            code = 0
        finally:
            os._exit(code)
    assert os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) == 0


forked(2)
forked(1)
assert er.plan(fine, task="first") == plans[0]
""")
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr


def planned(scene: er.Scene) -> er.Plan:
    return er.plan(scene, task="first", timeout=60)


@pytest.mark.parametrize("method", ["spawn", "forkserver"])
def test_scenes_and_plans_go_from_process_to_process(method: str) -> None:
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"a system without {method}")
    scene = er.Scene.example("paper-standin")
    with multiprocessing.get_context(method).Pool(1) as pool:
        assert pool.apply(er.plan, (scene,), {"task": "first"}) == planned(scene)
