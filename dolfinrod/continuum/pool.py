"""Discretizations kept for the next scene with the same elements: a sweep over loads or sections sets up once."""

from __future__ import annotations

from collections import OrderedDict
from contextlib import contextmanager
from typing import TYPE_CHECKING

from mpi4py import MPI

from dolfinrod.continuum.discretization import Discretization

if TYPE_CHECKING:
    from collections.abc import Iterator

    from dolfinrod.continuum.kinematics import Kinematics

__all__ = ["borrowed"]

# Discretizations kept for each communicator; the one used longest ago goes first.
MOST_KEPT = 8

# Only for communicators that are never freed: the ranks of each make the same calls, so they keep the same ones.
_IDLE: dict[str, OrderedDict[tuple[str, int, tuple[int, ...], bool, bool], Discretization]] = {
    "world": OrderedDict(),
    "self": OrderedDict(),
}


@contextmanager
def borrowed(
    comm: MPI.Comm,
    kinematics: Kinematics,
    degree: int,
    elements: tuple[int, ...],
    *,
    stepped: bool = False,
    rubbed: bool = False,
) -> Iterator[tuple[Discretization, bool]]:
    """A discretization for the time of one solve, and whether it was made for it.

    It leaves the pool while in use, so a solve started from within another one gets its own.
    """
    idle = _IDLE["world"] if comm == MPI.COMM_WORLD else _IDLE["self"] if comm == MPI.COMM_SELF else None
    key = (kinematics.name, degree, elements, stepped, rubbed)
    found = None if idle is None else idle.pop(key, None)
    if found is None:
        discretization = Discretization(comm, kinematics, degree, elements, stepped=stepped, rubbed=rubbed)
    else:
        discretization = found
    yield discretization, found is None
    if idle is not None:
        idle[key] = discretization
        if len(idle) > MOST_KEPT:
            idle.popitem(last=False)
