"""No input ends in a traceback or with an exit code that says something else."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import elbowroom as er
from elbowroom._cli.failure import FAULT, reported
from elbowroom._cli.main import app
from elbowroom._whole_files import write_whole, written_whole

COMMAND = [sys.executable, "-c", "from elbowroom_command import main; main()"]


def run(*arguments: str | Path, **options: object) -> subprocess.CompletedProcess[str]:
    command = [*COMMAND, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=120, **options)  # type: ignore[call-overload, no-any-return]


COMMANDS = {
    "plan": ("elbowroom._plan", "plan", ["plan", "SCENE", "--task", "first"]),
    "check": ("elbowroom._check", "check_messages", ["check", "SCENE", "SCENE"]),
    "map": ("elbowroom._free_space", "free_space", ["map", "SCENE"]),
    "follow": ("elbowroom.follow", "follow", ["follow", "SCENE"]),
    "paper": ("elbowroom._paper", "reproduce", ["paper"]),
    "compare": ("elbowroom.compare", "compare", ["compare", "SCENE"]),
    "generate": ("elbowroom.compare._generate", "write_scenes", ["generate", "--out", "OUT"]),
}


@pytest.mark.parametrize("command", COMMANDS)
def test_a_fault_of_ours_is_told_as_such(command: str, scenes: Path, tmp_path: Path) -> None:
    module, name, words = COMMANDS[command]
    assert set(COMMANDS) == {kind.name for kind in app.registered_commands}
    words = [word.replace("SCENE", str(scenes / "paper-standin.yaml")).replace("OUT", str(tmp_path)) for word in words]
    broken = f"""\
import importlib, sys
module = importlib.import_module({module!r})
def broken(*_, **__):
    raise ZeroDivisionError("a line\\nand another")
setattr(module, {name!r}, broken)
sys.argv = ["elbowroom", *{words!r}]
from elbowroom._cli import main
main()
"""
    failed = subprocess.run([sys.executable, "-c", broken], capture_output=True, text=True, timeout=120)
    assert failed.returncode == FAULT == 70
    first, second = failed.stderr.splitlines()
    assert first.startswith(
        "error: a fault of elbowroom itself, not of what it was given: ZeroDivisionError: a line and another (_cli/"
    )
    assert second.startswith("please report it: this message, the command, the files it was given; elbowroom 0.")
    assert failed.stdout == ""


class Panic(BaseException):
    """What PyO3 raises for a panic is no Exception either."""


@pytest.mark.parametrize("error", [Panic("lost"), MemoryError(), RecursionError("deep"), er.InternalError("a bug")])
def test_faults_of_all_kinds_have_their_exit_code(error: BaseException, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(BaseException) as caught, reported():  # noqa: PT011 (an exit of typer's)
        raise error
    assert getattr(caught.value, "exit_code", None) == FAULT
    assert len(capsys.readouterr().err.splitlines()) == 2


def test_a_panic_of_the_core_prints_nothing_of_its_own() -> None:
    # Poisoned by hand: a configuration whose joints are not those of the arm is a panic in the core.
    code = """\
import elbowroom as er, numpy as np
scene = er.Scene.example("paper-standin")
try:
    scene.link_clearances(np.zeros((1, 5)))
