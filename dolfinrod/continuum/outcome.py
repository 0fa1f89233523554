"""How an attempt at equilibrium ended, in numbers and words."""

from __future__ import annotations

from dataclasses import dataclass

from petsc4py import PETSc

__all__ = ["LOST", "MOST_ITERATIONS", "SINGULAR", "Outcome", "words"]

# Iterations after which a load step is given up; a rod that winds up five turns takes about twenty.
MOST_ITERATIONS = 50

LOST = PETSc.SNES.ConvergedReason.DIVERGED_DTOL
SINGULAR = PETSc.SNES.ConvergedReason.DIVERGED_LINEAR_SOLVE
REASONS = {
    PETSc.SNES.ConvergedReason.DIVERGED_FNORM_NAN: "the residual is not a number",
    PETSc.SNES.ConvergedReason.DIVERGED_MAX_IT: "Newton's method did not settle in {} iterations",
    LOST: "the sections turned to and fro and did not settle",
    SINGULAR: ("the tangent is singular: something is free to move, or a load is critical"),
    PETSc.SNES.ConvergedReason.DIVERGED_FUNCTION_DOMAIN: "the residual is not a number",
}


@dataclass(frozen=True)
class Outcome:
    """How one solve ended.

    Args:
        converged: Whether the increments became small enough.
        iterations: Newton iterations done.
        residual: Norm of the last residual in working units.
        reason: The SNES reason in words.
        strayed: Whether the rods ended up turned against the way they set out.
    """

    converged: bool
    iterations: int
    residual: float
    reason: str
    strayed: bool = False


def words(reason: int, iterations: int) -> str:
    """A reason of SNES for which it stopped after so many iterations."""
    if reason > 0:
        return "converged"
    return REASONS.get(reason, f"PETSc reports reason {reason}").format(iterations)
