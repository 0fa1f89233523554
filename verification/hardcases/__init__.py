"""Scenes that solvers stumble over: extreme numbers, long ways, and critical points."""

from verification.hardcases import extremes, passages, together, ways

__all__ = ["CASES"]

CASES = (*extremes.CASES, *ways.CASES, *together.CASES, *passages.CASES)
