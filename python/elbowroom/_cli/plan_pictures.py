"""The pictures of one plan."""

from __future__ import annotations

from pathlib import Path

from elbowroom import figures
from elbowroom._core import Plan
from elbowroom._free_space import free_space


def draw(plan: Plan, folder: Path, *, animate: bool) -> list[Path]:
    """Draw ``plan`` into ``folder``; return the pictures' paths."""
    flat = _has_two_links(plan)
    pictures = {
        "tip_path": figures.tip_path(plan, free_space(plan.scene) if flat else None),
        "smoothed_path": figures.smoothed_path(plan),
        "arm_tracking": figures.arm_tracking(plan),
        "joints": figures.joint_curves(plan),
        "clearance": figures.clearance_curve(plan),
    }
    if flat:
        pictures["configuration_space"] = figures.configuration_space(plan)
    written = [figures.save(figure, folder / f"{name}.png") for name, figure in pictures.items()]
    if animate:
        written.append(figures.animate(plan, folder / "motion.gif"))
    return written


def not_drawn(plan: Plan) -> str | None:
    """Return which pictures are left out for this arm, in words; None if all are drawn."""
    if _has_two_links(plan):
        return None
    links = len(plan.scene.arm.links)
    return (
        f"no picture of the configuration space and no free grid points: they are for arms of 2 links, this has {links}"
    )


def _has_two_links(plan: Plan) -> bool:
    return len(plan.scene.arm.links) == 2
