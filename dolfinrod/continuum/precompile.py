"""Weak forms compiled ahead of any solve: `python -m dolfinrod.continuum.precompile [DEGREE...]`.

DOLFINx keeps what it has compiled in the user's cache folder, named by the formula alone, so that no later process
waits for the compiler, whatever scene it solves.
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from mpi4py import MPI

from dolfinrod.continuum.discretization import Discretization
from dolfinrod.continuum.planar import PlanarRods
from dolfinrod.continuum.spatial import SpatialRods

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

__all__ = ["USUAL", "compiled"]

# The degree of those who ask for none.
USUAL = (3,)


def compiled(degrees: Iterable[int] = USUAL) -> Iterator[str]:
    """Compile the forms of equilibria and motions, in the plane and in space, or find them compiled.

    Args:
        degrees: Of centreline and rotation, 1 to 5.

    Yields:
        What there is now, and the seconds it took, in words.
    """
    for degree in degrees:
        for kinematics in (PlanarRods(), SpatialRods()):
            made = Discretization(MPI.COMM_SELF, kinematics, degree, (1,), stepped=True)
            yield f"{kinematics.name}, degree {degree}: {made.seconds_compile:.1f} s"


if __name__ == "__main__":
    for words in compiled(map(int, sys.argv[1:]) if len(sys.argv) > 1 else USUAL):
        sys.stdout.write(f"{words}\n")
