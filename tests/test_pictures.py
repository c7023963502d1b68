"""What pictures show: colours that everybody can tell apart, units, numbers of obstacles, labels that are whole."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.text import Text
from numpy.typing import NDArray
from PIL import Image

import elbowroom as er
from elbowroom import _walls as walls
from elbowroom import figures
from elbowroom._cli.plan_pictures import draw
from elbowroom._samples import Floats
from elbowroom._walls import walls_in_words
from elbowroom.figures import _maps as maps
from elbowroom.figures import _style as style
from tests.colour_distance import SEEN, distance


def test_the_measure_of_colours_is_ciede2000() -> None:
    assert distance("#50A0A0", "#50A0A0") == 0.0
    assert distance("#000000", "#FFFFFF") == pytest.approx(100.0, abs=0.1)
    # What was complained of: motion on contact, as a deuteranope sees them.
    assert distance("#CC79A7", "#D9A5C2", "deuteranope") < 12.0


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (style.MOTION, style.COLLISION),
        (style.MOTION, style.COLLISION_2),
        (style.MOTION, "#FFFFFF"),
        (style.COLLISION, style.COLLISION_2),
        (style.LIMIT_LINE, style.MOTION),
        (style.LIMIT_LINE, style.COLLISION_2),
        (style.FREE, style.COLLISION),
        (style.FREE, maps.TWO_POSTURES),
        (style.LIMIT, style.COLLISION),
        (style.PATH, style.FREE),
        (style.PATH, style.OBSTACLE),
        (style.LINK_1, style.LINK_2),
        (style.LINK_2, style.OBSTACLE),
    ],
)
def test_colours_that_meet_are_told_apart_by_everybody_and_in_grey(first: str, second: str) -> None:
    for reader in SEEN:
        assert distance(first, second, reader) > 12.0, reader


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (style.FREE, style.LIMIT),
        (style.FREE, style.OUT_OF_REACH),
        (style.LIMIT, style.OUT_OF_REACH),
        (style.FREE, style.COLLISION_2),
        (style.GOAL, style.FREE),
        (style.PATH, style.MOTION),
    ],
)
def test_other_colours_are_told_apart_by_who_sees_fewer(first: str, second: str) -> None:
    # In grey what is forbidden is hatched, marks differ in shape, and the path is dashed.
    for reader in ("everybody", "deuteranope", "protanope"):
        assert distance(first, second, reader) > 11.0, reader


def texts(figure: Figure) -> list[str]:
    return [text.get_text() for text in figure.findobj(Text) if text.get_text()]


def whole(figure: Figure) -> None:
    """Every label that is shown lies within the picture."""
    figure.draw_without_rendering()
    for text in figure.findobj(Text):
        if text.get_text() and text.get_visible() and not (text.get_clip_on() and isinstance(text.axes, Axes)):
            box = text.get_window_extent()
            if box.width:
                assert box.x0 >= -1.0, text
                assert box.x1 <= figure.bbox.x1 + 1.0, text


@pytest.fixture
def pick(scenes: Path) -> er.Plan:
    return er.plan(er.Scene.load(scenes / "abb-irb-910sc-065.yaml"), task="pick")


def test_pictures_are_in_the_units_of_the_scene_and_name_the_obstacles(pick: er.Plan, tmp_path: Path) -> None:
    scene = pick.scene
    space = er.free_space(scene)
    for figure in (
        figures.tip_path(pick, space),
        figures.smoothed_path(pick),
        figures.arm_tracking(pick),
        figures.posture_map(scene, space, posture="elbow-up"),
        figures.union_map(scene, space),
    ):
        found = texts(figure)
        assert {"x (mm)", "y (mm)", "1 post", "2 feeder", "3 tray"} <= set(found)
        whole(figure)
    space_of_joints = figures.configuration_space(pick)
    assert {"joint 1 (deg)", "joint 2 (deg)", "joint limit", "link 2 in contact", "2 feeder"} <= set(
        texts(space_of_joints)
    )
    whole(space_of_joints)
    assert "clearance (mm)" in texts(figures.clearance_curve(pick))
    assert "velocity (deg/s)" in texts(figures.joint_curves(pick))
    radians = figures.configuration_space(er.plan(scene.replace(units=er.Units()), task="pick"))
    assert "joint 1 (rad)" in texts(radians)
    draw(pick, tmp_path, animate=False)
    assert figures.save(figures.clearance_curve(pick), str(tmp_path / "text.png")).exists()


def test_the_least_clearance_is_where_it_is(pick: er.Plan) -> None:
    figure = figures.arm_tracking(pick)
    [axes] = figure.axes
    [mark] = [line for line in axes.get_lines() if str(line.get_label()).startswith("least clearance")]
    least = pick.verdict.least_clearance
    assert least is not None
    assert "to obstacle 1 (post)" in str(mark.get_label())
    x, y = np.array(mark.get_data()).ravel()
    # From there it is the clearance and the link's radius to the post, a circle.
    post = pick.scene.obstacles[0]
    assert isinstance(post, er.Circle)
    away = math.hypot(x - post.center[0] * 1e3, y - post.center[1] * 1e3) - post.radius * 1e3
    assert away == pytest.approx((least.distance + pick.scene.arm.half_width) * 1e3, abs=1.5)


def test_a_proof_says_what_is_around_the_start(scenes: Path) -> None:
    scene = er.Scene.load(scenes / "narrow.yaml")
    bend = er.Joint(min=-math.pi / 2, max=math.pi / 2)
    scene = scene.replace(arm=scene.arm.replace(joints=(scene.arm.joints[0], bend)))
    with pytest.raises(er.NoPath) as caught:
        er.plan(scene, task="second", planner="optimal")
    assert walls_in_words(scene, caught.value) == "obstacle 11, obstacle 3, joint limits"
    figure = figures.no_path(scene, caught.value)
    assert any("around what the start can reach: obstacle 11" in text for text in texts(figure))
    whole(figure)
    # The axes fill their picture.
    figure.draw_without_rendering()
    [axes] = figure.axes
    assert axes.get_window_extent().height > 0.6 * figure.bbox.height


def test_naming_walls_asks_each_cell_of_the_points_near_it_alone(scenes: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is done after the timeout: to ask all points of all cells took seconds."""
    scene = er.Scene.load(scenes / "narrow.yaml")
    bend = er.Joint(min=-math.pi / 2, max=math.pi / 2)
    scene = scene.replace(arm=scene.arm.replace(joints=(scene.arm.joints[0], bend)))
    with pytest.raises(er.NoPath) as caught:
        er.plan(scene, task="first", planner="optimal")
    asked = []
    within = walls._within

    def counted(places: Floats, cell: Floats) -> NDArray[np.bool_]:
        asked.append(len(places))
        return within(places, cell)

    monkeypatch.setattr(walls, "_within", counted)
    assert walls_in_words(scene, caught.value)
    assert len(asked) > 50
    assert sum(asked) < 8 * walls.POINTS**2


def test_the_last_picture_of_a_motion_stays(pick: er.Plan, tmp_path: Path) -> None:
    with Image.open(figures.animate(pick, tmp_path / "motion.gif")) as moving:
        moving.seek(moving.n_frames - 1)  # type: ignore[attr-defined]
        assert moving.info["duration"] >= 1000


def test_names_of_what_moves_stay_within_the_picture(scenes: Path) -> None:
    from elbowroom.figures._style import plane
    from elbowroom.follow._animation import _DrawnMover

    scene = er.Scene.load(scenes / "moving-one.yaml")
    figure, axes = plane("t", scene, moving=False)
    mover = _DrawnMover(axes, scene.obstacles[-1], label="12 a long name", scale=100.0)
    figure.draw_without_rendering()
    mover.measure()
    from elbowroom._outlines import middle

    frame = axes.get_window_extent()
    for x in np.linspace(scene.grid.x[0], scene.grid.x[1], 23):
        mover.move(np.array([x, 0.0]) - middle(scene.obstacles[-1]), np.zeros(2), scene.obstacles[-1].motion)
        box = mover.name.get_window_extent()
        assert frame.x0 <= box.x0
        assert box.x1 <= frame.x1
