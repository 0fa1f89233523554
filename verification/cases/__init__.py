"""The cases, one file a family."""

from verification.cases import bend45, elastica, follower, heavy, parabola, rollup

__all__ = ["CASES", "bend45", "elastica", "follower", "heavy", "parabola", "rollup"]

CASES = (*elastica.CASES, *follower.CASES, *heavy.CASES, *rollup.CASES, *bend45.CASES, *parabola.CASES)
