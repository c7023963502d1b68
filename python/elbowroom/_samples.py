"""A motion at instants."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from elbowroom._arrays import real_array
from elbowroom._core import Motion
from elbowroom._errors import BadSetting
from elbowroom._scene import Scene

Floats = NDArray[np.float64]


ROUNDING = 1e-9
"""How far beyond its ends a motion may be asked for (s): sums of steps are off by their last digits."""

MOST_SAMPLES = 10_000_000
"""Most samples that are taken of a motion at even times."""


@dataclass(frozen=True, eq=False)
class Samples:
    """A motion at instants ``t`` (s): joint positions, velocities, accelerations and jerks (rad, rad/s, ...), shape
    ``(n, joints)`` each, and where the links end (m), base first, shape ``(n, links, 2)``.
    """

    t: Floats
    q: Floats
    v: Floats
    a: Floats
    j: Floats
    link_ends: Floats

    @property
    def tip(self) -> Floats:
        """Where the tip is, shape ``(n, 2)`` (m)."""
        return self.link_ends[:, -1]


def sampled(scene: Scene, motion: Motion, t: ArrayLike) -> Samples:
    """Return ``motion`` of the arm of ``scene`` at the instants ``t``, shape ``(n,)`` (s); beyond its ends the arm
    stands.
    """
    times = np.ascontiguousarray(np.atleast_1d(t), dtype=np.float64)
    q, v, a, j = motion.sample(times)
    return Samples(times, q, v, a, j, scene.link_ends(q))


def within(scene: Scene, motion: Motion, t: ArrayLike) -> Samples:
    """Return ``motion`` at the instants ``t``, shape ``(n,)`` or one, all of them within it.

    Raises:
        BadSetting: An instant is, or is not a number.
    """
    times = np.atleast_1d(np.asarray(t)) if not isinstance(t, np.ma.MaskedArray) else t
    times = real_array("t", times, dimensions=1, shape="(n,) or a single one", setting="t")
    begin, end = motion.end - motion.duration, motion.end
    outside = ~((times >= begin - ROUNDING) & (times <= end + ROUNDING))
    if outside.any():
        first = int(outside.argmax())
        which = f"t[{first}]" if times.size > 1 else "t"
        message = f"{which} is {times[first]} s; the motion lasts from {begin:g} to {end!r} s"
        raise BadSetting(message, setting="t")
    return sampled(scene, motion, np.clip(times, begin, end))


def every(scene: Scene, motion: Motion, period: float) -> Samples:
    """Return ``motion`` every ``period`` (s), both ends included; the times count from 0 s.

    Raises:
        BadSetting: The period is not finite, or not greater than 0.
    """
    if not (math.isfinite(period) and period > 0.0):
        raise BadSetting(f"period is {period} s, it must be finite and greater than 0", setting="period")
    duration = motion.duration
    if duration / period > MOST_SAMPLES:
        message = f"period is {period} s, a motion of {duration:g} s would have more than {MOST_SAMPLES} samples"
        raise BadSetting(message, setting="period")
    count = math.ceil(duration / period - 1e-9)
    return sampled(scene, motion, np.minimum(period * np.arange(count + 1), duration))
