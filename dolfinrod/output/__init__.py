"""What a result looks like on disk and in words."""

from dolfinrod.output.record import versions, write
from dolfinrod.output.text import contents, summary

__all__ = ["contents", "summary", "versions", "write"]
