"""Pictures of arms of any number of links."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure
from PIL import Image

import elbowroom as er
from elbowroom import figures
from elbowroom._cli.plan_pictures import draw, not_drawn
from elbowroom.figures._curves import joint_lines
from elbowroom.figures._links import capsule, link_colours
from elbowroom.figures._style import LINK_1, LINK_2

Chain = Callable[..., er.Scene]
Planned = Callable[[er.Scene], er.Plan]


def legends_cover_nothing(figure: Figure) -> bool:
    """Whether all legends are beside the axes, within the picture."""
    figure.draw_without_rendering()
    whole = figure.bbox
    for axes in figure.axes:
        legend = axes.get_legend()
        if legend is not None:
            box = legend.get_window_extent()
            if box.x0 < axes.get_window_extent().x1 or box.x1 > whole.x1 + 1.0 or box.y0 < whole.y0 - 1.0:
                return False
    return True


@pytest.mark.parametrize("links", [2, 3, 5, 10])
def test_every_picture_is_drawn_and_no_legend_covers_any(
    chain: Chain, planned: Planned, tmp_path: Path, links: int
) -> None:
    plan = planned(chain(links))
    for figure in (
        figures.tip_path(plan, None),
        figures.smoothed_path(plan),
        figures.arm_tracking(plan),
        figures.joint_curves(plan),
        figures.clearance_curve(plan),
    ):
        assert legends_cover_nothing(figure)
    figures.tip_curve(plan, of=f"theta {links}")
    with pytest.raises(er.BadSetting, match=f"no curve is called 'theta 0'; x, y, theta 1 to theta {links}"):
        figures.tip_curve(plan, of="theta 0")
    names = {path.name for path in draw(plan, tmp_path, animate=False)}
    assert ("configuration_space.png" in names) == (links == 2)
    told = not_drawn(plan)
    assert (told is None) == (links == 2)
    assert told is None or (f"this has {links}" in told and "\n" not in told)


@pytest.mark.parametrize(("links", "half_width"), [(2, 0.0), (3, 0.0), (3, 0.01), (10, 0.004)])
def test_stills_are_the_arm_to_scale(chain: Chain, planned: Planned, links: int, half_width: float) -> None:
    plan = planned(chain(links, half_width=half_width))
    figure = figures.arm_tracking(plan)
    [axes] = figure.axes
    [lines] = [c for c in axes.collections if isinstance(c, LineCollection)]
    drawn = np.array(lines.get_segments()).reshape(-1, links, 2, 2)
    assert len(drawn) == 25
    np.testing.assert_allclose(np.linalg.norm(drawn[:, :, 1] - drawn[:, :, 0], axis=-1), 0.5 / links, rtol=1e-12)
    np.testing.assert_allclose(drawn[:, 0, 0], [plan.scene.arm.base] * 25)
    np.testing.assert_allclose(drawn[[0, -1], -1, 1], plan.tip_path[[0, -1]], atol=1e-12)
    bodies = [c for c in axes.collections if isinstance(c, PolyCollection)]
    assert len(bodies) == (half_width > 0.0)
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()][:links] == [f"link {i + 1}" for i in range(links)]


def test_a_capsule_keeps_its_half_width_all_round() -> None:
    random = np.random.default_rng(0)
    for _ in range(200):
        segment, half = random.uniform(-5.0, 5.0, (2, 2)), random.uniform(0.01, 2.0)
        along = segment[1] - segment[0]
        outline = capsule(segment, half)
        shares = np.clip((outline - segment[0]) @ along / (along @ along), 0.0, 1.0)
        nearest = segment[0] + shares[:, None] * along
        np.testing.assert_allclose(np.linalg.norm(outline - nearest, axis=1), half, rtol=1e-12)
        x, y = outline.T
        area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2.0
        assert area == pytest.approx(2.0 * half * np.hypot(*along) + np.pi * half**2, rel=0.01)


def test_shades_show_the_order_and_lines_are_told_apart() -> None:
    assert link_colours(2) == [LINK_1, LINK_2]
    for links in (3, 10, 30):
        channels = np.array([[int(c[k : k + 2], 16) for k in (1, 3, 5)] for c in link_colours(links)])
        lightness = channels @ [0.2126, 0.7152, 0.0722]
        assert (np.diff(lightness) > 0).all()
    for joints in (2, 3, 10, 28):
        assert len(set(joint_lines(joints))) == joints


def test_limits_that_joints_share_are_drawn_once(chain: Chain, planned: Planned) -> None:
    scene = chain(10)
    fast = scene.arm.joints[4].replace(velocity=3.0)
    joints = (*scene.arm.joints[:4], fast, *scene.arm.joints[5:])
    figure = figures.joint_curves(planned(scene.replace(arm=scene.arm.replace(joints=joints))))
    labels = [axes.get_legend_handles_labels()[1] for axes in figure.axes]
    assert labels[0] == ["joint 1 (continuous)", *(f"joint {j}" for j in range(2, 11)), "limit of joints 2 to 10"]
    assert labels[1] == [
        "limit of joints 1 to 4 and 6 to 10",
        "limit of joint 5",
    ]
    assert labels[3] == ["limit of joints 1 to 10 (assumed)"]


def test_clearance_between_links_is_drawn_where_it_counts(chain: Chain, planned: Planned) -> None:
    for links, self_collision in ((2, True), (5, True), (5, False)):
        [axes] = figures.clearance_curve(planned(chain(links, self_collision=self_collision))).axes
        labels = axes.get_legend_handles_labels()[1]
        assert labels[:links] == [f"link {i + 1}" for i in range(links)]
        assert ("between links" in labels) == (links > 2 and self_collision)


@pytest.mark.parametrize(("links", "half_width"), [(2, 0.0), (3, 0.01), (10, 0.004)])
def test_the_animation_moves(chain: Chain, planned: Planned, tmp_path: Path, links: int, half_width: float) -> None:
    plan = planned(chain(links, half_width=half_width))
    with Image.open(figures.animate(plan, tmp_path / "new" / "motion.gif")) as moving:
        assert moving.n_frames == round(plan.motion.duration * 20) + 1  # type: ignore[attr-defined]
        first = np.asarray(moving.convert("RGB"), dtype=int)
        moving.seek(moving.n_frames - 1)  # type: ignore[attr-defined]
        last = np.asarray(moving.convert("RGB"), dtype=int)
    assert np.count_nonzero(np.abs(first - last).sum(axis=2) > 60) > 200
