"""What a result looks like on disk."""

from dolfinrod.output.record import versions, write

__all__ = ["versions", "write"]
