"""The record as a page and as JSON.

`canvas`, `diagrams` and `shapes` draw, `tables`, `sections`, `times` and `families` write HTML, `remarks` and `misses`
put numbers into words, `contents` and `page` put it together.
"""

from verification.report.page import write

__all__ = ["write"]
