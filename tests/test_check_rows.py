"""Rows of other tools: motions at their limits are not refused for how they are written; faster ones are found out."""

from __future__ import annotations

import json
import pickle
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

import elbowroom as er
from elbowroom._cli.main import app
from elbowroom._plan_files import as_csv
from elbowroom._rounding import rounding_of
from elbowroom._trajectory_samples import TrajectorySamples
from tests.smooth_motions import Told, cell_of, double_s, rows_of

PERIODS = (0.001, 0.002, 0.004, 0.008, 0.01)
DECIMALS = (3, 4, 5, 6, 7, 8, 9, None)
WAYS = [
    *(Told(period, decimals, None, stated) for period in PERIODS for decimals in DECIMALS for stated in (0, 1, 2)),
    *(Told(period, decimals, counts) for period in PERIODS for decimals in (6, None) for counts in (1024, 4096, 16384)),
]
"""How tools write: by decimals, by what they state, and as counts of an encoder."""


def kinds(check: er.Check) -> set[str]:
    return {violation.kind for violation in check.verdict.violations}


def unjudged(check: er.Check) -> set[str]:
    return {one.rate for one in check.verdict.unjudged}


def test_motions_at_their_limits_are_never_refused_for_how_they_were_written() -> None:
    random = np.random.default_rng(1806)
    for i in range(2000):
        joints = [double_s(random), double_s(random)]
        told = WAYS[i % len(WAYS)]
        check = er.check(cell_of(joints), **rows_of(joints, told))
        assert check.safe, (i, told, [violation.message for violation in check.verdict.violations])


@pytest.mark.parametrize(("faster", "least"), [(1.05, 0.97), (1.1, 0.99), (1.5, 1.0)])
def test_motions_beyond_their_limits_are_found_out(faster: float, least: float) -> None:
    random = np.random.default_rng(1807)
    found: Counter[bool] = Counter()
    for i in range(300):
        joints = [double_s(random), double_s(random)]
        check = er.check(cell_of(joints), **rows_of(joints, WAYS[7 * i % len(WAYS)], faster=faster))
        found[check.safe] += 1
    assert found[False] >= least * 300, found


@pytest.mark.parametrize("period", PERIODS)
def test_what_digits_and_spacing_prove_is_never_missed(period: float) -> None:
    # Six decimals and velocities: those are known to within 5e-7 rad/s, and the greatest lasts for some rows.
    random = np.random.default_rng(1808)
    for _ in range(40):
        joints = [double_s(random), double_s(random)]
        check = er.check(cell_of(joints), **rows_of(joints, Told(period, 6, None, 1), faster=1.0001))
        assert "velocity_limit" in kinds(check)


def test_no_contact_verdict_depends_on_how_rows_are_judged() -> None:
    random = np.random.default_rng(1809)
    seen = Counter[bool]()
    for i in range(200):
        joints = [double_s(random), double_s(random)]
        angle, reach = random.uniform(0.0, 2.0 * np.pi), random.uniform(0.2, 0.6)
        post = er.Circle(center=(reach * np.cos(angle), reach * np.sin(angle)), radius=0.05)
        cell = cell_of(joints).replace(obstacles=[post])
        # A scene without limits, where nothing is judged but contact and where it begins and ends.
        free = cell.replace(arm=cell.arm.replace(joints=(er.Joint(continuous=True),) * 2))
        rows = rows_of(joints, WAYS[11 * i % len(WAYS)], faster=float(random.choice([1.0, 1.5])))
        contacts = [
            [(v.time, v.link, v.obstacle, v.depth) for v in check.verdict.violations if v.kind == "contact"]
            for check in (er.check(free, **rows), er.check(cell, **rows), er.check(cell, **rows, limit_tolerance=9.0))
        ]
        assert contacts[0] == contacts[1] == contacts[2]
        seen[bool(contacts[0])] += 1
    assert min(seen[True], seen[False]) > 20


def limited(scene: er.Scene) -> er.Scene:
    joint = {"velocity": 3.0, "acceleration": 3.14, "jerk": 12.57}
    return scene.replace(arm=scene.arm.replace(joints=tuple(one.replace(**joint) for one in scene.arm.joints)))


@pytest.fixture(scope="module")
def own() -> er.Plan:
    return er.plan(limited(er.Scene.example("paper-standin")), task="first", objective="time")


