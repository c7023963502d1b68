from __future__ import annotations

import threading

import numpy as np
import pytest

import elbowroom as er


@pytest.fixture
def scene() -> er.Scene:
    return er.Scene.example("moving-one")


def test_it_keeps_a_safe_motion_and_takes_over_without_a_jump() -> None:
    scene = er.Scene.example("late")
    replanner, world = er.Replanner(scene, seed=1), er.World(scene)
    q, v, a = replanner.start, np.zeros(2), np.zeros(2)
    decisions = []
    for k in range(150):
        now = k / 50
        update = replanner.update(world.known(q=q), now=now, q=q, v=v, a=a)
        here = update.at(now)
        np.testing.assert_allclose(here.q[0], q, atol=1e-9)
        np.testing.assert_allclose(here.v[0], v, atol=1e-9)
        np.testing.assert_allclose(here.a[0], a, atol=1e-7)
        assert update.safe
        # Whatever is run ends at rest.
        end = update.at(update.motion.end)
        np.testing.assert_allclose([end.v[0], end.a[0]], 0.0, atol=1e-6)
        decisions.append(update.decision)
        ahead = update.at([now + 0.02])
        q, v, a = ahead.q[0], ahead.v[0], ahead.a[0]
        world.advance(now + 0.02, q=q)
    # The obstacle that it does not know of at first is seen at 1 s.
    assert decisions[0] == decisions[50] == "new"
    assert decisions.count("keep") > 100
    assert replanner.motion.end == update.motion.end


def test_same_seed_same_decisions(scene: er.Scene) -> None:
    def motions() -> list[bytes]:
        replanner = er.Replanner(scene, seed=3)
        q = replanner.start
        found = []
        for k in range(5):
            sighting = {"shuttle": er.Sighting(shift=(0.1, 0.2 + 0.1 * k), time=k / 10)}
            update = replanner.update(sighting, now=k / 10, q=q)
            found.append(update.motion.coefficients.tobytes())
        return found

    assert motions() == motions()


def test_what_is_known_is_a_course_a_sighting_or_nothing(scene: er.Scene) -> None:
    def update(known: er.Known) -> er.Update:
        replanner = er.Replanner(scene)
        return replanner.update({"shuttle": known}, now=0.0, q=replanner.start)

    gone = update(None)
    assert gone.reaches_goal
    blocked = update(er.ObstacleMotion(waypoints=[(0.0, (-0.47, 0.43))]))
    assert not blocked.reaches_goal
    assert blocked.safe
    fast = update(er.Sighting(shift=(0.0, 0.36), time=0.0, greatest_speed=5.0))
    # An obstacle faster than the arm, its course unknown: nothing moves that is not proved to be safe.
    assert fast.motion.end < gone.motion.end
    named = er.Replanner(scene)
    by_place = named.update({2: None}, now=0.0, q=named.start)
    assert by_place.motion.end == gone.motion.end


def test_no_time_still_gives_something_safe(scene: er.Scene) -> None:
    replanner = er.Replanner(scene)
    update = replanner.update(now=0.0, q=replanner.start, deadline=0.0)
    assert update.safe
    np.testing.assert_allclose(update.at(update.motion.end).v[0], 0.0, atol=1e-9)


def test_an_arm_that_is_elsewhere_gets_a_motion_from_where_it_is(scene: er.Scene) -> None:
    replanner = er.Replanner(scene)
    replanner.update(now=0.0, q=replanner.start)
    lost = replanner.start + 0.05
    update = replanner.update(now=0.5, q=lost)
    assert update.decision == "new"
    np.testing.assert_allclose(update.at(0.5).q[0], lost, atol=1e-9)


def test_start_and_posture_can_be_chosen(scene: er.Scene) -> None:
    assert er.Replanner(scene).start[1] < 0.0
    assert er.Replanner(scene, q=[1.0, 0.5]).start.tolist() == [1.0, 0.5]
    down = scene.replace(tasks={"down": scene.tasks["first"].replace(posture="down")})
    replanner = er.Replanner(down)
    update = replanner.update({"shuttle": None}, now=0.0, q=replanner.start)
    assert update.reaches_goal
    assert update.at(update.motion.end).q[0, 1] > 0.0


