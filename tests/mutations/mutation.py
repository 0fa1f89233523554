"""What a mutation is, and those that issues 3, 5, 6 and 7 ask for."""

from __future__ import annotations

from dataclasses import dataclass

from tests.mutations.planting import Plant

# What issues 3, 5, 6 and 7 list, in their words.
ASKED = (
    "4× axial stiffness",
    "sign of the u–w coupling",
    "κ₀ ignored",
    "R₀ on the wrong side",
    "gauge kept from the last step",
    "dead moment treated as follower",
    "a dropped quadrature point",
    "transposed direction cosines",
    "F_n/l dropped",
    "ω × Jω dropped",
    "J* not rotated",
    "wrong end-node mass",
    "momentum at the wrong time level",
    "friction without stick",
    "slip measured against the fixed frame",
    "normal not unit",
    "gap from the centreline",
    "missing friction moment",
    "unsigned crossing",
    "force on one rod only",
    "missing lever arm",
    "wrong segment parameter",
)


@dataclass(frozen=True)
class Mutation:
    """A fault planted in the code.

    Args:
        name: Short; one of `ASKED`, maybe with a place behind a comma, or one of our own.
        fault: What is wrong with it.
        solver: With which it is solved, out of `laws.SOLVERS`.
        law: That it breaks, out of `laws.LAWS`.
        plant: Puts it in.
        compiles: Whether it changes the weak form.
        slow: Whether the law takes more than a second, as where no equilibrium is found.
    """

    name: str
    fault: str
    solver: str
    law: str
    plant: Plant
    compiles: bool = False
    slow: bool = False

    @property
    def asked(self) -> str:
        """Which of the faults of `ASKED` it is; empty for our own."""
        begins = self.name.split(", ")[0]
        return begins if begins in ASKED else ""
