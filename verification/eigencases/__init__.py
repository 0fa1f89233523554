"""Critical loads and natural frequencies with known answers, a file a family."""

from verification.eigencases import columns, strips, tubes, twist, vibrations

__all__ = ["CASES"]

CASES = (*columns.CASES, *twist.CASES, *strips.CASES, *tubes.CASES, *vibrations.CASES)
