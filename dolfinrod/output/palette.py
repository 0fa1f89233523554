"""Colours and line styles that all pictures of results share."""

from __future__ import annotations

__all__ = ["COMPONENTS", "RODS", "STYLES"]

# Okabe and Ito's colours, told apart by colour-blind eyes too.
COMPONENTS = ("#D55E00", "#0072B2", "#009E73")
RODS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
STYLES = ("-", (0, (5, 2)), (0, (1, 1.5)), (0, (5, 1.5, 1, 1.5)))
