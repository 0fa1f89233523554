"""The continuum model: geometrically exact rods in weak form in DOLFINx, solved by PETSc SNES."""

from dolfinrod.continuum.critical import critical
from dolfinrod.continuum.eigenmodes import buckling, modes
from dolfinrod.continuum.solver import solve

__all__ = ["buckling", "critical", "modes", "solve"]
