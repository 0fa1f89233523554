"""The cases, one file a family."""

from verification.cases import bend45, elastica, rollup

__all__ = ["CASES", "bend45", "elastica", "rollup"]

CASES = (*elastica.CASES, *rollup.CASES, *bend45.CASES)
