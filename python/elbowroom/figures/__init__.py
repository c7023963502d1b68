"""Pictures: of maps, paths and motions. Every function but ``animate`` returns a matplotlib ``Figure``."""

from elbowroom.figures._animation import animate
from elbowroom.figures._clearance import clearance_curve
from elbowroom.figures._configuration_space import configuration_space
from elbowroom.figures._curves import joint_curves, tip_curve
from elbowroom.figures._maps import posture_map, union_map
from elbowroom.figures._no_path import no_path
from elbowroom.figures._paths import arm_tracking, smoothed_path, tip_path
from elbowroom.figures._style import save

__all__ = [
    "animate",
    "arm_tracking",
    "clearance_curve",
    "configuration_space",
    "joint_curves",
    "no_path",
    "posture_map",
    "save",
    "smoothed_path",
    "tip_curve",
    "tip_path",
    "union_map",
]
