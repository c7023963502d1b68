"""The paper's experiments on our own run: three scenes, two tasks, figures 4 to 19, and its numbers beside ours."""

from elbowroom._paper.reproduce import reproduce

__all__ = ["reproduce"]