except BaseException as error:
    print(type(error).__name__)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0
    assert done.stderr == ""


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--duration", "1e300"), "duration is 1e300 s, it must be from 0.000001 to 1000000 s"),
        (("--duration", "1e10", "--out", "OUT"), "a motion of 1e+10 s does not fit into trajectory.csv"),
        (("--duration", "1e5", "--out", "OUT"), "at most 9999.99 s do"),
        (("--out", ""), "the name of the folder is empty; for the one you are in, write ."),
        (("--out", __file__), "is a file; a folder is needed"),
        (("--out", " "), "the name of the folder is empty"),
        (("--seed", "1_0"), "'1_0' is not a whole number"),
        (("--seed", "0x10"), "'0x10' is not a whole number"),
        (("--seed", "True"), "'True' is not a whole number"),
        (("--seed", "9" * 5000), "is not a whole number"),
        (("--timeout", "١"), "is not a number such as 2"),
        (("--timeout", "1_0"), "is not a number such as 2"),
        (("--duration", "1_0"), "a number of seconds, or fastest"),
        (("--planner", "dstar-pso:candidates=1_0"), "must be a whole number"),
        (("--planner", "dstar-pso:candidates=١"), "must be a whole number"),
    ],
)
def test_options_out_of_all_measure_are_refused(
    scenes: Path, tmp_path: Path, arguments: tuple[str, ...], words: str
) -> None:
    given = [argument.replace("OUT", str(tmp_path / "out")) for argument in arguments]
    failed = run("plan", scenes / "paper-standin.yaml", "--task", "first", *given, cwd=tmp_path)
    assert failed.returncode == 2
    assert words in failed.stderr
    assert "Traceback" not in failed.stderr
    assert list(tmp_path.iterdir()) == []


def test_durations_beyond_all_measure_are_refused(standin: er.Scene, tmp_path: Path) -> None:
    for duration in (1e300, 1e7, float("inf"), 0.0, 1e-300):
        for make in (er.plan, er.plan_as_in_paper):
            with pytest.raises(er.BadSetting, match=r"must be from 0\.000001 to 1000000 s"):
                make(standin, task="first", duration=duration)
    slow = tuple(joint.replace(velocity=1e-6) for joint in standin.arm.joints)
    crawling = standin.replace(arm=standin.arm.replace(joints=slow))
    from elbowroom._plan_files import write_plan

    with pytest.raises(er.BadSetting, match="does not fit"):
        write_plan(er.plan(crawling, task="second", planner="dstar"), tmp_path)
    assert list(tmp_path.iterdir()) == []


DEEP = {
    "cell.csv": "time_s,q1_rad,q2_rad\n0,0,0\n1,0," + "1" * 140_000 + "\n",
    "text.csv": 'time_s,q1_rad,q2_rad\n0,0,"' + "x" * 140_000 + '"\n',
    "digits.json": '{"joint_names": ["j1", "j2"], "points": [{"time_from_start": '
    + "7" * 5000
    + ', "positions": [0, 0]}]}',
    "deep.json": '{"joint_names": ["j1", "j2"], "points": ' + "[" * 100_000,
    "deep.yaml": "points: " + "[" * 100_000,
    "exponent.json": '{"joint_names": ["j1", "j2"], "points": [{"time_from_start": 1e-999999999, "positions": [0, 0]}, '
    '{"time_from_start": 1e999999999, "positions": [0, 0]}]}',
    "exponent.csv": "time_s,q1_rad,q2_rad\n1e-999999999,0,0\n1e999999999,0,0\n",
    "zero.json": "\0",
    "string.json": '"time_s,q1_rad,q2_rad\\n0,2.5,0\\n1,2.6,0\\n"',
    "nothing.yaml": "---\n---\n",
}


@pytest.mark.parametrize("name", DEEP)
def test_hostile_trajectories_are_refused_in_a_line(scenes: Path, tmp_path: Path, name: str) -> None:
    file = tmp_path / name
    file.write_text(DEEP[name], encoding="utf-8")
    failed = run("check", scenes / "paper-standin.yaml", file)
    assert failed.returncode == 2
    assert len(failed.stderr.splitlines()) == 1
    assert failed.stdout == ""


@pytest.mark.parametrize("scalar", ["true", "1_0", "0x10", "١٠", "1:30", "'1'", ".inf"])
def test_what_is_no_number_is_none_in_a_scene(scenes: Path, scalar: str) -> None:
    text = (scenes / "paper-standin.yaml").read_text()
    assert "start: [40, 10]" in text
    with pytest.raises(er.SceneError, match=r"tasks\.first\.start"):
        er.Scene.parse(text.replace("start: [40, 10]", f"start: [{scalar}, 10]"))


