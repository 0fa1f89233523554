"""The continuum model: geometrically exact rods in weak form in DOLFINx, solved by PETSc SNES."""

from dolfinrod.continuum.solver import solve

__all__ = ["solve"]