@pytest.mark.parametrize("period", [0.001, 0.004, 0.005, 0.008, 0.01])
@pytest.mark.parametrize("decimals", [None, 6])
def test_a_plan_sampled_again_is_not_refused(own: er.Plan, period: float, decimals: int | None) -> None:
    samples = own.sample(period=period)
    t, q, v, a = (
        values if decimals is None else np.round(values, decimals)
        for values in (samples.t, samples.q, samples.v, samples.a)
    )
    check = er.check(own.scene, t=t, q=q, v=v, a=a)
    assert check.safe, [violation.message for violation in check.verdict.violations]
    assert "velocity" not in unjudged(check)


def test_our_own_file_is_judged_whole_and_to_the_last_digit(own: er.Plan, tmp_path: Path) -> None:
    path = tmp_path / "trajectory.csv"
    path.write_text(as_csv(own))
    check = er.check_file(own.scene, path)
    assert check.safe
    assert check.verdict.unjudged == check.verdict.allowed == ()
    for rate in ("velocity", "acceleration", "jerk"):
        margins = [getattr(margins, rate) for margins in check.verdict.motion_margins]
        greatest = max(margins, key=lambda margin: margin.largest).largest
        joints = tuple(one.replace(**{rate: greatest * (1.0 - 1e-7)}) for one in own.scene.arm.joints)
        tighter = own.scene.replace(arm=own.scene.arm.replace(joints=joints))
        assert f"{rate}_limit" in kinds(er.check_file(tighter, path)), rate


def samples_of(**rows: np.ndarray) -> TrajectorySamples:
    return TrajectorySamples(since_start=True, **{"v": None, "a": None, **rows})


def test_rounding_is_seen_and_nothing_is_taken_for_it() -> None:
    random = np.random.default_rng(1810)
    joints = [double_s(random), double_s(random)]

    def quantum(told: Told) -> float:
        return float(rounding_of(samples_of(**rows_of(joints, told))).quanta[0, 0])

    for decimals in range(3, 10):
        assert quantum(Told(0.004, decimals)) == pytest.approx(10.0**-decimals)
    for counts in (1024, 4096, 16384):
        assert quantum(Told(0.004, 6, counts)) == pytest.approx(2.0 * np.pi / counts, rel=1e-4)
    assert quantum(Told(0.004)) == 0.0
    full = rows_of(joints, Told(0.004))
    single = rounding_of(samples_of(t=full["t"], q=full["q"].astype(np.float32).astype(float)))
    assert 0.0 < single.quanta[0, 0] < 1e-6
    degrees = rounding_of(samples_of(t=full["t"], q=np.radians(np.round(np.degrees(full["q"]), 3))))
    assert degrees.quanta[0, 0] == pytest.approx(np.radians(1e-3))
    # Motions that lie on a grid as they are: ramps, parabolas, what is typed by hand.
    t = 0.001 * np.arange(1001)
    for exact in (t, 0.5 * t * t, np.repeat(np.arange(7.0), 143) * 0.1):
        column = np.column_stack([exact, exact])
        assert not rounding_of(samples_of(t=t, q=column)).quanta.any()


def test_times_of_240_hz_are_seen_to_be_rounded() -> None:
    t = np.arange(400) / 240.0
    q = np.zeros((400, 2))
    assert rounding_of(samples_of(t=np.round(t, 6), q=q)).time == pytest.approx(1e-6)
    assert rounding_of(samples_of(t=t, q=q)).time == 0.0
    assert rounding_of(samples_of(t=0.004 * np.arange(400), q=q)).time == 0.0


@pytest.fixture
def cell(tmp_path: Path) -> Path:
    path = tmp_path / "cell.yaml"
    path.write_text("""\
elbowroom: 1
units: {length: m, angle: rad}
arm:
  links: [0.3, 0.25]
  joints:
    - {min: -2.5, max: 2.5, velocity: 3, acceleration: 30, jerk: 30000}
    - {min: -2.6, max: 2.6, velocity: 3}
  half_width: 0.03
grid: {x: [-0.55, 0.55], y: [-0.55, 0.55], step: 0.01}
tasks:
  go: {start: {q: [-0.5, 0.5]}, goal: {q: [1.5, 0.5]}}
""")
    return path


