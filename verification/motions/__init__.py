"""Motions and vibrations with known answers, a file a group."""

from verification.motions import air, bodies, pulses, swing, vibrations

__all__ = ["CASES", "VIBRATIONS"]

CASES = (*swing.CASES, *pulses.CASES, *bodies.CASES, *air.CASES)
VIBRATIONS = vibrations.CASES
