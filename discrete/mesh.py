"""Nodes and elements of all rods of a scene, in units of length L, force EI/L² and moment EI/L."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from discrete.element import stiffness
from discrete.frames import element_frame
from dolfinrod.scene import SceneError
from dolfinrod.scene.options import element_counts

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from dolfinrod.scene import Rod, Scene

    Array = NDArray[np.float64]
    Counts = NDArray[np.int64]

__all__ = ["RIGID_EXTENSION", "Elements", "Mesh", "Units", "mesh"]

# EA of a rod that cannot stretch, in EI/L²: the chord changes its length by a hundred-millionth under EI/L².
RIGID_EXTENSION = 1e8


@dataclass(frozen=True)
class Units:
    """What is one inside the model.

    Args:
        length: Longest rod L [m].
        stiffness: Largest bending stiffness EI [N m²].
    """

    length: float
    stiffness: float

    @property
    def force(self) -> float:
        """EI/L² [N]."""
        return self.stiffness / self.length**2

    @property
    def moment(self) -> float:
        """EI/L [N m], also the unit of energy [J]."""
        return self.stiffness / self.length


@dataclass(frozen=True, eq=False)
class Elements:
    """Elements of all rods, one after the other.

    Args:
        node_i: Node at which each begins; it ends at the next, shape (n,).
        rod: Its rod, shape (n,).
        l: Natural length along the rod, shape (n,).
        l_0: Natural length of the chord, shape (n,).
        compliance: Elongation per axial force, l/EA, shape (n,).
        k_star: [k*] at F_n = 0, shape (n, 12, 12).
        attached: Element axes seen from the sections of its ends, stress free, shape (n, 2, 3, 3).
    """

    node_i: Counts
    rod: Counts
    l: Array
    l_0: Array
    compliance: Array
    k_star: Array
    attached: Array

    def triads(self, R: Array) -> Array:
        """Triads E_i and E_j that are parallel to the element where it is stress free.

        Args:
            R: Section frames at all nodes, shape (n_nodes, 3, 3).

        Returns:
            E, shape (n, 2, 3, 3).
        """
        ends = np.empty_like(self.attached)
        ends[:, 0], ends[:, 1] = R[self.node_i], R[self.node_i + 1]
        return ends @ self.attached

    def gone(self, F_n: Array) -> bool:
        """Whether axial forces, shape (n,), leave nothing of any element, or less."""
        return bool((self.l_0 + self.compliance * F_n <= np.finfo(float).eps * self.l_0).any())


@dataclass(frozen=True, eq=False)
class Mesh:
    """Rods cut into elements, stress free.

    Args:
        units: What is one.
        origin: Where positions are counted from [m].
        s: Arc length of the nodes of each rod [m].
        first: First node of each rod, then the number of all nodes, shape (n_rods + 1,).
        x: Positions, shape (n_nodes, 3).
        R: Section frames, columns d1, d2, d3, shape (n_nodes, 3, 3).
        elements: The elements.
    """

    units: Units
    origin: Array
    s: tuple[Array, ...]
    first: Counts
    x: Array
    R: Array
    elements: Elements

    @cached_property
    def share(self) -> Array:
        """Length for which each node stands: half of the elements there, shape (n_nodes,)."""
        node_i, half = self.elements.node_i, 0.5 * self.elements.l
        share = np.zeros(len(self.x))
        share[node_i] = half
        share[node_i + 1] += half
        return share

    def node(self, rod: int, s: float) -> int:
        """Node of a rod nearest to an arc length [m]."""
        return int(self.first[rod] + np.argmin(np.abs(self.s[rod] - s)))


def mesh(scene: Scene, elements: int | Sequence[int]) -> Mesh:
    """Cut the rods of a scene, nodes wherever a support, point load or end of a line load sits.

    Args:
        scene: The problem.
        elements: Elements of each rod, one number for all or one a rod.

    Returns:
        The mesh in the units of the model.

    Raises:
        SceneError: Not a number of elements, or too few to have a node at every such place.
    """
    s = tuple(_nodes(scene, j, n) for j, n in enumerate(element_counts(elements, len(scene.rods))))
    units = Units(
        length=max(rod.length for rod in scene.rods), stiffness=max(max(rod.section.EI) for rod in scene.rods)
    )
    origin = scene.rods[0].centerline(np.zeros(1))[0]
    x = np.concatenate([rod.centerline(nodes) - origin for rod, nodes in zip(scene.rods, s, strict=True)])
    R = np.concatenate([rod.frames(nodes) for rod, nodes in zip(scene.rods, s, strict=True)])
    first = np.concatenate([[0], np.cumsum([len(nodes) for nodes in s])])
    x /= units.length
    return Mesh(units, origin, s, first, x, R, _elements(scene.rods, units, s, first, x, R))


def _nodes(scene: Scene, rod: int, n: int) -> Array:
    """Arc lengths of the nodes: evenly spaced between the marks of a rod, as evenly as n elements allow [m]."""
    length = scene.rods[rod].length
    marks = np.array(sorted({0.0, *scene.marks(rod), length}))
    gaps = np.diff(marks)
    if n < len(gaps):
        raise SceneError(
            f"elements must be at least {len(gaps)} for rods[{rod}], whose supports and loads cut it there, got {n}"
        )
    counts = np.maximum(1, ((n - len(gaps)) * gaps / length).astype(int))
    while counts.sum() < n:
        counts[np.argmax(gaps / counts)] += 1
    pieces = [np.linspace(a, b, c + 1)[:-1] for a, b, c in zip(marks[:-1], marks[1:], counts, strict=True)]
    return np.concatenate([*pieces, [length]])


def _elements(rods: Sequence[Rod], units: Units, s: tuple[Array, ...], first: Counts, x: Array, R: Array) -> Elements:
    """Elements of all rods from their stress-free nodes."""
    count = [len(nodes) - 1 for nodes in s]
    node_i = np.concatenate([np.arange(a, a + n) for a, n in zip(first, count, strict=False)])
    l = np.concatenate([np.diff(nodes) for nodes in s]) / units.length
    frame = element_frame(x[node_i + 1] - x[node_i], np.stack([R[node_i], R[node_i + 1]], axis=1))
    EA = np.repeat([_axial_stiffness(rod) / units.force for rod in rods], count)
    GI_p, EI_v, EI_w = np.repeat([(rod.section.GJ, *rod.section.EI) for rod in rods], count, axis=0).T / units.stiffness
    return Elements(
        node_i=node_i,
        rod=np.repeat(np.arange(len(rods)), count),
        l=l,
        l_0=frame.length,
        compliance=l / EA,
        k_star=stiffness(EA=EA, GI_p=GI_p, EI_v=EI_v, EI_w=EI_w, l=l),
        attached=np.swapaxes(frame.turned, 2, 3),
    )


def _axial_stiffness(rod: Rod) -> float:
    """EA, or what stands in for it where the rod cannot stretch [N]."""
    if "extension" in rod.section.rigid:
        return RIGID_EXTENSION * max(rod.section.EI) / rod.length**2
    return rod.section.EA