def limit_files() -> None:
    import resource

    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a system without /dev/full")
def test_a_full_disk_leaves_no_half_of_a_file(scenes: Path, tmp_path: Path) -> None:
    old = tmp_path / "trajectory.csv"
    old.write_text("as it was\n")
    arguments = ("plan", scenes / "paper-standin.yaml", "--task", "first", "--out", tmp_path)
    failed = run(*arguments, preexec_fn=limit_files)
    assert failed.returncode == 2
    assert failed.stderr.splitlines()[-1].startswith(f"error: {tmp_path}/")
    assert "Traceback" not in failed.stderr
    assert old.read_text() == "as it was\n"
    for path in tmp_path.iterdir():
        assert path == old or (path.suffix == ".json" and json.loads(path.read_text()))
    with open("/dev/full", "w") as nowhere:
        full = subprocess.run([*COMMAND, *map(str, arguments[:4])], stdout=nowhere, stderr=subprocess.PIPE, text=True)
    assert (full.returncode, full.stderr) == (2, "error: output: No space left on device\n")


def test_files_are_written_whole_or_not_at_all(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("old")
    os.link(path, tmp_path / "as it was")
    assert write_whole(path, "first\r\n").read_bytes() == b"first\r\n"
    # Nothing was written over the old file, which a reader may still be in.
    assert (tmp_path / "as it was").read_text() == "old"
    (tmp_path / "as it was").unlink()

    def half() -> None:
        with written_whole(path) as fresh:
            assert fresh.suffix == ".txt"
            fresh.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        half()
    assert [other.name for other in tmp_path.iterdir()] == ["a.txt"]
    assert path.read_bytes() == b"first\r\n"
    with pytest.raises(OSError, match="folder") as caught:
        write_whole(tmp_path / "no folder" / "a.txt", "x")
    assert caught.value.filename == str(tmp_path / "no folder" / "a.txt")


@pytest.mark.parametrize("module", ["elbowroom._cli.main", "numpy", "elbowroom._core", "elbowroom._plan"])
def test_ctrl_c_while_it_starts_is_no_fault(module: str, scenes: Path) -> None:
    # Whatever is imported when the signal comes.
    code = f"""\
import builtins, os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
real = builtins.__import__
def imported(name, *rest, **more):
    if name == {module!r}:
        os.kill(os.getpid(), signal.SIGINT)
    return real(name, *rest, **more)
builtins.__import__ = imported
sys.argv = ["elbowroom", "plan", {str(scenes / "paper-standin.yaml")!r}, "--task", "first"]
from elbowroom_command import main
main()
"""
    stopped = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert (stopped.returncode, stopped.stderr) == (130, "error: interrupted\n")


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="a system without /dev/zero")
def test_what_never_ends_is_read_no_further_than_a_file_may_be_long(
    standin: er.Scene, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("elbowroom._trajectory_files.LARGEST_FILE", 1)
    with pytest.raises(er.TrajectoryError, match="/dev/zero: more than 1 MiB"):
        er.check_file(standin, "/dev/zero")


def test_arrays_of_many_kinds_end_in_errors_of_ours(standin: er.Scene) -> None:
    for t, q in (
        ([], []),
        ([], np.empty((0, 2))),
        ([0.0, np.nan], np.zeros((2, 2))),
        ([0.0, 1.0], [[0, 0], [0, np.inf]]),
    ):
        with pytest.raises(er.TrajectoryError):
            er.check(standin, t=t, q=q)


@pytest.mark.parametrize("name", ["a\0b", "", "\ud800"])
def test_paths_that_are_none_are_told_of_scenes_and_trajectories(name: str, standin: er.Scene) -> None:
    with pytest.raises(er.SceneError, match="cannot be read"):
        er.Scene.load(name)
    with pytest.raises(er.TrajectoryError, match="cannot be read"):
        er.check_file(standin, name)
