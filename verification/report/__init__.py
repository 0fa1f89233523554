"""The record as a page, as JSON with its schema, and in short as Markdown.

`canvas`, `diagrams` and `shapes` draw, `tables`, `sections`, `times` and `families` write HTML, `outcomes`, `verdict`,
`remarks` and `misses` put numbers into words, `contents`, `page` and `summary` put it together.
"""

from verification.report.page import write
from verification.report.summary import summarise

__all__ = ["summarise", "write"]
