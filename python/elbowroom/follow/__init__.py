"""An arm that keeps going among obstacles that move, simulated: what ``elbowroom follow`` does."""

from elbowroom.follow._followed import Followed, Outcome, Step
from elbowroom.follow._simulation import follow

__all__ = ["Followed", "Outcome", "Step", "follow"]
