"""What a result looks like on disk and in words; pictures, which load Matplotlib, are in `dolfinrod.output.figures`."""

from dolfinrod.output.reading import load
from dolfinrod.output.record import versions, write
from dolfinrod.output.text import contents, summary

__all__ = ["contents", "load", "summary", "versions", "write"]
