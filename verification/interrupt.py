"""Ctrl-C that cannot get lost: what is raised within a callback of PETSc may be taken for a solve that failed."""

from __future__ import annotations

from dolfinrod.interrupt import Interrupt

__all__ = ["Interrupt"]
