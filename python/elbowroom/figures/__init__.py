"""Pictures: of maps, paths and motions. Every function returns a matplotlib ``Figure``."""

from elbowroom.figures.curves import joint_curves, tip_curve
from elbowroom.figures.maps import posture_map, union_map
from elbowroom.figures.paths import arm_tracking, smoothed_path, tip_path
from elbowroom.figures.style import save

__all__ = [
    "arm_tracking",
    "joint_curves",
    "posture_map",
    "save",
    "smoothed_path",
    "tip_curve",
    "tip_path",
    "union_map",
]
