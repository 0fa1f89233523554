"""A case: a problem posed as a scene, what is read off, and what it should be."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

if TYPE_CHECKING:
    from dolfinrod.result import Result
    from dolfinrod.scene import Scene
    from verification.references import Reference

__all__ = ["SKEW", "UPRIGHT", "Case", "Pose"]

Array = NDArray[np.float64]
Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Pose:
    """Where the axes of a problem lie in space, x ↦ Q·x + o.

    Args:
        rotation_vector: Of Q [rad].
        origin: o, in units of the case's length.
    """

    rotation_vector: Vector = (0.0, 0.0, 0.0)
    origin: Vector = (0.0, 0.0, 0.0)

    @property
    def rotation(self) -> Array:
        """Q, shape (3, 3)."""
        return np.asarray(Rotation.from_rotvec(self.rotation_vector).as_matrix())

    def vector(self, x: float, y: float, z: float = 0.0) -> Vector:
        """Q·x, for directions, forces and moments."""
        a, b, c = (float(v) for v in self.rotation @ (x, y, z))
        return a, b, c

    def start(self, length: float) -> Vector:
        """The origin of a problem of that length [m]."""
        a, b, c = (length * o for o in self.origin)
        return a, b, c

    def back(self, points: Array, length: float) -> Array:
        """Points of space in the axes of the problem, shape (..., 3) [m]."""
        return np.asarray((points - np.asarray(self.start(length))) @ self.rotation)


UPRIGHT = Pose()
# In no coordinate plane and with no axis along another.
SKEW = Pose(rotation_vector=(0.4, -0.9, 1.3), origin=(0.2, -0.5, 0.9))


def tip(result: Result) -> Array:
    """End of the first rod at the last stored state."""
    return result.tip


@dataclass(frozen=True)
class Case:
    """A problem with a known answer.

    Args:
        name: Short, unique, fit for a file name.
        title: For people.
        family: Of which it is one, such as "elastica"; its file in verification/cases.
        scene: The problem in a pose.
        reference: What the quantity should be.
        length: By which errors are divided [m].
        models: Families of models that pose the same problem, out of "continuum" and "discrete".
        planar: Whether planar kinematics holds it.
        turns: Full turns of the rod; meshes are as many times finer.
        quantity: What is read off a result, shape (3,) [m].
        quantity_name: In words.
        centreline: Exact centreline at arc lengths (n,), shape (n, 3), where a closed form is known [m].
        note: One sentence where a model deviates from theory: what is seen and why.
    """

    name: str
    title: str
    family: str
    scene: Callable[[Pose], Scene]
    reference: Reference
    length: float
    models: tuple[str, ...] = ("continuum", "discrete")
    planar: bool = True
    turns: int = 1
    quantity: Callable[[Result], Array] = tip
    quantity_name: str = "tip position"
    centreline: Callable[[Array], Array] | None = field(default=None, repr=False)
    note: str = ""

    def error(self, result: Result, pose: Pose = UPRIGHT) -> float:
        """|quantity − reference| / length.

        Args:
            result: Of this case's scene.
            pose: In which it was posed.

        Returns:
            The relative error.
        """
        found = pose.back(self.quantity(result), self.length)
        return float(np.linalg.norm(found - np.asarray(self.reference.value)) / self.length)

    def centreline_error(self, result: Result, degree: int, pose: Pose = UPRIGHT) -> float | None:
        """√(∫ |r − r_exact|² ds / L³), r taken as the piecewise polynomial through the nodes.

        Args:
            result: Of this case's scene, on elements with `degree` + 1 nodes.
            degree: Of the polynomials.
            pose: In which it was posed.

        Returns:
            The relative L2 error; None where no closed form is known.
        """
        if self.centreline is None:
            return None
        rod = result.rods[0]
        cells = np.arange(0, len(rod.s) - 1, degree)[:, None] + np.arange(degree + 1)
        ends = rod.s[cells[:, [0, -1]]]
        lengths = ends[:, 1] - ends[:, 0]
        # All elements carry their nodes at the same places.
        nodes = (rod.s[cells[0]] - ends[0, 0]) / lengths[0]
        ξ, w = np.polynomial.legendre.leggauss(degree + 8)
        ξ = 0.5 * (1.0 + ξ)
        legendre = np.polynomial.legendre.legvander
        basis = legendre(2.0 * ξ - 1.0, degree) @ np.linalg.inv(legendre(2.0 * nodes - 1.0, degree))
        r = np.einsum("qa,cai->cqi", basis, pose.back(rod.r[-1], self.length)[cells])
        s = ends[:, :1] + lengths[:, None] * ξ
        off = r - self.centreline(s.ravel()).reshape(r.shape)
        squared = np.einsum("cqi,cqi,c,q->", off, off, lengths, 0.5 * w)
        return float(np.sqrt(squared / self.length**3))
