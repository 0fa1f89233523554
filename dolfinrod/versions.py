"""What computes: Python and the packages that are installed, each with its version."""

from __future__ import annotations

import platform

__all__ = ["versions"]

PACKAGES = (
    "dolfinrod",
    "numpy",
    "scipy",
    "fenics-dolfinx",
    "fenics-ufl",
    "fenics-ffcx",
    "fenics-basix",
    "petsc4py",
    "mpi4py",
    "pint",
    "meshio",
    "matplotlib",
)


def versions() -> dict[str, str]:
    """Versions by name; packages that are not installed are left out."""
    # Its e-mail parser and all: a tenth of what a solve without a record loads.
    from importlib import metadata

    found = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            continue
    return found
