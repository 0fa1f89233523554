"""All that rods touch, surfaces and one another, as one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from dolfinrod.continuum.contact import Contacts
from dolfinrod.continuum.pairs import Pairs

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy as np
    from numpy.typing import NDArray

    from dolfinrod.continuum.problem import Block, Problem

    Array = NDArray[np.float64]

__all__ = ["Together", "Touching", "touching"]


class Touching(Protocol):
    """What steps and iterations ask of all that rods touch; all ranks call these together.

    Attributes:
        q: Rotation dofs of this rank's own nodes.
    """

    q: NDArray[np.int32]

    @property
    def renews(self) -> bool:
        """Whether any law has multipliers."""
        ...

    @property
    def pattern(self) -> bytes:
        """What touches, sticks and slides on this rank."""
        ...

    def glide(self) -> None:
        """Begin an iteration with what slid in the last state that counts sliding on."""
        ...

    def begin(self, t: float) -> None:
        """A step from where the rods were last accepted leads to time t."""
        ...

    def add_residual(self, b: Array, q: Array) -> None:
        """Add what acts on the rods to a residual, moments in the spins of rotations q."""
        ...

    def blocks(self, q: Array) -> Iterable[Block]:
        """Blocks of single nodes in the tangent by the state after the step."""
        ...

    @property
    def changed(self) -> bool:
        """Whether anything has come to touch, stick or slide, or ceased to, since the answer before the last one."""
        ...

    @property
    def stiffness(self) -> float:
        """That of the stiffest law, in EI/L⁴."""
        ...

    def soften(self, by: float) -> None:
        """Let all be softer by a factor, until the next step begins."""
        ...

    def foresee(self, r: Array) -> bool:
        """Whether a linear step to r changes what is pressed; the next answer is with that."""
        ...

    def renew(self) -> bool:
        """Renew multipliers; whether penetrations were within their tolerances already."""
        ...

    def accept(self) -> list[float]:
        """The step counts; energies rubbed off on this rank, and given by walls, in EI/L."""
        ...

    def stored(self) -> float:
        """Energy stored on this rank, in EI/L."""
        ...

    def memory(self) -> Any:
        """What this rank remembers."""
        ...

    def take_back(self, memory: Any) -> None:
        """Be what `memory` said earlier, at the state of that time."""
        ...


class Together:
    """Surfaces and pairs of rods; each method is that of both.

    Args:
        walls: The surfaces.
        pairs: The pairs.
    """

    def __init__(self, walls: Contacts, pairs: Pairs) -> None:
        self._walls, self._pairs = walls, pairs
        self._both: tuple[Touching, Touching] = walls, pairs
        self.q, self.renews = walls.q, walls.renews

    @property
    def pattern(self) -> bytes:
        """Of both."""
        return b"".join(part.pattern for part in self._both)

    def glide(self) -> None:
        """Both begin with what slid."""
        for part in self._both:
            part.glide()

    def begin(self, t: float) -> None:
        """A step leads to time t."""
        for part in self._both:
            part.begin(t)

    def add_residual(self, b: Array, q: Array) -> None:
        """Add what both do to the rods."""
        for part in self._both:
            part.add_residual(b, q)

    def blocks(self, q: Array) -> Iterable[Block]:
        """Those of both."""
        return [*self._walls.blocks(q), *self._pairs.blocks(q)]

    @property
    def changed(self) -> bool:
        """Whether either has."""
        walls, pairs = (part.changed for part in self._both)
        return walls or pairs

    @property
    def stiffness(self) -> float:
        """That of the stiffer."""
        return max(part.stiffness for part in self._both)

    def soften(self, by: float) -> None:
        """Let both be softer."""
        for part in self._both:
            part.soften(by)

    def foresee(self, r: Array) -> bool:
        """Whether the surfaces do."""
        return self._walls.foresee(r)

    def renew(self) -> bool:
        """Whether the surfaces were within their tolerances."""
        return self._walls.renew()

    def accept(self) -> list[float]:
        """Energies of both."""
        return [sum(parts) for parts in zip(*(part.accept() for part in self._both), strict=True)]

    def stored(self) -> float:
        """Energy in both."""
        return sum(part.stored() for part in self._both)

    def memory(self) -> Any:
        """Of both."""
        return [part.memory() for part in self._both]

    def take_back(self, memory: Any) -> None:
        """Both are what it said earlier."""
        for part, remembered in zip(self._both, memory, strict=True):
            part.take_back(remembered)


def touching(problem: Problem) -> tuple[Contacts | None, Pairs | None, Touching | None]:
    """Surfaces that the rods of a problem touch, pairs of its rods, and what there is of both as one."""
    walls = Contacts(problem, problem.level) if problem.scene.walls else None
    pairs = Pairs(problem, problem.level) if problem.scene.meetings else None
    if walls is not None and pairs is not None:
        return walls, pairs, Together(walls, pairs)
    return walls, pairs, walls if pairs is None else pairs
