"""Rods on rigid surfaces with known answers, a file a group."""

from verification.contacts import cylinders, foundation, grooves, normal, tubes, walls

__all__ = ["CASES"]

# Without friction, at rest.
NORMAL = (*normal.CASES, *foundation.CASES, *grooves.CASES, *walls.CASES, *cylinders.CASES, *tubes.CASES)
# With friction, and in motion.
RUBBING = ()
CASES = (*NORMAL, *RUBBING)
