"""Arrays of real numbers, as people hand them in."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from elbowroom._errors import BadSetting, ElbowroomError, TrajectoryError


def real_array(
    name: str, values: ArrayLike, *, dimensions: int, shape: str, setting: str | None = None
) -> NDArray[np.float64]:
    """Return ``values`` as an array of floats, if nothing of them is lost by it.

    Raises:
        TrajectoryError: They are masked, complex, True and False, text or objects, or of another shape than ``shape``.
        BadSetting: The same, where they are the value of a ``setting``.
    """

    def refused(what: str) -> ElbowroomError:
        message = f"{name} {what}; an array of real numbers of shape {shape} is needed"
        return TrajectoryError(message) if setting is None else BadSetting(message, setting=setting)

    if isinstance(values, np.ma.MaskedArray):
        raise refused("is a masked array, whose mask would be lost: leave out what is masked")
    try:
        array = np.asarray(values)
    except (ValueError, TypeError, OverflowError):
        raise refused("is no array: its rows differ in length, or hold what is no number") from None
    if array.dtype.kind not in "iuf":
        kind = {"b": "True and False", "c": "complex numbers", "O": "objects", "U": "text", "S": "text"}
        # An empty list is an array of floats; of any other kind it was asked to be.
        raise refused(f"holds {kind.get(array.dtype.kind, f'values of type {array.dtype}')}")
    if array.ndim != dimensions:
        raise refused(f"has shape {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)
