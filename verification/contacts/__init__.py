"""Rods on rigid surfaces with known answers, a file a group."""

from verification.contacts import (
    capstan,
    cylinders,
    foundation,
    friction,
    grooves,
    impacts,
    normal,
    rolling,
    tubes,
    walls,
)

__all__ = ["CASES"]

# Without friction, at rest.
NORMAL = (*normal.CASES, *foundation.CASES, *grooves.CASES, *walls.CASES, *cylinders.CASES, *tubes.CASES)
# With friction, and in motion.
RUBBING = (*capstan.CASES, *friction.CASES, *rolling.CASES, *impacts.CASES)
CASES = (*NORMAL, *RUBBING)
