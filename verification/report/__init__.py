"""The record as a page and as JSON.

`figures` draws, `tables` and `sections` write HTML, `remarks` puts deviations into words, `page` puts it together.
"""

from verification.report.page import write

__all__ = ["write"]
