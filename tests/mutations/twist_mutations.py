"""Faults in how twist is measured, and what kills them."""

from __future__ import annotations

from typing import Any

import numpy as np

from dolfinrod.twist import axis, crossing, flow, gauss, sweep, torsion
from tests.mutations.mutation import Mutation
from tests.mutations.planting import Plant, all_of, replaced
from tests.scenes import Array

__all__ = ["MUTATIONS"]


def _unsigned(right: Any, k: int, l: int, X: float, over: int, _sign: int, gap: float) -> Any:
    return right(k, l, X, over, 1, gap)


def _size(right: Any, *args: Any) -> Array:
    """Whichever way round."""
    return np.abs(right(*args))


def _other_way(right: Any, *args: Any) -> Array:
    return -right(*args)


def _exchanged(_right: Any, before: Array, after: Array) -> Array:
    """atan2(inner product, cross product)."""
    (y, z), (y_after, z_after) = before, after
    return np.asarray(np.arctan2(y * y_after + z * z_after, y * z_after - z * y_after))


def _at_its_own_nodes(right: Any, X: Array, yz: Array, fibre: Array, _at: Array, index: Array) -> Array:
    """Not at the X of the other fibre, but where the last node was."""
    return np.asarray(right(X, yz, fibre, X[fibre[:, None], index], index))


def _not_carried(_right: Any, u: Array, _t: Array, _onto: Array) -> Array:
    return u


def _no_rays(_right: Any, *_args: Any) -> float:
    return 0.0


def _everywhere(wrong: Any) -> Plant:
    """In every measure that sums up angles."""
    return all_of(*(replaced(module, "swept", wrong) for module in (axis, flow, sweep)))


def _of(name: str, fault: str, law: str, plant: Plant) -> Mutation:
    """Measuring is the same for every model."""
    return Mutation(name, fault, "discrete", law, plant)


MUTATIONS = (
    _of(
        "unsigned crossing",
        "each counts as right-handed",
        "signs of crossings",
        replaced(crossing, "Crossing", _unsigned),
    ),
    _of("unsigned crossing, angles", "|Δθ|", "winding of strands", _everywhere(_size)),
    _of("unsigned crossing, solid angles", "|Ω|", "Lk = Tw + Wr", replaced(gauss, "_solid_angles", _size)),
    _of("arguments of atan2 exchanged", "angle from the other axis", "winding of strands", _everywhere(_exchanged)),
    _of("arguments of atan2 exchanged, axis", "the same", "winding about an axis", _everywhere(_exchanged)),
    _of("S for Z", "angles from Z to Y", "winding of strands", _everywhere(_other_way)),
    _of("S for Z, axis", "the same", "winding about an axis", _everywhere(_other_way)),
    _of("S for Z, outflow", "the sense of what has left", "twist that leaves", _everywhere(_other_way)),
    _of(
        "fibres at different X",
        "each at its own nodes",
        "winding of strands",
        replaced(sweep, "between", _at_its_own_nodes),
    ),
    _of("ends cut off", "no rays beyond them", "winding with a hook", replaced(gauss, "_rays", _no_rays)),
    _of(
        "twist not carried over corners",
        "no parallel transport",
        "Lk = Tw + Wr",
        replaced(torsion, "_carried", _not_carried),
    ),
)
