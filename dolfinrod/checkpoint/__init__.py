"""Runs kept in a file while they are under way, so that what interrupts them costs a minute at most; of both models."""

from dolfinrod.checkpoint.checkpoint import Checkpoint
from dolfinrod.checkpoint.identity import goes_on
from dolfinrod.checkpoint.kept import Kept
from dolfinrod.checkpoint.steps import columns, rows

__all__ = ["Checkpoint", "Kept", "columns", "goes_on", "rows"]
