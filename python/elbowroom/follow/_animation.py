"""What was followed as a moving picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle as CirclePatch
from matplotlib.patches import FancyArrowPatch, Patch
from matplotlib.patches import Polygon as PolygonPatch

from elbowroom._known import Known, Sighting
from elbowroom._outlines import middle
from elbowroom._samples import Floats, sampled
from elbowroom._scene import Obstacle, ObstacleMotion
from elbowroom._whole_files import written_whole
from elbowroom.figures._animation import END, FRAMES_PER_SECOND, MOST_FRAMES
from elbowroom.figures._links import DrawnArm, link_legend
from elbowroom.figures._style import (
    INK,
    MOTION,
    PATH,
    coordinates,
    corners_of,
    legend_beside,
    mark_base,
    mark_ends,
    obstacle_label,
    plane,
)
from elbowroom.follow._courses import shifts
from elbowroom.follow._followed import Followed, Step
from elbowroom.follow._goal import Goal

AHEAD = 1.0
"""Arrows show where an obstacle goes within so long (s)."""

MOVING = "#F0E442"
"""Obstacles that move; static ones are as dark as ever."""

FLASH = 0.4
"""How long a decision other than to keep is shown (s)."""

DECISIONS = {"new": "new motion", "stop": "braked to rest"}
"""What the words of ``decisions.jsonl`` say here."""

LONGEST_WORDS = "new motion at 00.00 s"
"""What room is left for beside the picture."""

NEAR_EDGE = 0.02
"""Names keep this share of the picture from its edge."""


class _DrawnMover:
    """An obstacle that moves, as large as it is: filled once it is seen, with what is known of its course."""

    def __init__(self, axes: Axes, obstacle: Obstacle, *, label: str, scale: float) -> None:
        self.axes, self.obstacle, self.scale = axes, obstacle, scale
        look = {"edgecolor": INK, "linewidth": 1.2, "zorder": 3.2}
        points, self.radius = obstacle.outline
        if len(points) == 1:
            self.corners: Floats = np.zeros((0, 2))
            self.outline: CirclePatch | PolygonPatch = CirclePatch((0.0, 0.0), self.radius * scale, **look)
        else:
            self.corners = np.array(corners_of(obstacle.outline))
            self.outline = PolygonPatch(np.zeros((1, 2)), closed=True, **look)
        self.arrow = FancyArrowPatch(
            (0, 0),
            (1, 1),
            arrowstyle="-|>",
            mutation_scale=11,
            color=INK,
            linewidth=1.3,
            shrinkA=0,
            shrinkB=0,
            zorder=3.6,
        )
        self.doubt = CirclePatch((0.0, 0.0), 1.0, fill=False, edgecolor=INK, linestyle=":", linewidth=1.2, zorder=3.1)
        for artist in (self.outline, self.arrow, self.doubt):
            axes.add_patch(artist)
        self.name = axes.text(0, 0, label, ha="center", va="bottom", fontsize=8, color=INK, zorder=7)
        self.name.set_clip_on(True)
        self.half_name = 0.0

    def measure(self) -> None:
        """Take in how wide the name is, once the figure has its final size."""
        box = self.name.get_window_extent().transformed(self.axes.transData.inverted())
        self.half_name = box.width / 2.0

    def move(self, shift: Floats, ahead: Floats, known: Known) -> list[Artist]:
        """Put it where it is shifted to (m), with an arrow along ``ahead`` (m) if its course is known."""
        scale = self.scale
        place = (middle(self.obstacle) + shift) * scale
        if isinstance(self.outline, CirclePatch):
            self.outline.set_center((place[0], place[1]))
            half = self.outline.radius
        else:
            corners = (self.corners + shift) * scale
            self.outline.set_xy(corners)
            half = float(np.ptp(corners[:, 1])) / 2.0
        self.outline.set_facecolor("none" if known is None else MOVING)
        self.outline.set_linestyle("--" if known is None else "-")
        length = float(np.hypot(*ahead))
        self.arrow.set_visible(isinstance(known, ObstacleMotion) and length > 0.005)
        self.arrow.set_positions((place[0], place[1]), (place[0] + ahead[0] * scale, place[1] + ahead[1] * scale))
        self.doubt.set_visible(isinstance(known, Sighting))
        if isinstance(known, Sighting):
            self.doubt.set_center((place[0], place[1]))
            self.doubt.set_radius((self.radius + (known.greatest_speed or 0.0) * AHEAD) * scale)
        # Not where the arrow is, nor where the obstacle is out of sight; and whole, also near the edge.
        side = -1.0 if ahead[1] > 0.0 else 1.0
        x, y = self.axes.get_xlim(), self.axes.get_ylim()
        room = self.half_name + NEAR_EDGE * (x[1] - x[0])
        middle_x = min(max(place[0], x[0] + room), x[1] - room)
        self.name.set_position((middle_x, place[1] + side * (half + 0.01 * scale)))
        self.name.set_verticalalignment("top" if side < 0.0 else "bottom")
        self.name.set_visible(bool(x[0] <= place[0] <= x[1] and y[0] <= place[1] <= y[1]))
        return [self.outline, self.arrow, self.doubt, self.name]


def animate(followed: Followed, path: Path) -> Path:
    """Write a GIF of arm and obstacles to ``path`` and return it; in real time up to 20 s.

    Everything is as large as it is. Obstacles are dashed until they are seen; an arrow is where one on a known
    trajectory goes in a second, a dotted circle where one on an unknown trajectory may get in that time.
    """
    duration = followed.duration
    frames = min(max(round(duration * FRAMES_PER_SECOND), 1), MOST_FRAMES)
    t = np.linspace(0.0, duration, frames + 1)
    samples = sampled(followed.scene, followed.check.motion, t)
    scene = followed.true_scene
    scale = scene.units.per_metre
    figure, axes = plane(f"task '{followed.task}', replanned at {followed.rate:g} Hz", scene, moving=False)
    figure.set_dpi(90)
    start, goal = samples.tip[0], Goal.of(followed.scene, followed.task).tip
    mark_ends(axes, scene, (start[0], start[1]), (goal[0], goal[1]))
    mark_base(axes, scene)
    trail = axes.plot([], [], color=MOTION, linewidth=1.8, zorder=4, label="tip so far")[0]
    ahead = axes.plot([], [], color=PATH, linewidth=1.6, linestyle="--", zorder=3.9, label="tip, planned")[0]
    arm = DrawnArm(axes, scene)
    moving = [(i, obstacle) for i, obstacle in enumerate(scene.obstacles) if obstacle.motion is not None]
    movers = [
        (i, _DrawnMover(axes, obstacle, label=obstacle_label(i, obstacle.name), scale=scale)) for i, obstacle in moving
    ]
    ways = {i: shifts(obstacle.motion, t) for i, obstacle in moving}
    later = {i: shifts(obstacle.motion, t + AHEAD) for i, obstacle in moving}
    words = axes.text(1.02, 0.0, LONGEST_WORDS, transform=axes.transAxes, va="bottom", color=INK, fontsize=10, zorder=8)
    legend_beside(axes, after=[*link_legend(scene), *_mover_legend(followed)])

    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for _, mover in movers:
        mover.measure()

    def show(frame: int) -> list[Artist]:
        i = min(frame, frames)
        step = followed.step_at(t[i])
        trail.set_data(*coordinates(scene, samples.tip[: i + 1]))
        ahead.set_data(*coordinates(scene, _planned_tip(followed, step, t[i])))
        drawn = [
            artist
            for index, mover in movers
            for artist in mover.move(ways[index][i], later[index][i] - ways[index][i], step.known[index])
        ]
        words.set_text(f"time {t[i]:.2f} s\n{_decision(followed, t[i])}\n{_doing(step, t[i], samples.v[i])}")
        return [trail, ahead, *arm.move(samples.link_ends[i]), *drawn, words]

    path.parent.mkdir(parents=True, exist_ok=True)
    moving_picture = FuncAnimation(figure, show, frames=frames + 1 + END)
    with written_whole(path) as fresh:
        moving_picture.save(fresh, writer=PillowWriter(fps=FRAMES_PER_SECOND))
    return path


def _planned_tip(followed: Followed, step: Step, now: float) -> Floats:
    return sampled(followed.scene, step.motion, np.linspace(now, max(step.motion.end, now), 60)).tip


def _decision(followed: Followed, now: float) -> str:
    """The decision now, or one just before that changed something."""
    recent = [step for step in followed.steps if now - FLASH < step.time <= now + 1e-9 and step.decision != "keep"]
    if not recent:
        return "keeps its motion"
    last = recent[-1]
    return f"{DECISIONS.get(last.decision, last.decision)} at {last.time:.2f} s"


def _doing(step: Step, now: float, v: Floats) -> str:
    stands = bool(np.all(np.abs(v) < 1e-3))
    left = step.motion.end - now
    if step.reaches_goal:
        if left <= 0.02:
            return "at the goal"
        return f"{'waits for an obstacle' if stands else 'moves to the goal'}\nat the goal in {left:.1f} s"
    if not step.safe:
        return "brakes: not proved\nto be safe"
    return "at rest\nno safe path yet" if stands else "moves as far\nas is safe"


def _mover_legend(followed: Followed) -> list[Artist]:
    motions = [obstacle.motion for obstacle in followed.scene.obstacles if obstacle.motion is not None]
    entries: list[Artist] = [Patch(facecolor=MOVING, edgecolor=INK, label="moving obstacle")]
    if any(not motion.chases for motion in motions):
        entries.append(
            Line2D([], [], color=INK, marker=">", markevery=[1], linewidth=1.3, label=f"moves in {AHEAD:g} s")
        )
    if any(motion.chases for motion in motions):
        entries.append(Line2D([], [], color=INK, linestyle=":", linewidth=1.2, label=f"may reach in {AHEAD:g} s"))
    if any(motion.seen_from is not None or motion.sensing_radius is not None for motion in motions):
        entries.append(Patch(facecolor="none", edgecolor=INK, linestyle="--", label="not seen by the arm"))
    return entries
