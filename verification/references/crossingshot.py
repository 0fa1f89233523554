"""The crossing of `crossing` by another method: steps along both rods from their middles, shot at their ends.

Heights, tensions and moments of both middles and the forces there are eight unknowns; what the ends lack, and that
either middle feels the lens of the other rod, are eight conditions.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import root

from verification.references.crossing import N_H, N_X, OTHER, H, M, Q, X

if TYPE_CHECKING:
    from verification.references.crossing import Crossing, Strand

__all__ = ["shot"]

Array = NDArray[np.float64]

TOLERANCE = 1e-13


@dataclass(frozen=True)
class Edge:
    """Where a lens ends, for SciPy to stop at.

    Args:
        other: Height of the other rod's middle on its own side [m].
        reach: Distance at which contact begins [m].
    """

    other: float
    reach: float
    terminal: ClassVar[bool] = True

    def __call__(self, _: float, u: Array) -> float:
        """Distance from the other rod's middle beyond the reach [m]."""
        return float(np.hypot(u[X], u[H] + self.other) - self.reach)


def shot(crossing: Crossing) -> tuple[float, float, float]:
    """Both heights of the middles and the force [m, m, N].

    Args:
        crossing: Posed as for `crossed`.

    Raises:
        ArithmeticError: None was found.
    """
    known = _linear(crossing)
    size = np.tile([crossing.reach, known[1], np.sqrt(known[1] * crossing.strands[0].EI), known[3]], 2)

    def off(scaled: Array) -> Array:
        first, second = np.split(scaled * size, 2)
        ends = [_end(crossing, crossing.strands[0], first, second[0])]
        ends.append(_end(crossing, crossing.strands[1], second, first[0]))
        missed = []
        for strand, own, end, other in zip(crossing.strands, (first, second), ends, ends[::-1], strict=True):
            missed += [end[H] - strand.height, end[N_X] - strand.pull, end[M], own[3] - 2.0 * other[Q]]
        return np.array(missed) / size

    found = root(off, known / size, tol=TOLERANCE)
    if np.abs(off(found.x)).max() > 1e-9:
        raise ArithmeticError(f"the rods do not agree: {found.message}")
    first, second = np.split(found.x * size, 2)
    return float(first[0]), float(second[0]), float(first[3] + second[3])


def _linear(crossing: Crossing) -> Array:
    """Height, n_x, m and force of either middle in linear theory, shape (8,)."""
    force = crossing.linear
    starts = [s.sketch(force, np.zeros(1))[0] for s in crossing.strands]
    return np.concatenate([[u[H], u[N_X], u[M], 0.5 * force] for u in starts])


def _end(crossing: Crossing, strand: Strand, middle: Array, other: float) -> Array:
    """State at the end of a rod whose middle starts from height, n_x, m and half the force there."""
    h, n_x, m, P = middle
    start = np.zeros(7)
    start[[H, N_X, N_H, M]] = h, n_x, -0.5 * P, m

    def within(_: float, u: Array) -> Array:
        return strand.slope(u, *crossing.load(np.insert(u, [7] * (OTHER + 1 - 7), [0.0] * (OTHER - 7) + [other])))

    def beyond(_: float, u: Array) -> Array:
        return strand.slope(u, np.zeros(()), np.zeros(()))

    edge, ℓ = Edge(other, crossing.reach), 0.5 * strand.length
    steps = {"method": "DOP853", "rtol": TOLERANCE, "atol": 1e-15 * crossing.reach}
    if edge(0.0, start) >= 0.0:
        return np.asarray(solve_ivp(beyond, (0.0, ℓ), start, **steps).y[:, -1])
    lens = solve_ivp(within, (0.0, ℓ), start, events=edge, **steps)
    return np.asarray(solve_ivp(beyond, (lens.t[-1], ℓ), lens.y[:, -1], **steps).y[:, -1])
