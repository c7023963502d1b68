"""An arm that keeps going among obstacles that move, simulated: what ``elbowroom follow`` does."""

from elbowroom.follow.followed import Followed, Outcome, Step
from elbowroom.follow.simulation import follow

__all__ = ["Followed", "Outcome", "Step", "follow"]
