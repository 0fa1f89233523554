"""Ways to take a step: straight away, in halves where rods meet rods, and by an approach."""

from __future__ import annotations

from typing import TYPE_CHECKING

from discrete.assembly import SingularTangentError
from discrete.step import PiercedError, StepLostError

if TYPE_CHECKING:
    from collections.abc import Callable

    from discrete.taken import Taken

    Way = Callable[[], Taken]

__all__ = ["Ways"]


class Ways:
    """The order in which a step is tried.

    Where rods touch rods, half a step leads on sooner than another way through the whole of it: a first step that is
    lost is given back to be halved, and approached only when the next one is lost, too.

    Args:
        meet: Whether rods may touch rods.
    """

    def __init__(self, *, meet: bool) -> None:
        self._meet, self._lost = meet, False

    def taken(self, straight: Way, approached: Way, forget: Callable[[], None]) -> Taken:
        """The step.

        Args:
            straight: Takes it from an extrapolated first guess.
            approached: Takes it from where the rods stand, by another iteration first.
            forget: Lets go of what a way that led nowhere has left.

        Raises:
            StepLostError: It could not be taken.
        """
        try:
            found = straight()
        except PiercedError:
            forget()
            raise
        except (SingularTangentError, StepLostError) as error:
            forget()
            self._lost = self._meet and not self._lost
            if self._lost:
                raise StepLostError(str(error)) from error
            try:
                found = approached()
            except (SingularTangentError, StepLostError) as again:
                forget()
                raise StepLostError(str(again)) from again
        self._lost = False
        return found
