"""Elements in arbitrary states, for tests of their laws."""

from __future__ import annotations

import numpy as np

from discrete.corotation import ChordElement
from discrete.element import stiffness
from discrete.mesh import Elements
from discrete.nodeframe import EnergyNodeElement, PaperElement
from discrete.rotation import exp

N = 6

LAWS = {
    ("element", "chord"): lambda elements: ChordElement(elements, paper_strain=False),
    ("element", "paper"): lambda elements: ChordElement(elements, paper_strain=True),
    ("node_i", "chord"): EnergyNodeElement,
    ("node_i", "paper"): PaperElement,
}
# Forces of these are gradients.
ENERGETIC = [("element", "chord"), ("node_i", "chord")]


def some_elements(rng: np.random.Generator) -> Elements:
    """Unequal elements with three different stiffnesses."""
    l = rng.uniform(0.5, 1.5, N)
    EA = rng.uniform(10.0, 40.0, N)
    GI_p, EI_v, EI_w = rng.uniform(0.5, 2.0, (3, N))
    return Elements(
        node_i=np.arange(N),
        rod=np.zeros(N, dtype=int),
        l=l,
        l_0=0.97 * l,
        compliance=l / EA,
        k_star=stiffness(EA=EA, GI_p=GI_p, EI_v=EI_v, EI_w=EI_w, l=l),
        attached=np.tile(np.eye(3), (N, 2, 1, 1)),
    )


def some_state(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Chords, end triads turned by half a radian against them, axial forces."""
    Q = exp(rng.normal(size=(N, 3)))
    e = np.einsum("nij,j->ni", Q, [1.0, 0.0, 0.0]) * rng.uniform(0.6, 1.4, N)[:, None]
    E = Q[:, None] @ exp(0.4 * rng.normal(size=(N, 2, 3)))
    return e, E, rng.normal(size=N)


def moved(e: np.ndarray, E: np.ndarray, F_n: np.ndarray, d: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The state after displacements and spins d = (x_i, ω_i, F_n, x_j, ω_j), shape (n, 13)."""
    turned = exp(np.stack([d[:, 3:6], d[:, 10:13]], axis=1)) @ E
    return e + d[:, 7:10] - d[:, 0:3], turned, F_n + d[:, 6]
