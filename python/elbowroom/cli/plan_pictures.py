"""The pictures of one plan."""

from __future__ import annotations

from pathlib import Path

from elbowroom import figures
from elbowroom.free_space import free_space
from elbowroom.plan import Plan


def draw(plan: Plan, folder: Path, *, animate: bool) -> list[Path]:
    """Draw ``plan`` into ``folder``; return the pictures' paths."""
    space = free_space(plan.scene)
    pictures = {
        "tip_path": figures.tip_path(plan, space),
        "smoothed_path": figures.smoothed_path(plan),
        "arm_tracking": figures.arm_tracking(plan),
        "configuration_space": figures.configuration_space(plan),
        "joints": figures.joint_curves(plan),
        "clearance": figures.clearance_curve(plan),
    }
    written = [figures.save(figure, folder / f"{name}.png") for name, figure in pictures.items()]
    if animate:
        written.append(figures.animate(plan, folder / "motion.gif"))
    return written
