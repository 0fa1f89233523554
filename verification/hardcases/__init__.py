"""Scenes that solvers stumble over: extreme numbers, long ways, and critical points."""

from verification.hardcases import extremes, passages, ways

__all__ = ["CASES"]

CASES = (*extremes.CASES, *ways.CASES, *passages.CASES)