def at_three(path: Path, *, decimals: int, top: float = 3.0, velocities: bool = True) -> Path:
    """A file whose first joint gathers speed to ``top`` rad/s, keeps it, and stops, at 1 kHz."""
    t = 0.001 * np.arange(1134)
    ramp = 0.2437
    v = top * np.clip(np.minimum(t, t[-1] - t) / ramp, 0.0, 1.0)
    q = -0.5 + np.concatenate([[0.0], np.cumsum(0.0005 * (v[1:] + v[:-1]))])
    header = "time_s,q1_rad,q2_rad" + ",v1_rad_s,v2_rad_s" * velocities
    rows = [
        f"{t_:.6f},{q_:.{decimals}f},0.5" + f",{v_:.{decimals}f},0.0" * velocities
        for t_, q_, v_ in zip(t, q, v, strict=True)
    ]
    path.write_text("\n".join([header, *rows]))
    return path


def test_a_motion_at_its_limit_in_a_file_is_safe_and_says_what_was_not_judged(cell: Path, tmp_path: Path) -> None:
    run = CliRunner().invoke(app, ["check", str(cell), str(at_three(tmp_path / "t.csv", decimals=6))])
    assert run.exit_code == 0, run.output
    assert "SAFE: proved for the whole motion, in all that was judged" in run.output
    assert "judged: contact with obstacles, joint limits, velocity, acceleration of joint 1\n" not in run.output
    assert (
        "NOT judged: jerk of joint 1: positions rounded to 1.00e-6 rad, 1 ms apart, leave it uncertain by" in run.output
    )
    told = CliRunner().invoke(app, ["check", str(cell), str(tmp_path / "t.csv"), "--json"])
    [jerk] = [one for one in json.loads(told.stdout)["unjudged"] if one["rate"] == "jerk"]
    assert (jerk["joint"], jerk["limit"], jerk["cause"], jerk["quantity"]) == (1, 30000.0, "rounding", "position")
    assert jerk["quantum"] == pytest.approx(1e-6)


def test_a_tolerance_is_asked_for_and_told(cell: Path, tmp_path: Path) -> None:
    path = str(at_three(tmp_path / "t.csv", decimals=6, top=3.02))
    strict = CliRunner().invoke(app, ["check", str(cell), path])
    assert strict.exit_code == 4
    assert "the velocity of joint 1 reaches 3.02" in strict.output
    allowed = CliRunner().invoke(app, ["check", str(cell), path, "--limit-tolerance", "0.01"])
    assert allowed.exit_code == 0, allowed.output
    assert "3 rad/s are allowed: within the tolerance asked for" in allowed.output
    wrong = CliRunner().invoke(app, ["check", str(cell), path, "--limit-tolerance", "-0.01"])
    assert wrong.exit_code == 2
    assert "limit_tolerance is -0.01" in wrong.output


def test_a_check_with_what_it_left_open_is_judged_again_when_unpickled(cell: Path, tmp_path: Path) -> None:
    scene = er.Scene.load(cell)
    check = er.check_file(scene, at_three(tmp_path / "t.csv", decimals=4, velocities=False))
    assert check.safe
    assert check.verdict.unjudged
    assert "in what was judged" in repr(check)
    assert pickle.loads(pickle.dumps(check)) == check
    assert {one.as_dict()["cause"] for one in check.verdict.unjudged} <= {"rounding", "spacing"}


def test_a_stop_is_closed_but_for_the_digits(cell: Path) -> None:
    scene = er.Scene.load(cell)
    stop = 2.4999998
    joints = (scene.arm.joints[0].replace(max=stop, acceleration=None, jerk=None), scene.arm.joints[1])
    tight = scene.replace(arm=scene.arm.replace(joints=joints))
    t = 0.01 * np.arange(301)
    s = t / 3.0
    q = stop - 1.0 + s**3 * (10.0 - 15.0 * s + 6.0 * s * s)
    other = np.full_like(q, 0.5)
    rounded = er.check(tight, t=t, q=np.round(np.column_stack([q, other]), 6))
    assert rounded.safe, rounded.verdict.violations
    assert [(one.what, one.by) for one in rounded.verdict.allowed] == [("position", "rounding")]
    beyond = er.check(tight, t=t, q=np.round(np.column_stack([q + 2e-6, other]), 6))
    assert kinds(beyond) == {"joint_limit"}
