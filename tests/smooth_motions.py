"""Random motions that run at their limits, in closed form, and the rows that other tools write of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import elbowroom as er

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class DoubleS:
    """Pieces of constant jerk: from rest to rest, there and perhaps back, at all of its limits."""

    durations: Floats
    jerks: Floats
    begin: float
    limits: tuple[float, float, float]

    def at(self, t: Floats) -> tuple[Floats, Floats, Floats]:
        """Position, velocity, acceleration (rad, s)."""
        q, v, a = np.full_like(t, self.begin), np.zeros_like(t), np.zeros_like(t)
        state, start = (self.begin, 0.0, 0.0), 0.0
        ends = [*zip(self.durations, self.jerks, strict=True), (np.inf, 0.0)]
        for duration, jerk in ends:
            here = (t >= start) & (t < start + duration) if start > 0.0 else t < duration
            s = t[here] - start
            q0, v0, a0 = state
            q[here] = q0 + s * (v0 + s * (a0 / 2 + s * jerk / 6))
            v[here] = v0 + s * (a0 + s * jerk / 2)
            a[here] = a0 + s * jerk
            if np.isfinite(duration):
                s = duration
                state = (
                    q0 + s * (v0 + s * (a0 / 2 + s * jerk / 6)),
                    v0 + s * (a0 + s * jerk / 2),
                    a0 + s * jerk,
                )
                start += duration
        rests = t >= self.durations.sum()
        return q, np.where(rests, 0.0, v), np.where(rests, 0.0, a)


def double_s(random: np.random.Generator) -> DoubleS:
    """A motion that reaches all three of its limits."""
    jerk = float(10.0 ** random.uniform(0.7, 2.5))
    ramp, hold, cruise = random.uniform(0.04, 0.3), random.uniform(0.02, 0.2), random.uniform(0.02, 0.4)
    durations = np.array([ramp, hold, ramp, cruise, ramp, hold, ramp])
    signs = np.array([1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0]) * random.choice([-1.0, 1.0])
    if random.random() < 0.5:
        pause = random.choice([0.0, 0.05])
        durations = np.concatenate([durations, [pause], durations])
        signs = np.concatenate([signs, [0.0], -signs])
    greatest = (jerk * ramp * (ramp + hold), jerk * ramp, jerk)
    return DoubleS(durations, jerk * signs, float(random.uniform(-1.5, 1.5)), greatest)


@dataclass(frozen=True)
class Told:
    """How a tool writes rows."""

    period: float
    decimals: int | None = None
    counts: int | None = None
    stated: int = 0


def rows_of(joints: list[DoubleS], told: Told, *, faster: float = 1.0) -> dict[str, Floats]:
    """What ``er.check`` takes of the motion, run ``faster`` than its limits allow."""
    duration = max(float(joint.durations.sum()) for joint in joints) / faster
    t = told.period * np.arange(int(np.ceil(duration / told.period - 1e-9)) + 1)
    of_joints = [joint.at(t * faster) for joint in joints]
    columns = [np.column_stack([of_joint[k] for of_joint in of_joints]) * faster**k for k in range(told.stated + 1)]
    if told.counts is not None:
        step = 2.0 * np.pi / told.counts
        columns[0] = np.floor(columns[0] / step) * step
    if told.decimals is not None:
        columns = [np.round(column, told.decimals) for column in columns]
        t = np.round(t, max(told.decimals, 6))
    return {"t": t, **dict(zip("qva", columns, strict=False))}


def cell_of(joints: list[DoubleS]) -> er.Scene:
    """An arm that can do just that, and a post that it may or may not touch."""
    return er.Scene(
        arm=er.Arm(
            links=(0.3, 0.2),
            joints=tuple(
                er.Joint(continuous=True, velocity=v, acceleration=a, jerk=j)
                for v, a, j in (joint.limits for joint in joints)
            ),
            half_width=0.01,
        ),
        obstacles=[],
        grid=er.Grid(x=(-0.5, 0.5), y=(-0.5, 0.5), step=0.05),
    )
