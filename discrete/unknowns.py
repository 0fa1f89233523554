"""Where the unknowns stand: seven to a node, thirteen to an element.

A node carries its displacement x, its spin ω (both in global axes) and the axial force F_n of the element that begins
there. An element therefore sees one contiguous run (x_i, ω_i, F_n, x_j, ω_j), and the system is banded. The place of
F_n at the last node of a rod is empty.
"""

from __future__ import annotations

__all__ = ["AXIAL", "N_ELEMENT", "N_NODE", "SPIN", "SPIN_I", "SPIN_J", "X", "X_I", "X_J"]

N_NODE = 7
N_ELEMENT = 13

X = X_I = slice(0, 3)
SPIN = SPIN_I = slice(3, 6)
AXIAL = 6
X_J = slice(7, 10)
SPIN_J = slice(10, 13)