def test_nonsense_is_refused(scene: er.Scene) -> None:
    replanner = er.Replanner(scene)
    q = replanner.start

    def update(known: object = None, **changes: object) -> None:
        replanner.update(known, **{"now": 0.0, "q": q, **changes})  # type: ignore[arg-type]

    for changes, words in (
        ({"now": float("nan")}, "now is nan s"),
        ({"q": [1.0]}, r"q is \[1.0\]; two finite numbers"),
        ({"v": [float("inf"), 0.0]}, "v is .*two finite numbers"),
        ({"a": "fast"}, "a must be numbers"),
        ({"q": [[1.0, 2.0]]}, "q has shape"),
        ({"deadline": -1.0}, "deadline is -1.0 s"),
        ({"known": {"shuttel": None}}, r"'shuttel'; there are 2 \('shuttle'\)"),
        ({"known": {0: None}}, "no obstacle of the scene that moves is 0"),
        ({"known": {2: "gone"}}, "is a str"),
        ({"known": {2: er.Sighting(shift=(0.0, float("nan")), time=0.0)}}, "shift is NaN"),
        ({"known": {2: er.ObstacleMotion(chases=True, greatest_speed=1.0)}}, "a Sighting says where"),
    ):
        with pytest.raises(er.BadSetting, match=words):
            update(**changes)
    chased = er.Replanner(er.Scene.example("chase"))
    with pytest.raises(er.BadSetting, match=r"known has nothing about 1 \('hound'\)"):
        chased.update(now=0.0, q=chased.start)


def test_no_replanner_for_what_it_cannot_do(scene: er.Scene) -> None:
    with pytest.raises(er.BadSetting, match="needs an arm of 2 links; the arm of this scene has 3"):
        er.Replanner(er.Scene.example("three-links"))
    with pytest.raises(er.UnknownTask):
        er.Replanner(scene, task="second")
    with pytest.raises(er.BadSetting, match="cannot keep a posture"):
        er.Replanner(scene.replace(tasks={"keep": scene.tasks["first"].replace(posture="keep")}))
    far = scene.replace(tasks={"far": er.Task(start=(0.4, 0.1), goal=(0.9, 0.0))})
    with pytest.raises(er.NotFree) as caught:
        er.Replanner(far)
    assert caught.value.end == "goal"
    with pytest.raises(er.NotFree) as caught:
        er.Replanner(scene, q=[2.7, 0.0])
    assert caught.value.end == "start"
    with pytest.raises(er.BadSetting, match="seed"):
        er.Replanner(scene, seed=-1)
    world = er.World(scene)
    world.advance(1.0, q=(0.0, 1.0))
    with pytest.raises(er.BadSetting, match=r"at 1\.0 s already"):
        world.advance(0.5, q=(0.0, 1.0))


def test_planners_leave_what_moves_to_it(scene: er.Scene) -> None:
    for planning, words in (
        (lambda: er.plan(scene), "use elbowroom follow, or Replanner in Python"),
        (lambda: er.plan_as_in_paper(scene), "use elbowroom follow, or Replanner in Python"),
        (lambda: er.free_space(scene), "only for static obstacles; obstacle 3 \\(shuttle\\) moves"),
    ):
        with pytest.raises(er.BadSetting, match=words) as caught:
            planning()
        assert caught.value.setting == "scene"


def test_two_threads_wait_for_each_other(scene: er.Scene) -> None:
    replanner = er.Replanner(scene)
    updates: list[er.Update] = []
    call = lambda: updates.append(replanner.update(now=0.0, q=replanner.start))  # noqa: E731
    threads = [threading.Thread(target=call) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sorted(update.decision for update in updates) == ["keep", "keep", "keep", "new"]
