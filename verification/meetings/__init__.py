"""Rods on rods with known answers, a file a group."""

from verification.meetings import bundle, core, crossing, pile, plied, shots

__all__ = ["CASES"]

CASES = (*crossing.CASES, *plied.CASES, *core.CASES, *bundle.CASES, *pile.CASES, *shots.CASES)
